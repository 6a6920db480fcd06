//! Sets so far inside that their values need not be known: where the arm is now, a bound of them will do.
//!
//! A value changes by at most steepness · Σ|Δqᵢ| ([`Task::steepness`](crate::Task::steepness)). So a set
//! that was measured σ₀ when the arm had travelled s₀, in Σ|Δqᵢ| from configuration to configuration, has
//! at least σ₀ − steepness · (s − s₀) now that it has travelled s. While no velocity that the tick may look
//! at can take that to its least value, neither value nor Jacobian is computed. Nothing decides otherwise
//! for it: what the bound leaves open is measured (`Barrier::covers`, `Landing::correct`).
//!
//! Only tasks that are [costly](crate::Task::is_costly) are watched, in high-priority sets with a least
//! value alone, and only where the controller was told to
//! ([`Controller::measure_on_demand`](crate::Controller::measure_on_demand)).

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::barrier::NEAR;
use crate::border::MARGIN;
use crate::kinematics::Kinematics;
use crate::stack::{BoundRates, Goal, Stack};
use crate::task_id::TaskId;
use crate::task_vectors::TaskVectors;

/// Bounds are taken lower by this share of the way, for the rounding of sums.
const SLACK: f64 = 1e-6;

/// What each change of configuration adds for rounding [rad]: more than the last place of `LONGEST`.
const ROUNDING: f64 = 1e-12;

/// After so long a way [rad] everything is measured again, so that its last place stays small.
const LONGEST: f64 = 1e3;

/// Where less is left [task's unit], or a joint moves the value by less [task's unit/rad], a bound is lost
/// in rounding.
const LEAST_WAY: f64 = 1e-5;
const LEAST_STEEPNESS: f64 = 1e-3;

#[derive(Debug)]
pub(crate) struct Watch {
    list: Vec<TaskId>,
    /// Of each task of the stack.
    known: Vec<Known>,
    /// How far the arm has travelled [rad].
    travelled: f64,
    /// How far no tick looks [rad].
    out_of_sight: f64,
    /// The tasks of which a bound alone is known in the present configuration.
    bounded: ActiveSet,
    set_revision: Option<u64>,
}

/// What is known of a watched set.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// Its value when it was measured last, and how far the arm had travelled.
    measured: Option<(f64, f64)>,
    steepness: f64,
    /// Its least value with the margin; infinite if it must be measured anywhere.
    floor: f64,
    /// How far the arm must have travelled before it can be there [rad].
    limit: f64,
    /// Of which parameters of the task that is true.
    revision: u64,
}

const NOTHING: Known = Known {
    measured: None,
    steepness: f64::INFINITY,
    floor: f64::INFINITY,
    limit: f64::NEG_INFINITY,
    revision: 0,
};

impl Known {
    fn find_limit(&mut self) {
        self.limit = match self.measured {
            Some((value, travelled)) if self.floor.is_finite() => {
                travelled + (value - self.floor) / self.steepness * (1.0 - SLACK)
            }
            _ => f64::NEG_INFINITY,
        };
    }
}

impl Watch {
    pub(crate) fn new(stack: &Stack, period: f64) -> Self {
        Self {
            list: Vec::with_capacity(stack.len()),
            known: alloc::vec![NOTHING; stack.len()],
            travelled: 0.0,
            out_of_sight: NEAR * period * (1.0 + SLACK),
            bounded: ActiveSet::EMPTY,
            set_revision: None,
        }
    }

    /// Before the tasks are [offered](Self::takes) anew.
    pub(crate) fn clear(&mut self) {
        self.list.clear();
        self.bounded = ActiveSet::EMPTY;
        self.set_revision = None;
    }

    /// Whether a task that stands still is watched from now on.
    pub(crate) fn takes(&mut self, stack: &Stack, task: TaskId, steepness: f64) -> bool {
        let is_watched =
            stack.is_high_priority(task) && stack[task].task().is_costly() && steepness.is_finite();
        if is_watched {
            let (known, revision) = (&mut self.known[task.index()], stack[task].revision());
            if known.revision != revision || known.steepness.to_bits() != steepness.to_bits() {
                *known = Known {
                    steepness: steepness.max(LEAST_STEEPNESS),
                    revision,
                    ..NOTHING
                };
            }
            self.list.push(task);
        }
        is_watched
    }

    /// The arm goes from one configuration to another.
    pub(crate) fn travel(&mut self, from: &[f64], to: &[f64]) {
        let way: f64 = from
            .iter()
            .zip(to)
            .map(|(from, to)| (to - from).abs())
            .sum();
        self.travelled += way + ROUNDING;
        if !(self.travelled < LONGEST) {
            self.travelled = 0.0;
            for known in &mut self.known {
                known.measured = None;
                known.find_limit();
            }
        }
    }

    /// Whether the sets that are watched may have changed since they were looked at.
    pub(crate) fn is_stale(&self, stack: &Stack) -> bool {
        self.set_revision != Some(stack.set_revision())
    }

    /// The value of each watched set at a configuration, or a bound of it where that will do.
    pub(crate) fn look(
        &mut self,
        stack: &Stack,
        kinematics: &Kinematics,
        values: &mut TaskVectors,
    ) {
        self.bounded = ActiveSet::EMPTY;
        if self.is_stale(stack) {
            self.find_floors(stack);
        }
        for &task in &self.list {
            let known = &mut self.known[task.index()];
            let left = known.limit - self.travelled;
            let way = left * known.steepness;
            if left > self.out_of_sight && way > LEAST_WAY {
                values.of_mut(task)[0] = known.floor + way;
                self.bounded.insert(task);
            } else {
                let value = values.of_mut(task);
                stack[task].task().value(kinematics, value);
                known.measured = Some((value[0], self.travelled));
                known.find_limit();
            }
        }
    }

    /// Measures what a bound alone was known of; the tasks of which that was so.
    pub(crate) fn measure(
        &mut self,
        stack: &Stack,
        kinematics: &Kinematics,
        values: &mut TaskVectors,
    ) -> ActiveSet {
        let bounded = core::mem::take(&mut self.bounded);
        for task in bounded.iter() {
            let (known, value) = (&mut self.known[task.index()], values.of_mut(task));
            stack[task].task().value(kinematics, value);
            known.measured = Some((value[0], self.travelled));
            known.find_limit();
        }
        bounded
    }

    /// The tasks of which a bound alone is known.
    pub(crate) fn bounded(&self) -> &ActiveSet {
        &self.bounded
    }

    #[cold]
    fn find_floors(&mut self, stack: &Stack) {
        self.set_revision = Some(stack.set_revision());
        for &task in &self.list {
            let known = &mut self.known[task.index()];
            known.floor = match stack[task].goal() {
                Goal::Set {
                    interval,
                    rates,
                    recovery: None,
                    ..
                } if interval.max == f64::INFINITY
                    && *rates == BoundRates::default()
                    && interval.min.abs() < LONGEST =>
                {
                    interval.min + MARGIN
                }
                _ => f64::INFINITY,
            };
            known.find_limit();
        }
    }
}
