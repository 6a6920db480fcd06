//! Arms from Denavit-Hartenberg tables, standard and modified.

use alloc::format;
use alloc::vec::Vec;

use super::placement::exact_sin_cos;
use super::{Body, Joint, JointKind, JointLimits, Robot, RobotBuilder, RobotError};
use crate::geometry::{Pose, Vec3};

/// One row of a Denavit-Hartenberg table. A revolute joint adds its position to θ, a prismatic one to d.
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

/// What the rows of a table mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// Distal, Denavit and Hartenberg 1955, as in the paper: turn by θ about z, move by d along z, move
    /// by a along the new x, turn by α about it. The joint acts about the z axis *before* these.
    Standard,
    /// Proximal, Craig 1986: turn by α about x, move by a along it, turn by θ about the new z, move by d
    /// along it. The joint acts about that new z axis; a and α are often printed with index i − 1.
    Modified,
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

    fn is_finite(&self) -> bool {
        [self.a_m, self.alpha_rad, self.d_m, self.theta_rad]
            .iter()
            .all(|number| number.is_finite())
    }

    /// Turn by α about x, move by a along it.
    fn along_x(&self) -> Pose {
        let (sin, cos) = exact_sin_cos(self.alpha_rad);
        Pose {
            y_axis: Vec3::new(0.0, cos, sin),
            z_axis: Vec3::new(0.0, -sin, cos),
            origin: Vec3::new(self.a_m, 0.0, 0.0),
            ..Pose::IDENTITY
        }
    }

    /// Turn by θ about z, move by d along it.
    fn along_z(&self) -> Pose {
        let (sin, cos) = exact_sin_cos(self.theta_rad);
        Pose {
            x_axis: Vec3::new(cos, sin, 0.0),
            y_axis: Vec3::new(-sin, cos, 0.0),
            origin: Vec3::new(0.0, 0.0, self.d_m),
            ..Pose::IDENTITY
        }
    }
}

impl Robot {
    /// An arm of revolute joints named `joint_1`, `joint_2`, ... from its table in the standard
    /// convention, without limits.
    pub fn from_dh(name: &str, rows: &[DhRow]) -> Result<Self, RobotError> {
        let joints = rows.iter().enumerate().map(|(i, &row)| {
            let joint = Joint {
                name: format!("joint_{}", i + 1),
                kind: JointKind::Revolute,
                limits: JointLimits::default(),
            };
            (joint, row)
        });
        Self::from_dh_joints(name, DhConvention::Standard, joints.collect())
    }

    /// An arm from its joints, base to tool, each with its row.
    ///
    /// Its links are the frames of the convention: `link_0`, the base, to `link_n`, the tool.
    pub fn from_dh_joints(
        name: &str,
        convention: DhConvention,
        joints: Vec<(Joint, DhRow)>,
    ) -> Result<Self, RobotError> {
        let mut arm = RobotBuilder::new(name);
        arm.link("link_0", Body::FIXED, Pose::IDENTITY)?;
        let mut body = Body::FIXED;
        for (i, (joint, row)) in joints.into_iter().enumerate() {
            if !row.is_finite() {
                return Err(RobotError::BadNumber {
                    joint: joint.name,
                    what: "its Denavit-Hartenberg parameters must be finite",
                });
            }
            let (before, after) = match convention {
                DhConvention::Standard => (row.along_z(), row.along_x()),
                DhConvention::Modified => (row.along_x() * row.along_z(), Pose::IDENTITY),
            };
            body = arm.joint_between(body, before, joint, after)?;
            arm.link(&format!("link_{}", i + 1), body, Pose::IDENTITY)?;
        }
        arm.build()
    }
}
