//! Height above a plane: σ = nᵀ p(q) − d.

use super::{JacobianMut, Seen, Task};
use crate::geometry::Vec3;
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// Signed distance [m] of the origin of a frame to the plane nᵀ p = d of the world, or of another frame;
/// positive on the side that the unit normal n points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    seen: Seen,
    normal: Vec3,
    offset: f64,
    speed: f64,
}

impl Plane {
    /// The tool's, to the plane `offset` [m] from the origin along `normal`, any non-zero vector, whose length
    /// does not matter.
    pub fn of_tool_to(normal: impl Into<Vec3>, offset: f64) -> Self {
        Self::between(Frame::Tool, normal, offset)
    }

    /// That of any frame's origin.
    pub fn between(frame: Frame, normal: impl Into<Vec3>, offset: f64) -> Self {
        Self {
            seen: Seen::in_world(frame),
            normal: normal.into().normalized(),
            offset,
            speed: 0.0,
        }
    }

    /// Height of the tool: its z in the world.
    pub const fn height_of_tool() -> Self {
        Self::height_of(Frame::Tool)
    }

    /// Height of any frame's origin.
    pub const fn height_of(frame: Frame) -> Self {
        Self {
            seen: Seen::in_world(frame),
            normal: Vec3::new(0.0, 0.0, 1.0),
            offset: 0.0,
            speed: 0.0,
        }
    }

    /// The same with a plane that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
            ..self
        }
    }

    /// Another plane, at rest.
    pub fn set_plane(&mut self, normal: impl Into<Vec3>, offset: f64) {
        self.normal = normal.into().normalized();
        self.set_offset_moving(offset, 0.0);
    }

    /// Says where the plane is now [m] and how fast it moves along its normal [m/s]. Until the next call it
    /// is taken to move on so within each tick, so call this before every tick.
    pub fn set_offset_moving(&mut self, offset: f64, speed: f64) {
        self.offset = offset;
        self.speed = speed;
    }
}

impl Task for Plane {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.normal.dot(self.seen.origin(kinematics)) - self.offset;
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        kinematics.point_row(
            self.seen.motion(kinematics),
            self.seen.point(kinematics),
            self.seen.direction_in_world(kinematics, self.normal),
            jacobian.row(0),
        );
    }

    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        kinematics.add_point_curvature(
            self.seen.motion(kinematics),
            self.seen.point(kinematics),
            self.seen
                .direction_in_world(kinematics, self.normal * weights[0]),
            hessian,
        );
    }

    fn is_moving(&self) -> bool {
        self.speed != 0.0
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        self.value(kinematics, value);
        value[0] -= self.speed * ahead_s;
    }

    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        self.seen.reach(kinematics)
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        if !self.normal.is_unit() {
            Err("the normal must be finite and not zero")
        } else if !self.offset.is_finite() || !self.speed.is_finite() {
            Err("the offset of the plane and its speed must be finite")
        } else {
            Ok(())
        }
    }
}
