//! The fields that client and controller have agreed on.

use super::SessionError;
use crate::wire::{ControllerVersion, FieldReply, FieldType, WireError};

/// A recipe as agreed on.
#[derive(Clone, Debug, Default)]
pub(super) struct Recipe {
    /// The controller's number for it.
    pub(super) number: u8,
    /// The type of each field.
    pub(super) types: Vec<FieldType>,
}

impl Recipe {
    /// The recipe, if the controller gives every field with the type expected.
    pub(super) fn agree(
        number: u8,
        fields: &[(String, FieldType)],
        replies: &[FieldReply],
        version: ControllerVersion,
    ) -> Result<Self, SessionError> {
        let refused_as = |refusal: FieldReply| -> Vec<String> {
            let refused = fields.iter().zip(replies);
            refused
                .filter(|(_, reply)| **reply == refusal)
                .map(|((name, _), _)| name.clone())
                .collect()
        };
        let names = refused_as(FieldReply::NotFound);
        if !names.is_empty() {
            return Err(SessionError::NotFound { names, version });
        }
        let names = refused_as(FieldReply::InUse);
        if !names.is_empty() {
            return Err(SessionError::InUse { names });
        }
        if replies.len() != fields.len() {
            return Err(SessionError::Wire(WireError::WrongCount {
                need: fields.len(),
                have: replies.len(),
            }));
        }
        for ((name, need), reply) in fields.iter().zip(replies) {
            if let FieldReply::Type(have) = reply
                && have != need
            {
                return Err(SessionError::WrongType {
                    name: name.clone(),
                    need: *need,
                    have: *have,
                });
            }
        }
        Ok(Self {
            number,
            types: fields.iter().map(|(_, field_type)| *field_type).collect(),
        })
    }
}

/// The names alone.
pub(super) fn names_of(fields: &[(String, FieldType)]) -> Vec<String> {
    fields.iter().map(|(name, _)| name.clone()).collect()
}
