//! Looking at a point p: σ = atan2(|a × v|, a · v), a the z axis of a frame and v = p − o the line of sight.

use super::pointing_angle::{angle_between, bend_of_angle};
use super::{JacobianMut, NEARLY_ZERO, Seen, Task};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// Angle [rad] between the z axis of a frame and the line of sight from its origin to a point of the
/// world, or of another frame; from 0 (it looks at the point) to π.
///
/// Looking exactly at the point or away from it, or being there, the Jacobian is undefined, and zero here.
/// Near the point it grows as the inverse of the distance; a [`Distance`](super::Distance) set above keeps
/// away from that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAt {
    seen: Seen,
    point: Vec3,
    velocity: Vec3,
}

impl LookAt {
    /// The tool's z axis, at `point` [m].
    pub fn of_tool_at(point: impl Into<Vec3>) -> Self {
        Self::between(Frame::Tool, point)
    }

    /// The z axis of any frame, at `point` [m].
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

    /// The z axis and the line of sight in the world.
    fn in_world(&self, kinematics: &Kinematics) -> (Vec3, Vec3) {
        let frame = kinematics.world_from(self.seen.frame);
        let point = kinematics.world_from(self.seen.from).transform(self.point);
        (frame.z_axis, point - frame.origin)
    }
}

impl Task for LookAt {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        let (axis, sight) = self.in_world(kinematics);
        value[0] = angle_between(axis, sight);
    }

    /// To the frame the point is what moves: the angle grows with the speed of the frame, as far out as the
    /// point is, towards the axis.
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let (axis, sight) = self.in_world(kinematics);
        let distance = sight.norm();
        let towards_axis = if distance < NEARLY_ZERO {
            Vec3::ZERO
        } else {
            let sight = sight * (1.0 / distance);
            let across = sight.cross(axis).cross(sight);
            across.direction_or_zero() * (1.0 / distance)
        };
        kinematics.point_row(
            self.seen.motion(kinematics),
            self.seen.point(kinematics) + sight,
            towards_axis,
            jacobian.row(0),
        );
    }

    fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let point = self.point + self.velocity * ahead_s;
        let later = Self { point, ..*self };
        later.value(kinematics, value);
    }

    fn bend(&self, sigma: f64) -> f64 {
        bend_of_angle(sigma)
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        if self.point.is_finite() && self.velocity.is_finite() {
            Ok(())
        } else {
            Err("the point and its velocity must be finite")
        }
    }
}
