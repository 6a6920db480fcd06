//! Damped least squares, the damping decided direction by direction.
//!
//! ```text
//! min |A z − g|² + zᵀ R z ,   R = l₀² I + λ² (I − P − Σⱼ wⱼ yⱼ yⱼᵀ) ,   wⱼ = min(1, (sⱼ / ε)²)
//! ```
//!
//! P projects on the rows that are held, and sⱼ and yⱼ are singular values and right singular vectors
//! of what A has left beside them. Along held rows nothing is damped: whether they would be left is
//! asked of the task as it is. A direction with sⱼ ≥ ε is not damped at all; one that the rows have lost (sⱼ → 0) is damped
//! with λ². Damping all directions for the one that an obstacle takes away would slow the others.
//!
//! l₀ only makes the problem strictly convex.

use alloc::vec::Vec;

use crate::damping::Damping;

use super::row_space::push_row;
use super::symmetric::{eigenvectors, factor, solve};
use super::{COMMON, add_scaled, dot};
use crate::real::sqrt;

/// l₀: weight of the velocity itself [task's unit per rad].
pub(crate) const STRICT: f64 = 1e-3;

/// ε: singular values below this are damped [task's unit per rad].
pub(crate) const SINGULAR: f64 = 0.2;

/// Singular values below this are what rounding leaves of rows that are taken [task's unit per rad].
const ROUNDING: f64 = 1e-13;

/// Singular values below this have no direction [task's unit per rad].
const NO_DIRECTION: f64 = 1e-9;

#[derive(Debug)]
pub(crate) struct Damped {
    /// Gram matrix of the usable rows, its factor, or its eigenvalues.
    gram: Vec<f64>,
    eigenvectors: Vec<f64>,
    /// The yⱼ, one after the other, and their wⱼ.
    directions: Vec<f64>,
    weights: Vec<f64>,
    rhs: Vec<f64>,
    hessian: Vec<f64>,
    dof: usize,
    count: usize,
    lost: usize,
}

/// wⱼ of a direction with this squared singular value, `least` being the smallest of all.
fn weight(damping: Damping, squared: f64, least: f64) -> f64 {
    let undamped = |squared: f64| (squared.max(0.0) / (SINGULAR * SINGULAR)).min(1.0);
    match damping {
        Damping::None => 1.0,
        Damping::Fixed(_) => 0.0,
        Damping::Smallest => undamped(least),
        Damping::Automatic | Damping::PerDirection => undamped(squared),
    }
}

impl Damped {
    pub(crate) fn new(dof: usize, max_rows: usize) -> Self {
        Self {
            gram: alloc::vec![0.0; max_rows * max_rows],
            eigenvectors: alloc::vec![0.0; max_rows * max_rows],
            directions: alloc::vec![0.0; max_rows * dof],
            weights: Vec::with_capacity(max_rows),
            rhs: alloc::vec![0.0; max_rows],
            hessian: alloc::vec![0.0; dof * dof],
            dof,
            count: 0,
            lost: 0,
        }
    }

    fn fill_gram(&mut self, rows: &[f64], shift: f64) {
        let (dof, n) = (self.dof, rows.len() / self.dof);
        self.count = n;
        for i in 0..n {
            for j in 0..=i {
                let entry = dot(&rows[i * dof..][..dof], &rows[j * dof..][..dof]);
                self.gram[i * n + j] = entry;
                self.gram[j * n + i] = entry;
            }
            self.gram[i * n + i] += shift;
        }
    }

    /// Whether every singular value of the rows is at least ε, so that nothing is damped.
    pub(crate) fn is_regular(&mut self, rows: &[f64]) -> bool {
        self.fill_gram(rows, -SINGULAR * SINGULAR);
        let is_regular = factor(&mut self.gram, self.count);
        self.lost = usize::from(!is_regular);
        is_regular
    }

    /// If no direction of the rows needs damping, x += Aᵀ w with w = (A Aᵀ + l₀² I)⁻¹ g, and w.
    #[inline]
    pub(crate) fn add_if_regular(
        &mut self,
        rows: &[f64],
        g: &[f64],
        x: &mut [f64],
    ) -> Option<&[f64]> {
        let Self {
            gram, rhs: w, dof, ..
        } = self;
        // The same code each time; known sizes let the compiler unroll it.
        let is_regular = match (g.len(), *dof) {
            (1, COMMON) => add_if_regular(1, COMMON, gram, rows, g, w, x),
            (3, COMMON) => add_if_regular(3, COMMON, gram, rows, g, w, x),
            (count, dof) => add_if_regular(count, dof, gram, rows, g, w, x),
        };
        self.lost = usize::from(!is_regular);
        is_regular.then_some(&self.rhs[..g.len()])
    }

    /// vᵀ (A Aᵀ + l₀² I)⁻¹ v for the rows of the last regular solution.
    pub(crate) fn regular_square(&mut self, v: &[f64]) -> f64 {
        let w = &mut self.rhs[..v.len()];
        w.copy_from_slice(v);
        match v.len() {
            3 => solve(&self.gram, 3, w),
            count => solve(&self.gram, count, w),
        }
        dot(v, w)
    }

    /// x += the solution for rows that may all be used: Σⱼ yⱼ sⱼ (uⱼ g) / (sⱼ² + l₀² + (1 − wⱼ) λ²).
    pub(crate) fn add(
        &mut self,
        damping: Damping,
        rows: &[f64],
        g: &[f64],
        variable: f64,
        x: &mut [f64],
    ) {
        let lambda_squared = damping.lambda_squared(variable);
        self.fill_gram(rows, 0.0);
        let n = self.count;
        eigenvectors(&mut self.gram, n, &mut self.eigenvectors);
        let least = (0..n)
            .map(|k| self.gram[k * n + k])
            .fold(f64::INFINITY, f64::min);
        self.lost = 0;
        for k in 0..n {
            let squared = self.gram[k * n + k];
            self.lost += usize::from(squared < SINGULAR * SINGULAR);
            if squared <= ROUNDING * ROUNDING {
                // What rounding leaves of rows that are taken is no direction to move in.
                continue;
            }
            let weight = weight(damping, squared, least);
            let vector = &self.eigenvectors[k * n..][..n];
            let share =
                dot(vector, g) / (squared + STRICT * STRICT + (1.0 - weight) * lambda_squared);
            for (row, entry) in rows.chunks_exact(self.dof).zip(vector) {
                add_scaled(x, share * entry, row);
            }
        }
    }

    /// How many directions of the rows had a singular value below ε when they were last looked at; 1 if
    /// it was only asked whether there are any.
    pub(crate) fn lost(&self) -> usize {
        self.lost
    }

    /// Finds the yⱼ and wⱼ of the usable rows.
    pub(crate) fn analyse(&mut self, damping: Damping, usable: &[f64]) {
        let is_fixed = matches!(damping, Damping::Fixed(_));
        if !is_fixed && self.is_regular(usable) {
            // All weights are 1, and then any orthonormal rows of the same span will do.
            self.lost = 0;
            self.weights.clear();
            for row in usable.chunks_exact(self.dof) {
                let found = self.weights.len();
                if push_row(self.dof, &mut self.directions, found, row) {
                    self.weights.push(1.0);
                }
            }
            return;
        }
        self.fill_gram(usable, 0.0);
        let (dof, n) = (self.dof, self.count);
        eigenvectors(&mut self.gram, n, &mut self.eigenvectors);
        let least = (0..n)
            .map(|k| self.gram[k * n + k])
            .fold(f64::INFINITY, f64::min);
        self.weights.clear();
        self.lost = 0;
        for k in 0..n {
            let squared = self.gram[k * n + k].max(0.0);
            let singular = sqrt(squared);
            self.lost += usize::from(singular < SINGULAR);
            if singular <= NO_DIRECTION {
                continue;
            }
            let found = self.weights.len();
            let direction = &mut self.directions[found * dof..][..dof];
            direction.fill(0.0);
            for (row, share) in usable
                .chunks_exact(dof)
                .zip(&self.eigenvectors[k * n..][..n])
            {
                add_scaled(direction, share / singular, row);
            }
            self.weights.push(weight(damping, squared, least));
        }
    }

    /// The square of the smallest singular value of the rows, and l₀².
    pub(crate) fn least_squared(&mut self, rows: &[f64]) -> f64 {
        self.fill_gram(rows, 0.0);
        let n = self.count;
        eigenvectors(&mut self.gram, n, &mut self.eigenvectors);
        let least = (0..n).map(|k| self.gram[k * n + k]);
        least.fold(f64::INFINITY, f64::min).max(0.0) + STRICT * STRICT
    }

    /// The y, one for each row, with which Aᵀ y is nearest to −g: (A Aᵀ + l₀² I)⁻¹ (−A g).
    pub(crate) fn balance(&mut self, rows: &[f64], g: &[f64], y: &mut Vec<f64>) {
        self.fill_gram(rows, STRICT * STRICT);
        y.clear();
        y.extend(rows.chunks_exact(self.dof).map(|row| -dot(row, g)));
        factor(&mut self.gram, self.count);
        solve(&self.gram, self.count, y);
    }

    /// Rows B, orthonormal in H = AᵀA + R, that span what the orthonormal rows `span` span. R is that of
    /// the last analysis, P that of the orthonormal rows `held`.
    pub(crate) fn weighted_basis(
        &mut self,
        rows: &[f64],
        lambda_squared: f64,
        held: &[f64],
        span: &[f64],
        basis: &mut [f64],
    ) {
        let (dof, n) = (self.dof, span.len() / self.dof);
        let hessian = &mut self.hessian[..n * n];
        hessian.fill(0.0);
        for i in 0..n {
            hessian[i * n + i] = STRICT * STRICT + lambda_squared;
        }
        let mut add_outer = |row: &[f64], weight: f64| {
            let mut shares = [0.0; crate::MAX_JOINTS];
            for (share, direction) in shares.iter_mut().zip(span.chunks_exact(dof)) {
                *share = dot(direction, row);
            }
            for i in 0..n {
                add_scaled(
                    &mut hessian[i * n..=i * n + i],
                    weight * shares[i],
                    &shares[..=i],
                );
            }
        };
        for row in rows.chunks_exact(dof) {
            add_outer(row, 1.0);
        }
        for direction in held.chunks_exact(dof) {
            add_outer(direction, -lambda_squared);
        }
        for (direction, weight) in self.directions.chunks_exact(dof).zip(&self.weights) {
            add_outer(direction, -lambda_squared * weight);
        }
        factor(hessian, n);
        // B = D^(−1/2) L⁻¹ span, row by row.
        basis[..n * dof].copy_from_slice(&span[..n * dof]);
        for i in 0..n {
            let (done, row) = basis.split_at_mut(i * dof);
            for (earlier, share) in done.chunks_exact(dof).zip(&hessian[i * n..]) {
                add_scaled(&mut row[..dof], -share, earlier);
            }
        }
        for (i, row) in basis[..n * dof].chunks_exact_mut(dof).enumerate() {
            let scale = sqrt(hessian[i * n + i]);
            for value in row {
                *value *= scale;
            }
        }
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "for the sake of known sizes")]
fn add_if_regular(
    count: usize,
    dof: usize,
    gram: &mut [f64],
    rows: &[f64],
    g: &[f64],
    w: &mut [f64],
    x: &mut [f64],
) -> bool {
    let (rows, x) = (&rows[..count * dof], &mut x[..dof]);
    let (gram, w) = (&mut gram[..count * count], &mut w[..count]);
    let row = |i: usize| &rows[i * dof..][..dof];
    // The factor needs only the lower triangle. The upper one keeps the matrix itself, w its diagonal.
    for i in 0..count {
        for j in 0..i {
            let entry = dot(row(i), row(j));
            gram[i * count + j] = entry;
            gram[j * count + i] = entry;
        }
        w[i] = dot(row(i), row(i));
        gram[i * count + i] = w[i] - SINGULAR * SINGULAR;
    }
    if !factor(gram, count) {
        return false;
    }
    for i in 0..count {
        for j in 0..i {
            gram[i * count + j] = gram[j * count + i];
        }
        gram[i * count + i] = w[i] + STRICT * STRICT;
    }
    // Positive definite by the shift, unless a task gave NaN, which shows in x.
    factor(gram, count);
    w.copy_from_slice(&g[..count]);
    solve(gram, count, w);
    for i in 0..count {
        add_scaled(x, w[i], row(i));
    }
    true
}
