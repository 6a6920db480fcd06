//! The log of a run: `log.csv`, one row a tick.

mod read;
mod write;

pub use read::{Log, LogError};
pub use write::{LogWriteError, LogWriter};
