//! The arms of Universal Robots.
//!
//! Lengths: "DH Parameters for calculations of kinematics and dynamics" of the maker's support pages
//! (nominal; every arm has a calibration of its own beside them). Positions and speeds: the data sheets
//! of the arms. Both were compared with the files `default_kinematics.yaml` and `joint_limits.yaml` of
//! the maker's ROS package `ur_description`, which say the same but for the elbow: ±180° there, so that
//! planners do not try what the shoulder prevents.
//!
//! **Base frames.** The table begins at `base`, the frame that the controller and its teach pendant
//! show. The `base_link` of the maker's URDF is turned by π about z against it.

use core::f64::consts::FRAC_PI_2;

use super::super::{DhConvention, DhRow, Robot, RobotError};
use super::{in_degrees, revolute};
use crate::geometry::{Pose, Vec3};
use crate::kinematics::Frame;

/// What Universal Robots publishes of one of its arms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UrArm {
    /// Name of the built-in robot.
    pub name: &'static str,
    /// Lengths a of upper arm and forearm [m].
    pub lengths_m: [f64; 2],
    /// Offsets d of shoulder, wrist 1, wrist 2 and wrist 3 [m].
    pub offsets_m: [f64; 4],
    /// Greatest speeds, base to tool [deg/s].
    pub speeds_deg_per_s: [f64; 6],
    /// Whether wrist 3 turns without end.
    pub is_last_endless: bool,
}

const NAMES: [&str; 6] = [
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
];

/// How far every joint turns either way, unless it turns without end [deg].
const POSITION_DEG: f64 = 360.0;

const EVEN: [f64; 6] = [180.0; 6];
const SLOW_SHOULDER: [f64; 6] = [120.0, 120.0, 180.0, 180.0, 180.0, 180.0];
const HEAVY: [f64; 6] = [120.0, 120.0, 150.0, 210.0, 210.0, 210.0];
const QUICK_WRIST: [f64; 6] = [180.0, 180.0, 180.0, 360.0, 360.0, 360.0];

impl UrArm {
    /// Where the figures are printed.
    pub const SOURCE: &str = "Universal Robots: DH parameters, data sheets";
    /// Twists α, base to tool [rad].
    pub const TWISTS_RAD: [f64; 6] = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];

    /// UR3, CB3.
    pub const UR3: Self = Self {
        is_last_endless: true,
        ..Self::new(
            "ur3",
            [-0.24365, -0.21325],
            [0.1519, 0.11235, 0.08535, 0.0819],
            QUICK_WRIST,
        )
    };
    /// UR5, CB3.
    pub const UR5: Self = Self::new(
        "ur5",
        [-0.425, -0.39225],
        [0.089_159, 0.10915, 0.09465, 0.0823],
        EVEN,
    );
    /// UR10, CB3.
    pub const UR10: Self = Self::new(
        "ur10",
        [-0.612, -0.5723],
        [0.1273, 0.163_941, 0.1157, 0.0922],
        SLOW_SHOULDER,
    );
    /// UR3e.
    pub const UR3E: Self = Self {
        is_last_endless: true,
        ..Self::new(
            "ur3e",
            [-0.24355, -0.2132],
            [0.15185, 0.13105, 0.08535, 0.0921],
            QUICK_WRIST,
        )
    };
    /// UR5e.
    pub const UR5E: Self = Self::new(
        "ur5e",
        [-0.425, -0.3922],
        [0.1625, 0.1333, 0.0997, 0.0996],
        EVEN,
    );
    /// UR10e.
    pub const UR10E: Self = Self::new(
        "ur10e",
        [-0.6127, -0.57155],
        [0.1807, 0.17415, 0.11985, 0.11655],
        SLOW_SHOULDER,
    );
    /// UR16e.
    pub const UR16E: Self = Self::new(
        "ur16e",
        [-0.4784, -0.36],
        [0.1807, 0.17415, 0.11985, 0.11655],
        SLOW_SHOULDER,
    );
    /// UR20.
    pub const UR20: Self = Self::new(
        "ur20",
        [-0.862, -0.7287],
        [0.2363, 0.201, 0.1593, 0.1543],
        HEAVY,
    );
    /// UR30.
    pub const UR30: Self = Self::new(
        "ur30",
        [-0.637, -0.5037],
        [0.2363, 0.201, 0.1593, 0.1543],
        HEAVY,
    );

    const fn new(
        name: &'static str,
        lengths_m: [f64; 2],
        offsets_m: [f64; 4],
        speeds_deg_per_s: [f64; 6],
    ) -> Self {
        Self {
            name,
            lengths_m,
            offsets_m,
            speeds_deg_per_s,
            is_last_endless: false,
        }
    }

    /// Link lengths a, joint by joint [m].
    pub const fn all_lengths_m(&self) -> [f64; 6] {
        let [upper_arm, forearm] = self.lengths_m;
        [0.0, upper_arm, forearm, 0.0, 0.0, 0.0]
    }

    /// Link offsets d, joint by joint [m].
    pub const fn all_offsets_m(&self) -> [f64; 6] {
        let [shoulder, wrist_1, wrist_2, wrist_3] = self.offsets_m;
        [shoulder, 0.0, 0.0, wrist_1, wrist_2, wrist_3]
    }

    pub(super) fn robot(&self) -> Result<Robot, RobotError> {
        let (a_m, d_m) = (self.all_lengths_m(), self.all_offsets_m());
        let joints = NAMES.iter().enumerate().map(|(i, name)| {
            let is_endless = self.is_last_endless && i + 1 == NAMES.len();
            let position = (!is_endless).then_some(POSITION_DEG);
            let limits = in_degrees(position, self.speeds_deg_per_s[i]);
            let row = DhRow::new(a_m[i], Self::TWISTS_RAD[i], d_m[i]);
            (revolute(name, limits), row)
        });
        Robot::from_dh_joints(self.name, DhConvention::Standard, joints.collect())?
            .with_frame("base", Frame::World, Pose::IDENTITY)?
            .with_frame("base_link", Frame::World, BASE_FROM_BASE_LINK)?
            .with_frame("flange", Frame::Tool, TOOL0_FROM_FLANGE)?
            .with_frame("tool0", Frame::Tool, Pose::IDENTITY)?
            .with_tool("tool0")
    }
}

/// Half a turn about z.
const BASE_FROM_BASE_LINK: Pose = Pose {
    x_axis: Vec3::new(-1.0, 0.0, 0.0),
    y_axis: Vec3::new(0.0, -1.0, 0.0),
    ..Pose::IDENTITY
};

/// As ROS-Industrial has it, the flange's x axis points away from the arm, where `tool0` has its z axis.
const TOOL0_FROM_FLANGE: Pose = Pose {
    x_axis: Vec3::new(0.0, 0.0, 1.0),
    y_axis: Vec3::new(1.0, 0.0, 0.0),
    z_axis: Vec3::new(0.0, 1.0, 0.0),
    origin: Vec3::ZERO,
};
