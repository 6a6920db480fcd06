//! Manipulability (Yoshikawa 1985): w = √det(J Jᵀ) = Π σᵢ over the singular values of a frame's Jacobian.

use super::frame_jacobian::FrameJacobian;
use super::{JacobianMut, JacobianPart, Seen, Task};
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// How far a frame is from a singularity: the volume of the velocities that joints of unit speed give it
/// [m³ for its position, - for its orientation].
///
/// ∂w/∂q = w tr((J Jᵀ)⁻¹ ∂J/∂q Jᵀ), here as Σᵢ (Π_{j≠i} σⱼ) uᵢᵀ ∂J/∂q vᵢ, which needs no inverse and is
/// finite up to the singularity. At it w has a kink, and the term of the vanishing value is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Manipulability {
    jacobian: FrameJacobian,
}

impl Manipulability {
    /// Of a part of the tool's Jacobian.
    pub const fn of_tool(part: JacobianPart) -> Self {
        Self::of(Frame::Tool, part)
    }

    /// Of a part of any frame's Jacobian.
    pub const fn of(frame: Frame, part: JacobianPart) -> Self {
        let seen = Seen::in_world(frame);
        Self {
            jacobian: FrameJacobian { seen, part },
        }
    }

    /// The same of how the frame moves in another frame of the robot.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        let FrameJacobian { seen, part } = self.jacobian;
        let seen = seen.from(frame);
        Self {
            jacobian: FrameJacobian { seen, part },
        }
    }
}

impl Task for Manipulability {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        let singular = self.jacobian.singular(kinematics);
        value[0] = singular.values[..singular.size].iter().product();
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let singular = self.jacobian.singular(kinematics);
        let row = jacobian.row(0);
        row.fill(0.0);
        for i in 0..singular.size {
            let others = (0..singular.size).filter(|j| *j != i);
            let weight = others.map(|j| singular.values[j]).product();
            self.jacobian
                .add_gradient(kinematics, &singular, i, weight, row);
        }
    }

    fn unit(&self) -> &'static str {
        match self.jacobian.part {
            JacobianPart::Orientation => "-",
            JacobianPart::Position | JacobianPart::Pose => "m³",
        }
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.jacobian.check(robot)
    }
}
