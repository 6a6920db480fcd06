//! The rule `cone`: at each level the velocity nearest to what the task asks, among those that keep
//! every high-priority set.
//!
//! Every side of a high-priority set is a row a q̇ ≥ b (see `barrier`), and every level a small
//! quadratic program under those rows (see `level`). Standing still is feasible, b ≤ 0, or where
//! something in the world moves the `anchor` is; the programs are strictly convex; so one answer
//! exists, and it does not depend on how tasks are numbered. A set is *active* if its row binds: it
//! would be left if it were released. Nothing is ever frozen that would not leave.
//!
//! A low-priority set is a level of its own, and active while it asks for something (see `asked`).
//! Otherwise it only binds the levels below.
//!
//! A level claims its rows from the levels below, and a level that is at rest without having what it
//! asks, its rest (see `claims`).

use alloc::vec::Vec;

use super::asked::{Above, Asked, Asks};
use super::claims::{Claims, Turn};
use super::level::{Level, LevelProgram};
use super::tremor::Tremor;
use super::within::{self, Within};
use crate::active::ActiveSet;
use crate::barrier::Barrier;
use crate::border::Borders;
use crate::evaluation::Evaluation;
use crate::linalg::{Solution, clear, copy, dot};
use crate::ranges::{Cut, Ranges};
use crate::settings::{Recursion, Settings};
use crate::sides::{Held, Side, Sides};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// A side that was held is released when it moves inward faster than this [unit/s]. Rounding alone
/// must not release it and hold it again.
const RELEASE: f64 = 1e-7;

#[derive(Debug)]
pub(crate) struct Nearest {
    recursion: Recursion,
    /// The equality tasks, and the sets below the first of them, in list order.
    lower: Vec<TaskId>,
    program: LevelProgram,
    /// Sides held in the last tick, and in this one so far.
    held_before: Held,
    held: Held,
    /// Sides that bind a level but that the levels below it take inward.
    taken_inward: Held,
    low_active: ActiveSet,
    /// Multiplier of each side at each level in the last tick: how hard the set pushes back.
    multipliers: Vec<f64>,
    /// What the levels above the present one have claimed.
    above: Claims,
    asked: Asked,
    /// r: what the last level asked for and did not get, for the levels below it.
    unmet: Vec<f64>,
    returning: Vec<usize>,
    tremor: Tremor,
    within: Within,
    /// How fast each side would be left if it were let go [unit/s].
    crossings: Vec<f64>,
    /// Directions that each lower level has lost.
    lost: Vec<usize>,
    tasks: usize,
}

/// What a tick works on.
pub(crate) struct NearestTick<'a> {
    pub(crate) stack: &'a Stack,
    pub(crate) evaluation: &'a mut Evaluation,
    /// What the high-priority sets allow. Low-priority ones that are kept add to it.
    pub(crate) barrier: &'a mut Barrier,
    pub(crate) borders: &'a Borders,
    /// The joints' ranges, where accelerations are limited.
    pub(crate) ranges: Option<&'a Ranges>,
    pub(crate) pivots: &'a mut usize,
}

impl NearestTick<'_> {
    /// Whether a velocity keeps the sides that were left out.
    fn covers(&mut self, velocity: &[f64]) -> bool {
        self.barrier
            .covers(self.stack, self.borders, self.evaluation, velocity)
    }

    fn gather_far(&mut self) {
        self.barrier
            .gather_far(self.stack, self.borders, self.evaluation);
    }
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
        let period = 1.0 / settings.rate_hz;
        let tremor = Tremor::new(lower.len(), stack.dof());
        Self {
            recursion: settings.recursion,
            program: LevelProgram::new(stack, settings),
            held_before: Held::default(),
            held: Held::default(),
            taken_inward: Held::default(),
            low_active: ActiveSet::EMPTY,
            multipliers: alloc::vec![0.0; 2 * stack.len() * lower.len()],
            lost: alloc::vec![0; lower.len()],
            above: Claims::new(stack, &lower, max_rows, period),
            lower,
            asked: Asked::new(max_rows, period),
            unmet: Vec::with_capacity(max_rows),
            returning: Vec::with_capacity(2 * stack.len()),
            tremor,
            within: Within::new(stack, max_rows),
            crossings: alloc::vec![0.0; 2 * stack.len()],
            tasks: stack.len(),
        }
    }

    /// The velocity of this tick, and its active sets.
    pub(crate) fn choose(&mut self, tick: &mut NearestTick<'_>, velocity: &mut [f64]) -> ActiveSet {
        self.held_before = core::mem::take(&mut self.held);
        self.low_active = ActiveSet::EMPTY;
        self.above.clear();
        self.crossings.fill(0.0);
        self.lost.fill(0);
        clear(velocity);
        if let Some(ranges) = tick.ranges {
            self.within.begin(ranges);
        }
        let mut level_above: Option<usize> = None;
        for place in 0..self.lower.len() {
            let task = self.lower[place];
            let above = Above {
                velocity,
                within: tick.ranges.map(|_| self.within.velocity()),
            };
            match self.asked.ask(tick, task, &above, &self.held_before) {
                Asks::Always => {}
                Asks::At { side, leaving } => {
                    self.held.insert(side);
                    self.low_active.insert(task);
                    self.crossings[side.number()] = leaving;
                }
                Asks::Nothing => continue,
            }
            if let Some(previous) = level_above.replace(place) {
                self.claim(tick, previous);
            }
            self.descend(tick, place, velocity);
        }
        if let Some(ranges) = tick.ranges {
            self.within
                .finish(tick.barrier, ranges, velocity, tick.pivots);
        }
        self.keep_what_does_not_leave(tick.barrier, velocity);
        self.held.tasks().union(&self.low_active)
    }

    /// How fast a side would be left if it were let go [unit/s]; 0 if it would not.
    pub(crate) fn crossing(&self, side: Side) -> f64 {
        self.crossings[side.number()]
    }

    /// The joints whose ranges cut a level short, and with it this tick; `None` if none was.
    pub(crate) fn cut(&self) -> Option<Cut> {
        self.within.cut()
    }

    /// The levels that have lost directions, and how many.
    pub(crate) fn lost(&self) -> impl Iterator<Item = (TaskId, usize)> {
        let levels = self.lower.iter().copied().zip(self.lost.iter().copied());
        levels.filter(|(_, lost)| *lost > 0)
    }

    /// Sides held by this tick's velocity: to land on their borders undoes nothing of it.
    pub(crate) fn held(&self) -> Held {
        self.held.without(&self.taken_inward)
    }

    /// One level further down: fits the velocity to what the level asks. Where the program has no
    /// answer, the velocity of the levels above stands.
    fn descend(&mut self, tick: &mut NearestTick<'_>, place: usize, velocity: &mut [f64]) {
        let mut solution = self.solve(tick, place, velocity);
        if solution == Solution::Optimal && !tick.covers(self.program.velocity()) {
            tick.gather_far();
            solution = self.solve(tick, place, velocity);
        }
        if solution == Solution::Optimal {
            if place > 0 {
                self.tremor
                    .observe(place, velocity, self.program.velocity());
            }
            copy(velocity, self.program.velocity());
            self.remember(place, &tick.barrier.sides);
            self.lost[place] = self.program.lost();
        }
        self.take_unmet(tick, place, velocity);
        if let (Some(ranges), Solution::Optimal) = (tick.ranges, solution) {
            let turn = within::Turn {
                jacobian: tick.evaluation.known_jacobian(self.lower[place]),
                above: &self.above,
                barrier: tick.barrier,
                ranges,
            };
            self.within.follow(&turn, velocity, tick.pivots);
        }
    }

    /// What a level does not get of what it asks. Limits of joints take nothing for good, and do not count.
    fn take_unmet(&mut self, tick: &NearestTick<'_>, place: usize, velocity: &[f64]) {
        if place + 1 == self.lower.len() {
            return;
        }
        let jacobian = tick.evaluation.known_jacobian(self.lower[place]);
        let met = jacobian
            .chunks_exact(velocity.len())
            .map(|row| dot(row, velocity));
        self.unmet.clear();
        self.unmet.extend(
            self.asked
                .rates()
                .iter()
                .zip(met)
                .map(|(asked, met)| asked - met),
        );
    }

    /// The program of a level, after `from`, the velocity of the levels above.
    fn solve(&mut self, tick: &mut NearestTick<'_>, place: usize, from: &[f64]) -> Solution {
        let task = self.lower[place];
        tick.evaluation.jacobian(tick.stack, task);
        let (evaluation, barrier) = (&*tick.evaluation, &*tick.barrier);
        let multipliers = &self.multipliers[place * 2 * self.tasks..];
        // The estimate of a level with none above it counts everything that it can answer to.
        let stiffening = if self.above.rows().rank() == 0 {
            1.0
        } else {
            self.tremor.factor(place)
        };
        let counting_on = |held: &Held| Level {
            jacobian: evaluation.known_jacobian(task),
            asked: self.asked.rates(),
            from,
            above: &self.above,
            sides: &barrier.sides,
            bounds: &barrier.bounds,
            push_back: push_back(tick.stack, evaluation, barrier, held, multipliers),
            damping: tick.stack[task].damping(),
            stiffening,
        };
        let all = self.held_before.union(&self.held);
        let level = counting_on(&all);
        let solution = self.program.solve(&level, &all, &[], tick.pivots);
        if solution != Solution::Optimal || self.recursion == Recursion::Chiaverini {
            return solution;
        }
        // The damping counts on held sides, and by that may be what makes one seem to move inward.
        // It is released only if it also does when the damping does not count on it.
        let remaining = still_held(&level, &self.program, &all);
        if remaining == all {
            return solution;
        }
        let without = counting_on(&remaining);
        let solution = self.program.solve(&without, &remaining, &[], tick.pivots);
        let binding = self.program.binding().map(|(i, _)| i);
        self.returning.clear();
        self.returning
            .extend(binding.filter(|&i| all.contains(level.sides.get(i))));
        let returns = |&i: &usize| !remaining.contains(level.sides.get(i));
        if solution != Solution::Optimal || !self.returning.iter().any(returns) {
            return solution;
        }
        self.program
            .solve(&level, &all, &self.returning, tick.pivots)
    }

    /// A level that has had its turn claims its motions from those below.
    fn claim(&mut self, tick: &NearestTick<'_>, place: usize) {
        let task = self.lower[place];
        let turn = Turn {
            task,
            jacobian: tick.evaluation.known_jacobian(task),
            unmet: &self.unmet,
        };
        if self.recursion == Recursion::SicilianoSlotine {
            let multipliers = &self.multipliers[place * 2 * self.tasks..];
            self.above.claim_rest(
                tick.stack,
                tick.evaluation.kinematics(),
                &turn,
                &tick.barrier.sides,
                |side| multipliers[side.number()],
            );
        }
        self.above.claim(&turn);
    }

    /// Which sides bind, and how hard.
    fn remember(&mut self, place: usize, sides: &Sides) {
        let memory = &mut self.multipliers[place * 2 * self.tasks..][..2 * self.tasks];
        memory.fill(0.0);
        for (i, multiplier) in self.program.binding() {
            let side = sides.get(i);
            self.held.insert(side);
            memory[side.number()] = multiplier;
        }
        for (i, rate) in self.program.crossings() {
            let crossing = &mut self.crossings[sides.get(i).number()];
            *crossing = crossing.max(rate);
        }
    }

    /// A side that was held and does not move inward stays held, whatever its multiplier.
    fn keep_what_does_not_leave(&mut self, barrier: &Barrier, velocity: &[f64]) {
        self.taken_inward = Held::default();
        for (side, row, bound) in barrier.iter() {
            if dot(row, velocity) > bound + RELEASE {
                self.taken_inward.insert(side);
            } else if self.held_before.contains(side) {
                self.held.insert(side);
            }
        }
    }
}

/// Σ μ c over the sides held, with the multipliers of the last tick.
fn push_back(
    stack: &Stack,
    evaluation: &Evaluation,
    barrier: &Barrier,
    held: &Held,
    multipliers: &[f64],
) -> f64 {
    let pushing = |side: &Side| multipliers[side.number()] != 0.0 && held.contains(*side);
    let sides = barrier.sides.iter().map(|(side, _)| side);
    let pushes = sides.filter(pushing).map(|side| {
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
