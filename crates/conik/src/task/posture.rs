//! Posture: σ = (q_i, q_j, …), the positions of several joints.

use alloc::vec::Vec;

use super::{JacobianMut, Task};
use crate::kinematics::Kinematics;
use crate::robot::Robot;

/// Positions of several joints [rad, or m for a prismatic joint], in the order given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Posture {
    joints: Vec<usize>,
}

impl Posture {
    /// All joints of the robot.
    pub fn of_all(robot: &Robot) -> Self {
        Self::of(0..robot.dof())
    }

    /// The joints of these numbers, counted from 0 at the base.
    pub fn of(joints: impl IntoIterator<Item = usize>) -> Self {
        Self {
            joints: joints.into_iter().collect(),
        }
    }
}

impl Task for Posture {
    fn dimension(&self) -> usize {
        self.joints.len()
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        for (value, joint) in value.iter_mut().zip(&self.joints) {
            *value = kinematics.q()[*joint];
        }
    }

    fn jacobian(&self, _kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        for (i, joint) in self.joints.iter().enumerate() {
            let row = jacobian.row(i);
            row.fill(0.0);
            row[*joint] = 1.0;
        }
    }

    fn bend(&self, _sigma: f64) -> f64 {
        0.0
    }

    fn steepness(&self, _kinematics: &Kinematics) -> f64 {
        1.0
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        let is_repeated = |(place, joint): (usize, &usize)| self.joints[..place].contains(joint);
        if self.joints.iter().any(|joint| *joint >= robot.dof()) {
            Err("the robot has no such joint")
        } else if self.joints.iter().enumerate().any(is_repeated) {
            Err("a joint stands in the posture twice")
        } else {
            Ok(())
        }
    }
}
