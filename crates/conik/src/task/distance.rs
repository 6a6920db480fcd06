//! Distance to a point: σ = √((p_o − p)ᵀ(p_o − p)), Eqs. (9) and (10): collision avoidance.

use super::{JacobianMut, Seen, Task, norm};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics, Motion};
use crate::robot::Robot;

/// Distance of the origin of a frame to a point of the world, or of another frame [m].
///
/// At the point itself the direction is undefined and the Jacobian is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    seen: Seen,
    point: Vec3,
    velocity: Vec3,
}

impl Distance {
    /// Distance of the tool to `point` [m].
    pub fn of_tool_to(point: impl Into<Vec3>) -> Self {
        Self::between(Frame::Tool, point)
    }

    /// Distance of any frame's origin to `point` [m].
    pub fn between(frame: Frame, point: impl Into<Vec3>) -> Self {
        Self {
            seen: Seen::in_world(frame),
            point: point.into(),
            velocity: Vec3::ZERO,
        }
    }

    /// The same with a point that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
            ..self
        }
    }

    /// The point, in the frame that it is fixed to [m].
    pub fn point(&self) -> Vec3 {
        self.point
    }

    /// Velocity of the point in that frame [m/s].
    pub fn velocity(&self) -> Vec3 {
        self.velocity
    }

    /// Puts the point somewhere else [m], at rest.
    pub fn set_point(&mut self, point: impl Into<Vec3>) {
        self.set_point_moving(point, Vec3::ZERO);
    }

    /// Says where the point is now [m] and how it moves [m/s]. Until the next call it is taken to move
    /// on at that velocity within each tick, so call this before every tick.
    pub fn set_point_moving(&mut self, point: impl Into<Vec3>, velocity: impl Into<Vec3>) {
        self.point = point.into();
        self.velocity = velocity.into();
    }

    /// What it is at this moment to one who stands in the world.
    #[cold]
    fn in_world(&self, kinematics: &Kinematics) -> Self {
        let pose = kinematics.world_from(self.seen.from);
        Self {
            seen: Seen::in_world(self.seen.frame),
            point: pose.transform(self.point),
            velocity: pose.rotate(self.velocity),
        }
    }

    /// A call of its own, so that those who stand in the world do not pay for it.
    #[cold]
    #[inline(never)]
    fn value_from_elsewhere(&self, kinematics: &Kinematics, value: &mut [f64]) {
        self.in_world(kinematics).value(kinematics, value);
    }

    #[inline]
    fn away_from_point(&self, kinematics: &Kinematics) -> Vec3 {
        self.seen.point(kinematics) - self.point
    }

    #[inline]
    fn row(&self, kinematics: &Kinematics, motion: Motion, row: &mut [f64]) {
        let away = self.away_from_point(kinematics);
        let direction = norm::direction(away);
        kinematics.point_row(motion, self.seen.point(kinematics), direction, row);
    }
}

impl Task for Distance {
    fn dimension(&self) -> usize {
        1
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        if self.seen.is_from_elsewhere() {
            return self.value_from_elsewhere(kinematics, value);
        }
        value[0] = self.away_from_point(kinematics).norm();
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
        let away = self.in_world(kinematics).away_from_point(kinematics);
        let motion = self.seen.motion(kinematics);
        let point = self.seen.point(kinematics);
        let along = norm::direction(away) * weights[0];
        kinematics.add_point_curvature(motion, point, along, hessian);
        let row = |along: Vec3, row: &mut [f64]| kinematics.point_row(motion, point, along, row);
        norm::add_bending(away, weights[0], row, kinematics.dof(), hessian);
    }

    fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let now = self.in_world(kinematics);
        value[0] = (now.away_from_point(kinematics) - now.velocity * ahead_s).norm();
    }

    fn bend(&self, sigma: f64) -> f64 {
        norm::bend(sigma)
    }

    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        // The point stays where it is on the other frame, however far that is from its joints.
        match self.seen.from {
            Frame::World => kinematics.reach(),
            _ => kinematics.span() + kinematics.turning() * self.point.norm(),
        }
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        if self.point.to_array().iter().all(|v| v.is_finite()) {
            Ok(())
        } else {
            Err("the point must be finite")
        }
    }
}
