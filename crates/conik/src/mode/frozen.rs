//! How a frozen set is to move.

use crate::border::Borders;
use crate::evaluation::Evaluation;
use crate::sides::Side;
use crate::stack::{Goal, Stack};
use crate::task_id::TaskId;

/// J q̇ of a frozen set: zero, but for a bound or a task that moves by itself, and for a set that
/// recovers from outside.
pub(super) fn frozen_rate(
    stack: &Stack,
    borders: &Borders,
    evaluation: &Evaluation,
    task: TaskId,
) -> f64 {
    if borders.are_at_ease() {
        return 0.0;
    }
    let sigma = evaluation.scalar(task);
    let border = borders.sides_at(task, sigma).next();
    let bound_rate = border.map_or(0.0, |side| {
        let recovery = recovery(stack, borders.period(), side, sigma);
        borders.bound_rate(side) + side.inward(recovery)
    });
    bound_rate - evaluation.drift(task)
}

/// How fast a frozen set is to come back to a side that it is outside of.
fn recovery(stack: &Stack, period: f64, side: Side, sigma: f64) -> f64 {
    match stack[side.task].goal() {
        Goal::Set {
            interval,
            recovery: Some(speed),
            ..
        } => {
            let outside = -side.inside(interval, sigma);
            speed.min(outside.max(0.0) / period)
        }
        _ => 0.0,
    }
}
