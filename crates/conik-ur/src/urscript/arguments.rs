//! The arguments of a call, with their types and ranges checked.

use super::error::Fault;
use super::signature::Signature;
use super::surroundings::Register;
use super::value::Value;
use std::ops::RangeInclusive;

/// General-purpose registers of each kind.
const NUMBER_REGISTERS: f64 = 47.0;
const BOOLEAN_REGISTERS: f64 = 127.0;

/// The arguments of a call, as many as there are parameters.
pub(super) struct Arguments<'a> {
    pub(super) signature: &'a Signature,
    pub(super) values: &'a [Value],
}

impl Arguments<'_> {
    /// The name of an argument, for people.
    fn place(&self, index: usize) -> String {
        let parameter = self.signature.parameters().nth(index).unwrap_or_default();
        format!("{}'s {parameter}", self.signature.name)
    }

    pub(super) fn is_not(&self, index: usize, wanted: &'static str) -> Fault {
        self.values[index].is_not(wanted, self.place(index))
    }

    pub(super) fn number(&self, index: usize) -> Result<f64, Fault> {
        let number = self.values[index].number();
        number.ok_or_else(|| self.is_not(index, "a number"))
    }

    pub(super) fn integer(&self, index: usize) -> Result<i32, Fault> {
        match self.values[index] {
            Value::Integer(value) => Ok(value),
            _ => Err(self.is_not(index, "an integer")),
        }
    }

    pub(super) fn boolean(&self, index: usize) -> Result<bool, Fault> {
        match self.values[index] {
            Value::Boolean(value) => Ok(value),
            _ => Err(self.is_not(index, "a boolean")),
        }
    }

    pub(super) fn text(&self, index: usize) -> Result<&str, Fault> {
        match &self.values[index] {
            Value::Text(text) => Ok(text),
            _ => Err(self.is_not(index, "a text")),
        }
    }

    /// A number of this range.
    pub(super) fn within(&self, index: usize, range: RangeInclusive<f64>) -> Result<f64, Fault> {
        let value = self.number(index)?;
        if range.contains(&value) {
            return Ok(value);
        }
        let (from, to) = range.into_inner();
        let place = self.place(index);
        Err(Fault::Range {
            place,
            value,
            from,
            to,
        })
    }

    /// A number of this range, or what holds where none is given.
    pub(super) fn optional(
        &self,
        index: usize,
        otherwise: f64,
        range: RangeInclusive<f64>,
    ) -> Result<f64, Fault> {
        match self.values[index] {
            Value::Nothing => Ok(otherwise),
            _ => self.within(index, range),
        }
    }

    /// The number of a register of this kind, which is the first argument.
    pub(super) fn address(&self, kind: Register) -> Result<usize, Fault> {
        self.integer(0)?;
        let last = match kind {
            Register::Float | Register::Integer => NUMBER_REGISTERS,
            Register::Boolean => BOOLEAN_REGISTERS,
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 0 to 127.
        self.within(0, 0.0..=last).map(|address| address as usize)
    }
}
