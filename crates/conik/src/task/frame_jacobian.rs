//! The Jacobian of a frame as a whole: its singular values σᵢ, and how they change.

use super::{AXES, Seen};
use crate::geometry::Vec3;
use crate::joints::{JointVec, MAX_JOINTS};
use crate::kinematics::Kinematics;
use crate::linalg::{dot, singular_vectors};
use crate::real::sqrt;
use crate::robot::Robot;

/// A singular value that is a smaller share of the largest has no direction but that of rounding.
const ROUNDING: f64 = 1e-14;

/// Which rows of a frame's Jacobian.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JacobianPart {
    /// The three of its origin [m/rad].
    #[default]
    Position,
    /// The three of its angular velocity [-].
    Orientation,
    /// All six, a metre counting as much as a radian.
    Pose,
}

/// A part of the Jacobian of a frame, seen from another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FrameJacobian {
    pub(super) seen: Seen,
    pub(super) part: JacobianPart,
}

/// J = Σ σᵢ uᵢ vᵢᵀ.
pub(super) struct Singular {
    dof: usize,
    /// Number of rows.
    pub(super) size: usize,
    /// σᵢ, in no order.
    pub(super) values: [f64; 6],
    left: [f64; 36],
    /// σᵢ vᵢ.
    scaled_right: [f64; 6 * MAX_JOINTS],
}

impl Singular {
    /// Number of the smallest value, the first of several.
    pub(super) fn smallest(&self) -> usize {
        (1..self.size).fold(0, |best, i| {
            if self.values[i] < self.values[best] {
                i
            } else {
                best
            }
        })
    }
}

impl JacobianPart {
    pub(super) fn size(self) -> usize {
        match self {
            Self::Position | Self::Orientation => 3,
            Self::Pose => 6,
        }
    }
}

impl FrameJacobian {
    pub(super) fn singular(self, kinematics: &Kinematics) -> Singular {
        let (dof, size) = (kinematics.dof(), self.part.size());
        let motion = self.seen.motion(kinematics);
        let point = self.seen.point(kinematics);
        let mut rows = [0.0; 6 * MAX_JOINTS];
        // The axes of the world do as well as any others.
        for (i, row) in rows.chunks_exact_mut(dof).take(size).enumerate() {
            if self.part == JacobianPart::Orientation || i >= 3 {
                kinematics.turn_row(motion, AXES[i % 3], row);
            } else {
                kinematics.point_row(motion, point, AXES[i], row);
            }
        }
        let mut left = [0.0; 36];
        singular_vectors(&mut rows[..size * dof], dof, &mut left);
        let mut values = [0.0; 6];
        for (value, row) in values.iter_mut().zip(rows.chunks_exact(dof)).take(size) {
            *value = sqrt(dot(row, row));
        }
        Singular {
            dof,
            size,
            values,
            left,
            scaled_right: rows,
        }
    }

    /// Adds weight · ∇σᵢ = weight · uᵢᵀ (∂J/∂q) vᵢ to `gradient`; nothing where σᵢ is 0 but for rounding,
    /// which is where it has a kink.
    pub(super) fn add_gradient(
        self,
        kinematics: &Kinematics,
        singular: &Singular,
        i: usize,
        weight: f64,
        gradient: &mut [f64],
    ) {
        let (dof, size) = (singular.dof, singular.size);
        let largest = singular.values.iter().fold(0.0, |a: f64, b| a.max(*b));
        if singular.values[i] <= ROUNDING * largest {
            return;
        }
        let mut right = JointVec::zeros(dof);
        for (v, scaled) in right.iter_mut().zip(&singular.scaled_right[i * dof..]) {
            *v = scaled / singular.values[i];
        }
        let left = &singular.left[i * size..][..size];
        let three = |at: usize| Vec3::new(left[at], left[at + 1], left[at + 2]) * weight;
        let (along, about) = match self.part {
            JacobianPart::Position => (Some(three(0)), None),
            JacobianPart::Orientation => (None, Some(three(0))),
            JacobianPart::Pose => (Some(three(0)), Some(three(3))),
        };
        let motion = self.seen.motion(kinematics);
        if let Some(along) = along {
            let point = self.seen.point(kinematics);
            kinematics.add_point_speed_gradient(motion, point, along, &right, gradient);
        }
        if let Some(about) = about {
            kinematics.add_turn_speed_gradient(motion, about, &right, gradient);
        }
    }

    pub(super) fn check(self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        if robot.dof() < self.part.size() {
            return Err("with fewer joints than rows the Jacobian is singular everywhere");
        }
        Ok(())
    }
}
