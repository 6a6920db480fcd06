//! What a level asks for: the rate σ̇_ref of its task.
//!
//! An equality task asks for σ̇_des + Λ (σ_des − σ) − ∂σ/∂t. A low-priority set asks only where the levels
//! above do not keep it: inside, to stop at the border; outside, to come back with its gain. It does
//! not cease to ask as soon as the levels above happen to do so: they may do it by turns.

use alloc::vec::Vec;

use super::nearest::NearestTick;
use crate::linalg::dot;
use crate::sides::{Held, Side};
use crate::stack::Goal;
use crate::task_id::TaskId;

/// A low-priority set that asks ceases to when the levels above bring it inward faster than it asks by
/// this [unit/s]: its rate trembles with what holds them.
const RELEASE: f64 = 1e-4;

/// Whether a level asks for anything.
pub(super) enum Asks {
    /// An equality task, always.
    Always,
    /// A low-priority set at a side that would otherwise be left at this rate [unit/s]; 0 for one that
    /// is outside and would not get further.
    At { side: Side, leaving: f64 },
    /// A low-priority set that is kept: its sides bind the levels below.
    Nothing,
}

/// What the levels above have chosen.
pub(super) struct Above<'a> {
    /// Their velocity, where accelerations are limited without regard to that [rad/s].
    pub(super) velocity: &'a [f64],
    /// What it is within the joints' ranges; `None` if it is the same.
    pub(super) within: Option<&'a [f64]>,
}

#[derive(Debug)]
pub(super) struct Asked {
    rates: Vec<f64>,
    period: f64,
}

impl Asked {
    pub(super) fn new(max_rows: usize, period: f64) -> Self {
        Self {
            rates: Vec::with_capacity(max_rows),
            period,
        }
    }

    /// σ̇_ref of the level asked last, one entry per component [task's unit/s].
    pub(super) fn rates(&self) -> &[f64] {
        &self.rates
    }

    /// What a level asks for after the levels above. `held` are the sides that were held in the last tick.
    pub(super) fn ask(
        &mut self,
        tick: &mut NearestTick<'_>,
        task: TaskId,
        above: &Above<'_>,
        held: &Held,
    ) -> Asks {
        self.rates.clear();
        match tick.stack[task].goal() {
            Goal::Equality {
                desired_rate, gain, ..
            } => {
                let errors = tick.evaluation.errors().of(task);
                let drifts = tick.evaluation.drifts().of(task);
                let components = errors.iter().zip(desired_rate).zip(drifts);
                self.rates
                    .extend(components.map(|((error, rate), drift)| rate + gain * error - drift));
                Asks::Always
            }
            Goal::Set { .. } => self.ask_of_set(tick, task, above, held),
        }
    }

    fn ask_of_set(
        &mut self,
        tick: &mut NearestTick<'_>,
        task: TaskId,
        above: &Above<'_>,
        held: &Held,
    ) -> Asks {
        let Goal::Set { interval, gain, .. } = tick.stack[task].goal() else {
            return Asks::Nothing;
        };
        let (sigma, drift) = (tick.evaluation.scalar(task), tick.evaluation.drift(task));
        let row = tick.evaluation.jacobian(tick.stack, task);
        let rate = dot(row, above.velocity);
        let rate_within = above.within.map_or(rate, |within| dot(row, within));
        for side in Side::both(task) {
            let (inside, rate) = (side.inside(interval, sigma), side.inward(rate));
            let approaching = side.inward(tick.borders.bound_rate(side) - drift);
            let kept = approaching - inside.max(0.0) / self.period;
            // `Stack` insists on the gain.
            let asked = kept + gain.unwrap_or(0.0) * (-inside).max(0.0);
            let needed = if held.contains(side) {
                asked + RELEASE
            } else {
                kept
            };
            if rate < needed {
                self.rates.push(side.inward(asked));
                let leaving = (kept - rate).max(0.0);
                return Asks::At { side, leaving };
            }
            if kept > f64::NEG_INFINITY {
                let had = rate.min(side.inward(rate_within));
                tick.barrier
                    .push(tick.stack, tick.evaluation, side, kept.min(had));
            }
        }
        Asks::Nothing
    }
}
