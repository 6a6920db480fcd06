//! Strictly convex quadratic programs, by the dual active-set method of Goldfarb and Idnani (1983).
//!
//! ```text
//! min ½ (x − x₀)ᵀ H (x − x₀)   over   x = x₀ + span(B)   subject to   aᵢ x ≥ bᵢ  (for some i: =)
//! ```
//!
//! The weight H never appears: it is given by B, rows that are orthonormal in it, B H Bᵀ = I. So the
//! same code serves H = I on the null space of the levels above, and the damped Hessian of a level.
//! Starting from the free minimiser x₀, the most violated row is added at a time; a row whose
//! multiplier would turn negative on the way is dropped. Each pivot raises the dual objective, so
//! the method is finite; the number of pivots is capped all the same.

use alloc::vec::Vec;

use super::{add_scaled, dot};
use crate::real::sqrt;

/// A row counts as violated below this [unit/s].
pub(crate) const VIOLATION: f64 = 1e-11;

/// A row of which less than this share is left beside the active ones depends on them.
const DEPENDENT: f64 = 1e-9;

/// One-sided rows aᵢ x ≥ bᵢ, some of them two-sided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Constraints<'a> {
    /// The aᵢ, one after the other.
    pub(crate) rows: &'a [f64],
    pub(crate) bounds: &'a [f64],
    /// Indices of the rows that are to hold with equality.
    pub(crate) equalities: &'a [usize],
}

/// How a solution ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Solution {
    Optimal,
    /// No x satisfies all rows.
    Infeasible,
    /// The cap on pivots was reached.
    OutOfPivots,
}

#[derive(Debug)]
pub(crate) struct DualActiveSet {
    /// B, turned so that the first rows span what the active rows use up.
    basis: Vec<f64>,
    /// Upper triangle: column k holds the shares of active row k in the first rows of the basis.
    factor: Vec<f64>,
    active: Vec<usize>,
    multipliers: Vec<f64>,
    /// Shares of the row at hand in the basis.
    shares: Vec<f64>,
    /// Change of the multipliers along the step at hand, and scratch of the same size.
    slope: Vec<f64>,
    scratch: Vec<f64>,
    /// Whether the basis is still to be turned for the row that became active last.
    is_turn_due: bool,
    dof: usize,
    dimension: usize,
}

impl DualActiveSet {
    pub(crate) fn new(dof: usize) -> Self {
        Self {
            basis: alloc::vec![0.0; dof * dof],
            factor: alloc::vec![0.0; dof * dof],
            active: Vec::with_capacity(dof),
            multipliers: alloc::vec![0.0; dof + 1],
            shares: alloc::vec![0.0; dof],
            slope: alloc::vec![0.0; dof],
            scratch: alloc::vec![0.0; dof],
            is_turn_due: false,
            dof,
            dimension: 0,
        }
    }

    /// H = I on the whole space.
    pub(crate) fn set_identity(&mut self) {
        self.dimension = self.dof;
        self.basis.fill(0.0);
        for k in 0..self.dof {
            self.basis[k * self.dof + k] = 1.0;
        }
    }

    /// Room for `dimension` rows of B, to be filled by the caller.
    pub(crate) fn basis_mut(&mut self, dimension: usize) -> &mut [f64] {
        self.dimension = dimension;
        &mut self.basis[..dimension * self.dof]
    }

    /// Indices of the rows that hold with equality, in the order in which they were added.
    pub(crate) fn active(&self) -> &[usize] {
        &self.active
    }

    /// Multipliers of the active rows.
    pub(crate) fn multipliers(&self) -> &[f64] {
        &self.multipliers[..self.active.len()]
    }

    /// How far beyond its bound an active row would go [unit/s] if it alone were let go: its multiplier
    /// over the diagonal of (A H⁻¹ Aᵀ)⁻¹.
    pub(crate) fn rate_if_released(&mut self, k: usize) -> f64 {
        let rank = self.active.len();
        // w = R⁻ᵀ eₖ, forward; the diagonal is |w|².
        for j in 0..rank {
            let known: f64 = (0..j)
                .map(|i| self.factor[j * self.dof + i] * self.scratch[i])
                .sum();
            let unit = if j == k { 1.0 } else { 0.0 };
            self.scratch[j] = (unit - known) / self.factor[j * self.dof + j];
        }
        let row = &self.scratch[..rank];
        self.multipliers[k] / dot(row, row)
    }

    /// Turns `x` from the free minimiser into the constrained one. `pivots` is what is left of the
    /// cap. The basis must have been set since the last call, which uses it up.
    pub(crate) fn solve(
        &mut self,
        x: &mut [f64],
        constraints: Constraints<'_>,
        pivots: &mut usize,
    ) -> Solution {
        self.active.clear();
        self.is_turn_due = false;
        for &i in constraints.equalities {
            match self.enter(x, constraints, i, pivots) {
                Solution::Optimal => {}
                failed => return failed,
            }
        }
        while let Some(i) = self.most_violated(x, constraints) {
            match self.enter(x, constraints, i, pivots) {
                Solution::Optimal => {}
                failed => return failed,
            }
        }
        Solution::Optimal
    }

    fn most_violated(&self, x: &[f64], constraints: Constraints<'_>) -> Option<usize> {
        let mut worst = (None, -VIOLATION);
        for i in 0..constraints.bounds.len() {
            let slack = self.slack(x, constraints, i);
            if slack < worst.1 && !self.active.contains(&i) {
                worst = (Some(i), slack);
            }
        }
        worst.0
    }

    fn slack(&self, x: &[f64], constraints: Constraints<'_>, i: usize) -> f64 {
        dot(&constraints.rows[i * self.dof..][..self.dof], x) - constraints.bounds[i]
    }

    /// Moves x until row `entering` holds with equality, dropping what stands in the way.
    fn enter(
        &mut self,
        x: &mut [f64],
        constraints: Constraints<'_>,
        entering: usize,
        pivots: &mut usize,
    ) -> Solution {
        self.turn();
        let row = &constraints.rows[entering * self.dof..][..self.dof];
        // An equality that is exceeded is approached from the other side.
        let sign = if constraints.equalities.contains(&entering)
            && self.slack(x, constraints, entering) > 0.0
        {
            -1.0
        } else {
            1.0
        };
        let mut multiplier = 0.0;
        loop {
            if *pivots == 0 {
                return Solution::OutOfPivots;
            }
            *pivots -= 1;
            let rank = self.active.len();
            for (share, basis) in self.shares[..self.dimension]
                .iter_mut()
                .zip(self.basis.chunks_exact(self.dof))
            {
                *share = sign * dot(basis, row);
            }
            let free = &self.shares[rank..self.dimension];
            let all = &self.shares[..self.dimension];
            let free_squared = dot(free, free);
            let is_dependent = !(free_squared > DEPENDENT * DEPENDENT * dot(all, all));
            self.solve_triangle(rank);
            let blocking = self.blocking(constraints.equalities);
            let slack = sign * self.slack(x, constraints, entering);
            let full = if is_dependent {
                f64::INFINITY
            } else {
                -slack / free_squared
            };
            let partial = blocking.map_or(f64::INFINITY, |(_, step)| step);
            let step = full.min(partial);
            if step == f64::INFINITY {
                // A row that depends on the active ones cannot be met if they do not meet it.
                return if slack.abs() <= VIOLATION {
                    Solution::Optimal
                } else {
                    Solution::Infeasible
                };
            }
            if !is_dependent {
                for (basis, share) in self
                    .basis
                    .chunks_exact(self.dof)
                    .take(self.dimension)
                    .zip(&self.shares)
                    .skip(rank)
                {
                    add_scaled(x, step * share, basis);
                }
            }
            add_scaled(&mut self.multipliers[..rank], -step, &self.slope[..rank]);
            multiplier += step;
            if full <= partial {
                self.append(entering, sign * multiplier, sign);
                return Solution::Optimal;
            }
            if let Some((leaving, _)) = blocking {
                self.remove(leaving);
            }
        }
    }

    /// slope ← R⁻¹ shares, backward.
    fn solve_triangle(&mut self, rank: usize) {
        for k in (0..rank).rev() {
            let known: f64 = (k + 1..rank)
                .map(|j| self.factor[j * self.dof + k] * self.slope[j])
                .sum();
            self.slope[k] = (self.shares[k] - known) / self.factor[k * self.dof + k];
        }
    }

    /// The one-sided active row whose multiplier is the first to reach zero, and at which step.
    fn blocking(&self, equalities: &[usize]) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for (k, &index) in self.active.iter().enumerate() {
            if self.slope[k] > 0.0 && !equalities.contains(&index) {
                let step = self.multipliers[k] / self.slope[k];
                if first.is_none_or(|(_, least)| step < least) {
                    first = Some((k, step));
                }
            }
        }
        first
    }

    /// Makes the row at hand active: a reflection is to turn the free part of the basis until its share
    /// in all but the first of those rows is zero.
    fn append(&mut self, index: usize, multiplier: f64, sign: f64) {
        let (dof, rank) = (self.dof, self.active.len());
        let free = &mut self.shares[rank..self.dimension];
        let length = sqrt(dot(free, free));
        let head = if free[0] > 0.0 { -length } else { length };
        free[0] -= head;
        self.is_turn_due = true;
        // The factor is that of the row itself, not of its mirror image.
        let column = &mut self.factor[rank * dof..][..dof];
        for (entry, share) in column.iter_mut().zip(&self.shares[..rank]) {
            *entry = sign * share;
        }
        column[rank] = sign * head;
        self.active.push(index);
        self.multipliers[rank] = multiplier;
    }

    /// The reflection that is due for the row that became active last. No other row need follow, and then
    /// it is never done.
    fn turn(&mut self) {
        if !core::mem::take(&mut self.is_turn_due) {
            return;
        }
        let (dof, rank) = (self.dof, self.active.len() - 1);
        let free = &self.shares[rank..self.dimension];
        let squared = dot(free, free);
        if squared > 0.0 {
            let rows = &mut self.basis[rank * dof..self.dimension * dof];
            self.scratch.fill(0.0);
            for (row, share) in rows.chunks_exact(dof).zip(free) {
                add_scaled(&mut self.scratch, *share, row);
            }
            for (row, share) in rows.chunks_exact_mut(dof).zip(free) {
                add_scaled(row, -2.0 / squared * share, &self.scratch);
            }
        }
    }

    /// Drops the active row at place `k`; rotations make the factor triangular again.
    fn remove(&mut self, k: usize) {
        let (dof, rank) = (self.dof, self.active.len());
        self.active.remove(k);
        self.multipliers.copy_within(k + 1..rank, k);
        for j in k + 1..rank {
            self.factor
                .copy_within(j * dof..j * dof + dof, (j - 1) * dof);
        }
        for j in k..rank - 1 {
            let (a, b) = (self.factor[j * dof + j], self.factor[j * dof + j + 1]);
            let length = sqrt(a * a + b * b);
            let (cos, sin) = (a / length, b / length);
            for column in j..rank - 1 {
                let (a, b) = (
                    self.factor[column * dof + j],
                    self.factor[column * dof + j + 1],
                );
                self.factor[column * dof + j] = cos * a + sin * b;
                self.factor[column * dof + j + 1] = cos * b - sin * a;
            }
            let (upper, lower) = self.basis.split_at_mut((j + 1) * dof);
            for (a, b) in upper[j * dof..].iter_mut().zip(&mut lower[..dof]) {
                (*a, *b) = (cos * *a + sin * *b, cos * *b - sin * *a);
            }
        }
    }
}

#[cfg(test)]
mod tests;
