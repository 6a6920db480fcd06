//! The log of a run: `log.csv`, one row a tick.

mod write;

pub use write::{LogWriteError, LogWriter};
