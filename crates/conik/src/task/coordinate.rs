//! One coordinate of a frame's origin: σ = eᵀ p(q), a row of Eqs. (4) and (5).

use super::{JacobianMut, Seen, Task};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// An axis of a frame.
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

/// One coordinate of the origin of a frame in the world, or in another frame [m].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    seen: Seen,
    axis: Axis,
}

impl Coordinate {
    /// A coordinate of the tool's position.
    pub const fn of_tool(axis: Axis) -> Self {
        Self::of(Frame::Tool, axis)
    }

    /// A coordinate of any frame's position.
    pub const fn of(frame: Frame, axis: Axis) -> Self {
        Self {
            seen: Seen::in_world(frame),
            axis,
        }
    }

    /// The same, in another frame of the robot.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
            ..self
        }
    }
}

impl Task for Coordinate {
    fn dimension(&self) -> usize {
        1
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.seen.origin(kinematics).dot(self.axis.direction());
    }

    #[inline]
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        kinematics.point_row(
            self.seen.motion(kinematics),
            self.seen.point(kinematics),
            self.seen
                .direction_in_world(kinematics, self.axis.direction()),
            jacobian.row(0),
        );
    }

    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let along = self.axis.direction() * weights[0];
        kinematics.add_point_curvature(
            self.seen.motion(kinematics),
            self.seen.point(kinematics),
            self.seen.direction_in_world(kinematics, along),
            hessian,
        );
    }

    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        self.seen.reach(kinematics)
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)
    }
}
