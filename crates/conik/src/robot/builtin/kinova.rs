//! The Kinova Gen3 with 7 degrees of freedom.
//!
//! "KINOVA Gen3 Ultra lightweight robot, User Guide": its table of classical Denavit-Hartenberg
//! parameters of the 7 DoF robot, and (R07, tables 39 and following) position and speed limits of the
//! joints. Joints 1, 3, 5 and 7 turn without end. Compared with the maker's URDF (`gen3_macro.xacro` of the
//! ROS package `kortex_description`), which has hundredths of a millimetre where the table has tenths, and
//! a wrist that misses the axis by 0.2 mm: the tools of both are less than 0.5 mm apart everywhere.
//!
//! Of accelerations the guide has several limits, which depend on how the arm is driven: none is here.

use core::f64::consts::{FRAC_PI_2, PI};

use super::super::{DhConvention, DhRow, JointLimits, Robot, RobotError};
use super::revolute;
use crate::geometry::{Pose, Vec3};
use crate::kinematics::Frame;

pub(super) const SOURCE: &str = "Kinova: Gen3 User Guide";

/// Speeds of the large and of the small actuators [rad/s].
const LARGE: f64 = 1.39;
const SMALL: f64 = 1.22;

/// Each joint's row, position limit if it has one [deg], and speed [rad/s].
const JOINTS: [(&str, DhRow, Option<f64>, f64); 7] = [
    (
        "joint_1",
        row(FRAC_PI_2, -(0.1564 + 0.1284), 0.0),
        None,
        LARGE,
    ),
    (
        "joint_2",
        row(FRAC_PI_2, -(0.0054 + 0.0064), PI),
        Some(128.9),
        LARGE,
    ),
    (
        "joint_3",
        row(FRAC_PI_2, -(0.2104 + 0.2104), PI),
        None,
        LARGE,
    ),
    (
        "joint_4",
        row(FRAC_PI_2, -(0.0064 + 0.0064), PI),
        Some(147.8),
        LARGE,
    ),
    (
        "joint_5",
        row(FRAC_PI_2, -(0.2084 + 0.1059), PI),
        None,
        SMALL,
    ),
    ("joint_6", row(FRAC_PI_2, 0.0, PI), Some(120.3), SMALL),
    ("joint_7", row(PI, -(0.1059 + 0.0615), PI), None, SMALL),
];

const fn row(alpha_rad: f64, d_m: f64, theta_rad: f64) -> DhRow {
    DhRow {
        a_m: 0.0,
        alpha_rad,
        d_m,
        theta_rad,
    }
}

/// The row of the table before the first joint: half a turn about x.
const BASE_LINK_FROM_LINK_0: Pose = Pose {
    y_axis: Vec3::new(0.0, -1.0, 0.0),
    z_axis: Vec3::new(0.0, 0.0, -1.0),
    ..Pose::IDENTITY
};

pub(super) fn gen3() -> Result<Robot, RobotError> {
    let joints = JOINTS.iter().map(|&(name, row, position, speed)| {
        let position = position.map(f64::to_radians);
        let limits = JointLimits {
            position: position.map(|most| (-most, most)),
            speed: Some(speed),
            acceleration: None,
        };
        (revolute(name, limits), row)
    });
    Robot::from_dh_joints("gen3", DhConvention::Standard, joints.collect())?
        .standing_at(BASE_LINK_FROM_LINK_0)
        .with_frame("base_link", Frame::World, Pose::IDENTITY)?
        .with_frame("end_effector_link", Frame::Tool, Pose::IDENTITY)?
        .with_tool("end_effector_link")
}
