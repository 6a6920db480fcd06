//! Values and Jacobians of all tasks in one configuration, each computed at most once per tick.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::kinematics::Kinematics;
use crate::linalg::{are_equal, not_finite};
use crate::robot::Robot;
use crate::stack::{Goal, Stack};
use crate::task::JacobianMut;
use crate::task_id::TaskId;
use crate::task_vectors::TaskVectors;
use crate::watch::Watch;

#[derive(Debug)]
pub(crate) struct Evaluation {
    kinematics: Kinematics,
    period: f64,
    values: TaskVectors,
    errors: TaskVectors,
    /// ∂σ/∂t of the tasks whose own parameters move; zeros for the others.
    drifts: TaskVectors,
    is_any_drifting: bool,
    jacobians: Vec<TaskJacobian>,
    /// A task whose Jacobian, computed here, has an entry that is not a finite number.
    unsound: Option<TaskId>,
    /// How many configurations this was at, the present one included.
    configurations: u64,
    /// Which tasks these are: their parameters have been changed so many times.
    revision: Option<u64>,
    steepness: Vec<f64>,
    /// The sets that stand still while the robot does, and whether their values are known where it is.
    /// So what landing computes at q + T q̇ serves the tick that begins there.
    still: Vec<TaskId>,
    is_still_known: bool,
    /// The other tasks: those to be met, and those that move by themselves.
    others: Vec<TaskId>,
    /// Still sets that are costly to measure, if they are not to be measured everywhere.
    watch: Option<Box<Watch>>,
}

/// The Jacobian of a task, row after row, in the configuration of this number.
#[derive(Debug)]
struct TaskJacobian {
    entries: Vec<f64>,
    configuration: u64,
}

impl Evaluation {
    pub(crate) fn new(robot: &Robot, stack: &Stack, period: f64) -> Self {
        Self {
            kinematics: Kinematics::new(robot),
            period,
            values: TaskVectors::zeros(stack),
            errors: TaskVectors::zeros(stack),
            drifts: TaskVectors::zeros(stack),
            is_any_drifting: false,
            unsound: None,
            jacobians: stack
                .iter()
                .map(|(_, level)| TaskJacobian {
                    entries: alloc::vec![0.0; level.task().dimension() * robot.dof()],
                    configuration: 0,
                })
                .collect(),
            configurations: 1,
            revision: None,
            steepness: alloc::vec![f64::INFINITY; stack.len()],
            still: Vec::with_capacity(stack.len()),
            is_still_known: false,
            others: Vec::with_capacity(stack.len()),
            watch: None,
        }
    }

    /// The robot at `q`, without the tasks.
    pub(crate) fn kinematics_at(&mut self, q: &[f64]) -> &Kinematics {
        self.move_to(q);
        &self.kinematics
    }

    /// The robot where it is.
    pub(crate) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// How fast the value of a task can change, see [`Task::steepness`](crate::Task::steepness).
    #[inline]
    pub(crate) fn steepness(&self, task: TaskId) -> f64 {
        self.steepness[task.index()]
    }

    /// [`steepness`](Self::steepness) of every task.
    pub(crate) fn steepnesses(&self) -> &[f64] {
        &self.steepness
    }

    /// Whether the robot is at `q`.
    pub(crate) fn is_at(&self, q: &[f64]) -> bool {
        are_equal(self.kinematics.q(), q)
    }

    /// Values of all tasks at `q` now, errors of the equality tasks, and drifts. Jacobians wait to be
    /// asked for.
    pub(crate) fn update(&mut self, stack: &Stack, q: &[f64]) {
        self.move_to(q);
        self.look_at(stack);
        for &id in &self.others {
            let (level, value) = (&stack[id], self.values.of_mut(id));
            level.task().value(&self.kinematics, value);
            if let Goal::Equality { desired, .. } = level.goal() {
                level.task().error(desired, value, self.errors.of_mut(id));
            }
            if level.task().is_moving() {
                // The mean of ∂σ/∂t over the period: with it, the value at its end is met without lag.
                let drift = self.drifts.of_mut(id);
                level
                    .task()
                    .value_ahead(&self.kinematics, self.period, drift);
                for (drift, now) in drift.iter_mut().zip(value) {
                    *drift = (*drift - *now) / self.period;
                }
            }
        }
    }

    /// Values of the sets at `q` at the end of the period.
    pub(crate) fn look_ahead(&mut self, stack: &Stack, q: &[f64]) {
        self.move_to(q);
        self.look_at(stack);
        if self.is_any_drifting {
            for &id in &self.others {
                let (level, value) = (&stack[id], self.values.of_mut(id));
                if level.interval().is_some() {
                    level
                        .task()
                        .value_ahead(&self.kinematics, self.period, value);
                }
            }
        }
    }

    fn move_to(&mut self, q: &[f64]) {
        if !self.is_at(q) {
            if let Some(watch) = &mut self.watch {
                watch.travel(self.kinematics.q(), q);
            }
            self.kinematics.update(q);
            self.forget();
        }
    }

    fn forget(&mut self) {
        self.configurations += 1;
        self.unsound = None;
        self.is_still_known = false;
    }

    /// Values of the sets that stand still, unless they are known.
    fn look_at(&mut self, stack: &Stack) {
        if self.revision != Some(stack.revision()) {
            self.sort(stack);
        }
        if let Some(watch) = &self.watch {
            self.is_still_known &= !watch.is_stale(stack);
        }
        if !self.is_still_known {
            for &id in &self.still {
                let value = self.values.of_mut(id);
                stack[id].task().value(&self.kinematics, value);
            }
            if let Some(watch) = &mut self.watch {
                watch.look(stack, &self.kinematics, &mut self.values);
            }
            self.is_still_known = true;
        }
    }

    /// Sorts the tasks anew: the parameters of some have been changed.
    fn sort(&mut self, stack: &Stack) {
        self.forget();
        self.still.clear();
        self.others.clear();
        if let Some(watch) = &mut self.watch {
            watch.clear();
        }
        self.is_any_drifting = false;
        for (id, level) in stack.iter() {
            let is_moving = level.task().is_moving();
            self.is_any_drifting |= is_moving;
            self.drifts.of_mut(id).fill(0.0);
            let steepness = level.task().steepness(&self.kinematics);
            self.steepness[id.index()] = steepness;
            let watch = self.watch.as_mut();
            if is_moving || level.interval().is_none() {
                self.others.push(id);
            } else if !watch.is_some_and(|watch| watch.takes(stack, id, steepness)) {
                self.still.push(id);
            }
        }
        self.revision = Some(stack.revision());
    }

    /// Sets that are so far inside that they cannot matter are not measured from now on.
    pub(crate) fn measure_on_demand(&mut self, stack: &Stack) {
        self.watch = Some(Box::new(Watch::new(stack, self.period)));
        self.revision = None;
    }

    /// The sets of which `values` has a bound in the place of the value, if there may be any: it is on the
    /// same side of the bounds in force as the value is, and less far inside.
    #[inline]
    pub(crate) fn bounded(&self) -> Option<&ActiveSet> {
        self.watch.as_deref().map(Watch::bounded)
    }

    /// Measures them; the sets that it has measured.
    #[inline]
    pub(crate) fn measure(&mut self, stack: &Stack) -> ActiveSet {
        match &mut self.watch {
            None => ActiveSet::EMPTY,
            Some(watch) => watch.measure(stack, &self.kinematics, &mut self.values),
        }
    }

    /// The first task whose value, or drift, is not a finite number.
    pub(crate) fn not_finite(&self) -> Option<TaskId> {
        self.values.not_finite().or_else(|| {
            let drifts = self.is_any_drifting.then_some(&self.drifts)?;
            drifts.not_finite()
        })
    }

    /// A task whose Jacobian has an entry that is not a finite number, among those that were needed here.
    pub(crate) fn unsound(&self) -> Option<TaskId> {
        self.unsound
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

    /// σ of the first `count` tasks, each of one component.
    #[inline]
    pub(crate) fn scalars(&self, count: usize) -> &[f64] {
        self.values.first(count)
    }

    /// Whether any task moves by itself.
    pub(crate) fn is_any_drifting(&self) -> bool {
        self.is_any_drifting
    }

    /// J of a task for which it was asked before.
    pub(crate) fn known_jacobian(&self, task: TaskId) -> &[f64] {
        let jacobian = &self.jacobians[task.index()];
        debug_assert_eq!(jacobian.configuration, self.configurations);
        &jacobian.entries
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
        if jacobian.configuration != self.configurations {
            let mut target = JacobianMut::new(&mut jacobian.entries, stack.dof());
            stack[task].task().jacobian(&self.kinematics, &mut target);
            jacobian.configuration = self.configurations;
            if not_finite(&jacobian.entries).is_some() {
                self.unsound = self.unsound.or(Some(task));
            }
        }
        &jacobian.entries
    }
}
