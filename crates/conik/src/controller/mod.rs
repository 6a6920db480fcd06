//! The controller: from a configuration to the next joint reference, once per period.

mod explain;
mod on_demand;

use alloc::boxed::Box;

use crate::active::ActiveSet;
use crate::anchor::{Anchor, AnchorTick};
use crate::barrier::Barrier;
use crate::border::Borders;
use crate::evaluation::Evaluation;
use crate::joints::JointVec;
use crate::kinematics::Kinematics;
use crate::landing::{Approach, Landed, Landing};
use crate::limits::Limits;
use crate::linalg::{add_scaled, copy, not_finite, scaled_difference};
use crate::mode::{ModeSearch, Nearest, NearestTick};
use crate::ranges::{Cut, Ranges};
use crate::robot::Robot;
use crate::settings::{Border, ModeRule, Settings};
use crate::stack::{Setpoints, Stack};
use crate::step::Step;
use crate::task_id::TaskId;

/// A kinematic controller for one robot and one stack of tasks: the block of that name in Fig. 2 of
/// the paper.
///
/// [`step`](Self::step) does not allocate, lock, log or call the system, and its work is bounded:
///
/// * border `Land` computes the kinematics of at most 9 configurations a tick, 10 where sets that move cannot
///   all be kept, `Freeze` of one;
/// * all quadratic programs of a tick, those of rule `Cone` and those of `Land`, share
///   [`MAX_PIVOTS`] pivots;
/// * rules `Paper` and `Border` compute at most 1 + Σₖ C(n, k) velocities, k = 0 … min(n, joints),
///   n being the number of sets, of high and low priority, that may be active: all with `Paper`, those at
///   their border, rarely more than two, with `Border`. Fewer where rows depend on each other: no subset
///   is tried in which a row depends on those above it.
#[derive(Debug)]
pub struct Controller {
    stack: Stack,
    settings: Settings,
    period: f64,
    /// The robot at q.
    here: Box<Evaluation>,
    /// The robot where the last tick landed: the next q, as a rule.
    there: Box<Evaluation>,
    borders: Borders,
    barrier: Barrier,
    anchor: Anchor,
    limits: Limits,
    ranges: Ranges,
    rule: Rule,
    landing: Landing,
    /// Where the last tick left values that were not needed unmeasured.
    q: JointVec,
    /// q̇ and q + T q̇ while a tick is at work; in `step` they stand when it has succeeded.
    qd: JointVec,
    q_ref: JointVec,
    step: Step,
}

/// Pivots that the quadratic programs of one tick may take together.
pub const MAX_PIVOTS: usize = 60;

/// How many of them the rule must leave for landing: a velocity that cannot be corrected is worth
/// nothing.
const LANDING_PIVOTS: usize = 20;

#[derive(Debug)]
enum Rule {
    Search(Box<ModeSearch>),
    Nearest(Box<Nearest>),
}

/// What a rule proposes for a tick.
struct Proposal {
    active: Option<ActiveSet>,
    modes_evaluated: usize,
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
    /// A task of the stack does not fit the robot.
    #[error("task {} (from 0) does not fit the robot: {reason}", .task.index())]
    TaskUnfit {
        /// The task.
        task: TaskId,
        /// Why not.
        reason: &'static str,
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
    /// A task was given parameters with which it does not fit the robot.
    #[error("task {} (from 0) does not fit the robot any more: {reason}", .task.index())]
    TaskUnfit {
        /// The task.
        task: TaskId,
        /// Why not.
        reason: &'static str,
    },
    /// The value of a task is NaN or infinite. Such a set could not be kept.
    #[error("the value of task {} (from 0) is not a finite number", .task.index())]
    TaskNotFinite {
        /// The task.
        task: TaskId,
    },
    /// A Jacobian that this tick needs has an entry that is NaN or infinite.
    #[error("the Jacobian of task {} (from 0) has an entry that is not a finite number", .task.index())]
    JacobianNotFinite {
        /// The task.
        task: TaskId,
    },
    /// What the tasks ask is so much that the velocity of a joint is not a finite number.
    #[error("the velocity of joint {joint} (from 0) came out as no finite number")]
    VelocityNotFinite {
        /// Index of the joint.
        joint: usize,
    },
}

impl Controller {
    /// A controller for `robot` that keeps `stack`.
    pub fn new(
        robot: &Robot,
        mut stack: Stack,
        settings: Settings,
    ) -> Result<Self, ControllerError> {
        if !(settings.rate_hz > 0.0 && settings.rate_hz.is_finite()) {
            return Err(ControllerError::BadRate(settings.rate_hz));
        }
        if stack.dof() != robot.dof() {
            return Err(ControllerError::OtherRobot {
                stack: stack.dof(),
                robot: robot.dof(),
            });
        }
        let fits = stack.fit(robot);
        fits.map_err(|(task, reason)| ControllerError::TaskUnfit { task, reason })?;
        let period = 1.0 / settings.rate_hz;
        let limits = Limits::new(robot, period);
        Ok(Self {
            period,
            settings,
            here: Box::new(Evaluation::new(robot, &stack, period)),
            there: Box::new(Evaluation::new(robot, &stack, period)),
            borders: Borders::new(&settings, &stack),
            barrier: Barrier::new(&stack, &settings, limits.accelerations()),
            anchor: Anchor::new(stack.dof(), 2 * stack.len()),
            limits,
            ranges: Ranges::new(robot.dof()),
            rule: match settings.mode_rule {
                ModeRule::Paper | ModeRule::Border => {
                    Rule::Search(Box::new(ModeSearch::new(&stack, &settings)))
                }
                ModeRule::Cone => Rule::Nearest(Box::new(Nearest::new(&stack, &settings))),
            },
            landing: Landing::new(&stack, period),
            q: JointVec::zeros(robot.dof()),
            qd: JointVec::zeros(robot.dof()),
            q_ref: JointVec::zeros(robot.dof()),
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
        let fits = self.stack.check_changed();
        fits.map_err(|(task, reason)| StepError::TaskUnfit { task, reason })?;
        if self.settings.border == Border::Land && self.there.is_at(q) {
            core::mem::swap(&mut self.here, &mut self.there);
        }
        self.here.update(&self.stack, q);
        if let Some(task) = self.here.not_finite() {
            return Err(StepError::TaskNotFinite { task });
        }
        self.borders.observe(&self.stack, &self.here);

        let reserved = match self.settings.border {
            Border::Land => LANDING_PIVOTS,
            Border::Freeze => 0,
        };
        let mut pivots = MAX_PIVOTS - reserved;
        self.raise_barrier(&mut pivots);
        let proposal = self.propose(&mut pivots);
        // No program tells NaN from what it asks, and none may make a velocity of it.
        if let Some(task) = self.here.unsound() {
            return Err(StepError::JacobianNotFinite { task });
        }
        let is_cut_off = pivots == 0;
        pivots += reserved;
        if let Some(joint) = not_finite(&self.qd) {
            return Err(StepError::VelocityNotFinite { joint });
        }
        let cut = self.shorten();
        let is_shortened = cut.is_some();
        let cut = cut.unwrap_or_default();
        let landed = self.arrive(q, &proposal, is_shortened, &mut pivots);

        let was_active = self.step.active;
        let step = &mut self.step;
        scaled_difference(&mut step.qdd, self.settings.rate_hz, &self.qd, &step.qd);
        if self.limits.has_acceleration() {
            step.acceleration_exceeded = self
                .limits
                .exceeded(&step.qdd)
                .max_by(|a, b| a.times.total_cmp(&b.times));
        }
        copy(&mut step.q_ref, &self.q_ref);
        copy(&mut step.qd, &self.qd);
        step.speed_limit = cut.by_speed;
        step.acceleration_limit = cut.by_acceleration;
        step.no_mode = proposal.active.is_none();
        step.active = proposal.active.unwrap_or_default();
        step.modes_evaluated = proposal.modes_evaluated;
        step.pivots = MAX_PIVOTS - pivots;
        step.landed = landed;
        step.values.copy_from(self.here.values());
        if let Some(bounded) = self.here.bounded() {
            step.unmeasured = *bounded;
            copy(&mut self.q, q);
        }
        step.errors.copy_from(self.here.errors());
        self.explain(&was_active, is_cut_off || pivots == 0);
        Ok(&self.step)
    }

    /// What the high-priority sets allow in this tick, and a velocity that keeps them.
    ///
    /// The rules `Paper` and `Border` ask for the barrier only where rest is not the anchor.
    fn raise_barrier(&mut self, pivots: &mut usize) {
        self.anchor.rest();
        self.barrier.clear();
        let rest_is_enough = !self.limits.has_acceleration();
        if matches!(self.rule, Rule::Search(_)) && rest_is_enough && self.borders.are_at_ease() {
            return;
        }
        self.barrier
            .gather(&self.stack, &self.borders, &mut self.here);
        if rest_is_enough && self.barrier.is_at_ease() {
            return;
        }
        self.barrier
            .gather_far(&self.stack, &self.borders, &mut self.here);
        self.anchor.find(&mut AnchorTick {
            barrier: &mut self.barrier,
            limits: &self.limits,
            before: &self.step.qd,
            pivots,
        });
    }

    /// The velocity of the mode that the rule chooses.
    fn propose(&mut self, pivots: &mut usize) -> Proposal {
        match &mut self.rule {
            Rule::Search(search) => {
                let active =
                    search.choose(&self.stack, &self.borders, &mut self.here, &mut self.qd);
                if active.is_none() {
                    self.qd.copy_from_slice(self.anchor.velocity());
                }
                Proposal {
                    active,
                    modes_evaluated: search.evaluated(),
                }
            }
            Rule::Nearest(nearest) => {
                let is_limited = self.limits.has_acceleration();
                if is_limited {
                    self.ranges
                        .set(&self.limits, &self.step.qd, self.anchor.velocity());
                }
                let mut tick = NearestTick {
                    stack: &self.stack,
                    evaluation: &mut self.here,
                    barrier: &mut self.barrier,
                    borders: &self.borders,
                    ranges: is_limited.then_some(&self.ranges),
                    pivots,
                };
                Proposal {
                    active: Some(nearest.choose(&mut tick, &mut self.qd)),
                    modes_evaluated: 0,
                }
            }
        }
    }

    /// Brings the velocity within the limits of the joints, if the rule has not. `None` if it asked for
    /// nothing beyond them.
    fn shorten(&mut self) -> Option<Cut> {
        if let (Rule::Nearest(nearest), true) = (&self.rule, self.limits.has_acceleration()) {
            return nearest.cut();
        }
        let (qd, anchor) = (&mut self.qd, self.anchor.velocity());
        let cut = Cut {
            by_speed: self.limits.shorten_to_speed(qd, anchor),
            by_acceleration: self
                .limits
                .shorten_to_acceleration(qd, anchor, &self.step.qd),
        };
        (cut.by_speed.is_some() || cut.by_acceleration.is_some()).then_some(cut)
    }

    /// q_ref = q + T q̇; with border `Land`, after changing q̇ until that is inside every set entered.
    fn arrive(
        &mut self,
        q: &[f64],
        proposal: &Proposal,
        is_shortened: bool,
        pivots: &mut usize,
    ) -> Landed {
        if self.settings.border == Border::Freeze {
            copy(&mut self.q_ref, q);
            add_scaled(&mut self.q_ref, self.period, &self.qd);
            return Landed::default();
        }
        let mut held = match &self.rule {
            Rule::Search(_) => {
                let active = proposal.active.unwrap_or_default();
                self.borders.held(&self.stack, &active, &self.here)
            }
            Rule::Nearest(nearest) => nearest.held(),
        };
        // What moves in from outside is not to be held where it was, nor what is still approached.
        for &(side, _) in &self.barrier.wishes {
            held.remove(self.barrier.sides.get(side));
        }
        let held = held.without(&self.barrier.slowed);
        let mut approach = Approach {
            stack: &self.stack,
            here: &mut self.here,
            there: &mut self.there,
            borders: &self.borders,
            limits: &self.limits,
            before: &self.step.qd,
            anchor: self.anchor.velocity(),
            held: &held,
            pivots,
        };
        self.landing.land(
            &mut approach,
            q,
            is_shortened,
            &mut self.qd,
            &mut self.q_ref,
        )
    }

    fn check(&self, q: &[f64]) -> Result<(), StepError> {
        if q.len() != self.stack.dof() {
            return Err(StepError::WrongLength {
                expected: self.stack.dof(),
                found: q.len(),
            });
        }
        match not_finite(q) {
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
        if self.there.is_at(q) {
            core::mem::swap(&mut self.here, &mut self.there);
        }
        self.here.kinematics_at(q)
    }

    /// The last tick; all zeros before the first.
    pub fn last_step(&self) -> &Step {
        &self.step
    }

    /// Takes over the motion of another controller of the same robot: its last velocity, from which
    /// accelerations are reckoned. Which sets were entered is found anew in the next step.
    ///
    /// # Panics
    /// If the other one's robot has another number of joints.
    pub fn take_over(&mut self, before: &Self) {
        copy(&mut self.step.qd, &before.step.qd);
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
