//! Values and Jacobians of all tasks in one configuration, each computed at most once per tick.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::kinematics::Kinematics;
use crate::robot::Robot;
use crate::stack::{Goal, Stack};
use crate::task::JacobianMut;
use crate::task_id::TaskId;
use crate::task_vectors::TaskVectors;

#[derive(Debug)]
pub(crate) struct Evaluation {
    kinematics: Kinematics,
    period: f64,
    values: TaskVectors,
    errors: TaskVectors,
    /// ∂σ/∂t of the tasks whose own parameters move; zeros for the others.
    drifts: TaskVectors,
    /// Tasks whose drift is not zero, and whether there are any.
    drifting: ActiveSet,
    is_any_drifting: bool,
    /// The Jacobian of each task, row after row.
    jacobians: Vec<Vec<f64>>,
    jacobian_known: ActiveSet,
}

impl Evaluation {
    pub(crate) fn new(robot: &Robot, stack: &Stack, period: f64) -> Self {
        Self {
            kinematics: Kinematics::new(robot),
            period,
            values: TaskVectors::zeros(stack),
            errors: TaskVectors::zeros(stack),
            drifts: TaskVectors::zeros(stack),
            drifting: ActiveSet::EMPTY,
            is_any_drifting: false,
            jacobians: stack
                .iter()
                .map(|(_, level)| alloc::vec![0.0; level.task().dimension() * robot.dof()])
                .collect(),
            jacobian_known: ActiveSet::EMPTY,
        }
    }

    /// The robot at `q`, without the tasks.
    pub(crate) fn kinematics_at(&mut self, q: &[f64]) -> &Kinematics {
        self.kinematics.update(q);
        &self.kinematics
    }

    /// The robot where it is.
    pub(crate) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// How fast the value of a task can change, see [`Task::steepness`](crate::Task::steepness).
    pub(crate) fn steepness(&self, stack: &Stack, task: TaskId) -> f64 {
        stack[task].task().steepness(self.kinematics.reach())
    }

    /// Whether the robot is at `q`.
    pub(crate) fn is_at(&self, q: &[f64]) -> bool {
        **self.kinematics.q() == *q
    }

    /// Values of all tasks at `q` now, errors of the equality tasks, and drifts. Jacobians wait to be
    /// asked for.
    pub(crate) fn update(&mut self, stack: &Stack, q: &[f64]) {
        self.kinematics.update(q);
        self.jacobian_known = ActiveSet::EMPTY;
        for (id, level) in stack.iter() {
            let value = self.values.of_mut(id);
            level.task().value(&self.kinematics, value);
            if let Goal::Equality { desired, .. } = level.goal() {
                level.task().error(desired, value, self.errors.of_mut(id));
            }
            self.update_drift(stack, id);
        }
        self.is_any_drifting = !self.drifting.is_empty();
    }

    /// The mean of ∂σ/∂t over the period: with it, the value at its end is met without lag.
    fn update_drift(&mut self, stack: &Stack, id: TaskId) {
        let task = stack[id].task();
        if task.is_moving() {
            let drift = self.drifts.of_mut(id);
            task.value_ahead(&self.kinematics, self.period, drift);
            for (drift, now) in drift.iter_mut().zip(self.values.of(id)) {
                *drift = (*drift - now) / self.period;
            }
            self.drifting.insert(id);
        } else if self.drifting.contains(id) {
            self.drifting.remove(id);
            self.drifts.of_mut(id).fill(0.0);
        }
    }

    /// Values of the sets at `q` at the end of the period.
    pub(crate) fn look_ahead(&mut self, stack: &Stack, q: &[f64]) {
        self.kinematics.update(q);
        self.jacobian_known = ActiveSet::EMPTY;
        for (id, level) in stack.iter().filter(|(_, level)| level.interval().is_some()) {
            let (task, value) = (level.task(), self.values.of_mut(id));
            if task.is_moving() {
                task.value_ahead(&self.kinematics, self.period, value);
            } else {
                task.value(&self.kinematics, value);
            }
        }
    }

    /// The first task whose value, or drift, is not a finite number.
    pub(crate) fn not_finite(&self) -> Option<TaskId> {
        self.values.not_finite().or_else(|| {
            let drifts = self.is_any_drifting.then_some(&self.drifts)?;
            drifts.not_finite()
        })
    }

    /// σ of every task.
    pub(crate) fn values(&self) -> &TaskVectors {
        &self.values
    }

    /// σ̃ of every equality task, zeros for the others.
    pub(crate) fn errors(&self) -> &TaskVectors {
        &self.errors
    }

    /// ∂σ/∂t of every task [unit/s].
    pub(crate) fn drifts(&self) -> &TaskVectors {
        &self.drifts
    }

    /// σ of a scalar task.
    #[inline]
    pub(crate) fn scalar(&self, task: TaskId) -> f64 {
        self.values.of(task)[0]
    }

    /// J of a task for which it was asked before.
    pub(crate) fn known_jacobian(&self, task: TaskId) -> &[f64] {
        debug_assert!(self.jacobian_known.contains(task));
        &self.jacobians[task.index()]
    }

    /// ∂σ/∂t of a scalar task [unit/s].
    #[inline]
    pub(crate) fn drift(&self, task: TaskId) -> f64 {
        if self.is_any_drifting {
            self.drifts.of(task)[0]
        } else {
            0.0
        }
    }

    /// J of a task, row after row.
    #[inline]
    pub(crate) fn jacobian(&mut self, stack: &Stack, task: TaskId) -> &[f64] {
        let jacobian = &mut self.jacobians[task.index()];
        if !self.jacobian_known.contains(task) {
            let mut target = JacobianMut::new(jacobian, stack.dof());
            stack[task].task().jacobian(&self.kinematics, &mut target);
            self.jacobian_known.insert(task);
        }
        jacobian
    }
}
