//! The robots that a scenario may name, and what its reader must know of them.

/// What the reader of a scenario must know of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RobotFacts {
    /// Name in the file.
    pub name: &'static str,
    /// Names of the movable joints, base to tool.
    pub joint_names: &'static [&'static str],
}

/// Every robot that a scenario may name.
pub fn known_robots() -> &'static [RobotFacts] {
    &[RobotFacts {
        name: "ur5-paper",
        joint_names: &[
            "shoulder_pan_joint",
            "shoulder_lift_joint",
            "elbow_joint",
            "wrist_1_joint",
            "wrist_2_joint",
            "wrist_3_joint",
        ],
    }]
}
