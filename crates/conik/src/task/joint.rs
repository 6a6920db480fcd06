//! Position of one joint: σ = q_i.

use super::{JacobianMut, Task};
use crate::kinematics::Kinematics;
use crate::robot::{JointKind, Robot};

/// Position of one joint [rad, or m for a prismatic joint].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointPosition {
    index: usize,
    slides: bool,
}

impl JointPosition {
    /// Position of joint `index`, counted from 0 at the base.
    pub const fn of(index: usize) -> Self {
        Self {
            index,
            slides: false,
        }
    }

    /// As [`of`](Self::of), of a joint of this robot: the unit is that of the joint.
    pub fn of_robot(index: usize, robot: &Robot) -> Self {
        let joint = robot.joints().get(index);
        Self {
            index,
            slides: joint.is_some_and(|joint| joint.kind == JointKind::Prismatic),
        }
    }
}

impl Task for JointPosition {
    fn dimension(&self) -> usize {
        1
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = kinematics.q()[self.index];
    }

    #[inline]
    fn jacobian(&self, _kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let row = jacobian.row(0);
        row.fill(0.0);
        row[self.index] = 1.0;
    }

    fn bend(&self, _sigma: f64) -> f64 {
        0.0
    }

    fn steepness(&self, _kinematics: &Kinematics) -> f64 {
        1.0
    }

    fn unit(&self) -> &'static str {
        if self.slides { "m" } else { "rad" }
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        if self.index < robot.dof() {
            Ok(())
        } else {
            Err("the robot has no such joint")
        }
    }
}
