//! How a level is damped where it loses a direction.

use crate::settings::Recursion;

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
    /// Every direction, everywhere, by the same λ [task's unit per rad]: min |J q̇ − s|² + λ² |q̇|².
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
        match self {
            Self::None => 0.0,
            Self::Fixed(lambda) => lambda * lambda,
            Self::Automatic | Self::Smallest | Self::PerDirection => variable,
        }
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
