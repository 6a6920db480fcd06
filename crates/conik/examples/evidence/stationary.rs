//! Is a point at which the arm stopped one at which it had to?
//!
//! First-order conditions (Karush, Kuhn and Tucker) of "minimise ½|e|² subject to the sets", e being
//! the error of the position task and J its Jacobian: with a the inward row of every bound that the
//! point lies on,
//!
//! ```text
//! Jᵀ e + Σ μ a = 0   for some μ ≥ 0
//! ```
//!
//! What is left of it, r = min |Jᵀ e + Σ μ a|, says how much could still be gained: |e| falls by r/|e|
//! for every radian that the joints turn in the best direction allowed.

/// r, by non-negative least squares: one multiplier after the other takes its best value, until none
/// moves any more.
pub fn residual(gradient: [f64; 6], inward: &[[f64; 6]]) -> f64 {
    const ROUNDS: usize = 50_000;
    let product = |a: &[f64; 6], b: &[f64; 6]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut rest = gradient;
    let mut multipliers = vec![0.0_f64; inward.len()];
    for _ in 0..ROUNDS {
        let mut largest: f64 = 0.0;
        for (multiplier, row) in multipliers.iter_mut().zip(inward) {
            let squared = product(row, row);
            if squared < 1e-18 {
                continue;
            }
            let best = (*multiplier - product(row, &rest) / squared).max(0.0);
            let change = best - *multiplier;
            *multiplier = best;
            for (rest, entry) in rest.iter_mut().zip(row) {
                *rest += change * entry;
            }
            largest = largest.max(change.abs() * squared.sqrt());
        }
        if largest < 1e-12 {
            break;
        }
    }
    product(&rest, &rest).sqrt()
}
