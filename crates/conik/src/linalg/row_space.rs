//! An orthonormal basis of the rows stacked so far, and the projector on their null space.
//!
//! The null-space matrix N = I − J⁺J of stacked rows J depends on their span alone. With an
//! orthonormal basis Q of that span N = I − QᵀQ, whatever the rank of J: rows that depend on those
//! before them add nothing to Q. Nothing here is ever damped, so N is a projector and rows that are
//! in the basis stay frozen to rounding.

use alloc::vec::Vec;

use super::{COMMON, ENOUGH_LENGTH_KEPT, NO_LENGTH, RANK_TOLERANCE, add_scaled, dot};
use crate::joints::MAX_JOINTS;
use crate::real::sqrt;

#[derive(Debug)]
pub(crate) struct RowSpace {
    /// Orthonormal rows, one after the other.
    basis: Vec<f64>,
    /// Rows of a block that wait for their turn, see `push_block`.
    block: Vec<f64>,
    dof: usize,
    rank: usize,
}

impl RowSpace {
    /// The empty span in `dof` dimensions; blocks may have up to `max_rows` rows.
    pub(crate) fn new(dof: usize, max_rows: usize) -> Self {
        Self {
            basis: alloc::vec![0.0; dof * dof],
            block: alloc::vec![0.0; dof * max_rows],
            dof,
            rank: 0,
        }
    }

    #[inline]
    pub(crate) fn rank(&self) -> usize {
        self.rank
    }

    /// The orthonormal rows after the first `rank`.
    pub(crate) fn basis_from(&self, rank: usize) -> &[f64] {
        &self.basis[rank * self.dof..self.rank * self.dof]
    }

    /// Forgets all rows but the first `rank` of the basis.
    #[inline]
    pub(crate) fn truncate(&mut self, rank: usize) {
        debug_assert!(rank <= self.rank);
        self.rank = rank;
    }

    /// Takes over the span of another.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.rank = other.rank;
        let used = self.rank * self.dof;
        self.basis[..used].copy_from_slice(&other.basis[..used]);
    }

    /// Writes orthonormal rows that span what is left free, and returns how many.
    pub(crate) fn complement(&self, span: &mut [f64]) -> usize {
        let (dof, rank) = (self.dof, self.rank);
        span.fill(0.0);
        if rank == 0 {
            for k in 0..dof {
                span[k * dof + k] = 1.0;
            }
            return dof;
        }
        // Of each unit vector, the squared length that is left beside all rows so far. The longest
        // is next; it is at least 1 / √dof long.
        let mut left = [1.0; MAX_JOINTS];
        let take_from = |left: &mut [f64], row: &[f64]| {
            for (left, entry) in left.iter_mut().zip(row) {
                *left -= entry * entry;
            }
        };
        for row in self.basis[..rank * dof].chunks_exact(dof) {
            take_from(&mut left[..dof], row);
        }
        for found in 0..dof - rank {
            let (done, rest) = span.split_at_mut(found * dof);
            let row = &mut rest[..dof];
            row[largest(&left[..dof])] = 1.0;
            // Twice is enough.
            for _ in 0..2 {
                project_out(&self.basis[..rank * dof], row);
                project_out(done, row);
            }
            let length = sqrt(dot(row, row));
            for entry in row.iter_mut() {
                *entry /= length;
            }
            take_from(&mut left[..dof], row);
        }
        dof - rank
    }

    /// Adds one row. `false` if it depends on the rows before it and so adds nothing.
    #[inline]
    pub(crate) fn push(&mut self, row: &[f64]) -> bool {
        let is_new = if self.dof == COMMON {
            push_row(COMMON, &mut self.basis, self.rank, row)
        } else {
            push_row(self.dof, &mut self.basis, self.rank, row)
        };
        self.rank += usize::from(is_new);
        is_new
    }

    /// Adds a block of rows, at each turn the one of which most is left, so that the rank of the
    /// block is decided by its best-conditioned rows.
    pub(crate) fn push_block(&mut self, rows: &[f64]) {
        let (dof, count) = (self.dof, rows.len() / self.dof);
        let mut squares = [0.0; MAX_JOINTS];
        self.block[..rows.len()].copy_from_slice(rows);
        for (row, squared) in self.block.chunks_exact_mut(dof).zip(&mut squares[..count]) {
            *squared = dot(row, row);
            project_out(&self.basis[..self.rank * dof], row);
        }
        for next in 0..count {
            if self.rank == dof {
                return;
            }
            let best = super::longest(&self.block[next * dof..count * dof], dof) + next;
            if best != next {
                let (before, from_best) = self.block.split_at_mut(best * dof);
                before[next * dof..][..dof].swap_with_slice(&mut from_best[..dof]);
                squares.swap(next, best);
            }
            if self.push_from_block(next, squares[next]) {
                let newest = &self.basis[(self.rank - 1) * dof..][..dof];
                for row in self.block[(next + 1) * dof..count * dof].chunks_exact_mut(dof) {
                    project_out(newest, row);
                }
            }
        }
    }

    /// Takes row `i` of the block, projected already, into the basis unless too little is left of
    /// its original length, given `squared`.
    fn push_from_block(&mut self, i: usize, squared: f64) -> bool {
        if self.rank == self.dof {
            return false;
        }
        let (basis, free) = self.basis.split_at_mut(self.rank * self.dof);
        let new = &mut free[..self.dof];
        new.copy_from_slice(&self.block[i * self.dof..][..self.dof]);
        let is_new = normalise(basis, new, squared);
        self.rank += usize::from(is_new);
        is_new
    }

    /// v ← N v: takes out of `v` what would move any of the stacked rows.
    #[inline]
    pub(crate) fn project_out(&self, v: &mut [f64]) {
        project_out(&self.basis[..self.rank * self.dof], v);
    }
}

/// Writes what is left of `row` beside `rank` orthonormal rows after them, at length 1. `false` if that
/// is too little.
#[inline(always)]
#[allow(clippy::inline_always, reason = "for the sake of known sizes")]
pub(super) fn push_row(dof: usize, basis: &mut [f64], rank: usize, row: &[f64]) -> bool {
    if rank == dof {
        return false;
    }
    let (basis, free) = basis.split_at_mut(rank * dof);
    let (row, new) = (&row[..dof], &mut free[..dof]);
    new.copy_from_slice(row);
    project_out(basis, new);
    normalise(basis, new, dot(row, row))
}

/// Brings a projected row to length 1. `false` if too little is left of its original length.
#[inline]
fn normalise(basis: &[f64], row: &mut [f64], original_squared: f64) -> bool {
    if !(original_squared > NO_LENGTH * NO_LENGTH) {
        return false;
    }
    let mut squared = dot(row, row);
    if squared < ENOUGH_LENGTH_KEPT * ENOUGH_LENGTH_KEPT * original_squared {
        project_out(basis, row);
        squared = dot(row, row);
    }
    if !(squared > RANK_TOLERANCE * RANK_TOLERANCE * original_squared) {
        return false;
    }
    let scale = 1.0 / sqrt(squared);
    for value in row {
        *value *= scale;
    }
    true
}

fn largest(values: &[f64]) -> usize {
    let mut best = 0;
    for (i, value) in values.iter().enumerate() {
        if *value > values[best] {
            best = i;
        }
    }
    best
}

#[inline]
fn project_out(basis: &[f64], v: &mut [f64]) {
    if v.len() == COMMON {
        for row in basis.as_chunks::<COMMON>().0 {
            let along = dot(row, v);
            add_scaled(v, -along, row);
        }
    } else {
        for row in basis.chunks_exact(v.len()) {
            let along = dot(row, v);
            add_scaled(v, -along, row);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn norm(v: &[f64]) -> f64 {
        dot(v, v).sqrt()
    }

    proptest! {
        #[test]
        fn projected_vectors_move_no_stacked_row(
            rows in prop::collection::vec(-1.0..1.0f64, 6 * 4),
            v in prop::collection::vec(-1.0..1.0f64, 6),
        ) {
            let mut space = RowSpace::new(6, 6);
            space.push(&rows[..6]);
            space.push_block(&rows[6..]);
            let mut projected = v.clone();
            space.project_out(&mut projected);
            for row in rows.chunks_exact(6) {
                prop_assert!(dot(row, &projected).abs() <= 1e-14);
            }
        }

        #[test]
        fn projecting_twice_is_projecting_once(
            rows in prop::collection::vec(-1.0..1.0f64, 6 * 3),
            v in prop::collection::vec(-1.0..1.0f64, 6),
        ) {
            let mut space = RowSpace::new(6, 3);
            space.push_block(&rows);
            let mut once = v.clone();
            space.project_out(&mut once);
            let mut twice = once.clone();
            space.project_out(&mut twice);
            for (a, b) in once.iter().zip(&twice) {
                prop_assert!((a - b).abs() <= 1e-15);
            }
        }
    }

    #[test]
    fn dependent_rows_add_nothing_whatever_their_length() {
        let mut space = RowSpace::new(3, 3);
        assert!(space.push(&[1.0, 2.0, 3.0]));
        assert!(!space.push(&[1e-6, 2e-6, 3e-6]));
        assert!(!space.push(&[-3e9, -6e9, -9e9]));
        assert!(!space.push(&[0.0, 0.0, 0.0]));
        assert_eq!(space.rank(), 1);
        assert!(
            space.push(&[1e-8, 0.0, 0.0]),
            "short rows count by their direction"
        );
    }

    #[test]
    fn a_block_of_dependent_rows_has_the_rank_of_its_span() {
        // Three rows of a plane, as a distance on top of a position makes them.
        let mut space = RowSpace::new(4, 3);
        space.push_block(&[1.0, 0.0, 1e-3, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1e-3, 0.0]);
        assert_eq!(space.rank(), 2);
    }

    #[test]
    fn nearly_parallel_rows_still_give_an_orthonormal_basis() {
        let mut space = RowSpace::new(3, 1);
        space.push(&[1.0, 1.0, 1.0]);
        space.push(&[1.0, 1.0, 1.0 + 1e-7]);
        assert_eq!(space.rank(), 2);
        let (a, b) = space.basis[..6].split_at(3);
        assert!(dot(a, b).abs() < 1e-15 && (norm(b) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_full_basis_leaves_no_direction_free() {
        let mut space = RowSpace::new(2, 3);
        space.push_block(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(space.rank(), 2);
        let mut v = [0.3, -0.7];
        space.project_out(&mut v);
        assert!(norm(&v) < 1e-15);
    }
}
