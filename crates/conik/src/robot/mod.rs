//! The robot: a serial chain of joints from base to tool, and its limits.
//!
//! What follows from one configuration q is [`Kinematics`](crate::Kinematics); what the robot is
//! asked to do is a [`Stack`](crate::Stack). Neither belongs here.

mod builtin;
pub(crate) mod dh;

use alloc::string::String;
use alloc::vec::Vec;

pub use dh::DhRow;

use crate::joints::{MAX_JOINTS, TooManyJoints};

/// How a joint moves the links after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its z axis; positions in [rad].
    Revolute,
    /// Slides along its z axis; positions in [m].
    Prismatic,
}

/// What a joint must not exceed. An absent limit is no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointLimits {
    /// Least and greatest position [rad or m].
    pub position: Option<(f64, f64)>,
    /// Greatest speed, either way [rad/s or m/s].
    pub speed: Option<f64>,
    /// Greatest acceleration, either way [rad/s² or m/s²].
    pub acceleration: Option<f64>,
}

/// One joint and the rigid link that it carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The joint's name, unique in the robot.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Geometry of the joint and its link, standard Denavit-Hartenberg convention.
    pub dh: DhRow,
    /// What it must not exceed.
    pub limits: JointLimits,
}

/// A serial arm: joints in order from base to tool.
///
/// The tool frame is the frame after the last joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    name: String,
    joints: Vec<Joint>,
}

/// Why a robot could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RobotError {
    /// No built-in robot has this name.
    #[error("no built-in robot is called `{name}`; there are: {}", Robot::builtin_names().join(", "))]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// The robot has no joints.
    #[error("a robot needs at least one joint")]
    NoJoints,
    /// The robot has too many joints.
    #[error(transparent)]
    TooManyJoints(#[from] TooManyJoints),
    /// A geometric parameter or a limit is not a usable number.
    #[error("joint `{joint}`: {what}")]
    BadNumber {
        /// Name of the joint.
        joint: String,
        /// What is wrong with which number.
        what: &'static str,
    },
}

impl Robot {
    /// A robot from its joints, base to tool.
    pub fn from_joints(name: impl Into<String>, joints: Vec<Joint>) -> Result<Self, RobotError> {
        if joints.is_empty() {
            return Err(RobotError::NoJoints);
        }
        if joints.len() > MAX_JOINTS {
            return Err(TooManyJoints(joints.len()).into());
        }
        for joint in &joints {
            joint.check().map_err(|what| RobotError::BadNumber {
                joint: joint.name.clone(),
                what,
            })?;
        }
        Ok(Self {
            name: name.into(),
            joints,
        })
    }

    /// The robot's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of joints.
    pub fn dof(&self) -> usize {
        self.joints.len()
    }

    /// The joints, base to tool.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Names of the joints, base to tool.
    pub fn joint_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.joints.iter().map(|joint| joint.name.as_str())
    }
}

impl Joint {
    fn check(&self) -> Result<(), &'static str> {
        let DhRow {
            a_m,
            alpha_rad,
            d_m,
            theta_rad,
        } = self.dh;
        if ![a_m, alpha_rad, d_m, theta_rad]
            .iter()
            .all(|v| v.is_finite())
        {
            return Err("its Denavit-Hartenberg parameters must be finite");
        }
        let JointLimits {
            position,
            speed,
            acceleration,
        } = self.limits;
        if position.is_some_and(|(min, max)| !(min <= max)) {
            return Err("its least position must not exceed its greatest");
        }
        if [speed, acceleration]
            .into_iter()
            .flatten()
            .any(|limit| !(limit > 0.0))
        {
            return Err("its speed and acceleration limits must be positive");
        }
        Ok(())
    }
}
