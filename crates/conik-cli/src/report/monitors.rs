//! What was seen in a run besides the five properties: each monitor in plain words, with its verdict.

use std::fmt::Write;

use conik_sim::monitors::{JointMonitor, Monitors, Sighting, Verdict};
use conik_sim::summary::Summary;

use super::replay::moment;
use super::{table, units};
use crate::figure::Run;
use crate::figure::lettering::{number, seconds};
use crate::figure::markup::Escaped;

/// What one monitor says, ready for people.
#[derive(Clone, Debug)]
pub struct Line<'a> {
    /// What it looks for, in a few words.
    pub about: &'static str,
    /// The same as a sentence.
    pub sentence: &'static str,
    /// What it saw.
    pub seen: &'a Sighting,
    /// For how long, or how often.
    pub how_long: String,
    /// The worst of it, with its unit; empty if there was nothing.
    pub worst: String,
}

/// Writes the worst that was seen, given with the unit of its task.
type Amount = fn(f64, &str) -> String;

/// Every monitor but those of the joints and of the mode.
pub fn lines<'a>(summary: &Summary, monitors: &'a Monitors) -> Vec<Line<'a>> {
    let of_task = |seen: &Sighting| unit(summary, seen);
    let words: [(_, _, &Sighting, Amount); 7] = [
        (
            "rank lost",
            "A task lost directions to a singularity, or to what stands above it.",
            &monitors.rank_lost,
            |worst, _| match worst {
                1.0 => "1 direction".to_owned(),
                worst => format!("{} directions", number(worst, 3)),
            },
        ),
        (
            "frozen set moved",
            "A frozen high-priority set moved.",
            &monitors.frozen_moves,
            |worst, unit| format!("{}/s", units::quantity(worst, unit)),
        ),
        (
            "frozen inside",
            "A set was frozen though it was strictly inside.",
            &monitors.frozen_inside,
            units::quantity,
        ),
        (
            "stuck at a border",
            "The arm stood still at a border short of its goal: a local minimum.",
            &monitors.stuck,
            |worst, unit| format!("{} short", units::quantity(worst, unit)),
        ),
        (
            "outside, announced",
            "A set was left, as the tick before had announced.",
            &monitors.went_outside,
            units::quantity,
        ),
        (
            "outside, unannounced",
            "A set was left without notice.",
            &monitors.unannounced,
            units::quantity,
        ),
        (
            "stood still",
            "No velocity would land inside every set, and the arm stood still.",
            &monitors.stood_still,
            |_, _| String::new(),
        ),
    ];
    let line = |(about, sentence, seen, worst): (_, _, &'a Sighting, Amount)| Line {
        about,
        sentence,
        seen,
        how_long: seconds(seen.for_s),
        worst: if seen.is_seen() {
            worst(seen.worst, of_task(seen))
        } else {
            String::new()
        },
    };
    words.into_iter().map(line).collect()
}

/// The monitor of the mode.
fn mode_changes(monitors: &Monitors) -> Line<'_> {
    Line {
        about: "mode changes",
        sentence: "The mode changed; the worst is how often within one second.",
        seen: &monitors.mode_changes,
        how_long: format!("{} times", monitors.mode_changes.ticks),
        worst: number(monitors.mode_changes.worst, 4),
    }
}

fn unit<'a>(summary: &'a Summary, seen: &Sighting) -> &'a str {
    let unit = seen
        .task
        .as_ref()
        .and_then(|task| summary.settings.units.get(task));
    unit.map_or("-", String::as_str)
}

/// The section of the page; nothing for a run of an earlier version.
pub fn section(run: &Run) -> String {
    let Some(monitors) = &run.summary().monitors else {
        return String::new();
    };
    let mut body = String::new();
    let lines = lines(run.summary(), monitors);
    for line in lines.into_iter().chain([mode_changes(monitors)]) {
        let verdict = match line.seen.verdict {
            Verdict::Never => "never",
            Verdict::Seen => "seen",
            Verdict::NotWatched => "not watched",
        };
        let at = line.seen.at_s.map_or_else(|| "–".to_owned(), moment);
        let task = line.seen.task.as_deref().unwrap_or("–");
        // Writing to a string cannot fail.
        let _ = writeln!(
            body,
            "<tr><th scope=\"row\">{}</th><td>{verdict}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td><td class=\"number\">{at}</td><td>{}</td></tr>",
            line.sentence,
            if line.seen.is_seen() {
                &line.how_long
            } else {
                "–"
            },
            if line.worst.is_empty() {
                "–"
            } else {
                &line.worst
            },
            Escaped(task),
        );
    }
    let columns = [
        ("Monitor", false),
        ("Verdict", false),
        ("For", true),
        ("Worst", true),
        ("When", true),
        ("Task", false),
    ];
    let joints = joints(run, &monitors.joints);
    table::section("What else was watched", &columns, &body, &joints)
}

/// Which joint's limits bound, and for how long.
fn joints(run: &Run, joints: &[JointMonitor]) -> String {
    let mut body = String::new();
    let time = |time: f64| {
        if time > 0.0 {
            seconds(time)
        } else {
            "–".to_owned()
        }
    };
    for joint in joints {
        let exceeded = &joint.acceleration_exceeded;
        let exceeded = match exceeded.at_s.filter(|_| exceeded.is_seen()) {
            Some(at_s) => format!("{} times at {}", number(exceeded.worst, 3), seconds(at_s)),
            None => "–".to_owned(),
        };
        let _ = writeln!(
            body,
            "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td><td class=\"number\">{exceeded}</td>\
             <td class=\"number\">{}</td><td class=\"number\">{}</td></tr>",
            Escaped(&joint.joint),
            time(joint.position_limited_s),
            time(joint.speed_limited_s),
            time(joint.acceleration_limited_s),
            number(joint.fastest, 3),
            number(joint.hardest, 3),
        );
    }
    let fastest = format!("Fastest [{}]", run.joint_unit("/s"));
    let hardest = format!("Hardest [{}]", run.joint_unit("/s²"));
    let columns = [
        ("Joint", false),
        ("Position", true),
        ("Speed", true),
        ("Acceleration", true),
        ("Exceeded for a set", true),
        (&fastest, true),
        (&hardest, true),
    ];
    let table = table::table(&columns, &body);
    format!(
        "<h3>Limits of the joints: for how long they bound</h3>\n{table}<p class=\"note\">Exceeded for a \
         set: how many times its limit a joint accelerated, because a set could not have been kept \
         otherwise. Fastest, hardest: greatest speed and acceleration of the run.</p>\n"
    )
}
