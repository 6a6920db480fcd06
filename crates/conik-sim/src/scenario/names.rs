//! Names of tasks: which are allowed, and that no two tasks or columns of the log share one.

use std::collections::{HashMap, HashSet};

use super::config::TaskConfig;
use super::keys;
use super::mistake::{Mistakes, quoted};
use super::place::Placed;
use super::table::Table;
use super::task::{ReadTask, Role};

/// Columns of the log that no task may be named as, besides those of the joints.
const COLUMNS: &[&str] = &[
    "t_s", "mode", "active", "waypoint", "tool_x_m", "tool_y_m", "tool_z_m", "why",
];

/// How the names of the sets begin that keep the joints' position limits.
pub(super) const LIMIT: &str = "limit/";

/// Columns of the log for each joint N: what stands before and after the number.
const JOINT_COLUMNS: &[(&str, &str)] = &[
    ("q", "_rad"),
    ("qd", "_rad_s"),
    ("qdd", "_rad_s2"),
    ("q", "_measured_rad"),
];

/// Characters of a task's name. The log joins names with `+`, and `,` parts its columns.
pub(super) const PATTERN: &str = "^[A-Za-z0-9_./-]+$";

/// No table or picture has room for longer names.
const LONGEST: usize = 200;

pub(super) fn is_name_character(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '/' | '-')
}

fn is_log_column(name: &str) -> bool {
    let of_joint = |(before, after): &(&str, &str)| {
        name.strip_prefix(before)
            .and_then(|rest| rest.strip_suffix(after))
            .is_some_and(|n| !n.is_empty() && n.bytes().all(|c| c.is_ascii_digit()))
    };
    COLUMNS.contains(&name) || JOINT_COLUMNS.iter().any(of_joint)
}

/// Reads the name of a task; a name that is wrong in itself is noted but returned all the same,
/// so that what refers to it is not wrong too.
pub(super) fn read(table: &Table, found: &mut Mistakes) -> Option<Placed<String>> {
    let name = table.text(&keys::NAME, found).required(table, found)?;
    let placed = Placed {
        value: name.to_owned(),
        span: table.span_of(&keys::NAME),
        path: table.path_of(&keys::NAME),
    };
    if name.is_empty() || !name.chars().all(is_name_character) {
        let right: String = name
            .trim()
            .chars()
            .take(40)
            .map(|c| if is_name_character(c) { c } else { '_' })
            .collect();
        let what = match name.chars().find(|c| !is_name_character(*c)) {
            Some(c) => format!("{c:?} cannot stand in the name of a task"),
            None => "the name is empty".to_owned(),
        };
        let right = if right.is_empty() { "pillar" } else { &right };
        found.add(
            placed.span.clone(),
            &*placed.path,
            what,
            format!("use letters, digits and `_ . / -`, for example {right:?}"),
        );
    } else if name.len() > LONGEST {
        found.add(
            placed.span.clone(),
            &*placed.path,
            format!("the name has {} characters", name.len()),
            format!("take a shorter one, of at most {LONGEST}"),
        );
    } else if is_log_column(name) {
        found.add(
            placed.span.clone(),
            &*placed.path,
            format!("{} is a column of the log already", quoted(name)),
            format!(
                "take another name, for example {}",
                quoted(&format!("task_{name}"))
            ),
        );
    }
    if name.starts_with(LIMIT) {
        found.add(
            placed.span.clone(),
            &*placed.path,
            format!("names that begin with `{LIMIT}` belong to the joints' position limits"),
            format!(
                "take another name, for example {}",
                quoted(&name.replacen(LIMIT, "limit_", 1))
            ),
        );
    }
    Some(placed)
}

/// Notes names of tasks that are those of sets which keep shapes apart.
pub(super) fn check_free(tasks: &[ReadTask], sets: &[TaskConfig], found: &mut Mistakes) {
    let mut taken: HashSet<&str> = HashSet::new();
    for set in sets {
        if set.name.starts_with(LIMIT) {
            found.add(
                0..0,
                "shape",
                format!(
                    "{} would be the name of a pair of shapes, and such names belong to the joints' \
                     position limits",
                    quoted(&set.name)
                ),
                "give the shape another name than `limit`",
            );
        }
        // Such as `a/b` and `c` with `a` and `b/c`.
        if !taken.insert(&set.name) {
            found.add(
                0..0,
                "shape",
                format!(
                    "two pairs of shapes would both be named {}",
                    quoted(&set.name)
                ),
                "give shapes and obstacles names without `/`",
            );
        }
    }
    for name in tasks.iter().filter_map(|task| task.name.as_ref()) {
        if taken.contains(name.value.as_str()) {
            found.add(
                name.span.clone(),
                &*name.path,
                format!(
                    "{} is the name of the set that keeps those shapes apart",
                    quoted(&name.value)
                ),
                "take another name",
            );
        }
    }
}

/// Notes names that two tasks share, and names that are the error column of another task.
pub(super) fn check_unique(tasks: &[ReadTask], found: &mut Mistakes) {
    let named = || {
        tasks
            .iter()
            .filter_map(|task| Some((task, task.name.as_ref()?)))
    };
    let equality: HashSet<&str> = named()
        .filter(|(task, _)| task.role == Role::Equality)
        .map(|(_, name)| name.value.as_str())
        .collect();
    let mut first: HashMap<&str, &ReadTask> = HashMap::new();
    for (task, name) in named() {
        if let Some(earlier) = first.get(name.value.as_str()) {
            found.add(
                name.span.clone(),
                &*name.path,
                format!("{} has this name already", earlier.path),
                "every task needs a name of its own",
            );
            continue;
        }
        first.insert(&name.value, task);
        if let Some(other) = name
            .value
            .strip_suffix("_error")
            .filter(|other| equality.contains(other))
        {
            found.add(
                name.span.clone(),
                &*name.path,
                format!(
                    "{} is the log's column for the error of task {}",
                    quoted(&name.value),
                    quoted(other)
                ),
                "take another name",
            );
        }
    }
}
