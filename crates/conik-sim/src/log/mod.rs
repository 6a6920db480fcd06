//! The log of a run, `log.csv`: one row a tick.

pub mod read;
