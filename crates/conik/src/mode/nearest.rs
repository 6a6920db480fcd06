//! The rule `cone`: at each level the velocity nearest to what the task asks, among those that keep
//! every high-priority set.
//!
//! Every side of a high-priority set is a row a q̇ ≥ b (see `sides`), and every level a small
//! quadratic program under those rows (see `level`). Since b ≤ 0, standing still is feasible; the
//! programs are strictly convex; so one answer exists, and it does not depend on how tasks are
//! numbered. A set is *active* if its row binds: it would be left if it were released. Nothing is
//! ever frozen that would not leave.
//!
//! A low-priority set is a level of its own. While the velocity of the levels above keeps it, or brings
//! it closer from outside, it is inactive and only binds the levels below. Otherwise it is active
//! and asks: inside, to stop at the border; outside, to come back with its gain.

use alloc::vec::Vec;

use super::claims::{Claims, Turn};
use super::level::{Level, LevelProgram};
use crate::active::ActiveSet;
use crate::border::Borders;
use crate::evaluation::Evaluation;
use crate::linalg::{Solution, dot};
use crate::real::sqrt;
use crate::settings::{Border, Recursion, Settings};
use crate::sides::{Held, Side, Sides, distance_inside, landing_rate};
use crate::stack::{Goal, Stack};
use crate::task_id::TaskId;

/// A side that was held is released when it moves inward faster than this [unit/s]. Rounding alone
/// must not release it and hold it again.
const RELEASE: f64 = 1e-7;

/// The same for a set of low priority, whose rate also changes with what holds the levels above.
const LOW_RELEASE: f64 = 1e-4;

#[derive(Debug)]
pub(crate) struct Nearest {
    recursion: Recursion,
    border: Border,
    period: f64,
    /// The equality tasks, and the sets below the first of them, in list order.
    lower: Vec<TaskId>,
    program: LevelProgram,
    sides: Sides,
    /// b, one for each side.
    bounds: Vec<f64>,
    /// Sides held in the last tick, and in this one so far.
    held_before: Held,
    held: Held,
    low_active: ActiveSet,
    /// Multiplier of each side at each level in the last tick: how hard the set pushes back.
    multipliers: Vec<f64>,
    /// What the levels above the present one have claimed.
    above: Claims,
    asked: Vec<f64>,
    /// r: what the level above the present one asked for and did not get.
    unmet: Vec<f64>,
    returning: Vec<usize>,
    tasks: usize,
}

/// What a tick works on.
pub(crate) struct NearestTick<'a> {
    pub(crate) stack: &'a Stack,
    pub(crate) evaluation: &'a mut Evaluation,
    pub(crate) borders: &'a Borders,
    pub(crate) pivots: &'a mut usize,
}

impl Nearest {
    pub(crate) fn new(stack: &Stack, settings: &Settings) -> Self {
        let max_rows = stack
            .iter()
            .map(|(_, l)| l.task().dimension())
            .max()
            .unwrap_or(1);
        let lower: Vec<TaskId> = stack
            .iter()
            .map(|(id, _)| id)
            .filter(|&id| !stack.is_high_priority(id))
            .collect();
        Self {
            recursion: settings.recursion,
            border: settings.border,
            period: 1.0 / settings.rate_hz,
            program: LevelProgram::new(stack, settings),
            sides: Sides::new(stack),
            bounds: Vec::with_capacity(2 * stack.len()),
            held_before: Held::default(),
            held: Held::default(),
            low_active: ActiveSet::EMPTY,
            above: Claims::new(stack.dof(), max_rows, lower.len(), 1.0 / settings.rate_hz),
            unmet: Vec::with_capacity(max_rows),
            multipliers: alloc::vec![0.0; 2 * stack.len() * lower.len()],
            lower,
            asked: Vec::with_capacity(max_rows),
            returning: Vec::with_capacity(2 * stack.len()),
            tasks: stack.len(),
        }
    }

    /// The velocity of this tick, and its active sets.
    pub(crate) fn choose(&mut self, tick: &mut NearestTick<'_>, velocity: &mut [f64]) -> ActiveSet {
        self.begin(tick);
        velocity.fill(0.0);
        let mut level_above: Option<usize> = None;
        for place in 0..self.lower.len() {
            let task = self.lower[place];
            if !self.ask(tick, task, velocity) {
                continue;
            }
            if let Some(previous) = level_above.replace(place) {
                self.claim(tick, previous);
            }
            self.descend(tick, place, velocity);
            self.unmet.clear();
            let rows = tick
                .evaluation
                .jacobian(tick.stack, task)
                .chunks_exact(velocity.len());
            self.unmet.extend(
                self.asked
                    .iter()
                    .zip(rows)
                    .map(|(asked, row)| asked - dot(row, velocity)),
            );
        }
        self.keep_what_does_not_leave(velocity);
        self.held.tasks().union(&self.low_active)
    }

    /// Sides held by this tick's velocity.
    pub(crate) fn held(&self) -> Held {
        self.held
    }

    /// Gathers the sides of the high-priority sets.
    fn begin(&mut self, tick: &mut NearestTick<'_>) {
        self.held_before = core::mem::take(&mut self.held);
        self.low_active = ActiveSet::EMPTY;
        self.above.clear();
        self.sides.clear();
        self.bounds.clear();
        for (task, level) in tick.stack.iter() {
            if level.interval().is_none() {
                break;
            }
            for is_upper in [false, true] {
                let side = Side { task, is_upper };
                let inside = distance_inside(tick.borders, side, tick.evaluation.scalar(task));
                if let Some(bound) = self.bound(inside) {
                    self.sides.push(tick.stack, tick.evaluation, side);
                    self.bounds.push(bound);
                }
            }
        }
    }

    /// b for a side whose bound is `inside` away; `None` if it binds nothing.
    fn bound(&self, inside: f64) -> Option<f64> {
        match self.border {
            Border::Freeze => (inside <= 0.0).then_some(0.0),
            Border::Land if inside == f64::INFINITY => None,
            Border::Land if inside >= 0.0 => Some(landing_rate(inside, self.period).min(0.0)),
            // Outside a set that had been entered: its bound, or the arm, was moved.
            Border::Land => Some(landing_rate(inside, self.period)),
        }
    }

    /// What a level asks for, into `asked`. `false` for a low-priority set that asks for nothing; its
    /// sides then bind the levels below.
    fn ask(&mut self, tick: &mut NearestTick<'_>, task: TaskId, velocity: &[f64]) -> bool {
        self.asked.clear();
        match tick.stack[task].goal() {
            Goal::Equality {
                desired_rate, gain, ..
            } => {
                let errors = tick.evaluation.errors().of(task).iter();
                self.asked.extend(
                    errors
                        .zip(desired_rate)
                        .map(|(error, rate)| rate + gain * error),
                );
                true
            }
            Goal::Set { interval, gain } => {
                let (interval, gain) = (*interval, gain.unwrap_or(0.0));
                let sigma = tick.evaluation.scalar(task);
                let rate = dot(tick.evaluation.jacobian(tick.stack, task), velocity);
                let lower = (false, sigma - interval.min, rate);
                let upper = (true, interval.max - sigma, -rate);
                for (is_upper, inside, rate) in [lower, upper] {
                    let side = Side { task, is_upper };
                    let kept = if inside < 0.0 {
                        0.0
                    } else {
                        -inside / self.period
                    };
                    let asked = if inside < 0.0 { -gain * inside } else { kept };
                    let enough = if self.held_before.contains(side) {
                        asked + LOW_RELEASE
                    } else {
                        kept
                    };
                    if rate < enough {
                        self.held.insert(side);
                        self.low_active.insert(task);
                        self.asked.push(if is_upper { -asked } else { asked });
                        return true;
                    }
                    if kept > f64::NEG_INFINITY {
                        self.sides.push(tick.stack, tick.evaluation, side);
                        self.bounds.push(kept.min(rate));
                    }
                }
                false
            }
        }
    }

    /// One level further down: fits the velocity to what the level asks. Where the program has no
    /// answer, the velocity of the levels above stands.
    fn descend(&mut self, tick: &mut NearestTick<'_>, place: usize, velocity: &mut [f64]) {
        let task = self.lower[place];
        tick.evaluation.jacobian(tick.stack, task);
        let (stack, evaluation) = (tick.stack, &*tick.evaluation);
        let multipliers = &self.multipliers[place * 2 * self.tasks..];
        let counting_on = |held: &Held| Level {
            jacobian: evaluation.known_jacobian(task),
            asked: &self.asked,
            from: velocity,
            above: &self.above,
            sides: &self.sides,
            bounds: &self.bounds,
            push_back: push_back(stack, evaluation, &self.sides, held, multipliers),
        };
        let all = self.held_before.union(&self.held);
        let level = counting_on(&all);
        let mut solution = self.program.solve(&level, &all, &[], tick.pivots);
        if solution == Solution::Optimal && self.recursion == Recursion::SicilianoSlotine {
            // The damping counts on held sides, and by that may be what makes one seem to move inward.
            // It is released only if it also does when the damping does not count on it.
            let remaining = still_held(&level, &self.program, &all);
            if remaining != all {
                let without = counting_on(&remaining);
                solution = self.program.solve(&without, &remaining, &[], tick.pivots);
                let binds = |i: &usize| all.contains(self.sides.get(*i));
                self.returning.clear();
                self.returning
                    .extend(self.program.binding().map(|(i, _)| i).filter(binds));
                let returns = |&i: &usize| !remaining.contains(self.sides.get(i));
                if solution == Solution::Optimal && self.returning.iter().any(returns) {
                    solution = self
                        .program
                        .solve(&level, &all, &self.returning, tick.pivots);
                }
            }
        }
        if solution == Solution::Optimal {
            velocity.copy_from_slice(self.program.velocity());
            self.remember(place);
        }
    }

    /// A level that has had its turn claims its motions from those below. `self.unmet` is its r.
    fn claim(&mut self, tick: &mut NearestTick<'_>, place: usize) {
        let task = self.lower[place];
        if self.recursion == Recursion::SicilianoSlotine {
            tick.evaluation.jacobian(tick.stack, task);
            let evaluation = &*tick.evaluation;
            let multipliers = &self.multipliers[place * 2 * self.tasks..];
            let turn = Turn {
                jacobian: evaluation.known_jacobian(task),
                unmet: sqrt(dot(&self.unmet, &self.unmet)),
            };
            let pushes = |(side, row): (Side, _)| (multipliers[side.number()] > 0.0).then_some(row);
            let pushing = self.sides.iter().filter_map(pushes);
            self.above.claim_rest(&turn, pushing, |curvature| {
                let mut add = |task: TaskId, weights: &[f64]| {
                    let task = tick.stack[task].task();
                    task.add_curvature(evaluation.kinematics(), weights, curvature);
                };
                add(task, &self.unmet);
                for (side, _) in self.sides.iter() {
                    let push = multipliers[side.number()];
                    if push > 0.0 {
                        add(side.task, &[if side.is_upper { -push } else { push }]);
                    }
                }
            });
        }
        self.above.claim(tick.evaluation.jacobian(tick.stack, task));
    }

    /// Which sides bind, and how hard.
    fn remember(&mut self, place: usize) {
        let memory = &mut self.multipliers[place * 2 * self.tasks..][..2 * self.tasks];
        memory.fill(0.0);
        for (i, multiplier) in self.program.binding() {
            let side = self.sides.get(i);
            self.held.insert(side);
            memory[side.number()] = multiplier;
        }
    }

    /// A side that was held and does not move inward stays held, whatever its multiplier.
    fn keep_what_does_not_leave(&mut self, velocity: &[f64]) {
        for ((side, row), bound) in self.sides.iter().zip(&self.bounds) {
            if self.held_before.contains(side) && dot(row, velocity) <= bound + RELEASE {
                self.held.insert(side);
            }
        }
    }
}

/// Σ μ c over the sides held, with the multipliers of the last tick.
fn push_back(
    stack: &Stack,
    evaluation: &Evaluation,
    sides: &Sides,
    held: &Held,
    multipliers: &[f64],
) -> f64 {
    let pushes = sides
        .iter()
        .filter(|(side, _)| multipliers[side.number()] != 0.0 && held.contains(*side))
        .map(|(side, _)| {
            let bend = stack[side.task].task().bend(evaluation.scalar(side.task));
            multipliers[side.number()].abs() * bend
        });
    pushes.sum()
}

/// The sides counted on that the solution does not release.
fn still_held(level: &Level<'_>, program: &LevelProgram, counted_on: &Held) -> Held {
    let mut remaining = *counted_on;
    for (i, ((side, row), bound)) in level.sides.iter().zip(level.bounds).enumerate() {
        let moves_inward = dot(row, program.velocity()) > bound + RELEASE;
        if moves_inward && counted_on.contains(side) && program.binding().all(|(k, _)| k != i) {
            remaining.remove(side);
        }
    }
    remaining
}
