//! What the run loop asks of an arm, whoever drives it: an ideal one, an emulated one, a real one.

use crate::cycle_times::CycleTimes;
use conik::JointVec;

/// A reference for the arm's joint servos, valid for one control period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Joint positions [rad].
    pub q: JointVec,
    /// Joint velocities [rad/s], for extrapolation between references.
    pub qd: JointVec,
    /// Joint accelerations [rad/s²].
    pub qdd: JointVec,
}

/// What an arm says of itself once per cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feedback {
    /// Measured joint positions [rad]; `None` where nothing measures (the ideal arm).
    pub q: Option<JointVec>,
    /// Cycles of the arm's clock that went by unanswered since the previous feedback.
    pub missed_cycles: u64,
}

/// An arm that takes one reference per control period and sets the pace.
///
/// The order of calls is `start`, then `next_cycle` and `send` in turn, then `stop`. After any
/// error only `stop` may follow: an arm that reported a fault takes no further reference.
pub trait Arm {
    /// Makes the arm ready to take references at `rate_hz` and returns the joint positions [rad]
    /// that it holds at that moment. Nothing moves.
    fn start(&mut self, rate_hz: f64) -> Result<JointVec, ArmError>;

    /// Waits for the arm's next cycle.
    fn next_cycle(&mut self) -> Result<Feedback, ArmError>;

    /// Sends the reference of the present cycle.
    fn send(&mut self, reference: &Reference) -> Result<(), ArmError>;

    /// Brings the arm to a stop and takes it out of the control of this program. May be called at
    /// any time, more than once.
    fn stop(&mut self) -> Result<(), ArmError>;

    /// One line that names the arm, for people: `ideal arm`, `emulated UR5 at 127.0.0.1:40001`.
    fn describe(&self) -> String;

    /// Whether time passes on its own (a real arm, or an emulated one in wall time) rather than
    /// as fast as references are computed.
    fn is_real_time(&self) -> bool;

    /// How the cycles since `start` came and were answered, also after `stop`; `None` of an arm that
    /// has no clock of its own.
    fn cycle_times(&self) -> Option<&CycleTimes> {
        None
    }
}

/// A named fault of the arm or of the way to it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}: {detail}")]
pub struct ArmError {
    /// The fault's short name, stable for programs: `link-lost`, `protective-stop`, ...
    pub name: &'static str,
    /// What happened, with figures, and what to do about it.
    pub detail: String,
}

impl ArmError {
    /// A fault with its stable name and a sentence about it.
    pub fn new(name: &'static str, detail: impl Into<String>) -> Self {
        Self {
            name,
            detail: detail.into(),
        }
    }
}

/// An arm that is at its reference at once: no network, no lag, no clock.
#[derive(Clone, Debug)]
pub struct IdealArm {
    q: JointVec,
}

impl IdealArm {
    /// An ideal arm standing at `q` [rad].
    pub fn at(q: JointVec) -> Self {
        Self { q }
    }
}

impl Arm for IdealArm {
    fn start(&mut self, _rate_hz: f64) -> Result<JointVec, ArmError> {
        Ok(self.q)
    }

    fn next_cycle(&mut self) -> Result<Feedback, ArmError> {
        Ok(Feedback {
            q: None,
            missed_cycles: 0,
        })
    }

    fn send(&mut self, reference: &Reference) -> Result<(), ArmError> {
        self.q = reference.q;
        Ok(())
    }

    fn stop(&mut self) -> Result<(), ArmError> {
        Ok(())
    }

    fn describe(&self) -> String {
        "ideal arm (q = q_ref)".to_owned()
    }

    fn is_real_time(&self) -> bool {
        false
    }
}
