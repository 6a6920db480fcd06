//! What a client and a controller say to each other: the eight package types in both directions.

use super::WireError;
use super::contents::Contents;
use super::frame::Frame;
use super::recipe::{FieldReply, join_replies, split_names, split_replies};
use super::text::TextMessage;
use std::fmt;

const PROTOCOL_VERSION: u8 = b'V';
const CONTROLLER_VERSION: u8 = b'v';
const TEXT: u8 = b'M';
const DATA: u8 = b'U';
const OUTPUTS: u8 = b'O';
const INPUTS: u8 = b'I';
const START: u8 = b'S';
const PAUSE: u8 = b'P';

/// What a client sends.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Speak this version of the protocol.
    ProtocolVersion(u16),
    /// Which version are you?
    ControllerVersion,
    /// A message for the controller's log.
    Text(TextMessage),
    /// Values for the inputs of a recipe.
    Data {
        /// The recipe, as the controller numbered it.
        recipe: u8,
        /// Its values' bytes.
        values: Vec<u8>,
    },
    /// Send these fields, this often [Hz].
    Outputs {
        /// Packages per second.
        frequency_hz: f64,
        /// Fields in the order wanted.
        names: Vec<String>,
    },
    /// These fields will be written.
    Inputs(Vec<String>),
    /// Begin to send outputs.
    Start,
    /// Cease to send outputs.
    Pause,
}

/// What a controller sends.
#[derive(Clone, Debug, PartialEq)]
pub enum Reply {
    /// Whether the version is accepted.
    ProtocolVersion(bool),
    /// The version of the controller's software.
    ControllerVersion(ControllerVersion),
    /// A message for people.
    Text(TextMessage),
    /// Values of the outputs.
    Data {
        /// The recipe, as the controller numbered it.
        recipe: u8,
        /// Its values' bytes.
        values: Vec<u8>,
    },
    /// The types of the outputs asked for.
    Outputs {
        /// The number of the recipe.
        recipe: u8,
        /// One entry per name.
        fields: Vec<FieldReply>,
    },
    /// The types of the inputs announced.
    Inputs {
        /// The number of the recipe.
        recipe: u8,
        /// One entry per name.
        fields: Vec<FieldReply>,
    },
    /// Whether outputs begin.
    Start(bool),
    /// Whether outputs cease.
    Pause(bool),
}

/// Version of a controller's software.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ControllerVersion {
    /// 3: CB3; 5 and above: e-Series and its successors.
    pub major: u32,
    /// Feature release.
    pub minor: u32,
    /// Correction.
    pub bugfix: u32,
    /// Build number.
    pub build: u32,
}

impl fmt::Display for ControllerVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            major,
            minor,
            bugfix,
            build,
        } = self;
        write!(f, "{major}.{minor}.{bugfix}.{build}")
    }
}

impl Request {
    /// The package of this request.
    pub fn to_frame(&self) -> Result<Frame, WireError> {
        let (kind, payload) = match self {
            Self::ProtocolVersion(version) => (PROTOCOL_VERSION, version.to_be_bytes().to_vec()),
            Self::ControllerVersion => (CONTROLLER_VERSION, Vec::new()),
            Self::Text(message) => (TEXT, message.encode()?),
            Self::Data { recipe, values } => (DATA, prefixed(&[*recipe], values)),
            Self::Outputs {
                frequency_hz,
                names,
            } => {
                if !frequency_hz.is_finite() {
                    return Err(WireError::NotFinite { field: 0 });
                }
                let names = names.join(",");
                (
                    OUTPUTS,
                    prefixed(&frequency_hz.to_be_bytes(), names.as_bytes()),
                )
            }
            Self::Inputs(names) => (INPUTS, names.join(",").into_bytes()),
            Self::Start => (START, Vec::new()),
            Self::Pause => (PAUSE, Vec::new()),
        };
        Ok(Frame { kind, payload })
    }

    /// The request in a package that a client sent.
    pub fn from_frame(frame: &Frame) -> Result<Self, WireError> {
        let mut contents = Contents::of(frame);
        match frame.kind {
            PROTOCOL_VERSION => {
                let version = u16::from_be_bytes(contents.take("protocol version")?);
                contents.end("protocol version", Self::ProtocolVersion(version))
            }
            CONTROLLER_VERSION => contents.end("controller version", Self::ControllerVersion),
            TEXT => TextMessage::decode(contents).map(Self::Text),
            DATA => {
                let [recipe] = contents.take("data")?;
                let values = contents.take_rest().to_vec();
                Ok(Self::Data { recipe, values })
            }
            OUTPUTS => Ok(Self::Outputs {
                frequency_hz: f64::from_be_bytes(contents.take("outputs")?),
                names: split_names(contents.text("outputs")?),
            }),
            INPUTS => Ok(Self::Inputs(split_names(contents.text("inputs")?))),
            START => contents.end("start", Self::Start),
            PAUSE => contents.end("pause", Self::Pause),
            kind => Err(WireError::UnknownType(kind)),
        }
    }
}

impl Reply {
    /// The package of this reply.
    pub fn to_frame(&self) -> Result<Frame, WireError> {
        let (kind, payload) = match self {
            Self::ProtocolVersion(accepted) => (PROTOCOL_VERSION, vec![u8::from(*accepted)]),
            Self::ControllerVersion(version) => {
                let numbers = [version.major, version.minor, version.bugfix, version.build];
                let bytes = numbers.iter().flat_map(|number| number.to_be_bytes());
                (CONTROLLER_VERSION, bytes.collect())
            }
            Self::Text(message) => (TEXT, message.encode()?),
            Self::Data { recipe, values } => (DATA, prefixed(&[*recipe], values)),
            Self::Outputs { recipe, fields } => (
                OUTPUTS,
                prefixed(&[*recipe], join_replies(fields).as_bytes()),
            ),
            Self::Inputs { recipe, fields } => (
                INPUTS,
                prefixed(&[*recipe], join_replies(fields).as_bytes()),
            ),
            Self::Start(accepted) => (START, vec![u8::from(*accepted)]),
            Self::Pause(accepted) => (PAUSE, vec![u8::from(*accepted)]),
        };
        Ok(Frame { kind, payload })
    }

    /// The reply in a package that a controller sent.
    pub fn from_frame(frame: &Frame) -> Result<Self, WireError> {
        let mut contents = Contents::of(frame);
        match frame.kind {
            PROTOCOL_VERSION => {
                let accepted = contents.flag("protocol version")?;
                contents.end("protocol version", Self::ProtocolVersion(accepted))
            }
            CONTROLLER_VERSION => {
                let package = "controller version";
                let version = ControllerVersion {
                    major: u32::from_be_bytes(contents.take(package)?),
                    minor: u32::from_be_bytes(contents.take(package)?),
                    bugfix: u32::from_be_bytes(contents.take(package)?),
                    build: u32::from_be_bytes(contents.take(package)?),
                };
                contents.end(package, Self::ControllerVersion(version))
            }
            TEXT => TextMessage::decode(contents).map(Self::Text),
            DATA => {
                let [recipe] = contents.take("data")?;
                let values = contents.take_rest().to_vec();
                Ok(Self::Data { recipe, values })
            }
            OUTPUTS => {
                let [recipe] = contents.take("outputs")?;
                let fields = split_replies(contents.text("outputs")?)?;
                Ok(Self::Outputs { recipe, fields })
            }
            INPUTS => {
                let [recipe] = contents.take("inputs")?;
                let fields = split_replies(contents.text("inputs")?)?;
                Ok(Self::Inputs { recipe, fields })
            }
            START => {
                let accepted = contents.flag("start")?;
                contents.end("start", Self::Start(accepted))
            }
            PAUSE => {
                let accepted = contents.flag("pause")?;
                contents.end("pause", Self::Pause(accepted))
            }
            kind => Err(WireError::UnknownType(kind)),
        }
    }
}

fn prefixed(front: &[u8], rest: &[u8]) -> Vec<u8> {
    [front, rest].concat()
}
