//! What is kept of one run.

use serde::{Deserialize, Serialize};

use crate::class::Class;

/// One run: a row of `runs.parquet`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of the run, from 0.
    pub run: u64,
    /// Joint positions at the start [rad or m].
    pub q0: Vec<f64>,
    /// Control rate [Hz].
    pub rate_hz: f64,
    /// How far the arm lagged behind its reference [s].
    pub servo_lag_s: Option<f64>,
    /// `completed`, or the name of a fault.
    pub outcome: String,
    /// When it was over [s].
    pub ended_at_s: f64,
    /// How many waypoints were reached, and when the last one was [s].
    pub waypoints_reached: u64,
    /// When the last waypoint was reached [s]; `None`: it was not, or there is none.
    pub arrived_s: Option<f64>,
    /// How often the mode changed.
    pub mode_changes: u64,
    /// The worst of each set: how far outside [task's unit] it was after it was inside, or at all if it never was.
    pub violations: Vec<f64>,
    /// Error of each equality task at the end [task's unit].
    pub errors: Vec<f64>,
    /// The same of the arm that lags: the worst of each set where the arm was [task's unit].
    pub measured_violations: Option<Vec<f64>>,
    /// Whether each of the five properties was kept; `None`: there was nothing that could show it.
    pub kept: [Option<bool>; 5],
    /// Its worst deviation [task's unit].
    pub worst: [f64; 5],
    /// What kind of failure it was, if any.
    pub class: Class,
}
