//! Singular values of a few rows, by one-sided Jacobi rotations (Hestenes 1958): small ones too are
//! accurate to rounding, which eigenvalues of J Jᵀ are not.

use super::dot;
use crate::real::sqrt;

/// Each sweep squares what is left of the inner products; more than ten are never needed.
const SWEEPS: usize = 15;

/// Turns the rows of J (`dof` entries each) into σᵢ vᵢᵀ, at right angles to each other, and writes the uᵢ
/// that belong to them, so that J = Σ σᵢ uᵢ vᵢᵀ, into the rows of `left`, as long as J has rows.
pub(crate) fn singular_vectors(rows: &mut [f64], dof: usize, left: &mut [f64]) {
    let m = rows.len() / dof;
    left[..m * m].fill(0.0);
    for i in 0..m {
        left[i * m + i] = 1.0;
    }
    for _ in 0..SWEEPS {
        let mut is_done = true;
        for p in 0..m {
            for q in p + 1..m {
                is_done &= !rotate(rows, dof, left, (p, q));
            }
        }
        if is_done {
            return;
        }
    }
}

/// Makes two rows orthogonal. Whether they were not.
fn rotate(rows: &mut [f64], dof: usize, left: &mut [f64], (p, q): (usize, usize)) -> bool {
    let (a, b) = (&rows[p * dof..][..dof], &rows[q * dof..][..dof]);
    let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
    if ab.abs() <= 1e-15 * sqrt(aa) * sqrt(bb) {
        return false;
    }
    let zeta = (bb - aa) / (2.0 * ab);
    let tangent = 1.0 / (zeta.abs() + sqrt(1.0 + zeta * zeta));
    let tangent = if zeta < 0.0 { -tangent } else { tangent };
    let cos = 1.0 / sqrt(1.0 + tangent * tangent);
    let sin = cos * tangent;
    let m = rows.len() / dof;
    for (matrix, width) in [(rows, dof), (left, m)] {
        for k in 0..width {
            let (x, y) = (matrix[p * width + k], matrix[q * width + k]);
            matrix[p * width + k] = cos * x - sin * y;
            matrix[q * width + k] = sin * x + cos * y;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_become_orthogonal_and_make_the_matrix(
            mut rows in prop::collection::vec(-1.0..1.0_f64, 18),
            small in prop_oneof![Just(0.0), Just(1e-9), Just(1.0)],
        ) {
            // Two rows that hardly differ.
            for k in 0..6 {
                rows[12 + k] = rows[6 + k] + small * rows[12 + k];
            }
            let before = rows.clone();
            let mut left = [0.0; 9];
            singular_vectors(&mut rows, 6, &mut left);
            let row = |i: usize| &rows[i * 6..][..6];
            let lengths: Vec<f64> = (0..3).map(|i| sqrt(dot(row(i), row(i)))).collect();
            for i in 0..3 {
                for j in 0..i {
                    prop_assert!(dot(row(i), row(j)).abs() <= 1e-14 * lengths[i] * lengths[j] + 1e-30);
                }
                for k in 0..6 {
                    let entry: f64 = (0..3).map(|s| left[s * 3 + i] * rows[s * 6 + k]).sum();
                    prop_assert!((entry - before[i * 6 + k]).abs() < 1e-14);
                }
            }
        }
    }
}
