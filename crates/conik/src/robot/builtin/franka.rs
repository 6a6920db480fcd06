//! The arms of Franka Robotics: Franka Emika Robot (Panda) and Franka Research 3.
//!
//! "Robot and interface specifications" of the maker's FCI documentation: the Denavit-Hartenberg
//! parameters in Craig's convention, and position, speed and acceleration limits. Compared with
//! `kinematics.yaml` and `joint_limits.yaml` of the maker's ROS package `franka_description`.
//!
//! What a Franka Research 3 allows of the speed falls towards the ends of a joint's travel; the figures
//! are its greatest.

use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use super::super::{DhConvention, DhRow, JointLimits, Robot, RobotError};
use super::revolute;
use crate::geometry::{Pose, Vec3};
use crate::kinematics::Frame;

pub(super) const SOURCE: &str = "Franka Robotics: FCI documentation";

/// a and α are those with index i − 1 in the maker's table.
const ROWS: [DhRow; 7] = [
    DhRow::new(0.0, 0.0, 0.333),
    DhRow::new(0.0, -FRAC_PI_2, 0.0),
    DhRow::new(0.0, FRAC_PI_2, 0.316),
    DhRow::new(0.0825, FRAC_PI_2, 0.0),
    DhRow::new(-0.0825, -FRAC_PI_2, 0.384),
    DhRow::new(0.0, FRAC_PI_2, 0.0),
    DhRow::new(0.088, FRAC_PI_2, 0.0),
];

/// The last row of the table, which has no joint.
const LINK_7_FROM_FLANGE: Pose = Pose::at(Vec3::new(0.0, 0.0, 0.107));
/// The hand is mounted at −45° about z.
const FLANGE_FROM_HAND: Pose = Pose {
    x_axis: Vec3::new(FRAC_1_SQRT_2, -FRAC_1_SQRT_2, 0.0),
    y_axis: Vec3::new(FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0),
    ..Pose::IDENTITY
};
/// Between the finger tips.
const HAND_FROM_TCP: Pose = Pose::at(Vec3::new(0.0, 0.0, 0.1034));

/// Least and greatest position [rad], greatest speed [rad/s] and acceleration [rad/s²].
type Limits = [((f64, f64), f64, f64); 7];

const PANDA: Limits = [
    ((-2.8973, 2.8973), 2.175, 15.0),
    ((-1.7628, 1.7628), 2.175, 7.5),
    ((-2.8973, 2.8973), 2.175, 10.0),
    ((-3.0718, -0.0698), 2.175, 12.5),
    ((-2.8973, 2.8973), 2.61, 15.0),
    ((-0.0175, 3.7525), 2.61, 20.0),
    ((-2.8973, 2.8973), 2.61, 20.0),
];

const FR3: Limits = [
    ((-2.7437, 2.7437), 2.62, 10.0),
    ((-1.7837, 1.7837), 2.62, 10.0),
    ((-2.9007, 2.9007), 2.62, 10.0),
    ((-3.0421, -0.1518), 2.62, 10.0),
    ((-2.8065, 2.8065), 5.26, 10.0),
    ((0.5445, 4.5169), 4.18, 10.0),
    ((-3.0159, 3.0159), 5.26, 10.0),
];

const PANDA_NAMES: [&str; 7] = [
    "panda_joint1",
    "panda_joint2",
    "panda_joint3",
    "panda_joint4",
    "panda_joint5",
    "panda_joint6",
    "panda_joint7",
];

const FR3_NAMES: [&str; 7] = [
    "fr3_joint1",
    "fr3_joint2",
    "fr3_joint3",
    "fr3_joint4",
    "fr3_joint5",
    "fr3_joint6",
    "fr3_joint7",
];

pub(super) fn panda() -> Result<Robot, RobotError> {
    arm("panda", PANDA_NAMES, PANDA)
}

pub(super) fn fr3() -> Result<Robot, RobotError> {
    arm("fr3", FR3_NAMES, FR3)
}

/// Both have the same lengths. The tool is the flange: not every arm has a hand.
fn arm(name: &str, names: [&str; 7], limits: Limits) -> Result<Robot, RobotError> {
    let joints = names.iter().zip(limits).zip(ROWS);
    let joints = joints.map(|((name, (position, speed, acceleration)), row)| {
        let limits = JointLimits {
            position: Some(position),
            speed: Some(speed),
            acceleration: Some(acceleration),
        };
        (revolute(name, limits), row)
    });
    let flange_from_tcp = FLANGE_FROM_HAND * HAND_FROM_TCP;
    Robot::from_dh_joints(name, DhConvention::Modified, joints.collect())?
        .with_frame("flange", Frame::Tool, LINK_7_FROM_FLANGE)?
        .with_tool("flange")?
        .with_frame("hand", Frame::Tool, FLANGE_FROM_HAND)?
        .with_frame("hand_tcp", Frame::Tool, flange_from_tcp)
}
