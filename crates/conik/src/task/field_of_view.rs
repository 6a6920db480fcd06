//! Field of view: σ = √((a_des − a)ᵀ(a_des − a)), a the z axis of a frame, Eqs. (13) to (17).

use super::{JacobianMut, Seen, Task, norm};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics, Motion};
use crate::robot::Robot;

/// Norm of the difference between a desired direction and the z axis of a frame [-]:
/// 2 sin(angle / 2), from 0 (aligned) to 2 (opposite).
///
/// Exactly aligned, the Jacobian is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldOfView {
    seen: Seen,
    direction: Vec3,
    angular_velocity: Vec3,
}

impl FieldOfView {
    /// The tool's z axis against `direction`, any non-zero vector of the world; its length
    /// does not matter.
    pub fn of_tool_along(direction: impl Into<Vec3>) -> Self {
        Self::between(Frame::Tool, direction)
    }

    /// The z axis of any frame against `direction`.
    pub fn between(frame: Frame, direction: impl Into<Vec3>) -> Self {
        Self {
            seen: Seen::in_world(frame),
            direction: direction.into().normalized(),
            angular_velocity: Vec3::ZERO,
        }
    }

    /// The same with a direction that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
            ..self
        }
    }

    /// The desired direction in the frame that it is fixed to, of length 1.
    pub fn direction(&self) -> Vec3 {
        self.direction
    }

    /// Angular velocity of the desired direction in that frame [rad/s].
    pub fn angular_velocity(&self) -> Vec3 {
        self.angular_velocity
    }

    /// Desires another direction, at rest.
    pub fn set_direction(&mut self, direction: impl Into<Vec3>) {
        self.set_direction_turning(direction, Vec3::ZERO);
    }

    /// Says what direction is desired now and how it turns [rad/s]. Until the next call it is taken to
    /// turn on at that rate within each tick, so call this before every tick.
    pub fn set_direction_turning(
        &mut self,
        direction: impl Into<Vec3>,
        angular_velocity: impl Into<Vec3>,
    ) {
        self.direction = direction.into().normalized();
        self.angular_velocity = angular_velocity.into();
    }

    /// What it is at this moment to one who stands in the world.
    #[cold]
    fn in_world(&self, kinematics: &Kinematics) -> Self {
        let pose = kinematics.world_from(self.seen.from);
        Self {
            seen: Seen::in_world(self.seen.frame),
            direction: pose.rotate(self.direction),
            angular_velocity: pose.rotate(self.angular_velocity),
        }
    }

    /// A call of its own, so that those who stand in the world do not pay for it.
    #[cold]
    #[inline(never)]
    fn value_from_elsewhere(&self, kinematics: &Kinematics, value: &mut [f64]) {
        self.in_world(kinematics).value(kinematics, value);
    }

    #[inline]
    fn away_from_desired(&self, kinematics: &Kinematics) -> Vec3 {
        self.seen.z_axis(kinematics) - self.direction
    }

    #[inline]
    fn row(&self, kinematics: &Kinematics, motion: Motion, row: &mut [f64]) {
        let away = self.away_from_desired(kinematics);
        let direction = norm::direction(away);
        kinematics.axis_row(motion, self.seen.z_axis(kinematics), direction, row);
    }
}

impl Task for FieldOfView {
    fn dimension(&self) -> usize {
        1
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        if self.seen.is_from_elsewhere() {
            return self.value_from_elsewhere(kinematics, value);
        }
        value[0] = self.away_from_desired(kinematics).norm();
    }

    #[inline]
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let motion = self.seen.motion(kinematics);
        if self.seen.is_from_elsewhere() {
            return self
                .in_world(kinematics)
                .row(kinematics, motion, jacobian.row(0));
        }
        self.row(kinematics, motion, jacobian.row(0));
    }

    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let away = self.in_world(kinematics).away_from_desired(kinematics);
        let motion = self.seen.motion(kinematics);
        let z_axis = self.seen.z_axis(kinematics);
        let along = norm::direction(away) * weights[0];
        kinematics.add_axis_curvature(motion, z_axis, along, hessian);
        let row = |along: Vec3, row: &mut [f64]| kinematics.axis_row(motion, z_axis, along, row);
        norm::add_bending(away, weights[0], row, kinematics.dof(), hessian);
    }

    fn is_moving(&self) -> bool {
        self.angular_velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let now = self.in_world(kinematics);
        let later = now.direction.turned_by(now.angular_velocity * ahead_s);
        value[0] = (now.seen.z_axis(kinematics) - later).norm();
    }

    fn bend(&self, sigma: f64) -> f64 {
        norm::bend(sigma)
    }

    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        kinematics.turning()
    }

    fn unit(&self) -> &'static str {
        "-"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        // False for NaN too, which is what a zero or infinite vector normalises to.
        if (self.direction.norm() - 1.0).abs() < 1e-9 {
            Ok(())
        } else {
            Err("the direction must be finite and not zero")
        }
    }
}
