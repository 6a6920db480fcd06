//! The emulated controller's general-purpose registers.

use super::fields::{InputField, NAMED_INPUTS};
use crate::registers::REGISTER_COUNT;
use crate::wire::Value;

const COUNT: usize = REGISTER_COUNT as usize;

/// Registers keep their last value; clients write inputs, programs write outputs.
#[derive(Clone, Debug)]
pub(super) struct Registers {
    input_int: [i32; COUNT],
    input_double: [f64; COUNT],
    input_bit: [bool; 64],
    named: [Value; NAMED_INPUTS.len()],
    output_int: [i32; COUNT],
    /// The cycle in which each integer input was last written, for the watchdog.
    written_at: [u64; COUNT],
}

impl Registers {
    pub(super) fn new() -> Self {
        Self {
            input_int: [0; COUNT],
            input_double: [0.0; COUNT],
            input_bit: [false; 64],
            named: NAMED_INPUTS.map(|(_, value)| value),
            output_int: [0; COUNT],
            written_at: [0; COUNT],
        }
    }

    /// Writes an input in the given cycle. Numbers that are not finite never get here: a package
    /// that holds one is dropped as a whole.
    pub(super) fn write_input(&mut self, field: InputField, value: Value, cycle: u64) {
        match (field, value) {
            (InputField::Int(register), Value::Int32(value)) => {
                self.input_int[register] = value;
                self.written_at[register] = cycle;
            }
            (InputField::Double(register), Value::Double(value)) => {
                self.input_double[register] = value;
            }
            (InputField::Bit(register), Value::Bool(value)) => self.input_bit[register] = value,
            (InputField::Named(place), value) => self.named[place] = value,
            // A package is decoded with its recipe's types, so no other pair occurs.
            _ => {}
        }
    }

    pub(super) fn input(&self, field: InputField) -> Value {
        match field {
            InputField::Int(register) => Value::Int32(self.input_int[register]),
            InputField::Double(register) => Value::Double(self.input_double[register]),
            InputField::Bit(register) => Value::Bool(self.input_bit[register]),
            InputField::Named(place) => self.named[place],
        }
    }

    /// The present value of an input that is no register.
    pub(super) fn named(&self, place: usize) -> Value {
        self.named[place]
    }

    pub(super) fn input_int(&self, register: u8) -> i32 {
        self.input_int[usize::from(register)]
    }

    /// Six doubles from register `first` on.
    pub(super) fn six_doubles(&self, first: u8) -> [f64; 6] {
        std::array::from_fn(|joint| self.input_double[usize::from(first) + joint])
    }

    pub(super) fn written_at(&self, register: u8) -> u64 {
        self.written_at[usize::from(register)]
    }

    pub(super) fn output_int(&self, register: usize) -> i32 {
        self.output_int[register]
    }

    pub(super) fn write_output_int(&mut self, register: u8, value: i32) {
        self.output_int[usize::from(register)] = value;
    }
}
