//! Running one case, and what becomes of it. Nothing is logged: a run costs its controller's steps and little more.

use conik::{ActiveSet, Goal, JointVec, Monitor, PROPERTY_TOLERANCE, Reason, StackError, TaskId};
use conik_sim::announced::Announcements;
use conik_sim::experiment::{Experiment, ExperimentError};
use conik_sim::scenario::DescriptionError;
use conik_sim::servo::{BadServoModel, Servo, ServoModel};

use crate::case::Case;
use crate::class::{Class, of_rest};
use crate::row::Row;

/// An equality task without waypoints counts as done when its error is at most this [task's unit].
pub const DONE: f64 = 1e-3;
/// Joint speeds below this are none [rad/s or m/s].
const STILL: f64 = 1e-4;
/// Over so long it is looked whether the arm rests, and whether an error falls [s].
const LOOK_BACK_S: f64 = 2.0;
/// An error that has fallen by this share since then is still falling.
const FALLS: f64 = 1e-3;
/// Gain of the simulated servo [1/s²]: stiff, so that it lags by its lookahead.
const SERVO_GAIN: f64 = 2000.0;
/// Largest acceleration of its joints [rad/s²].
const SERVO_ACCELERATION: f64 = 40.0;
/// Largest speed where a joint has no limit [rad/s].
const SERVO_SPEED: f64 = std::f64::consts::PI;

/// A case that cannot be run. One of a scenario that was read can be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// The scenario cannot be made ready.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// There is no such robot.
    #[error(transparent)]
    Robot(#[from] DescriptionError),
    /// The servo makes no sense.
    #[error(transparent)]
    Servo(#[from] BadServoModel),
    /// What moves has left all numbers.
    #[error(transparent)]
    Moves(#[from] StackError),
}

/// Runs it to its end.
///
/// # Errors
///
/// If it cannot be run at all. What goes wrong on the way is in the row.
pub fn row(case: &Case) -> Result<Row, CaseError> {
    let mut flight = Flight::of(case)?;
    let outcome = flight.run()?;
    Ok(flight.row(case, outcome))
}

struct Flight {
    experiment: Experiment,
    monitor: Monitor,
    /// With border `land`, which announces.
    announced: Option<Announcements>,
    measured: Option<Measured>,
    q: JointVec,
    mode_changes: u64,
    reached: u64,
    arrived_s: Option<f64>,
    ended_at_s: f64,
    /// Largest joint speed since the look back began.
    fastest: f64,
    /// Whether the velocity was shortened for a speed limit in every tick since then.
    is_always_shortened: bool,
    /// Errors of the equality tasks when it began, and how many waypoints had been reached.
    errors_before: Vec<f64>,
    reached_before: u64,
    went_outside: bool,
    /// In how many ticks since the look back began, and of how many, a set strictly inside was held.
    frozen_inside: u64,
    looked_at: u64,
}

/// The arm behind its reference.
struct Measured {
    servo: Servo,
    kinematics: conik::Kinematics,
    violations: Vec<f64>,
    /// Sets that the arm has entered.
    entered: ActiveSet,
}

impl Flight {
    fn of(case: &Case) -> Result<Self, CaseError> {
        let experiment = Experiment::new(&case.scenario)?;
        let stack = experiment.controller.stack();
        let measured = case.servo_lag_s.map(|lookahead_s| {
            let mut speeds = JointVec::zeros(experiment.robot.dof());
            for (speed, joint) in speeds.iter_mut().zip(experiment.robot.joints()) {
                *speed = joint.limits.speed.unwrap_or(SERVO_SPEED);
            }
            let model = ServoModel {
                lookahead_s,
                gain_per_s2: SERVO_GAIN,
                acceleration_limit: SERVO_ACCELERATION,
            };
            Ok::<_, BadServoModel>(Measured {
                servo: Servo::at_rest(model, speeds, experiment.q0)?,
                kinematics: conik::Kinematics::new(&experiment.robot),
                violations: vec![0.0; stack.len()],
                entered: ActiveSet::EMPTY,
            })
        });
        Ok(Self {
            monitor: Monitor::new(stack),
            announced: (experiment.controller.settings().border == conik::Border::Land)
                .then(|| Announcements::new(stack)),
            measured: measured.transpose()?,
            q: experiment.q0,
            mode_changes: 0,
            reached: 0,
            arrived_s: None,
            ended_at_s: 0.0,
            fastest: 0.0,
            is_always_shortened: true,
            errors_before: Vec::new(),
            reached_before: 0,
            went_outside: false,
            frozen_inside: 0,
            looked_at: 0,
            experiment,
        })
    }

    /// `completed`, or the name of a fault.
    fn run(&mut self) -> Result<&'static str, CaseError> {
        let rate_hz = self.experiment.controller.settings().rate_hz;
        let last = self.experiment.last_tick;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few seconds"
        )]
        let look_from = last.saturating_sub((LOOK_BACK_S * rate_hz) as u64);
        let mut active = None;
        for tick in 0..=last {
            let t_s = tick as f64 / rate_hz;
            self.experiment.move_world(t_s)?;
            self.visit(t_s)?;
            let controller = &mut self.experiment.controller;
            if controller.step(&self.q).is_err() {
                return Ok("no-reference");
            }
            controller.measure();
            let step = controller.last_step();
            self.monitor
                .observe_properties(controller.stack(), step, t_s);
            if let Some(announced) = &mut self.announced {
                announced.observe(controller.stack(), step, t_s);
            }
            self.went_outside |= step.landed.outside.is_some();
            self.mode_changes += u64::from(active.is_some_and(|active| active != step.active));
            active = Some(step.active);
            if let Some(measured) = &mut self.measured {
                measured.observe(&self.experiment);
                measured.servo.follow(&self.q, 1.0 / rate_hz);
            }
            if tick == look_from {
                self.errors_before = self.errors();
                self.reached_before = self.reached;
            }
            let step = self.experiment.controller.last_step();
            if tick >= look_from {
                let fastest = step.qd.largest().map_or(0.0, |(_, speed)| speed);
                self.fastest = self.fastest.max(fastest);
                self.is_always_shortened &= step.speed_limit.is_some();
                let is_inside = |reason: &Reason| matches!(reason, Reason::HoldsInside { .. });
                self.frozen_inside += u64::from(step.reasons().iter().any(is_inside));
                self.looked_at += 1;
            }
            self.ended_at_s = t_s;
            if tick < last {
                self.q = step.q_ref;
            }
        }
        Ok("completed")
    }

    fn visit(&mut self, t_s: f64) -> Result<(), StackError> {
        let Some(visits) = &mut self.experiment.waypoints else {
            return Ok(());
        };
        let controller = &mut self.experiment.controller;
        let pose = visits.pose(controller.kinematics_at(&self.q));
        if let Some(reached) = visits.advance(&pose, &mut controller.setpoints())? {
            self.reached = reached as u64 + 1;
            self.arrived_s = (reached + 1 == visits.count()).then_some(t_s);
        }
        Ok(())
    }

    /// Errors of the equality tasks, in the order of the stack.
    fn errors(&self) -> Vec<f64> {
        let controller = &self.experiment.controller;
        let equalities = controller
            .stack()
            .iter()
            .filter(|(_, level)| level.interval().is_none());
        equalities
            .map(|(id, _)| controller.last_step().error_norm(id))
            .collect()
    }

    fn row(self, case: &Case, outcome: &'static str) -> Row {
        let controller = &self.experiment.controller;
        let stack = controller.stack();
        let properties = self.monitor.properties(stack);
        let sets = stack.iter().filter(|(_, level)| level.interval().is_some());
        let sets: Vec<TaskId> = sets.map(|(id, _)| id).collect();
        let high = |id: &TaskId| stack.is_high_priority(*id);
        let began_inside = |id: &TaskId| self.monitor.history(*id).entered_s == Some(0.0);
        let entered = |id: &TaskId| self.monitor.history(*id).entered_s.is_some();
        let shown = [
            stack.iter().any(|(_, level)| level.interval().is_none()),
            sets.iter().any(|id| high(id) && began_inside(id)),
            sets.iter().any(|id| high(id) && !began_inside(id)),
            sets.iter()
                .any(|id| high(id) && !began_inside(id) && entered(id)),
            sets.iter().any(|id| !high(id)),
        ];
        let failing = self.failing();
        let worst = [
            properties.equality_converges.worst,
            properties.inside_stays.worst,
            properties.outside_never_worse.worst,
            properties.entered_stays.worst,
            properties.low_priority_excess.worst,
        ];
        let holds = |nth: usize| {
            let is_kept = if nth == 0 {
                failing.is_none()
            } else {
                worst[nth] <= PROPERTY_TOLERANCE
            };
            shown[nth].then_some(is_kept)
        };
        let kept = [0, 1, 2, 3, 4].map(holds);
        let measured_violations = self.measured.as_ref().map(|measured| {
            let violations = sets.iter().map(|id| measured.violations[id.index()]);
            violations.collect::<Vec<f64>>()
        });
        let class = if outcome == "completed" {
            self.class(kept, failing, measured_violations.as_deref())
        } else {
            Class::Fault
        };
        Row {
            run: case.run,
            q0: case.scenario.robot.q0_rad.clone(),
            rate_hz: case.scenario.control.rate_hz,
            servo_lag_s: case.servo_lag_s,
            outcome: outcome.to_owned(),
            ended_at_s: self.ended_at_s,
            waypoints_reached: self.reached,
            arrived_s: self.arrived_s,
            mode_changes: self.mode_changes,
            violations: sets
                .iter()
                .map(|id| self.monitor.history(*id).worst_violation)
                .collect(),
            errors: self.errors(),
            measured_violations,
            kept,
            worst,
            class,
        }
    }

    /// The first equality task that did not come to what it was asked.
    fn failing(&self) -> Option<TaskId> {
        let controller = &self.experiment.controller;
        let step = controller.last_step();
        let mut equalities = controller
            .stack()
            .iter()
            .filter(|(_, level)| level.interval().is_none());
        let visits = self.experiment.waypoints.as_ref();
        let fails = |id: TaskId| match visits.filter(|visits| visits.task == id) {
            Some(visits) => self.reached < visits.count() as u64,
            None => step.error_norm(id) > DONE,
        };
        equalities.find(|(id, _)| fails(*id)).map(|(id, _)| id)
    }

    fn class(
        &self,
        kept: [Option<bool>; 5],
        failing: Option<TaskId>,
        measured: Option<&[f64]>,
    ) -> Class {
        let controller = &self.experiment.controller;
        let is_broken = |nth: usize| kept[nth] == Some(false);
        if (1..4).any(is_broken) {
            return match &self.announced {
                None => Class::Freeze,
                Some(announced) if self.went_outside && announced.unannounced().ticks == 0 => {
                    Class::Announced
                }
                Some(_) => Class::Unexplained,
            };
        }
        let Some(failing) = failing else {
            let outside = |violation: &f64| *violation > DONE;
            let lags = measured.is_some_and(|violations| violations.iter().any(outside));
            return if lags { Class::ServoLag } else { Class::None };
        };
        if self.is_outside_at_the_end() {
            return Class::ConflictOfSets;
        }
        if self.fastest >= STILL && self.falls(failing) {
            return Class::OnItsWay;
        }
        let rests = of_rest(&self.experiment.robot, controller, failing, &self.q);
        rests.unwrap_or(
            // Held only now and then, a set holds up nothing.
            if 2 * self.frozen_inside > self.looked_at {
                Class::FrozenInside
            } else if self.is_always_shortened {
                Class::SpeedLimit
            } else {
                Class::Unexplained
            },
        )
    }

    /// Whether a set of high priority was never entered.
    fn is_outside_at_the_end(&self) -> bool {
        let stack = self.experiment.controller.stack();
        let mut sets = stack.iter().filter(|(id, level)| {
            matches!(level.goal(), Goal::Set { .. }) && stack.is_high_priority(*id)
        });
        sets.any(|(id, _)| self.monitor.history(id).entered_s.is_none())
    }

    /// Whether the error of a task was still falling, or is one to another waypoint than it was.
    fn falls(&self, task: TaskId) -> bool {
        let visits = self.experiment.waypoints.as_ref();
        if visits.is_some_and(|visits| visits.task == task) && self.reached > self.reached_before {
            return true;
        }
        let stack = self.experiment.controller.stack();
        let equalities = stack.iter().filter(|(_, level)| level.interval().is_none());
        let errors = self.errors_before.iter().zip(self.errors());
        equalities
            .zip(errors)
            .find(|((id, _), _)| *id == task)
            .is_some_and(|(_, (before, now))| now < before * (1.0 - FALLS))
    }
}

impl Measured {
    /// Notes where the arm is against every set.
    fn observe(&mut self, experiment: &Experiment) {
        self.kinematics.update(self.servo.q());
        for (id, level) in experiment.controller.stack().iter() {
            if let Some(interval) = level.interval() {
                let mut value = [0.0];
                level.task().value(&self.kinematics, &mut value);
                let violation = interval.violation(value[0]);
                if violation <= 0.0 {
                    self.entered.insert(id);
                }
                if self.entered.contains(id) {
                    let worst = &mut self.violations[id.index()];
                    *worst = worst.max(violation);
                }
            }
        }
    }
}
