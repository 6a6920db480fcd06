//! What can go wrong in a session, and what to do about it.

use crate::wire::{ControllerVersion, FieldType, PROTOCOL_VERSION, WireError};

/// What went wrong in a session.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// The stream broke or fell silent.
    #[error("{0}")]
    Lost(String),
    /// The other side does not speak RTDE as we know it.
    #[error(
        "the other side does not speak RTDE version {PROTOCOL_VERSION}: {0}; is it a UR controller?"
    )]
    Wire(#[from] WireError),
    /// Version 2 of the protocol was refused.
    #[error(
        "the controller refuses RTDE version {PROTOCOL_VERSION}; its software is too old: update \
         to 3.4 or later (CB3)"
    )]
    ProtocolRefused,
    /// An answer of another kind than the question.
    #[error("the controller answered out of order while '{0}' was awaited")]
    OutOfOrder(&'static str),
    /// The controller lacks fields.
    #[error("controller {version} has no field {}; its software is too old: update it", names.join(", "))]
    NotFound {
        /// The fields.
        names: Vec<String>,
        /// The controller's version.
        version: ControllerVersion,
    },
    /// Someone else writes these inputs.
    #[error(
        "another client or a fieldbus (EtherNet/IP, PROFINET) holds {}: end the other client, \
         switch the fieldbus off, or use registers 24 to 47; a connection that has died may hold \
         them until the controller notices",
        names.join(", ")
    )]
    InUse {
        /// The inputs.
        names: Vec<String>,
    },
    /// A field exists with another type.
    #[error("field {name} is {have}, not {need}")]
    WrongType {
        /// The field.
        name: String,
        /// The type that was expected.
        need: FieldType,
        /// The type that it has.
        have: FieldType,
    },
    /// The controller did not begin to send.
    #[error("the controller refuses to start sending")]
    StartRefused,
}

impl SessionError {
    /// What it means if not even the first question was answered.
    pub(super) fn at_first_word(self) -> Self {
        match self {
            Self::Lost(cause) => Self::Lost(format!(
                "{cause}; is it a UR controller, and this its RTDE port?"
            )),
            other => other,
        }
    }
}
