//! The robots that need no file.

use alloc::string::ToString;
use core::f64::consts::{FRAC_PI_2, PI};

use super::{DhConvention, DhRow, Joint, JointKind, JointLimits, Robot, RobotError};

/// A built-in robot as a table.
struct Table {
    name: &'static str,
    joints: &'static [(&'static str, DhRow)],
    speed_limit: f64,
}

/// The UR5 of the paper: Table I, lengths rounded to millimetres as printed there. Joint speeds up
/// to 180°/s, as in the maker's data sheet; no position or acceleration limits.
const UR5_PAPER: Table = Table {
    name: "ur5-paper",
    joints: &[
        ("shoulder_pan_joint", DhRow::new(0.0, FRAC_PI_2, 0.089)),
        ("shoulder_lift_joint", DhRow::new(-0.425, 0.0, 0.0)),
        ("elbow_joint", DhRow::new(-0.392, 0.0, 0.0)),
        ("wrist_1_joint", DhRow::new(0.0, FRAC_PI_2, 0.109)),
        ("wrist_2_joint", DhRow::new(0.0, -FRAC_PI_2, 0.095)),
        ("wrist_3_joint", DhRow::new(0.0, 0.0, 0.082)),
    ],
    speed_limit: PI,
};

const TABLES: [&Table; 1] = [&UR5_PAPER];

impl Robot {
    /// A built-in robot by its name.
    pub fn builtin(name: &str) -> Result<Self, RobotError> {
        let table = TABLES
            .iter()
            .find(|table| table.name == name)
            .ok_or_else(|| RobotError::Unknown {
                name: name.to_string(),
            })?;
        let joints = table.joints.iter().map(|&(joint, dh)| {
            let limits = JointLimits {
                speed: Some(table.speed_limit),
                ..JointLimits::default()
            };
            let joint = Joint {
                name: joint.to_string(),
                kind: JointKind::Revolute,
                limits,
            };
            (joint, dh)
        });
        Self::from_dh_joints(table.name, DhConvention::Standard, joints.collect())
    }

    /// Names that [`builtin`](Self::builtin) knows.
    pub fn builtin_names() -> [&'static str; TABLES.len()] {
        TABLES.map(|table| table.name)
    }
}
