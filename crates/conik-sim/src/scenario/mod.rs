//! The scenario file: one run of a robot, written in TOML.
//!
//! Here live the types of a scenario ([`Scenario`] and what it holds), reading them from the file
//! with every mistake named and placed ([`Scenario::from_toml`], [`Scenario::load`]), writing them
//! back ([`Scenario::to_toml`]), and the JSON Schema of the file ([`schema`]). Nothing here knows
//! how a scenario is run.
//!
//! What the file may say stands in one place each: `keys.rs` (the keys of every table),
//! `task_types.rs` (what a task can measure), `choice.rs` (settings with a fixed list of values)
//! and `robots.rs`. Reader and schema are both driven by those tables.

mod arm_types;
mod choice;
mod collision;
mod config;
mod control;
mod damping;
mod direction;
mod fit;
mod frames;
mod geometry;
mod goal;
mod goal_schema;
mod hierarchy;
mod joints;
mod key;
mod keys;
mod limits;
mod load;
mod mistake;
mod motion;
mod moving_goal;
mod names;
mod orientation;
mod orientation_types;
mod place;
mod posture;
mod read;
mod robot;
mod robot_keys;
mod robot_source;
mod robots;
mod scalar_goal;
mod schema;
mod shape_distance;
mod shape_keys;
mod suggest;
mod syntax;
mod table;
mod task;
mod task_keys;
mod task_types;
mod ur;
mod ur_keys;
mod urdf_file;
mod urdf_shapes;
mod value;
mod waypoints;
mod workspace;
mod write;
mod written;

pub use choice::Choice;
pub use collision::{Collision, LinkShape, Obstacle, SelfCollision};
pub use config::{
    Axis, Border, Control, GoalConfig, LimitsConfig, ModeRule, Part, Recursion, RobotConfig,
    Scenario, TaskConfig, TaskKind,
};
pub use damping::{Damping, DampingRule};
pub use frames::Frames;
pub use geometry::Geometry;
pub use load::{LoadError, MAX_FILE_BYTES};
pub use mistake::{Mistake, ScenarioErrors};
pub use motion::Motion;
pub use robot_source::{DescriptionError, PlacesConfig, RobotSource, Unreadable, UrdfConfig};
pub use robots::{RobotFacts, known_robots};
pub use schema::schema;
pub use ur::{UrModel, UrSeries, UrSettings};

/// A commented scenario to start from: every key with its unit and default, and a small working
/// example.
pub fn template() -> &'static str {
    include_str!("../../../../scenarios/template.toml")
}
