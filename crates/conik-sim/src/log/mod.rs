//! The log of a run: `log.csv`, one row a tick.

mod error;
mod read;
mod rows;
mod write;

pub use error::LogError;
pub use read::Log;
pub use rows::{LogRows, Row};
pub use write::{LogWriteError, LogWriter};
