//! Border `Land`: no sample outside a set that was ever entered.
//!
//! Whatever velocity the rule proposes, the values at q + T q̇ are computed with the true kinematics
//! before it is committed. What is found outside is corrected: the least change of q̇ that, by the
//! rows at q, repairs the values found. If two corrections do not do, the way from the anchor to the
//! velocity is halved; after two halvings the arm stands still for this period.
//!
//! **Every sample is inside.** By induction over ticks, for sets and bounds that do not move. Let q be
//! inside every bound in force; for sets entered, those are the sets. (1) Each way out of
//! [`Landing::land`] commits either a point whose values were computed and found inside every bound
//! in force, or q itself. (2) The next tick uses these values, or computes the same from the same bits, so
//! it finds them inside too. (3) Bounds in force only ever tighten, towards the set, and never past the
//! present value ([`Borders`](crate::border::Borders)). Hence the next q is inside, exactly: no
//! tolerance, any rate, any rule, any recursion, any number of sets. Nothing is said about the time
//! between samples. `docs/method.md` goes through the steps one by one.
//!
//! **Where something moves by itself**, values and bounds are those of the end of the period, and
//! standing still may be outside too. Then the trial of the least violation is committed, standing
//! still among them, and [`Landed::outside`] says by how much: the next sample is inside, or this
//! tick has said that it is not.
//!
//! At most 10 kinematics a tick: three trials of one and two corrections each, and one more where sets that
//! cannot all be kept make the arm turn back from tick to tick.

use alloc::vec::Vec;

use crate::barrier::NEAR;
use crate::border::{Borders, MARGIN};
use crate::evaluation::Evaluation;
use crate::joints::JointVec;
use crate::limits::Limits;
use crate::linalg::{Constraints, DualActiveSet, Solution, add_scaled, clear, dot};
use crate::restless::Restless;
use crate::sides::{Held, Side, Sides, landing_rate};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// Corrections of one trial.
const CORRECTIONS: usize = 2;

/// Halvings before the arm stands still.
const HALVINGS: usize = 2;

/// After a tick that had to stand still, the next one sets out with this share of the share before.
/// So halving goes on from tick to tick until a step is short enough for the rows at q, and no tick
/// takes more kinematics than another.
const CAUTION: f64 = 0.125;

/// The least of these shares: of a step so short, what the rows at q leave out is lost in rounding. Shares that
/// fell on would only keep the arm from moving when it can again.
const LEAST_CAUTION: f64 = 1e-9;

/// Shares of the margin that a correction is content with where it cannot have all of it. Two bounds may
/// be closer than two margins: those of sets that were never entered and contradict each other.
const MARGIN_SHARES: [f64; 2] = [0.5, 0.0625];

/// What it took to land.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Landed {
    /// Configurations of which the kinematics were computed.
    pub kinematics: usize,
    /// Corrections of the velocity.
    pub corrections: usize,
    /// Halvings of the velocity.
    pub halvings: usize,
    /// Share of the velocity that the tick set out with, because one before had to stand still; `None`:
    /// all of it.
    pub cautious: Option<f64>,
    /// Whether no velocity was found that lands, so that the arm stands still for this period.
    pub stood_still: bool,
    /// The set that will be furthest outside at the end of this period, because it, its bound or
    /// another one moves and no velocity was found that keeps them all. `None`: all will be inside, if
    /// what moves goes on as was said.
    pub outside: Option<Outside>,
}

/// A set that will be outside its bound in force at the end of the period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// The set-based task.
    pub task: TaskId,
    /// By how much [task's unit].
    pub by: f64,
}

#[derive(Debug)]
pub(crate) struct Landing {
    solver: DualActiveSet,
    sides: Sides,
    /// The rows of the sides, then those of the joints' ranges.
    rows: Vec<f64>,
    bounds: Vec<f64>,
    equalities: Vec<usize>,
    change: Vec<f64>,
    /// Sides that were left out are kept by every change with Σ|Δq̇ᵢ| up to this [rad/s].
    horizon: f64,
    /// The trial of the least violation so far.
    best: Option<Best>,
    /// Share of the velocity that the next tick tries first.
    caution: f64,
    restless: Restless,
    period: f64,
}

/// A tick that is to be landed.
pub(crate) struct Approach<'a> {
    pub(crate) stack: &'a Stack,
    /// The robot at q, with its rows.
    pub(crate) here: &'a mut Evaluation,
    /// The robot at the trial.
    pub(crate) there: &'a mut Evaluation,
    pub(crate) borders: &'a Borders,
    pub(crate) limits: &'a Limits,
    /// The last velocity [rad/s or m/s].
    pub(crate) before: &'a [f64],
    /// A velocity that keeps every set to first order; rest while nothing moves.
    pub(crate) anchor: &'a [f64],
    /// Sides to be held at their margin.
    pub(crate) held: &'a Held,
    pub(crate) pivots: &'a mut usize,
}

/// A trial that was outside, and how far.
#[derive(Clone, Copy, Debug)]
struct Best {
    outside: Outside,
    qd: JointVec,
}

impl Landing {
    pub(crate) fn new(stack: &Stack, period: f64) -> Self {
        Self {
            solver: DualActiveSet::new(stack.dof()),
            sides: Sides::new(stack),
            rows: Vec::with_capacity(2 * (stack.len() + stack.dof()) * stack.dof()),
            bounds: Vec::with_capacity(2 * (stack.len() + stack.dof())),
            equalities: Vec::with_capacity(2 * stack.len()),
            change: alloc::vec![0.0; stack.dof()],
            horizon: f64::INFINITY,
            best: None,
            caution: 1.0,
            restless: Restless::new(period),
            period,
        }
    }

    /// Turns the proposed velocity `qd` into one that lands inside every bound in force, and `target`
    /// into q + T q̇. `is_shortened` says that limits of the joints have already cut `qd` short of the
    /// sides to be held.
    pub(crate) fn land(
        &mut self,
        approach: &mut Approach<'_>,
        q: &[f64],
        mut is_shortened: bool,
        qd: &mut JointVec,
        target: &mut JointVec,
    ) -> Landed {
        let mut landed = Landed::default();
        self.best = None;
        let mut corrections = 0;
        if self.caution < 1.0 {
            is_shortened = true;
            landed.cautious = Some(self.caution);
            shorten(qd, approach.anchor, self.caution);
        }
        loop {
            self.aim(q, qd, target);
            landed.kinematics += 1;
            approach.there.look_ahead(approach.stack, target);
            let is_last = corrections == CORRECTIONS;
            match approach.worst_at_trial() {
                None if is_shortened || is_last || approach.holds_margins() => {
                    self.caution = (2.0 * self.caution).min(1.0);
                    self.restless.ease();
                    return landed;
                }
                None => {}
                Some(outside) => self.remember(outside, qd),
            }
            if !is_last && self.correct(approach, is_shortened, qd) {
                corrections += 1;
                landed.corrections += 1;
                is_shortened |= approach
                    .limits
                    .shorten_to_speed(qd, approach.anchor)
                    .is_some();
                continue;
            }
            if landed.halvings == HALVINGS {
                self.give_in(approach, q, qd, target, &mut landed);
                if landed.stood_still {
                    self.caution = (self.caution * CAUTION).max(LEAST_CAUTION);
                }
                self.aim(q, qd, target);
                return landed;
            }
            landed.halvings += 1;
            corrections = 0;
            is_shortened = true;
            shorten(qd, approach.anchor, 0.5);
        }
    }

    fn aim(&self, q: &[f64], qd: &[f64], target: &mut [f64]) {
        for ((target, q), qd) in target.iter_mut().zip(q).zip(qd) {
            *target = q + self.period * qd;
        }
    }

    fn remember(&mut self, outside: Outside, qd: &JointVec) {
        let is_better = |best: &Best| outside.by < best.outside.by;
        if self.best.as_ref().is_none_or(is_better) {
            self.best = Some(Best { outside, qd: *qd });
        }
    }

    /// No trial was inside: the arm stands still, unless that is worse than the best of them.
    fn give_in(
        &mut self,
        approach: &mut Approach<'_>,
        q: &[f64],
        qd: &mut JointVec,
        target: &mut JointVec,
        landed: &mut Landed,
    ) {
        let standing = worst(approach, |task| {
            approach.here.scalar(task) + self.period * approach.here.drift(task)
        });
        match (standing, &self.best) {
            (Some(standing), Some(best)) if best.outside.by < standing.by => {
                *qd = best.qd;
                landed.outside = Some(best.outside);
                self.steady(approach, q, qd, target, standing, landed);
            }
            _ => {
                landed.stood_still = true;
                landed.outside = standing;
                qd.fill(0.0);
            }
        }
    }

    /// The velocity of the least violation may leap from one end of the joints' ranges to the other. Where
    /// it turns back from tick to tick, the last velocity is changed by a share of the way to it alone
    /// ([`Restless`]), and where that is worse than `standing` still, the arm stands still.
    fn steady(
        &mut self,
        approach: &mut Approach<'_>,
        q: &[f64],
        qd: &mut JointVec,
        target: &mut JointVec,
        standing: Outside,
        landed: &mut Landed,
    ) {
        let mut steadier = *qd;
        if !self.restless.steady(&mut steadier, approach.before) {
            return;
        }
        self.aim(q, &steadier, target);
        landed.kinematics += 1;
        approach.there.look_ahead(approach.stack, target);
        let outside = approach.worst_at_trial();
        if outside.is_none_or(|outside| outside.by <= standing.by) {
            *qd = steadier;
            landed.outside = outside;
        } else {
            qd.fill(0.0);
            landed.outside = Some(standing);
            landed.stood_still = true;
        }
    }

    /// q̇ += the least change that repairs what the trial found. `false` if there is none.
    fn correct(
        &mut self,
        approach: &mut Approach<'_>,
        is_shortened: bool,
        qd: &mut JointVec,
    ) -> bool {
        let bounded = approach.there.bounded();
        if bounded.is_some_and(|bounded| bounded.intersects(&approach.held.tasks())) {
            approach.there.measure(approach.stack);
        }
        // Almost always the sides that are near decide alone.
        for near in [NEAR, f64::INFINITY] {
            if near == f64::INFINITY {
                approach.there.measure(approach.stack);
            }
            self.gather(approach, near, is_shortened);
            if !self.find_change(approach, qd) {
                return false;
            }
            if !self.covers_change() && !approach.there.measure(approach.stack).is_empty() {
                // What was left out may be farther away than its bounds said.
                self.gather(approach, near, is_shortened);
            }
            if self.covers_change() {
                add_scaled(qd, 1.0, &self.change);
                return true;
            }
        }
        false
    }

    /// Whether the change keeps the sides that were left out.
    fn covers_change(&self) -> bool {
        self.change.iter().map(|speed| speed.abs()).sum::<f64>() <= self.horizon
    }

    /// The least change under the sides gathered and the joints' ranges.
    fn find_change(&mut self, approach: &mut Approach<'_>, qd: &JointVec) -> bool {
        self.rows.clear();
        self.rows.extend_from_slice(self.sides.rows());
        let sides = self.bounds.len();
        if approach.limits.has_acceleration() {
            approach
                .limits
                .push_rows(Some(approach.before), &mut self.rows, &mut self.bounds);
            let ranges = self.rows[sides * qd.len()..].chunks_exact(qd.len());
            for (bound, row) in self.bounds[sides..].iter_mut().zip(ranges) {
                *bound -= dot(row, qd);
            }
        }
        // Held sides that cannot all be met may still all be kept, and sets come before accelerations.
        let (held, all) = (self.equalities.len(), self.bounds.len());
        let attempts = [(held, all), (0, all), (0, sides)];
        let with_margin = attempts.into_iter().enumerate().any(|(i, attempt)| {
            let (held, rows) = attempt;
            !attempts[..i].contains(&attempt) && self.change_by_least(approach, held, rows)
        });
        let mut share = 1.0;
        with_margin
            || MARGIN_SHARES.into_iter().any(|less| {
                for bound in &mut self.bounds[..sides] {
                    *bound -= (share - less) * MARGIN / self.period;
                }
                share = less;
                self.change_by_least(approach, 0, sides)
            })
    }

    /// The least change under the first `rows` rows, the first `held` held sides met exactly.
    fn change_by_least(&mut self, approach: &mut Approach<'_>, held: usize, rows: usize) -> bool {
        clear(&mut self.change);
        self.solver.set_identity();
        let constraints = Constraints {
            rows: &self.rows,
            bounds: &self.bounds[..rows],
            equalities: &self.equalities[..held],
        };
        let change = &mut self.change;
        self.solver.solve(change, constraints, approach.pivots) == Solution::Optimal
    }

    /// The sides of the high-priority sets with what the trial found of them, but for those that no
    /// change with Σ|Δq̇ᵢ| up to `near` can violate.
    fn gather(&mut self, approach: &mut Approach<'_>, near: f64, is_shortened: bool) {
        self.sides.clear();
        self.bounds.clear();
        self.equalities.clear();
        self.horizon = f64::INFINITY;
        for (task, level) in approach.stack.iter() {
            let Some(set) = level.interval() else { break };
            let (next, sigma) = (
                approach.borders.next_interval(task),
                approach.there.scalar(task),
            );
            let bounded = |side: &Side| side.inside(set, 0.0).is_finite();
            for side in Side::both(task).into_iter().filter(bounded) {
                let bound = landing_rate(side.inside(next, sigma), self.period);
                let is_held = approach.held.contains(side) && !is_shortened;
                let horizon = -bound / approach.here.steepness(task);
                if horizon > near && !is_held {
                    self.horizon = self.horizon.min(horizon);
                    continue;
                }
                if is_held {
                    self.equalities.push(self.bounds.len());
                }
                self.sides.push(approach.stack, approach.here, side);
                self.bounds.push(bound);
            }
        }
    }
}

impl Approach<'_> {
    /// The high-priority set that is furthest outside at the trial; `None` if all are inside.
    fn worst_at_trial(&self) -> Option<Outside> {
        if self.borders.all_will_be_inside(self.there) {
            return None;
        }
        worst(self, |task| self.there.scalar(task))
    }

    /// Whether every held side is a margin inside at the trial, to half of it.
    fn holds_margins(&self) -> bool {
        let tasks = self.held.tasks();
        tasks
            .iter()
            .filter(|&task| self.stack.is_high_priority(task))
            .flat_map(Side::both)
            .filter(|&side| self.held.contains(side))
            .all(|side| {
                let set = self.borders.next_interval(side.task);
                let inside = side.inside(set, self.there.scalar(side.task));
                (inside - MARGIN).abs() <= 0.5 * MARGIN
            })
    }
}

/// The high-priority set that is furthest outside its bound in force at the end of the period, with
/// these values; `None` if all are inside.
fn worst(approach: &Approach<'_>, value: impl Fn(TaskId) -> f64) -> Option<Outside> {
    let mut worst: Option<Outside> = None;
    for (task, _) in approach.stack.high_priority_sets() {
        let (set, sigma) = (approach.borders.next_interval(task), value(task));
        if set.contains(sigma) {
            continue;
        }
        let by = if sigma.is_nan() {
            f64::INFINITY
        } else {
            set.violation(sigma)
        };
        if worst.is_none_or(|worst| by > worst.by) {
            worst = Some(Outside { task, by });
        }
    }
    worst
}

/// What `share` leaves of a velocity beyond its anchor.
fn shorten(qd: &mut JointVec, anchor: &[f64], share: f64) {
    for (speed, anchor) in qd.iter_mut().zip(anchor) {
        *speed = anchor + share * (*speed - anchor);
    }
}
