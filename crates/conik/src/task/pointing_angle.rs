//! Angle between an axis of a frame and a direction: σ = atan2(|a × d|, a · d).

use super::{JacobianMut, NEARLY_ZERO, Seen, Task, add_outer};
use crate::geometry::Vec3;
use crate::joints::JointVec;
use crate::kinematics::{Frame, Kinematics};
use crate::real::atan2;
use crate::robot::Robot;

/// Angle [rad] between an axis of a frame, its z axis unless it is told another, and a direction; from 0
/// (aligned) to π (opposite).
///
/// Exactly aligned or opposite, the Jacobian is undefined, and zero here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointingAngle {
    seen: Seen,
    axis: Vec3,
    direction: Vec3,
    angular_velocity: Vec3,
}

impl PointingAngle {
    /// The tool's z axis against `direction`, any non-zero vector of the world; its length does not matter.
    pub fn of_tool_along(direction: impl Into<Vec3>) -> Self {
        Self::between(Frame::Tool, direction)
    }

    /// The z axis of any frame against `direction`.
    pub fn between(frame: Frame, direction: impl Into<Vec3>) -> Self {
        Self {
            seen: Seen::in_world(frame),
            axis: Vec3::new(0.0, 0.0, 1.0),
            direction: direction.into().normalized(),
            angular_velocity: Vec3::ZERO,
        }
    }

    /// The same with another axis, any non-zero vector of the frame.
    #[must_use]
    pub fn with_axis(self, axis: impl Into<Vec3>) -> Self {
        Self {
            axis: axis.into().normalized(),
            ..self
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

    /// The axis and the direction in the world.
    fn in_world(&self, kinematics: &Kinematics) -> (Vec3, Vec3) {
        let axis = kinematics.world_from(self.seen.frame).rotate(self.axis);
        (
            axis,
            self.seen.direction_in_world(kinematics, self.direction),
        )
    }

    fn row(&self, kinematics: &Kinematics, row: &mut [f64]) {
        let (axis, direction) = self.in_world(kinematics);
        let about = direction.cross(axis).direction_or_zero();
        kinematics.turn_row(self.seen.motion(kinematics), about, row);
    }
}

/// The angle between two directions [rad], accurate everywhere, which an arc cosine is not.
pub(super) fn angle_between(a: Vec3, b: Vec3) -> f64 {
    atan2(a.cross(b).norm(), a.dot(b))
}

/// How strongly such an angle bends: ∂²σ/∂ω² across the axis of the turn is cot σ.
pub(super) fn bend_of_angle(sigma: f64) -> f64 {
    1.0 / (sigma.min(core::f64::consts::PI - sigma).abs() + NEARLY_ZERO)
}

impl Task for PointingAngle {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        let (axis, direction) = self.in_world(kinematics);
        value[0] = angle_between(axis, direction);
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        self.row(kinematics, jacobian.row(0));
    }

    /// With c = a · d = cos σ: ∇²σ = −(∇²c + c ∇σ ∇σᵀ) / sin σ.
    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let (axis, direction) = self.in_world(kinematics);
        let sine = axis.cross(direction).norm();
        if sine < NEARLY_ZERO {
            return;
        }
        let weight = -weights[0] / sine;
        let motion = self.seen.motion(kinematics);
        kinematics.add_axis_curvature(motion, axis, direction * weight, hessian);
        let mut row = JointVec::zeros(kinematics.dof());
        self.row(kinematics, &mut row);
        add_outer(hessian, weight * axis.dot(direction), &row);
    }

    fn is_moving(&self) -> bool {
        self.angular_velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let direction = self.direction.turned_by(self.angular_velocity * ahead_s);
        let later = Self { direction, ..*self };
        later.value(kinematics, value);
    }

    fn bend(&self, sigma: f64) -> f64 {
        bend_of_angle(sigma)
    }

    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        kinematics.turning()
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        if !self.direction.is_unit() || !self.axis.is_unit() {
            Err("the direction and the axis must be finite and not zero")
        } else if !self.angular_velocity.is_finite() {
            Err("the angular velocity of the direction must be finite")
        } else {
            Ok(())
        }
    }
}
