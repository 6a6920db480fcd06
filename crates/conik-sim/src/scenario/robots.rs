//! The robots that a scenario may name, and what its reader must know of them.

use std::sync::LazyLock;

use conik::{JointKind, Robot};

/// What the reader of a scenario must know of a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RobotFacts {
    /// Name in the file.
    pub name: String,
    /// Names of the joints, base to tool.
    pub joint_names: Vec<String>,
    /// Of each joint, whether it slides and has its positions in [m].
    pub slides: Vec<bool>,
    /// Names of the links.
    pub link_names: Vec<String>,
    /// How many of the joints have position limits, unless a scenario overrides them.
    pub position_limits: usize,
}

static KNOWN: LazyLock<Vec<RobotFacts>> = LazyLock::new(|| {
    Robot::builtin_names()
        .iter()
        .filter_map(|name| Robot::builtin(name).ok())
        .map(|robot| RobotFacts::of(&robot, robot.name()))
        .collect()
});

impl RobotFacts {
    /// The facts of a robot that is called `name` in the file.
    pub(super) fn of(robot: &Robot, name: &str) -> Self {
        let joints = robot.joints();
        Self {
            name: name.to_owned(),
            joint_names: robot.joint_names().map(str::to_owned).collect(),
            link_names: robot.link_names().map(str::to_owned).collect(),
            slides: joints
                .iter()
                .map(|joint| joint.kind == JointKind::Prismatic)
                .collect(),
            position_limits: joints
                .iter()
                .filter(|joint| joint.limits.position.is_some())
                .count(),
        }
    }
}

/// Every robot that a scenario may name as its model.
pub fn known_robots() -> &'static [RobotFacts] {
    &KNOWN
}
