//! What follows from one configuration: where every frame is, and how its points move.

mod curvature;

use alloc::vec::Vec;

use crate::geometry::{Pose, Vec3};
use crate::joints::JointVec;
use crate::linalg::{are_equal, copy};
use crate::robot::placement::{Placement, turn_about_z};
use crate::robot::{Body as RobotBody, JointKind, Mimic, Robot};
use crate::trigonometry::sin_cos;

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
    /// Frames that are on bodies but not theirs.
    fixed: Vec<Fixed>,
    /// Pose of the world, then of each body, then of each fixed frame.
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

/// A frame on a body, away from the body's own.
#[derive(Clone, Copy, Debug)]
struct Fixed {
    /// 0 for what does not move.
    body: usize,
    placement: Pose,
}

/// How one frame moves as another sees it: through the joints that are between them.
///
/// A joint that moves both moves nothing between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motion {
    /// Bodies that carry the frame and not the one it is seen from, a bit each.
    forward: u32,
    /// Bodies that carry only the frame that it is seen from: they move it the other way round.
    backward: u32,
}

impl Motion {
    /// Whether no joint is between the two frames.
    pub fn is_none(self) -> bool {
        self.forward | self.backward == 0
    }

    /// How many joints are between the two frames; those that follow others count too.
    pub fn joints(self) -> usize {
        (self.forward | self.backward).count_ones() as usize
    }

    /// 1 for a body that moves the frame, −1 for one that moves the other frame, else 0.
    #[inline]
    fn sign(self, body: usize) -> f64 {
        match (self.forward >> body & 1, self.backward >> body & 1) {
            (1, _) => 1.0,
            (_, 1) => -1.0,
            _ => 0.0,
        }
    }
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
        let mut fixed = Vec::new();
        let mut place = |frame| {
            let (body, placement) = robot
                .attachment(frame)
                .unwrap_or((RobotBody::FIXED, Pose::IDENTITY));
            let body = body.index();
            if placement == Pose::IDENTITY {
                return body;
            }
            fixed.push(Fixed { body, placement });
            moved_by.push(moved_by[body]);
            moved_by.len() - 1
        };
        let links: Vec<usize> = (0..robot.links().len())
            .map(|link| place(Frame::Link(link)))
            .collect();
        let own = |(i, drive): (usize, &Mimic)| *drive == Mimic::own(i);
        let drives: Vec<Mimic> = robot.bodies().iter().map(|body| body.drive).collect();
        let is_direct = drives.iter().enumerate().all(own);
        let zeros = JointVec::zeros(bodies.len());
        let turning = turning(&drives);
        let mut kinematics = Self {
            poses: alloc::vec![Pose::IDENTITY; moved_by.len()],
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
        let (bodies, frames) = self.poses.split_at_mut(1 + self.bodies.len());
        for (frame, fixed) in frames.iter_mut().zip(&self.fixed) {
            *frame = bodies[fixed.body] * fixed.placement;
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

    /// The Jacobian of a point [m], Eq. (5) of the paper: `rows` is its x, y and z row, each of one entry
    /// per joint [m/rad, or 1 for a prismatic joint]. The point is where it is in the world now, and
    /// `motion` says what it moves with.
    #[inline]
    pub fn point_rows(&self, motion: Motion, point: Vec3, rows: [&mut [f64]; 3]) {
        let [x, y, z] = rows;
        self.fill_row(motion, x, |TwoTwists { turn, slide }, i| {
            turn[1][i] * point.z - turn[2][i] * point.y + slide[0][i]
        });
        self.fill_row(motion, y, |TwoTwists { turn, slide }, i| {
            turn[2][i] * point.x - turn[0][i] * point.z + slide[1][i]
        });
        self.fill_row(motion, z, |TwoTwists { turn, slide }, i| {
            turn[0][i] * point.y - turn[1][i] * point.x + slide[2][i]
        });
    }

    /// One row of the Jacobian of a point [m]: `row · q̇` is its speed [m/s] along `direction`.
    #[inline]
    pub fn point_row(&self, motion: Motion, point: Vec3, direction: Vec3, row: &mut [f64]) {
        // direction · (ω × p + v) = ω · (p × direction) + v · direction
        let moment = point.cross(direction);
        self.fill_row(motion, row, |TwoTwists { turn, slide }, i| {
            let by_turning = turn[0][i] * moment.x + turn[1][i] * moment.y + turn[2][i] * moment.z;
            let by_sliding =
                slide[0][i] * direction.x + slide[1][i] * direction.y + slide[2][i] * direction.z;
            by_turning + by_sliding
        });
    }

    /// One row of the Jacobian of an orientation: `row · q̇` is the angular velocity [rad/s] about
    /// `direction`.
    #[inline]
    pub fn turn_row(&self, motion: Motion, direction: Vec3, row: &mut [f64]) {
        self.fill_row(motion, row, |TwoTwists { turn, .. }, i| {
            turn[0][i] * direction.x + turn[1][i] * direction.y + turn[2][i] * direction.z
        });
    }

    /// One row of the Jacobian of a unit vector `axis` that is fixed to a frame: `row · q̇` is its rate
    /// [1/s] along `direction`. Eq. (14) of the paper is three such rows.
    #[inline]
    pub fn axis_row(&self, motion: Motion, axis: Vec3, direction: Vec3, row: &mut [f64]) {
        // direction · (ω × axis) = ω · (axis × direction)
        self.turn_row(motion, axis.cross(direction), row);
    }

    /// The joint that moves a body, and how far per unit of it.
    fn drive(&self, body: usize) -> (usize, f64) {
        let drive = self.drives.get(body);
        drive.map_or((body, 1.0), |drive| (drive.joint, drive.multiplier))
    }

    /// Fills `row` two joints at a time.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "the entries are a few operations each, and so is a call"
    )]
    fn fill_row(&self, motion: Motion, row: &mut [f64], entry: impl Fn(&TwoTwists, usize) -> f64) {
        if !self.drives.is_empty() {
            return self.sum_row(motion, row, entry);
        }
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
        if motion.forward != self.all {
            keep_between(motion, row);
        }
    }

    /// Fills `row` where some bodies follow others: each adds to the entry of the joint that moves it.
    #[cold]
    fn sum_row(&self, motion: Motion, row: &mut [f64], entry: impl Fn(&TwoTwists, usize) -> f64) {
        row.fill(0.0);
        for (i, drive) in self.drives.iter().enumerate() {
            let rate = motion.sign(i) * drive.multiplier;
            if rate != 0.0 {
                row[drive.joint] += rate * entry(&self.twists[i / 2], i % 2);
            }
        }
    }
}

/// The most that a link can be away from the joints that move it [m], or from the world's origin if
/// the first joints' own places count.
fn reach(robot: &Robot, from_world: bool) -> f64 {
    let mut lengths: Vec<f64> = alloc::vec![0.0];
    for body in robot.bodies() {
        let own = if from_world || body.parent != 0 {
            body.length()
        } else {
            body.length_from_joint()
        };
        lengths.push(lengths[body.parent] + own);
    }
    let links = robot
        .links()
        .iter()
        .filter(|link| from_world || link.body.index() != 0);
    links
        .map(|link| lengths[link.body.index()] + link.placement.origin.norm())
        .fold(0.0, f64::max)
}

/// The most that one joint can turn, itself and what follows it [rad/rad].
fn turning(drives: &[Mimic]) -> f64 {
    let of = |joint: usize| -> f64 {
        let driven = drives.iter().filter(|drive| drive.joint == joint);
        driven.map(|drive| drive.multiplier.abs()).sum()
    };
    (0..drives.len()).map(of).fold(0.0, f64::max)
}

/// Of a row that counts every joint as one that moves the frame, what those between the two make.
#[inline(never)]
fn keep_between(motion: Motion, row: &mut [f64]) {
    for (i, value) in row.iter_mut().enumerate() {
        *value *= motion.sign(i);
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

    fn get(&self, which: usize) -> (Vec3, Vec3) {
        let of = |parts: &[[f64; 2]; 3]| Vec3::from(parts.map(|pair| pair[which]));
        (of(&self.turn), of(&self.slide))
    }
}
