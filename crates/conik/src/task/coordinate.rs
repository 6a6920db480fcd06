//! One coordinate of a frame's origin: σ = eᵀ p(q), a row of Eqs. (4) and (5).

use super::{JacobianMut, Task, check_frame};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics};

/// An axis of the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// x
    X,
    /// y
    Y,
    /// z
    Z,
}

impl Axis {
    const fn direction(self) -> Vec3 {
        match self {
            Self::X => Vec3::new(1.0, 0.0, 0.0),
            Self::Y => Vec3::new(0.0, 1.0, 0.0),
            Self::Z => Vec3::new(0.0, 0.0, 1.0),
        }
    }
}

/// One coordinate of the origin of a frame in the base frame [m].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    frame: Frame,
    axis: Axis,
}

impl Coordinate {
    /// A coordinate of the tool's position.
    pub const fn of_tool(axis: Axis) -> Self {
        Self::of(Frame::Tool, axis)
    }

    /// A coordinate of any frame's position.
    pub const fn of(frame: Frame, axis: Axis) -> Self {
        Self { frame, axis }
    }
}

impl Task for Coordinate {
    fn dimension(&self) -> usize {
        1
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = kinematics
            .base_from(self.frame)
            .origin
            .dot(self.axis.direction());
    }

    #[inline]
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        kinematics.point_row(self.frame, self.axis.direction(), jacobian.row(0));
    }

    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let along = self.axis.direction() * weights[0];
        kinematics.add_point_curvature(self.frame, along, hessian);
    }

    fn steepness(&self, reach: f64) -> f64 {
        reach
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, dof: usize) -> Result<(), &'static str> {
        check_frame(self.frame, dof)
    }
}
