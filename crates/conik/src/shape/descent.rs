//! Where a function that falls and then rises along a way is least on it.

use crate::geometry::Vec3;

/// A place on a way, and what the function is there.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// How far along the way.
    pub(super) t: f64,
    pub(super) value: f64,
    /// Of the function, in space. Where that has a kink, the one of its gradients that does not lead along the
    /// way.
    pub(super) gradient: Vec3,
    pub(super) point: Vec3,
    /// How it grows along the way.
    pub(super) slope: f64,
}

/// Halving alone finds a place in [0, 1] to rounding in half as many.
const MOST_EVALUATIONS: usize = 110;

/// The least place between two, of which `at` tells what is between them.
///
/// Its slope changes sign once: secants and halving by turns, at most 110 evaluations, close in on where,
/// until it is `small`. Where it leaps there, as over an edge, so do gradients, and the one between them
/// that does not lead along the way is the gradient of the least value.
#[inline]
pub(super) fn least(low: Place, high: Place, small: f64, at: impl Fn(f64) -> Place) -> Place {
    let (mut low, mut high) = (low, high);
    if low.slope >= 0.0 {
        return low;
    }
    if high.slope <= 0.0 {
        return high;
    }
    for i in 2..MOST_EVALUATIONS {
        let width = high.t - low.t;
        let secant = low.t - low.slope * width / (high.slope - low.slope);
        let middle = low.t + 0.5 * width;
        let t = if i % 2 == 0 { secant } else { middle };
        if !(low.t < t && t < high.t) {
            break;
        }
        let here = at(t);
        if here.slope.abs() <= small {
            return here;
        }
        *(if here.slope < 0.0 {
            &mut low
        } else {
            &mut high
        }) = here;
    }
    let share = -low.slope / (high.slope - low.slope);
    Place {
        t: low.t + (high.t - low.t) * share,
        value: low.value + (high.value - low.value) * share,
        gradient: low.gradient + (high.gradient - low.gradient) * share,
        point: low.point + (high.point - low.point) * share,
        slope: 0.0,
    }
}
