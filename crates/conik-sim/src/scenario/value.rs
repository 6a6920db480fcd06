//! Typed access to one value of the file. What is wrong with it is noted, with its place.

use std::ops::Range as Span;

use toml::Spanned;
use toml::de::{DeInteger, DeValue};

use super::key::{Key, Range};
use super::mistake::{Mistakes, quoted};
use super::place::{self, Placed};
use super::table::Table;

/// One value of the file, or a member of one.
#[derive(Debug)]
pub(super) struct Value<'a> {
    pub(super) toml: &'a Spanned<DeValue<'a>>,
    pub(super) path: String,
    pub(super) key: &'static Key,
}

impl<'a> Value<'a> {
    pub(super) fn span(&self) -> Span<usize> {
        self.toml.span()
    }

    /// What was made of the value, with the value's place.
    pub(super) fn placed<T>(&self, value: T) -> Placed<T> {
        Placed {
            value,
            span: self.span(),
            path: self.path.clone(),
        }
    }

    /// Notes that the value is of the wrong kind.
    pub(super) fn wrong_kind(&self, expected: &str, found: &mut Mistakes) {
        found.add(
            self.span(),
            &*self.path,
            format!(
                "expected {expected}, found {}",
                described(self.toml.get_ref())
            ),
            self.key.write_example(),
        );
    }

    /// A table.
    pub(super) fn table(&self, found: &mut Mistakes) -> Option<Table<'a>> {
        let entries = self.toml.get_ref().as_table();
        if entries.is_none() {
            self.wrong_kind("a table", found);
        }
        Some(Table {
            path: self.path.clone(),
            header: self.span(),
            entries: entries?,
        })
    }

    /// Text.
    pub(super) fn text(&self, found: &mut Mistakes) -> Option<&'a str> {
        let text = self.toml.get_ref().as_str();
        if text.is_none() {
            self.wrong_kind("text in quotes", found);
        }
        text
    }

    /// A number in a range; integers are numbers too.
    pub(super) fn number(&self, range: &Range, found: &mut Mistakes) -> Option<f64> {
        let number = match self.toml.get_ref() {
            DeValue::Integer(integer) => integer_as_number(integer),
            // A literal too great for a double reads as infinity, and is refused as such.
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            _ => {
                self.wrong_kind("a number", found);
                return None;
            }
        };
        if number.is_finite() && range.contains(number) {
            return Some(number);
        }
        let what = if number.is_finite() {
            format!("{} is out of range", shown(number))
        } else {
            format!("{number} is not a finite number")
        };
        let help = format!("allowed: {}", range.describe(self.key.unit));
        found.add(self.span(), &*self.path, what, help);
        None
    }

    /// The members of a list.
    pub(super) fn members(&self, expected: &str, found: &mut Mistakes) -> Option<Vec<Value<'a>>> {
        let Some(array) = self.toml.get_ref().as_array() else {
            self.wrong_kind(expected, found);
            return None;
        };
        let members = array.iter().enumerate().map(|(i, member)| Value {
            toml: member,
            path: place::member(&self.path, i),
            key: self.key,
        });
        Some(members.collect())
    }

    /// The members of a list of lists. The first member of another kind speaks for all: what is
    /// missing is one pair of brackets.
    pub(super) fn lists(&self, each: &str, found: &mut Mistakes) -> Option<Vec<Value<'a>>> {
        let members = self.members(self.key.holds.expected(), found)?;
        let other = members.iter().find(|it| !it.toml.get_ref().is_array());
        if let Some(member) = other {
            member.wrong_kind(each, found);
            return None;
        }
        Some(members)
    }

    /// A list of numbers in a range.
    pub(super) fn numbers(&self, range: &Range, found: &mut Mistakes) -> Option<Vec<f64>> {
        let members = self.members(self.key.holds.expected(), found)?;
        // Every member is looked at, also after a wrong one.
        let numbers: Vec<_> = members.iter().map(|x| x.number(range, found)).collect();
        numbers.into_iter().collect()
    }

    /// Three numbers in a range.
    pub(super) fn vector(&self, range: &Range, found: &mut Mistakes) -> Option<[f64; 3]> {
        let members = self.members("a list of three numbers", found)?;
        if members.len() != 3 {
            found.add(
                self.span(),
                &*self.path,
                format!(
                    "expected three numbers, x, y and z; found {}",
                    members.len()
                ),
                self.key.write_example(),
            );
            return None;
        }
        let numbers = self.numbers(range, found)?;
        numbers.try_into().ok()
    }

    /// One or more points.
    pub(super) fn points(&self, range: &Range, found: &mut Mistakes) -> Option<Vec<[f64; 3]>> {
        let members = self.lists("a list of three numbers", found)?;
        if members.is_empty() {
            found.add(
                self.span(),
                &*self.path,
                "the list is empty",
                format!("give at least one point: {}", self.key.write_example()),
            );
            return None;
        }
        let points: Vec<_> = members.iter().map(|x| x.vector(range, found)).collect();
        points.into_iter().collect()
    }
}

/// Precision beyond 2^53 does not matter: no range reaches so far.
fn integer_as_number(integer: &DeInteger) -> f64 {
    i128::from_str_radix(integer.as_str(), integer.radix())
        .map_or(f64::INFINITY, |number| number as f64)
}

/// A value as messages name it.
pub(super) fn described(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => format!("the text {}", quoted(text)),
        DeValue::Integer(integer) => format!("the number {}", shortened(integer.as_str())),
        DeValue::Float(float) => format!("the number {}", shortened(float.as_str())),
        DeValue::Boolean(boolean) => boolean.to_string(),
        DeValue::Datetime(_) => "a date or time".to_owned(),
        DeValue::Array(array) => format!("a list of {}", array.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// A number as messages show it: short, however great or small.
pub(super) fn shown(number: f64) -> String {
    let digits = format!("{number:?}");
    digits
        .strip_suffix(".0")
        .map_or(digits.clone(), str::to_owned)
}

fn shortened(number: &str) -> String {
    number.chars().take(24).collect()
}
