//! From a scenario to the objects that run it: robot, controller, waypoints.

use conik::{
    Controller, ControllerError, JointVec, ModeOrder, Robot, Settings, Stack, StackError, TaskId,
    TooManyJoints,
};

use crate::joint_limits::limited_robot;
use crate::measured::add_task;
use crate::mover::Mover;
use crate::named_shapes::NoPair;
use crate::scenario::{
    Border, Control, Damping, DampingRule, DescriptionError, GoalConfig, ModeRule, Recursion,
    Scenario, TaskConfig,
};
use crate::visits::Visits;

/// A scenario made ready to run.
#[derive(Debug)]
pub struct Experiment {
    /// The robot.
    pub robot: Robot,
    /// The controller with the scenario's tasks.
    pub controller: Controller,
    /// Numbers of the modes.
    pub mode_order: ModeOrder,
    /// The task that visits waypoints, and those.
    pub waypoints: Option<Visits>,
    /// What moves besides the robot.
    pub movers: Vec<Mover>,
    /// Joint positions at the start [rad].
    pub q0: JointVec,
    /// Whether the run begins where the arm stands, wherever that is.
    pub from_here: bool,
    /// Index of the last tick: the run has one more tick than this.
    pub last_tick: u64,
}

/// Why a scenario cannot be run. A scenario that was read from a file was checked for all of these.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExperimentError {
    /// The robot is unknown or unusable.
    #[error(transparent)]
    Robot(#[from] DescriptionError),
    /// The start has too many joints.
    #[error(transparent)]
    Start(#[from] TooManyJoints),
    /// A task does not fit.
    #[error(transparent)]
    Stack(#[from] StackError),
    /// The controller cannot be made.
    #[error(transparent)]
    Controller(#[from] ControllerError),
    /// A name in `exclusive` is no task's.
    #[error("`exclusive` names `{0}`, which is no task")]
    UnknownTask(String),
    /// A task names a link that the robot does not have.
    #[error("the robot has no link `{0}`")]
    UnknownLink(String),
    /// A task names shapes between which it can measure no distance.
    #[error("task `{0}`: {1}")]
    Shapes(String, NoPair),
    /// Waypoints without points.
    #[error("task `{0}` has no waypoints")]
    NoWaypoints(String),
}

impl Experiment {
    /// Makes a scenario ready to run.
    pub fn new(scenario: &Scenario) -> Result<Self, ExperimentError> {
        Self::with_movers(scenario, Mover::of, |_, _| None)
    }

    /// The same, with tasks that no scenario has: for each task of the scenario `own` is asked, and what it
    /// adds stands in its place.
    pub fn with_own(
        scenario: &Scenario,
        own: impl FnMut(&mut Stack, &TaskConfig) -> Option<Result<TaskId, StackError>>,
    ) -> Result<Self, ExperimentError> {
        Self::with_movers(scenario, Mover::of, own)
    }

    /// The same, of which anything may be moved while it runs.
    pub fn changeable(scenario: &Scenario) -> Result<Self, ExperimentError> {
        let any = |task, config: &TaskConfig| Some(Mover::of_any(task, config));
        Self::with_movers(scenario, any, |_, _| None)
    }

    fn with_movers(
        scenario: &Scenario,
        mover: impl Fn(TaskId, &TaskConfig) -> Option<Mover>,
        mut own: impl FnMut(&mut Stack, &TaskConfig) -> Option<Result<TaskId, StackError>>,
    ) -> Result<Self, ExperimentError> {
        let robot = limited_robot(&scenario.robot)?;
        let mut stack = Stack::new(&robot);
        let mut waypoints = None;
        let mut movers = Vec::new();
        let mut tasks = scenario.collision.tasks(&robot);
        for task in &scenario.tasks {
            let named = scenario.collision.with_shapes(task, &robot);
            tasks.push(named.map_err(|it| ExperimentError::Shapes(task.name.clone(), it))?);
        }
        for task in &tasks {
            let id = match own(&mut stack, task) {
                Some(added) => added?,
                None => add_task(&mut stack, &robot, task)?,
            };
            movers.extend(mover(id, task));
            stack.setpoints().set_damping(id, damping(task.damping))?;
            if let GoalConfig::Set {
                recovery_per_s: Some(speed),
                ..
            } = task.goal
            {
                stack.setpoints().set_recovery(id, Some(speed))?;
            }
            waypoints = Visits::of(id, task, &robot)?.or(waypoints);
        }
        for group in &scenario.control.exclusive {
            let ids = group
                .iter()
                .map(|name| {
                    stack
                        .find(name)
                        .ok_or_else(|| ExperimentError::UnknownTask(name.clone()))
                })
                .collect::<Result<Vec<_>, _>>()?;
            stack.exclude_together(&ids)?;
        }
        Ok(Self {
            mode_order: ModeOrder::new(&stack),
            controller: Controller::new(&robot, stack, settings(&scenario.control))?,
            waypoints,
            movers,
            q0: JointVec::from_slice(&scenario.robot.q0_rad)?,
            from_here: false,
            last_tick: scenario.control.last_tick(),
            robot,
        })
    }
}

impl Experiment {
    /// How many waypoints there are to reach.
    pub fn waypoint_count(&self) -> usize {
        self.waypoints.as_ref().map_or(0, Visits::count)
    }

    /// The control period [s].
    pub fn period_s(&self) -> f64 {
        1.0 / self.controller.settings().rate_hz
    }

    /// Tells the controller where what moves is at `t_s` [s], and how it moves on; before every tick.
    ///
    /// # Errors
    ///
    /// If a desired value has moved beyond all numbers, which none of a scenario that was checked does.
    pub fn move_world(&mut self, t_s: f64) -> Result<(), StackError> {
        let period_s = self.period_s();
        let mut movers = self.movers.iter_mut();
        movers.try_for_each(|mover| mover.tell(&mut self.controller.setpoints(), t_s, period_s))
    }
}

impl Control {
    /// Index of the tick at the end of the run: tick k is at t = k / rate.
    pub fn last_tick(&self) -> u64 {
        // Checked by the reader: positive, and far below 2^53 ticks.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let last = (self.duration_s * self.rate_hz + 1e-9).floor() as u64;
        last
    }
}

fn settings(control: &Control) -> Settings {
    Settings {
        rate_hz: control.rate_hz,
        mode_rule: match control.mode_rule {
            ModeRule::Paper => conik::ModeRule::Paper,
            ModeRule::Border => conik::ModeRule::Border,
            ModeRule::Cone => conik::ModeRule::Cone,
        },
        border: match control.border {
            Border::Freeze => conik::Border::Freeze,
            Border::Land => conik::Border::Land,
        },
        recursion: match control.recursion {
            Recursion::Chiaverini => conik::Recursion::Chiaverini,
            Recursion::SicilianoSlotine => conik::Recursion::SicilianoSlotine,
        },
    }
}

fn damping(config: Damping) -> conik::Damping {
    match config {
        Damping::Rule(DampingRule::Automatic) => conik::Damping::Automatic,
        Damping::Rule(DampingRule::None) => conik::Damping::None,
        Damping::Rule(DampingRule::Smallest) => conik::Damping::Smallest,
        Damping::Rule(DampingRule::PerDirection) => conik::Damping::PerDirection,
        Damping::Fixed(lambda) => conik::Damping::Fixed(lambda),
    }
}
