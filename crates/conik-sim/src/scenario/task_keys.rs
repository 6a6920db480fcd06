//! The keys that single task types have besides those of all tasks.

use super::config::{Axis, Part};
use super::key::{Holds, Key, Range};
use super::keys;

/// What several types have.
pub(super) const AXIS: Key = Key::new(
    "axis",
    "",
    "Which coordinate of the position",
    Holds::choice::<Axis>(),
    r#""z""#,
);
pub(super) const POINT_M: Key = Key::new(
    "point_m",
    "m",
    "The point, in the world or in the axes of `relative_to`",
    Holds::Vector(Range::SANE),
    "[0.40, -0.25, -0.33]",
);
/// How what is asked for moves. A type says in `moves` which of these it may have; what takes one desired
/// value has `desired_per_s` besides, and what has any of them `moves_until_s`.
pub(super) const MOVES: &[&Key] = &[&VELOCITY_M_PER_S];
pub(super) const TURNS: &[&Key] = &[&ANGULAR_VELOCITY_DEG_PER_S, &ANGULAR_VELOCITY_RAD_PER_S];
pub(super) const MOVES_AND_TURNS: &[&Key] = &[
    &VELOCITY_M_PER_S,
    &ANGULAR_VELOCITY_DEG_PER_S,
    &ANGULAR_VELOCITY_RAD_PER_S,
];

pub(super) const VELOCITY_M_PER_S: Key = Key::new(
    "velocity_m_per_s",
    "m/s",
    "How the point or target moves, from where it is at t = 0; in the world or in the axes of `relative_to`",
    Holds::Vector(Range::SANE),
    "[0, -0.2, 0]",
);
pub(super) const ANGULAR_VELOCITY_DEG_PER_S: Key = Key::new(
    "angular_velocity_deg_per_s",
    "deg/s",
    "How the direction or the desired orientation turns, from what it is at t = 0: about this axis of the \
     world or of `relative_to`, by its length",
    Holds::Vector(Range::SANE),
    "[0, 0, 20]",
);
pub(super) const ANGULAR_VELOCITY_RAD_PER_S: Key = Key::new(
    "angular_velocity_rad_per_s",
    "rad/s",
    "The same in radians",
    Holds::Vector(Range::SANE),
    "[0, 0, 0.35]",
);
pub(super) const DESIRED_PER_S: Key = Key::new(
    "desired_per_s",
    "",
    "Equality task: how fast the desired value moves, in the task's unit per second; `desired` is what it \
     is at t = 0",
    Holds::Number(Range::SANE),
    "0.05",
);
pub(super) const MOVES_UNTIL_S: Key = Key::new(
    "moves_until_s",
    "s",
    "When what moves comes to rest; without it, it never does",
    Holds::Number(keys::DURATION),
    "4",
);
pub(super) const DIRECTION: Key = Key::new(
    "direction",
    "",
    "The direction, of any length but zero, in the world or in the axes of `relative_to`",
    Holds::Vector(Range::FINITE),
    "[1, 0, 0]",
);
pub(super) const JOINT: Key = Key::new(
    "joint",
    "",
    "Number of the joint, from 1 at the base, or its name",
    Holds::Joint,
    r#""elbow_joint""#,
);
pub(super) const FRAME: Key = Key::new(
    "frame",
    "",
    "Name of the link that is measured. Without it, the tool",
    Holds::Link,
    r#""link_3""#,
);
pub(super) const RELATIVE_TO: Key = Key::new(
    "relative_to",
    "",
    "Name of the link in whose axes points, directions and values are, and move. Without it, the world",
    Holds::Link,
    r#""link_1""#,
);

/// What the types have that concern orientations.
pub(super) const DESIRED_RPY_DEG: Key = Key::new(
    "desired_rpy_deg",
    "deg",
    "The desired orientation as roll, pitch and yaw: turns about the fixed x, then y, then z axis",
    Holds::Vector(Range::SANE),
    "[180, 0, 90]",
);
pub(super) const DESIRED_QUATERNION_WXYZ: Key = Key::new(
    "desired_quaternion_wxyz",
    "",
    "The desired orientation as a quaternion of any length but zero, its real part first",
    Holds::Quaternion(Range::FINITE),
    "[0, 1, 0, 0]",
);
pub(super) const AXIS_IN_FRAME: Key = Key::new(
    "axis",
    "",
    "The axis, in the frame that is measured, of any length but zero. Without it, its z axis",
    Holds::Vector(Range::FINITE),
    "[0, 0, 1]",
);

/// What planes have.
pub(super) const NORMAL: Key = Key::new(
    "normal",
    "",
    "The normal of the plane, of any length but zero, towards the side that counts positive",
    Holds::Vector(Range::FINITE),
    "[0, 0, 1]",
);
pub(super) const OFFSET_M: Key = Key::new(
    "offset_m",
    "m",
    "How far the plane is from the origin, along its normal. Without it, 0",
    Holds::Number(Range::SANE),
    "-0.3",
);

/// What workspaces have.
pub(super) const MIN_M: Key = Key::new(
    "min_m",
    "m",
    "The corner of the box with the least coordinates, in the axes of the world or of `relative_to`",
    Holds::Vector(Range::SANE),
    "[0.2, -0.5, 0.05]",
);
pub(super) const MAX_M: Key = Key::new(
    "max_m",
    "m",
    "The corner of the box with the greatest coordinates",
    Holds::Vector(Range::SANE),
    "[0.8, 0.5, 0.9]",
);

/// What the types have that concern several joints.
pub(super) const JOINTS: Key = Key::new(
    "joints",
    "",
    "Some joints, each by its number, from 1 at the base, or its name. Without it, all",
    Holds::Joints,
    r#"["elbow_joint", 4]"#,
);
pub(super) const DESIRED_DEG: Key = Key::new(
    "desired_deg",
    "deg",
    "Equality task: the desired position of each of the joints; of those that slide in [m]",
    Holds::JointNumbers(Range::SANE),
    "[-48, -158, -108, -90, -85, 0]",
);
pub(super) const DESIRED_RAD: Key = Key::new(
    "desired_rad",
    "rad",
    "The same in radians",
    Holds::JointNumbers(Range::SANE),
    "[-0.84, -2.76, -1.88, -1.57, -1.48, 0]",
);
pub(super) const SPEED_DEG_PER_S: Key = Key::new(
    "speed_deg_per_s",
    "deg/s",
    "The desired speed",
    Holds::Number(Range::SANE),
    "20",
);
pub(super) const SPEED_RAD_PER_S: Key = Key::new(
    "speed_rad_per_s",
    "rad/s",
    "The desired speed [m/s of a joint that slides]",
    Holds::Number(Range::SANE),
    "0.35",
);
pub(super) const PART: Key = Key::new(
    "part",
    "",
    "Which rows of the Jacobian count. Without it, \"position\"",
    Holds::choice::<Part>(),
    r#""position""#,
);
pub(super) const SHOULDER: Key = Key::new(
    "shoulder",
    "",
    "Link at whose origin the shoulder is",
    Holds::Link,
    r#""link_1""#,
);
pub(super) const ELBOW: Key = Key::new(
    "elbow",
    "",
    "Link at whose origin the elbow is",
    Holds::Link,
    r#""link_2""#,
);
pub(super) const WRIST: Key = Key::new(
    "wrist",
    "",
    "Link at whose origin the wrist is",
    Holds::Link,
    r#""link_5""#,
);
