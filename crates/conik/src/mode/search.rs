//! The choice of the mode: the first, fewest active sets first, that keeps every other set.
//!
//! The rule of Section IV of the paper: go through the modes from least to most restrictive, and
//! take the first in which every *inactive* set-based task passes the tangent-cone test
//! `in_T_C(J f, σ)`, f being the velocity of that mode. Active high-priority sets are frozen, so they
//! pass by construction; active low-priority ones are pushed to their border and are not tested.
//!
//! 2ⁿ modes are never looked at, and the answer is the same:
//!
//! * Only a set at or outside its border can fail the test, so only those are tested; while none is
//!   there, the first mode is the answer.
//! * A mode whose frozen rows depend on each other has the velocity of an earlier one, of which a
//!   basis of those rows is frozen: f depends on their span alone, and a released row of the span
//!   has J f = 0, which is in every cone. If the later mode were accepted, so would have been the
//!   earlier. So every subset with a dependent row is passed over together with its supersets, and
//!   no mode freezes more rows than there are joints.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::border::Borders;
use crate::cone::Interval;
use crate::evaluation::Evaluation;
use crate::hierarchy::Hierarchy;
use crate::linalg::dot;
use crate::settings::{ModeRule, Settings};
use crate::sides::Side;
use crate::stack::{Goal, Stack};
use crate::task_id::TaskId;

/// A task that changes slower than this [unit/s] counts as one that stands still: a frozen task
/// moves at the level of rounding, and the test must not see it leave.
const STILL: f64 = 1e-12;

#[derive(Debug)]
pub(crate) struct ModeSearch {
    hierarchy: Hierarchy,
    rule: ModeRule,
    sets: Vec<TaskId>,
    /// The sets above the first equality task.
    high_priority: ActiveSet,
    /// The sets of the mode at hand.
    active: ActiveSet,
    /// Sets that the rule allows to be active this tick, in list order.
    candidates: Vec<TaskId>,
    /// Sets at or outside their border this tick, with the rates J q̇ that their cones allow.
    at_border: Vec<(TaskId, Interval)>,
    /// How fast each task was left in the last mode that was refused for it [unit/s].
    leaving: Vec<f64>,
    evaluated: usize,
}

/// What one tick's search works on.
struct Tick<'a> {
    stack: &'a Stack,
    borders: &'a Borders,
    evaluation: &'a mut Evaluation,
    velocity: &'a mut [f64],
}

impl Tick<'_> {
    /// J q̇ of a frozen set: zero, but for a bound or a task that moves by itself, and for a set that
    /// recovers from outside.
    fn frozen_rate(&self, task: TaskId) -> f64 {
        if self.borders.are_at_ease() {
            return 0.0;
        }
        let sigma = self.evaluation.scalar(task);
        let border = self.borders.sides_at(task, sigma).next();
        let bound_rate = border.map_or(0.0, |side| {
            self.borders.bound_rate(side) + side.inward(self.recovery(task, side, sigma))
        });
        bound_rate - self.evaluation.drift(task)
    }

    /// How fast a frozen set is to come back to a side that it is outside of.
    fn recovery(&self, task: TaskId, side: Side, sigma: f64) -> f64 {
        match self.stack[task].goal() {
            Goal::Set {
                interval,
                recovery: Some(speed),
                ..
            } => {
                let outside = -side.inside(interval, sigma);
                speed.min(outside.max(0.0) / self.borders.period())
            }
            _ => 0.0,
        }
    }
}

impl ModeSearch {
    pub(crate) fn new(stack: &Stack, settings: &Settings) -> Self {
        let sets: Vec<TaskId> = stack
            .iter()
            .filter(|(_, level)| level.interval().is_some())
            .map(|(id, _)| id)
            .collect();
        Self {
            hierarchy: Hierarchy::new(stack, settings),
            high_priority: sets
                .iter()
                .copied()
                .filter(|&task| stack.is_high_priority(task))
                .collect(),
            active: ActiveSet::EMPTY,
            candidates: Vec::with_capacity(sets.len()),
            at_border: Vec::with_capacity(sets.len()),
            leaving: alloc::vec![0.0; stack.len()],
            sets,
            rule: settings.mode_rule,
            evaluated: 0,
        }
    }

    /// How fast a task on its border would be left if it were let go [unit/s]; 0 if it would not.
    pub(crate) fn leaving(&self, task: TaskId) -> f64 {
        self.leaving[task.index()]
    }

    /// The levels that had lost directions, and how many.
    pub(crate) fn lost(&self) -> impl Iterator<Item = (TaskId, usize)> {
        self.hierarchy.lost()
    }

    /// How many modes the last search computed a velocity of.
    pub(crate) fn evaluated(&self) -> usize {
        self.evaluated
    }

    /// The mode of this tick, its velocity in `velocity`; `None` if exclusions leave no mode that
    /// keeps every set.
    pub(crate) fn choose(
        &mut self,
        stack: &Stack,
        borders: &Borders,
        evaluation: &mut Evaluation,
        velocity: &mut [f64],
    ) -> Option<ActiveSet> {
        self.begin_tick(borders, evaluation);
        let high = self
            .candidates
            .iter()
            .filter(|&&task| self.high_priority.contains(task))
            .count();
        let low = self.candidates.len() - high;
        let mut tick = Tick {
            stack,
            borders,
            evaluation,
            velocity,
        };
        (0..=high.min(stack.dof()) + low)
            .any(|size| self.finds_one_of_size(&mut tick, size, 0))
            .then_some(self.active)
    }

    fn begin_tick(&mut self, borders: &Borders, evaluation: &Evaluation) {
        self.evaluated = 0;
        self.active = ActiveSet::EMPTY;
        self.hierarchy.begin_tick();
        self.candidates.clear();
        self.at_border.clear();
        for &task in &self.sets {
            let cone = borders.tangent_cone(task, evaluation.scalar(task));
            let at_border = cone.min.is_finite() || cone.max.is_finite();
            if at_border {
                let drift = evaluation.drift(task);
                let allowed = Interval {
                    min: cone.min - drift,
                    max: cone.max - drift,
                };
                self.at_border.push((task, allowed));
                self.leaving[task.index()] = 0.0;
            }
            if at_border || self.rule == ModeRule::Paper {
                self.candidates.push(task);
            }
        }
    }

    /// Looks for the first acceptable mode that adds `missing` more sets to the active ones, in list
    /// order from the candidate number `from` on. If there is one, its sets stay active.
    fn finds_one_of_size(&mut self, tick: &mut Tick<'_>, missing: usize, from: usize) -> bool {
        if missing == 0 {
            return self.is_accepted(tick);
        }
        for i in from..(self.candidates.len() + 1).saturating_sub(missing) {
            let task = self.candidates[i];
            if tick.stack[task].excluded().intersects(&self.active) {
                continue;
            }
            let frozen = self.hierarchy.frozen();
            if self.high_priority.contains(task) {
                let rate = tick.frozen_rate(task);
                if !self
                    .hierarchy
                    .freeze(tick.stack, tick.evaluation, task, rate)
                {
                    continue;
                }
            }
            self.active.insert(task);
            let is_found = self.finds_one_of_size(tick, missing - 1, i + 1);
            self.hierarchy.release_to(frozen);
            if is_found {
                return true;
            }
            self.active.remove(task);
        }
        false
    }

    /// Whether, at the velocity of this mode, no inactive set is left or driven further out.
    fn is_accepted(&mut self, tick: &mut Tick<'_>) -> bool {
        self.evaluated += 1;
        self.hierarchy
            .velocity(tick.stack, tick.evaluation, &self.active, tick.velocity);
        self.at_border.iter().all(|(task, allowed)| {
            self.active.contains(*task) || {
                let rate = dot(tick.evaluation.jacobian(tick.stack, *task), tick.velocity);
                let rate = if rate.abs() <= STILL { 0.0 } else { rate };
                // True for NaN, which the controller reports.
                let stays = !(rate < allowed.min || rate > allowed.max);
                if !stays {
                    self.leaving[task.index()] = rate + tick.evaluation.drift(*task);
                }
                stays
            }
        })
    }
}
