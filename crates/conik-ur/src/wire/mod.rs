//! The wire format of RTDE (Real-Time Data Exchange), version 2: bytes to packages and back.
//!
//! Only the format lives here: nothing in this folder opens a socket, keeps a state or knows which
//! package answers which. All numbers are big-endian. No input makes it panic, and no number that
//! is not finite is ever written.
//!
//! | file | what it holds |
//! |---|---|
//! | `frame` | packages cut out of a byte stream, however it is segmented |
//! | `package` | what a client and a controller say to each other |
//! | `text` | messages for people, which either side may send |
//! | `recipe` | lists of field names and of their types |
//! | `value` | the ten field types and their values |

mod contents;
pub mod frame;
pub mod package;
pub mod recipe;
mod text;
pub mod value;

pub use frame::{Frame, FrameReader};
pub use package::{ControllerVersion, Reply, Request};
pub use recipe::FieldReply;
pub use text::{TextLevel, TextMessage};
pub use value::{FieldType, Value};

/// The protocol version spoken here.
pub const PROTOCOL_VERSION: u16 = 2;

/// Bytes that are no RTDE package, or values that must not become one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WireError {
    /// The size in a header is smaller than the header: the stream can no longer be cut.
    #[error("a package header announces {0} bytes, less than the header's own 3: framing is lost")]
    Framing(u16),
    /// No package of this type exists in this direction.
    #[error("unknown package type {0}")]
    UnknownType(u8),
    /// A package ends before its contents do.
    #[error("the {package} package is too short: {have} bytes where {need} are needed")]
    TooShort {
        /// Which package.
        package: &'static str,
        /// Bytes that were needed.
        need: usize,
        /// Bytes that were there.
        have: usize,
    },
    /// A package goes on after its contents have ended.
    #[error("the {package} package has {surplus} bytes too many")]
    TooLong {
        /// Which package.
        package: &'static str,
        /// Bytes left over.
        surplus: usize,
    },
    /// A list of names or types is not plain text.
    #[error("the {0} package holds text that is not UTF-8")]
    NotText(&'static str),
    /// A type name that RTDE does not have.
    #[error("unknown field type '{0}'")]
    UnknownFieldType(String),
    /// A number that is not finite.
    #[error("field {field} is not a finite number; nothing was encoded")]
    NotFinite {
        /// 0-based place of the field in its recipe.
        field: usize,
    },
    /// A value of another type than the recipe says.
    #[error("field {field} is {have} where the recipe says {need}")]
    WrongType {
        /// 0-based place of the field in its recipe.
        field: usize,
        /// Type in the recipe.
        need: FieldType,
        /// Type of the value.
        have: FieldType,
    },
    /// Another number of values than the recipe has fields.
    #[error("{have} values for a recipe of {need} fields")]
    WrongCount {
        /// Fields in the recipe.
        need: usize,
        /// Values given.
        have: usize,
    },
    /// Contents too long for the 16-bit size of a package, or the 8-bit size of a text.
    #[error("{size} bytes do not fit into {limit}")]
    Oversize {
        /// Bytes to be written.
        size: usize,
        /// Most that fit.
        limit: usize,
    },
}
