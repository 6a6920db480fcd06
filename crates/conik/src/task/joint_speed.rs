//! Speed of one joint: q̇_i = v. As a task σ = q_i whose desired value runs ahead of it, σ̇_des = v, and
//! leaves no error: only the feed-forward remains.

use super::{JacobianMut, Task};
use crate::kinematics::Kinematics;
use crate::robot::Robot;

/// One joint moves at a speed [rad/s, or m/s for a prismatic joint]; the value is its position.
///
/// For equality tasks: whatever value is desired, and whatever gain, the error is zero and the joint is
/// asked for this speed and nothing else. Ground lost to tasks above is not made up for, as a
/// [`JointPosition`](super::JointPosition) with a desired value that moves would. As a set it makes no
/// sense: sets are of positions, q̇ is no function of q. A range of speeds is what the limits of a
/// [`Joint`](crate::Joint) are for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSpeed {
    index: usize,
    speed: f64,
}

impl JointSpeed {
    /// Joint `index`, counted from 0 at the base, at `speed` [rad/s or m/s].
    pub const fn of(index: usize, speed: f64) -> Self {
        Self { index, speed }
    }

    /// The speed asked for [rad/s or m/s].
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Asks for another speed [rad/s or m/s].
    pub fn set_speed(&mut self, speed: f64) {
        self.speed = speed;
    }
}

impl Task for JointSpeed {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = kinematics.q()[self.index];
    }

    fn jacobian(&self, _kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let row = jacobian.row(0);
        row.fill(0.0);
        row[self.index] = 1.0;
    }

    fn error(&self, _desired: &[f64], _value: &[f64], error: &mut [f64]) {
        error[0] = 0.0;
    }

    fn is_moving(&self) -> bool {
        self.speed != 0.0
    }

    /// Where the joint is as the desired value sees it that runs ahead.
    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        value[0] = kinematics.q()[self.index] - self.speed * ahead_s;
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
        if self.index >= robot.dof() {
            Err("the robot has no such joint")
        } else if !self.speed.is_finite() {
            Err("the speed must be finite")
        } else {
            Ok(())
        }
    }
}
