//! The ten types that an RTDE field may have, and values of them.

use super::WireError;
use std::fmt;

/// The type of a field, as the controller names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // Each is the type of the same name in the protocol.
pub enum FieldType {
    Bool,
    Uint8,
    Uint32,
    Uint64,
    Int32,
    Double,
    Vector3d,
    Vector6d,
    Vector6Int32,
    Vector6Uint32,
}

impl FieldType {
    /// Every type.
    pub const ALL: [Self; 10] = [
        Self::Bool,
        Self::Uint8,
        Self::Uint32,
        Self::Uint64,
        Self::Int32,
        Self::Double,
        Self::Vector3d,
        Self::Vector6d,
        Self::Vector6Int32,
        Self::Vector6Uint32,
    ];

    /// The name in a recipe.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bool => "BOOL",
            Self::Uint8 => "UINT8",
            Self::Uint32 => "UINT32",
            Self::Uint64 => "UINT64",
            Self::Int32 => "INT32",
            Self::Double => "DOUBLE",
            Self::Vector3d => "VECTOR3D",
            Self::Vector6d => "VECTOR6D",
            Self::Vector6Int32 => "VECTOR6INT32",
            Self::Vector6Uint32 => "VECTOR6UINT32",
        }
    }

    /// The type of this name.
    pub fn from_name(name: &str) -> Result<Self, WireError> {
        Self::ALL
            .into_iter()
            .find(|field_type| field_type.name() == name)
            .ok_or_else(|| WireError::UnknownFieldType(name.to_owned()))
    }

    /// Bytes of a value on the wire.
    pub fn size(self) -> usize {
        match self {
            Self::Bool | Self::Uint8 => 1,
            Self::Uint32 | Self::Int32 => 4,
            Self::Uint64 | Self::Double => 8,
            Self::Vector3d | Self::Vector6Int32 | Self::Vector6Uint32 => 24,
            Self::Vector6d => 48,
        }
    }
}

impl fmt::Display for FieldType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The value of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // As in `FieldType`.
pub enum Value {
    Bool(bool),
    Uint8(u8),
    Uint32(u32),
    Uint64(u64),
    Int32(i32),
    Double(f64),
    Vector3d([f64; 3]),
    Vector6d([f64; 6]),
    Vector6Int32([i32; 6]),
    Vector6Uint32([u32; 6]),
}

impl Value {
    /// The type that this is a value of.
    pub fn field_type(&self) -> FieldType {
        match self {
            Self::Bool(_) => FieldType::Bool,
            Self::Uint8(_) => FieldType::Uint8,
            Self::Uint32(_) => FieldType::Uint32,
            Self::Uint64(_) => FieldType::Uint64,
            Self::Int32(_) => FieldType::Int32,
            Self::Double(_) => FieldType::Double,
            Self::Vector3d(_) => FieldType::Vector3d,
            Self::Vector6d(_) => FieldType::Vector6d,
            Self::Vector6Int32(_) => FieldType::Vector6Int32,
            Self::Vector6Uint32(_) => FieldType::Vector6Uint32,
        }
    }

    /// Whether every number in it is finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Double(value) => value.is_finite(),
            Self::Vector3d(values) => values.iter().all(|value| value.is_finite()),
            Self::Vector6d(values) => values.iter().all(|value| value.is_finite()),
            _ => true,
        }
    }

    /// Appends the value's bytes.
    fn write(&self, bytes: &mut Vec<u8>) {
        match self {
            Self::Bool(value) => bytes.push(u8::from(*value)),
            Self::Uint8(value) => bytes.push(*value),
            Self::Uint32(value) => bytes.extend(value.to_be_bytes()),
            Self::Uint64(value) => bytes.extend(value.to_be_bytes()),
            Self::Int32(value) => bytes.extend(value.to_be_bytes()),
            Self::Double(value) => bytes.extend(value.to_be_bytes()),
            Self::Vector3d(values) => bytes.extend(values.iter().flat_map(|v| v.to_be_bytes())),
            Self::Vector6d(values) => bytes.extend(values.iter().flat_map(|v| v.to_be_bytes())),
            Self::Vector6Int32(values) => bytes.extend(values.iter().flat_map(|v| v.to_be_bytes())),
            Self::Vector6Uint32(values) => {
                bytes.extend(values.iter().flat_map(|v| v.to_be_bytes()));
            }
        }
    }

    /// Takes a value of this type off the front of `bytes`; `None` if they are too few.
    fn take(field_type: FieldType, bytes: &mut &[u8]) -> Option<Self> {
        Some(match field_type {
            FieldType::Bool => Self::Bool(take::<1>(bytes)? != [0]),
            FieldType::Uint8 => Self::Uint8(u8::from_be_bytes(take(bytes)?)),
            FieldType::Uint32 => Self::Uint32(u32::from_be_bytes(take(bytes)?)),
            FieldType::Uint64 => Self::Uint64(u64::from_be_bytes(take(bytes)?)),
            FieldType::Int32 => Self::Int32(i32::from_be_bytes(take(bytes)?)),
            FieldType::Double => Self::Double(f64::from_be_bytes(take(bytes)?)),
            FieldType::Vector3d => Self::Vector3d(take_all(bytes, f64::from_be_bytes)?),
            FieldType::Vector6d => Self::Vector6d(take_all(bytes, f64::from_be_bytes)?),
            FieldType::Vector6Int32 => Self::Vector6Int32(take_all(bytes, i32::from_be_bytes)?),
            FieldType::Vector6Uint32 => Self::Vector6Uint32(take_all(bytes, u32::from_be_bytes)?),
        })
    }
}

/// Takes `N` bytes off the front; `None` if they are too few.
fn take<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (front, rest) = bytes.split_first_chunk::<N>()?;
    *bytes = rest;
    Some(*front)
}

fn take_all<T: Copy + Default, const COUNT: usize, const SIZE: usize>(
    bytes: &mut &[u8],
    from_bytes: fn([u8; SIZE]) -> T,
) -> Option<[T; COUNT]> {
    let mut values = [T::default(); COUNT];
    for value in &mut values {
        *value = from_bytes(take(bytes)?);
    }
    Some(values)
}

/// The bytes of a recipe's values, in the recipe's order.
///
/// Refuses a value of another type than the recipe's and any number that is not finite: a `NaN`
/// must never reach a robot, in no field.
pub fn encode(types: &[FieldType], values: &[Value]) -> Result<Vec<u8>, WireError> {
    if types.len() != values.len() {
        return Err(WireError::WrongCount {
            need: types.len(),
            have: values.len(),
        });
    }
    let mut bytes = Vec::with_capacity(types.iter().map(|field_type| field_type.size()).sum());
    for (field, (need, value)) in types.iter().zip(values).enumerate() {
        let have = value.field_type();
        if have != *need {
            return Err(WireError::WrongType {
                field,
                need: *need,
                have,
            });
        }
        if !value.is_finite() {
            return Err(WireError::NotFinite { field });
        }
        value.write(&mut bytes);
    }
    Ok(bytes)
}

/// The values of a recipe from their bytes, which must be neither too few nor too many.
pub fn decode(types: &[FieldType], mut bytes: &[u8]) -> Result<Vec<Value>, WireError> {
    let package = "data";
    let have = bytes.len();
    let values = types
        .iter()
        .map(|field_type| Value::take(*field_type, &mut bytes))
        .collect::<Option<Vec<_>>>()
        .ok_or_else(|| WireError::TooShort {
            package,
            need: types.iter().map(|field_type| field_type.size()).sum(),
            have,
        })?;
    if !bytes.is_empty() {
        return Err(WireError::TooLong {
            package,
            surplus: bytes.len(),
        });
    }
    Ok(values)
}
