//! What the monitors saw, on the terminal: a line each for those that saw something.

use conik_cli::report::monitors::{Line, lines as all_lines};
use conik_sim::monitors::JointMonitor;
use conik_sim::summary::Summary;

use crate::layout::wrapped;

/// A line per monitor that saw something, and per joint whose limits bound; of the changes of mode
/// the last line of the summary tells.
pub fn lines(summary: &Summary) -> String {
    let Some(monitors) = &summary.monitors else {
        return String::new();
    };
    let seen: Vec<String> = all_lines(summary, monitors)
        .iter()
        .filter(|line| line.seen.is_seen())
        .map(line)
        .chain(
            monitors
                .joints
                .iter()
                .filter(|joint| joint.was_limited())
                .map(joint),
        )
        .collect();
    if seen.is_empty() {
        return "  nothing else to report\n".to_owned();
    }
    seen.iter().map(|line| wrapped("  ", line)).collect()
}

/// `, at most 2 in one second`, where the mode changed.
pub fn most_changes(summary: &Summary) -> String {
    let changes = summary
        .monitors
        .as_ref()
        .map(|monitors| &monitors.mode_changes);
    changes
        .filter(|changes| changes.is_seen())
        .map_or(String::new(), |changes| {
            format!(", at most {} in one second", changes.worst)
        })
}

fn line(line: &Line) -> String {
    let mut text = format!("{}: for {:.3} s", line.about, line.seen.for_s);
    if !line.worst.is_empty() {
        text += &format!(", at worst {}", line.worst);
    }
    if let Some(task) = &line.seen.task {
        text += &format!(" in {task}");
    }
    if let Some(at_s) = line.seen.at_s {
        text += &format!(" at {at_s} s");
    }
    text
}

fn joint(joint: &JointMonitor) -> String {
    let mut bound: Vec<String> = [
        ("position", joint.position_limited_s),
        ("speed", joint.speed_limited_s),
        ("acceleration", joint.acceleration_limited_s),
    ]
    .into_iter()
    .filter(|(_, time)| *time > 0.0)
    .map(|(what, time)| format!("{what} for {time:.3} s"))
    .collect();
    let exceeded = &joint.acceleration_exceeded;
    if exceeded.is_seen() {
        let (times, at_s) = (exceeded.worst, exceeded.at_s.unwrap_or(0.0));
        bound.push(format!(
            "acceleration exceeded for a set, {times:.2} times at worst at {at_s} s"
        ));
    }
    format!("limits of {}: {}", joint.joint, bound.join(", "))
}
