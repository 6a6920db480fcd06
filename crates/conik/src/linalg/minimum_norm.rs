//! Minimum-norm least squares: x = J⁺ s for a Jacobian of any rank.
//!
//! The rows of J are orthonormalised, the longest remaining first: P J = L Q with Q orthonormal
//! rows and L lower triangular of full rank r (a complete orthogonal decomposition). Then
//! x = Qᵀ y, where y solves L y = P s: exactly if r = m, in the least-squares sense if r < m.

use alloc::vec::Vec;

use super::symmetric::{factor, solve};
use super::{COMMON, ENOUGH_LENGTH_KEPT, NO_LENGTH, RANK_TOLERANCE, add_scaled, dot};
use crate::real::sqrt;

/// Jacobians of at most this many rows may take the short way by the normal equations.
const SHORT: usize = 6;

/// The short way is taken while the squared pivots stay above this share of the largest squared row:
/// its error is then below 1e-12 of the solution.
const WELL_CONDITIONED: f64 = 1e-4;

#[derive(Debug)]
pub(crate) struct MinimumNorm {
    /// Rows of J, turned into Q from the top.
    rows: Vec<f64>,
    /// L by columns: column k holds the share of Q's row k in every row of P J.
    shares: Vec<f64>,
    /// P s, consumed by the solution.
    rhs: Vec<f64>,
    /// Original lengths of the rows of P J.
    lengths: Vec<f64>,
    dof: usize,
    max_rows: usize,
}

impl MinimumNorm {
    pub(crate) fn new(dof: usize, max_rows: usize) -> Self {
        Self {
            rows: alloc::vec![0.0; dof * max_rows],
            shares: alloc::vec![0.0; max_rows * max_rows],
            rhs: alloc::vec![0.0; max_rows],
            lengths: alloc::vec![0.0; max_rows],
            dof,
            max_rows,
        }
    }

    /// x ← J⁺ s. Returns the rank of J.
    pub(crate) fn solve(&mut self, jacobian: &[f64], s: &[f64], x: &mut [f64]) -> usize {
        // The same code each time; known sizes let the compiler unroll it.
        let is_solved = match (s.len(), self.dof) {
            (1, COMMON) => solve_normal(1, COMMON, jacobian, s, x),
            (3, COMMON) => solve_normal(3, COMMON, jacobian, s, x),
            (count, dof) => count <= SHORT && solve_normal(count, dof, jacobian, s, x),
        };
        if is_solved {
            return s.len();
        }
        self.solve_orthogonal(jacobian, s, x)
    }

    /// x ← J⁺ s by the complete orthogonal decomposition.
    fn solve_orthogonal(&mut self, jacobian: &[f64], s: &[f64], x: &mut [f64]) -> usize {
        let count = s.len();
        self.rows[..jacobian.len()].copy_from_slice(jacobian);
        self.rhs[..count].copy_from_slice(s);
        let rank = self.factor(count);
        if rank == count {
            self.substitute(count);
        } else {
            self.least_squares(count, rank);
        }
        x.fill(0.0);
        for (row, &y) in self.rows.chunks_exact(self.dof).zip(&self.rhs[..rank]) {
            add_scaled(x, y, row);
        }
        rank
    }

    /// P J = L Q. Returns the rank.
    fn factor(&mut self, count: usize) -> usize {
        let (dof, max_rows) = (self.dof, self.max_rows);
        let mut longest = 0.0_f64;
        for (row, length) in self.rows.chunks_exact(dof).zip(&mut self.lengths[..count]) {
            *length = sqrt(dot(row, row));
            longest = longest.max(*length);
        }
        // What is left of a row is measured against the longest one: a row may be short, but a
        // velocity that is 1e10 times as large as the others ask for is no velocity.
        let least = (RANK_TOLERANCE * longest).max(NO_LENGTH);
        for k in 0..count.min(dof) {
            self.pivot(k, count);
            let (done, rest) = self.rows.split_at_mut(k * dof);
            let (row, below) = rest.split_at_mut(dof);
            let mut left = sqrt(dot(row, row));
            if left < ENOUGH_LENGTH_KEPT * self.lengths[k] {
                for (i, earlier) in done.chunks_exact(dof).enumerate() {
                    let share = dot(earlier, row);
                    self.shares[i * max_rows + k] += share;
                    add_scaled(row, -share, earlier);
                }
                left = sqrt(dot(row, row));
            }
            if !(left > least) {
                return k;
            }
            for value in row.iter_mut() {
                *value /= left;
            }
            let shares = &mut self.shares[k * max_rows..][..max_rows];
            shares[k] = left;
            for (i, other) in below.chunks_exact_mut(dof).take(count - k - 1).enumerate() {
                let share = dot(row, other);
                shares[k + 1 + i] = share;
                add_scaled(other, -share, row);
            }
        }
        count.min(dof)
    }

    /// Brings the row of which most is left to place k.
    fn pivot(&mut self, k: usize, count: usize) {
        let dof = self.dof;
        let best = super::longest(&self.rows[k * dof..count * dof], dof) + k;
        if best == k {
            return;
        }
        let (before, from_best) = self.rows.split_at_mut(best * dof);
        before[k * dof..][..dof].swap_with_slice(&mut from_best[..dof]);
        self.rhs.swap(k, best);
        self.lengths.swap(k, best);
        for earlier in 0..k {
            let column = earlier * self.max_rows;
            self.shares.swap(column + k, column + best);
        }
    }

    /// Solves L y = P s for square L, forward.
    fn substitute(&mut self, count: usize) {
        for k in 0..count {
            let column = &self.shares[k * self.max_rows..];
            let y = self.rhs[k] / column[k];
            self.rhs[k] = y;
            for i in k + 1..count {
                self.rhs[i] -= column[i] * y;
            }
        }
    }

    /// Solves min |L y − P s| for tall L by orthonormalising its columns from the last to the
    /// first: with L = V U, V orthonormal columns and U lower triangular, U y = Vᵀ P s.
    fn least_squares(&mut self, count: usize, rank: usize) {
        // Column k of L starts at row k; the entries above are structural zeros, not yet written.
        for k in 0..rank {
            self.shares[k * self.max_rows..][..k].fill(0.0);
        }
        // U is kept where column k's structural zeros and diagonal are: U[j][k], j >= k, goes to
        // `upper` below. r and m are at most 32, and this branch is the rare one.
        let mut upper = [[0.0; crate::MAX_JOINTS]; crate::MAX_JOINTS];
        let mut projected = [0.0; crate::MAX_JOINTS];
        for k in (0..rank).rev() {
            let (columns, later) = self.shares.split_at_mut((k + 1) * self.max_rows);
            let column = &mut columns[k * self.max_rows..][..count];
            // Twice, so that V is orthonormal to rounding.
            for _ in 0..2 {
                for (offset, orthonormal) in
                    later.chunks(self.max_rows).take(rank - k - 1).enumerate()
                {
                    let share = dot(&orthonormal[..count], column);
                    upper[k + 1 + offset][k] += share;
                    add_scaled(column, -share, &orthonormal[..count]);
                }
            }
            let length = sqrt(dot(column, column));
            upper[k][k] = length;
            for value in column.iter_mut() {
                *value /= length;
            }
            projected[k] = dot(column, &self.rhs[..count]);
        }
        for k in 0..rank {
            let known: f64 = (0..k).map(|j| upper[k][j] * self.rhs[j]).sum();
            self.rhs[k] = (projected[k] - known) / upper[k][k];
        }
    }
}

/// x ← Jᵀ (J Jᵀ)⁻¹ s, the short way. `false` unless J is so well conditioned that nothing is lost by
/// squaring it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "for the sake of known sizes")]
fn solve_normal(count: usize, dof: usize, jacobian: &[f64], s: &[f64], x: &mut [f64]) -> bool {
    let (jacobian, x) = (&jacobian[..count * dof], &mut x[..dof]);
    let row = |i: usize| &jacobian[i * dof..][..dof];
    let mut gram = [0.0; SHORT * SHORT];
    let mut largest = 0.0_f64;
    for i in 0..count {
        for j in 0..=i {
            gram[i * count + j] = dot(row(i), row(j));
        }
        largest = largest.max(gram[i * count + i]);
    }
    if !factor(&mut gram, count) {
        return false;
    }
    let largest_inverse = (0..count).map(|i| gram[i * count + i]).fold(0.0, f64::max);
    if !(largest_inverse * WELL_CONDITIONED * largest < 1.0) {
        return false;
    }
    let mut y = [0.0; SHORT];
    y[..count].copy_from_slice(&s[..count]);
    solve(&gram, count, &mut y[..count]);
    x.fill(0.0);
    for i in 0..count {
        add_scaled(x, y[i], row(i));
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The four Penrose conditions in the form that a solution can show: the residual is orthogonal
    /// to the range of J, and the solution lies in the range of Jᵀ.
    fn assert_minimum_norm(jacobian: &[f64], dof: usize, s: &[f64], expected_rank: usize) {
        let count = s.len();
        let mut solver = MinimumNorm::new(dof, count);
        let mut x = alloc::vec![0.0; dof];
        assert_eq!(solver.solve(jacobian, s, &mut x), expected_rank);
        let mut other_way = x.clone();
        assert_eq!(
            solver.solve_orthogonal(jacobian, s, &mut other_way),
            expected_rank
        );
        for (a, b) in x.iter().zip(&other_way) {
            assert!((a - b).abs() <= 1e-9 * (1.0 + a.abs()), "{a} or {b}");
        }
        let residual: Vec<f64> = jacobian
            .chunks_exact(dof)
            .zip(s)
            .map(|(row, s)| s - dot(row, &x))
            .collect();
        for k in 0..dof {
            let gradient: f64 = (0..count)
                .map(|i| jacobian[i * dof + k] * residual[i])
                .sum();
            assert!(gradient.abs() < 1e-10, "gradient {gradient}");
        }
        let mut space = super::super::RowSpace::new(dof, count);
        space.push_block(jacobian);
        let mut outside = x.clone();
        space.project_out(&mut outside);
        assert!(
            outside.iter().all(|v| v.abs() < 1e-10),
            "outside {outside:?}"
        );
    }

    proptest! {
        #[test]
        fn full_rank_solutions_are_exact_and_shortest(
            jacobian in prop::collection::vec(-1.0..1.0f64, 3 * 6),
            s in prop::collection::vec(-1.0..1.0f64, 3),
        ) {
            assert_minimum_norm(&jacobian, 6, &s, 3);
        }

        #[test]
        fn rank_deficient_solutions_are_best_and_shortest(
            base in prop::collection::vec(-1.0..1.0f64, 2 * 5),
            mix in prop::collection::vec(-1.0..1.0f64, 4 * 2),
            s in prop::collection::vec(-1.0..1.0f64, 4),
        ) {
            // Well-conditioned mixtures only: rank decisions near the tolerance are another matter.
            prop_assume!((mix[0] * mix[3] - mix[1] * mix[2]).abs() > 0.1);
            let jacobian: Vec<f64> = (0..4 * 5)
                .map(|i| mix[i / 5 * 2] * base[i % 5] + mix[i / 5 * 2 + 1] * base[5 + i % 5])
                .collect();
            assert_minimum_norm(&jacobian, 5, &s, 2);
        }

        #[test]
        fn more_rows_than_joints_are_least_squares(
            jacobian in prop::collection::vec(-1.0..1.0f64, 5 * 2),
            s in prop::collection::vec(-1.0..1.0f64, 5),
        ) {
            assert_minimum_norm(&jacobian, 2, &s, 2);
        }
    }

    #[test]
    fn zero_jacobian_gives_zero() {
        let mut solver = MinimumNorm::new(3, 2);
        let mut x = [1.0; 3];
        assert_eq!(solver.solve(&[0.0; 6], &[1.0, 2.0], &mut x), 0);
        assert_eq!(x, [0.0; 3]);
    }

    #[test]
    fn a_workspace_carries_nothing_from_one_problem_to_the_next() {
        let mut used = MinimumNorm::new(3, 3);
        let mut x = [0.0; 3];
        used.solve(
            &[1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 1.0, 0.0],
            &[1.0, 1.0, 1.0],
            &mut x,
        );
        let mut fresh = MinimumNorm::new(3, 3);
        let mut y = [0.0; 3];
        let second = [0.0, 0.0, 2.0, 1.0, 0.0, 2.0, 1.0, 0.0, 0.0];
        used.solve(&second, &[3.0, 1.0, 4.0], &mut x);
        fresh.solve(&second, &[3.0, 1.0, 4.0], &mut y);
        assert_eq!(x, y);
    }
}
