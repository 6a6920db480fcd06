//! What there is in a run: the robot, the shapes, the tasks in priority order.

use conik::{Goal, Level};
use conik_sim::experiment::{Experiment, ExperimentError};
use conik_sim::scenario::{Border, LinkShape, ModeRule, Obstacle, Recursion, Scenario, TaskConfig};
use conik_sim::summary::{Outcome, Properties, StepTime, Summary};
use serde::Serialize;

use super::PROTOCOL;
use super::robot::RobotTree;

/// What there is, once; and again after every change of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    kind: &'static str,
    protocol: u32,
    title: Option<String>,
    /// Whether ticks are still coming.
    live: bool,
    /// Whether whoever watches may change anything.
    editable: bool,
    /// The arm that is driven: `ideal`, `emulator`, or a host.
    arm: String,
    rate_hz: f64,
    duration_s: f64,
    settings: Settings,
    /// `None` where whoever reads it has it.
    robot: Option<RobotTree>,
    /// Shapes on links, as in the scenario.
    shapes: Vec<LinkShape>,
    /// Shapes in the world, as in the scenario.
    obstacles: Vec<Obstacle>,
    /// In decreasing priority.
    tasks: Vec<SceneTask>,
    /// What became of it; `None` while nobody knows.
    result: Option<RunResult>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Settings {
    mode_rule: ModeRule,
    border: Border,
    recursion: Recursion,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct SceneTask {
    role: Role,
    unit: &'static str,
    /// Column of its value; `None` of a task of several components.
    value: Option<String>,
    /// Column of the norm of its error; `None` of a set.
    error: Option<String>,
    /// The shape and the obstacle, or the two shapes, that it keeps apart.
    between: Option<[String; 2]>,
    /// The task's own keys, as in the scenario.
    #[serde(flatten)]
    config: TaskConfig,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
enum Role {
    #[serde(rename = "high-priority set")]
    HighPrioritySet,
    #[serde(rename = "equality")]
    Equality,
    #[serde(rename = "low-priority set")]
    LowPrioritySet,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct RunResult {
    outcome: Outcome,
    ended_at_s: f64,
    waypoints_reached_s: Vec<Option<f64>>,
    properties: Properties,
    step_time_us: StepTime,
    deadline_misses: u64,
}

impl Scene {
    /// The scene of a run that is over.
    pub fn of_run(summary: &Summary) -> Result<Self, ExperimentError> {
        let scenario = &summary.settings.scenario;
        // A summary from before the first tick knows nothing of the end.
        let result = (summary.outcome != Outcome::Running).then(|| RunResult {
            outcome: summary.outcome.clone(),
            ended_at_s: summary.ended_at_s,
            waypoints_reached_s: summary.waypoints_reached_s.clone(),
            properties: summary.properties.clone(),
            step_time_us: summary.step_time_us,
            deadline_misses: summary.deadline_misses,
        });
        Ok(Self {
            result,
            ..Self::new(scenario, &summary.settings.robot)?
        })
    }

    /// The scene of a run that goes on.
    pub(super) fn live(
        scenario: &Scenario,
        arm: &str,
        is_editable: bool,
    ) -> Result<Self, ExperimentError> {
        Ok(Self {
            live: true,
            editable: is_editable,
            ..Self::new(scenario, arm)?
        })
    }

    /// The same, for those who have the robot.
    pub(super) fn without_robot(&self) -> Self {
        Self {
            robot: None,
            ..self.clone()
        }
    }

    pub(super) fn new(scenario: &Scenario, arm: &str) -> Result<Self, ExperimentError> {
        let experiment = Experiment::new(scenario)?;
        let stack = experiment.controller.stack();
        let configs = scenario.all_tasks();
        let mut is_below = false;
        let tasks = stack.iter().zip(configs).map(|((_, level), config)| {
            let role = role(level, is_below);
            is_below |= role == Role::Equality;
            SceneTask {
                between: scenario.between(&config),
                ..SceneTask::new(level, role, config)
            }
        });
        Ok(Self {
            kind: "scene",
            protocol: PROTOCOL,
            title: scenario.title.clone(),
            live: false,
            editable: false,
            arm: arm.to_owned(),
            rate_hz: scenario.control.rate_hz,
            duration_s: scenario.control.duration_s,
            settings: Settings {
                mode_rule: scenario.control.mode_rule,
                border: scenario.control.border,
                recursion: scenario.control.recursion,
            },
            robot: Some(RobotTree::of(&experiment.robot)),
            shapes: scenario.collision.shapes.clone(),
            obstacles: scenario.collision.obstacles.clone(),
            tasks: tasks.collect(),
            result: None,
        })
    }
}

fn role(level: &Level, is_below: bool) -> Role {
    match level.goal() {
        Goal::Equality { .. } => Role::Equality,
        Goal::Set { .. } if is_below => Role::LowPrioritySet,
        Goal::Set { .. } => Role::HighPrioritySet,
    }
}

impl SceneTask {
    fn new(level: &Level, role: Role, config: TaskConfig) -> Self {
        let name = level.name();
        Self {
            role,
            unit: level.task().unit(),
            value: (level.task().dimension() == 1).then(|| name.to_owned()),
            error: (role == Role::Equality).then(|| format!("{name}_error")),
            between: None,
            config,
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn scene(text: &str) -> Value {
        let scenario = Scenario::from_toml(text).unwrap();
        serde_json::to_value(Scene::new(&scenario, "ideal").unwrap()).unwrap()
    }

    const SHELF: &str = include_str!("../../../../scenarios/gallery/shelf.toml");
    const VIEW: &str = include_str!("../../../../scenarios/gallery/low-priority-view.toml");

    #[test]
    fn tasks_come_with_their_role_their_columns_and_their_keys() {
        let scene = scene(VIEW);
        let tasks = scene["tasks"].as_array().unwrap();
        let named = |name| tasks.iter().find(|task| task["name"] == name).unwrap();
        let position = named("position");
        assert_eq!(position["role"], "equality");
        assert_eq!(position["unit"], "m");
        assert_eq!(position["value"], Value::Null);
        assert_eq!(position["error"], "position_error");
        assert!(position["waypoints_m"][0][2].is_f64());
        let view = named("view");
        assert_eq!(view["role"], "low-priority set");
        assert_eq!(view["type"], "field_of_view");
        assert_eq!(view["value"], "view");
        assert_eq!(view["error"], Value::Null);
        assert!(view["max"].is_f64() && view["direction"][0].is_number());
    }

    #[test]
    fn pairs_of_shapes_say_which_two_they_keep_apart() {
        let scene = scene(SHELF);
        let tasks = scene["tasks"].as_array().unwrap();
        let named = |name| tasks.iter().find(|task| task["name"] == name).unwrap();
        assert_eq!(named("forearm/post")["between"], json!(["forearm", "post"]));
        assert_eq!(
            named("upper_arm/hand")["between"],
            json!(["upper_arm", "hand"])
        );
        assert_eq!(named("position")["between"], Value::Null);
        assert_eq!(named("limit/elbow_joint")["role"], "high-priority set");
        assert_eq!(scene["obstacles"][0]["type"], "half_space");
        assert_eq!(scene["shapes"][0]["link"], "link_2");
    }

    #[test]
    fn distance_of_two_shapes_names_them_whatever_it_is_called() {
        let task = "[[task]]\nname = \"gap\"\ntype = \"shape_distance\"\nshapes = [\"hand\", \"post\"]\nmin = 0.05\n";
        let scene = scene(&SHELF.replacen("[[task]]", &format!("{task}\n[[task]]"), 1));
        let mut tasks = scene["tasks"].as_array().unwrap().iter();
        let gap = tasks.find(|task| task["name"] == "gap").unwrap();
        assert_eq!(gap["between"], json!(["hand", "post"]));
        assert_eq!(gap["min"], json!(0.05));
    }
}
