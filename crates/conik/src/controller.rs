//! The controller: from a configuration to the next joint reference, once per period.

use alloc::vec::Vec;

use crate::evaluation::Evaluation;
use crate::joints::JointVec;
use crate::kinematics::Kinematics;
use crate::mode::ModeSearch;
use crate::robot::Robot;
use crate::settings::Settings;
use crate::stack::{Setpoints, Stack};
use crate::step::{SpeedLimit, Step};
use crate::task_id::TaskId;

/// A kinematic controller for one robot and one stack of tasks: the block of that name in Fig. 2 of
/// the paper.
///
/// [`step`](Self::step) does not allocate, lock, log or call the system. Its time is bounded by the
/// number of modes that the rule can choose from: with n candidates for activation and d joints, at
/// most Σₖ C(n, k) velocities, k = 0 … min(n, d) for high-priority sets. Candidates are all sets
/// with rule `Paper`, and those at their border, rarely more than two, with rule `Border`.
#[derive(Debug)]
pub struct Controller {
    stack: Stack,
    settings: Settings,
    period: f64,
    evaluation: Evaluation,
    modes: ModeSearch,
    /// Greatest speed of each joint; infinite where there is none.
    speed_limits: Vec<f64>,
    step: Step,
}

/// Why a controller could not be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ControllerError {
    /// The control rate is not a positive number.
    #[error("the control rate must be a positive number [Hz], not {0}")]
    BadRate(f64),
    /// The stack was made for a robot of another number of joints.
    #[error("the stack is for {stack} joints, the robot has {robot}")]
    OtherRobot {
        /// Joints of the stack.
        stack: usize,
        /// Joints of the robot.
        robot: usize,
    },
}

/// Why a tick gave no reference. The last one stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StepError {
    /// A configuration of the wrong length.
    #[error("{expected} joint positions expected, {found} found")]
    WrongLength {
        /// Joints of the robot.
        expected: usize,
        /// Positions given.
        found: usize,
    },
    /// A joint position that is NaN or infinite.
    #[error("the position of joint {joint} (from 0) is not a finite number")]
    PositionNotFinite {
        /// Index of the joint.
        joint: usize,
    },
    /// The value of a task is NaN or infinite. Such a set could not be kept.
    #[error("the value of task {} (from 0) is not a finite number", .task.index())]
    TaskNotFinite {
        /// The task.
        task: TaskId,
    },
    /// A Jacobian gave NaN or an infinite number, so that the velocity of a joint is none.
    #[error("the velocity of joint {joint} (from 0) came out as no finite number")]
    VelocityNotFinite {
        /// Index of the joint.
        joint: usize,
    },
}

impl Controller {
    /// A controller for `robot` that keeps `stack`.
    pub fn new(robot: &Robot, stack: Stack, settings: Settings) -> Result<Self, ControllerError> {
        if !(settings.rate_hz > 0.0 && settings.rate_hz.is_finite()) {
            return Err(ControllerError::BadRate(settings.rate_hz));
        }
        if stack.dof() != robot.dof() {
            return Err(ControllerError::OtherRobot {
                stack: stack.dof(),
                robot: robot.dof(),
            });
        }
        Ok(Self {
            period: 1.0 / settings.rate_hz,
            settings,
            evaluation: Evaluation::new(robot, &stack),
            modes: ModeSearch::new(&stack),
            speed_limits: robot
                .joints()
                .iter()
                .map(|joint| joint.limits.speed.unwrap_or(f64::INFINITY))
                .collect(),
            step: Step::at_rest(&stack),
            stack,
        })
    }

    /// One tick: the mode at `q` [rad or m] and the reference at the end of the period.
    ///
    /// `q` is the last reference, not a measurement (Fig. 2 of the paper); the loop is
    /// `q = controller.step(&q)?.q_ref`.
    pub fn step(&mut self, q: &[f64]) -> Result<&Step, StepError> {
        self.check(q)?;
        let mut qd = JointVec::zeros(q.len());
        self.evaluation.update(&self.stack, q);
        if let Some(task) = self.evaluation.not_finite() {
            return Err(StepError::TaskNotFinite { task });
        }
        let active = self.modes.choose(
            self.settings.mode_rule,
            &self.stack,
            &mut self.evaluation,
            &mut qd,
        );
        if active.is_none() {
            qd.fill(0.0);
        }
        if let Some(joint) = qd.iter().position(|v| !v.is_finite()) {
            return Err(StepError::VelocityNotFinite { joint });
        }
        let speed_limit = scale_to_limits(&mut qd, &self.speed_limits);

        let step = &mut self.step;
        for i in 0..q.len() {
            step.qdd[i] = (qd[i] - step.qd[i]) / self.period;
            step.q_ref[i] = q[i] + self.period * qd[i];
        }
        step.qd = qd;
        step.speed_limit = speed_limit;
        step.no_mode = active.is_none();
        step.active = active.unwrap_or_default();
        step.modes_evaluated = self.modes.evaluated();
        step.values.copy_from(self.evaluation.values());
        step.errors.copy_from(self.evaluation.errors());
        Ok(step)
    }

    fn check(&self, q: &[f64]) -> Result<(), StepError> {
        if q.len() != self.stack.dof() {
            return Err(StepError::WrongLength {
                expected: self.stack.dof(),
                found: q.len(),
            });
        }
        match q.iter().position(|v| !v.is_finite()) {
            Some(joint) => Err(StepError::PositionNotFinite { joint }),
            None => Ok(()),
        }
    }

    /// The robot at `q` [rad or m]: what a caller needs to move setpoints before a tick. The tick at
    /// the same `q` reuses it.
    ///
    /// # Panics
    /// If `q` has not one entry per joint.
    pub fn kinematics_at(&mut self, q: &[f64]) -> &Kinematics {
        self.evaluation.kinematics_at(q)
    }

    /// The last tick; all zeros before the first.
    pub fn last_step(&self) -> &Step {
        &self.step
    }

    /// The tasks.
    pub fn stack(&self) -> &Stack {
        &self.stack
    }

    /// Setpoints of the tasks: desired values, bounds, tasks' own parameters.
    pub fn setpoints(&mut self) -> Setpoints<'_> {
        self.stack.setpoints()
    }

    /// How the controller works.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }
}

/// Scales the whole velocity so that every joint is within its speed limit. Scaling keeps each J q̇
/// in its cone, clamping single joints does not.
fn scale_to_limits(qd: &mut [f64], limits: &[f64]) -> Option<SpeedLimit> {
    let mut bound: Option<SpeedLimit> = None;
    for (joint, (speed, limit)) in qd.iter().zip(limits).enumerate() {
        let factor = limit / speed.abs();
        if factor < bound.map_or(1.0, |bound| bound.factor) {
            bound = Some(SpeedLimit { joint, factor });
        }
    }
    if let Some(SpeedLimit { factor, .. }) = bound {
        for speed in qd {
            *speed *= factor;
        }
    }
    bound
}
