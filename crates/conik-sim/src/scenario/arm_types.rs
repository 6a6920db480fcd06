//! The types of task that concern the arm as a whole: several joints, speeds, singularities, the elbow.

use std::f64::consts::PI;

use super::config::TaskKind;
use super::keys;
use super::posture;
use super::robot::{in_one_unit, of_joint};
use super::task_types::{GoalShape, PLAIN, RADIANS, TaskType};

pub(super) const POSTURE: TaskType = TaskType {
    name: "posture",
    about: "Positions of all joints, or of some [rad, or m]; cannot be a set, \"joint\" can",
    optional: &[&keys::JOINTS],
    frames: &[],
    goal: GoalShape::Posture,
    read: |table, robot, found| {
        Some(TaskKind::Posture {
            joints: posture::joints(table, robot, found)?,
        })
    },
    ..PLAIN
};

pub(super) const JOINT_SPEED: TaskType = TaskType {
    name: "joint_speed",
    about: "Speed of one joint, wherever it is; its value is the joint's position [rad, or m]; cannot be a \
            set, speed limits stand in `[robot]`",
    keys: &[&keys::JOINT],
    frames: &[],
    one_of: &[&keys::SPEED_DEG_PER_S, &keys::SPEED_RAD_PER_S],
    goal: GoalShape::Own,
    read: |table, robot, found| {
        let joint = table
            .joint(&keys::JOINT, robot, found)
            .required(table, found);
        let in_deg = table.number(&keys::SPEED_DEG_PER_S, found);
        let in_rad = table.number(&keys::SPEED_RAD_PER_S, found);
        let (deg, rad) = (&keys::SPEED_DEG_PER_S, &keys::SPEED_RAD_PER_S);
        let speed = in_one_unit(table, deg, in_deg, rad, in_rad, found);
        let (speed, in_rad) = speed.required(table, found)?;
        let joint = joint?;
        Some(TaskKind::JointSpeed {
            joint,
            speed_rad_per_s: of_joint(robot, joint - 1, in_rad)(speed),
        })
    },
    ..PLAIN
};

pub(super) const MANIPULABILITY: TaskType = TaskType {
    name: "manipulability",
    about: "Manipulability √det(J Jᵀ) [m³, of an orientation -]: 0 at a singularity",
    optional: &[&keys::PART],
    goal: GoalShape::Scalar(0.0, f64::INFINITY),
    read: |table, robot, found| {
        Some(TaskKind::Manipulability {
            part: posture::part(table, robot, found)?,
        })
    },
    ..PLAIN
};

pub(super) const SMALLEST_SINGULAR_VALUE: TaskType = TaskType {
    name: "smallest_singular_value",
    about: "Smallest singular value of the Jacobian [m/rad, of an orientation or a pose -]: the least speed \
            for a joint speed of 1; 0 at a singularity",
    optional: &[&keys::PART],
    goal: MANIPULABILITY.goal,
    read: |table, robot, found| {
        Some(TaskKind::SmallestSingularValue {
            part: posture::part(table, robot, found)?,
        })
    },
    ..PLAIN
};

pub(super) const ELBOW: TaskType = TaskType {
    name: "elbow",
    about: "Angle [rad] from `direction` to the elbow, about the line from shoulder to wrist, from -π to π",
    keys: &[
        &keys::SHOULDER,
        &keys::ELBOW,
        &keys::WRIST,
        &keys::DIRECTION,
    ],
    frames: &[&keys::RELATIVE_TO],
    goal: GoalShape::Scalar(-PI, PI),
    degrees: RADIANS,
    read: |table, robot, found| {
        let [shoulder, elbow, wrist] = [&keys::SHOULDER, &keys::ELBOW, &keys::WRIST]
            .map(|key| table.link(key, robot, found).required(table, found));
        let direction = table
            .direction(&keys::DIRECTION, found)
            .required(table, found);
        Some(TaskKind::Elbow {
            shoulder: shoulder?,
            elbow: elbow?,
            wrist: wrist?,
            direction: direction?,
        })
    },
    ..PLAIN
};
