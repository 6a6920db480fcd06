//! What each set-based task is held to: its bounds or, while it has never been inside, its best value.
//!
//! A set counts as *entered* once a sample was inside, and for ever after: where it is now does not
//! matter. (Deciding by where it is now would let a set that was left by a nanometre count as one
//! that started outside, and drift.)

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::cone::Interval;
use crate::evaluation::Evaluation;
use crate::settings::Border;
use crate::sides::{Held, Side};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// With border `Land`, sets are held this far inside their bounds [task's unit], so that a tangential
/// step has room to bend towards the bound without crossing it.
pub(crate) const MARGIN: f64 = 1e-7;

/// A set not yet entered is held at a new best value once that is this far inside the last hold [task's
/// unit]. A margin below would follow every rounding.
const GAIN: f64 = 3.0 * MARGIN;

#[derive(Debug)]
pub(crate) struct Borders {
    border: Border,
    holds: Vec<Hold>,
}

/// What one task is held to.
#[derive(Clone, Copy, Debug)]
struct Hold {
    entered: bool,
    /// The bounds in force. Empty (∞, −∞) for an equality task.
    interval: Interval,
}

impl Borders {
    pub(crate) fn new(border: Border, stack: &Stack) -> Self {
        let unbounded = Interval {
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
        };
        Self {
            border,
            holds: alloc::vec![
                Hold {
                    entered: false,
                    interval: unbounded,
                };
                stack.len()
            ],
        }
    }

    /// Takes in the values at the configuration in which the robot now is.
    pub(crate) fn observe(&mut self, stack: &Stack, evaluation: &Evaluation) {
        for (id, level) in stack.iter() {
            let Some(&set) = level.interval() else {
                continue;
            };
            let sigma = evaluation.scalar(id);
            let hold = &mut self.holds[id.index()];
            hold.entered |= set.contains(sigma);
            if self.border == Border::Freeze || hold.entered {
                hold.interval = set;
            } else {
                // Not yet inside: the side that is exceeded is held at its best value so far. The
                // slack is given once, and never grows. Not every small gain is followed: two sets that
                // pull apart would soon leave no room between them, and the arm would stand still.
                let best = &mut hold.interval;
                if sigma - best.min > GAIN {
                    best.min = sigma - MARGIN;
                }
                if best.max - sigma > GAIN {
                    best.max = sigma + MARGIN;
                }
                best.min = best.min.min(set.min);
                best.max = best.max.max(set.max);
            }
        }
    }

    /// The bounds in force for a set-based task.
    #[inline]
    pub(crate) fn interval(&self, task: TaskId) -> &Interval {
        &self.holds[task.index()].interval
    }

    /// Whether a value is on the border or outside. A set that is held a margin inside counts as on
    /// its border there.
    #[inline]
    pub(crate) fn is_at_border(&self, task: TaskId, sigma: f64) -> bool {
        let (set, band) = (self.interval(task), self.band());
        sigma <= set.min + band || sigma >= set.max - band
    }

    /// `in_T_C` for the bounds in force.
    #[inline]
    pub(crate) fn tangent_cone_contains(&self, task: TaskId, sigma_dot: f64, sigma: f64) -> bool {
        let (set, band) = (self.interval(task), self.band());
        let widened = Interval {
            min: set.min + band,
            max: set.max - band,
        };
        widened.tangent_cone_contains(sigma_dot, sigma)
    }

    /// Sides of the active sets at whose border they now are.
    pub(crate) fn held(&self, stack: &Stack, active: &ActiveSet, evaluation: &Evaluation) -> Held {
        let mut held = Held::default();
        for task in active.iter().filter(|&task| stack.is_high_priority(task)) {
            let (set, sigma) = (self.interval(task), evaluation.scalar(task));
            for (is_upper, is_at) in [
                (false, sigma <= set.min + self.band()),
                (true, sigma >= set.max - self.band()),
            ] {
                if is_at {
                    held.insert(Side { task, is_upper });
                }
            }
        }
        held
    }

    #[inline]
    fn band(&self) -> f64 {
        match self.border {
            Border::Freeze => 0.0,
            Border::Land => 2.0 * MARGIN,
        }
    }
}
