//! The hierarchy: tasks in decreasing priority, and what is asked of each.

mod checks;
mod setpoints;

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::active::{ActiveSet, MAX_TASKS};
use crate::cone::Interval;
use crate::damping::Damping;
use crate::robot::Robot;
use crate::task::{JointPosition, Task};
use crate::task_id::TaskId;
pub use checks::{StackError, StackErrorReason};
use checks::{check_desired, check_dimension, check_gain, check_set, error};
pub use setpoints::Setpoints;

/// What is asked of a task.
#[derive(Clone, Debug, PartialEq)]
pub enum Goal {
    /// Have one value: σ̇_ref = σ̇_des + Λ (σ_des − σ).
    Equality {
        /// σ_des [task's unit].
        desired: Vec<f64>,
        /// σ̇_des [task's unit per second], the feed-forward of a desired value that moves.
        desired_rate: Vec<f64>,
        /// Λ [1/s].
        gain: f64,
    },
    /// Stay in an interval, and cost nothing while there.
    Set {
        /// The allowed values [task's unit].
        interval: Interval,
        /// How fast the bounds move [task's unit per second].
        rates: BoundRates,
        /// Λ [1/s] with which a low-priority set is driven back to its border.
        gain: Option<f64>,
        /// Speed [task's unit per second] at which a high-priority set that is outside moves back in;
        /// without it, it is only kept from getting worse.
        recovery: Option<f64>,
    },
}

/// How fast the two bounds of a set move [task's unit per second], positive upward.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundRates {
    /// Of the least allowed value.
    pub min: f64,
    /// Of the greatest allowed value.
    pub max: f64,
}

/// One task of a stack.
#[derive(Debug)]
pub struct Level {
    name: String,
    task: Box<dyn Task>,
    goal: Goal,
    damping: Damping,
    /// Tasks that may not be active together with this one.
    excluded: ActiveSet,
    /// That of the stack when its parameters may have been changed last.
    revision: u64,
}

impl Level {
    /// The task's name, unique in its stack.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is measured.
    pub fn task(&self) -> &dyn Task {
        &*self.task
    }

    /// What is asked of it.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// The allowed values, for a set-based task.
    #[inline]
    pub fn interval(&self) -> Option<&Interval> {
        match &self.goal {
            Goal::Set { interval, .. } => Some(interval),
            Goal::Equality { .. } => None,
        }
    }

    /// Another number after every access that may have changed the task's own parameters.
    #[inline]
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// How it is damped near singularities, where it is a level of its own.
    pub fn damping(&self) -> Damping {
        self.damping
    }

    /// Tasks that may not be active together with this one.
    pub(crate) fn excluded(&self) -> &ActiveSet {
        &self.excluded
    }
}

/// Tasks in decreasing priority for one robot.
///
/// A set-based task above the first equality task has *high priority*: it is frozen where it would
/// leave its set, and only there is it guaranteed. Below, it has *low priority*: it is driven back
/// to its border as well as the tasks above allow.
///
/// Tasks are added at construction; desired values, bounds and the tasks' own parameters may change
/// between any two ticks.
#[derive(Debug)]
pub struct Stack {
    robot: Robot,
    levels: Vec<Level>,
    /// Number of sets above the first equality task.
    high_priority: usize,
    /// How often tasks' own parameters may have been changed.
    revision: u64,
    /// How often what is asked of sets may have been changed.
    set_revision: u64,
    /// Tasks whose own parameters may have been changed since they were last looked at.
    changed: ActiveSet,
}

impl Stack {
    /// A stack for a robot, with the position limits of its joints as its first high-priority sets:
    /// `limit/<joint>` for each joint that has any.
    pub fn new(robot: &Robot) -> Self {
        let mut stack = Self::without_position_limits(robot);
        for (index, joint) in robot.joints().iter().enumerate() {
            let limits = joint
                .limits
                .position
                .map(|(min, max)| Interval { min, max });
            if let Some(interval) = limits.filter(Interval::is_valid) {
                stack.high_priority += 1;
                stack.levels.push(Level {
                    name: alloc::format!("limit/{}", joint.name),
                    task: Box::new(JointPosition::of_robot(index, robot)),
                    goal: Goal::Set {
                        interval,
                        rates: BoundRates::default(),
                        gain: None,
                        recovery: None,
                    },
                    damping: Damping::Automatic,
                    excluded: ActiveSet::EMPTY,
                    revision: 0,
                });
            }
        }
        stack
    }

    /// An empty stack for a robot, even if its joints have position limits.
    pub fn without_position_limits(robot: &Robot) -> Self {
        Self {
            robot: robot.clone(),
            levels: Vec::new(),
            high_priority: 0,
            revision: 0,
            set_revision: 0,
            changed: ActiveSet::EMPTY,
        }
    }

    /// Adds an equality task below all others: σ → `desired` with gain Λ = `gain` [1/s].
    pub fn equality(
        &mut self,
        name: &str,
        task: impl Task,
        desired: &[f64],
        gain: f64,
    ) -> Result<TaskId, StackError> {
        let dimension = task.dimension();
        let goal = check_desired(dimension, desired)
            .and_then(|()| check_gain(gain))
            .map(|()| Goal::Equality {
                desired: desired.to_vec(),
                desired_rate: alloc::vec![0.0; dimension],
                gain,
            });
        self.push(name, Box::new(task), goal)
    }

    /// Adds a high-priority set-based task below all others: `stack.set("a", task, 0.18..)`.
    ///
    /// Below an equality task use [`set_with_gain`](Self::set_with_gain).
    pub fn set(
        &mut self,
        name: &str,
        task: impl Task,
        interval: impl Into<Interval>,
    ) -> Result<TaskId, StackError> {
        self.add_set(name, Box::new(task), interval.into(), None)
    }

    /// Adds a set-based task below all others that, where it has low priority, is driven back to
    /// its border with Λ = `gain` [1/s].
    pub fn set_with_gain(
        &mut self,
        name: &str,
        task: impl Task,
        interval: impl Into<Interval>,
        gain: f64,
    ) -> Result<TaskId, StackError> {
        self.add_set(name, Box::new(task), interval.into(), Some(gain))
    }

    fn add_set(
        &mut self,
        name: &str,
        task: Box<dyn Task>,
        interval: Interval,
        gain: Option<f64>,
    ) -> Result<TaskId, StackError> {
        let low_priority = self.high_priority < self.levels.len();
        let goal = check_set(task.dimension(), interval)
            .and_then(|()| match gain {
                Some(gain) => check_gain(gain),
                None if low_priority => Err(StackErrorReason::MissingGain),
                None => Ok(()),
            })
            .map(|()| Goal::Set {
                interval,
                rates: BoundRates::default(),
                gain,
                recovery: None,
            });
        self.push(name, task, goal)
    }

    fn push(
        &mut self,
        name: &str,
        task: Box<dyn Task>,
        goal: Result<Goal, StackErrorReason>,
    ) -> Result<TaskId, StackError> {
        let goal = check_dimension(task.dimension())
            .and_then(|()| task.check(&self.robot).map_err(StackErrorReason::Unfit))
            .and(goal)
            .and_then(|goal| {
                if self.find(name).is_some() {
                    Err(StackErrorReason::NameTaken)
                } else if self.levels.len() == MAX_TASKS {
                    Err(StackErrorReason::TooManyTasks)
                } else {
                    Ok(goal)
                }
            })
            .map_err(|reason| error(name, reason))?;
        let is_highest = self.high_priority == self.levels.len();
        if is_highest && matches!(goal, Goal::Set { .. }) {
            self.high_priority += 1;
        }
        self.levels.push(Level {
            name: name.to_string(),
            task,
            goal,
            damping: Damping::Automatic,
            excluded: ActiveSet::EMPTY,
            revision: 0,
        });
        Ok(TaskId::new(self.levels.len() - 1))
    }

    /// Declares that no two of these set-based tasks can be active together (the paper strikes the
    /// modes out in which both of two disjoint obstacles are frozen).
    pub fn exclude_together(&mut self, tasks: &[TaskId]) -> Result<(), StackError> {
        if let Some(&task) = tasks
            .iter()
            .find(|task| self.levels[task.index()].interval().is_none())
        {
            return Err(error(
                &self.levels[task.index()].name,
                StackErrorReason::WrongKind,
            ));
        }
        let group: ActiveSet = tasks.iter().copied().collect();
        for &task in tasks {
            for other in group.iter().filter(|&other| other != task) {
                self.levels[task.index()].excluded.insert(other);
            }
        }
        Ok(())
    }

    /// What may change between any two ticks.
    pub fn setpoints(&mut self) -> Setpoints<'_> {
        Setpoints { stack: self }
    }

    /// The task of this name.
    pub fn find(&self, name: &str) -> Option<TaskId> {
        self.levels
            .iter()
            .position(|level| level.name == name)
            .map(TaskId::new)
    }

    /// The tasks with their places, the highest priority first.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (TaskId, &Level)> {
        self.levels
            .iter()
            .enumerate()
            .map(|(i, level)| (TaskId::new(i), level))
    }

    /// The sets above the first equality task.
    #[inline]
    pub(crate) fn high_priority_sets(&self) -> impl Iterator<Item = (TaskId, &Level)> {
        let sets = self.levels[..self.high_priority].iter().enumerate();
        sets.map(|(i, level)| (TaskId::new(i), level))
    }

    /// Whether a set moves in by itself while it is outside.
    pub(crate) fn recovers(&self, task: TaskId) -> bool {
        matches!(
            self[task].goal(),
            Goal::Set {
                recovery: Some(_),
                ..
            }
        )
    }

    /// The allowed values of a task that is a set; all values for another one.
    pub(crate) fn interval_of_set(&self, task: TaskId) -> Interval {
        let all = Interval {
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
        };
        self[task].interval().copied().unwrap_or(all)
    }

    /// Number of tasks.
    pub fn len(&self) -> usize {
        self.levels.len()
    }

    /// Whether there is no task.
    pub fn is_empty(&self) -> bool {
        self.levels.is_empty()
    }

    /// Number of joints of the robot that the stack is for.
    pub fn dof(&self) -> usize {
        self.robot.dof()
    }

    /// Takes the stack for another robot: a task that does not fit it, with the reason.
    pub(crate) fn fit(&mut self, robot: &Robot) -> Result<(), (TaskId, &'static str)> {
        self.robot = robot.clone();
        self.changed = self.iter().map(|(id, _)| id).collect();
        self.check_changed()
    }

    /// The first task that was given parameters with which it does not fit the robot, and why.
    #[inline]
    pub(crate) fn check_changed(&mut self) -> Result<(), (TaskId, &'static str)> {
        if !self.changed.is_empty() {
            for id in self.changed.iter() {
                let fits = self[id].task().check(&self.robot);
                fits.map_err(|reason| (id, reason))?;
            }
            self.changed = ActiveSet::EMPTY;
        }
        Ok(())
    }

    /// Whether a task stands above the first equality task.
    #[inline]
    pub fn is_high_priority(&self, task: TaskId) -> bool {
        task.index() < self.high_priority
    }

    /// Another number after every change of what is asked of a set.
    #[inline]
    pub(crate) fn set_revision(&self) -> u64 {
        self.set_revision
    }

    /// Another number after every access that may have changed a task's own parameters.
    #[inline]
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }
}

impl core::ops::Index<TaskId> for Stack {
    type Output = Level;

    #[inline]
    fn index(&self, task: TaskId) -> &Level {
        &self.levels[task.index()]
    }
}
