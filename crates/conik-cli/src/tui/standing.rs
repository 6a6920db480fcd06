//! How a task stands in one tick, and why, in plain words: those of the page.

use conik_sim::record::Record;

use super::scene::{Role, SceneTask};
use crate::report::units::quantity;

/// Nearer than this to a border is on it [task's unit], as in the summary's properties.
const TOLERANCE: f64 = 1e-6;

/// How a task stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Standing {
    pub(super) state: State,
    /// A word or two.
    pub(super) short: String,
    /// A sentence or two; may be empty.
    pub(super) long: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// An active set of high priority.
    Held,
    /// An active set of low priority.
    Driven,
    /// A set that is not active, and not inside.
    Outside,
    Inside,
    Equality,
}

impl State {
    /// What tells it from the others without colour.
    pub(super) fn mark(self) -> char {
        match self {
            Self::Held => '■',
            Self::Driven => '▲',
            Self::Outside => '!',
            Self::Inside => '·',
            Self::Equality => '→',
        }
    }
}

/// How far inside its interval a value is; negative outside; `None` of an equality task.
pub(super) fn inside(task: &SceneTask, value: f64) -> Option<f64> {
    let set = task.interval?;
    Some((value - set.min).min(set.max - value))
}

/// How a task stands whose value, or error, is this.
pub(super) fn standing(task: &SceneTask, record: &Record, value: f64) -> Standing {
    match inside(task, value) {
        Some(margin) => of_set(task, record, value, margin),
        None => of_equality(task, record, value),
    }
}

fn says(record: &Record, word: &str, task: &SceneTask) -> bool {
    let mut reasons = record.reasons.iter();
    reasons.any(|reason| reason.word() == word && reason.task() == Some(task.id))
}

fn of_set(task: &SceneTask, record: &Record, value: f64, margin: f64) -> Standing {
    let amount = quantity(margin.abs(), task.unit);
    let is_low = task.role == Role::LowPrioritySet;
    let is_out = margin < -TOLERANCE;
    let is_active = record.active.contains(task.id);
    let (state, short, mut long) = if is_active && says(record, "hold-inside", task) {
        let long = format!(
            "Frozen {amount} inside its set: the rule found that this stops another set from being left."
        );
        (State::Held, "HELD inside".to_owned(), long)
    } else if is_active && is_low {
        let short = if is_out { "driven back" } else { "driven" };
        let long = "Driven back to its border, as well as the tasks above leave room.";
        (State::Driven, short.to_owned(), long.to_owned())
    } else if is_active && is_out {
        let (short, moving) = if task.recovers {
            ("HELD, brought in", "brought back in")
        } else {
            ("HELD outside", "kept from getting worse")
        };
        let long = format!("Outside by {amount}, and {moving}.");
        (State::Held, short.to_owned(), long)
    } else if is_active {
        let is_least = task.interval.is_some_and(|set| value - set.min <= margin);
        let side = if is_least { "least" } else { "greatest" };
        let long =
            format!("Held at its {side} allowed value. Let go, the tasks below would push it out.");
        (State::Held, format!("HELD at {side}"), long)
    } else if is_out {
        let long = if is_low {
            format!("Outside by {amount}. Low priority: the tasks above come first.")
        } else {
            format!("Outside by {amount}, and coming in.")
        };
        (State::Outside, format!("OUTSIDE by {amount}"), long)
    } else {
        let long = if says(record, "free", task) {
            "Just let go: it moves inward by itself."
        } else {
            ""
        };
        (
            State::Inside,
            format!("inside by {amount}"),
            long.to_owned(),
        )
    };
    if says(record, "outside", task) {
        long +=
            " It will be outside at the next tick: no velocity within the limits keeps every set.";
    }
    Standing { state, short, long }
}

fn of_equality(task: &SceneTask, record: &Record, error: f64) -> Standing {
    let is_there = !task.follows && error < arrived_below(task.unit);
    let short = match (task.follows, is_there) {
        (true, _) => "follows",
        (false, true) => "there",
        (false, false) => "on its way",
    };
    let mut long = Vec::new();
    if task.follows {
        long.push("Follows a speed.");
    } else if !is_there && !record.active.is_empty() {
        long.push("It gets what freedom the active sets leave.");
    }
    if says(record, "rank", task) {
        long.push("Slowed where a singularity, or a task above, leaves it no direction.");
    }
    Standing {
        state: State::Equality,
        short: short.to_owned(),
        long: long.join(" "),
    }
}

/// Nearer than this an equality task is there [task's unit].
fn arrived_below(unit: &str) -> f64 {
    if unit == "rad" { 1e-3 } else { 5e-4 }
}
