//! The types of task that concern orientations.

use std::f64::consts::PI;

use super::config::TaskKind;
use super::keys;
use super::orientation;
use super::task_types::{GoalShape, PLAIN, RADIANS, TaskType};
use super::waypoints::{Counts, Places};

const ORIENTATION_COUNTS: Counts = Counts {
    point: false,
    orientation: true,
};
const POSE_COUNTS: Counts = Counts {
    point: true,
    orientation: true,
};

pub(super) const ORIENTATION: TaskType = TaskType {
    name: "orientation",
    about: "Orientation against a desired one: the rotation vector between them [rad]; cannot be a set, \
            \"orientation_angle\" can",
    moves: keys::TURNS,
    goal: GoalShape::Place(ORIENTATION_COUNTS),
    read: |table, _, _| {
        let (_, desired_quaternion_wxyz) = Places::known(table, ORIENTATION_COUNTS)?.first();
        Some(TaskKind::Orientation {
            desired_quaternion_wxyz,
        })
    },
    ..PLAIN
};

pub(super) const ORIENTATION_ANGLE: TaskType = TaskType {
    name: "orientation_angle",
    about: "Angle between the orientation and a desired one [rad], from 0 to π",
    one_of: &[&keys::DESIRED_RPY_DEG, &keys::DESIRED_QUATERNION_WXYZ],
    moves: keys::TURNS,
    goal: GoalShape::Scalar(0.0, PI),
    degrees: RADIANS,
    read: |table, _, found| {
        Some(TaskKind::OrientationAngle {
            desired_quaternion_wxyz: orientation::read(table, found)?,
        })
    },
    ..PLAIN
};

pub(super) const POSE: TaskType = TaskType {
    name: "pose",
    about: "Position [m] and orientation [rad] against desired ones, a metre counting as much as a radian; \
            cannot be a set",
    moves: keys::MOVES_AND_TURNS,
    goal: GoalShape::Place(POSE_COUNTS),
    read: |table, _, _| {
        let (target_m, desired_quaternion_wxyz) = Places::known(table, POSE_COUNTS)?.first();
        Some(TaskKind::Pose {
            target_m,
            desired_quaternion_wxyz,
        })
    },
    ..PLAIN
};

pub(super) const POINTING_ANGLE: TaskType = TaskType {
    name: "pointing_angle",
    about: "Angle between an axis, the z axis unless `axis` is given, and a direction [rad], from 0 to π",
    keys: &[&keys::DIRECTION],
    optional: &[&keys::AXIS_IN_FRAME],
    moves: keys::TURNS,
    goal: GoalShape::Scalar(0.0, PI),
    degrees: RADIANS,
    read: |table, _, found| {
        let direction = table
            .direction(&keys::DIRECTION, found)
            .required(table, found);
        let axis = table
            .direction(&keys::AXIS_IN_FRAME, found)
            .or([0.0, 0.0, 1.0]);
        Some(TaskKind::PointingAngle {
            axis: axis?,
            direction: direction?,
        })
    },
    ..PLAIN
};

pub(super) const LOOK_AT: TaskType = TaskType {
    name: "look_at",
    about: "Angle between the z axis and the line of sight to a point, which may move [rad], from 0 to π",
    keys: &[&keys::POINT_M],
    moves: keys::MOVES,
    goal: GoalShape::Scalar(0.0, PI),
    degrees: RADIANS,
    read: |table, _, found| {
        let point_m = table.vector(&keys::POINT_M, found).required(table, found)?;
        Some(TaskKind::LookAt { point_m })
    },
    ..PLAIN
};
