//! Robots for `conik` from URDF, the Unified Robot Description Format of ROS.
//!
//! A description is a tree of links and joints. [`read`] makes a [`conik::Robot`] of it, seen from a
//! base, with one or more tools: its degrees of freedom are the movable joints on the way from the base
//! to the tools, in that order. Every link becomes a named frame. What the robot does not use is held
//! still or left out, and a [`Note`] says so.
//!
//! ```text
//! text -> Elements (places, numbers) -> Description (links, joints) -> Tree (from the base) -> Robot
//! ```
//!
//! ```
//! let pendulum = r#"
//!     <robot name="pendulum">
//!       <link name="stand"/>
//!       <link name="rod"/>
//!       <joint name="swing" type="continuous">
//!         <parent link="stand"/> <child link="rod"/>
//!         <origin xyz="0 0 1"/> <axis xyz="0 1 0"/>
//!       </joint>
//!     </robot>"#;
//! let described = conik_urdf::read(pendulum, &conik_urdf::Options::default())?;
//! assert_eq!(described.robot.joint_names().collect::<Vec<_>>(), ["swing"]);
//! assert_eq!(described.robot.tool_name(), "rod");
//! # Ok::<(), conik_urdf::UrdfError>(())
//! ```
//!
//! Nothing here opens files or knows of scenarios.

mod assemble;
mod description;
mod document;
mod element;
mod error;
mod extent;
mod joint;
mod limits;
mod mimic;
mod narrow;
mod note;
mod pose;
mod role;
mod shapes;
mod tree;
mod unit;
mod unknown;

use conik::Robot;

pub use error::{Place, UrdfError};
pub use note::Note;
pub use pose::turned;
pub use shapes::{DescribedShapes, LinkMesh, LinkShape, shapes};

/// From where to where a description is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The link that stands still, whose frame is the world; `None`: the root of the tree.
    pub base: Option<String>,
    /// The links that are to be moved. The first is the tool; the joints on the way to the others are
    /// degrees of freedom too. Without any, the tree must have one end.
    pub tools: Vec<String>,
}

/// A robot, and what of its description does not show in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Described {
    /// The robot: its world is the frame of the base link, and every link is a frame of its own.
    pub robot: Robot,
    /// Greatest effort of each joint [N·m, or N if it slides], where the description says.
    pub efforts: Vec<Option<f64>>,
    /// What was not taken as it stands.
    pub notes: Vec<Note>,
}

/// Reads a description.
///
/// Joints: `fixed`, `revolute`, `continuous` and `prismatic`, with `mimic`. A `planar` or `floating`
/// joint is refused between base and tool and held elsewhere. Joints off the way are held at 0, or at
/// their limit nearest to it. Position, velocity and acceleration limits become those of the robot's joints.
///
/// # Errors
///
/// The first thing that keeps the text from being a robot: where it stands, what is wrong and what
/// would be right. Whatever the text is, this returns.
pub fn read(text: &str, options: &Options) -> Result<Described, UrdfError> {
    let document = document::parse(text)?;
    let mut notes = note::Notes::default();
    let description = description::read(&document, &mut notes)?;
    let tree = tree::Tree::new(&description, options)?;
    let roles = role::of_joints(&description, &tree, &mut notes)?;
    assemble::robot(&description, &tree, &roles, notes)
}
