//! Position of a frame's origin: σ = p(q) ∈ ℝ³, Eqs. (4) and (5).

use super::{JacobianMut, Task, check_frame};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics};

/// Position of the origin of a frame in the base frame [m], dimension 3.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Position {
    frame: Frame,
}

impl Position {
    /// Position of the tool.
    pub const fn of_tool() -> Self {
        Self::of(Frame::Tool)
    }

    /// Position of any frame.
    pub const fn of(frame: Frame) -> Self {
        Self { frame }
    }
}

impl Task for Position {
    fn dimension(&self) -> usize {
        3
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value.copy_from_slice(&kinematics.base_from(self.frame).origin.to_array());
    }

    #[inline]
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        kinematics.point_rows(self.frame, jacobian.rows());
    }

    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let along = Vec3::new(weights[0], weights[1], weights[2]);
        kinematics.add_point_curvature(self.frame, along, hessian);
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, dof: usize) -> Result<(), &'static str> {
        check_frame(self.frame, dof)
    }
}
