//! The KUKA LBR iiwa 14 R820.
//!
//! "LBR iiwa 7 R800, LBR iiwa 14 R820 Specification" of KUKA: the distances between the axes (main
//! dimensions), and range and speed at rated payload of each axis (Section 4.3.2, "Axis data"). KUKA
//! prints no Denavit-Hartenberg table; this one has these distances and the axes' directions, and its
//! frames at position 0 are turned as the base's. Distances and ranges were compared with
//! `iiwa_description` of the ROS package `iiwa_stack`, whose joint names these are.

use core::f64::consts::FRAC_PI_2;

use super::super::{DhConvention, DhRow, Robot, RobotError};
use super::{in_degrees, revolute};
use crate::geometry::Pose;
use crate::kinematics::Frame;

pub(super) const SOURCE: &str = "KUKA: LBR iiwa 14 R820 Specification";

/// Each joint's row, position limit [deg] and speed [deg/s].
const JOINTS: [(&str, DhRow, f64, f64); 7] = [
    (
        "iiwa_joint_1",
        DhRow::new(0.0, -FRAC_PI_2, 0.36),
        170.0,
        85.0,
    ),
    ("iiwa_joint_2", DhRow::new(0.0, FRAC_PI_2, 0.0), 120.0, 85.0),
    (
        "iiwa_joint_3",
        DhRow::new(0.0, FRAC_PI_2, 0.42),
        170.0,
        100.0,
    ),
    (
        "iiwa_joint_4",
        DhRow::new(0.0, -FRAC_PI_2, 0.0),
        120.0,
        75.0,
    ),
    (
        "iiwa_joint_5",
        DhRow::new(0.0, -FRAC_PI_2, 0.4),
        170.0,
        130.0,
    ),
    (
        "iiwa_joint_6",
        DhRow::new(0.0, FRAC_PI_2, 0.0),
        120.0,
        135.0,
    ),
    ("iiwa_joint_7", DhRow::new(0.0, 0.0, 0.126), 175.0, 135.0),
];

pub(super) fn iiwa14() -> Result<Robot, RobotError> {
    let joints = JOINTS.iter().map(|&(name, row, position, speed)| {
        (revolute(name, in_degrees(Some(position), speed)), row)
    });
    Robot::from_dh_joints("iiwa14", DhConvention::Standard, joints.collect())?
        .with_frame("flange", Frame::Tool, Pose::IDENTITY)?
        .with_tool("flange")
}
