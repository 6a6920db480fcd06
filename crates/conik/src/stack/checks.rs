//! What a stack refuses, and why.

use alloc::string::{String, ToString};

use super::BoundRates;
use crate::active::MAX_TASKS;
use crate::cone::Interval;
use crate::joints::MAX_JOINTS;

/// Why a task cannot stand in the stack, or a setpoint cannot be taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("task `{task}`: {reason}")]
pub struct StackError {
    /// Name of the task.
    pub task: String,
    /// What is wrong.
    pub reason: StackErrorReason,
}

/// What is wrong with a task or a setpoint.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StackErrorReason {
    /// Another task has the name.
    #[error("the name is taken")]
    NameTaken,
    /// [`MAX_TASKS`] are there already.
    #[error("a stack holds at most {MAX_TASKS} tasks")]
    TooManyTasks,
    /// The task does not fit the robot, or its parameters are unusable.
    #[error("{0}")]
    Unfit(&'static str),
    /// A desired value of the wrong length.
    #[error("{expected} values expected, {found} found")]
    WrongDimension {
        /// Components of the task.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// A task without components, or with more than [`MAX_JOINTS`].
    #[error("a task has 1 to {MAX_JOINTS} components, this one has {0}")]
    BadDimension(usize),
    /// A set-based task of more than one component.
    #[error("a set-based task must have one component, this one has {0}")]
    NotScalar(usize),
    /// NaN, two infinite bounds, or bounds in the wrong order.
    #[error("the allowed values [{}, {}] are not an interval", .0.min, .0.max)]
    BadInterval(Interval),
    /// A desired value, or a rate, that is not finite.
    #[error("the desired value and all rates must be finite")]
    NotFinite,
    /// A gain that is not a positive number.
    #[error("the gain must be a positive number [1/s], not {0}")]
    BadGain(f64),
    /// A speed of recovery that is not a positive number.
    #[error("the speed of recovery must be a positive number [unit/s], not {0}")]
    BadSpeed(f64),
    /// A damping that is negative or not finite.
    #[error("the damping must be a finite number, at least 0 [unit/rad], not {0}")]
    BadDamping(f64),
    /// A low-priority set without a gain.
    #[error("a set-based task below an equality task needs a gain [1/s]")]
    MissingGain,
    /// An equality setpoint for a set-based task, or the reverse.
    #[error("it is not that kind of task")]
    WrongKind,
}

pub(super) fn error(task: &str, reason: StackErrorReason) -> StackError {
    StackError {
        task: task.to_string(),
        reason,
    }
}

pub(super) fn check_desired(dimension: usize, desired: &[f64]) -> Result<(), StackErrorReason> {
    if desired.len() != dimension {
        return Err(StackErrorReason::WrongDimension {
            expected: dimension,
            found: desired.len(),
        });
    }
    if desired.iter().all(|value| value.is_finite()) {
        Ok(())
    } else {
        Err(StackErrorReason::NotFinite)
    }
}

pub(super) fn check_set(dimension: usize, interval: Interval) -> Result<(), StackErrorReason> {
    if dimension != 1 {
        Err(StackErrorReason::NotScalar(dimension))
    } else if !interval.is_valid() {
        Err(StackErrorReason::BadInterval(interval))
    } else {
        Ok(())
    }
}

pub(super) fn check_rates(rates: BoundRates) -> Result<(), StackErrorReason> {
    if rates.min.is_finite() && rates.max.is_finite() {
        Ok(())
    } else {
        Err(StackErrorReason::NotFinite)
    }
}

pub(super) fn check_speed(speed: f64) -> Result<(), StackErrorReason> {
    if speed > 0.0 && speed.is_finite() {
        Ok(())
    } else {
        Err(StackErrorReason::BadSpeed(speed))
    }
}

pub(super) fn check_gain(gain: f64) -> Result<(), StackErrorReason> {
    if gain > 0.0 && gain.is_finite() {
        Ok(())
    } else {
        Err(StackErrorReason::BadGain(gain))
    }
}

pub(super) fn check_dimension(dimension: usize) -> Result<(), StackErrorReason> {
    if (1..=MAX_JOINTS).contains(&dimension) {
        Ok(())
    } else {
        Err(StackErrorReason::BadDimension(dimension))
    }
}
