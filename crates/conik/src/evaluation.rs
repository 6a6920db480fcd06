//! Values and Jacobians of all tasks in one configuration, each computed at most once per tick.

use alloc::vec::Vec;

use crate::kinematics::Kinematics;
use crate::robot::Robot;
use crate::stack::{Goal, Stack};
use crate::task::JacobianMut;
use crate::task_id::TaskId;
use crate::task_vectors::TaskVectors;

#[derive(Debug)]
pub(crate) struct Evaluation {
    kinematics: Kinematics,
    values: TaskVectors,
    errors: TaskVectors,
    /// The Jacobian of each task, row after row.
    jacobians: Vec<Vec<f64>>,
    jacobian_known: Vec<bool>,
}

impl Evaluation {
    pub(crate) fn new(robot: &Robot, stack: &Stack) -> Self {
        Self {
            kinematics: Kinematics::new(robot),
            values: TaskVectors::zeros(stack),
            errors: TaskVectors::zeros(stack),
            jacobians: stack
                .iter()
                .map(|(_, level)| alloc::vec![0.0; level.task().dimension() * robot.dof()])
                .collect(),
            jacobian_known: alloc::vec![false; stack.len()],
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

    /// Whether the robot is at `q`.
    pub(crate) fn is_at(&self, q: &[f64]) -> bool {
        **self.kinematics.q() == *q
    }

    /// Values of all tasks at `q`, and errors of the equality tasks. Jacobians wait to be asked for.
    pub(crate) fn update(&mut self, stack: &Stack, q: &[f64]) {
        self.kinematics.update(q);
        self.jacobian_known.fill(false);
        for (id, level) in stack.iter() {
            let value = self.values.of_mut(id);
            level.task().value(&self.kinematics, value);
            if let Goal::Equality { desired, .. } = level.goal() {
                level.task().error(desired, value, self.errors.of_mut(id));
            }
        }
    }

    /// The first task whose value is not a finite number.
    pub(crate) fn not_finite(&self) -> Option<TaskId> {
        self.values.not_finite()
    }

    /// σ of every task.
    pub(crate) fn values(&self) -> &TaskVectors {
        &self.values
    }

    /// σ̃ of every equality task, zeros for the others.
    pub(crate) fn errors(&self) -> &TaskVectors {
        &self.errors
    }

    /// σ of a scalar task.
    #[inline]
    pub(crate) fn scalar(&self, task: TaskId) -> f64 {
        self.values.of(task)[0]
    }

    /// J of a task for which it was asked before.
    pub(crate) fn known_jacobian(&self, task: TaskId) -> &[f64] {
        debug_assert!(self.jacobian_known[task.index()]);
        &self.jacobians[task.index()]
    }

    /// J of a task, row after row.
    #[inline]
    pub(crate) fn jacobian(&mut self, stack: &Stack, task: TaskId) -> &[f64] {
        let jacobian = &mut self.jacobians[task.index()];
        if !self.jacobian_known[task.index()] {
            let mut target = JacobianMut::new(jacobian, stack.dof());
            stack[task].task().jacobian(&self.kinematics, &mut target);
            self.jacobian_known[task.index()] = true;
        }
        jacobian
    }
}
