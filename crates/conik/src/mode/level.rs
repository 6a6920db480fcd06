//! One level of the rule `cone`: a small strictly convex quadratic program.
//!
//! ```text
//! siciliano-slotine   min |J q̇ − s|² + |q̇ − q̇₀|²_R          s: what the task asks, σ̇_ref
//! chiaverini          min |q̇ − q̇₀ − N J⁺ s|²                q̇₀: the velocity of the levels above
//!                     over q̇ = q̇₀ + motions that the levels above have left free
//!                     subject to a q̇ ≥ b for every side of a high-priority set
//! ```
//!
//! R is the damping of [`Damped`], with λ² = T (l |s| + Σ μ c): near a point where the arm comes to
//! rest, a tick is a gradient step, and it is stable only if the damping exceeds half a period times
//! the curvature of what holds it there. |s| stands for the curvature of the task, with l = 1 m for
//! the reach of the arm; a set that pushes back with multiplier μ adds its own, μ c. Below other levels
//! λ² is at least `LOWER`: their rows push back too, and near a singularity of theirs very hard.

use alloc::vec::Vec;

use super::claims::Claims;
use crate::damping::Damping;
use crate::linalg::{
    Constraints, Damped, DualActiveSet, HeldFit, HeldProblem, MinimumNorm, RowSpace, Solution,
    VIOLATION, add_scaled, copy, dot,
};
use crate::real::sqrt;
use crate::settings::{Recursion, Settings};
use crate::sides::{Held, Sides};
use crate::stack::Stack;

/// Least λ² of a level below others: that of ε [(task's unit per rad)²].
const LOWER: f64 = 0.04;

#[derive(Debug)]
pub(crate) struct LevelProgram {
    recursion: Recursion,
    period: f64,
    solver: DualActiveSet,
    damped: Damped,
    held_fit: HeldFit,
    minimum_norm: MinimumNorm,
    /// The answer.
    velocity: Vec<f64>,
    /// The sides, by index, that bind in it, with their multipliers.
    binding: Vec<(usize, f64)>,
    /// Whether it came from `held_fit`, not from `solver`.
    is_held_fit: bool,
    /// J, or J N and the motions that are dear to the levels above.
    rows: Vec<f64>,
    /// What of J N is left beside the held sides.
    usable: Vec<f64>,
    /// s, or s − J q̇₀ and none of those.
    gap: Vec<f64>,
    /// Rows of the levels above and of the held sides.
    taken: RowSpace,
    /// The held sides, by index, of which a row was taken.
    held: Vec<usize>,
    /// Orthonormal rows that span the free motions.
    free: Vec<f64>,
    dof: usize,
}

/// What a level works on.
pub(crate) struct Level<'a> {
    /// J, row after row.
    pub(crate) jacobian: &'a [f64],
    /// s [task's unit/s].
    pub(crate) asked: &'a [f64],
    /// q̇₀ [rad/s].
    pub(crate) from: &'a [f64],
    /// What the levels above have claimed.
    pub(crate) above: &'a Claims,
    pub(crate) sides: &'a Sides,
    /// b, one for each side.
    pub(crate) bounds: &'a [f64],
    /// Σ μ c [task's unit/s].
    pub(crate) push_back: f64,
    /// How many times its estimate λ² is to be.
    pub(crate) stiffening: f64,
    pub(crate) damping: Damping,
}

impl LevelProgram {
    pub(crate) fn new(stack: &Stack, settings: &Settings) -> Self {
        let dof = stack.dof();
        let max_rows = stack
            .iter()
            .map(|(_, l)| l.task().dimension())
            .max()
            .unwrap_or(1);
        Self {
            recursion: settings.recursion,
            period: 1.0 / settings.rate_hz,
            solver: DualActiveSet::new(dof),
            damped: Damped::new(dof, max_rows),
            held_fit: HeldFit::new(dof, max_rows),
            minimum_norm: MinimumNorm::new(dof, max_rows),
            velocity: alloc::vec![0.0; dof],
            binding: Vec::with_capacity(dof),
            is_held_fit: false,
            rows: Vec::with_capacity((max_rows + stack.len() * dof) * dof),
            usable: Vec::with_capacity(max_rows * dof),
            gap: Vec::with_capacity(max_rows + stack.len() * dof),
            taken: RowSpace::new(dof, max_rows),
            held: Vec::with_capacity(dof),
            free: alloc::vec![0.0; dof * dof],
            dof,
        }
    }

    /// Solves the program. `held` are the sides that the damping may count on to be held, `equal` the
    /// sides, by index, that are to be held whatever the task asks.
    pub(crate) fn solve(
        &mut self,
        level: &Level<'_>,
        held: &Held,
        equal: &[usize],
        pivots: &mut usize,
    ) -> Solution {
        self.binding.clear();
        self.is_held_fit = false;
        self.rows.clear();
        self.rows.extend_from_slice(level.jacobian);
        self.gap.clear();
        self.gap.extend_from_slice(level.asked);
        copy(&mut self.velocity, level.from);
        match self.recursion {
            Recursion::Chiaverini => self.project(level),
            Recursion::SicilianoSlotine => {
                if self.fit(level, held, !equal.is_empty()) {
                    return Solution::Optimal;
                }
            }
        }
        let constraints = Constraints {
            rows: level.sides.rows(),
            bounds: level.bounds,
            equalities: equal,
        };
        let solution = self.solver.solve(&mut self.velocity, constraints, pivots);
        let multipliers = self.solver.multipliers().iter().copied();
        self.binding
            .extend(self.solver.active().iter().copied().zip(multipliers));
        solution
    }

    /// How many directions of the task's the level had lost, or was about to, in the last solution.
    pub(crate) fn lost(&self) -> usize {
        self.damped.lost()
    }

    /// The velocity of the last solution [rad/s].
    pub(crate) fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// The sides, by index, that bind in the last solution, with their multipliers.
    pub(crate) fn binding(&self) -> impl Iterator<Item = (usize, f64)> {
        self.binding.iter().copied()
    }

    /// How far beyond its bound each binding side would go [unit/s] if it alone were let go, in the order
    /// of [`binding`](Self::binding).
    pub(crate) fn crossings(&mut self) -> impl Iterator<Item = (usize, f64)> {
        let (rank, count) = (self.binding.len(), self.gap.len());
        (0..rank).map(move |k| {
            let rate = if self.is_held_fit {
                self.held_fit
                    .rate_if_released(k, rank, count, &mut self.damped)
            } else {
                self.solver.rate_if_released(k)
            };
            (self.binding[k].0, rate)
        })
    }

    /// Siciliano and Slotine's recursion: the free minimiser, and a basis in its weight. `true` if the
    /// minimiser already keeps every side; the basis is then not there.
    fn fit(&mut self, level: &Level<'_>, held: &Held, must_hold: bool) -> bool {
        for (gap, row) in self
            .gap
            .iter_mut()
            .zip(self.rows.chunks_exact_mut(self.dof))
        {
            *gap -= dot(row, level.from);
            level.above.rows().project_out(row);
        }
        self.take_held(level, held);
        let is_fixed = matches!(level.damping, Damping::Fixed(_));
        let has_closed_form = !must_hold && !is_fixed && level.above.dear().is_empty();
        if has_closed_form && self.fit_held(level) {
            return true;
        }
        copy(&mut self.velocity, level.from);
        let asked = sqrt(dot(level.asked, level.asked));
        let damping = level
            .damping
            .or_else(Damping::of_cone(Recursion::SicilianoSlotine));
        self.rows.extend_from_slice(level.above.dear());
        self.gap.resize(self.rows.len() / self.dof, 0.0);
        let least = if level.above.rows().rank() == 0 {
            0.0
        } else {
            LOWER
        };
        let to_rest = self.period * (asked + level.push_back);
        let lambda_squared = damping.lambda_squared(level.stiffening * to_rest.max(least));
        self.damped.analyse(damping, &self.usable);
        let dimension = level.above.rows().complement(&mut self.free);
        let free = &self.free[..dimension * self.dof];
        let taken = self.taken.basis_from(level.above.rows().rank());
        let basis = self.solver.basis_mut(dimension);
        self.damped
            .weighted_basis(&self.rows, lambda_squared, taken, free, basis);
        // H⁻¹ = BᵀB on the free motions, so the minimiser is q̇₀ + BᵀB Jᵀ gap.
        for direction in basis.chunks_exact(self.dof) {
            let pull: f64 = self
                .rows
                .chunks_exact(self.dof)
                .zip(&self.gap)
                .map(|(row, gap)| dot(direction, row) * gap)
                .sum();
            add_scaled(&mut self.velocity, pull, direction);
        }
        false
    }

    /// taken ← rows of the levels above and of the held sides; usable ← what of J N is left.
    fn take_held(&mut self, level: &Level<'_>, held: &Held) {
        self.taken.copy_from(level.above.rows());
        self.held.clear();
        for (i, (side, row)) in level.sides.iter().enumerate() {
            if held.contains(side) && self.taken.push(row) {
                self.held.push(i);
            }
        }
        self.usable.clear();
        self.usable.extend_from_slice(&self.rows);
        if !self.held.is_empty() {
            for row in self.usable.chunks_exact_mut(self.dof) {
                self.taken.project_out(row);
            }
        }
    }

    /// The usual tick: what was held binds, and nothing else. `true` if that is so, and the velocity
    /// then the solution: there is one only, and it is the one that satisfies the conditions for it.
    fn fit_held(&mut self, level: &Level<'_>) -> bool {
        let problem = HeldProblem {
            rows: &self.rows,
            usable: &self.usable,
            gap: &self.gap,
            orthonormal: self.taken.basis_from(level.above.rows().rank()),
            held: &self.held,
            sides: level.sides.rows(),
            bounds: level.bounds,
        };
        let is_solution = self
            .held_fit
            .solve(problem, &mut self.damped, &mut self.velocity)
            && keeps_every_side(level, &self.velocity);
        self.is_held_fit = is_solution;
        if is_solution {
            let multipliers = self.held_fit.multipliers().iter().copied();
            self.binding
                .extend(self.held.iter().copied().zip(multipliers));
        }
        is_solution
    }

    /// Chiaverini's recursion: q̇₀ + N J⁺ s, and an orthonormal basis.
    fn project(&mut self, level: &Level<'_>) {
        let mut motion = [0.0; crate::MAX_JOINTS];
        let motion = &mut motion[..self.dof];
        let damping = level
            .damping
            .or_else(Damping::of_cone(Recursion::Chiaverini));
        let is_fixed = matches!(damping, Damping::Fixed(_));
        let is_regular = self.damped.is_regular(&self.rows);
        if damping == Damping::None || (is_regular && !is_fixed) {
            self.minimum_norm.solve(&self.rows, &self.gap, motion);
        } else {
            let variable = self.period * sqrt(dot(&self.gap, &self.gap));
            self.damped
                .add(damping, &self.rows, &self.gap, variable, motion);
        }
        // Near a singularity the motion may be much longer than what is left of it: twice is enough.
        for _ in 0..2 {
            level.above.rows().project_out(motion);
        }
        add_scaled(&mut self.velocity, 1.0, motion);
        let dimension = level.above.rows().complement(&mut self.free);
        self.solver
            .basis_mut(dimension)
            .copy_from_slice(&self.free[..dimension * self.dof]);
    }
}

fn keeps_every_side(level: &Level<'_>, velocity: &[f64]) -> bool {
    level
        .sides
        .iter()
        .zip(level.bounds)
        .all(|((_, row), bound)| dot(row, velocity) >= *bound - VIOLATION)
}
