//! The types of task that a scenario may name: what each measures, the keys it needs, and how it
//! is read; those that concern orientations stand in `orientation_types.rs`, those that concern the
//! arm as a whole in `arm_types.rs`. To add a type, add a constant and its place in the list [`ALL`]: what
//! it has beyond [`PLAIN`]; then the compiler asks for it in `written.rs` and `measured.rs`. Reader, schema
//! and messages follow, and so do frames, goals, motion and damping.

use super::config::TaskKind;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robots::RobotFacts;
use super::table::Table;
use super::waypoints::Counts;
use super::{arm_types, orientation_types, shape_distance, workspace};

/// A type of task.
#[derive(Debug)]
pub(super) struct TaskType {
    /// Its name in the file.
    pub(super) name: &'static str,
    /// What it measures, in one line for people, with the unit.
    pub(super) about: &'static str,
    /// The keys that it needs besides name, type and goal.
    pub(super) keys: &'static [&'static Key],
    /// The keys that it may have besides.
    pub(super) optional: &'static [&'static Key],
    /// The keys that say what is measured, and as who sees it.
    pub(super) frames: &'static [&'static Key],
    /// The keys of which it needs one, and cannot have two.
    pub(super) one_of: &'static [&'static Key],
    /// The keys that say how what it measures against moves.
    pub(super) moves: &'static [&'static Key],
    /// What can be asked of it.
    pub(super) goal: GoalShape,
    /// How its value follows from an angle in degrees, if it is one.
    pub(super) degrees: Option<Degrees>,
    /// Reads what it measures.
    pub(super) read: fn(&Table, Option<&RobotFacts>, &mut Mistakes) -> Option<TaskKind>,
}

/// How a value follows from an angle in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Degrees {
    /// The value, which grows with the angle.
    pub(super) to_value: fn(f64) -> f64,
    /// The angle [deg].
    pub(super) of_value: fn(f64) -> f64,
}

/// The value is the angle in radians.
pub(super) const RADIANS: Option<Degrees> = Some(Degrees {
    to_value: f64::to_radians,
    of_value: f64::to_degrees,
});

/// The value is the length of the chord: 2 sin(angle / 2).
const CHORD: Option<Degrees> = Some(Degrees {
    to_value: |angle| 2.0 * (angle.clamp(-180.0, 180.0).to_radians() / 2.0).sin(),
    of_value: |chord| 2.0 * (chord / 2.0).asin().to_degrees(),
});

/// What can be asked of a type of task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GoalShape {
    /// A point, an orientation or both: one place, or waypoints to visit; never a set.
    Place(Counts),
    /// One value that is always between these: desired, or kept in a set.
    Scalar(f64, f64),
    /// What its own keys say, and no error that a gain acts on; never a set.
    Own,
    /// A position for each of some joints; never a set.
    Posture,
    /// Staying inside what its own keys say; always a set.
    Region,
}

impl TaskType {
    /// The keys that state its goal.
    pub(super) fn goal_keys(&self) -> &'static [&'static Key] {
        match self.goal {
            GoalShape::Place(Counts {
                orientation: false, ..
            }) => keys::POINT_GOAL,
            GoalShape::Place(Counts { point: false, .. }) => keys::ORIENTATION_GOAL,
            GoalShape::Place(_) => keys::POSE_GOAL,
            GoalShape::Scalar(..) if self.degrees.is_some() => keys::ANGLE_GOAL,
            GoalShape::Scalar(..) => keys::SCALAR_GOAL,
            GoalShape::Own => keys::OWN_GOAL,
            GoalShape::Posture => keys::POSTURE_GOAL,
            GoalShape::Region => keys::REGION_GOAL,
        }
    }

    /// The keys that say how fast something of it moves.
    pub(super) fn speed_keys(&self) -> Vec<&'static Key> {
        let desired = matches!(self.goal, GoalShape::Scalar(..)).then_some(&keys::DESIRED_PER_S);
        self.moves.iter().copied().chain(desired).collect()
    }

    /// Those, and the key that says when it comes to rest.
    fn motion_keys(&self) -> impl Iterator<Item = &'static Key> + Clone + use<> {
        let speeds = self.speed_keys();
        let until = (!speeds.is_empty()).then_some(&keys::MOVES_UNTIL_S);
        speeds.into_iter().chain(until)
    }

    /// Every key that it may have.
    pub(super) fn all_keys(&self) -> impl Iterator<Item = &'static Key> + Clone {
        keys::TASK_KEYS
            .iter()
            .chain(self.keys)
            .chain(self.one_of)
            .chain(self.goal_keys())
            .chain(self.optional)
            .chain(self.frames)
            .copied()
            .chain(self.motion_keys())
    }
}

pub(super) const ANY: GoalShape = GoalShape::Scalar(f64::NEG_INFINITY, f64::INFINITY);

/// What a type is that says nothing else: a value of any size of a frame, without keys of its own.
pub(super) const PLAIN: TaskType = TaskType {
    name: "",
    about: "",
    keys: &[],
    optional: &[],
    frames: &[&keys::FRAME, &keys::RELATIVE_TO],
    one_of: &[],
    moves: &[],
    goal: ANY,
    degrees: None,
    read: |_, _, _| None,
};

/// Every type of task.
pub(super) const ALL: &[TaskType] = &[
    TaskType {
        name: "position",
        about: "Position of the tool, or of `frame` [m]; cannot be a set",
        moves: keys::MOVES,
        goal: GoalShape::Place(Counts {
            point: true,
            orientation: false,
        }),
        read: |_, _, _| Some(TaskKind::Position),
        ..PLAIN
    },
    TaskType {
        name: "coordinate",
        about: "One coordinate of the position [m]",
        keys: &[&keys::AXIS],
        read: |table, _, found| {
            let axis = table.choice(&keys::AXIS, found).required(table, found)?;
            Some(TaskKind::Coordinate { axis })
        },
        ..PLAIN
    },
    TaskType {
        name: "distance",
        about: "Distance of the tool to a point [m], which may move",
        keys: &[&keys::POINT_M],
        moves: keys::MOVES,
        goal: GoalShape::Scalar(0.0, f64::INFINITY),
        read: |table, _, found| {
            let point_m = table.vector(&keys::POINT_M, found).required(table, found)?;
            Some(TaskKind::Distance { point_m })
        },
        ..PLAIN
    },
    TaskType {
        name: "field_of_view",
        about: "Norm of (direction - tool z axis) [-]: 2 sin(angle / 2), from 0 to 2",
        keys: &[&keys::DIRECTION],
        moves: keys::TURNS,
        goal: GoalShape::Scalar(0.0, 2.0),
        degrees: CHORD,
        read: |table, _, found| {
            let direction = table
                .direction(&keys::DIRECTION, found)
                .required(table, found)?;
            Some(TaskKind::FieldOfView { direction })
        },
        ..PLAIN
    },
    TaskType {
        name: "joint",
        about: "Position of one joint [rad], or [m] if it slides",
        keys: &[&keys::JOINT],
        frames: &[],
        degrees: RADIANS,
        read: |table, robot, found| {
            let joint = table
                .joint(&keys::JOINT, robot, found)
                .required(table, found)?;
            Some(TaskKind::Joint { joint })
        },
        ..PLAIN
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
        optional: &[&keys::OFFSET_M],
        read: |table, _, found| {
            let normal = table.direction(&keys::NORMAL, found).required(table, found);
            let offset_m = table.number(&keys::OFFSET_M, found).or(0.0);
            Some(TaskKind::Plane {
                normal: normal?,
                offset_m: offset_m?,
            })
        },
        ..PLAIN
    },
    TaskType {
        name: "height",
        about: "Height [m]: z of the position",
        read: |_, _, _| Some(TaskKind::Height),
        ..PLAIN
    },
    shape_distance::SHAPE_DISTANCE,
    workspace::WORKSPACE,
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
