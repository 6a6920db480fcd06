//! One tick of a run, as the log keeps it.

use conik::{ActiveSet, JointVec, Landed, Reason, Vec3};

use crate::live::Gliding;

/// One tick: the state at t = k / rate *before* the step, and what was decided there.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// k, from 0.
    pub tick: u64,
    /// Time since the start [s].
    pub t_s: f64,
    /// The active set-based tasks.
    pub active: ActiveSet,
    /// Whether the active set is another than in the tick before. True in the first tick.
    pub mode_changed: bool,
    /// 0-based index of the waypoint in use.
    pub waypoint: usize,
    /// A waypoint that this tick is the first to reach.
    pub reached: Option<usize>,
    /// Value of each scalar task, then norm of the error of each equality task, in list order.
    pub task_values: Vec<f64>,
    /// Position of the tool [m].
    pub tool: Vec3,
    /// Joint references [rad].
    pub q: JointVec,
    /// Joint velocities from here to the next tick [rad/s].
    pub qd: JointVec,
    /// Joint accelerations [rad/s²].
    pub qdd: JointVec,
    /// Measured joint positions [rad].
    pub q_measured: Option<JointVec>,
    /// Why the tick came out as it did.
    pub reasons: Vec<Reason>,
    /// Whether the speed limit of a joint scaled the velocity.
    pub speed_limited: bool,
    /// Whether no mode kept every set, so that the arm stands still.
    pub no_mode: bool,
    /// What it took to land, with border `land`.
    pub landed: Landed,
    /// Pivots of the quadratic programs.
    pub pivots: usize,
    /// Modes of which the velocity was computed, by the rules `paper` and `border`.
    pub modes_evaluated: usize,
    /// Time of the controller's step alone [ns].
    pub step_ns: u64,
    /// Cycles of the arm's clock that went by unanswered before this one.
    pub missed_cycles: u64,
    /// The number of the change of the scenario that was in force; 0 if nobody changed any.
    pub revision: u64,
    /// What was on its way to where a change has put it.
    pub gliding: Vec<Gliding>,
}
