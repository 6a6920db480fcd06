//! Symmetric matrices: factors and, for the rare case, eigenvectors.

use crate::real::sqrt;

/// Factors the lower triangle of a symmetric n×n matrix in place, A = L D Lᵀ: L, whose diagonal is 1,
/// below the diagonal, and D⁻¹ on it. `false` if A is not positive definite.
#[inline(always)]
#[allow(clippy::inline_always, reason = "for the sake of known sizes")]
pub(crate) fn factor(a: &mut [f64], n: usize) -> bool {
    for i in 0..n {
        let (above, row) = a.split_at_mut(i * n);
        let row = &mut row[..n];
        // First L D, then, with the pivot, L.
        for j in 0..i {
            let earlier = &above[j * n..][..n];
            for k in 0..j {
                row[j] -= row[k] * earlier[k];
            }
        }
        let mut pivot = row[i];
        for j in 0..i {
            let scaled = row[j];
            row[j] *= above[j * n + j];
            pivot -= scaled * row[j];
        }
        if !(pivot > 0.0) {
            return false;
        }
        row[i] = 1.0 / pivot;
    }
    true
}

/// x ← A⁻¹ x, from the factor of A.
#[inline(always)]
#[allow(clippy::inline_always, reason = "for the sake of known sizes")]
pub(crate) fn solve(factor: &[f64], n: usize, x: &mut [f64]) {
    for i in 1..n {
        for k in 0..i {
            x[i] -= factor[i * n + k] * x[k];
        }
    }
    for i in 0..n {
        x[i] *= factor[i * n + i];
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            x[i] -= factor[k * n + i] * x[k];
        }
    }
}

/// Eigenvalues, then on the diagonal of `a`, and eigenvectors, the rows of `vectors`, of a symmetric
/// n×n matrix, by cyclic Jacobi rotations.
pub(crate) fn eigenvectors(a: &mut [f64], n: usize, vectors: &mut [f64]) {
    /// Each sweep squares what is left beside the diagonal; more than ten are never needed.
    const SWEEPS: usize = 12;
    vectors[..n * n].fill(0.0);
    for i in 0..n {
        vectors[i * n + i] = 1.0;
    }
    for _ in 0..SWEEPS {
        let mut beside = 0.0;
        let mut diagonal = 0.0;
        for i in 0..n {
            diagonal += a[i * n + i] * a[i * n + i];
            for j in 0..i {
                beside += a[i * n + j] * a[i * n + j];
            }
        }
        if beside <= 1e-30 * diagonal {
            return;
        }
        for p in 0..n {
            for q in p + 1..n {
                rotate(a, n, vectors, p, q);
            }
        }
    }
}

/// One Jacobi rotation, which makes the entry (p, q) zero.
fn rotate(a: &mut [f64], n: usize, vectors: &mut [f64], p: usize, q: usize) {
    let off = a[p * n + q];
    if off == 0.0 {
        return;
    }
    let theta = (a[q * n + q] - a[p * n + p]) / (2.0 * off);
    let tangent = 1.0 / (theta.abs() + sqrt(theta * theta + 1.0));
    let tangent = if theta < 0.0 { -tangent } else { tangent };
    let cos = 1.0 / sqrt(tangent * tangent + 1.0);
    let sin = tangent * cos;
    for k in 0..n {
        let (x, y) = (a[k * n + p], a[k * n + q]);
        a[k * n + p] = cos * x - sin * y;
        a[k * n + q] = sin * x + cos * y;
    }
    for k in 0..n {
        let (x, y) = (a[p * n + k], a[q * n + k]);
        a[p * n + k] = cos * x - sin * y;
        a[q * n + k] = sin * x + cos * y;
        let (x, y) = (vectors[p * n + k], vectors[q * n + k]);
        vectors[p * n + k] = cos * x - sin * y;
        vectors[q * n + k] = sin * x + cos * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::prelude::*;

    fn gram(rows: &[f64], n: usize) -> Vec<f64> {
        (0..n * n)
            .map(|i| crate::linalg::dot(&rows[i / n * n..][..n], &rows[i % n * n..][..n]))
            .collect()
    }

    proptest! {
        #[test]
        fn eigenvectors_diagonalise(rows in prop::collection::vec(-1.0..1.0f64, 16)) {
            let a = gram(&rows, 4);
            let (mut d, mut v) = (a.clone(), [0.0; 16]);
            eigenvectors(&mut d, 4, &mut v);
            for i in 0..4 {
                for j in 0..4 {
                    let entry: f64 = (0..16).map(|k| v[i * 4 + k / 4] * a[k] * v[j * 4 + k % 4]).sum();
                    let expected = if i == j { d[i * 4 + i] } else { 0.0 };
                    prop_assert!((entry - expected).abs() < 1e-13);
                }
            }
        }

        #[test]
        fn factors_solve(rows in prop::collection::vec(-1.0..1.0f64, 9), x in prop::collection::vec(-1.0..1.0f64, 3)) {
            let mut a = gram(&rows, 3);
            for i in 0..3 {
                a[i * 3 + i] += 0.1;
            }
            let mut y: Vec<f64> = (0..3).map(|i| crate::linalg::dot(&a[i * 3..][..3], &x)).collect();
            prop_assert!(factor(&mut a, 3));
            solve(&a, 3, &mut y);
            for (x, y) in x.iter().zip(&y) {
                prop_assert!((x - y).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn indefinite_matrices_have_no_factor() {
        assert!(!factor(&mut [1.0, 2.0, 2.0, 1.0], 2));
        assert!(!factor(&mut [f64::NAN], 1));
    }
}
