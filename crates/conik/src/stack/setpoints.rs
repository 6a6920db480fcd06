//! What may change between two ticks: desired values, allowed values, the tasks' own parameters.

use core::any::Any;

use super::checks::{check_desired, check_rates, check_set, check_speed, error};
use super::{BoundRates, Goal, Stack, StackError, StackErrorReason};
use crate::cone::Interval;
use crate::damping::Damping;
use crate::task::Task;
use crate::task_id::TaskId;

/// The part of a [`Stack`] that may change between any two ticks.
#[derive(Debug)]
pub struct Setpoints<'a> {
    pub(super) stack: &'a mut Stack,
}

impl Setpoints<'_> {
    /// Sets the desired value of an equality task, at rest.
    pub fn set_desired(&mut self, task: TaskId, desired: &[f64]) -> Result<(), StackError> {
        self.change(task, |level_goal, dimension| {
            check_desired(dimension, desired)?;
            level_goal.set_desired(desired, None)
        })
    }

    /// Sets the desired value of an equality task and the rate [unit/s] at which it moves.
    pub fn set_desired_moving(
        &mut self,
        task: TaskId,
        desired: &[f64],
        rate: &[f64],
    ) -> Result<(), StackError> {
        self.change(task, |level_goal, dimension| {
            check_desired(dimension, desired)?;
            check_desired(dimension, rate)?;
            level_goal.set_desired(desired, Some(rate))
        })
    }

    /// Sets the allowed values of a set-based task, at rest.
    pub fn set_interval(
        &mut self,
        task: TaskId,
        new_interval: impl Into<Interval>,
    ) -> Result<(), StackError> {
        self.set_interval_moving(task, new_interval, BoundRates::default())
    }

    /// Sets the allowed values of a set-based task and the rates at which its bounds move.
    pub fn set_interval_moving(
        &mut self,
        task: TaskId,
        new_interval: impl Into<Interval>,
        new_rates: BoundRates,
    ) -> Result<(), StackError> {
        let new_interval = new_interval.into();
        self.stack.set_revision = self.stack.set_revision.wrapping_add(1);
        self.change(task, |level_goal, dimension| {
            check_set(dimension, new_interval)?;
            check_rates(new_rates)?;
            match level_goal {
                Goal::Set {
                    interval, rates, ..
                } => {
                    *interval = new_interval;
                    *rates = new_rates;
                    Ok(())
                }
                Goal::Equality { .. } => Err(StackErrorReason::WrongKind),
            }
        })
    }

    /// Sets the speed [task's unit per second] at which a high-priority set moves in while it is
    /// outside, as far as all others and the joints' limits allow; `None`: it is only kept from
    /// getting worse, and moves in as the tasks below move it.
    pub fn set_recovery(&mut self, task: TaskId, speed: Option<f64>) -> Result<(), StackError> {
        self.stack.set_revision = self.stack.set_revision.wrapping_add(1);
        self.change(task, |level_goal, _| {
            if let Some(speed) = speed {
                check_speed(speed)?;
            }
            match level_goal {
                Goal::Set { recovery, .. } => {
                    *recovery = speed;
                    Ok(())
                }
                Goal::Equality { .. } => Err(StackErrorReason::WrongKind),
            }
        })
    }

    /// Sets how a level is damped near singularities. It has no effect on a high-priority set, which is
    /// no level of its own.
    pub fn set_damping(&mut self, task: TaskId, damping: Damping) -> Result<(), StackError> {
        let level = &mut self.stack.levels[task.index()];
        match damping {
            Damping::Fixed(lambda) if !(lambda >= 0.0 && lambda.is_finite()) => {
                Err(error(&level.name, StackErrorReason::BadDamping(lambda)))
            }
            _ => {
                level.damping = damping;
                Ok(())
            }
        }
    }

    /// A task as its own type, to change its parameters; `None` if it is of another type. The next step
    /// refuses parameters with which it no longer fits the robot.
    pub fn task_mut<T: Task>(&mut self, task: TaskId) -> Option<&mut T> {
        self.stack.changed.insert(task);
        self.stack.revision = self.stack.revision.wrapping_add(1);
        let level = &mut self.stack.levels[task.index()];
        level.revision = self.stack.revision;
        let task: &mut dyn Any = &mut *level.task;
        task.downcast_mut()
    }

    fn change(
        &mut self,
        task: TaskId,
        change: impl FnOnce(&mut Goal, usize) -> Result<(), StackErrorReason>,
    ) -> Result<(), StackError> {
        let level = &mut self.stack.levels[task.index()];
        let dimension = level.task.dimension();
        change(&mut level.goal, dimension).map_err(|reason| error(&level.name, reason))
    }
}

impl Goal {
    /// Lengths are checked already. No rate is a rate of zero.
    fn set_desired(&mut self, value: &[f64], rate: Option<&[f64]>) -> Result<(), StackErrorReason> {
        let Self::Equality {
            desired,
            desired_rate,
            ..
        } = self
        else {
            return Err(StackErrorReason::WrongKind);
        };
        desired.copy_from_slice(value);
        match rate {
            Some(rate) => desired_rate.copy_from_slice(rate),
            None => desired_rate.fill(0.0),
        }
        Ok(())
    }
}
