//! The choice of the mode: the first, fewest active sets first, that keeps every other set.
//!
//! The rule of Section IV of the paper: go through the modes from least to most restrictive, and
//! take the first in which every *inactive* set-based task passes the tangent-cone test
//! `in_T_C(J f, σ)`, f being the velocity of that mode. Active high-priority sets are frozen, so they
//! pass by construction; active low-priority ones are pushed to their border and are not tested.
//!
//! Only a set at or outside its border can fail, so only those are tested; while none is there, the
//! first mode is the answer. Otherwise the same answer is found without going through the 2ⁿ modes:
//!
//! 1. An active set whose row depends on the active rows that stand above it adds nothing: f and the
//!    projectors of all levels depend on spans alone, and what it asks for lies in the span it is
//!    projected out of. So a mode has the velocity of its *core*, the mode without these sets, and no
//!    core has more sets than there are joints. A subset of a core is a core.
//! 2. Of the modes with a given core I, all those are accepted in which the sets that fail at the
//!    velocity of I are active: the *closure* I ∪ F of I and everything larger. The modes with this
//!    core are I and any sets that depend on what is above them. So if a set of F does not, or
//!    excludes another of I ∪ F, no mode with this core is accepted; else the closure is the first.
//!    Frozen high-priority rows that depend on others keep their place: they are not in F.
//! 3. The answer is the first of all closures. A closure does not come before its core, so once the
//!    next core comes after the first closure found, that is the answer.
//!
//! As a rule it has at most one set. So the modes of at most one set are looked at first, as they are;
//! only where none of them is accepted, rows are asked whether they depend on others.
//!
//! With n sets that may be active at most Σₖ C(n, k) velocities are computed, k = 0 … min(n, joints),
//! and one more where the answer is larger than its core: for a given arm, a polynomial in n. It is
//! none in the number of joints. There the rule itself is hard: rows that pass once any of some joints
//! is frozen make it ask for the fewest sets that cover all elements.

use alloc::vec::Vec;

use super::frozen::frozen_rate;
use crate::active::ActiveSet;
use crate::border::Borders;
use crate::cone::Interval;
use crate::evaluation::Evaluation;
use crate::hierarchy::Hierarchy;
use crate::linalg::dot;
use crate::settings::{ModeRule, Settings};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// A task that changes slower than this [unit/s] counts as one that stands still: a frozen task
/// moves at the level of rounding, and the test must not see it leave.
const STILL: f64 = 1e-12;

/// A task that leaves faster than this share of the velocity does so beyond doubt.
const CLEARLY: f64 = 1e-9;

#[derive(Debug)]
pub(crate) struct ModeSearch {
    hierarchy: Hierarchy,
    rule: ModeRule,
    sets: Vec<TaskId>,
    /// How many of them stand above the first equality task: they are the first tasks of the stack.
    high_priority: usize,
    /// The core at hand.
    core: ActiveSet,
    /// The first of the closures found so far.
    first: Option<ActiveSet>,
    /// Whether the modes at hand are those of at most one set, looked at as they are.
    is_first_look: bool,
    /// What the first look left open: modes, and with the low-priority sets that fail there.
    open: Vec<(ActiveSet, ActiveSet)>,
    /// Sets that the rule allows to be active this tick, in list order.
    candidates: Vec<TaskId>,
    /// Sets at or outside their border this tick.
    at_border: Vec<AtBorder>,
    /// |q̇|² of the velocity asked for.
    speed_squared: f64,
    /// How fast each task was left at the last core that it failed at [unit/s].
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

/// A set at or outside its border.
#[derive(Clone, Copy, Debug)]
struct AtBorder {
    task: TaskId,
    /// The rates J q̇ that its cone allows [unit/s].
    allowed: Interval,
    /// Its rate at the velocity asked for [unit/s], if there is one level.
    asked: f64,
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
            high_priority: stack.high_priority_sets().count(),
            core: ActiveSet::EMPTY,
            first: None,
            is_first_look: true,
            open: Vec::with_capacity(1 + sets.len()),
            candidates: Vec::with_capacity(sets.len()),
            at_border: Vec::with_capacity(sets.len()),
            leaving: alloc::vec![0.0; stack.len()],
            sets,
            rule: settings.mode_rule,
            speed_squared: 0.0,
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

    /// How many velocities the last search computed.
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
        let mut tick = Tick {
            stack,
            borders,
            evaluation,
            velocity,
        };
        if !self.is_closed(&mut tick) && !self.settles_with_one(&mut tick) {
            self.is_first_look = false;
            self.close_open(&mut tick);
            self.go_through_cores(&mut tick);
        }
        let first = self.first?;
        if first != self.core {
            self.freeze_alone(&mut tick, &first);
            self.find_velocity(&mut tick, &first);
        }
        Some(first)
    }

    fn begin_tick(&mut self, borders: &Borders, evaluation: &Evaluation) {
        self.evaluated = 0;
        self.core = ActiveSet::EMPTY;
        self.first = None;
        self.is_first_look = true;
        self.open.clear();
        self.hierarchy.begin_tick();
        self.candidates.clear();
        self.at_border.clear();
        for &task in &self.sets {
            let sigma = evaluation.scalar(task);
            let at_border = borders.is_at_border(task, sigma);
            if at_border {
                let cone = borders.tangent_cone(task, sigma);
                let drift = evaluation.drift(task);
                let allowed = Interval {
                    min: cone.min - drift,
                    max: cone.max - drift,
                };
                self.at_border.push(AtBorder {
                    task,
                    allowed,
                    asked: 0.0,
                });
                self.leaving[task.index()] = 0.0;
            }
            if at_border || self.rule == ModeRule::Paper {
                self.candidates.push(task);
            }
        }
    }

    fn has_high_priority(&self, task: TaskId) -> bool {
        task.index() < self.high_priority
    }

    /// Goes through the modes of one set until one is the answer.
    fn settles_with_one(&mut self, tick: &mut Tick<'_>) -> bool {
        self.look_at_border(tick);
        for i in 0..self.candidates.len() {
            let task = self.candidates[i];
            if self.is_clearly_refused(tick, task) || !self.extends_core(tick, task) {
                continue;
            }
            self.core.insert(task);
            let is_settled = self.is_closed(tick);
            self.hierarchy.release_to(0);
            if is_settled {
                return true;
            }
            self.core.remove(task);
        }
        false
    }

    /// Looks for closures of the modes of the first look.
    fn close_open(&mut self, tick: &mut Tick<'_>) {
        for i in 0..self.open.len() {
            let (mode, closure) = self.open[i];
            self.freeze_alone(tick, &mode);
            self.keep_if_closure(tick, &mode, &closure);
        }
        self.hierarchy.release_to(0);
    }

    /// Goes through the cores of two sets and more until the answer is known.
    fn go_through_cores(&mut self, tick: &mut Tick<'_>) {
        for size in 2..=self.candidates.len() {
            let evaluated = self.evaluated;
            let is_settled = self.settles_with(tick, size, 0);
            // Where there is no core of one size there is none of the next.
            if is_settled || self.evaluated == evaluated {
                return;
            }
        }
    }

    /// Goes through the cores that have `missing` more sets than the one at hand, in list order from
    /// the candidate number `from` on, until the answer is known. The core it is known at stays.
    fn settles_with(&mut self, tick: &mut Tick<'_>, missing: usize, from: usize) -> bool {
        if missing == 0 {
            let is_too_late = self.first.is_some_and(|first| precedes(&first, &self.core));
            return is_too_late || self.is_closed(tick);
        }
        for i in from..(self.candidates.len() + 1).saturating_sub(missing) {
            let task = self.candidates[i];
            let frozen = self.hierarchy.frozen();
            if !self.extends_core(tick, task) {
                continue;
            }
            self.core.insert(task);
            let is_settled = self.settles_with(tick, missing - 1, i + 1);
            self.hierarchy.release_to(frozen);
            if is_settled {
                return true;
            }
            self.core.remove(task);
        }
        false
    }

    /// How fast each set at the border goes at the velocity asked for, where that is one level's.
    fn look_at_border(&mut self, tick: &mut Tick<'_>) {
        let Some(asked) = self.hierarchy.asked_of_one_level() else {
            return;
        };
        self.speed_squared = dot(asked, asked);
        for at in &mut self.at_border {
            at.asked = dot(tick.evaluation.jacobian(tick.stack, at.task), asked);
        }
    }

    /// Whether another set clearly leaves in the mode of this one alone, told without building the mode:
    /// with one row a frozen and one level v below, J f = J v − (a v / a a) J a. Where rounding could
    /// decide, the mode is built.
    fn is_clearly_refused(&mut self, tick: &mut Tick<'_>, task: TaskId) -> bool {
        let Some(asked) = self.hierarchy.asked_of_one_level() else {
            return false;
        };
        if self.at_border.iter().all(|at| at.task == task) || !tick.borders.are_at_ease() {
            return false;
        }
        tick.evaluation.jacobian(tick.stack, task);
        let row = tick.evaluation.known_jacobian(task);
        let (along, length) = (dot(row, asked), dot(row, row));
        for at in self.at_border.iter().filter(|at| at.task != task) {
            // Rates times a a, so that nothing waits for a division. A row without length refuses none.
            let shared = dot(tick.evaluation.known_jacobian(at.task), row);
            let rate = at.asked * length - along * shared;
            let beyond = (at.allowed.min * length - rate).max(rate - at.allowed.max * length);
            let clearly = CLEARLY * length;
            if beyond > 0.0 && beyond * beyond > clearly * clearly * (1.0 + self.speed_squared) {
                self.leaving[at.task.index()] = rate / length;
                self.evaluated += 1;
                return true;
            }
        }
        false
    }

    /// Whether a set below those of the core makes a larger one with them. If it has high priority,
    /// it is then frozen.
    fn extends_core(&mut self, tick: &mut Tick<'_>, task: TaskId) -> bool {
        let has_high_priority = self.has_high_priority(task);
        let (stack, hierarchy) = (tick.stack, &mut self.hierarchy);
        if stack[task].excluded().intersects(&self.core) {
            return false;
        }
        if has_high_priority {
            let rate = frozen_rate(stack, tick.borders, tick.evaluation, task);
            hierarchy.freeze(stack, tick.evaluation, task, rate)
        } else {
            self.is_first_look || !hierarchy.depends(stack, tick.evaluation, task, &self.core)
        }
    }

    /// Whether the core is its own closure, and so the answer. A larger closure is kept.
    fn is_closed(&mut self, tick: &mut Tick<'_>) -> bool {
        let core = self.core;
        self.find_velocity(tick, &core);
        let mut closure = core;
        for &AtBorder { task, allowed, .. } in &self.at_border {
            if core.contains(task) {
                continue;
            }
            let rate = dot(tick.evaluation.jacobian(tick.stack, task), tick.velocity);
            let rate = if rate.abs() <= STILL { 0.0 } else { rate };
            // NaN passes; the controller reports it.
            if rate < allowed.min || rate > allowed.max {
                self.leaving[task.index()] = rate + tick.evaluation.drift(task);
                let is_excluded = tick.stack[task].excluded().intersects(&closure);
                if is_excluded || self.has_high_priority(task) {
                    return false;
                }
                closure.insert(task);
            }
        }
        if closure == core {
            self.first = Some(core);
            return true;
        }
        if self.is_first_look {
            self.open.push((core, closure));
        } else {
            self.keep_if_closure(tick, &core, &closure);
        }
        false
    }

    /// Keeps a closure that is the first so far. It is one if what it adds to the core, of which the
    /// high-priority sets are frozen, depends on the rows above.
    fn keep_if_closure(&mut self, tick: &mut Tick<'_>, core: &ActiveSet, closure: &ActiveSet) {
        let comes_first = self.first.is_none_or(|first| precedes(closure, &first));
        let mut added = closure.iter().filter(|&task| !core.contains(task));
        let hierarchy = &mut self.hierarchy;
        if comes_first
            && added.all(|task| hierarchy.depends(tick.stack, tick.evaluation, task, core))
        {
            self.first = Some(*closure);
        }
    }

    /// Freezes the high-priority sets of a mode and nothing else.
    fn freeze_alone(&mut self, tick: &mut Tick<'_>, mode: &ActiveSet) {
        self.hierarchy.release_to(0);
        for task in mode.iter() {
            if self.has_high_priority(task) {
                let rate = frozen_rate(tick.stack, tick.borders, tick.evaluation, task);
                self.hierarchy
                    .freeze(tick.stack, tick.evaluation, task, rate);
            }
        }
    }

    fn find_velocity(&mut self, tick: &mut Tick<'_>, mode: &ActiveSet) {
        self.evaluated += 1;
        self.hierarchy
            .velocity(tick.stack, tick.evaluation, mode, tick.velocity);
    }
}

/// Whether a mode comes before another in the order of the rule.
fn precedes(mode: &ActiveSet, other: &ActiveSet) -> bool {
    let by_size = mode.len().cmp(&other.len());
    by_size.then_with(|| mode.iter().cmp(other.iter())).is_lt()
}
