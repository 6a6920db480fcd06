//! A robot put together joint by joint: any tree.

use alloc::collections::BTreeSet;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::placement::Placement;
use super::{Joint, JointKind, Link, MovedBody, Robot, RobotError};
use crate::geometry::Pose;
use crate::joints::{MAX_JOINTS, TooManyJoints};

/// Something rigid: what a joint moves, or what does not move at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Body(usize);

impl Body {
    /// What no joint moves: the floor, the base.
    pub const FIXED: Self = Self(0);

    /// Its number: 0 of what does not move, n of [`Robot::bodies`]`[n - 1]`.
    pub const fn index(self) -> usize {
        self.0
    }
}

/// A robot in the making.
///
/// ```
/// use conik::{Body, Joint, Pose, RobotBuilder, Vec3};
///
/// let mut robot = RobotBuilder::new("pendulum");
/// let rod = robot.joint(Body::FIXED, Pose::IDENTITY, Joint::revolute("swing"))?;
/// robot.link("bob", rod, Pose::at(Vec3::new(0.5, 0.0, 0.0)))?;
/// let robot = robot.build()?;
/// assert_eq!(robot.dof(), 1);
/// # Ok::<(), conik::RobotError>(())
/// ```
#[derive(Debug)]
pub struct RobotBuilder {
    name: String,
    joints: Vec<Joint>,
    /// Of each follower, its name and the joint that it follows.
    followers: Vec<(String, usize)>,
    bodies: Vec<MovedBody>,
    links: Vec<Link>,
    /// The names of the links: descriptions may have tens of thousands.
    link_names: BTreeSet<String>,
    tool: Option<usize>,
}

/// How a joint follows another: position = `multiplier` · position of the other + `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mimic {
    /// Number of the joint that it follows, counted from 0 in the order of addition, followers not
    /// counted. It may be added later.
    pub joint: usize,
    /// Units of its own per unit of the other.
    pub multiplier: f64,
    /// Its position where the other is at 0 [rad or m].
    pub offset: f64,
}

impl RobotBuilder {
    /// A robot without joints and links.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            joints: Vec::new(),
            followers: Vec::new(),
            bodies: Vec::new(),
            links: Vec::new(),
            link_names: BTreeSet::new(),
            tool: None,
        }
    }

    /// Adds a joint on a body. `placement` is the joint's frame in that of the body, `body_from_joint`;
    /// the joint acts about, or along, its z axis. What is returned is what the joint moves, whose frame
    /// is the joint's, moved.
    pub fn joint(&mut self, on: Body, placement: Pose, joint: Joint) -> Result<Body, RobotError> {
        self.joint_between(on, placement, joint, Pose::IDENTITY)
    }

    /// As [`joint`](Self::joint), but the frame of what is moved is `joint_from_body` away from the joint's,
    /// moved. Frames that coincide with those of bodies cost least.
    pub fn joint_between(
        &mut self,
        on: Body,
        placement: Pose,
        joint: Joint,
        joint_from_body: Pose,
    ) -> Result<Body, RobotError> {
        joint.check()?;
        if self.joints.iter().any(|other| other.name == joint.name) {
            return Err(RobotError::NameTaken { name: joint.name });
        }
        let drive = Mimic::own(self.joints.len());
        let body = MovedBody {
            parent: on.index(),
            placement,
            kind: joint.kind,
            joint_from_body,
            drive,
        };
        let body = self.add(body, &joint.name)?;
        self.joints.push(joint);
        Ok(body)
    }

    /// Adds a joint that follows another and so is no degree of freedom of its own. Its name is for
    /// error messages; the rest is as in [`joint_between`](Self::joint_between).
    pub fn follower_between(
        &mut self,
        on: Body,
        placement: Pose,
        (kind, mimic, name): (JointKind, Mimic, &str),
        joint_from_body: Pose,
    ) -> Result<Body, RobotError> {
        if !mimic.multiplier.is_finite() || !mimic.offset.is_finite() {
            return Err(RobotError::BadNumber {
                joint: name.to_string(),
                what: "its multiplier and its offset must be finite",
            });
        }
        let body = MovedBody {
            parent: on.index(),
            placement,
            kind,
            joint_from_body,
            drive: mimic,
        };
        let body = self.add(body, name)?;
        self.followers.push((name.to_string(), mimic.joint));
        Ok(body)
    }

    fn add(&mut self, body: MovedBody, name: &str) -> Result<Body, RobotError> {
        if self.bodies.len() == MAX_JOINTS {
            return Err(TooManyJoints(self.bodies.len() + 1).into());
        }
        let is_rigid = body.placement.is_rigid() && body.joint_from_body.is_rigid();
        if body.parent > self.bodies.len() || !is_rigid {
            return Err(RobotError::BadNumber {
                joint: name.to_string(),
                what: "it must be on a body of this robot, and its placement a rigid motion",
            });
        }
        self.bodies.push(body);
        Ok(Body(self.bodies.len()))
    }

    /// Adds a named frame on a body; `placement` is `body_from_link`. The last one added is the tool,
    /// unless [`tool`](Self::tool) says otherwise.
    pub fn link(&mut self, name: &str, on: Body, placement: Pose) -> Result<(), RobotError> {
        if self.link_names.contains(name) {
            return Err(RobotError::NameTaken {
                name: name.to_string(),
            });
        }
        if on.index() > self.bodies.len() || !placement.is_rigid() {
            return Err(RobotError::BadLink {
                link: name.to_string(),
            });
        }
        self.link_names.insert(name.to_string());
        self.links.push(Link {
            name: name.to_string(),
            body: on,
            placement,
        });
        Ok(())
    }

    /// Makes a link the tool.
    pub fn tool(&mut self, name: &str) -> Result<(), RobotError> {
        let place = self.links.iter().position(|link| link.name == name);
        self.tool = Some(place.ok_or_else(|| RobotError::NoSuchLink {
            name: name.to_string(),
        })?);
        Ok(())
    }

    /// The robot.
    pub fn build(self) -> Result<Robot, RobotError> {
        if self.joints.is_empty() {
            return Err(RobotError::NoJoints);
        }
        let mut followers = self.followers.into_iter();
        if let Some((joint, _)) = followers.find(|(_, leader)| *leader >= self.joints.len()) {
            return Err(RobotError::BadNumber {
                joint,
                what: "the robot has no joint of the number that it follows",
            });
        }
        let Some(last) = self.links.len().checked_sub(1) else {
            return Err(RobotError::NoLinks);
        };
        Ok(Robot {
            name: self.name,
            joints: self.joints,
            bodies: self.bodies,
            tool: self.tool.unwrap_or(last),
            links: self.links,
        })
    }
}

impl Mimic {
    /// A joint that follows itself alone.
    pub(crate) const fn own(joint: usize) -> Self {
        Self {
            joint,
            multiplier: 1.0,
            offset: 0.0,
        }
    }
}

impl MovedBody {
    pub(crate) fn placement(&self) -> Placement {
        Placement::new(&self.placement, &self.joint_from_body)
    }

    /// The most that the frame of the body can be away from that of its carrier [m].
    pub(crate) fn length(&self) -> f64 {
        match self.kind {
            JointKind::Revolute => {
                self.placement.origin.norm() + self.joint_from_body.origin.norm()
            }
            JointKind::Prismatic => f64::INFINITY,
        }
    }

    /// The most that the frame of the body can be away from the joint [m].
    pub(crate) fn length_from_joint(&self) -> f64 {
        match self.kind {
            JointKind::Revolute => self.joint_from_body.origin.norm(),
            JointKind::Prismatic => f64::INFINITY,
        }
    }
}
