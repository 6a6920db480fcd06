//! What concerns all tasks together: their names, their priority, and which exclude each other.

use std::collections::{HashMap, HashSet};

use conik::MAX_TASKS;

use super::control::Group;
use super::keys;
use super::mistake::{Mistakes, quoted};
use super::names;
use super::place;
use super::suggest::nearest;
use super::task::{ReadTask, Role};

/// What is wrong with the tasks of a controller that has `limits` others besides: those that keep the
/// joints' position limits, and those that keep shapes apart.
pub(super) fn check(tasks: &[ReadTask], limits: usize, groups: &[Group], found: &mut Mistakes) {
    names::check_unique(tasks, found);
    check_low_priority_gains(tasks, found);
    check_high_priority_damping(tasks, found);
    check_one_has_waypoints(tasks, found);
    check_number(tasks, limits, found);
    for group in groups {
        check_group(group, tasks, found);
    }
}

/// A set-based task below an equality task is driven back with a gain, as an equality task is, and
/// has no other speed.
fn check_low_priority_gains(tasks: &[ReadTask], found: &mut Mistakes) {
    let Some(first) = tasks.iter().position(|task| task.role == Role::Equality) else {
        return;
    };
    for task in &tasks[first..] {
        if let Some(span) = task.recovery.clone().filter(|_| task.role == Role::Set) {
            found.add(
                span,
                place::join(&task.path, keys::RECOVERY_PER_S.name),
                format!(
                    "a set below the equality task {} has low priority and is driven in with its \
                     gain",
                    tasks[first].path
                ),
                "remove it, or move the task above the equality task",
            );
        }
        if task.role == Role::Set && !task.has_gain {
            found.add(
                task.header.clone(),
                place::join(&task.path, keys::GAIN_PER_S.name),
                format!(
                    "missing: a set below the equality task {} has low priority and needs a gain",
                    tasks[first].path
                ),
                format!(
                    "{}, or move the task above it",
                    keys::GAIN_PER_S.write_example()
                ),
            );
        }
    }
}

/// A set-based task above every equality task is kept exactly, and is no level that could be damped.
fn check_high_priority_damping(tasks: &[ReadTask], found: &mut Mistakes) {
    // Below a task that may be meant as an equality task nothing is sure.
    let high = tasks.iter().take_while(|task| task.role == Role::Set);
    for task in high {
        if let Some(span) = task.damping.clone() {
            found.add(
                span,
                place::join(&task.path, keys::DAMPING.name),
                "a set above every equality task has high priority: it is kept, never damped",
                "remove it; equality tasks and the sets below one have `damping`",
            );
        }
    }
}

/// The log has one column for the waypoint in use.
fn check_one_has_waypoints(tasks: &[ReadTask], found: &mut Mistakes) {
    let mut with_waypoints = tasks
        .iter()
        .filter_map(|task| Some((task, task.waypoints.clone()?)));
    let Some((first, _)) = with_waypoints.next() else {
        return;
    };
    for (task, (span, key)) in with_waypoints {
        found.add(
            span,
            place::join(&task.path, key.name),
            format!(
                "{} has waypoints already, and only one task can",
                first.path
            ),
            "give this one a single place: `target_m`, or a desired orientation",
        );
    }
}

/// The controller has tasks for position limits and for pairs of shapes besides those of the file. The
/// first that it cannot have is reported.
fn check_number(tasks: &[ReadTask], limits: usize, found: &mut Mistakes) {
    let most = MAX_TASKS.saturating_sub(limits);
    let Some(task) = tasks.get(most) else {
        return;
    };
    let help = match limits {
        0 => format!("a scenario has at most {most}"),
        MAX_TASKS.. => format!(
            "the controller has at most {MAX_TASKS}, and position limits and shapes need at least \
             {limits}: take shapes or obstacles away"
        ),
        _ => format!(
            "the controller has at most {MAX_TASKS}, and {limits} of them keep position limits or \
             shapes apart: give at most {most}"
        ),
    };
    found.add(
        task.header.clone(),
        &*task.path,
        format!("{} tasks are too many", tasks.len()),
        help,
    );
}

/// Notes what is wrong with one group of `exclusive`.
fn check_group(group: &Group, tasks: &[ReadTask], found: &mut Mistakes) {
    if group.value.len() < 2 {
        found.add(
            group.span.clone(),
            &*group.path,
            "a group needs at least two tasks that exclude each other",
            keys::EXCLUSIVE.write_example(),
        );
    }
    let roles: HashMap<&str, Role> = tasks
        .iter()
        .filter_map(|task| Some((task.name.as_ref()?.value.as_str(), task.role)))
        .collect();
    let mut seen = HashSet::new();
    for name in &group.value {
        if found.is_full() {
            return;
        }
        let first_time = seen.insert(&name.value);
        let shown = quoted(&name.value);
        let (what, help) = match roles.get(name.value.as_str()) {
            _ if !first_time => (
                format!("{shown} stands in this group twice"),
                "remove one of them".to_owned(),
            ),
            Some(Role::Set | Role::Unclear) => continue,
            Some(Role::Equality) => (
                format!("{shown} is an equality task, which is always active"),
                "only set-based tasks can exclude each other".to_owned(),
            ),
            None => (
                format!("there is no task {shown}"),
                meant_set(&name.value, group, tasks),
            ),
        };
        found.add(name.span.clone(), &*name.path, what, help);
    }
}

/// Which set-based task may be meant by a name that no task has: none that the group names anyway.
fn meant_set(name: &str, group: &Group, tasks: &[ReadTask]) -> String {
    let sets = tasks.iter().filter(|task| task.role == Role::Set);
    let names = sets.filter_map(|task| Some(task.name.as_ref()?.value.as_str()));
    let named = |meant: &&str| group.value.iter().any(|other| other.value == **meant);
    match nearest(name, names.clone().filter(|meant| !named(meant))) {
        Some(meant) => format!("did you mean {}?", quoted(meant)),
        None => format!("the set-based tasks are: {}", first_few(names)),
    }
}

/// `"a", "b", ...`
fn first_few<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut listed: Vec<_> = names.take(9).map(quoted).collect();
    if listed.is_empty() {
        return "none".to_owned();
    }
    if listed.len() == 9 {
        listed[8] = String::from("...");
    }
    listed.join(", ")
}
