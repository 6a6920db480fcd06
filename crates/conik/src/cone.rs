//! Sets of allowed values and their tangent cones: Section III of the paper.

use core::ops::{RangeFrom, RangeInclusive, RangeToInclusive};

/// The valid set C = [min, max] of a set-based task, Eq. (2) of Moe et al. 2015.
///
/// An absent side is infinite. Ranges convert: `0.18..`, `..=0.2622`, `-1.0..=1.0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least allowed value, or −∞.
    pub min: f64,
    /// Greatest allowed value, or +∞.
    pub max: f64,
}

impl Interval {
    /// Whether the bounds are numbers, in order, and at least one of them is finite.
    pub fn is_valid(&self) -> bool {
        self.min <= self.max
            && self.min < f64::INFINITY
            && self.max > f64::NEG_INFINITY
            && (self.min.is_finite() || self.max.is_finite())
    }

    /// Whether the value is inside or on the border.
    #[inline]
    pub fn contains(&self, sigma: f64) -> bool {
        self.min <= sigma && sigma <= self.max
    }

    /// Whether the value is on the border or outside: only there can a task fail the cone test.
    #[inline]
    pub fn is_at_border(&self, sigma: f64) -> bool {
        sigma <= self.min || sigma >= self.max
    }

    /// How far outside the value is; 0 inside.
    #[inline]
    pub fn violation(&self, sigma: f64) -> f64 {
        (self.min - sigma).max(sigma - self.max).max(0.0)
    }

    /// Whether the least allowed value is the bound that was crossed or, from inside, the nearest.
    #[inline]
    pub fn is_nearer_to_min(&self, sigma: f64) -> bool {
        sigma - self.min <= self.max - sigma
    }

    /// The bound that was crossed or, from inside, the nearest one: σ_des of an active low-priority
    /// set, Eq. (28).
    #[inline]
    pub fn nearest_bound(&self, sigma: f64) -> f64 {
        if self.is_nearer_to_min(sigma) {
            self.min
        } else {
            self.max
        }
    }

    /// σ̇ ∈ T_C(σ): whether a task at `sigma` that changes at `sigma_dot` stays or comes closer.
    ///
    /// The extended tangent cone, `in_T_C` in Section III of the paper and Fig. 3: false only on
    /// the border or outside with a derivative that points away from the set. Where both bounds
    /// coincide each side is tested, so that there only σ̇ = 0 passes.
    #[inline]
    pub fn tangent_cone_contains(&self, sigma_dot: f64, sigma: f64) -> bool {
        let leaves_below = sigma <= self.min && sigma_dot < 0.0;
        let leaves_above = sigma >= self.max && sigma_dot > 0.0;
        !(leaves_below || leaves_above)
    }
}

impl From<RangeFrom<f64>> for Interval {
    fn from(range: RangeFrom<f64>) -> Self {
        Self {
            min: range.start,
            max: f64::INFINITY,
        }
    }
}

impl From<RangeToInclusive<f64>> for Interval {
    fn from(range: RangeToInclusive<f64>) -> Self {
        Self {
            min: f64::NEG_INFINITY,
            max: range.end,
        }
    }
}

impl From<RangeInclusive<f64>> for Interval {
    fn from(range: RangeInclusive<f64>) -> Self {
        Self {
            min: *range.start(),
            max: *range.end(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The listing of Section III, branch by branch.
    #[allow(
        clippy::if_same_then_else,
        clippy::needless_bool,
        reason = "as printed"
    )]
    fn in_t_c(sigma_dot: f64, sigma: f64, min: f64, max: f64) -> bool {
        if sigma > min && sigma < max {
            true
        } else if sigma <= min && sigma_dot >= 0.0 {
            true
        } else if sigma <= min && sigma_dot < 0.0 {
            false
        } else if sigma >= max && sigma_dot <= 0.0 {
            true
        } else {
            false
        }
    }

    #[test]
    fn tangent_cone_agrees_with_the_listing_of_the_paper() {
        let set = Interval::from(-1.0..=2.0);
        for sigma in [-5.0, -1.0, -0.999, 0.0, 1.999, 2.0, 7.0] {
            for sigma_dot in [-1.0, -1e-300, 0.0, 1e-300, 1.0] {
                assert_eq!(
                    set.tangent_cone_contains(sigma_dot, sigma),
                    in_t_c(sigma_dot, sigma, -1.0, 2.0),
                    "sigma {sigma}, sigma_dot {sigma_dot}"
                );
            }
        }
    }

    #[test]
    fn a_set_of_one_value_allows_no_motion_from_it() {
        let point = Interval::from(1.0..=1.0);
        assert!(point.tangent_cone_contains(0.0, 1.0));
        assert!(!point.tangent_cone_contains(0.1, 1.0));
        assert!(!point.tangent_cone_contains(-0.1, 1.0));
    }

    #[test]
    fn one_sided_sets_have_no_border_on_the_open_side() {
        let above = Interval::from(0.18..);
        assert!(above.is_at_border(0.18) && above.is_at_border(0.1));
        assert!(!above.is_at_border(1e300));
        assert_eq!(above.nearest_bound(100.0), 0.18);
        assert_eq!(Interval::from(..=0.5).nearest_bound(-100.0), 0.5);
    }

    #[test]
    fn unusable_bounds_are_recognised() {
        assert!(Interval::from(0.0..=0.0).is_valid());
        assert!(!Interval::from(1.0..=0.0).is_valid());
        assert!(!Interval::from(f64::NAN..).is_valid());
        assert!(!Interval::from(f64::INFINITY..).is_valid());
        assert!(!Interval::from(f64::NEG_INFINITY..).is_valid());
    }
}
