//! Every key of the scenario file, table by table; those of `[robot]` stand in `robot_keys.rs`,
//! those of single task types in `task_keys.rs`. To add one, add it here, to the list of its table, and to the function that reads that table.

use super::config::{Border, ModeRule, Recursion};
use super::damping::DampingRule;
use super::key::{Holds, Key, Range};
pub(super) use super::robot_keys::*;
pub(super) use super::shape_keys::*;
pub(super) use super::task_keys::*;
pub(super) use super::ur_keys::*;

/// Slower than 1 Hz nothing is controlled; no arm takes references faster than 10 kHz.
const RATE: Range = Range::between(1.0, 10_000.0);
/// Up to a day.
pub(super) const DURATION: Range = Range::positive(86_400.0);
/// A day at 500 Hz is 43 million ticks, and its log some 20 GB.
pub(super) const MOST_TICKS: f64 = 50_000_000.0;
/// Gains are held to less than twice the control rate besides.
const GAIN: Range = Range::positive(20_000.0);

/// The file itself.
pub(super) const FILE: &[&Key] = &[
    &TITLE,
    &ROBOT,
    &CONTROL,
    &UR,
    &SHAPE,
    &OBSTACLE,
    &SELF_COLLISION,
    &TASK,
];

pub(super) const TITLE: Key = Key::new(
    "title",
    "",
    "A line for people",
    Holds::Text,
    r#""Pick and place beside a pillar""#,
);
pub(super) const ROBOT: Key = Key::new(
    "robot",
    "",
    "The robot and where it starts",
    Holds::Table,
    "[robot]",
);
pub(super) const CONTROL: Key = Key::new(
    "control",
    "",
    "How the controller works; may be left out",
    Holds::Table,
    "[control]",
);
pub(super) const UR: Key = Key::new(
    "ur",
    "",
    "How a Universal Robots arm is driven; may be left out",
    Holds::Table,
    "[ur]",
);
pub(super) const TASK: Key = Key::new(
    "task",
    "",
    "The tasks in decreasing priority. A task with `min` and/or `max` is set-based, one with a \
     desired value is an equality task. A set-based task above the first equality task has high \
     priority: only there is it guaranteed",
    Holds::Tables,
    "[[task]]",
);

/// `[control]`.
pub(super) const CONTROL_KEYS: &[&Key] = &[
    &RATE_HZ,
    &DURATION_S,
    &MODE_RULE,
    &BORDER,
    &RECURSION,
    &EXCLUSIVE,
];

pub(super) const RATE_HZ: Key = Key::new(
    "rate_hz",
    "Hz",
    "Control rate: references a second",
    Holds::Number(RATE),
    "125",
);
pub(super) const DURATION_S: Key = Key::new(
    "duration_s",
    "s",
    "Length of the run",
    Holds::Number(DURATION),
    "60",
);
pub(super) const MODE_RULE: Key = Key::new(
    "mode_rule",
    "",
    "Which rule chooses the active set-based tasks",
    Holds::choice::<ModeRule>(),
    r#""cone""#,
);
pub(super) const BORDER: Key = Key::new(
    "border",
    "",
    "What happens at the border of a set between samples",
    Holds::choice::<Border>(),
    r#""land""#,
);
pub(super) const RECURSION: Key = Key::new(
    "recursion",
    "",
    "How the velocities of lower tasks are fitted under the higher ones",
    Holds::choice::<Recursion>(),
    r#""siciliano-slotine""#,
);
pub(super) const EXCLUSIVE: Key = Key::new(
    "exclusive",
    "",
    "Groups of set-based tasks of which no two can ever be active together; the rules `paper` and \
     `border` strike such modes out, `cone` only leaves them without a number",
    Holds::NameGroups,
    r#"[["pillar", "table"]]"#,
);

/// What every `[[task]]` has, whatever its type.
pub(super) const TASK_KEYS: &[&Key] = &[&NAME, &TYPE];

pub(super) const NAME: Key = Key::new(
    "name",
    "",
    "Unique name of letters, digits and `_ . / -`; a column of the log",
    Holds::TaskName,
    r#""pillar""#,
);
pub(super) const TYPE: Key = Key::new(
    "type",
    "",
    "What the task measures",
    Holds::TaskType,
    r#""distance""#,
);

/// What can be asked of a task with one value.
pub(super) const SCALAR_GOAL: &[&Key] =
    &[&DESIRED, &MIN, &MAX, &RECOVERY_PER_S, &GAIN_PER_S, &DAMPING];
/// The same of an angle, which may be given in degrees.
pub(super) const ANGLE_GOAL: &[&Key] = &[
    &DESIRED,
    &ANGLE_DESIRED_DEG,
    &MIN,
    &MIN_DEG,
    &MAX,
    &MAX_DEG,
    &RECOVERY_PER_S,
    &GAIN_PER_S,
    &DAMPING,
];
/// What makes a task of one value an equality task, and what makes it a set.
pub(super) const DESIRED_VALUE: &[&Key] = &[&DESIRED, &ANGLE_DESIRED_DEG];
pub(super) const LIMITS: &[&Key] = &[&MIN, &MAX, &MIN_DEG, &MAX_DEG];
/// What is asked of a task that has it among its own keys, and no error that a gain could act on.
pub(super) const OWN_GOAL: &[&Key] = &[&DAMPING];
/// What can be asked of a region: how fast it is entered.
pub(super) const REGION_GOAL: &[&Key] = &[&RECOVERY_PER_S, &GAIN_PER_S, &DAMPING];
/// What can be asked of several joints.
pub(super) const POSTURE_GOAL: &[&Key] = &[&DESIRED_DEG, &DESIRED_RAD, &GAIN_PER_S, &DAMPING];
/// What can be asked of a task whose value is a point, an orientation, or both.
pub(super) const POINT_GOAL: &[&Key] = &[
    &WAYPOINTS_M,
    &ACCEPTANCE_M,
    &TARGET_M,
    &GAIN_PER_S,
    &DAMPING,
];
pub(super) const ORIENTATION_GOAL: &[&Key] = &[
    &WAYPOINTS_RPY_DEG,
    &WAYPOINTS_QUATERNION_WXYZ,
    &ACCEPTANCE_DEG,
    &ACCEPTANCE_RAD,
    &DESIRED_RPY_DEG,
    &DESIRED_QUATERNION_WXYZ,
    &GAIN_PER_S,
    &DAMPING,
];
pub(super) const POSE_GOAL: &[&Key] = &[
    &WAYPOINTS_M,
    &WAYPOINTS_RPY_DEG,
    &WAYPOINTS_QUATERNION_WXYZ,
    &ACCEPTANCE_M,
    &ACCEPTANCE_DEG,
    &ACCEPTANCE_RAD,
    &TARGET_M,
    &DESIRED_RPY_DEG,
    &DESIRED_QUATERNION_WXYZ,
    &GAIN_PER_S,
    &DAMPING,
];

pub(super) const DESIRED: Key = Key::new(
    "desired",
    "",
    "Equality task: the desired value, in the task's unit",
    Holds::Number(Range::SANE),
    "0.5",
);
pub(super) const MIN: Key = Key::new(
    "min",
    "",
    "Set-based task: least allowed value, in the task's unit",
    Holds::Number(Range::SANE),
    "0.18",
);
pub(super) const MAX: Key = Key::new(
    "max",
    "",
    "Set-based task: greatest allowed value, in the task's unit",
    Holds::Number(Range::SANE),
    "0.8",
);
pub(super) const ANGLE_DESIRED_DEG: Key = Key::new(
    "desired_deg",
    "deg",
    "Equality task: the desired angle, in place of `desired`",
    Holds::Number(Range::SANE),
    "30",
);
pub(super) const MIN_DEG: Key = Key::new(
    "min_deg",
    "deg",
    "Set-based task: least allowed angle, in place of `min`",
    Holds::Number(Range::SANE),
    "5",
);
pub(super) const MAX_DEG: Key = Key::new(
    "max_deg",
    "deg",
    "Set-based task: greatest allowed angle, in place of `max`",
    Holds::Number(Range::SANE),
    "15",
);
pub(super) const WAYPOINTS_M: Key = Key::new(
    "waypoints_m",
    "m",
    "Equality task: points in the base frame to visit one after the other",
    Holds::Points(Range::SANE),
    "[[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]]",
);
pub(super) const ACCEPTANCE_M: Key = Key::new(
    "acceptance_m",
    "m",
    "At this distance to a waypoint the next one is taken",
    Holds::Number(Range::positive(Range::SANE.most)),
    "0.02",
);
pub(super) const WAYPOINTS_RPY_DEG: Key = Key::new(
    "waypoints_rpy_deg",
    "deg",
    "Equality task: orientations to visit one after the other, as roll, pitch and yaw; of a pose one for \
     each point",
    Holds::Points(Range::SANE),
    "[[180, 0, 90], [180, 0, 0]]",
);
pub(super) const WAYPOINTS_QUATERNION_WXYZ: Key = Key::new(
    "waypoints_quaternion_wxyz",
    "",
    "The same as quaternions of any length but zero, their real parts first",
    Holds::Quaternions(Range::FINITE),
    "[[0, 1, 0, 0], [0, 1, 1, 0]]",
);
pub(super) const ACCEPTANCE_DEG: Key = Key::new(
    "acceptance_deg",
    "deg",
    "With so much to turn to a waypoint the next one is taken; of a pose the distance must be met too",
    Holds::Number(Range::positive(180.0)),
    "3",
);
pub(super) const ACCEPTANCE_RAD: Key = Key::new(
    "acceptance_rad",
    "rad",
    "The same in radians",
    Holds::Number(Range::positive(std::f64::consts::PI)),
    "0.05",
);
pub(super) const TARGET_M: Key = Key::new(
    "target_m",
    "m",
    "Equality task: one desired point in the base frame",
    Holds::Vector(Range::SANE),
    "[0.486, -0.066, -0.250]",
);
pub(super) const GAIN_PER_S: Key = Key::new(
    "gain_per_s",
    "1/s",
    "How fast the error is to fall: an equality task and a set-based task of low priority need \
     it. It must stay below twice the control rate",
    Holds::Number(GAIN),
    "0.5",
);

pub(super) const RECOVERY_PER_S: Key = Key::new(
    "recovery_per_s",
    "1/s",
    "Set-based task of high priority: how fast it moves in while it is outside, in the task's unit \
     per second. Without it, it is only kept from getting worse",
    Holds::Number(Range::positive(Range::SANE.most)),
    "0.05",
);

pub(super) const DAMPING: Key = Key::new(
    "damping",
    "unit/rad",
    "Equality task or set-based task of low priority: how it is damped near singularities; a number \
     is the same λ everywhere, in the task's unit per radian. Without it, \"automatic\"",
    Holds::choice_or_number::<DampingRule>(Range::between(0.0, Range::SANE.most)),
    r#""per-direction""#,
);
