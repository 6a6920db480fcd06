//! The tables of the page: tasks, mode changes, tracking and step time.
//!
//! Writing to a string cannot fail, so what `writeln!` returns is dropped.

use std::fmt::Write;

use conik_sim::scenario::{GoalConfig, TaskConfig, TaskKind};
use conik_sim::summary::{Summary, TaskSummary};

use super::replay::moment;
use super::table::{section, table};
use super::units;
use crate::figure::lettering::{number, seconds};
use crate::figure::markup::Escaped;
use crate::figure::{Run, quantity};

/// More mode changes than this are not listed: the log has them.
const MOST_CHANGES: usize = 200;

/// A longer list of changes is folded.
const READ_AT_A_GLANCE: usize = 40;

/// What was asked of each task and what became of it.
pub fn tasks(run: &Run) -> String {
    let nothing = TaskSummary::default();
    let mut body = String::new();
    for (nth, task) in run.tasks().iter().enumerate() {
        let unit = quantity::unit(run, task);
        let result = run.summary().tasks.get(&task.name).unwrap_or(&nothing);
        let entered = match (&task.goal, result.entered_set_s) {
            (GoalConfig::Set { .. }, None) => "never".to_owned(),
            (_, entered) => time(entered),
        };
        let _ = writeln!(
            body,
            "<tr><td class=\"number\">{}</td><th scope=\"row\">{}</th><td>{}</td><td>{}</td>\
             <td class=\"number\">{}</td><td class=\"number\">{entered}</td>\
             <td class=\"number breaks\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td></tr>",
            nth + 1,
            breakable(&task.name),
            Escaped(&kind(run, task)),
            goal(task, unit),
            units::optional(result.worst_violation, unit),
            held(result),
            units::optional(result.largest_crossing, unit),
            units::optional(result.final_error, unit),
        );
    }
    section(
        "Tasks, the most important first",
        &[
            ("Priority", true),
            ("Name", false),
            ("Measures", false),
            ("Asked", false),
            ("Violation", true),
            ("Entered", true),
            ("Active", true),
            ("Crossing", true),
            ("Final error", true),
        ],
        &body,
        "<p class=\"note\">Crossing: how much further out, let go, the set would have been at \
         the end of a period, at most.</p>\n",
    )
}

/// A name that may be broken after each of its parts.
fn breakable(name: &str) -> String {
    let escaped = Escaped(name).to_string();
    escaped.replace('/', "/<wbr>").replace('_', "_<wbr>")
}

/// For how long a set was active, and in how many stretches: `4.2 s, 3 times`.
fn held(result: &TaskSummary) -> String {
    let stretches = match result.held_times {
        None | Some(0) => String::new(),
        Some(1) => ", once".to_owned(),
        Some(times) => format!(", {times} times"),
    };
    time(result.active_s) + &stretches
}

/// What is measured, and what of it moves: `distance to (0, 0, 1), moves at (0.1, 0, 0) m/s until 4 s`.
fn kind(run: &Run, task: &TaskConfig) -> String {
    let mut kind = kind_at_start(run, task);
    let motion = &task.motion;
    let rate = motion.desired_per_s.map(|rate| number(rate, 4));
    let ways = [
        (
            " moves at",
            motion.velocity_m_per_s.map(|it| point(&it)),
            "m/s",
        ),
        (
            " turns at",
            motion.angular_velocity_rad_per_s.map(|it| point(&it)),
            "rad/s",
        ),
        (" goal moves at", rate, "a second"),
    ];
    let mut joint = ",";
    for (how, speed, unit) in ways {
        if let Some(speed) = speed {
            kind += &format!("{joint}{how} {speed} {unit}");
            joint = " and";
        }
    }
    if let Some(until) = motion.moves_until_s {
        kind += &format!(" until {}", seconds(until));
    }
    kind
}

fn kind_at_start(run: &Run, task: &TaskConfig) -> String {
    match task.kind {
        TaskKind::Distance { point_m } => format!("distance to {}", point(&point_m)),
        TaskKind::FieldOfView { .. } => "field of view".to_owned(),
        TaskKind::PointingAngle { direction, .. } => {
            format!(
                "{} along {}",
                quantity::quantity(run, task),
                point(&direction)
            )
        }
        TaskKind::LookAt { point_m, .. } => {
            format!("{} at {}", quantity::quantity(run, task), point(&point_m))
        }
        TaskKind::Shapes(ref pair) => format!(
            "{} to {}",
            pair.shape.type_name().replace('_', "-"),
            pair.other.type_name().replace('_', "-"),
        ),
        _ => quantity::quantity(run, task),
    }
}

fn point(coordinates: &[f64]) -> String {
    let numbers: Vec<String> = coordinates.iter().map(|&value| number(value, 4)).collect();
    format!("({})", numbers.join(", "))
}

fn goal(task: &TaskConfig, unit: &str) -> String {
    match &task.goal {
        GoalConfig::Set { min, max, .. } => {
            let min = min.map(|min| format!("≥\u{a0}{}", units::limit(min, unit)));
            let max = max.map(|max| format!("≤\u{a0}{}", units::limit(max, unit)));
            [min, max]
                .into_iter()
                .flatten()
                .collect::<Vec<_>>()
                .join(", ")
        }
        GoalConfig::Desired { desired, .. } => match desired[..] {
            _ if quantity::wanted(task).is_some() => {
                format!("= {}", quantity::wanted(task).unwrap_or_default())
            }
            [value] => format!("= {}", units::limit(value, unit)),
            _ => format!("= {} {}", point(desired), Escaped(unit)),
        },
        GoalConfig::Waypoints {
            acceptance_m,
            acceptance_rad,
            ..
        } => {
            let distance = acceptance_m.map(|it| units::quantity(it, "m"));
            let angle = acceptance_rad.map(|it| units::quantity(it, "rad"));
            let near: Vec<_> = [distance, angle].into_iter().flatten().collect();
            format!(
                "{} waypoints, each to {}",
                task.goal.waypoint_count().unwrap_or_default(),
                near.join(" and ")
            )
        }
    }
}

/// When which sets became active.
pub fn mode_changes(run: &Run) -> String {
    let changes = &run.summary().modes;
    let mut body = String::new();
    for change in changes.iter().take(MOST_CHANGES) {
        let mode = change
            .mode
            .map_or_else(|| "–".to_owned(), |mode| mode.to_string());
        let active = if change.active.is_empty() {
            "none".to_owned()
        } else {
            Escaped(&change.active.join(" + ")).to_string()
        };
        let _ = writeln!(
            body,
            "<tr><td class=\"number\">{}</td><td class=\"number\">{mode}</td><td>{active}</td></tr>",
            moment(change.t_s)
        );
    }
    let left_out = changes.len().saturating_sub(MOST_CHANGES);
    let note = if left_out > 0 {
        format!("<p class=\"note\">{left_out} more changes are in summary.json.</p>\n")
    } else {
        String::new()
    };
    let columns = [("Since", true), ("Mode", true), ("Active sets", false)];
    let table = table(&columns, &body);
    let list = if changes.len() > READ_AT_A_GLANCE {
        let count = changes.len().min(MOST_CHANGES);
        format!("<details>\n<summary>The first {count}</summary>\n{table}{note}</details>\n")
    } else {
        table + &note
    };
    format!("<section>\n<h2>Mode changes</h2>\n{list}</section>\n")
}

/// How fast the controller was, and how closely the arm followed.
pub fn timing(run: &Run) -> String {
    let summary = run.summary();
    let time = &summary.step_time_us;
    let text = format!(
        "<section>\n<h2>Step time and tracking</h2>\n<p>A step of the controller took {} µs \
         (median), {} µs (99 of 100), {} µs (the slowest). {} of the arm's cycles went by without \
         a reference.</p>\n",
        number(time.median, 3),
        number(time.p99, 3),
        number(time.max, 3),
        summary.deadline_misses,
    );
    let tracking = tracking(run, summary);
    format!("{text}{tracking}</section>\n")
}

fn tracking(run: &Run, summary: &Summary) -> String {
    let Some(tracking) = &summary.tracking else {
        return "<p>This arm has no measurement of its own, so there is no tracking error.</p>\n"
            .to_owned();
    };
    let mut body = String::new();
    let of = |list: &Option<Vec<f64>>, nth: usize| list.as_ref()?.get(nth).copied();
    for (nth, (max, rms)) in tracking.max_rad.iter().zip(&tracking.rms_rad).enumerate() {
        let errors = [
            Some(*max),
            Some(*rms),
            of(&tracking.delayed_max_rad, nth),
            of(&tracking.delayed_rms_rad, nth),
        ];
        let cells = errors.map(|error| {
            let error = units::optional(error, "rad");
            format!("<td class=\"number\">{error}</td>")
        });
        let _ = writeln!(
            body,
            "<tr><th scope=\"row\">{}</th>{}</tr>",
            Escaped(&quantity::joint_name(run, nth + 1)),
            cells.concat(),
        );
    }
    let columns = [
        ("Joint", false),
        ("Largest tracking error", true),
        ("Root mean square", true),
        ("Largest, less the delay", true),
        ("Root mean square, less the delay", true),
    ];
    let delay = tracking.delay_s.map_or(String::new(), |delay_s| {
        format!(
            "<p>The arm ran {:.1} ms behind its reference: at this lag the two agree best.</p>\n",
            1e3 * delay_s
        )
    });
    delay + &table(&columns, &body)
}

fn time(t_s: Option<f64>) -> String {
    t_s.map_or_else(|| "–".to_owned(), seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_break_between_their_parts() {
        assert_eq!(
            breakable("upper_arm/<post>"),
            "upper_<wbr>arm/<wbr>&lt;post&gt;"
        );
    }
}
