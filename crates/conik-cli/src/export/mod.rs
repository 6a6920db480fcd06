//! A run in the formats of other programs: MCAP for Foxglove and its like, Parquet for tables.
//!
//! A [`Source`] is the run folder. [`recording`] tells its log again as messages: `channels` is the file
//! and its topics, `teller` and `events` tell what happens, `frames`, `arm`, `scene` and `path` what is
//! seen, and `types` and `protobuf` are how messages are written. [`table`] has the log as it is. Both read the log row by row, so
//! that memory does not grow with it, and the same run gives the same bytes.

mod arm;
mod channels;
mod error;
mod events;
mod frames;
mod path;
mod primitive;
mod protobuf;
pub mod recording;
mod region;
mod scene;
mod schema;
mod source;
pub mod table;
mod teller;
mod types;

pub use error::ExportError;
pub use source::{Source, Watch};

/// Version of the program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What became of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exported {
    /// Rows of the log.
    pub rows: u64,
    /// Whether the log's last line was cut off and therefore left out.
    pub is_truncated: bool,
}
