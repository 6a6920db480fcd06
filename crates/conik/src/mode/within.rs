//! The levels within the joints' ranges, where accelerations are limited.
//!
//! The program of a level (see `level`) knows no limits of joints: its answer w is what the level would
//! have without them. Here follows what it has, v. Both begin above the first level, w at rest and v at
//! the anchor, which keeps every set and every range.
//!
//! ```text
//! x := w + N (v − w)                    N: on motions that change no row of this level or of one above
//! x := v + f (x − v)                    the largest f ≤ 1 for which no joint accelerates too hard
//! v := argmin |J (v' − x)|² + |v' − x|²_R
//!      over v' = v + motions that the levels above have left free
//!      subject to a v' ≥ b for every side of a high-priority set, and to every joint's range
//! w := v + N (w − v)                    what the levels below go on from
//! ```
//!
//! So a level loses what it asks for to sets, to ranges and to levels above, and never to one below. What it
//! cannot have because the joints accelerate too slowly is shortened along itself, and not bent; only
//! where sets or levels above have used up part of a range is it bent, as little as may be. (All that could be had
//! within the ranges would be more, but takes every joint to the end of its range, and leaves
//! nothing to brake with.) Almost always x keeps everything, and v is x.
//!
//! In the end, motions that no level asks for go from those of v to those of w, shortened likewise. Where no
//! range binds, what comes out is w.
//!
//! R is l₀² I, and motions that are dear to the levels above (see `claims`) are dear here too.

use alloc::vec::Vec;

use super::claims::Claims;
use crate::barrier::Barrier;
use crate::joints::JointVec;
use crate::linalg::{
    Constraints, Damped, DualActiveSet, RowSpace, Solution, VIOLATION, add_scaled, copy, dot,
};
use crate::ranges::{Cut, Ranges};
use crate::stack::Stack;

#[derive(Debug)]
pub(super) struct Within {
    solver: DualActiveSet,
    damped: Damped,
    /// v and w of the levels so far.
    velocity: JointVec,
    wanted: JointVec,
    /// Rows of the sides, then those of the ranges, and their bounds.
    rows: Vec<f64>,
    bounds: Vec<f64>,
    /// J, and the motions that are dear to the levels above.
    weighted: Vec<f64>,
    /// Rows of the levels so far.
    taken: RowSpace,
    /// Orthonormal rows that span the free motions.
    free: Vec<f64>,
    /// By which joints the first level was cut short that was.
    cut: Cut,
    is_cut: bool,
    dof: usize,
}

/// A level that has its turn.
pub(super) struct Turn<'a> {
    /// J, row after row.
    pub(super) jacobian: &'a [f64],
    /// What the levels above have claimed.
    pub(super) above: &'a Claims,
    pub(super) barrier: &'a Barrier,
    pub(super) ranges: &'a Ranges,
}

impl Within {
    pub(super) fn new(stack: &Stack, max_rows: usize) -> Self {
        let dof = stack.dof();
        Self {
            solver: DualActiveSet::new(dof),
            damped: Damped::new(dof, 0),
            velocity: JointVec::zeros(dof),
            wanted: JointVec::zeros(dof),
            rows: Vec::with_capacity(2 * (stack.len() + dof) * dof),
            bounds: Vec::with_capacity(2 * (stack.len() + dof)),
            weighted: Vec::with_capacity((max_rows + stack.len() * dof) * dof),
            taken: RowSpace::new(dof, max_rows),
            free: alloc::vec![0.0; dof * dof],
            cut: Cut::default(),
            is_cut: false,
            dof,
        }
    }

    /// Above the first level.
    pub(super) fn begin(&mut self, ranges: &Ranges) {
        self.velocity.copy_from_slice(ranges.anchor());
        self.wanted.fill(0.0);
        self.taken.truncate(0);
        self.cut = Cut::default();
        self.is_cut = false;
    }

    /// v of the levels so far [rad/s].
    pub(super) fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// The joints that cut a level short; `None` if none was cut short.
    pub(super) fn cut(&self) -> Option<Cut> {
        self.is_cut.then_some(self.cut)
    }

    /// One level further down. `wanted` is its w, and becomes what the levels below go on from. If the
    /// program has no answer, that of the levels above stands.
    pub(super) fn follow(&mut self, turn: &Turn<'_>, wanted: &mut [f64], pivots: &mut usize) {
        let by_speed = turn.ranges.shorten_to_speed(&self.wanted, wanted);
        self.taken.copy_from(turn.above.rows());
        self.taken.push_block(turn.jacobian);
        let mut aim = self.between(wanted, &self.velocity);
        self.gather(turn.barrier, turn.ranges);
        if by_speed.is_some() || !self.keeps_all(&aim) {
            self.note_cut(turn.ranges, &aim);
            self.cut.by_speed = self.cut.by_speed.or(by_speed);
        }
        self.shorten(turn.ranges, &mut aim);
        if !self.keeps_all(&aim) && !self.approach(turn, &mut aim, pivots) {
            self.taken.copy_from(turn.above.rows());
            copy(wanted, &self.wanted);
            return;
        }
        self.velocity = aim;
        self.wanted = self.between(&aim, wanted);
        copy(wanted, &self.wanted);
    }

    /// Below the last level: what no level asks for. `velocity` becomes that of the tick.
    pub(super) fn finish(
        &mut self,
        barrier: &Barrier,
        ranges: &Ranges,
        velocity: &mut [f64],
        pivots: &mut usize,
    ) {
        self.gather(barrier, ranges);
        let mut aim = self.between(&self.velocity, &self.wanted);
        if !self.keeps_all(&aim) {
            self.note_cut(ranges, &aim);
            self.shorten(ranges, &mut aim);
        }
        if self.keeps_all(&aim) || self.settle(&mut aim, pivots) {
            self.velocity = aim;
        }
        ranges.clamp(&mut self.velocity);
        copy(velocity, &self.velocity);
    }

    /// As `rows` where a level so far asks for something, as `others` where none does.
    fn between(&self, rows: &[f64], others: &[f64]) -> JointVec {
        let mut velocity = JointVec::zeros(self.dof);
        for ((entry, other), row) in velocity.iter_mut().zip(others).zip(rows) {
            *entry = other - row;
        }
        // Twice is enough.
        for _ in 0..2 {
            self.taken.project_out(&mut velocity);
        }
        add_scaled(&mut velocity, 1.0, rows);
        velocity
    }

    fn shorten(&self, ranges: &Ranges, aim: &mut JointVec) {
        let reach = ranges.reach(&self.velocity, aim);
        if reach < 1.0 {
            for (speed, from) in aim.iter_mut().zip(self.velocity.iter()) {
                *speed = from + reach * (*speed - from);
            }
        }
    }

    fn note_cut(&mut self, ranges: &Ranges, aim: &JointVec) {
        if !self.is_cut {
            self.cut = ranges.cut(&self.velocity, aim);
            self.is_cut = true;
        }
    }

    /// Rows of the sides, then those of the ranges.
    fn gather(&mut self, barrier: &Barrier, ranges: &Ranges) {
        self.rows.clear();
        self.bounds.clear();
        self.rows.extend_from_slice(barrier.sides.rows());
        self.bounds.extend_from_slice(&barrier.bounds);
        ranges.push_rows(&mut self.rows, &mut self.bounds);
    }

    fn keeps_all(&self, velocity: &[f64]) -> bool {
        let rows = self.rows.chunks_exact(self.dof).zip(&self.bounds);
        rows.fold(true, |keeps, (row, bound)| {
            keeps && dot(row, velocity) >= *bound - VIOLATION
        })
    }

    /// Turns `aim` into the nearest that keeps everything, rates of the level first.
    fn approach(&mut self, turn: &Turn<'_>, aim: &mut JointVec, pivots: &mut usize) -> bool {
        self.weighted.clear();
        self.weighted.extend_from_slice(turn.jacobian);
        self.weighted.extend_from_slice(turn.above.dear());
        let dimension = turn.above.rows().complement(&mut self.free);
        let free = &self.free[..dimension * self.dof];
        let basis = self.solver.basis_mut(dimension);
        self.damped
            .weighted_basis(&self.weighted, 0.0, &[], free, basis);
        self.solve(aim, pivots)
    }

    /// Turns `aim` into the nearest that keeps everything and moves no row of a level.
    fn settle(&mut self, aim: &mut JointVec, pivots: &mut usize) -> bool {
        let dimension = self.taken.complement(&mut self.free);
        let free = &self.free[..dimension * self.dof];
        self.solver.basis_mut(dimension).copy_from_slice(free);
        self.solve(aim, pivots)
    }

    fn solve(&mut self, aim: &mut JointVec, pivots: &mut usize) -> bool {
        let constraints = Constraints {
            rows: &self.rows,
            bounds: &self.bounds,
            equalities: &[],
        };
        self.solver.solve(aim, constraints, pivots) == Solution::Optimal
    }
}
