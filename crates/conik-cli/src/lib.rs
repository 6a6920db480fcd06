//! What the command `conik` shows of a run: its figures and its report.
pub mod figure;
pub mod report;
