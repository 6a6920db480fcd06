//! Pose of a frame: σ = (p(q) − p_des, log(R(q) R_desᵀ)) ∈ ℝ⁶.

use super::{AXES, JacobianMut, Orientation, Task};
use crate::geometry::{Pose, Vec3};
use crate::kinematics::{Frame, Kinematics};
use crate::robot::Robot;

/// Position and orientation of a frame against desired ones: three components in [m], then three in [rad]
/// as those of [`Orientation`], in the axes of the world or of the frame that it is seen from. The desired
/// value is zero.
///
/// Where not all six can be had at once, a radian counts as much as a metre. Two tasks, a
/// [`Position`](super::Position) and an [`Orientation`], say instead which of the two matters more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FramePose {
    orientation: Orientation,
    velocity: Vec3,
}

impl FramePose {
    /// The tool against `desired`.
    pub const fn of_tool(desired: Pose) -> Self {
        Self::of(Frame::Tool, desired)
    }

    /// Any frame against `desired`.
    pub const fn of(frame: Frame, desired: Pose) -> Self {
        Self {
            orientation: Orientation::of(frame, desired),
            velocity: Vec3::ZERO,
        }
    }

    /// The same with a desired pose that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            orientation: self.orientation.relative_to(frame),
            ..self
        }
    }

    /// Desires another pose, at rest.
    pub fn set_desired(&mut self, desired: Pose) {
        self.set_desired_moving(desired, Vec3::ZERO, Vec3::ZERO);
    }

    /// Says what pose is desired now, how its origin moves [m/s] and how it turns [rad/s]. Until the next
    /// call it is taken to move on so within each tick, so call this before every tick.
    pub fn set_desired_moving(
        &mut self,
        desired: Pose,
        velocity: impl Into<Vec3>,
        angular_velocity: impl Into<Vec3>,
    ) {
        self.orientation
            .set_desired_turning(desired, angular_velocity);
        self.velocity = velocity.into();
    }

    /// The desired pose, in the frame that it is seen from.
    pub fn desired(&self) -> Pose {
        self.orientation.desired()
    }

    fn write(&self, kinematics: &Kinematics, desired: Vec3, rotation: Vec3, value: &mut [f64]) {
        let away = self.orientation.seen().origin(kinematics) - desired;
        value[..3].copy_from_slice(&away.to_array());
        value[3..].copy_from_slice(&rotation.to_array());
    }
}

impl Task for FramePose {
    fn dimension(&self) -> usize {
        6
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        let rotation = self.orientation.rotation(kinematics);
        self.write(kinematics, self.desired().origin, rotation, value);
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let seen = self.orientation.seen();
        let (motion, point) = (seen.motion(kinematics), seen.point(kinematics));
        let [x, y, z, about_x, about_y, about_z] = jacobian.rows();
        for (axis, row) in AXES.into_iter().zip([x, y, z]) {
            let along = seen.direction_in_world(kinematics, axis);
            kinematics.point_row(motion, point, along, row);
        }
        self.orientation
            .rows(kinematics, [about_x, about_y, about_z]);
    }

    fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO || self.orientation.is_moving()
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        let rotation = self.orientation.rotation_ahead(kinematics, ahead_s);
        let desired = self.desired().origin + self.velocity * ahead_s;
        self.write(kinematics, desired, rotation, value);
    }

    fn unit(&self) -> &'static str {
        "m, rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        self.orientation.check(robot)?;
        if self.velocity.is_finite() {
            Ok(())
        } else {
            Err("the velocity of the desired pose must be finite")
        }
    }
}
