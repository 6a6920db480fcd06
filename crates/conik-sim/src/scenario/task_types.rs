//! The types of task that a scenario may name: what each measures, the keys it needs, and how it
//! is read and written. To add a type, add it here and to `TaskKind`.

use super::choice::Choice;
use super::config::TaskKind;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::motion;
use super::robots::RobotFacts;
use super::table::Table;
use super::write::{text, vector};

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
}

impl TaskType {
    /// The keys that state its goal.
    pub(super) fn goal_keys(&self) -> &'static [&'static Key] {
        match self.goal {
            GoalShape::Point => keys::POINT_GOAL,
            GoalShape::Scalar(..) => keys::SCALAR_GOAL,
        }
    }

    /// Every key that it may have.
    pub(super) fn all_keys(&self) -> impl Iterator<Item = &'static Key> + Clone {
        keys::TASK_KEYS
            .iter()
            .chain(self.keys)
            .chain(self.goal_keys())
            .copied()
            .chain(self.optional.iter().map(|(key, _)| *key))
    }
}

const ANY: GoalShape = GoalShape::Scalar(f64::NEG_INFINITY, f64::INFINITY);

/// Every type of task.
pub(super) const ALL: &[TaskType] = &[
    TaskType {
        name: "position",
        about: "Tool position in the base frame [m]; cannot be a set",
        keys: &[],
        optional: &[],
        goal: GoalShape::Point,
        read: |_, _, _| Some(TaskKind::Position),
    },
    TaskType {
        name: "coordinate",
        about: "One coordinate of the tool position in the base frame [m]",
        keys: &[&keys::AXIS],
        optional: &[],
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
        optional: &[
            (&keys::VELOCITY_M_PER_S, None),
            (&keys::MOVES_UNTIL_S, Some(&keys::VELOCITY_M_PER_S)),
        ],
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
        optional: &[],
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
        goal: ANY,
        read: |table, robot, found| {
            let joint = table
                .joint(&keys::JOINT, robot, found)
                .required(table, found)?;
            Some(TaskKind::Joint { joint })
        },
    },
];

/// The type of that name.
pub(super) fn by_name(name: &str) -> Option<&'static TaskType> {
    ALL.iter().find(|task_type| task_type.name == name)
}

/// What a task measures, as it stands in the file: the type's name, then its own keys and values.
pub(super) fn written(kind: &TaskKind) -> (&'static str, Vec<(&'static str, String)>) {
    match kind {
        TaskKind::Position => ("position", vec![]),
        TaskKind::Coordinate { axis } => ("coordinate", vec![(keys::AXIS.name, text(axis.name()))]),
        TaskKind::Distance { point_m, motion } => {
            let mut values = vec![(keys::POINT_M.name, vector(point_m))];
            values.extend(motion.iter().flat_map(motion::written));
            ("distance", values)
        }
        TaskKind::FieldOfView { direction } => (
            "field_of_view",
            vec![(keys::DIRECTION.name, vector(direction))],
        ),
        TaskKind::Joint { joint } => ("joint", vec![(keys::JOINT.name, joint.to_string())]),
    }
}
