//! The UR5 of the paper.

use core::f64::consts::{FRAC_PI_2, PI};

use super::super::{DhConvention, DhRow, JointLimits, Robot, RobotError};
use super::revolute;

/// Its name.
pub(super) const NAME: &str = "ur5-paper";

/// Table I of the paper, lengths rounded to millimetres as printed there.
const UR5_PAPER: [(&str, DhRow); 6] = [
    ("shoulder_pan_joint", DhRow::new(0.0, FRAC_PI_2, 0.089)),
    ("shoulder_lift_joint", DhRow::new(-0.425, 0.0, 0.0)),
    ("elbow_joint", DhRow::new(-0.392, 0.0, 0.0)),
    ("wrist_1_joint", DhRow::new(0.0, FRAC_PI_2, 0.109)),
    ("wrist_2_joint", DhRow::new(0.0, -FRAC_PI_2, 0.095)),
    ("wrist_3_joint", DhRow::new(0.0, 0.0, 0.082)),
];

/// Joint speeds up to 180°/s, as in the maker's data sheet; no position or acceleration limits, as the
/// paper's experiments had none.
const LIMITS: JointLimits = JointLimits {
    position: None,
    speed: Some(PI),
    acceleration: None,
};

pub(super) fn robot() -> Result<Robot, RobotError> {
    let joints = UR5_PAPER.map(|(name, row)| (revolute(name, LIMITS), row));
    Robot::from_dh_joints(NAME, DhConvention::Standard, joints.into())
}
