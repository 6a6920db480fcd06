//! Border `Land`: no sample outside a set that was ever entered.
//!
//! Whatever velocity the rule proposes, the values at q + T q̇ are computed with the true kinematics
//! before it is committed. What is found outside is corrected: the least change of q̇ that, by the
//! rows at q, repairs the values found. If two corrections do not do, half the velocity is tried;
//! after two halvings the arm stands still for this period.
//!
//! **Every sample is inside.** By induction over ticks, for sets and bounds that do not move. Let q be
//! inside every bound in force; for sets entered, those are the sets. (1) Each way out of
//! [`Landing::land`] commits either a point whose values were computed and found inside every bound
//! in force, or q itself. (2) The next tick computes the same values from the same bits, so it finds
//! them inside too. (3) Bounds in force only ever tighten, towards the set, and never past the
//! present value ([`Borders`](crate::border::Borders)). Hence the next q is inside, exactly: no
//! tolerance, any rate, any rule, any recursion, any number of sets. Nothing is said about the time
//! between samples.
//!
//! At most 9 kinematics a tick: three trials of one and two corrections each.

use alloc::vec::Vec;

use crate::border::{Borders, MARGIN};
use crate::evaluation::Evaluation;
use crate::joints::JointVec;
use crate::linalg::{Constraints, DualActiveSet, Solution, add_scaled};
use crate::sides::{Held, Side, Sides, distance_inside};
use crate::stack::Stack;

/// Corrections of one trial.
const CORRECTIONS: usize = 2;

/// Halvings before the arm stands still.
const HALVINGS: usize = 2;

/// After a tick that had to stand still, the next one sets out with this share of the share before.
/// So halving goes on from tick to tick until a step is short enough for the rows at q, and no tick
/// takes more kinematics than another.
const CAUTION: f64 = 0.125;

/// Shares of the margin that a correction aims at. Two bounds may be closer than two margins: those
/// of sets that were never entered and contradict each other.
const MARGIN_SHARES: [f64; 3] = [1.0, 0.5, 0.0625];

/// What it took to land.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Landed {
    /// Configurations of which the kinematics were computed.
    pub kinematics: usize,
    /// Corrections of the velocity.
    pub corrections: usize,
    /// Halvings of the velocity.
    pub halvings: usize,
    /// Whether no velocity was found that lands, so that the arm stands still for this period.
    pub stood_still: bool,
}

#[derive(Debug)]
pub(crate) struct Landing {
    solver: DualActiveSet,
    sides: Sides,
    bounds: Vec<f64>,
    equalities: Vec<usize>,
    change: Vec<f64>,
    /// Share of the velocity that the next tick tries first.
    caution: f64,
    period: f64,
}

/// A tick that is to be landed.
pub(crate) struct Approach<'a> {
    pub(crate) stack: &'a Stack,
    /// The robot at q, with its rows.
    pub(crate) here: &'a mut Evaluation,
    /// The robot at the trial; in the end at the point that was committed.
    pub(crate) there: &'a mut Evaluation,
    pub(crate) borders: &'a Borders,
    pub(crate) speed_limits: &'a [f64],
    pub(crate) pivots: &'a mut usize,
}

impl Landing {
    pub(crate) fn new(stack: &Stack, period: f64) -> Self {
        Self {
            solver: DualActiveSet::new(stack.dof()),
            sides: Sides::new(stack),
            bounds: Vec::with_capacity(2 * stack.len()),
            equalities: Vec::with_capacity(2 * stack.len()),
            change: alloc::vec![0.0; stack.dof()],
            caution: 1.0,
            period,
        }
    }

    /// Turns the proposed velocity `qd` into one that lands inside every bound in force. `held` are the
    /// sides to be held at their margin; `is_scaled` says that speed limits have already cut `qd`
    /// short of them.
    pub(crate) fn land(
        &mut self,
        approach: &mut Approach<'_>,
        q: &[f64],
        held: &Held,
        mut is_scaled: bool,
        qd: &mut JointVec,
        target: &mut JointVec,
    ) -> Landed {
        let mut landed = Landed::default();
        self.sides.clear();
        let mut corrections = 0;
        if self.caution < 1.0 {
            is_scaled = true;
            for speed in qd.iter_mut() {
                *speed *= self.caution;
            }
        }
        loop {
            for ((target, q), qd) in target.iter_mut().zip(q).zip(qd.iter()) {
                *target = q + self.period * qd;
            }
            landed.kinematics += 1;
            approach.there.update(approach.stack, target);
            let is_last = corrections == CORRECTIONS;
            if is_inside(approach) && (is_scaled || is_last || holds_margins(approach, held)) {
                self.caution = (2.0 * self.caution).min(1.0);
                return landed;
            }
            if !is_last && self.correct(approach, held, is_scaled, qd) {
                corrections += 1;
                landed.corrections += 1;
                is_scaled |=
                    crate::controller::scale_to_limits(qd, approach.speed_limits).is_some();
                continue;
            }
            if landed.halvings == HALVINGS {
                landed.stood_still = true;
                self.caution = (self.caution * CAUTION).max(f64::MIN_POSITIVE);
                qd.fill(0.0);
                target.copy_from_slice(q);
                return landed;
            }
            landed.halvings += 1;
            corrections = 0;
            is_scaled = true;
            for speed in qd.iter_mut() {
                *speed *= 0.5;
            }
        }
    }

    /// q̇ += the least change that repairs what the trial found. `false` if there is none.
    fn correct(
        &mut self,
        approach: &mut Approach<'_>,
        held: &Held,
        is_scaled: bool,
        qd: &mut JointVec,
    ) -> bool {
        self.gather(approach);
        self.equalities.clear();
        if !is_scaled {
            let is_held = |(i, (side, _)): (usize, (Side, _))| held.contains(side).then_some(i);
            self.equalities
                .extend(self.sides.iter().enumerate().filter_map(is_held));
        }
        // Held sides that cannot all be met may still all be kept, or kept by less.
        let attempts = [&self.equalities[..], &[], &[], &[]];
        let shares = MARGIN_SHARES[..1].iter().chain(&MARGIN_SHARES);
        for (equalities, share) in attempts.into_iter().zip(shares) {
            self.bounds.clear();
            for (side, _) in self.sides.iter() {
                let inside =
                    distance_inside(approach.borders, side, approach.there.scalar(side.task));
                self.bounds.push((share * MARGIN - inside) / self.period);
            }
            self.change.fill(0.0);
            self.solver.set_identity();
            let constraints = Constraints {
                rows: self.sides.rows(),
                bounds: &self.bounds,
                equalities,
            };
            if self
                .solver
                .solve(&mut self.change, constraints, approach.pivots)
                == Solution::Optimal
            {
                add_scaled(qd, 1.0, &self.change);
                return true;
            }
        }
        false
    }

    /// All sides of the high-priority sets, once a tick.
    fn gather(&mut self, approach: &mut Approach<'_>) {
        if self.sides.len() > 0 {
            return;
        }
        for (task, level) in approach.stack.iter() {
            let Some(set) = level.interval() else { break };
            for (is_upper, bound) in [(false, set.min), (true, set.max)] {
                if bound.is_finite() {
                    self.sides
                        .push(approach.stack, approach.here, Side { task, is_upper });
                }
            }
        }
    }
}

/// Whether every high-priority set is inside its bounds in force at the trial.
fn is_inside(approach: &Approach<'_>) -> bool {
    approach
        .stack
        .iter()
        .take_while(|(_, level)| level.interval().is_some())
        .all(|(task, _)| {
            approach
                .borders
                .interval(task)
                .contains(approach.there.scalar(task))
        })
}

/// Whether every held side is a margin inside at the trial, to half of it.
fn holds_margins(approach: &Approach<'_>, held: &Held) -> bool {
    held.tasks()
        .iter()
        .filter(|&task| approach.stack.is_high_priority(task))
        .all(|task| {
            [false, true].into_iter().all(|is_upper| {
                let side = Side { task, is_upper };
                let inside = distance_inside(approach.borders, side, approach.there.scalar(task));
                !held.contains(side) || (inside - MARGIN).abs() <= 0.5 * MARGIN
            })
        })
}
