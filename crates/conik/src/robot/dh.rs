//! Denavit-Hartenberg parameters, standard convention.

use alloc::format;
use alloc::vec::Vec;

use super::{Joint, JointKind, JointLimits, Robot, RobotError};
use crate::geometry::{Pose, Vec3};
use crate::real::sin_cos;

/// One row of a Denavit-Hartenberg table in the standard (distal) convention:
/// turn by θ about z, move by d along z, move by a along the new x, turn by α about the new x.
///
/// A revolute joint adds its position to θ, a prismatic one to d.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DhRow {
    /// Link length a [m].
    pub a_m: f64,
    /// Link twist α [rad].
    pub alpha_rad: f64,
    /// Link offset d [m].
    pub d_m: f64,
    /// Joint angle θ at position 0 [rad].
    pub theta_rad: f64,
}

impl DhRow {
    /// A row of a revolute joint whose angle at position 0 is 0, as in Table I of the paper.
    pub const fn new(a_m: f64, alpha_rad: f64, d_m: f64) -> Self {
        Self {
            a_m,
            alpha_rad,
            d_m,
            theta_rad: 0.0,
        }
    }
}

/// A row made ready for forward kinematics: the constant part of it computed once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    a: f64,
    twist: Twist,
    d: f64,
    theta: f64,
    kind: JointKind,
}

/// The turn by α about the new x. Most arms have none but those of a quarter, which cost little.
#[derive(Clone, Copy, Debug)]
enum Twist {
    /// By ±π/2; the sign is sin α.
    Quarter {
        sign: f64,
    },
    /// By nothing.
    None,
    Any {
        cos: f64,
        sin: f64,
    },
}

impl Twist {
    fn new(alpha_rad: f64) -> Self {
        /// A sine or cosine of less than this is that of a multiple of π/2 that was rounded.
        const ROUNDED: f64 = 1e-15;
        let (sin, cos) = sin_cos(alpha_rad);
        if cos.abs() < ROUNDED {
            Self::Quarter { sign: sin.signum() }
        } else if sin.abs() < ROUNDED && cos > 0.0 {
            Self::None
        } else {
            Self::Any { cos, sin }
        }
    }

    /// The y and the z axis after the turn.
    #[inline]
    fn turn(self, y_axis: Vec3, z_axis: Vec3) -> (Vec3, Vec3) {
        if let Self::Quarter { sign } = self {
            return (z_axis * sign, y_axis * -sign);
        }
        if let Self::Any { cos, sin } = self {
            return (y_axis * cos + z_axis * sin, z_axis * cos - y_axis * sin);
        }
        (y_axis, z_axis)
    }
}

impl Link {
    pub(crate) fn new(joint: &Joint) -> Self {
        Self {
            a: joint.dh.a_m,
            twist: Twist::new(joint.dh.alpha_rad),
            d: joint.dh.d_m,
            theta: joint.dh.theta_rad,
            kind: joint.kind,
        }
    }

    pub(crate) fn kind(&self) -> JointKind {
        self.kind
    }

    /// θ [rad] at a position of the joint.
    #[inline]
    pub(crate) fn angle(&self, position: f64) -> f64 {
        match self.kind {
            JointKind::Revolute => self.theta + position,
            JointKind::Prismatic => self.theta,
        }
    }

    /// `base_from_link` given `base_from_previous`, the joint's position, and sine and cosine of its θ.
    #[inline]
    pub(crate) fn advance(&self, previous: &Pose, position: f64, (sin, cos): (f64, f64)) -> Pose {
        let d = match self.kind {
            JointKind::Revolute => self.d,
            JointKind::Prismatic => self.d + position,
        };
        let x_axis = previous.x_axis * cos + previous.y_axis * sin;
        let across: Vec3 = previous.y_axis * cos - previous.x_axis * sin;
        let (y_axis, z_axis) = self.twist.turn(across, previous.z_axis);
        Pose {
            x_axis,
            y_axis,
            z_axis,
            origin: previous.origin + previous.z_axis * d + x_axis * self.a,
        }
    }
}

impl Robot {
    /// An arm of revolute joints named `joint_1`, `joint_2`, ... from its table, without limits.
    pub fn from_dh(name: &str, rows: &[DhRow]) -> Result<Self, RobotError> {
        let joints: Vec<Joint> = rows
            .iter()
            .enumerate()
            .map(|(i, &dh)| Joint {
                name: format!("joint_{}", i + 1),
                kind: JointKind::Revolute,
                dh,
                limits: JointLimits::default(),
            })
            .collect();
        Self::from_joints(name, joints)
    }
}
