//! Scenarios, the run loop and the log.
pub mod arm;
pub mod scenario;
pub mod servo;
pub mod summary;
