//! The anchor of a tick: a velocity that keeps every set within the joints' limits, as near as possible
//! to rest or, where accelerations are limited, to the last velocity.
//!
//! Whatever exceeds a limit is shortened towards it. Rest itself is the anchor while it keeps every set,
//! which it does unless something in the world moves.
//!
//! If the sets cannot all be kept, first the acceleration limits give way, then the demands beyond
//! standing still: each is met as far as those of sets further up in the list leave it possible.

use alloc::vec::Vec;

use crate::barrier::Barrier;
use crate::joints::JointVec;
use crate::limits::Limits;
use crate::linalg::{Constraints, DualActiveSet, Solution, add_scaled, clear, dot};
use crate::real::sqrt;

/// ε: how much a demand that cannot be met in full yields to a smaller velocity [(unit/rad)²].
const SOFT: f64 = 1e-6;

/// What was met must be feasible beyond doubt in the programs that follow.
const ROUNDING: f64 = 1e-9;

#[derive(Debug)]
pub(crate) struct Anchor {
    solver: DualActiveSet,
    velocity: JointVec,
    /// Rows and bounds of the barrier, then those of the joints' ranges.
    rows: Vec<f64>,
    bounds: Vec<f64>,
    /// Sides that ask for more than standing still.
    demands: Vec<(usize, f64)>,
}

/// What a tick works on.
pub(crate) struct AnchorTick<'a> {
    pub(crate) barrier: &'a mut Barrier,
    pub(crate) limits: &'a Limits,
    /// The last velocity [rad/s or m/s].
    pub(crate) before: &'a [f64],
    pub(crate) pivots: &'a mut usize,
}

impl Anchor {
    pub(crate) fn new(dof: usize, sides: usize) -> Self {
        Self {
            solver: DualActiveSet::new(dof),
            velocity: JointVec::zeros(dof),
            rows: Vec::with_capacity((sides + 2 * dof) * dof),
            bounds: Vec::with_capacity(sides + 2 * dof),
            demands: Vec::with_capacity(sides),
        }
    }

    /// The anchor of this tick [rad/s or m/s].
    pub(crate) fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Rest.
    pub(crate) fn rest(&mut self) {
        clear(&mut self.velocity);
    }

    /// Finds the anchor, and turns what the barrier demands and wishes into what can be met.
    pub(crate) fn find(&mut self, tick: &mut AnchorTick<'_>) {
        let limited = tick.limits.has_acceleration();
        self.rest();
        if limited {
            self.velocity.copy_from_slice(tick.before);
        }
        if !tick.barrier.allows(&self.velocity) {
            let met =
                (limited && self.approach(tick, Some(tick.before))) || self.approach(tick, None);
            if !met {
                self.relax(tick);
            }
        }
        for k in 0..tick.barrier.wishes.len() {
            let (side, rate) = tick.barrier.wishes[k];
            self.raise(tick, side, rate);
        }
    }

    /// Demands beyond standing still, one after the other.
    fn relax(&mut self, tick: &mut AnchorTick<'_>) {
        self.demands.clear();
        for (side, bound) in tick.barrier.bounds.iter_mut().enumerate() {
            if *bound > 0.0 {
                self.demands.push((side, *bound));
                *bound = 0.0;
            }
        }
        self.velocity.fill(0.0);
        for k in 0..self.demands.len() {
            let (side, demand) = self.demands[k];
            self.raise(tick, side, demand);
        }
    }

    /// Raises the bound of a side to `demand`, or as near to it as the others allow:
    /// min |a q̇ − demand|² + ε |q̇|² under all others.
    fn raise(&mut self, tick: &mut AnchorTick<'_>, side: usize, demand: f64) {
        let dof = self.velocity.len();
        if tick.barrier.bounds[side] >= demand {
            return;
        }
        self.gather(tick, None);
        let row = &self.rows[side * dof..][..dof];
        let squared = dot(row, row);
        let mut velocity = JointVec::zeros(dof);
        add_scaled(&mut velocity, demand / (squared + SOFT), row);
        // H = a aᵀ + ε I, and B = H^(−1/2).
        let along = (sqrt(SOFT / (squared + SOFT)) - 1.0) / squared;
        let basis = self.solver.basis_mut(dof);
        for (i, direction) in basis.chunks_exact_mut(dof).enumerate() {
            direction.fill(0.0);
            direction[i] = 1.0;
            if squared > 0.0 {
                add_scaled(direction, along * row[i], row);
            }
            for entry in direction {
                *entry /= sqrt(SOFT);
            }
        }
        if self.solve(&mut velocity, tick.pivots) {
            let rate = dot(&self.rows[side * dof..][..dof], &velocity);
            tick.barrier.bounds[side] = demand.min(rate - ROUNDING * rate.abs());
            self.velocity = velocity;
        }
    }

    /// The velocity nearest to rest, or to the last one, that keeps the barrier and the joints' ranges.
    /// `false`, and none, if there is none.
    fn approach(&mut self, tick: &mut AnchorTick<'_>, before: Option<&[f64]>) -> bool {
        self.gather(tick, before);
        let mut velocity = JointVec::zeros(self.velocity.len());
        if tick.limits.has_acceleration() {
            velocity.copy_from_slice(tick.before);
        }
        self.solver.set_identity();
        let met = self.solve(&mut velocity, tick.pivots);
        if met {
            self.velocity = velocity;
        }
        met
    }

    /// Rows of the barrier, then those of the joints' ranges.
    fn gather(&mut self, tick: &AnchorTick<'_>, before: Option<&[f64]>) {
        self.rows.clear();
        self.bounds.clear();
        self.rows.extend_from_slice(tick.barrier.sides.rows());
        self.bounds.extend_from_slice(&tick.barrier.bounds);
        tick.limits
            .push_rows(before, &mut self.rows, &mut self.bounds);
    }

    fn solve(&mut self, velocity: &mut [f64], pivots: &mut usize) -> bool {
        let constraints = Constraints {
            rows: &self.rows,
            bounds: &self.bounds,
            equalities: &[],
        };
        self.solver.solve(velocity, constraints, pivots) == Solution::Optimal
    }
}
