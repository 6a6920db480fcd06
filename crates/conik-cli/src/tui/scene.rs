//! What the view shows of a run that does not change while it goes on.

use conik::{Goal, Interval, JointKind, ModeOrder, TaskId};
use conik_sim::columns::Columns;
use conik_sim::experiment::Experiment;
use conik_sim::joint_limits::LIMIT;
use conik_sim::scenario::{Choice, GoalConfig, Scenario, TaskConfig, TaskKind};

use crate::figure::quantity::wanted;
use crate::report::units::limit;

/// What there is in a run.
#[derive(Debug)]
pub struct Scene {
    pub(super) title: String,
    /// The robot, and what it is driven as.
    pub(super) robot: String,
    pub(super) rules: String,
    pub(super) duration_s: f64,
    pub(super) last_tick: u64,
    /// In decreasing priority.
    pub(super) tasks: Vec<SceneTask>,
    pub(super) joints: Vec<SceneJoint>,
    pub(super) mode_order: ModeOrder,
    pub(super) waypoints: usize,
}

/// A task, and what is asked of it.
#[derive(Debug)]
pub(super) struct SceneTask {
    pub(super) id: TaskId,
    pub(super) name: String,
    pub(super) unit: &'static str,
    pub(super) role: Role,
    /// `None` of an equality task.
    pub(super) interval: Option<Interval>,
    /// Whether it is brought in while it is outside.
    pub(super) recovers: bool,
    /// Whether it follows a speed, and never arrives.
    pub(super) follows: bool,
    /// What is asked, in words; `None` where it is to visit waypoints.
    pub(super) asked: Option<String>,
    /// Where its value stands among the numbers of a record; of an equality task the norm of its error.
    pub(super) column: Option<usize>,
    /// The title of the group in which it stands with others of its kind.
    pub(super) kind: Option<&'static str>,
}

/// Where a task stands, and of what kind it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    HighPrioritySet,
    Equality,
    LowPrioritySet,
}

/// A joint, and between what it may stand.
#[derive(Debug)]
pub(super) struct SceneJoint {
    pub(super) name: String,
    pub(super) is_revolute: bool,
    pub(super) limits: Option<(f64, f64)>,
}

impl Scene {
    /// Of a run of this scenario on the arm of that description.
    pub fn new(scenario: &Scenario, experiment: &Experiment, arm: &str) -> Self {
        let stack = experiment.controller.stack();
        let control = &scenario.control;
        let robot = scenario.robot.label();
        let names = Columns::new(stack).names(stack);
        let tasks = stack.iter().zip(scenario.all_tasks());
        let tasks = tasks.map(|((id, level), config)| SceneTask {
            id,
            name: level.name().to_owned(),
            unit: level.task().unit(),
            role: match level.goal() {
                Goal::Equality { .. } => Role::Equality,
                Goal::Set { .. } if stack.is_high_priority(id) => Role::HighPrioritySet,
                Goal::Set { .. } => Role::LowPrioritySet,
            },
            interval: level.interval().copied(),
            recovers: matches!(
                level.goal(),
                Goal::Set {
                    recovery: Some(_),
                    ..
                }
            ),
            follows: matches!(config.kind, TaskKind::JointSpeed { .. }),
            asked: asked(&config, level.task().unit()),
            column: {
                let name = match level.interval() {
                    Some(_) => level.name().to_owned(),
                    None => format!("{}_error", level.name()),
                };
                names.iter().position(|other| *other == name)
            },
            kind: kind(scenario, &config),
        });
        let joints = experiment.robot.joints().iter().map(|joint| SceneJoint {
            name: joint.name.clone(),
            is_revolute: joint.kind == JointKind::Revolute,
            limits: joint
                .limits
                .position
                .filter(|(min, max)| min.is_finite() && max.is_finite()),
        });
        Self {
            title: scenario.title.clone().unwrap_or_else(|| robot.to_string()),
            robot: format!("{robot} on {arm}"),
            rules: format!(
                "{} Hz, rule {}, border {}, recursion {}",
                control.rate_hz,
                control.mode_rule.name(),
                control.border.name(),
                control.recursion.name()
            ),
            duration_s: experiment.last_tick as f64 * experiment.period_s(),
            last_tick: experiment.last_tick,
            tasks: tasks.collect(),
            joints: joints.collect(),
            mode_order: experiment.mode_order.clone(),
            waypoints: experiment.waypoint_count(),
        }
    }
}

/// What joints and shapes became stands together, as on the page.
fn kind(scenario: &Scenario, task: &TaskConfig) -> Option<&'static str> {
    let is_pair = || {
        let pair = scenario.between(task);
        pair.is_some_and(|[shape, other]| task.name == format!("{shape}/{other}"))
    };
    if task.name.starts_with(LIMIT) {
        Some("joint limits")
    } else if is_pair() {
        Some("shapes kept apart")
    } else {
        None
    }
}

fn asked(task: &TaskConfig, unit: &str) -> Option<String> {
    match &task.goal {
        GoalConfig::Waypoints { .. } => None,
        GoalConfig::Desired { desired, .. } => {
            let values = || {
                let values = desired.iter().map(|value| limit(*value, unit));
                values.collect::<Vec<_>>().join(", ")
            };
            Some(format!("= {}", wanted(task).unwrap_or_else(values)))
        }
        GoalConfig::Set { min, max, .. } => Some(match (min, max) {
            (Some(min), Some(max)) => format!("{} … {}", limit(*min, "-"), limit(*max, unit)),
            (Some(min), None) => format!("≥ {}", limit(*min, unit)),
            (None, Some(max)) => format!("≤ {}", limit(*max, unit)),
            (None, None) => "anything".to_owned(),
        }),
    }
}
