//! Recipes: the fields of a data package, agreed on once per connection.
//!
//! A client asks for names joined by commas; the controller answers with types joined by commas,
//! or in a type's place with the reason why a field cannot be had.

use super::{FieldType, WireError};

/// The most bytes of a list of names.
pub const MAX_NAMES_SIZE: usize = 2048;

/// What the controller says of one field of a recipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldReply {
    /// It exists, with this type.
    Type(FieldType),
    /// This controller has no such field.
    NotFound,
    /// Another client writes this input.
    InUse,
}

impl FieldReply {
    /// The word in the list.
    pub fn name(self) -> &'static str {
        match self {
            Self::Type(field_type) => field_type.name(),
            Self::NotFound => "NOT_FOUND",
            Self::InUse => "IN_USE",
        }
    }

    fn from_name(name: &str) -> Result<Self, WireError> {
        match name {
            "NOT_FOUND" => Ok(Self::NotFound),
            "IN_USE" => Ok(Self::InUse),
            _ => FieldType::from_name(name).map(Self::Type),
        }
    }
}

/// The list of types or refusals as text.
pub(super) fn join_replies(fields: &[FieldReply]) -> String {
    let names: Vec<_> = fields.iter().map(|field| field.name()).collect();
    names.join(",")
}

/// The list of types or refusals from text.
pub(super) fn split_replies(text: &str) -> Result<Vec<FieldReply>, WireError> {
    text.split(',')
        .map(str::trim)
        .filter(|name| !name.is_empty())
        .map(FieldReply::from_name)
        .collect()
}

/// The names in a list. Empty ones are left out: widespread clients end their list with a comma.
pub(super) fn split_names(text: &str) -> Vec<String> {
    text.split(',')
        .map(str::trim)
        .filter(|name| !name.is_empty())
        .map(str::to_owned)
        .collect()
}
