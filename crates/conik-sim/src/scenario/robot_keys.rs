//! The keys of `[robot]`: what describes it, where it stands and starts, and limits that override the
//! description's.

use super::key::{Holds, Key, Range};
use super::urdf_shapes::UrdfShapes;

/// 160 turns; more is a mistake of units.
const START_RAD: f64 = 1_000.0;
/// The same in degrees, rounded off.
const START_DEG: f64 = 57_000.0;

/// `[robot]`.
pub(super) const ROBOT_KEYS: &[&Key] = &[
    &MODEL,
    &URDF,
    &BASE,
    &TOOL,
    &URDF_SHAPES,
    &BASE_POSITION_M,
    &BASE_RPY_DEG,
    &TOOL_OFFSET_M,
    &TOOL_RPY_DEG,
    &Q0_DEG,
    &Q0_RAD,
    &POSITION_LIMITS_DEG,
    &POSITION_LIMITS_RAD,
    &SPEED_LIMITS_DEG,
    &SPEED_LIMITS_RAD,
    &ACCELERATION_LIMITS_DEG,
    &ACCELERATION_LIMITS_RAD,
];

/// The same in degrees and in radians: one of the two is given.
pub(super) const IN_TWO_UNITS: &[(&Key, &Key)] = &[
    (&Q0_DEG, &Q0_RAD),
    (&POSITION_LIMITS_DEG, &POSITION_LIMITS_RAD),
    (&SPEED_LIMITS_DEG, &SPEED_LIMITS_RAD),
    (&ACCELERATION_LIMITS_DEG, &ACCELERATION_LIMITS_RAD),
];

pub(super) const MODEL: Key = Key::new(
    "model",
    "",
    "Name of a built-in robot (either this or `urdf`)",
    Holds::Robot,
    r#""ur5-paper""#,
);
pub(super) const URDF: Key = Key::new(
    "urdf",
    "",
    "Path of a URDF file, from where the scenario's file is (either this or `model`)",
    Holds::Text,
    r#""arm.urdf""#,
);
pub(super) const BASE: Key = Key::new(
    "base",
    "",
    "The link of the URDF file that stands still; without it the root of its tree",
    Holds::Text,
    r#""base_link""#,
);
pub(super) const TOOL: Key = Key::new(
    "tool",
    "",
    "The link of the URDF file that is the tool; of a list, the first is, and the joints on the way \
     to the others move too. Only a tree with one end needs none",
    Holds::NameOrNames,
    r#""tool0""#,
);
pub(super) const URDF_SHAPES: Key = Key::new(
    "shapes",
    "",
    "Which shapes the URDF file gives the links, besides those of `[[shape]]`",
    Holds::choice::<UrdfShapes>(),
    r#""collision""#,
);
pub(super) const BASE_POSITION_M: Key = Key::new(
    "base_position_m",
    "m",
    "Where the base stands in the world that tasks are expressed in; without it at the origin",
    Holds::Vector(Range::SANE),
    "[0, 0, 0.8]",
);
pub(super) const BASE_RPY_DEG: Key = Key::new(
    "base_rpy_deg",
    "deg",
    "How the base is turned in the world: roll, pitch and yaw, about the world's x, y and z in turn",
    Holds::Vector(Range::within(START_DEG)),
    "[0, 0, 90]",
);
pub(super) const TOOL_OFFSET_M: Key = Key::new(
    "tool_offset_m",
    "m",
    "Where the tool's tip is in the frame of the link that carries it; the tip becomes the tool",
    Holds::Vector(Range::SANE),
    "[0, 0, 0.15]",
);
pub(super) const TOOL_RPY_DEG: Key = Key::new(
    "tool_offset_rpy_deg",
    "deg",
    "How the tip is turned in the frame of that link: roll, pitch and yaw, about its x, y and z in turn",
    Holds::Vector(Range::within(START_DEG)),
    "[0, 90, 0]",
);
pub(super) const Q0_DEG: Key = Key::new(
    "q0_deg",
    "deg",
    "Joint positions at the start, base to tool, those of sliding joints in m (either this or \
     `q0_rad`)",
    Holds::JointNumbers(Range::within(START_DEG)),
    "[-48, -158, -108, -90, -85, 0]",
);
pub(super) const Q0_RAD: Key = Key::new(
    "q0_rad",
    "rad",
    "Joint positions at the start, base to tool, those of sliding joints in m (either this or \
     `q0_deg`)",
    Holds::JointNumbers(Range::within(START_RAD)),
    "[-0.84, -2.76, -1.88, -1.57, -1.48, 0]",
);
pub(super) const POSITION_LIMITS_DEG: Key = Key::new(
    "position_limits_deg",
    "deg",
    "Least and greatest position of each joint, `[]` for a joint without; they override the \
     model's, and are the first high-priority sets, `limit/<joint>`",
    Holds::JointPairs(Range::within(START_DEG)),
    "[[-90, 90], [-180, 0], [-150, 150], [], [], []]",
);
pub(super) const POSITION_LIMITS_RAD: Key = Key::new(
    "position_limits_rad",
    "rad",
    "The same in radians",
    Holds::JointPairs(Range::within(START_RAD)),
    "[[-1.57, 1.57], [-3.14, 0], [-2.62, 2.62], [], [], []]",
);
pub(super) const SPEED_LIMITS_DEG: Key = Key::new(
    "speed_limits_deg_per_s",
    "deg/s",
    "Greatest speed, one number for all joints or one for each; it overrides the model's",
    Holds::NumberOrJointNumbers(Range::positive(START_DEG)),
    "90",
);
pub(super) const SPEED_LIMITS_RAD: Key = Key::new(
    "speed_limits_rad_per_s",
    "rad/s",
    "The same in radians per second",
    Holds::NumberOrJointNumbers(Range::positive(START_RAD)),
    "1.57",
);
pub(super) const ACCELERATION_LIMITS_DEG: Key = Key::new(
    "acceleration_limits_deg_per_s2",
    "deg/s²",
    "Greatest acceleration, one number for all joints or one for each; it overrides the model's",
    Holds::NumberOrJointNumbers(Range::positive(START_DEG)),
    "[200, 200, 300, 400, 400, 400]",
);
pub(super) const ACCELERATION_LIMITS_RAD: Key = Key::new(
    "acceleration_limits_rad_per_s2",
    "rad/s²",
    "The same in radians per second squared",
    Holds::NumberOrJointNumbers(Range::positive(START_RAD)),
    "4",
);
