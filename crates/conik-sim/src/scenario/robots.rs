//! The robots that a scenario may name, and what its reader must know of them.

use std::sync::LazyLock;

use conik::Robot;

/// What the reader of a scenario must know of a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotFacts {
    /// Name in the file.
    pub name: String,
    /// Names of the joints, base to tool.
    pub joint_names: Vec<String>,
    /// How many of the joints have position limits, unless a scenario overrides them.
    pub position_limits: usize,
}

static KNOWN: LazyLock<Vec<RobotFacts>> = LazyLock::new(|| {
    Robot::builtin_names()
        .iter()
        .filter_map(|name| Robot::builtin(name).ok())
        .map(|robot| RobotFacts {
            name: robot.name().to_owned(),
            joint_names: robot.joint_names().map(str::to_owned).collect(),
            position_limits: robot
                .joints()
                .iter()
                .filter(|joint| joint.limits.position.is_some())
                .count(),
        })
        .collect()
});

/// Every robot that a scenario may name.
pub fn known_robots() -> &'static [RobotFacts] {
    &KNOWN
}
