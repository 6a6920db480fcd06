//! Scenarios, the run loop and the log.
pub mod arm;
pub mod log;
pub mod scenario;
pub mod summary;
