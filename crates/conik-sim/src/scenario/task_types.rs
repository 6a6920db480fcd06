//! The types of task that a scenario may name: what each measures, the keys it needs, and how it
//! is read; those that concern orientations stand in `orientation_types.rs`, those that concern the
//! arm as a whole in `arm_types.rs`. To add a type, add it here, to `TaskKind` and to `written.rs`.

use super::config::TaskKind;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::motion;
use super::robots::RobotFacts;
use super::table::Table;
use super::{arm_types, orientation_types};

/// A type of task.
#[derive(Debug)]
pub(super) struct TaskType {
    /// Its name in the file.
    pub(super) name: &'static str,
    /// What it measures, in one line for people, with the unit.
    pub(super) about: &'static str,
    /// The keys that it needs besides name, type and goal.
    pub(super) keys: &'static [&'static Key],
    /// The keys that it may have besides, each with the key that it needs beside it.
    pub(super) optional: &'static [(&'static Key, Option<&'static Key>)],
    /// The keys of which it needs one, and cannot have two.
    pub(super) one_of: &'static [&'static Key],
    /// What can be asked of it.
    pub(super) goal: GoalShape,
    /// Reads what it measures.
    pub(super) read: fn(&Table, Option<&RobotFacts>, &mut Mistakes) -> Option<TaskKind>,
}

/// What can be asked of a type of task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GoalShape {
    /// A point: visited, never a set.
    Point,
    /// One value that is always between these: desired, or kept in a set.
    Scalar(f64, f64),
    /// So many values that are desired to be zero; never a set.
    Vanishing {
        /// Number of values.
        size: usize,
        /// Whether there is an error that a gain acts on.
        has_gain: bool,
    },
    /// A position for each of some joints; never a set.
    Posture,
}

impl TaskType {
    /// The keys that state its goal.
    pub(super) fn goal_keys(&self) -> &'static [&'static Key] {
        match self.goal {
            GoalShape::Point => keys::POINT_GOAL,
            GoalShape::Scalar(..) => keys::SCALAR_GOAL,
            GoalShape::Vanishing { has_gain: true, .. } => keys::VANISHING_GOAL,
            GoalShape::Vanishing { .. } => keys::VANISHING_GOAL_WITHOUT_GAIN,
            GoalShape::Posture => keys::POSTURE_GOAL,
        }
    }

    /// Every key that it may have.
    pub(super) fn all_keys(&self) -> impl Iterator<Item = &'static Key> + Clone {
        keys::TASK_KEYS
            .iter()
            .chain(self.keys)
            .chain(self.one_of)
            .chain(self.goal_keys())
            .copied()
            .chain(self.optional.iter().map(|(key, _)| *key))
    }
}

pub(super) const ANY: GoalShape = GoalShape::Scalar(f64::NEG_INFINITY, f64::INFINITY);

/// What every type may have that measures a frame.
pub(super) const OF_FRAME: &[(&Key, Option<&Key>)] =
    &[(&keys::FRAME, None), (&keys::RELATIVE_TO, None)];

/// What a type may have that measures a frame against a point that may move.
pub(super) const OF_FRAME_AND_MOVING_POINT: &[(&Key, Option<&Key>)] = &[
    (&keys::FRAME, None),
    (&keys::RELATIVE_TO, None),
    (&keys::VELOCITY_M_PER_S, None),
    (&keys::MOVES_UNTIL_S, Some(&keys::VELOCITY_M_PER_S)),
];

/// Every type of task.
pub(super) const ALL: &[TaskType] = &[
    TaskType {
        name: "position",
        about: "Position of the tool, or of `frame` [m]; cannot be a set",
        keys: &[],
        optional: OF_FRAME,
        one_of: &[],
        goal: GoalShape::Point,
        read: |_, _, _| Some(TaskKind::Position),
    },
    TaskType {
        name: "coordinate",
        about: "One coordinate of the position [m]",
        keys: &[&keys::AXIS],
        optional: OF_FRAME,
        one_of: &[],
        goal: ANY,
        read: |table, _, found| {
            let axis = table.choice(&keys::AXIS, found).required(table, found)?;
            Some(TaskKind::Coordinate { axis })
        },
    },
    TaskType {
        name: "distance",
        about: "Distance of the tool to a point [m], which may move",
        keys: &[&keys::POINT_M],
        optional: OF_FRAME_AND_MOVING_POINT,
        one_of: &[],
        goal: GoalShape::Scalar(0.0, f64::INFINITY),
        read: |table, _, found| {
            let point_m = table.vector(&keys::POINT_M, found).required(table, found);
            let motion = motion::read(table, found).map(Some).or(None);
            Some(TaskKind::Distance {
                point_m: point_m?,
                motion: motion?,
            })
        },
    },
    TaskType {
        name: "field_of_view",
        about: "Norm of (direction - tool z axis) [-]: 2 sin(angle / 2), from 0 to 2",
        keys: &[&keys::DIRECTION],
        optional: OF_FRAME,
        one_of: &[],
        goal: GoalShape::Scalar(0.0, 2.0),
        read: |table, _, found| {
            let direction = table
                .direction(&keys::DIRECTION, found)
                .required(table, found)?;
            Some(TaskKind::FieldOfView { direction })
        },
    },
    TaskType {
        name: "joint",
        about: "Position of one joint [rad], or [m] if it slides",
        keys: &[&keys::JOINT],
        optional: &[],
        one_of: &[],
        goal: ANY,
        read: |table, robot, found| {
            let joint = table
                .joint(&keys::JOINT, robot, found)
                .required(table, found)?;
            Some(TaskKind::Joint { joint })
        },
    },
    orientation_types::ORIENTATION,
    orientation_types::ORIENTATION_ANGLE,
    orientation_types::POSE,
    orientation_types::POINTING_ANGLE,
    orientation_types::LOOK_AT,
    TaskType {
        name: "plane",
        about: "Signed distance to a plane [m], positive on the side of its normal",
        keys: &[&keys::NORMAL],
        optional: &[
            (&keys::OFFSET_M, None),
            (&keys::FRAME, None),
            (&keys::RELATIVE_TO, None),
        ],
        one_of: &[],
        goal: ANY,
        read: |table, _, found| {
            let normal = table.direction(&keys::NORMAL, found).required(table, found);
            let offset_m = table.number(&keys::OFFSET_M, found).or(0.0);
            Some(TaskKind::Plane {
                normal: normal?,
                offset_m: offset_m?,
            })
        },
    },
    TaskType {
        name: "height",
        about: "Height [m]: z of the position",
        keys: &[],
        optional: OF_FRAME,
        one_of: &[],
        goal: ANY,
        read: |_, _, _| Some(TaskKind::Height),
    },
    arm_types::POSTURE,
    arm_types::JOINT_SPEED,
    arm_types::MANIPULABILITY,
    arm_types::SMALLEST_SINGULAR_VALUE,
    arm_types::ELBOW,
];

/// The type of that name.
pub(super) fn by_name(name: &str) -> Option<&'static TaskType> {
    ALL.iter().find(|task_type| task_type.name == name)
}
