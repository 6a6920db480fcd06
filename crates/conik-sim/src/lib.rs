//! Scenarios for conik: what a run is, the loop that runs it on any arm, and the log of it.
//!
//! ```text
//! scenario.toml -> Scenario -> Experiment -> run(.., &mut dyn Arm, ..) -> Record, Record, ... -> log.csv
//!                                                                                     \\-> Summary
//! ```
//!
//! Nothing here knows which arm it drives or how a log is drawn.

pub mod announced;
pub mod arm;
mod between;
pub mod check;
pub mod collision_pairs;
pub mod columns;
pub mod cycle_times;
pub mod experiment;
pub mod histogram;
pub mod joint_limits;
pub mod live;
pub mod log;
mod measured;
pub mod monitors;
pub mod mover;
pub mod named_shapes;
pub mod promise;
pub mod record;
pub mod run;
pub mod scenario;
pub mod servo;
mod servo_delay;
pub mod summarise;
pub mod summary;
pub mod visits;
