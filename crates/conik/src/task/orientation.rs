//! Orientation: σ = log(R(q) R_desᵀ) ∈ ℝ³, and its length, the angle that is left to turn.

use super::{AXES, JacobianMut, Seen, Task};
use crate::geometry::{Pose, Vec3};
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;
use crate::rotation::inverse_left_jacobian_transposed;

/// The rotation vector [rad] that takes a desired orientation to that of a frame, in the axes of the world
/// or of the frame that it is seen from; dimension 3, the desired value is zero.
///
/// There is no gimbal: value and Jacobian are finite everywhere, and the Jacobian is regular. The value is
/// continuous but at half a turn, where an axis and its opposite lead to the same place: there it is one of
/// the two, of length π, and across it jumps to the other. An equality task that starts there takes one
/// way and keeps to it, for the angle falls from then on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    seen: Seen,
    desired: Pose,
    angular_velocity: Vec3,
}

/// The angle [rad] between the orientation of a frame and a desired one, from 0 to π.
///
/// At 0 the axis is undefined and the Jacobian is zero; at π it is that of one of the two ways back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientationAngle {
    orientation: Orientation,
}

impl Orientation {
    /// The tool's orientation against that of `desired`, whose origin does not matter.
    pub const fn of_tool(desired: Pose) -> Self {
        Self::of(Frame::Tool, desired)
    }

    /// The orientation of any frame.
    pub const fn of(frame: Frame, desired: Pose) -> Self {
        Self {
            seen: Seen::in_world(frame),
            desired,
            angular_velocity: Vec3::ZERO,
        }
    }

    /// The same with a desired orientation that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            seen: self.seen.from(frame),
            ..self
        }
    }

    /// Desires another orientation, at rest.
    pub fn set_desired(&mut self, desired: Pose) {
        self.set_desired_turning(desired, Vec3::ZERO);
    }

    /// Says what orientation is desired now and how it turns [rad/s], in the axes of the frame that it is
    /// seen from. Until the next call it is taken to turn on at that rate within each tick, so call this
    /// before every tick.
    pub fn set_desired_turning(&mut self, desired: Pose, angular_velocity: impl Into<Vec3>) {
        self.desired = desired;
        self.angular_velocity = angular_velocity.into();
    }

    /// The desired orientation, in the frame that it is seen from.
    pub fn desired(&self) -> Pose {
        self.desired
    }

    /// How the desired orientation turns [rad/s].
    pub fn angular_velocity(&self) -> Vec3 {
        self.angular_velocity
    }

    pub(super) const fn seen(&self) -> Seen {
        self.seen
    }

    pub(super) fn rotation(&self, kinematics: &Kinematics) -> Vec3 {
        (self.seen.pose(kinematics) * self.desired.inverse()).rotation_vector()
    }

    /// The rotation vector after a while in which the robot stays; of the two that lead there the one nearer
    /// to that of now, for what turns on does not jump.
    pub(super) fn rotation_ahead(&self, kinematics: &Kinematics, ahead_s: f64) -> Vec3 {
        let now = self.rotation(kinematics);
        let turned = Pose::turned(self.angular_velocity * ahead_s) * self.desired;
        let later = (self.seen.pose(kinematics) * turned.inverse()).rotation_vector();
        let angle = later.norm();
        if now.dot(later) < 0.0 && angle > 1.0 {
            later * (1.0 - core::f64::consts::TAU / angle)
        } else {
            later
        }
    }

    /// The rows of the Jacobian, one for each axis: J⁻¹ ω.
    pub(super) fn rows(&self, kinematics: &Kinematics, rows: [&mut [f64]; 3]) {
        let motion = self.seen.motion(kinematics);
        let rotation = self.rotation(kinematics);
        for (axis, row) in AXES.into_iter().zip(rows) {
            let about = inverse_left_jacobian_transposed(rotation, axis);
            let about = self.seen.direction_in_world(kinematics, about);
            kinematics.turn_row(motion, about, row);
        }
    }
}

impl Task for Orientation {
    fn dimension(&self) -> usize {
        3
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value.copy_from_slice(&self.rotation(kinematics).to_array());
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        self.rows(kinematics, jacobian.rows());
    }

    fn is_moving(&self) -> bool {
        self.angular_velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        value.copy_from_slice(&self.rotation_ahead(kinematics, ahead_s).to_array());
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.seen.check(robot)?;
        if self.desired.is_rigid() && self.angular_velocity.is_finite() {
            Ok(())
        } else {
            Err("the desired orientation must be a rotation, and its angular velocity finite")
        }
    }
}

impl OrientationAngle {
    /// Of the tool, to the orientation of `desired`, whose origin does not matter.
    pub const fn of_tool_to(desired: Pose) -> Self {
        Self::between(Frame::Tool, desired)
    }

    /// Of any frame.
    pub const fn between(frame: Frame, desired: Pose) -> Self {
        Self {
            orientation: Orientation::of(frame, desired),
        }
    }

    /// The same with a desired orientation that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            orientation: self.orientation.relative_to(frame),
        }
    }

    /// What is desired, and how it turns.
    pub const fn orientation(&self) -> &Orientation {
        &self.orientation
    }

    /// The same, to change it.
    pub fn orientation_mut(&mut self) -> &mut Orientation {
        &mut self.orientation
    }
}

impl Task for OrientationAngle {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.orientation.rotation(kinematics).norm();
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let rotation = self.orientation.rotation(kinematics);
        // The axis of the turn is an eigenvector of J⁻¹.
        let about = rotation.direction_or_zero();
        let seen = self.orientation.seen;
        let about = seen.direction_in_world(kinematics, about);
        kinematics.turn_row(seen.motion(kinematics), about, jacobian.row(0));
    }

    fn is_moving(&self) -> bool {
        self.orientation.is_moving()
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let later = self.orientation.rotation_ahead(kinematics, ahead_s).norm();
        value[0] = later.min(core::f64::consts::TAU - later);
    }

    /// ∂²σ/∂ω² across the axis is cot(σ/2) / 2.
    fn bend(&self, sigma: f64) -> f64 {
        1.0 / (sigma + super::NEARLY_ZERO)
    }

    fn steepness(&self, kinematics: &Kinematics) -> f64 {
        kinematics.turning()
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.orientation.check(robot)
    }
}
