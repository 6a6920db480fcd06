//! What follows from one configuration: where every frame is, and how its points move.

use alloc::vec::Vec;

use crate::geometry::{Pose, Vec3};
use crate::joints::JointVec;
use crate::robot::dh::Link;
use crate::robot::{JointKind, Robot};

/// A frame of the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frame {
    /// The frame after the last joint.
    #[default]
    Tool,
    /// The frame after the first `n` joints; 0 is the base.
    Link(usize),
}

/// The poses of all frames of a robot in one configuration q, and the Jacobians of its points.
///
/// Everything is expressed in the base frame. Made once per robot; [`update`](Self::update) then
/// brings it to another configuration without allocating.
#[derive(Clone, Debug)]
pub struct Kinematics {
    links: Vec<Link>,
    /// Pose of the base, then of the frame after each joint. Joint i acts about the z axis of the
    /// frame before it.
    base_from_frame: Vec<Pose>,
    q: JointVec,
}

impl Kinematics {
    /// The robot at q = 0.
    pub fn new(robot: &Robot) -> Self {
        let mut kinematics = Self {
            links: robot.joints().iter().map(Link::new).collect(),
            base_from_frame: alloc::vec![Pose::IDENTITY; robot.dof() + 1],
            q: JointVec::zeros(robot.dof()),
        };
        kinematics.place_frames();
        kinematics
    }

    /// Brings the robot to `q` [rad or m]. A configuration that is already there costs nothing.
    ///
    /// # Panics
    /// If `q` has not one entry per joint.
    #[inline]
    pub fn update(&mut self, q: &[f64]) {
        assert_eq!(q.len(), self.links.len(), "one position per joint");
        if *self.q != *q {
            self.q.copy_from_slice(q);
            self.place_frames();
        }
    }

    fn place_frames(&mut self) {
        let mut pose = Pose::IDENTITY;
        let frames = &mut self.base_from_frame[1..];
        for ((link, &position), frame) in self.links.iter().zip(self.q.iter()).zip(frames) {
            pose = link.advance(&pose, position);
            *frame = pose;
        }
    }

    /// Number of joints.
    #[inline]
    pub fn dof(&self) -> usize {
        self.links.len()
    }

    /// The configuration [rad or m].
    #[inline]
    pub fn q(&self) -> &JointVec {
        &self.q
    }

    /// Pose of a frame in the base frame.
    ///
    /// # Panics
    /// If the robot has no such frame; [`Stack`](crate::Stack) checks its tasks' frames once.
    #[inline]
    pub fn base_from(&self, frame: Frame) -> &Pose {
        &self.base_from_frame[self.joints_before(frame)]
    }

    /// Number of joints that move a frame.
    #[inline]
    pub fn joints_before(&self, frame: Frame) -> usize {
        match frame {
            Frame::Tool => self.links.len(),
            Frame::Link(joints) => joints,
        }
    }

    /// The Jacobian of the origin of `frame`, Eq. (5) of the paper: `rows` is its x, y and z row, each
    /// of one entry per joint [m/rad, or 1 for a prismatic joint].
    #[inline]
    pub fn point_rows(&self, frame: Frame, rows: [&mut [f64]; 3]) {
        let point = self.base_from(frame).origin;
        let [x, y, z] = rows;
        self.fill_row(frame, z, |kind, joint| match kind {
            JointKind::Revolute => joint.z_axis.cross(point - joint.origin).z,
            JointKind::Prismatic => joint.z_axis.z,
        });
        self.fill_row(frame, y, |kind, joint| match kind {
            JointKind::Revolute => joint.z_axis.cross(point - joint.origin).y,
            JointKind::Prismatic => joint.z_axis.y,
        });
        self.fill_row(frame, x, |kind, joint| match kind {
            JointKind::Revolute => joint.z_axis.cross(point - joint.origin).x,
            JointKind::Prismatic => joint.z_axis.x,
        });
    }

    /// One row of the Jacobian of the origin of `frame`: `row · q̇` is the speed [m/s] of that
    /// origin along `direction`.
    #[inline]
    pub fn point_row(&self, frame: Frame, direction: Vec3, row: &mut [f64]) {
        let point = self.base_from(frame).origin;
        self.fill_row(frame, row, |kind, joint| match kind {
            // direction · (z × r) = z · (r × direction)
            JointKind::Revolute => joint.z_axis.dot((point - joint.origin).cross(direction)),
            JointKind::Prismatic => direction.dot(joint.z_axis),
        });
    }

    /// One row of the Jacobian of the z axis of `frame`: `row · q̇` is the rate [1/s] of that unit
    /// vector along `direction`. Eq. (14) of the paper is three such rows.
    #[inline]
    pub fn axis_row(&self, frame: Frame, direction: Vec3, row: &mut [f64]) {
        let moment = self.base_from(frame).z_axis.cross(direction);
        self.fill_row(frame, row, |kind, joint| match kind {
            JointKind::Revolute => joint.z_axis.dot(moment),
            JointKind::Prismatic => 0.0,
        });
    }

    /// Adds the second derivatives [m/rad²] of the origin of `frame` along `direction` to `hessian`, one
    /// row of one entry per joint for each joint.
    pub fn add_point_curvature(&self, frame: Frame, direction: Vec3, hessian: &mut [f64]) {
        self.add_curvature(frame, hessian, |axis, row| {
            self.point_row(frame, direction.cross(axis), row);
        });
    }

    /// Adds the second derivatives [1/rad²] of the z axis of `frame` along `direction` to `hessian`, one
    /// row of one entry per joint for each joint.
    pub fn add_axis_curvature(&self, frame: Frame, direction: Vec3, hessian: &mut [f64]) {
        self.add_curvature(frame, hessian, |axis, row| {
            self.axis_row(frame, direction.cross(axis), row);
        });
    }

    /// Joint i turns all that joint j ≥ i does: the second derivative along d is d · (zᵢ × Jⱼ), which
    /// is column j of the row along d × zᵢ.
    fn add_curvature(
        &self,
        frame: Frame,
        hessian: &mut [f64],
        row_along: impl Fn(Vec3, &mut [f64]),
    ) {
        let n = self.dof();
        let mut row = JointVec::zeros(n);
        for i in 0..self.joints_before(frame) {
            if self.links[i].kind() == JointKind::Prismatic {
                continue;
            }
            row_along(self.base_from_frame[i].z_axis, &mut row);
            hessian[i * n + i] += row[i];
            for j in i + 1..n {
                hessian[i * n + j] += row[j];
                hessian[j * n + i] += row[j];
            }
        }
    }

    /// Fills `row` joint by joint; joints after `frame` do not move it.
    #[inline]
    fn fill_row(&self, frame: Frame, row: &mut [f64], entry: impl Fn(JointKind, &Pose) -> f64) {
        let (moving, still) = row.split_at_mut(self.joints_before(frame));
        for ((link, joint), value) in self.links.iter().zip(&self.base_from_frame).zip(moving) {
            *value = entry(link.kind(), joint);
        }
        still.fill(0.0);
    }
}
