//! What a task measures, in words, and in which unit.

use conik_sim::scenario::{Axis, Part, TaskConfig, TaskKind};

use super::lettering::number;
use super::run::Run;

/// Unit of the task's value and of its error: `m`, `rad`, `-`.
pub fn unit<'a>(run: &'a Run, task: &TaskConfig) -> &'a str {
    let known = run.summary().settings.units.get(&task.name);
    known.map_or(
        match task.kind {
            TaskKind::Position
            | TaskKind::Coordinate { .. }
            | TaskKind::Distance { .. }
            | TaskKind::Plane { .. }
            | TaskKind::Height
            | TaskKind::ShapeDistance { .. }
            | TaskKind::Shapes(_) => "m",
            TaskKind::Joint { .. }
            | TaskKind::Orientation { .. }
            | TaskKind::OrientationAngle { .. }
            | TaskKind::PointingAngle { .. }
            | TaskKind::LookAt { .. }
            | TaskKind::Posture { .. }
            | TaskKind::JointSpeed { .. }
            | TaskKind::Elbow { .. } => "rad",
            TaskKind::Pose { .. } => "m, rad",
            TaskKind::Manipulability { part } if part != Part::Orientation => "m³",
            TaskKind::SmallestSingularValue {
                part: Part::Position,
            } => "m/rad",
            TaskKind::FieldOfView { .. }
            | TaskKind::Manipulability { .. }
            | TaskKind::SmallestSingularValue { .. } => "-",
        },
        String::as_str,
    )
}

/// Axis label of the task's value: `distance [m]`.
pub fn value_label(run: &Run, task: &TaskConfig) -> String {
    format!("{} [{}]", quantity(run, task), unit(run, task))
}

/// What is measured: `distance`, `tool x`, `link_3 height`, `tool in link_3 height`.
pub fn quantity(run: &Run, task: &TaskConfig) -> String {
    let of_frame = |what: &str| format!("{} {what}", task.frames.described());
    // What the tool in the world is measured by needs no frame to be told.
    let of_other_frame = |what: &str| {
        if task.frames.is_tool_in_world() {
            what.to_owned()
        } else {
            of_frame(what)
        }
    };
    match task.kind {
        TaskKind::Position => of_frame("position"),
        TaskKind::Coordinate { axis: Axis::X } => of_frame("x"),
        TaskKind::Coordinate { axis: Axis::Y } => of_frame("y"),
        TaskKind::Coordinate { axis: Axis::Z } => of_frame("z"),
        TaskKind::Distance { .. } => of_other_frame("distance"),
        TaskKind::ShapeDistance { .. } | TaskKind::Shapes(_) => "distance".to_owned(),
        TaskKind::FieldOfView { .. } => of_other_frame("view error"),
        TaskKind::Orientation { .. } => of_frame("orientation"),
        TaskKind::OrientationAngle { .. } => of_other_frame("angle to turn"),
        TaskKind::Pose { .. } => of_frame("pose"),
        TaskKind::PointingAngle { .. } => of_other_frame("pointing angle"),
        TaskKind::LookAt { .. } => of_other_frame("angle off the point"),
        TaskKind::Plane { .. } => of_other_frame("height above plane"),
        TaskKind::Height => of_frame("height"),
        TaskKind::Joint { joint } => joint_name(run, joint),
        TaskKind::Posture { .. } => "posture".to_owned(),
        TaskKind::JointSpeed { joint, .. } => format!("{}, at a speed", joint_name(run, joint)),
        TaskKind::Manipulability { .. } => of_other_frame("manipulability"),
        TaskKind::SmallestSingularValue { .. } => of_other_frame("smallest singular value"),
        TaskKind::Elbow { .. } => "swivel of the elbow".to_owned(),
    }
}

/// What is desired of a task that has it among its own keys.
pub fn wanted(task: &TaskConfig) -> Option<String> {
    match task.kind {
        TaskKind::Orientation { .. } => Some("the desired orientation".to_owned()),
        TaskKind::Pose { .. } => Some("the desired pose".to_owned()),
        TaskKind::JointSpeed {
            speed_rad_per_s, ..
        } => Some(format!("{} rad/s", number(speed_rad_per_s, 4))),
        _ => None,
    }
}

/// Axis label of the norm of the task's error: `error norm [m]`.
pub fn error_label(run: &Run, task: &TaskConfig) -> String {
    format!("error norm [{}]", unit(run, task))
}

/// Name of the joint with that 1-based number.
pub fn joint_name(run: &Run, joint: usize) -> String {
    let names = &run.summary().settings.joint_names;
    let name = joint.checked_sub(1).and_then(|at| names.get(at));
    name.cloned().unwrap_or_else(|| format!("joint {joint}"))
}

/// Whether the task looks at the direction of view, which the paper's figure shows last.
pub fn is_view(task: &TaskConfig) -> bool {
    matches!(task.kind, TaskKind::FieldOfView { .. })
}
