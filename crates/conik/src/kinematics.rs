//! What follows from one configuration: where every frame is, and how its points move.

use alloc::vec::Vec;

use crate::geometry::{Pose, Vec3};
use crate::joints::JointVec;
use crate::linalg::{are_equal, copy};
use crate::robot::dh::Link;
use crate::robot::{Joint, JointKind, Robot};
use crate::trigonometry::sin_cos;

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
    twists: Vec<TwoTwists>,
    reach: f64,
    q: JointVec,
    /// θ of each joint [rad], its sine and its cosine.
    angles: JointVec,
    sines: JointVec,
    cosines: JointVec,
}

/// Of a pair of neighbouring joints, x, y and z of ω and of v: at unit speed, each moves a point p of a
/// later link at ω × p + v. Side by side, so that both are worked on at once.
#[derive(Clone, Copy, Debug, Default)]
struct TwoTwists {
    turn: [[f64; 2]; 3],
    slide: [[f64; 2]; 3],
}

impl Kinematics {
    /// The robot at q = 0.
    pub fn new(robot: &Robot) -> Self {
        let zeros = JointVec::zeros(robot.dof());
        let mut kinematics = Self {
            links: robot.joints().iter().map(Link::new).collect(),
            base_from_frame: alloc::vec![Pose::IDENTITY; robot.dof() + 1],
            twists: alloc::vec![TwoTwists::default(); robot.dof().div_ceil(2)],
            reach: robot.joints().iter().map(length).sum(),
            q: zeros,
            angles: zeros,
            sines: zeros,
            cosines: zeros,
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
        if !are_equal(&self.q, q) {
            copy(&mut self.q, q);
            self.place_frames();
        }
    }

    fn place_frames(&mut self) {
        for ((angle, link), position) in self.angles.iter_mut().zip(&self.links).zip(self.q.iter())
        {
            *angle = link.angle(*position);
        }
        sin_cos(&self.angles, &mut self.sines, &mut self.cosines);
        let turned = self.sines.iter().zip(self.cosines.iter());
        let joints = self.links.iter().zip(self.q.iter()).zip(turned);
        let mut pose = Pose::IDENTITY;
        for (i, (((link, position), (sin, cos)), frame)) in
            joints.zip(&mut self.base_from_frame[1..]).enumerate()
        {
            let (turn, slide) = match link.kind() {
                JointKind::Revolute => (pose.z_axis, pose.origin.cross(pose.z_axis)),
                JointKind::Prismatic => (Vec3::ZERO, pose.z_axis),
            };
            self.twists[i / 2].set(i % 2, turn, slide);
            pose = link.advance(&pose, *position, (*sin, *cos));
            *frame = pose;
        }
    }

    /// Number of joints.
    #[inline]
    pub fn dof(&self) -> usize {
        self.links.len()
    }

    /// The most that a point of the robot can be away from a joint that moves it [m]; infinite if the
    /// robot has sliding joints.
    #[inline]
    pub fn reach(&self) -> f64 {
        self.reach
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
        self.fill_row(frame, x, |TwoTwists { turn, slide }, i| {
            turn[1][i] * point.z - turn[2][i] * point.y + slide[0][i]
        });
        self.fill_row(frame, y, |TwoTwists { turn, slide }, i| {
            turn[2][i] * point.x - turn[0][i] * point.z + slide[1][i]
        });
        self.fill_row(frame, z, |TwoTwists { turn, slide }, i| {
            turn[0][i] * point.y - turn[1][i] * point.x + slide[2][i]
        });
    }

    /// One row of the Jacobian of the origin of `frame`: `row · q̇` is the speed [m/s] of that
    /// origin along `direction`.
    #[inline]
    pub fn point_row(&self, frame: Frame, direction: Vec3, row: &mut [f64]) {
        // direction · (ω × p + v) = ω · (p × direction) + v · direction
        let moment = self.base_from(frame).origin.cross(direction);
        self.fill_row(frame, row, |TwoTwists { turn, slide }, i| {
            let by_turning = turn[0][i] * moment.x + turn[1][i] * moment.y + turn[2][i] * moment.z;
            let by_sliding =
                slide[0][i] * direction.x + slide[1][i] * direction.y + slide[2][i] * direction.z;
            by_turning + by_sliding
        });
    }

    /// One row of the Jacobian of the z axis of `frame`: `row · q̇` is the rate [1/s] of that unit
    /// vector along `direction`. Eq. (14) of the paper is three such rows.
    #[inline]
    pub fn axis_row(&self, frame: Frame, direction: Vec3, row: &mut [f64]) {
        let moment = self.base_from(frame).z_axis.cross(direction);
        self.fill_row(frame, row, |TwoTwists { turn, .. }, i| {
            turn[0][i] * moment.x + turn[1][i] * moment.y + turn[2][i] * moment.z
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

    /// Fills `row` two joints at a time; joints after `frame` do not move it.
    #[inline]
    fn fill_row(&self, frame: Frame, row: &mut [f64], entry: impl Fn(&TwoTwists, usize) -> f64) {
        let (pairs, last) = row.as_chunks_mut::<2>();
        if let (Ok(pairs), Some(twists)) = (
            <&mut [_; 3]>::try_from(&mut *pairs),
            self.twists.first_chunk(),
        ) {
            // Six joints are the common case, and a loop of known length the fast one.
            fill_pairs::<3>(pairs, twists, &entry);
        } else {
            for (values, twists) in pairs.iter_mut().zip(&self.twists) {
                *values = [entry(twists, 0), entry(twists, 1)];
            }
        }
        if let ([value], Some(twists)) = (last, self.twists.last()) {
            *value = entry(twists, 0);
        }
        for still in &mut row[self.joints_before(frame)..] {
            *still = 0.0;
        }
    }
}

/// How far the frame after a joint can be from the frame before it [m].
fn length(joint: &Joint) -> f64 {
    match joint.kind {
        JointKind::Revolute => joint.dh.a_m.abs() + joint.dh.d_m.abs(),
        JointKind::Prismatic => f64::INFINITY,
    }
}

#[inline]
fn fill_pairs<const N: usize>(
    pairs: &mut [[f64; 2]; N],
    twists: &[TwoTwists; N],
    entry: impl Fn(&TwoTwists, usize) -> f64,
) {
    for (values, twists) in pairs.iter_mut().zip(twists) {
        *values = [entry(twists, 0), entry(twists, 1)];
    }
}

impl TwoTwists {
    #[inline]
    fn set(&mut self, which: usize, turn: Vec3, slide: Vec3) {
        for axis in 0..3 {
            self.turn[axis][which] = turn.to_array()[axis];
            self.slide[axis][which] = slide.to_array()[axis];
        }
    }
}
