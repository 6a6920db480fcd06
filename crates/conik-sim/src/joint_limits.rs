//! Limits of the joints: those of the model or of the scenario, and the sets that keep the positions.

use conik::Robot;

use crate::scenario::{
    Damping, DescriptionError, Frames, GoalConfig, LimitsConfig, Motion, RobotConfig, Scenario,
    TaskConfig, TaskKind,
};

/// How the names of the sets begin that keep the joints within their position limits.
pub const LIMIT: &str = "limit/";

impl Scenario {
    /// Every task that the controller has, the most important first: the sets that keep the joints'
    /// position limits and those that keep shapes apart, which no scenario lists, then those of the
    /// scenario, with the shapes that they name in the place of the names.
    pub fn all_tasks(&self) -> Vec<TaskConfig> {
        let robot = limited_robot(&self.robot).ok();
        let joints = robot.iter().flat_map(Robot::joints).enumerate();
        let limits = joints.filter_map(|(index, joint)| {
            let (min, max) = joint.limits.position?;
            Some(TaskConfig {
                name: format!("{LIMIT}{}", joint.name),
                kind: TaskKind::Joint { joint: index + 1 },
                frames: Frames::default(),
                motion: Motion::default(),
                goal: GoalConfig::Set {
                    min: min.is_finite().then_some(min),
                    max: max.is_finite().then_some(max),
                    recovery_per_s: None,
                    gain_per_s: None,
                },
                damping: Damping::default(),
            })
        });
        let pairs = robot.iter().flat_map(|robot| self.collision.tasks(robot));
        limits
            .chain(pairs)
            .chain(self.tasks.iter().map(|task| {
                let named = robot
                    .as_ref()
                    .map(|it| self.collision.with_shapes(task, it));
                named.and_then(Result::ok).unwrap_or_else(|| task.clone())
            }))
            .collect()
    }
}

impl RobotConfig {
    /// The robot that controllers are made for, with the limits that are given here in the place of its own.
    ///
    /// # Errors
    ///
    /// If there is no such robot, or it cannot be placed or limited so.
    pub fn limited(&self) -> Result<Robot, DescriptionError> {
        limited_robot(self)
    }
}

/// The model, with the scenario's limits in the place of its own.
pub(crate) fn limited_robot(config: &RobotConfig) -> Result<Robot, DescriptionError> {
    let model = config.described()?;
    let LimitsConfig {
        position_limits_rad,
        speed_limits_rad_per_s,
        acceleration_limits_rad_per_s2,
    } = &config.limits;
    let limited = model.with_limits(|index, joint| {
        let mut limits = joint.limits;
        if let Some(positions) = position_limits_rad {
            let pair = positions.get(index).copied().flatten();
            limits.position = pair.map(|[min, max]| (min, max));
        }
        if let Some(speeds) = speed_limits_rad_per_s {
            limits.speed = speeds.get(index).copied();
        }
        if let Some(accelerations) = acceleration_limits_rad_per_s2 {
            limits.acceleration = accelerations.get(index).copied();
        }
        limits
    })?;
    Ok(limited)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Experiment;

    const SCENARIO: &str = r#"
        [robot]
        model = "ur5-paper"
        q0_rad = [0, 0.5, 1, 0, 0, 0]
        position_limits_deg = [[-90, 90], [], [-180, 180], [], [], []]
        speed_limits_deg_per_s = 90
        acceleration_limits_rad_per_s2 = [1, 2, 3, 4, 5, 6]
        [[task]]
        name = "ball"
        type = "distance"
        point_m = [1, 0, 0]
        min = 0.1
    "#;

    #[test]
    fn scenario_s_limits_stand_in_the_place_of_the_model_s() {
        let scenario = Scenario::from_toml(SCENARIO).expect("it is right");
        let robot = limited_robot(&scenario.robot).expect("it is right");
        let limits: Vec<_> = robot.joints().iter().map(|joint| joint.limits).collect();
        let turn = std::f64::consts::PI;
        assert_eq!(limits[0].position, Some((-turn / 2.0, turn / 2.0)));
        assert_eq!(limits[1].position, None);
        assert!(limits.iter().all(|limits| limits.speed == Some(turn / 2.0)));
        assert_eq!(limits[5].acceleration, Some(6.0));
        let model = Robot::builtin("ur5-paper").expect("built in");
        let bare = SCENARIO.lines().filter(|line| !line.contains("limits"));
        let bare = Scenario::from_toml(&bare.collect::<Vec<_>>().join("\n")).expect("right");
        assert_eq!(limited_robot(&bare.robot).expect("right"), model);
    }

    #[test]
    fn all_tasks_are_those_of_the_controller() {
        let scenario = Scenario::from_toml(SCENARIO).expect("it is right");
        let experiment = Experiment::new(&scenario).expect("it is right");
        let stack = experiment.controller.stack();
        let tasks = scenario.all_tasks();
        assert_eq!(tasks.len(), 3);
        for ((_, level), task) in stack.iter().zip(&tasks) {
            assert_eq!(level.name(), task.name);
            let interval = level.interval().expect("sets only");
            let GoalConfig::Set { min, max, .. } = task.goal else {
                panic!("{} is a set", task.name);
            };
            assert_eq!(interval.min, min.unwrap_or(f64::NEG_INFINITY));
            assert_eq!(interval.max, max.unwrap_or(f64::INFINITY));
        }
        assert_eq!(stack.len(), tasks.len());
    }
}
