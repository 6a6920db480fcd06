//! Distance of two shapes: σ = the least distance of their points, negative where they overlap.
//!
//! J = n · (velocity of one closest point, as the other sees it), n the direction between them: where the
//! points are on their shapes changes nothing to the first order.

use super::{JacobianMut, Seen, Task};
use crate::geometry::{Pose, Vec3};
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;
use crate::shape::{Closest, Shape};

/// The shortest radius [m] with which closest points are taken to turn about each other.
const LEAST_RADIUS: f64 = 0.01;

/// Distance between a shape on a frame of the robot and another one, in the world or on another frame
/// [m]; negative where they overlap.
///
/// Which pairs of shapes have a distance, and what it is where they overlap, is said at
/// [`Shape::closest_to`]. Where closest points are not unique the Jacobian is that of one pair of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeDistance {
    seen: Seen,
    shape: Shape,
    other: Shape,
    shift: Vec3,
    velocity: Vec3,
}

impl ShapeDistance {
    /// Distance between a shape that is fixed to a frame, and given in it, and one in the world.
    pub fn between(frame: Frame, shape: impl Into<Shape>, other: impl Into<Shape>) -> Self {
        Self {
            seen: Seen::in_world(frame),
            shape: shape.into(),
            other: other.into(),
            shift: Vec3::ZERO,
            velocity: Vec3::ZERO,
        }
    }

    /// The same, with the other shape fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
            ..self
        }
    }

    /// The shape on the frame.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// The other shape, where it was given.
    pub fn other(&self) -> Shape {
        self.other
    }

    /// Says how far the other shape is now from where it was given [m], and how it moves on [m/s], both in
    /// the frame that it is fixed to. Until the next call it is taken to move on at that velocity within
    /// each tick, so call this before every tick.
    pub fn set_shift_moving(&mut self, shift: impl Into<Vec3>, velocity: impl Into<Vec3>) {
        self.shift = shift.into();
        self.velocity = velocity.into();
    }

    /// Where the two are closest, in the world.
    pub fn closest(&self, kinematics: &Kinematics) -> Closest {
        self.closest_after(kinematics, self.shift)
    }

    #[inline]
    fn closest_after(&self, kinematics: &Kinematics, shift: Vec3) -> Closest {
        let shape = self.shape.placed(kinematics.world_from(self.seen.frame));
        let other = match self.seen.from {
            Frame::World if shift == Vec3::ZERO => self.other,
            from => self
                .other
                .placed(&(*kinematics.world_from(from) * Pose::at(shift))),
        };
        // A pair without a distance was refused with the stack.
        shape.closest_to(&other).unwrap_or(NOWHERE)
    }
}

/// Between two shapes that have no distance.
const NOWHERE: Closest = Closest {
    distance: 0.0,
    normal: Vec3::ZERO,
    on_first: Vec3::ZERO,
    on_second: Vec3::ZERO,
};

impl Task for ShapeDistance {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.closest(kinematics).distance;
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let closest = self.closest(kinematics);
        // Between the two points, which lie along the normal, turning about either makes no difference.
        kinematics.point_row(
            self.seen.motion(kinematics),
            closest.on_first,
            closest.normal,
            jacobian.row(0),
        );
    }

    fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let shift = self.shift + self.velocity * ahead_s;
        value[0] = self.closest_after(kinematics, shift).distance;
    }

    /// As of two points that are as far apart as the middles of the rounded shapes.
    fn bend(&self, sigma: f64) -> f64 {
        let radius = sigma.abs() + self.shape.rounding() + self.other.rounding();
        1.0 / radius.max(LEAST_RADIUS)
    }

    /// A closest point is on its shape; seen from a joint of the other frame, that can be anywhere.
    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        let extent = self.shape.extent();
        let (reach, arm) = match self.seen.from {
            Frame::World if extent.is_finite() => (kinematics.reach(), extent),
            _ => {
                let other = self.other.extent() + self.shift.norm();
                (kinematics.span(), extent.min(other))
            }
        };
        // A joint that others follow turns the shape by more than it turns itself.
        reach + kinematics.turning() * arm
    }

    fn is_costly(&self) -> bool {
        true
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        self.shape.check()?;
        self.other.check()?;
        self.shape.check_pair(&self.other)
    }
}
