//! The smallest singular value of a frame's Jacobian: σ_min, ∂σ_min/∂q = uᵀ ∂J/∂q v.

use super::frame_jacobian::FrameJacobian;
use super::{JacobianMut, JacobianPart, Seen, Task};
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// The least speed that joints of unit speed give a frame, in its worst direction [m/rad for its position,
/// - for its orientation].
///
/// Where two singular values are the smallest, it is continuous with a kink, and the Jacobian is that of one
/// of the two. At 0 the Jacobian is undefined, and zero here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SmallestSingularValue {
    jacobian: FrameJacobian,
}

impl SmallestSingularValue {
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

impl Task for SmallestSingularValue {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        let singular = self.jacobian.singular(kinematics);
        value[0] = singular.values[singular.smallest()];
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let singular = self.jacobian.singular(kinematics);
        let row = jacobian.row(0);
        row.fill(0.0);
        let smallest = singular.smallest();
        self.jacobian
            .add_gradient(kinematics, &singular, smallest, 1.0, row);
    }

    fn unit(&self) -> &'static str {
        match self.jacobian.part {
            JacobianPart::Position => "m/rad",
            JacobianPart::Orientation | JacobianPart::Pose => "-",
        }
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.jacobian.check(robot)
    }
}
