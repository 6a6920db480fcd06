//! A frame as another one sees it: what most tasks measure something of.

use crate::geometry::{Pose, Vec3};
use crate::kinematics::{Frame, Kinematics, Motion};
use crate::robot::Robot;

/// A frame and the one that it is seen from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    pub(crate) frame: Frame,
    pub(crate) from: Frame,
}

impl Seen {
    pub(crate) const fn in_world(frame: Frame) -> Self {
        Self {
            frame,
            from: Frame::World,
        }
    }

    /// Whether that is not the world.
    #[inline]
    pub(crate) fn is_from_elsewhere(self) -> bool {
        self.from != Frame::World
    }

    pub(crate) const fn from(self, from: Frame) -> Self {
        Self { from, ..self }
    }

    /// The origin of the frame in the world [m].
    #[inline]
    pub(crate) fn point(self, kinematics: &Kinematics) -> Vec3 {
        kinematics.world_from(self.frame).origin
    }

    /// The z axis of the frame in the world.
    #[inline]
    pub(crate) fn z_axis(self, kinematics: &Kinematics) -> Vec3 {
        kinematics.world_from(self.frame).z_axis
    }

    /// Which joints are between the two.
    #[inline]
    pub(crate) fn motion(self, kinematics: &Kinematics) -> Motion {
        match self.from {
            Frame::World => kinematics.motion(self.frame),
            from => kinematics.motion_between(from, self.frame),
        }
    }

    /// A direction of the frame that it is seen from, in the world.
    pub(crate) fn direction_in_world(self, kinematics: &Kinematics, direction: Vec3) -> Vec3 {
        kinematics.world_from(self.from).rotate(direction)
    }

    /// The origin of the frame, in the frame that it is seen from [m].
    #[inline]
    pub(crate) fn origin(self, kinematics: &Kinematics) -> Vec3 {
        let origin = self.point(kinematics);
        match self.from {
            Frame::World => origin,
            from => kinematics.world_from(from).untransform(origin),
        }
    }

    /// The frame in the one that it is seen from.
    pub(crate) fn pose(self, kinematics: &Kinematics) -> Pose {
        let pose = *kinematics.world_from(self.frame);
        match self.from {
            Frame::World => pose,
            from => kinematics.world_from(from).inverse() * pose,
        }
    }

    /// A bound on how fast the origin moves [m/rad], see [`Task::steepness`](super::Task::steepness).
    pub(crate) fn reach(self, kinematics: &Kinematics) -> f64 {
        match self.from {
            Frame::World => kinematics.reach(),
            _ => kinematics.span(),
        }
    }

    pub(crate) fn check(self, robot: &Robot) -> Result<(), &'static str> {
        if !robot.has(self.frame) || !robot.has(self.from) {
            return Err("the robot has no such link");
        }
        let body = |frame| robot.attachment(frame).map(|(body, _)| body);
        if body(self.frame) == body(self.from) {
            return Err("no joint is between the frame and the one that it is seen from");
        }
        Ok(())
    }
}
