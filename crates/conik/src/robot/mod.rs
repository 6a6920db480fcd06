//! The robot: a tree of joints, the links on it, and the limits.
//!
//! What follows from one configuration q is [`Kinematics`](crate::Kinematics); what the robot is
//! asked to do is a [`Stack`](crate::Stack). Neither belongs here.

mod builder;
mod builtin;
mod dh;
pub(crate) mod placement;
mod skeleton;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

pub use builder::{Body, Mimic, RobotBuilder};
pub use builtin::UrArm;
pub use dh::{DhConvention, DhRow};
pub use skeleton::PlacedJoint;

use crate::geometry::Pose;
use crate::joints::TooManyJoints;
use crate::kinematics::Frame;

/// How a joint moves what it carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its z axis; positions in [rad].
    Revolute,
    /// Slides along its z axis; positions in [m].
    Prismatic,
}

/// What a joint must not exceed. An absent limit is no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointLimits {
    /// Least and greatest position [rad or m].
    pub position: Option<(f64, f64)>,
    /// Greatest speed, either way [rad/s or m/s].
    pub speed: Option<f64>,
    /// Greatest acceleration, either way [rad/s² or m/s²].
    pub acceleration: Option<f64>,
}

/// A joint: one degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The joint's name, unique in the robot.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// What it must not exceed.
    pub limits: JointLimits,
}

/// A robot: a tree of joints on a fixed base, with named frames, one of which is the tool.
///
/// Its configuration q has one entry per joint, each after those that carry it. A serial arm is the
/// tree with one branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    name: String,
    joints: Vec<Joint>,
    bodies: Vec<MovedBody>,
    links: Vec<Link>,
    /// Place among the links.
    tool: usize,
}

/// A body that a joint moves. Its pose in the world, at a position p of the joint, is
///
/// ```text
/// world_from_body = world_from_parent · placement · motion(p) · joint_from_body
/// p = drive.multiplier · q[drive.joint] + drive.offset
/// ```
///
/// where `motion(p)` turns about the z axis by p, or slides along it.
#[derive(Clone, Debug, PartialEq)]
pub struct MovedBody {
    /// Number of the body that carries it: 0 for what does not move, n for [`Robot::bodies`]`[n - 1]`,
    /// which stands before this one.
    pub parent: usize,
    /// The joint's frame in that body's, with the joint at 0.
    pub placement: Pose,
    /// How the joint moves it.
    pub kind: JointKind,
    /// The frame of the body in the joint's, moved.
    pub joint_from_body: Pose,
    /// How the joint's position follows from q: by itself, unless it follows another joint.
    pub drive: Mimic,
}

/// A named frame on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The link's name, unique in the robot.
    pub name: String,
    /// What it is fixed to.
    pub body: Body,
    /// Its frame in that of the body.
    pub placement: Pose,
}

/// Why a robot could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RobotError {
    /// No built-in robot has this name.
    #[error("no built-in robot is called `{name}`; there are: {}", Robot::builtin_names().join(", "))]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// The robot has no joints.
    #[error("a robot needs at least one joint")]
    NoJoints,
    /// The robot has no named frame that could be the tool.
    #[error("a robot needs at least one link")]
    NoLinks,
    /// The robot has too many joints.
    #[error(transparent)]
    TooManyJoints(#[from] TooManyJoints),
    /// A geometric parameter or a limit is not a usable number.
    #[error("joint `{joint}`: {what}")]
    BadNumber {
        /// Name of the joint.
        joint: String,
        /// What is wrong with which number.
        what: &'static str,
    },
    /// Two joints or two links have one name.
    #[error("the name `{name}` is taken")]
    NameTaken {
        /// The name.
        name: String,
    },
    /// A link on no body, or not at a rigid motion from it.
    #[error("link `{link}`: it must be on a body of this robot, and its placement a rigid motion")]
    BadLink {
        /// Name of the link.
        link: String,
    },
    /// No link has this name.
    #[error("the robot has no link `{name}`")]
    NoSuchLink {
        /// The name asked for.
        name: String,
    },
}

impl Joint {
    /// A joint that turns, without limits.
    pub fn revolute(name: &str) -> Self {
        Self {
            name: name.to_string(),
            kind: JointKind::Revolute,
            limits: JointLimits::default(),
        }
    }

    /// A joint that slides, without limits.
    pub fn prismatic(name: &str) -> Self {
        Self {
            kind: JointKind::Prismatic,
            ..Self::revolute(name)
        }
    }
}

impl Robot {
    /// The robot's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of joints.
    pub fn dof(&self) -> usize {
        self.joints.len()
    }

    /// The joints, base to tool.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Names of the joints, base to tool.
    pub fn joint_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.joints.iter().map(|joint| joint.name.as_str())
    }

    /// Names of the links in the order in which [`Frame::Link`] counts them.
    pub fn link_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.links.iter().map(|link| link.name.as_str())
    }

    /// The frame of the link of this name, if the robot has it.
    pub fn frame(&self, link: &str) -> Option<Frame> {
        let place = self.links.iter().position(|other| other.name == link);
        place.map(Frame::Link)
    }

    /// Name of the link that is the tool.
    pub fn tool_name(&self) -> &str {
        &self.links[self.tool].name
    }

    /// Whether the robot has this frame.
    pub fn has(&self, frame: Frame) -> bool {
        match frame {
            Frame::World | Frame::Tool => true,
            Frame::Link(place) => place < self.links.len(),
        }
    }

    /// The same robot with other limits of each joint, given its number.
    pub fn with_limits(
        mut self,
        limits: impl Fn(usize, &Joint) -> JointLimits,
    ) -> Result<Self, RobotError> {
        for (index, joint) in self.joints.iter_mut().enumerate() {
            joint.limits = limits(index, joint);
            joint.check()?;
        }
        Ok(self)
    }

    /// The same robot standing elsewhere: `world_from_base` takes what it stood in until now to the world.
    #[must_use]
    pub fn standing_at(mut self, world_from_base: Pose) -> Self {
        for body in self.bodies.iter_mut().filter(|body| body.parent == 0) {
            body.placement = world_from_base * body.placement;
        }
        for link in self
            .links
            .iter_mut()
            .filter(|link| link.body == Body::FIXED)
        {
            link.placement = world_from_base * link.placement;
        }
        self
    }

    /// The same robot with one more link: a frame fixed to another.
    pub fn with_frame(
        mut self,
        name: &str,
        on: Frame,
        placement: Pose,
    ) -> Result<Self, RobotError> {
        if self.links.iter().any(|link| link.name == name) {
            return Err(RobotError::NameTaken {
                name: name.to_string(),
            });
        }
        let (body, body_from_frame) = self.attachment(on).ok_or_else(|| RobotError::BadLink {
            link: name.to_string(),
        })?;
        if !placement.is_rigid() {
            return Err(RobotError::BadLink {
                link: name.to_string(),
            });
        }
        self.links.push(Link {
            name: name.to_string(),
            body,
            placement: body_from_frame * placement,
        });
        Ok(self)
    }

    /// The same robot with another link as its tool.
    pub fn with_tool(mut self, link: &str) -> Result<Self, RobotError> {
        let place = self.links.iter().position(|other| other.name == link);
        self.tool = place.ok_or_else(|| RobotError::NoSuchLink {
            name: link.to_string(),
        })?;
        Ok(self)
    }

    /// The body that a frame is on, and where on it; `None` if there is no such frame.
    pub(crate) fn attachment(&self, frame: Frame) -> Option<(Body, Pose)> {
        let link = match frame {
            Frame::World => return Some((Body::FIXED, Pose::IDENTITY)),
            Frame::Tool => self.tool,
            Frame::Link(place) => place,
        };
        let link = self.links.get(link)?;
        Some((link.body, link.placement))
    }

    /// Number of the link that is the tool.
    pub fn tool(&self) -> usize {
        self.tool
    }

    /// The bodies that joints move, each after the one that carries it.
    pub fn bodies(&self) -> &[MovedBody] {
        &self.bodies
    }

    /// The links in the order in which [`Frame::Link`] counts them.
    pub fn links(&self) -> &[Link] {
        &self.links
    }
}

impl Joint {
    fn check(&self) -> Result<(), RobotError> {
        let JointLimits {
            position,
            speed,
            acceleration,
        } = self.limits;
        let wrong = |what| {
            Err(RobotError::BadNumber {
                joint: self.name.clone(),
                what,
            })
        };
        if position.is_some_and(|(min, max)| !(min <= max)) {
            return wrong("its least position must not exceed its greatest");
        }
        if [speed, acceleration]
            .into_iter()
            .flatten()
            .any(|limit| !(limit > 0.0))
        {
            return wrong("its speed and acceleration limits must be positive");
        }
        Ok(())
    }
}
