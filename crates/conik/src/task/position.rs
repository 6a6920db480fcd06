//! Position of a frame's origin: σ = p(q) ∈ ℝ³, Eqs. (4) and (5).

use super::{AXES, JacobianMut, Seen, Task};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// Position of the origin of a frame in the world, or in another frame [m], dimension 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    seen: Seen,
}

impl Position {
    /// Position of the tool.
    pub const fn of_tool() -> Self {
        Self::of(Frame::Tool)
    }

    /// Position of any frame.
    pub const fn of(frame: Frame) -> Self {
        Self {
            seen: Seen::in_world(frame),
        }
    }

    /// The same, in another frame of the robot.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
        }
    }
}

impl Task for Position {
    fn dimension(&self) -> usize {
        3
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value.copy_from_slice(&self.seen.origin(kinematics).to_array());
    }

    #[inline]
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let motion = self.seen.motion(kinematics);
        let point = self.seen.point(kinematics);
        if !self.seen.is_from_elsewhere() {
            return kinematics.point_rows(motion, point, jacobian.rows());
        }
        for (i, axis) in AXES.into_iter().enumerate() {
            let along = self.seen.direction_in_world(kinematics, axis);
            kinematics.point_row(motion, point, along, jacobian.row(i));
        }
    }

    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let along = Vec3::new(weights[0], weights[1], weights[2]);
        kinematics.add_point_curvature(
            self.seen.motion(kinematics),
            self.seen.point(kinematics),
            self.seen.direction_in_world(kinematics, along),
            hessian,
        );
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)
    }
}
