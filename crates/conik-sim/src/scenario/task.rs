//! Reading one `[[task]]`.

use std::ops::Range;

use super::config::{GoalConfig, TaskConfig, TaskKind};
use super::damping::{self, Damping};
use super::frames;
use super::goal;
use super::key::Key;
use super::keys;
use super::mistake::{Mistakes, quoted};
use super::motion;
use super::moving_goal;
use super::names;
use super::place::Placed;
use super::read::Surroundings;
use super::shape_distance;
use super::suggest::nearest;
use super::table::{Table, unknown_name};
use super::task_types::{self, GoalShape, TaskType};
use super::waypoints::{Counts, WAYPOINTS, first_of};
use super::workspace;

/// What was found in one `[[task]]`.
#[derive(Clone, Debug)]
pub(super) struct ReadTask {
    /// The task, if everything in it is right.
    pub(super) config: Option<TaskConfig>,
    /// Its name, even if the rest is wrong.
    pub(super) name: Option<Placed<String>>,
    /// What its keys make of it, even if their values are wrong.
    pub(super) role: Role,
    /// Path of the task: `task[3] "view"`.
    pub(super) path: String,
    /// Its header.
    pub(super) header: Range<usize>,
    /// Whether it states a gain.
    pub(super) has_gain: bool,
    /// Where its speed of recovery stands.
    pub(super) recovery: Option<Range<usize>>,
    /// Where its damping stands.
    pub(super) damping: Option<Range<usize>>,
    /// Where its waypoints stand, and under which key.
    pub(super) waypoints: Option<(Range<usize>, &'static Key)>,
}

/// What a task is in the hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// It has a desired value.
    Equality,
    /// It has limits.
    Set,
    /// Its keys say neither or both; that has been noted.
    Unclear,
}

/// Reads one `[[task]]`: what it is, or the sets of which it consists.
pub(super) fn read(
    table: &Table,
    surroundings: Surroundings,
    found: &mut Mistakes,
) -> Vec<ReadTask> {
    let mut table = table.clone();
    if let Some(name) = table
        .entries
        .get(keys::NAME.name)
        .and_then(|name| name.get_ref().as_str())
    {
        table.path = format!("{} {}", table.path, quoted(name));
    }
    let name = names::read(&table, found);
    let task_type = read_type(&table, found);
    refuse_unknown_keys(&table, task_type, found);

    let kind = task_type
        .and_then(|it| (it.read)(&table, surroundings.robot, found))
        .filter(|kind| shape_distance::check(&table, kind, surroundings.scene, found));
    let frames = frames::read(&table, surroundings.robot, found);
    let speeds = task_type.map_or(Vec::new(), TaskType::speed_keys);
    let motion = motion::read(&table, &speeds, found);
    let goal = match task_type {
        Some(task_type) => {
            let goal = goal::read(&table, task_type, surroundings, found);
            if let (Some(motion), Some(goal)) = (&motion, &goal) {
                moving_goal::check(&table, task_type, (motion, goal), surroundings, found);
            }
            goal
        }
        None => goal::look_over(&table, found),
    };
    let damping = damping::read(&table, found).or(Damping::default());
    let is_region = task_type.is_some_and(|it| it.goal == GoalShape::Region);
    let parts = is_region.then(|| workspace::read(&table, found)).flatten();
    let config = |name: &Placed<String>, kind: TaskKind, goal: GoalConfig| {
        Some(TaskConfig {
            name: name.value.clone(),
            kind,
            frames: frames.clone()?,
            motion: motion?,
            goal,
            damping: damping?,
        })
    };
    let mut task = ReadTask {
        config: None,
        role: role(&table, task_type),
        has_gain: table.has(&keys::GAIN_PER_S),
        recovery: place_of(&table, &keys::RECOVERY_PER_S),
        damping: place_of(&table, &keys::DAMPING),
        waypoints: first_of(&table, WAYPOINTS).map(|key| (table.span_of(key), key)),
        name,
        header: table.header.clone(),
        path: table.path,
    };
    let (Some(name), Some(goal)) = (task.name.clone(), goal) else {
        return vec![task];
    };
    let Some(parts) = parts else {
        task.config = kind.and_then(|kind| config(&name, kind, goal));
        return vec![task];
    };
    let of_part = |part: workspace::Part| {
        let name = Placed {
            value: format!("{}{}", name.value, part.suffix),
            ..name.clone()
        };
        let goal = part.goal(&goal);
        ReadTask {
            config: config(&name, part.kind, goal),
            name: Some(name),
            ..task.clone()
        }
    };
    parts.into_iter().map(of_part).collect()
}

/// Where the value of a key stands, if it does.
fn place_of(table: &Table, key: &Key) -> Option<Range<usize>> {
    table.has(key).then(|| table.span_of(key))
}

fn role(table: &Table, task_type: Option<&TaskType>) -> Role {
    let has_limits = first_of(table, keys::LIMITS).is_some();
    let places = [&keys::TARGET_M, &keys::WAYPOINTS_M];
    let has_desired = first_of(table, keys::DESIRED_VALUE).or(first_of(table, &places));
    let has_desired = has_desired.is_some();
    match task_type.map(|it| it.goal) {
        Some(GoalShape::Region) => Role::Set,
        Some(goal) if !matches!(goal, GoalShape::Scalar(..)) => Role::Equality,
        _ => match (has_desired, has_limits) {
            (true, false) => Role::Equality,
            (false, true) => Role::Set,
            _ => Role::Unclear,
        },
    }
}

fn read_type(table: &Table, found: &mut Mistakes) -> Option<&'static TaskType> {
    let name = table.text(&keys::TYPE, found).required(table, found)?;
    let task_type = task_types::by_name(name);
    if task_type.is_none() {
        let (_, help) = unknown_name(name, task_types::ALL.iter().map(|known| known.name));
        let what = format!("unknown task type {}", quoted(name));
        found.add(
            table.span_of(&keys::TYPE),
            table.path_of(&keys::TYPE),
            what,
            help,
        );
    }
    task_type
}

/// A key that another type would have deserves to hear so.
fn refuse_unknown_keys(table: &Table, task_type: Option<&'static TaskType>, found: &mut Mistakes) {
    let Some(task_type) = task_type else {
        // Of a task of unknown type, any key of any type may be meant.
        let known = task_types::ALL.iter().flat_map(TaskType::all_keys);
        let names = known.clone().map(|key| key.name);
        let of_none = |name: &str| {
            nearest(name, names.clone()).is_none().then(|| {
                let what = format!("unknown key {}", quoted(name));
                (what, "no type of task has such a key".to_owned())
            })
        };
        return table.refuse_unknown_keys(&known, of_none, found);
    };
    let special = |name: &str| {
        let owner = task_types::ALL
            .iter()
            .find(|other| other.all_keys().any(|key| key.name == name))?;
        let this = task_type.name;
        let is_point =
            matches!(task_type.goal, GoalShape::Place(Counts { orientation, .. }) if !orientation);
        let is_scalar = matches!(task_type.goal, GoalShape::Scalar(..));
        Some(match name {
            "min" | "max" | "desired" if task_type.goal == GoalShape::Region => (
                format!("a task of type {this:?} has no `{name}`: it is a region"),
                "give `center_m` and `radius_m`, or `min_m` and `max_m`".to_owned(),
            ),
            "min" | "max" | "min_deg" | "max_deg" | "recovery_per_s" if !is_scalar && !is_point => (
                format!("a task of type {this:?} cannot be a set"),
                "sets are of one number: take type \"orientation_angle\", \"coordinate\" or \"joint\""
                    .to_owned(),
            ),
            "min" | "max" | "min_deg" | "max_deg" | "recovery_per_s" if is_point => (
                format!("a task of type {this:?} cannot be a set: its value is a point"),
                "take type \"coordinate\" to limit one axis, or \"distance\" to keep away from a \
                 point"
                    .to_owned(),
            ),
            "desired" if is_point => (
                format!("a task of type {this:?} has no single `desired` value"),
                keys::TARGET_M.write_example(),
            ),
            "target_m" | "waypoints_m" | "acceptance_m" if is_scalar => (
                format!("a task of type {this:?} has no `{name}`: its value is one number"),
                "give `desired`, or `min` and/or `max`; points belong to type \"position\""
                    .to_owned(),
            ),
            _ => (
                format!("`{name}` is a key of type {:?}, not of {this:?}", owner.name),
                "remove it, or correct the type".to_owned(),
            ),
        })
    };
    table.refuse_unknown_keys(&task_type.all_keys(), special, found);
}
