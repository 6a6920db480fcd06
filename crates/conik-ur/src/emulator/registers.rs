//! The emulated controller's general-purpose registers.

use super::fields::{InputField, LOWER_BITS, NAMED_INPUTS};
use crate::registers::REGISTER_COUNT;
use crate::wire::Value;
use std::collections::BTreeMap;

const COUNT: usize = REGISTER_COUNT as usize;

/// Bits; clients write those from 64 on one by one, and the others as two words.
const BITS: usize = 128;

/// Bits in a word.
const WORD: usize = 32;

/// Registers keep their last value; clients write inputs, programs write outputs.
#[derive(Clone, Debug)]
pub(super) struct Registers {
    input_int: [i32; COUNT],
    input_double: [f64; COUNT],
    input_bit: [bool; BITS],
    named: [Value; NAMED_INPUTS.len()],
    output_int: [i32; COUNT],
    output_double: [f64; COUNT],
    output_bit: [bool; BITS],
    /// The cycle in which each input was last written, for watchdogs.
    written_at: BTreeMap<InputField, u64>,
}

impl Registers {
    pub(super) fn new() -> Self {
        Self {
            input_int: [0; COUNT],
            input_double: [0.0; COUNT],
            input_bit: [false; BITS],
            named: NAMED_INPUTS.map(|(_, value)| value),
            output_int: [0; COUNT],
            output_double: [0.0; COUNT],
            output_bit: [false; BITS],
            written_at: BTreeMap::new(),
        }
    }

    /// Writes an input in the given cycle. Numbers that are not finite never get here: a package
    /// that holds one is dropped as a whole.
    pub(super) fn write_input(&mut self, field: InputField, value: Value, cycle: u64) {
        match (field, value) {
            (InputField::Int(register), Value::Int32(value)) => self.input_int[register] = value,
            (InputField::Double(register), Value::Double(value)) => {
                self.input_double[register] = value;
            }
            (InputField::Bit(register), Value::Bool(value)) => self.input_bit[register] = value,
            (InputField::Named(place), value) => self.named[place] = value,
            // A package is decoded with its recipe's types, so no other pair occurs.
            _ => {}
        }
        self.written_at.insert(field, cycle);
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

    pub(super) fn input_int(&self, register: usize) -> i32 {
        self.input_int[register]
    }

    pub(super) fn input_bit(&self, bit: usize) -> bool {
        match LOWER_BITS.get(bit / WORD).map(|place| self.named[*place]) {
            Some(Value::Uint32(word)) => word >> (bit % WORD) & 1 == 1,
            _ => self.input_bit[bit],
        }
    }

    /// The cycle in which an input was last written; 0 if never.
    pub(super) fn written_at(&self, field: InputField) -> u64 {
        self.written_at.get(&field).copied().unwrap_or(0)
    }

    pub(super) fn output_int(&self, register: usize) -> i32 {
        self.output_int[register]
    }

    pub(super) fn write_output_int(&mut self, register: usize, value: i32) {
        self.output_int[register] = value;
    }

    pub(super) fn output_double(&self, register: usize) -> f64 {
        self.output_double[register]
    }

    pub(super) fn write_output_double(&mut self, register: usize, value: f64) {
        self.output_double[register] = value;
    }

    pub(super) fn output_bit(&self, bit: usize) -> bool {
        self.output_bit[bit]
    }

    pub(super) fn write_output_bit(&mut self, bit: usize, value: bool) {
        self.output_bit[bit] = value;
    }

    /// The outputs of one word, the first in the lowest bit.
    pub(super) fn output_bits(&self, word: usize) -> u32 {
        let bits = self.output_bit.iter().skip(word * WORD).take(WORD);
        bits.rev().fold(0, |word, bit| word << 1 | u32::from(*bit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_stand_in_words_below_64_and_alone_above() {
        let mut registers = Registers::new();
        let word = InputField::Named(LOWER_BITS[1]);
        registers.write_input(word, Value::Uint32(1 << 3), 0);
        registers.write_input(InputField::Bit(100), Value::Bool(true), 0);
        let set: Vec<usize> = (0..BITS).filter(|bit| registers.input_bit(*bit)).collect();
        assert_eq!(set, [35, 100]);
        registers.write_output_bit(33, true);
        assert_eq!([registers.output_bits(0), registers.output_bits(1)], [0, 2]);
    }
}
