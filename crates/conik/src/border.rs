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
    /// Whether standing still keeps every set, and none is to recover.
    at_ease: bool,
}

/// What one task is held to.
#[derive(Clone, Copy, Debug)]
struct Hold {
    entered: bool,
    /// How far outside the lower and the upper bound it may be: nothing once it has entered, its best
    /// so far until then.
    leeway: [f64; 2],
    /// The bounds in force. All values for an equality task.
    interval: Interval,
    /// How fast they move.
    rates: BoundRates,
}

impl Borders {
    pub(crate) fn new(settings: &Settings, stack: &Stack) -> Self {
        let unbounded = Interval {
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
        };
        Self {
            at_ease: true,
            border: settings.border,
            period: 1.0 / settings.rate_hz,
            holds: alloc::vec![
                Hold {
                    entered: false,
                    leeway: [f64::INFINITY; 2],
                    interval: unbounded,
                    rates: BoundRates::default(),
                };
                stack.len()
            ],
        }
    }

    /// Takes in the values at the configuration in which the robot now is.
    pub(crate) fn observe(&mut self, stack: &Stack, evaluation: &Evaluation) {
        self.at_ease = true;
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
            hold.rates = rates;
            hold.interval = set;
            if self.border == Border::Land && !hold.entered {
                hold.leeway = [
                    least_leeway(hold.leeway[0], set.min - sigma),
                    least_leeway(hold.leeway[1], sigma - set.max),
                ];
                hold.interval.min -= hold.leeway[0];
                hold.interval.max += hold.leeway[1];
            }
            self.at_ease &= rates == BoundRates::default()
                && evaluation.drift(id) == 0.0
                && (recovery.is_none() || set.contains(sigma))
                && (self.border == Border::Freeze || hold.interval.contains(sigma));
        }
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
        &self.holds[task.index()].interval
    }

    /// The bounds in force at the end of the period.
    #[inline]
    pub(crate) fn next_interval(&self, task: TaskId) -> Interval {
        let Hold {
            interval, rates, ..
        } = self.holds[task.index()];
        Interval {
            min: interval.min + self.period * rates.min,
            max: interval.max + self.period * rates.max,
        }
    }

    /// How fast the bound of a side moves [unit/s].
    #[inline]
    pub(crate) fn bound_rate(&self, side: Side) -> f64 {
        let BoundRates { min, max } = self.holds[side.task.index()].rates;
        if side.is_upper { max } else { min }
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
        let (set, rates) = (self.with_band(task), self.holds[task.index()].rates);
        let is_at = |is_at: bool, rate: f64, otherwise: f64| if is_at { rate } else { otherwise };
        Interval {
            min: is_at(sigma <= set.min, rates.min, f64::NEG_INFINITY),
            max: is_at(sigma >= set.max, rates.max, f64::INFINITY),
        }
    }

    /// Whether a value is on the border or outside.
    pub(crate) fn is_at_border(&self, task: TaskId, sigma: f64) -> bool {
        self.sides_at(task, sigma).next().is_some()
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
