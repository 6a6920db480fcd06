//! Keys of `[[shape]]`, `[[obstacle]]` and `[self_collision]`.

use super::key::{Holds, Key, Range};
use super::keys::{MOVES_UNTIL_S, NAME, NORMAL, POINT_M, TYPE, VELOCITY_M_PER_S};

/// A kilometre is more than any arm passes.
const LENGTH: Range = Range::between(0.0, 1000.0);

pub(super) const SHAPE: Key = Key::new(
    "shape",
    "",
    "Shapes on the robot's links, which keep their distance from obstacles and from each other",
    Holds::Tables,
    "[[shape]]",
);
pub(super) const OBSTACLE: Key = Key::new(
    "obstacle",
    "",
    "Shapes in the world: each that has a `distance_m` becomes a high-priority set for every shape on the robot that can \
     meet it, above all tasks of the file, named `SHAPE/OBSTACLE`",
    Holds::Tables,
    "[[obstacle]]",
);
pub(super) const SELF_COLLISION: Key = Key::new(
    "self_collision",
    "",
    "The robot's shapes keep away from each other: a high-priority set for every two of which the \
     links are not neighbours, named `SHAPE/SHAPE`",
    Holds::Table,
    "[self_collision]",
);

/// `[[shape]]`: what it may have, but for its type's own keys.
pub(super) const SHAPE_KEYS: &[&Key] = &[&NAME, &LINK, &TYPE];
/// `[[obstacle]]`.
pub(super) const OBSTACLE_KEYS: &[&Key] = &[
    &NAME,
    &TYPE,
    &OBSTACLE_DISTANCE_M,
    &VELOCITY_M_PER_S,
    &MOVES_UNTIL_S,
];
/// `[self_collision]`.
pub(super) const SELF_COLLISION_KEYS: &[&Key] = &[&DISTANCE_M, &EXCLUDE];

pub(super) const LINK: Key = Key::new(
    "link",
    "",
    "The link that the shape is fixed to, and in whose frame it is given",
    Holds::Text,
    r#""link_3""#,
);
pub(super) const DISTANCE_M: Key = Key::new(
    "distance_m",
    "m",
    "Least distance between the surfaces",
    Holds::Number(LENGTH),
    "0.03",
);
pub(super) const OBSTACLE_DISTANCE_M: Key = Key::new(
    "distance_m",
    "m",
    "Least distance between the surfaces. Without it, the obstacle keeps nothing away: tasks of type \
     `shape_distance` can measure it",
    Holds::Number(LENGTH),
    "0.03",
);
pub(super) const EXCLUDE: Key = Key::new(
    "exclude",
    "",
    "Groups of shapes of the robot of which no two are kept apart",
    Holds::NameGroups,
    r#"[["forearm", "gripper"]]"#,
);
pub(super) const CENTER_M: Key = Key::new(
    "center_m",
    "m",
    "Middle of a sphere or box",
    Holds::Vector(Range::SANE),
    "[0.5, 0, 0.2]",
);
pub(super) const RADIUS_M: Key = Key::new(
    "radius_m",
    "m",
    "Radius of a sphere, capsule or cylinder",
    Holds::Number(LENGTH),
    "0.06",
);
pub(super) const FROM_M: Key = Key::new(
    "from_m",
    "m",
    "Where the axis of a capsule or cylinder begins",
    Holds::Vector(Range::SANE),
    "[0, 0, 0]",
);
pub(super) const TO_M: Key = Key::new(
    "to_m",
    "m",
    "Where the axis of a capsule or cylinder ends",
    Holds::Vector(Range::SANE),
    "[0.4, 0, 0]",
);
pub(super) const SIZE_M: Key = Key::new(
    "size_m",
    "m",
    "Lengths of a box's edges",
    Holds::Vector(LENGTH),
    "[0.4, 0.3, 0.02]",
);
pub(super) const ROTATION_RAD: Key = Key::new(
    "rotation_rad",
    "rad",
    "How a box is turned: about this axis, by its length",
    Holds::Vector(Range::within(1000.0)),
    "[0, 0, 0.5]",
);

/// Keys of the types of shape, in the order of `Geometry`.
pub(super) const SPHERE_KEYS: &[&Key] = &[&CENTER_M, &RADIUS_M];
pub(super) const AXIS_KEYS: &[&Key] = &[&FROM_M, &TO_M, &RADIUS_M];
pub(super) const BOX_KEYS: &[&Key] = &[&CENTER_M, &SIZE_M];
pub(super) const HALF_SPACE_KEYS: &[&Key] = &[&POINT_M, &NORMAL];

/// What a task of type `shape_distance` has.
pub(super) const SHAPES: Key = Key::new(
    "shapes",
    "",
    "The two, by the names of a `[[shape]]` and another one or an `[[obstacle]]`",
    Holds::TwoNames,
    r#"["forearm", "post"]"#,
);
