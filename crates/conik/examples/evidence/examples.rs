//! The paper's three examples under every combination, from four starts, at two rates.

use crate::combo::Combo;
use crate::course::{Course, bench, course, deadlock};
use crate::paper::{fitted, thesis};

/// A name, where the run starts [rad], and for how long it goes [s].
type Start = (&'static str, fn() -> [f64; 6], u32);

const STARTS: [Start; 4] = [
    ("thesis", thesis, 60),
    ("fitted", fitted, 60),
    ("bench", bench, 70),
    ("deadlock", deadlock, 80),
];

pub fn print(combos: &[Combo]) {
    let columns = [
        "example",
        "start",
        "combination",
        "rate [Hz]",
        "mode changes",
        "at rest",
        "outside, distance [m]",
        "view [-]",
        "waypoint 1 [s]",
        "waypoint 2 [s]",
        "last error [m]",
        "speed [rad/s]",
        "acceleration [rad/s²]",
    ];
    println!("| {} |", columns.join(" | "));
    println!("|---:|---|---|{}", "---:|".repeat(columns.len() - 3));
    for number in 1..=3 {
        for (start, q0, duration_s) in STARTS {
            for combo in combos {
                for rate_hz in [125.0, 500.0] {
                    let settings = combo.settings(rate_hz);
                    let course = course(number, q0(), settings, f64::from(duration_s));
                    println!(
                        "| {number} | {start} | `{combo}` | {rate_hz} | {} |",
                        cells(&course).join(" | ")
                    );
                }
            }
        }
    }
}

fn cells(course: &Course) -> Vec<String> {
    let outside = |worst: f64| match worst {
        worst if worst == f64::NEG_INFINITY => "-".into(),
        worst if worst <= crate::table::ROUNDING => "0".into(),
        worst => format!("{worst:.1e}"),
    };
    let time = |at: Option<f64>| at.map_or("never".into(), |t| format!("{t:.3}"));
    vec![
        course.mode_changes.to_string(),
        course.changes_at_rest.to_string(),
        outside(course.outside),
        outside(course.outside_view),
        time(course.waypoints_s[0]),
        time(course.waypoints_s[1]),
        format!("{:.1e}", course.last_error),
        format!("{:.2}", course.peak_speed),
        format!("{:.1}", course.peak_acceleration),
    ]
}
