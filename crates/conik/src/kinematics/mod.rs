//! What follows from one configuration: where every frame is, and how its points move.

mod bounds;
mod curvature;
mod motion;
mod rows;

use alloc::vec::Vec;

use crate::geometry::{Pose, Vec3};
use crate::joints::JointVec;
use crate::linalg::{are_equal, copy};
use crate::robot::placement::{Placement, turn_about_z};
use crate::robot::{Body as RobotBody, JointKind, Link, Mimic, Robot};
use crate::trigonometry::sin_cos;
use bounds::{reach, turning};
pub use motion::Motion;
use rows::TwoTwists;

/// A frame of the robot, or of the room that it stands in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frame {
    /// The frame that everything is expressed in: the robot's base, unless it was put elsewhere.
    World,
    /// The robot's tool.
    #[default]
    Tool,
    /// The link of this number, counted from 0 in the order of [`Robot::link_names`]. Of an arm from a
    /// Denavit-Hartenberg table it is the frame after so many joints; 0 is the base.
    Link(usize),
}

/// The poses of all frames of a robot in one configuration q, and the Jacobians of its points.
///
/// Everything is expressed in the [world](Frame::World). Made once per robot; [`update`](Self::update)
/// then brings it to another configuration without allocating.
#[derive(Clone, Debug)]
pub struct Kinematics {
    bodies: Vec<Body>,
    /// How the positions of bodies follow from q; empty if each has an entry of its own.
    drives: Vec<Mimic>,
    /// Links on bodies, away from the bodies' own frames.
    fixed: Vec<Fixed>,
    /// Pose of the world, then of each body, then of each link that is elsewhere.
    poses: Vec<Pose>,
    /// Of each of these, the bodies that move it, a bit each.
    moved_by: Vec<u32>,
    twists: Vec<TwoTwists>,
    /// All of them, a bit each.
    all: u32,
    /// Where among the poses the tool is, and each link; no table where links are numbered as the poses
    /// are, as those of Denavit-Hartenberg tables.
    tool: usize,
    links: Vec<usize>,
    reach: f64,
    span: f64,
    turning: f64,
    q: JointVec,
    /// Position of each body's joint [rad or m], if they are not q.
    positions: JointVec,
    /// The turn of each joint [rad], its sine and its cosine.
    angles: JointVec,
    sines: JointVec,
    cosines: JointVec,
}

#[derive(Clone, Copy, Debug)]
struct Body {
    parent: usize,
    placement: Placement,
    kind: JointKind,
}

/// A link on a body that moves, away from the body's own frame.
#[derive(Clone, Copy, Debug)]
struct Fixed {
    /// Where among the poses it is, and the body.
    place: usize,
    body: usize,
    placement: Pose,
}

impl Kinematics {
    /// The robot at q = 0.
    pub fn new(robot: &Robot) -> Self {
        let bodies = robot.bodies().iter().map(|body| Body {
            parent: body.parent,
            placement: body.placement(),
            kind: body.kind,
        });
        let bodies: Vec<Body> = bodies.collect();
        let mut moved_by = alloc::vec![0];
        for (i, body) in bodies.iter().enumerate() {
            moved_by.push(moved_by[body.parent] | 1 << i);
        }
        let mut poses = alloc::vec![Pose::IDENTITY; moved_by.len()];
        let mut fixed = Vec::new();
        let mut place = |link: &Link| {
            let (place, body, placement) = (poses.len(), link.body.index(), link.placement);
            if placement == Pose::IDENTITY {
                return body;
            }
            if link.body != RobotBody::FIXED {
                fixed.push(Fixed {
                    place,
                    body,
                    placement,
                });
            }
            // What is on no body that moves is there for good.
            poses.push(placement);
            moved_by.push(moved_by[body]);
            place
        };
        let links: Vec<usize> = robot.links().iter().map(&mut place).collect();
        let own = |(i, drive): (usize, &Mimic)| *drive == Mimic::own(i);
        let drives: Vec<Mimic> = robot.bodies().iter().map(|body| body.drive).collect();
        let is_direct = drives.iter().enumerate().all(own);
        let zeros = JointVec::zeros(bodies.len());
        let turning = turning(&drives);
        let mut kinematics = Self {
            poses,
            twists: alloc::vec![TwoTwists::default(); bodies.len().div_ceil(2)],
            all: moved_by.iter().fold(0, |all, bodies| all | bodies),
            tool: links[robot.tool()],
            links: if links.iter().copied().eq(0..=bodies.len()) {
                Vec::new()
            } else {
                links
            },
            fixed,
            moved_by,
            reach: turning * reach(robot, false),
            span: turning * 2.0 * reach(robot, true),
            turning,
            bodies,
            drives: if is_direct { Vec::new() } else { drives },
            q: JointVec::zeros(robot.dof()),
            positions: zeros,
            angles: zeros,
            sines: zeros,
            cosines: zeros,
        };
        kinematics.place_bodies();
        kinematics
    }

    /// Brings the robot to `q` [rad or m]. A configuration that is already there costs nothing.
    ///
    /// # Panics
    /// If `q` has not one entry per joint.
    #[inline]
    pub fn update(&mut self, q: &[f64]) {
        assert_eq!(q.len(), self.q.len(), "one position per joint");
        if !are_equal(&self.q, q) {
            copy(&mut self.q, q);
            self.place_bodies();
        }
    }

    fn place_bodies(&mut self) {
        let positions = if self.drives.is_empty() {
            &self.q
        } else {
            for (position, drive) in self.positions.iter_mut().zip(&self.drives) {
                *position = drive.multiplier * self.q[drive.joint] + drive.offset;
            }
            &self.positions
        };
        for ((angle, body), position) in self.angles.iter_mut().zip(&self.bodies).zip(&**positions)
        {
            let turn = match body.kind {
                JointKind::Revolute => *position,
                JointKind::Prismatic => 0.0,
            };
            *angle = body.placement.theta() + turn;
        }
        sin_cos(&self.angles, &mut self.sines, &mut self.cosines);
        let turned = self.sines.iter().zip(self.cosines.iter());
        let joints = self.bodies.iter().zip(positions.iter()).zip(turned);
        let mut pose = Pose::IDENTITY;
        for (i, ((body, position), (sin, cos))) in joints.enumerate() {
            // The one before is at hand; of a serial arm it always is that.
            if body.parent != i {
                pose = self.poses[body.parent];
            }
            if let Placement::Poses { before, .. } = &body.placement {
                pose = pose * *before;
            }
            let (turn, slide, slid) = match body.kind {
                JointKind::Revolute => (pose.z_axis, pose.origin.cross(pose.z_axis), 0.0),
                JointKind::Prismatic => (Vec3::ZERO, pose.z_axis, *position),
            };
            self.twists[i / 2].set(i % 2, turn, slide);
            pose = match &body.placement {
                Placement::Row(row) => row.advance(&pose, slid, (*sin, *cos)),
                Placement::Poses { after, .. } => {
                    let (x_axis, y_axis) = turn_about_z(&pose, (*sin, *cos));
                    let joint = Pose {
                        x_axis,
                        y_axis,
                        origin: pose.origin + pose.z_axis * slid,
                        ..pose
                    };
                    after.map_or(joint, |after| joint * after)
                }
            };
            self.poses[i + 1] = pose;
        }
        for fixed in &self.fixed {
            self.poses[fixed.place] = self.poses[fixed.body] * fixed.placement;
        }
    }

    /// Number of joints.
    #[inline]
    pub fn dof(&self) -> usize {
        self.q.len()
    }

    /// The most that a joint can move a frame of the robot [m/rad]: how far away from it that can be;
    /// infinite if the robot has sliding joints.
    #[inline]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The most that a joint can move a frame as another one sees it [m/rad]: how far two frames of the
    /// robot, or a frame and a joint that does not move it, can be apart; infinite if the robot has
    /// sliding joints.
    #[inline]
    pub fn span(&self) -> f64 {
        self.span
    }

    /// The most that a joint can turn a frame, as any other sees it [rad/rad]: 1, but for joints that
    /// others follow.
    #[inline]
    pub fn turning(&self) -> f64 {
        self.turning
    }

    /// The configuration [rad or m].
    #[inline]
    pub fn q(&self) -> &JointVec {
        &self.q
    }

    /// Pose of a frame in the world.
    ///
    /// # Panics
    /// If the robot has no such frame; [`Stack`](crate::Stack) checks its tasks' frames once.
    #[inline]
    pub fn world_from(&self, frame: Frame) -> &Pose {
        &self.poses[self.place(frame)]
    }

    /// How a frame moves in the world.
    ///
    /// # Panics
    /// If the robot has no such frame.
    #[inline]
    pub fn motion(&self, frame: Frame) -> Motion {
        Motion {
            forward: self.moved_by[self.place(frame)],
            backward: 0,
        }
    }

    /// How a frame moves as another sees it.
    ///
    /// # Panics
    /// If the robot has not both frames.
    #[inline]
    pub fn motion_between(&self, seen_from: Frame, frame: Frame) -> Motion {
        let forward = self.moved_by[self.place(frame)];
        let backward = self.moved_by[self.place(seen_from)];
        Motion {
            forward: forward & !backward,
            backward: backward & !forward,
        }
    }

    /// Where among the poses a frame is.
    #[inline]
    fn place(&self, frame: Frame) -> usize {
        match frame {
            Frame::World => 0,
            Frame::Tool => self.tool,
            Frame::Link(link) if self.links.is_empty() => link,
            Frame::Link(link) => self.links[link],
        }
    }
}
