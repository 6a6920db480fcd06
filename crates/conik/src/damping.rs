//! How a level is damped where it loses a direction.

use crate::settings::Recursion;

/// Greatest λ² [(task's unit per rad)²]. What one tick needs to come to rest has no bound: sets that contradict
/// each other push back as hard as they please. A direction that is damped so much all but stands still,
/// and l₀² of the directions that are not is not yet lost in rounding beside it.
const MOST: f64 = 1e6;

/// How the velocity of a level is damped near a singularity of its task, or where the rows above leave
/// too little of one of its directions.
///
/// Damping slows a level down; it never touches the null-space projectors, so what stands above a damped
/// level stays exactly where it is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Damping {
    /// What suits the recursion and the rule: [`PerDirection`](Self::PerDirection) with
    /// [`SicilianoSlotine`](Recursion::SicilianoSlotine); with [`Chiaverini`](Recursion::Chiaverini)
    /// [`Smallest`](Self::Smallest) under rule `Cone`, and [`None`](Self::None), as in the paper, under
    /// `Paper` and `Border`.
    #[default]
    Automatic,
    /// Not at all. Near a singularity velocities grow without bound, up to the joints' speed limits.
    None,
    /// Every direction, everywhere, by the same λ [task's unit per rad]: min |J q̇ − s|² + λ² |q̇|². With λ = 1000 a level
    /// all but stands still, and a greater λ counts as that.
    Fixed(f64),
    /// Every direction alike, the more the smaller the smallest singular value is (Nakamura and
    /// Hanafusa 1986), and as strongly as one tick needs to come to rest.
    Smallest,
    /// Each singular direction by its own singular value: a direction that is lost does not slow down
    /// the others.
    PerDirection,
}

impl Damping {
    /// What `Automatic` stands for.
    pub(crate) fn or_else(self, automatic: Self) -> Self {
        if self == Self::Automatic {
            automatic
        } else {
            self
        }
    }

    /// λ² [(task's unit per rad)²], where `variable` is what one tick needs to come to rest.
    pub(crate) fn lambda_squared(self, variable: f64) -> f64 {
        let squared = match self {
            Self::None => 0.0,
            Self::Fixed(lambda) => lambda * lambda,
            Self::Automatic | Self::Smallest | Self::PerDirection => variable,
        };
        squared.min(MOST)
    }

    /// What `Automatic` stands for under rule `Cone`.
    pub(crate) fn of_cone(recursion: Recursion) -> Self {
        match recursion {
            Recursion::Chiaverini => Self::Smallest,
            Recursion::SicilianoSlotine => Self::PerDirection,
        }
    }

    /// What `Automatic` stands for under the rules `Paper` and `Border`.
    pub(crate) fn of_search(recursion: Recursion) -> Self {
        match recursion {
            Recursion::Chiaverini => Self::None,
            Recursion::SicilianoSlotine => Self::PerDirection,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::STRICT;

    #[test]
    fn rounding_of_the_strongest_damping_is_less_than_what_makes_a_program_strictly_convex() {
        let strongest = [
            Damping::Fixed(1e100),
            Damping::Smallest,
            Damping::PerDirection,
        ];
        for damping in strongest {
            let lambda_squared = damping.lambda_squared(1e18);
            assert!(
                lambda_squared >= 1e5,
                "{damping:?}: {lambda_squared} is not strong"
            );
            assert!(
                1e3 * lambda_squared * f64::EPSILON < STRICT * STRICT,
                "{damping:?}: {lambda_squared}"
            );
        }
    }
}
