//! Where the joints of a robot are in one configuration: what a picture of it is drawn from.

use alloc::vec::Vec;

use super::{JointKind, Robot};
use crate::geometry::Pose;
use crate::kinematics::Frame;

/// A joint in one configuration, or one that follows another, in the [world](Frame::World).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedJoint {
    /// Index of the joint that carries it; `None`: it stands on what does not move.
    pub carried_by: Option<usize>,
    /// How it moves.
    pub kind: JointKind,
    /// Index of the joint of the robot that it is, or that it follows.
    pub driven_by: usize,
    /// Its frame, which does not move with it: it turns about, or slides along, the z axis [m].
    pub frame: Pose,
    /// The same frame, moved.
    pub moved: Pose,
    /// The frame of the body that it moves.
    pub body: Pose,
}

impl Robot {
    /// The joints at `q` [rad or m], those that follow others among them, each after what carries it. Not
    /// for the control loop: it allocates.
    ///
    /// # Panics
    /// If `q` has not one entry per joint.
    pub fn placed_joints(&self, q: &[f64]) -> Vec<PlacedJoint> {
        assert_eq!(q.len(), self.dof(), "one position per joint");
        let mut joints: Vec<PlacedJoint> = Vec::with_capacity(self.bodies.len());
        for body in &self.bodies {
            let carried_by = body.parent.checked_sub(1);
            let carrier = carried_by.map_or(Pose::IDENTITY, |joint| joints[joint].body);
            let frame = carrier * body.placement;
            let position = body.drive.multiplier * q[body.drive.joint] + body.drive.offset;
            let along = frame.z_axis * position;
            let moved = match body.kind {
                JointKind::Revolute => Pose {
                    x_axis: frame.x_axis.turned_by(along),
                    y_axis: frame.y_axis.turned_by(along),
                    ..frame
                },
                JointKind::Prismatic => Pose {
                    origin: frame.origin + along,
                    ..frame
                },
            };
            joints.push(PlacedJoint {
                carried_by,
                kind: body.kind,
                driven_by: body.drive.joint,
                frame,
                moved,
                body: moved * body.joint_from_body,
            });
        }
        joints
    }

    /// Index among [`placed_joints`](Self::placed_joints) of the last joint that moves a frame; `None` if
    /// none does, or if there is no such frame.
    pub fn carrier(&self, frame: Frame) -> Option<usize> {
        let (body, _) = self.attachment(frame)?;
        body.index().checked_sub(1)
    }
}
