//! Length of a vector that depends on the configuration: σ = |v(q)|, as in Eqs. (9) and (16).

use super::{AXES, add_outer};
use crate::geometry::Vec3;
use crate::joints::JointVec;

/// Added to the denominators of Eqs. (10) and (17), whose Jacobians are undefined at σ = 0.
const DENOMINATOR_EPSILON: f64 = 1e-9;

/// Along which v grows: J = nᵀ ∂v/∂q with n = v / (σ + ε); nothing where v is.
#[inline]
pub(super) fn direction(v: Vec3) -> Vec3 {
    v * (1.0 / (v.norm() + DENOMINATOR_EPSILON))
}

/// How strongly σ bends, for motions of v of order 1.
pub(super) fn bend(sigma: f64) -> f64 {
    1.0 / (sigma + DENOMINATOR_EPSILON)
}

/// Adds weight · ∇²σ = weight · (Σₖ nₖ ∇²vₖ + (∂v/∂q)ᵀ (I − n nᵀ) ∂v/∂q / σ) to `hessian`, but for the first
/// term. `row` writes dᵀ ∂v/∂q for a direction d, into `dof` entries.
pub(super) fn add_bending(
    v: Vec3,
    weight: f64,
    row: impl Fn(Vec3, &mut [f64]),
    dof: usize,
    hessian: &mut [f64],
) {
    let mut add = |direction: Vec3, weight: f64| {
        let mut entries = JointVec::zeros(dof);
        row(direction, &mut entries);
        add_outer(hessian, weight * bend(v.norm()), &entries);
    };
    for axis in AXES {
        add(axis, weight);
    }
    add(direction(v), -weight);
}
