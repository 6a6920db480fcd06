//! The linear algebra of the method: orthonormal bases of row spaces, least squares of minimum norm
//! or damped, and small quadratic programs. Nothing here allocates after construction.

mod damped;
mod dual_active_set;
mod held_fit;
mod minimum_norm;
mod row_space;
mod singular;
mod symmetric;

pub(crate) use damped::Damped;
#[cfg(test)]
pub(crate) use damped::STRICT;
pub(crate) use dual_active_set::{Constraints, DualActiveSet, Solution, VIOLATION};
pub(crate) use held_fit::{HeldFit, HeldProblem};
pub(crate) use minimum_norm::MinimumNorm;
pub(crate) use row_space::RowSpace;
pub(crate) use singular::singular_vectors;

/// A row that keeps less than this share of its length beside the rows before it depends on them.
///
/// Exactly dependent rows keep some 1e-16; a share of 1e-10 would already mean joint velocities
/// ten orders of magnitude above the task's.
const RANK_TOLERANCE: f64 = 1e-10;

/// A row that keeps at least this share of its length after projection is orthogonal to rounding;
/// one that keeps less is projected once more ("twice is enough", Giraud et al. 2005).
const ENOUGH_LENGTH_KEPT: f64 = 0.7;

/// Rows shorter than this have no direction: their squared length is not a normal number.
const NO_LENGTH: f64 = 1e-150;

/// Rows of six entries are the common case, and loops of known length the fast one: six entries are
/// three pairs. The generic loops stay for every other robot.
const COMMON: usize = 6;

#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    if let (Ok(a), Ok(b)) = (<&[f64; COMMON]>::try_from(a), <&[f64; COMMON]>::try_from(b)) {
        let even = a[0] * b[0] + a[2] * b[2] + a[4] * b[4];
        let odd = a[1] * b[1] + a[3] * b[3] + a[5] * b[5];
        return even + odd;
    }
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `y += factor * x`
#[inline]
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    if let (Ok(y), Ok(x)) = (
        <&mut [f64; COMMON]>::try_from(&mut *y),
        <&[f64; COMMON]>::try_from(x),
    ) {
        for (y, x) in y.iter_mut().zip(x) {
            *y += factor * x;
        }
        return;
    }
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// `y = factor * (a - b)`
#[inline]
pub(crate) fn scaled_difference(y: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    if let (Ok(y), Ok(a), Ok(b)) = (
        <&mut [f64; COMMON]>::try_from(&mut *y),
        <&[f64; COMMON]>::try_from(a),
        <&[f64; COMMON]>::try_from(b),
    ) {
        for k in 0..COMMON {
            y[k] = factor * (a[k] - b[k]);
        }
        return;
    }
    for (y, (a, b)) in y.iter_mut().zip(a.iter().zip(b)) {
        *y = factor * (a - b);
    }
}

/// Whether an entry is larger, whatever its sign, than the bound of its place.
#[inline]
pub(crate) fn exceeds(values: &[f64], bounds: &[f64]) -> bool {
    if let (Ok(values), Ok(bounds)) = (
        <&[f64; COMMON]>::try_from(values),
        <&[f64; COMMON]>::try_from(bounds),
    ) {
        // Without a branch for each entry.
        return (0..COMMON).fold(false, |found, k| found | (values[k].abs() > bounds[k]));
    }
    values
        .iter()
        .zip(bounds)
        .any(|(value, bound)| value.abs() > *bound)
}

/// `y = 0`
#[inline]
pub(crate) fn clear(y: &mut [f64]) {
    if let Ok(y) = <&mut [f64; COMMON]>::try_from(&mut *y) {
        *y = [0.0; COMMON];
        return;
    }
    y.fill(0.0);
}

/// `y = x`
#[inline]
pub(crate) fn copy(y: &mut [f64], x: &[f64]) {
    if let (Ok(y), Ok(x)) = (
        <&mut [f64; COMMON]>::try_from(&mut *y),
        <&[f64; COMMON]>::try_from(x),
    ) {
        *y = *x;
        return;
    }
    y.copy_from_slice(x);
}

/// Whether two vectors of the same length agree in every entry.
#[inline]
pub(crate) fn are_equal(a: &[f64], b: &[f64]) -> bool {
    if let (Ok(a), Ok(b)) = (<&[f64; COMMON]>::try_from(a), <&[f64; COMMON]>::try_from(b)) {
        // Without a branch for each entry.
        return (0..COMMON).filter(|&k| a[k] != b[k]).count() == 0;
    }
    a == b
}

/// Index of the first number that is not finite.
#[inline]
pub(crate) fn not_finite(values: &[f64]) -> Option<usize> {
    // Almost always there is none, which is found out without a branch for each number: zero times a
    // number is zero only if that is finite.
    let all_are_finite = if let Ok(six) = <&[f64; COMMON]>::try_from(values) {
        dot(six, &[0.0; COMMON]) == 0.0
    } else {
        values.iter().all(|value| value.is_finite())
    };
    if all_are_finite {
        return None;
    }
    values.iter().position(|value| !value.is_finite())
}

/// Index of the longest row.
fn longest(rows: &[f64], dof: usize) -> usize {
    let mut best = (0, 0.0);
    for (i, row) in rows.chunks_exact(dof).enumerate() {
        let squared = dot(row, row);
        if squared > best.1 {
            best = (i, squared);
        }
    }
    best.0
}
