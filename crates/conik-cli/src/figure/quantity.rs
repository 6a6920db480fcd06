//! What a task measures, in words, and in which unit.

use conik_sim::scenario::{Axis, TaskConfig, TaskKind};

use super::run::Run;

/// Unit of the task's value and of its error: `m`, `rad`, `-`.
pub fn unit<'a>(run: &'a Run, task: &TaskConfig) -> &'a str {
    let known = run.summary().settings.units.get(&task.name);
    known.map_or(
        match task.kind {
            TaskKind::Position | TaskKind::Coordinate { .. } | TaskKind::Distance { .. } => "m",
            TaskKind::Joint { .. } => "rad",
            TaskKind::FieldOfView { .. } => "-",
        },
        String::as_str,
    )
}

/// Axis label of the task's value: `distance [m]`.
pub fn value_label(run: &Run, task: &TaskConfig) -> String {
    let quantity = match task.kind {
        TaskKind::Position => "tool position".to_owned(),
        TaskKind::Coordinate { axis: Axis::X } => "tool x".to_owned(),
        TaskKind::Coordinate { axis: Axis::Y } => "tool y".to_owned(),
        TaskKind::Coordinate { axis: Axis::Z } => "tool z".to_owned(),
        TaskKind::Distance { .. } => "distance".to_owned(),
        TaskKind::FieldOfView { .. } => "view error".to_owned(),
        TaskKind::Joint { joint } => joint_name(run, joint),
    };
    format!("{quantity} [{}]", unit(run, task))
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
