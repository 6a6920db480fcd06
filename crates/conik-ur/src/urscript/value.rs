//! Values of a running program, and what operators make of them.
//!
//! An integer has 32 bits, and the quotient of two integers is a float, as the maker's own programs
//! rely on. A result that does not fit or is not finite is a fault, so that every number is finite.

use super::error::Fault;
use super::syntax::{Binary, Unary};
use std::fmt;
use std::sync::Arc;

/// Elements of a list.
pub(super) const MOST_ELEMENTS: usize = 256;

/// Bytes of a text.
pub(super) const MOST_TEXT: usize = 1024;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// None: what a function without `return` gives, an argument left out, a variable at first.
    Nothing,
    Boolean(bool),
    Integer(i32),
    Float(f64),
    Text(Arc<str>),
    /// Shared until an element is assigned: assignment copies.
    List(Arc<Vec<Value>>),
    Pose([f64; 6]),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => f.write_str("nothing"),
            Self::Boolean(true) => f.write_str("True"),
            Self::Boolean(false) => f.write_str("False"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Float(value) => write!(f, "{value:?}"),
            Self::Text(text) => f.write_str(text),
            Self::List(elements) => {
                let elements: Vec<String> = elements.iter().map(Self::to_string).collect();
                write!(f, "[{}]", elements.join(", "))
            }
            Self::Pose(numbers) => {
                let numbers = numbers.map(|number| format!("{number:?}"));
                write!(f, "p[{}]", numbers.join(", "))
            }
        }
    }
}

impl Value {
    /// A float, if it is finite; `of` says what made it.
    pub(super) fn float(value: f64, of: &str) -> Result<Self, Fault> {
        let is_finite = value.is_finite();
        is_finite
            .then_some(Self::Float(value))
            .ok_or_else(|| Fault::Result(of.to_owned()))
    }

    /// A list of six floats.
    pub(super) fn six(values: [f64; 6]) -> Self {
        Self::List(Arc::new(values.map(Self::Float).to_vec()))
    }

    /// What the language calls its type.
    pub(super) fn type_name(&self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Boolean(_) => "a boolean",
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a float",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Pose(_) => "a pose",
        }
    }

    /// The fault of finding this where another type is needed.
    pub(super) fn is_not(&self, wanted: &'static str, place: impl Into<String>) -> Fault {
        Fault::Type {
            place: place.into(),
            wanted,
            found: self.type_name(),
        }
    }

    /// An integer or a float as a float.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(value) => Some(f64::from(*value)),
            Self::Float(value) => Some(*value),
            _ => None,
        }
    }

    /// Six numbers, from a list.
    pub(super) fn six_numbers(&self) -> Option<[f64; 6]> {
        let Self::List(elements) = self else {
            return None;
        };
        let numbers: Option<Vec<f64>> = elements.iter().map(Self::number).collect();
        numbers?.try_into().ok()
    }

    /// A list of these.
    pub(super) fn list(elements: Vec<Self>) -> Result<Self, Fault> {
        if elements.len() > MOST_ELEMENTS {
            return Err(Fault::TooMuch {
                what: "a list's length",
                most: MOST_ELEMENTS,
            });
        }
        if let Some(list) = elements
            .iter()
            .find(|element| matches!(element, Self::List(_)))
        {
            return Err(list.is_not("no list itself", "an element of a list"));
        }
        Ok(Self::List(Arc::new(elements)))
    }

    /// The element at an index.
    pub(super) fn element(&self, index: &Self) -> Result<Self, Fault> {
        match self {
            Self::List(elements) => {
                let place = place(index, elements.len())?;
                Ok(elements[place].clone())
            }
            Self::Pose(numbers) => Ok(Self::Float(numbers[place(index, numbers.len())?])),
            other => Err(other.is_not("a list or a pose", "what has elements")),
        }
    }

    /// Changes the element at an index.
    pub(super) fn set_element(&mut self, index: &Self, value: Self) -> Result<(), Fault> {
        match self {
            Self::List(elements) => {
                if let Self::List(_) = value {
                    return Err(value.is_not("no list itself", "an element of a list"));
                }
                let place = place(index, elements.len())?;
                Arc::make_mut(elements)[place] = value;
            }
            Self::Pose(numbers) => {
                let place = place(index, numbers.len())?;
                let number = value.number();
                numbers[place] =
                    number.ok_or_else(|| value.is_not("a number", "a pose's element"))?;
            }
            other => return Err(other.is_not("a list or a pose", "what has elements")),
        }
        Ok(())
    }
}

fn place(index: &Value, length: usize) -> Result<usize, Fault> {
    let Value::Integer(index) = *index else {
        return Err(index.is_not("an integer", "an index"));
    };
    let place = usize::try_from(index).ok().filter(|place| *place < length);
    place.ok_or(Fault::Index { index, length })
}

/// The value of an operator with one operand.
pub(super) fn unary(operator: Unary, operand: Value) -> Result<Value, Fault> {
    match (operator, operand) {
        (Unary::Not, Value::Boolean(value)) => Ok(Value::Boolean(!value)),
        (Unary::Not, other) => Err(other.is_not("a boolean", "the operand of 'not'")),
        (Unary::Plus, value @ (Value::Integer(_) | Value::Float(_))) => Ok(value),
        (Unary::Minus, Value::Float(value)) => Ok(Value::Float(-value)),
        (Unary::Minus, Value::Integer(value)) => value
            .checked_neg()
            .map(Value::Integer)
            .ok_or_else(|| Fault::Result("'-'".to_owned())),
        (_, other) => Err(other.is_not("a number", "the operand of a sign")),
    }
}

/// The value of an operator with two operands.
pub(super) fn binary(operator: Binary, left: &Value, right: &Value) -> Result<Value, Fault> {
    match operator {
        Binary::Or | Binary::Xor | Binary::And => logic(operator, left, right),
        Binary::Equal => Ok(Value::Boolean(equal(left, right)?)),
        Binary::NotEqual => Ok(Value::Boolean(!equal(left, right)?)),
        Binary::Less | Binary::LessOrEqual | Binary::Greater | Binary::GreaterOrEqual => {
            let (left, right) = numbers(operator, left, right)?;
            Ok(Value::Boolean(match operator {
                Binary::Less => left < right,
                Binary::LessOrEqual => left <= right,
                Binary::Greater => left > right,
                _ => left >= right,
            }))
        }
        _ => arithmetic(operator, left, right),
    }
}

fn logic(operator: Binary, left: &Value, right: &Value) -> Result<Value, Fault> {
    let boolean = |value: &Value| match value {
        Value::Boolean(value) => Ok(*value),
        other => Err(operand_is_not(operator, "a boolean", other)),
    };
    let (left, right) = (boolean(left)?, boolean(right)?);
    Ok(Value::Boolean(match operator {
        Binary::Or => left || right,
        Binary::And => left && right,
        _ => left != right,
    }))
}

/// Integers and floats compare by value, everything else with its own type only.
fn equal(left: &Value, right: &Value) -> Result<bool, Fault> {
    if let (Some(left), Some(right)) = (left.number(), right.number()) {
        return Ok(left == right);
    }
    match (left, right) {
        (Value::List(left), Value::List(right)) => {
            for (left, right) in left.iter().zip(right.iter()) {
                if !equal(left, right)? {
                    return Ok(false);
                }
            }
            Ok(left.len() == right.len())
        }
        (left, right) if std::mem::discriminant(left) == std::mem::discriminant(right) => {
            Ok(left == right)
        }
        (left, right) => Err(Fault::Type {
            place: "the right side of a comparison".to_owned(),
            wanted: left.type_name(),
            found: right.type_name(),
        }),
    }
}

fn arithmetic(operator: Binary, left: &Value, right: &Value) -> Result<Value, Fault> {
    let overflow = || Fault::Result(format!("'{}'", operator.word()));
    if let (Value::Integer(left), Value::Integer(right)) = (left, right)
        && operator != Binary::Divide
    {
        let result = match operator {
            Binary::Add => left.checked_add(*right),
            Binary::Subtract => left.checked_sub(*right),
            Binary::Multiply => left.checked_mul(*right),
            _ => left.checked_rem(*right),
        };
        return result.map(Value::Integer).ok_or_else(overflow);
    }
    let (left, right) = numbers(operator, left, right)?;
    let result = match operator {
        Binary::Add => left + right,
        Binary::Subtract => left - right,
        Binary::Multiply => left * right,
        Binary::Divide => left / right,
        _ => left % right,
    };
    let is_finite = result.is_finite();
    is_finite
        .then_some(Value::Float(result))
        .ok_or_else(overflow)
}

fn numbers(operator: Binary, left: &Value, right: &Value) -> Result<(f64, f64), Fault> {
    let number = |value: &Value| {
        let number = value.number();
        number.ok_or_else(|| operand_is_not(operator, "a number", value))
    };
    Ok((number(left)?, number(right)?))
}

fn operand_is_not(operator: Binary, wanted: &'static str, value: &Value) -> Fault {
    value.is_not(wanted, format!("an operand of '{}'", operator.word()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_stay_integers_except_in_quotients() {
        let of =
            |operator, left, right| binary(operator, &Value::Integer(left), &Value::Integer(right));
        assert_eq!(of(Binary::Add, 7, 2), Ok(Value::Integer(9)));
        assert_eq!(of(Binary::Divide, 7, 2), Ok(Value::Float(3.5)));
        assert_eq!(of(Binary::Remainder, 7, 2), Ok(Value::Integer(1)));
        assert_eq!(of(Binary::Equal, 7, 7), Ok(Value::Boolean(true)));
        let with_float = binary(Binary::Multiply, &Value::Integer(7), &Value::Float(0.5));
        assert_eq!(with_float, Ok(Value::Float(3.5)));
    }

    #[test]
    fn no_operator_makes_a_number_that_is_not_finite() {
        let (most, float) = (Value::Integer(i32::MAX), Value::Float(f64::MAX));
        for (operator, left, right) in [
            (Binary::Add, &most, &most),
            (Binary::Multiply, &most, &most),
            (Binary::Multiply, &float, &float),
            (Binary::Divide, &most, &Value::Integer(0)),
            (Binary::Divide, &Value::Float(0.0), &Value::Float(0.0)),
            (Binary::Remainder, &most, &Value::Integer(0)),
            (Binary::Remainder, &float, &Value::Float(0.0)),
        ] {
            let result = binary(operator, left, right);
            assert!(
                matches!(result, Err(Fault::Result(_))),
                "{operator:?}: {result:?}"
            );
        }
    }

    #[test]
    fn assigning_an_element_leaves_copies_as_they_were() {
        let mut list = Value::six([0.0; 6]);
        let copy = list.clone();
        list.set_element(&Value::Integer(5), Value::Float(1.0))
            .unwrap();
        assert_eq!(copy, Value::six([0.0; 6]));
        assert_eq!(list.element(&Value::Integer(5)), Ok(Value::Float(1.0)));
        for index in [-1, 6] {
            let fault = Fault::Index { index, length: 6 };
            assert_eq!(list.element(&Value::Integer(index)), Err(fault));
        }
    }
}
