//! What one tick of the controller decided, and why.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::joints::JointVec;
use crate::landing::Landed;
use crate::limits::{Exceeded, Shortened};
use crate::real::sqrt;
use crate::reason::Reason;
use crate::stack::Stack;
use crate::task_id::TaskId;
use crate::task_vectors::TaskVectors;

/// One tick: the mode chosen at q, and the reference that follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The active set-based tasks.
    pub active: ActiveSet,
    /// Joint velocity q̇_ref [rad/s or m/s], within the speed limits.
    pub qd: JointVec,
    /// Joint acceleration q̈_ref [rad/s² or m/s²]: the change of q̇_ref since the last tick.
    pub qdd: JointVec,
    /// Joint positions q_ref = q + T q̇_ref [rad or m], for the end of this period.
    pub q_ref: JointVec,
    /// The joint for whose speed limit the whole velocity was shortened, or with rule `Cone` and limited
    /// accelerations that of a level; `None` if none was.
    pub speed_limit: Option<Shortened>,
    /// The joint for whose acceleration limit a change of velocity was shortened: with rule `Cone` that of a
    /// level, else the whole.
    pub acceleration_limit: Option<Shortened>,
    /// The joint whose acceleration is furthest beyond its limit, for the sake of a set.
    pub acceleration_exceeded: Option<Exceeded>,
    /// Whether the exclusions left no mode that keeps every set. The arm then stands still.
    pub no_mode: bool,
    /// Number of modes whose velocity was computed, by the rules `Paper` and `Border`.
    pub modes_evaluated: usize,
    /// Number of pivots of the quadratic programs, by the rule `Cone` and border `Land`.
    pub pivots: usize,
    /// What it took to land, with border `Land`.
    pub landed: Landed,
    pub(crate) reasons: Vec<Reason>,
    pub(crate) values: TaskVectors,
    pub(crate) errors: TaskVectors,
    /// Sets whose values the tick had no need of.
    pub(crate) unmeasured: ActiveSet,
}

/// Kinds of reasons that are not about a task or a joint's acceleration.
const REASONS_OF_THE_WHOLE: usize = 9;

impl Step {
    pub(crate) fn at_rest(stack: &Stack) -> Self {
        let still = JointVec::zeros(stack.dof());
        Self {
            active: ActiveSet::EMPTY,
            qd: still,
            qdd: still,
            q_ref: still,
            speed_limit: None,
            acceleration_limit: None,
            acceleration_exceeded: None,
            no_mode: false,
            modes_evaluated: 0,
            pivots: 0,
            landed: Landed::default(),
            reasons: Vec::with_capacity(2 * stack.len() + stack.dof() + REASONS_OF_THE_WHOLE),
            values: TaskVectors::zeros(stack),
            errors: TaskVectors::zeros(stack),
            unmeasured: ActiveSet::EMPTY,
        }
    }

    /// Why this tick came out as it did.
    pub fn reasons(&self) -> &[Reason] {
        &self.reasons
    }

    /// Adds the reasons that stand in the other fields.
    pub(crate) fn explain_motion(&mut self) {
        let landed = self.landed;
        if let Some(shortened) = self.speed_limit {
            self.add_reason(Reason::SpeedLimit(shortened));
        }
        if let Some(shortened) = self.acceleration_limit {
            self.add_reason(Reason::AccelerationLimit(shortened));
        }
        if landed.corrections > 0 {
            self.add_reason(Reason::Corrected(landed.corrections));
        }
        if landed.halvings > 0 {
            self.add_reason(Reason::Halved(landed.halvings));
        }
        if let Some(share) = landed.cautious {
            self.add_reason(Reason::Cautious(share));
        }
        if landed.stood_still {
            self.add_reason(Reason::StandsStill);
        }
        if let Some(outside) = landed.outside {
            self.add_reason(Reason::GoesOutside(outside));
        }
    }

    /// Adds a reason. There is room for one of each kind for the whole arm and two for each task; what
    /// exceeds it is lost rather than allocated for.
    pub(crate) fn add_reason(&mut self, reason: Reason) {
        if self.reasons.len() < self.reasons.capacity() {
            self.reasons.push(reason);
        }
    }

    /// σ of a task at q [task's unit], one entry per component.
    ///
    /// NaN for a set that the tick had no need to measure, which is only so where the controller [was told
    /// to](crate::Controller::measure_on_demand); [`Controller::measure`](crate::Controller::measure) has it.
    pub fn value(&self, task: TaskId) -> &[f64] {
        if self.unmeasured.contains(task) {
            return &[f64::NAN];
        }
        self.values.of(task)
    }

    /// σ̃ of an equality task at q [task's unit], one entry per component; zeros for a set.
    pub fn error(&self, task: TaskId) -> &[f64] {
        self.errors.of(task)
    }

    /// Euclidean norm of the error of an equality task at q [task's unit].
    pub fn error_norm(&self, task: TaskId) -> f64 {
        sqrt(self.error(task).iter().map(|e| e * e).sum())
    }
}
