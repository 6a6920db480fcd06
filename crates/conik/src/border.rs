//! What each set-based task is held to: its bounds or, while it has never been inside, its best value.
//!
//! A set counts as *entered* once a sample was inside, and for ever after: where it is now does not
//! matter. (Deciding by where it is now would let a set that was left by a nanometre count as one
//! that started outside, and drift.)

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::cone::Interval;
use crate::evaluation::Evaluation;
use crate::settings::{Border, Settings};
use crate::sides::{Held, Side};
use crate::stack::{BoundRates, Goal, Stack};
use crate::task_id::TaskId;

/// With border `Land`, sets are held this far inside their bounds [task's unit], so that a tangential
/// step has room to bend towards the bound without crossing it.
pub(crate) const MARGIN: f64 = 1e-7;

#[derive(Debug)]
pub(crate) struct Borders {
    border: Border,
    period: f64,
    holds: Vec<Hold>,
    /// The bounds in force for each task: now, and at the end of the period. All values for an
    /// equality task.
    intervals: Vec<Interval>,
    next: Vec<Interval>,
    /// How fast they move.
    rates: Vec<BoundRates>,
    /// Number of sets above the first equality task, and the other sets.
    high_priority: usize,
    low_priority: Vec<TaskId>,
    /// Whether standing still keeps every set, and none is to recover.
    at_ease: bool,
    /// The revision of the sets in which no bound moved, nor, with `Freeze`, recovered, and with `Land`
    /// all had entered. Until the next, the bounds in force stay what they are.
    settled: Option<u64>,
}

/// What is known of one set.
#[derive(Clone, Copy, Debug)]
struct Hold {
    entered: bool,
    /// How far outside the lower and the upper bound it may be: nothing once it has entered, its best
    /// so far until then.
    leeway: [f64; 2],
}

impl Borders {
    pub(crate) fn new(settings: &Settings, stack: &Stack) -> Self {
        let unbounded = Interval {
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
        };
        let sets = stack.iter().filter(|(_, level)| level.interval().is_some());
        let unknown = Hold {
            entered: false,
            leeway: [f64::INFINITY; 2],
        };
        Self {
            border: settings.border,
            period: 1.0 / settings.rate_hz,
            holds: alloc::vec![unknown; stack.len()],
            intervals: alloc::vec![unbounded; stack.len()],
            next: alloc::vec![unbounded; stack.len()],
            rates: alloc::vec![BoundRates::default(); stack.len()],
            high_priority: stack.high_priority_sets().count(),
            low_priority: sets
                .map(|(id, _)| id)
                .filter(|&id| !stack.is_high_priority(id))
                .collect(),
            at_ease: true,
            settled: None,
        }
    }

    /// Takes in the values at the configuration in which the robot now is.
    pub(crate) fn observe(&mut self, stack: &Stack, evaluation: &Evaluation) {
        self.at_ease = true;
        let is_settled = self.settled == Some(stack.set_revision());
        if is_settled && !evaluation.is_any_drifting() && self.all_are_inside(evaluation) {
            return;
        }
        let mut is_settled = true;
        for (id, level) in stack.iter() {
            let &Goal::Set {
                interval: set,
                rates,
                recovery,
                ..
            } = level.goal()
            else {
                continue;
            };
            let sigma = evaluation.scalar(id);
            let hold = &mut self.holds[id.index()];
            hold.entered |= set.contains(sigma);
            let mut interval = set;
            if self.border == Border::Land && !hold.entered {
                hold.leeway = [
                    least_leeway(hold.leeway[0], set.min - sigma),
                    least_leeway(hold.leeway[1], sigma - set.max),
                ];
                interval.min -= hold.leeway[0];
                interval.max += hold.leeway[1];
            }
            let is_still = rates == BoundRates::default();
            is_settled &= is_still
                && match self.border {
                    Border::Freeze => recovery.is_none(),
                    Border::Land => hold.entered,
                };
            self.at_ease &= is_still
                && evaluation.drift(id) == 0.0
                && (recovery.is_none() || set.contains(sigma))
                && (self.border == Border::Freeze || interval.contains(sigma));
            self.intervals[id.index()] = interval;
            self.next[id.index()] = Interval {
                min: interval.min + self.period * rates.min,
                max: interval.max + self.period * rates.max,
            };
            self.rates[id.index()] = rates;
        }
        self.settled = is_settled.then_some(stack.set_revision());
    }

    /// Whether every set is within its bounds in force, where that matters.
    fn all_are_inside(&self, evaluation: &Evaluation) -> bool {
        if self.border == Border::Freeze {
            return true;
        }
        let is_inside = |&task: &TaskId| self.interval(task).contains(evaluation.scalar(task));
        are_within(&self.intervals, evaluation.scalars(self.high_priority))
            && self.low_priority.iter().all(is_inside)
    }

    /// Whether every high-priority set is within its bounds in force at the end of the period, with the
    /// values of then.
    pub(crate) fn all_will_be_inside(&self, at_end: &Evaluation) -> bool {
        are_within(&self.next, at_end.scalars(self.high_priority))
    }

    /// Whether standing still keeps every set, and none is to recover.
    pub(crate) fn are_at_ease(&self) -> bool {
        self.at_ease
    }

    /// T [s].
    pub(crate) fn period(&self) -> f64 {
        self.period
    }

    /// The bounds in force for a set-based task.
    #[inline]
    pub(crate) fn interval(&self, task: TaskId) -> &Interval {
        &self.intervals[task.index()]
    }

    /// The bounds in force at the end of the period.
    #[inline]
    pub(crate) fn next_interval(&self, task: TaskId) -> &Interval {
        &self.next[task.index()]
    }

    /// How fast the bound of a side moves [unit/s].
    #[inline]
    pub(crate) fn bound_rate(&self, side: Side) -> f64 {
        let BoundRates { min, max } = self.rates[side.task.index()];
        if side.is_upper { max } else { min }
    }

    /// Whether the bounds in force will stay what they are; with `Land`, they are the sets.
    pub(crate) fn are_settled(&self) -> bool {
        self.settled.is_some()
    }

    /// Number of sets above the first equality task.
    pub(crate) fn high_priority(&self) -> usize {
        self.high_priority
    }

    /// The bounds in force for every task.
    pub(crate) fn intervals(&self) -> &[Interval] {
        &self.intervals
    }

    /// The sides at whose border, or outside of which, a value is.
    pub(crate) fn sides_at(&self, task: TaskId, sigma: f64) -> impl Iterator<Item = Side> {
        let set = self.with_band(task);
        [(false, sigma <= set.min), (true, sigma >= set.max)]
            .into_iter()
            .filter(|(_, is_at)| *is_at)
            .map(move |(is_upper, _)| Side { task, is_upper })
    }

    /// The tangent cone of the bounds in force, which may themselves move: the rates [unit/s] at which a
    /// task at `sigma` stays or comes closer. All rates, unless the value is on the border or outside. A
    /// set that is held a margin inside counts as on its border there.
    #[inline]
    pub(crate) fn tangent_cone(&self, task: TaskId, sigma: f64) -> Interval {
        let (set, rates) = (self.with_band(task), self.rates[task.index()]);
        let is_at = |is_at: bool, rate: f64, otherwise: f64| if is_at { rate } else { otherwise };
        Interval {
            min: is_at(sigma <= set.min, rates.min, f64::NEG_INFINITY),
            max: is_at(sigma >= set.max, rates.max, f64::INFINITY),
        }
    }

    /// Whether a value is on the border or outside.
    #[inline]
    pub(crate) fn is_at_border(&self, task: TaskId, sigma: f64) -> bool {
        let set = self.with_band(task);
        sigma <= set.min || sigma >= set.max
    }

    /// Sides of the active sets at whose border they now are.
    pub(crate) fn held(&self, stack: &Stack, active: &ActiveSet, evaluation: &Evaluation) -> Held {
        let mut held = Held::default();
        for task in active.iter().filter(|&task| stack.is_high_priority(task)) {
            for side in self.sides_at(task, evaluation.scalar(task)) {
                held.insert(side);
            }
        }
        held
    }

    #[inline]
    fn with_band(&self, task: TaskId) -> Interval {
        let (set, band) = (self.interval(task), self.band());
        Interval {
            min: set.min + band,
            max: set.max - band,
        }
    }

    #[inline]
    fn band(&self) -> f64 {
        match self.border {
            Border::Freeze => 0.0,
            Border::Land => 2.0 * MARGIN,
        }
    }
}

/// Whether each value is in its interval, found out without a branch for each.
fn are_within(intervals: &[Interval], values: &[f64]) -> bool {
    let sets = intervals.iter().zip(values);
    sets.fold(true, |all, (set, sigma)| all & set.contains(*sigma))
}

/// A bound that jumped moved by more than this; what is less is rounding [task's unit].
const JUMP: f64 = 1e-3 * MARGIN;

/// The leeway follows what is gained only by more than this [task's unit]. Following every gain, two sets
/// that pull apart would soon leave no room between them, and the arm would stand still.
const GAIN: f64 = 2.0 * MARGIN;

/// The leeway of a side that is `outside` by so much now. The slack of a margin is given once and never
/// grows; only a bound that jumped away from the task gives it a new start.
fn least_leeway(best: f64, outside: f64) -> f64 {
    let now = (outside + MARGIN).max(0.0);
    if outside > best + JUMP || now == 0.0 || best - now > GAIN {
        now
    } else {
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leeway_grows_for_a_jump_and_not_for_rounding() {
        let best = least_leeway(f64::INFINITY, 0.3);
        assert_eq!(best, 0.3 + MARGIN);
        assert_eq!(least_leeway(best, 0.2), 0.2 + MARGIN);
        assert_eq!(least_leeway(best, best), best, "at the bound in force");
        assert_eq!(least_leeway(best, best + 1e-16), best);
        assert_eq!(least_leeway(best, 0.4), 0.4 + MARGIN);
        assert_eq!(least_leeway(best, -1.0), 0.0);
    }
}
