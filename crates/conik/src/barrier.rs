//! What the high-priority sets allow a velocity: a row a q̇ ≥ b for every side that it could leave.
//!
//! With border `Land`, b is the rate at which the side is a margin inside its bound at the end of the
//! period, to first order, cut at zero: while nothing but the arm moves, standing still is enough. With
//! `Freeze`, b is zero at the border and outside, and sides further inside bind nothing.
//!
//! A bound that comes closer by itself, because it moves or because the task's own parameters do, adds
//! the rate at which it comes. Then b may be positive, and standing still is not enough.
//!
//! Where joints have acceleration limits, a side is approached no faster than half of what they can
//! do would still stop in front of it.

use alloc::vec::Vec;

use crate::border::{Borders, MARGIN};
use crate::evaluation::Evaluation;
use crate::real::sqrt;
use crate::settings::{Border, Settings};
use crate::sides::{Held, Side, Sides, landing_rate};
use crate::stack::{Goal, Stack};
use crate::task_id::TaskId;

/// Share of the joints' acceleration that braking in front of a bound counts on. The rest is for what
/// bends, and for the other sets.
const BRAKING_SHARE: f64 = 0.5;

/// Sides that are kept by every velocity with Σ|q̇ᵢ| up to this [rad/s] are left out at first.
pub(crate) const NEAR: f64 = 4.0;

#[derive(Debug)]
pub(crate) struct Barrier {
    pub(crate) sides: Sides,
    /// b of each side [unit/s].
    pub(crate) bounds: Vec<f64>,
    /// Sides, by index, that are to move inward at a rate [unit/s], as far as all the others allow:
    /// the recovery of sets that are outside.
    pub(crate) wishes: Vec<(usize, f64)>,
    /// Sides in front of which the arm brakes: their b keeps them away from their margin.
    pub(crate) slowed: Held,
    /// Greatest acceleration of each joint, where braking is to be counted on.
    braking: Option<Vec<f64>>,
    border: Border,
    period: f64,
    /// Sides so far inside that they are kept by every velocity with Σ|q̇ᵢ| below `horizon` [rad/s], and
    /// their b.
    far: Vec<(Side, f64)>,
    horizon: f64,
    /// The sets that may have a side that is not.
    near: Vec<TaskId>,
}

impl Barrier {
    pub(crate) fn new(stack: &Stack, settings: &Settings, braking: Option<Vec<f64>>) -> Self {
        Self {
            sides: Sides::new(stack),
            bounds: Vec::with_capacity(2 * stack.len()),
            wishes: Vec::with_capacity(2 * stack.len()),
            slowed: Held::default(),
            braking,
            border: settings.border,
            period: 1.0 / settings.rate_hz,
            far: Vec::with_capacity(2 * stack.len()),
            near: Vec::with_capacity(stack.len()),
            horizon: f64::INFINITY,
        }
    }

    /// Nothing is asked.
    pub(crate) fn clear(&mut self) {
        self.sides.clear();
        self.bounds.clear();
        self.wishes.clear();
        self.slowed = Held::default();
        self.far.clear();
        self.horizon = f64::INFINITY;
    }

    /// Gathers, into an empty barrier, the sides of the high-priority sets.
    pub(crate) fn gather(&mut self, stack: &Stack, borders: &Borders, evaluation: &mut Evaluation) {
        self.part(stack, borders, evaluation);
        for place in 0..self.near.len() {
            let task = self.near[place];
            let Goal::Set {
                interval, recovery, ..
            } = stack[task].goal()
            else {
                break;
            };
            let (sigma, steepness) = (evaluation.scalar(task), evaluation.steepness(task));
            for side in Side::both(task) {
                let inside = side.inside(borders.interval(task), sigma);
                let Some(bound) = self.bound(inside) else {
                    continue;
                };
                let approaching = side.inward(borders.bound_rate(side) - evaluation.drift(task));
                let outside = -side.inside(interval, sigma);
                let horizon = -(bound + approaching) / steepness;
                if horizon > NEAR && outside <= 0.0 && self.braking.is_none() {
                    self.far.push((side, bound + approaching));
                    self.horizon = self.horizon.min(horizon);
                    continue;
                }
                self.sides.push(stack, evaluation, side);
                let braked = self.braked(bound, inside);
                if braked > bound {
                    self.slowed.insert(side);
                }
                self.bounds.push(braked + approaching);
                if let (Some(speed), true) = (*recovery, outside > 0.0) {
                    let rate = speed.min(landing_rate(-outside, self.period)) + approaching;
                    self.wishes.push((self.bounds.len() - 1, rate));
                }
            }
        }
    }

    /// Parts the high-priority sets into those that are near and, where nothing but the arm moves and
    /// every set was entered, those with both sides far away, which takes no more than one look.
    fn part(&mut self, stack: &Stack, borders: &Borders, evaluation: &Evaluation) {
        self.near.clear();
        let sets = stack.high_priority_sets().map(|(task, _)| task);
        let only_the_arm_moves = borders.are_settled() && !evaluation.is_any_drifting();
        if self.border == Border::Freeze || self.braking.is_some() || !only_the_arm_moves {
            self.near.extend(sets);
            return;
        }
        let looks = borders.intervals().iter().zip(evaluation.steepnesses());
        let looks = looks.zip(evaluation.scalars(borders.high_priority()));
        for (task, ((set, steepness), sigma)) in sets.zip(looks) {
            let rates = Side::both(task)
                .map(|side| (side, landing_rate(side.inside(set, *sigma), self.period)));
            let [(_, lower), (_, upper)] = rates;
            let horizon = -lower.max(upper) / steepness;
            if horizon > NEAR {
                self.horizon = self.horizon.min(horizon);
                let bounded = |(_, bound): &(Side, f64)| *bound > f64::NEG_INFINITY;
                self.far.extend(rates.into_iter().filter(bounded));
            } else {
                self.near.push(task);
            }
        }
    }

    /// Whether a velocity keeps, for certain, the sides left out as too far away. If it does not, they
    /// are to be gathered after all, and what was found without them is to be found again.
    pub(crate) fn covers(
        &mut self,
        stack: &Stack,
        borders: &Borders,
        evaluation: &mut Evaluation,
        velocity: &[f64],
    ) -> bool {
        let speed: f64 = velocity.iter().map(|speed| speed.abs()).sum();
        if speed > self.horizon {
            self.look_closer(stack, borders, evaluation);
        }
        speed <= self.horizon
    }

    /// Measures those sides left out of which only a bound was known.
    fn look_closer(&mut self, stack: &Stack, borders: &Borders, evaluation: &mut Evaluation) {
        let measured = evaluation.measure(stack);
        if measured.is_empty() {
            return;
        }
        self.horizon = f64::INFINITY;
        for (side, bound) in &mut self.far {
            let task = side.task;
            if measured.contains(task) {
                let inside = side.inside(borders.interval(task), evaluation.scalar(task));
                *bound = landing_rate(inside, self.period);
            }
            self.horizon = self.horizon.min(-*bound / evaluation.steepness(task));
        }
    }

    /// Gathers the sides that were left out.
    pub(crate) fn gather_far(
        &mut self,
        stack: &Stack,
        borders: &Borders,
        evaluation: &mut Evaluation,
    ) {
        self.look_closer(stack, borders, evaluation);
        for (side, bound) in self.far.drain(..) {
            self.sides.push(stack, evaluation, side);
            self.bounds.push(bound);
        }
        self.horizon = f64::INFINITY;
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

    /// b, raised for the side gathered last to the rate from which the joints can still brake: the
    /// largest v with T v + v²/2d ≤ the way that is left, d being the deceleration of the task.
    fn braked(&self, bound: f64, inside: f64) -> f64 {
        let Some(accelerations) = &self.braking else {
            return bound;
        };
        let row = self.sides.last_row();
        let together: f64 = row
            .iter()
            .zip(accelerations)
            .map(|(a, limit)| a.abs() * limit)
            .sum();
        let deceleration = BRAKING_SHARE * together;
        if !(deceleration > 0.0 && deceleration.is_finite()) {
            return bound;
        }
        let way = (inside - MARGIN).max(0.0);
        let gained = deceleration * self.period;
        bound.max(gained * (1.0 - sqrt(1.0 + 2.0 * way / (gained * self.period))))
    }

    /// Adds a side of a lower level, which binds the levels below it.
    pub(crate) fn push(
        &mut self,
        stack: &Stack,
        evaluation: &mut Evaluation,
        side: Side,
        bound: f64,
    ) {
        self.sides.push(stack, evaluation, side);
        self.bounds.push(bound);
    }

    /// Sides with their rows and their b.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Side, &[f64], f64)> {
        self.sides
            .iter()
            .zip(&self.bounds)
            .map(|((side, row), bound)| (side, row, *bound))
    }

    /// Whether standing still keeps every side, and no more is wished.
    pub(crate) fn is_at_ease(&self) -> bool {
        self.wishes.is_empty() && self.bounds.iter().all(|bound| *bound <= 0.0)
    }

    /// Whether a velocity keeps every side.
    pub(crate) fn allows(&self, velocity: &[f64]) -> bool {
        self.iter()
            .all(|(_, row, bound)| crate::linalg::dot(row, velocity) >= bound)
    }
}
