//! Damped least squares under rows that are held, where nothing needs damping: in closed form.
//!
//! ```text
//! min ½ |A z − g|² + ½ zᵀ R z   subject to   hᵢ z = βᵢ
//! ```
//!
//! R is that of [`Damped`](super::Damped), and what of A is left beside the held rows, U, has no
//! singular value below ε. R is then l₀² I on all that z needs. With H = L Q, Q orthonormal and L
//! lower triangular,
//!
//! ```text
//! z = Qᵀ y + Uᵀ w ,   L y = β ,   (U Uᵀ + l₀² I) w = g − A Qᵀ y
//! ```
//!
//! and since A z − g = −l₀² w, the multipliers μ of the held rows follow from
//! Lᵀ μ = Q (Aᵀ (A z − g) + R z) = l₀² (y − Q Aᵀ w). As a function of β alone the objective has the
//! second derivative L⁻ᵀ K L⁻¹, K = l₀² (I + Q Aᵀ (U Uᵀ + l₀² I)⁻¹ A Qᵀ).

use alloc::vec::Vec;

use super::damped::{Damped, STRICT};
use super::{add_scaled, copy, dot};

#[derive(Debug)]
pub(crate) struct HeldFit {
    /// Shares of the held rows in Q: row i of L begins at i · dof.
    factor: Vec<f64>,
    /// Shares of the rows of A in Q, Q's row by Q's row.
    shares: Vec<f64>,
    y: Vec<f64>,
    /// g − A Qᵀ y
    gap: Vec<f64>,
    multipliers: Vec<f64>,
    /// A column of L⁻¹, and what A makes of it.
    column: Vec<f64>,
    image: Vec<f64>,
    dof: usize,
}

/// The problem.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeldProblem<'a> {
    /// A, row after row.
    pub(crate) rows: &'a [f64],
    /// U, row after row.
    pub(crate) usable: &'a [f64],
    /// g
    pub(crate) gap: &'a [f64],
    /// Q
    pub(crate) orthonormal: &'a [f64],
    /// Where the held rows stand in `sides`, and their bounds in `bounds`.
    pub(crate) held: &'a [usize],
    pub(crate) sides: &'a [f64],
    pub(crate) bounds: &'a [f64],
}

impl HeldFit {
    pub(crate) fn new(dof: usize, max_rows: usize) -> Self {
        Self {
            factor: alloc::vec![0.0; dof * dof],
            shares: alloc::vec![0.0; dof * max_rows],
            y: alloc::vec![0.0; dof],
            gap: alloc::vec![0.0; max_rows],
            multipliers: alloc::vec![0.0; dof],
            column: alloc::vec![0.0; dof],
            image: alloc::vec![0.0; max_rows],
            dof,
        }
    }

    /// x += z such that the held rows of x meet their bounds. `false`, with nothing of worth in x, if
    /// something needs damping or if a held row would not hold by itself: its multiplier is negative.
    pub(crate) fn solve(
        &mut self,
        problem: HeldProblem<'_>,
        damped: &mut Damped,
        x: &mut [f64],
    ) -> bool {
        let (dof, rank) = (self.dof, problem.held.len());
        let count = problem.gap.len();
        copy(&mut self.gap[..count], problem.gap);
        for (i, &side) in problem.held.iter().enumerate() {
            let row = &problem.sides[side * dof..][..dof];
            let mut rest = problem.bounds[side] - dot(row, x);
            for j in 0..=i {
                self.factor[i * dof + j] = dot(row, &problem.orthonormal[j * dof..][..dof]);
            }
            for j in 0..i {
                rest -= self.factor[i * dof + j] * self.y[j];
            }
            self.y[i] = rest / self.factor[i * dof + i];
        }
        for j in 0..rank {
            let direction = &problem.orthonormal[j * dof..][..dof];
            for k in 0..count {
                let share = dot(direction, &problem.rows[k * dof..][..dof]);
                self.shares[j * count + k] = share;
                self.gap[k] -= share * self.y[j];
            }
            add_scaled(x, self.y[j], direction);
        }
        let Some(w) = damped.add_if_regular(problem.usable, &self.gap[..count], x) else {
            return false;
        };
        for j in (0..rank).rev() {
            let along = dot(&self.shares[j * count..][..count], w);
            let mut rest = STRICT * STRICT * (self.y[j] - along);
            for i in j + 1..rank {
                rest -= self.factor[i * dof + j] * self.multipliers[i];
            }
            self.multipliers[j] = rest / self.factor[j * dof + j];
        }
        self.multipliers[..rank]
            .iter()
            .all(|&multiplier| multiplier >= 0.0)
    }

    /// How far beyond its bound [unit/s] the held row `k` of `rank` would go if it alone were let go, A
    /// having `count` rows.
    pub(crate) fn rate_if_released(
        &mut self,
        k: usize,
        rank: usize,
        count: usize,
        damped: &mut Damped,
    ) -> f64 {
        let column = &mut self.column[..rank];
        column.fill(0.0);
        column[k] = 1.0 / self.factor[k * self.dof + k];
        for i in k + 1..rank {
            let known = dot(&self.factor[i * self.dof + k..][..i - k], &column[k..i]);
            column[i] = -known / self.factor[i * self.dof + i];
        }
        let image = &mut self.image[..count];
        image.fill(0.0);
        for (j, share) in column.iter().enumerate() {
            add_scaled(image, *share, &self.shares[j * count..][..count]);
        }
        let stiffness = STRICT * STRICT * (dot(column, column) + damped.regular_square(image));
        self.multipliers[k] / stiffness
    }

    /// Multipliers of the held rows, in their order.
    pub(crate) fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::RowSpace;
    use proptest::prelude::*;

    const LAMBDA_SQUARED: f64 = 0.01;

    /// Qᵀ Q v for the rows Q of a basis.
    fn part_within(basis: &[f64], v: &[f64]) -> [f64; 6] {
        let mut part = [0.0; 6];
        for row in basis.chunks_exact(6) {
            add_scaled(&mut part, dot(row, v), row);
        }
        part
    }

    proptest! {
        #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..ProptestConfig::default() })]
        /// The gradient of the objective, R written out, is made of the held rows alone, and their
        /// multipliers are its shares.
        #[test]
        fn held_fit_satisfies_the_first_order_conditions(
            rows in prop::collection::vec(-1.0..1.0f64, 3 * 6),
            sides in prop::collection::vec(-1.0..1.0f64, 3 * 6),
            gap in prop::array::uniform3(-1.0..1.0f64),
            bounds in prop::array::uniform3(-1.0..0.0f64),
            from in prop::array::uniform6(-0.1..0.1f64),
        ) {
            let held = [2, 0];
            let mut taken = RowSpace::new(6, 3);
            prop_assume!(held.iter().all(|&side: &usize| taken.push(&sides[side * 6..][..6])));
            let mut usable = rows.clone();
            usable.chunks_exact_mut(6).for_each(|row| taken.project_out(row));
            let mut fit = HeldFit::new(6, 4);
            let mut x = from;
            let problem = HeldProblem {
                rows: &rows,
                usable: &usable,
                gap: &gap,
                orthonormal: taken.basis_from(0),
                held: &held,
                sides: &sides,
                bounds: &bounds,
            };
            let mut damped = Damped::new(6, 4);
            let keeps = fit.solve(problem, &mut damped, &mut x);
            let multipliers = [fit.multipliers()[0], fit.multipliers()[1]];
            prop_assume!(keeps);
            prop_assert!(multipliers.iter().all(|&multiplier| multiplier >= 0.0));
            for side in held {
                prop_assert!((dot(&sides[side * 6..][..6], &x) - bounds[side]).abs() < 1e-10);
            }
            let (first, rate) = (multipliers[0], fit.rate_if_released(0, 2, 3, &mut damped));
            let mut moved_bounds = bounds;
            moved_bounds[held[0]] += 1.0;
            let moved = HeldProblem { bounds: &moved_bounds, ..problem };
            fit.solve(moved, &mut damped, &mut from.clone());
            // The multiplier is proportional to how far the bound is from where x would go by itself.
            let stiffness = fit.multipliers()[0] - first;
            prop_assert!((rate * stiffness - first).abs() <= 1e-6 * first, "{rate} {stiffness}");
            let z: Vec<f64> = x.iter().zip(from).map(|(x, from)| x - from).collect();
            let undamped = {
                let mut space = RowSpace::new(6, 3);
                sides.chunks_exact(6).enumerate().filter(|(i, _)| held.contains(i)).for_each(|(_, row)| {
                    space.push(row);
                });
                space.push_block(&rows);
                part_within(space.basis_from(0), &z)
            };
            let mut gradient: Vec<f64> = z
                .iter()
                .zip(undamped)
                .map(|(z, undamped)| STRICT * STRICT * z + LAMBDA_SQUARED * (z - undamped))
                .collect();
            for (row, gap) in rows.chunks_exact(6).zip(gap) {
                add_scaled(&mut gradient, dot(row, &z) - gap, row);
            }
            for (side, multiplier) in held.into_iter().zip(multipliers) {
                add_scaled(&mut gradient, -multiplier, &sides[side * 6..][..6]);
            }
            prop_assert!(gradient.iter().all(|entry| entry.abs() < 1e-9), "{gradient:?}");
        }
    }
}
