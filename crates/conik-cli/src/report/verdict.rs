//! The verdict in a sentence: what was run, on which arm, how it ended, what was reached when.

use conik_sim::summary::{ChangeMade, Outcome};

use crate::figure::Run;
use crate::figure::lettering::{number, seconds};
use crate::figure::markup::Escaped;

/// More arrivals than this are counted, not listed.
const MOST_LISTED: usize = 8;

/// The verdict as a box of the page; a run that ended early stands out.
pub fn banner(run: &Run) -> String {
    let summary = run.summary();
    let class = match summary.outcome {
        Outcome::Completed => "good",
        _ => "bad",
    };
    let mut notes = match &summary.outcome {
        Outcome::Fault { detail, .. } => format!("<p>{}</p>\n", Escaped(detail)),
        Outcome::Running => "<p>The program was killed, or is still running: what became of the \
             tasks and of the properties was not written.</p>\n"
            .to_owned(),
        Outcome::Completed | Outcome::Interrupted => String::new(),
    };
    notes.push_str(&changes(&summary.changes));
    if run.log().is_truncated() {
        notes.push_str("<p>The last line of the log was cut off and is left out.</p>\n");
    }
    format!(
        "<div class=\"verdict {class}\" role=\"status\">\n<p>{}</p>\n{notes}</div>\n",
        sentence(run)
    )
}

/// That people changed the run, if they did.
fn changes(changes: &[ChangeMade]) -> String {
    let Some(first) = changes.iter().find_map(|change| change.t_s) else {
        return String::new();
    };
    let times = match changes.len() {
        1 => "once".to_owned(),
        times => format!("{times} times, at first"),
    };
    format!(
        "<p>What was asked was changed {times} at {}, by people who watched. Figures and tables have tasks \
         and obstacles as they were before; <code>conik view</code> shows them as they were at each \
         time.</p>\n",
        seconds(first)
    )
}

fn sentence(run: &Run) -> String {
    let summary = run.summary();
    let settings = &summary.settings;
    let control = &settings.scenario.control;
    let arm = match settings.robot.as_str() {
        "ideal" => "an ideal arm (q = q_ref)".to_owned(),
        "emulator" => "the emulated arm".to_owned(),
        host => format!("the arm at {}", Escaped(host)),
    };
    let end = match &summary.outcome {
        Outcome::Completed => "<strong>Completed</strong>".to_owned(),
        Outcome::Interrupted => "<strong>Interrupted</strong>".to_owned(),
        Outcome::Running => "<strong>Cut off</strong>".to_owned(),
        Outcome::Fault { name, .. } => {
            format!("<strong>Stopped by a fault ({})</strong>", Escaped(name))
        }
    };
    let arrivals = match &summary.outcome {
        Outcome::Running => String::new(),
        _ => waypoints(&summary.waypoints_reached_s),
    };
    format!(
        "{end} after {} of {} on {arm}, robot {}, at {} Hz. {arrivals}",
        seconds(summary.ended_at_s),
        seconds(control.duration_s),
        Escaped(settings.scenario.robot.label()),
        number(control.rate_hz, 4),
    )
}

fn waypoints(reached: &[Option<f64>]) -> String {
    let count = reached.iter().flatten().count();
    let last = reached.iter().flatten().copied().fold(0.0, f64::max);
    match (reached.len(), count) {
        (0, _) => "The scenario has no waypoints.".to_owned(),
        (all, 0) => format!("None of the {all} waypoints was reached."),
        (all, count) if all > MOST_LISTED => {
            format!(
                "{count} of {all} waypoints reached, the last of these at {}.",
                seconds(last)
            )
        }
        _ => {
            let each = reached.iter().enumerate().map(|(nth, t_s)| match t_s {
                Some(t_s) => format!("waypoint {} reached at {}", nth + 1, seconds(*t_s)),
                None => format!("waypoint {} not reached", nth + 1),
            });
            let mut text = each.collect::<Vec<_>>().join(", ");
            text.replace_range(..1, "W");
            text.push('.');
            text
        }
    }
}
