//! How a controller works: rate and rules.

/// Which rule chooses the active set-based tasks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ModeRule {
    /// The paper's: all subsets, fewest members first, then list order; the first in which every
    /// inactive set passes the tangent-cone test. It may freeze a task strictly inside its set.
    Paper,
    /// The same, but only tasks at or outside their border may be active.
    Border,
    /// At each level the velocity nearest to what the task asks, among those that keep every
    /// high-priority set inside its tangent cone. Freezes nothing that would not leave, and does not
    /// depend on the order of the sets.
    #[default]
    Cone,
}

/// What happens at the border of a set between samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Border {
    /// An active high-priority set is frozen where it is, as in the paper. The sample at which it
    /// is found outside is not undone, so samples may lie outside by a term of first order in the
    /// control period.
    Freeze,
    /// The next sample of every high-priority set is computed before it is committed, and corrected
    /// until it is inside: every sample lies in every set that was ever entered.
    #[default]
    Land,
}

/// How the velocity of a level is fitted under the levels above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Recursion {
    /// q̇ = Σ N J⁺ σ̇_ref, the paper's singularity-robust form: each level is solved alone, then
    /// projected.
    Chiaverini,
    /// q̇ ← q̇ + (J N)⁺ (σ̇_ref − J q̇): each level is fitted to what the levels above leave of it. Exact
    /// while feasible; damped where a level loses a direction to the levels above.
    #[default]
    SicilianoSlotine,
}

/// How a [`Controller`](crate::Controller) works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Control rate [Hz]; the period is T = 1 / rate.
    pub rate_hz: f64,
    /// Which rule chooses the active set-based tasks.
    pub mode_rule: ModeRule,
    /// What happens at the border of a set between samples.
    pub border: Border,
    /// How lower levels are fitted under higher ones.
    pub recursion: Recursion,
}

impl Settings {
    /// Rule `Cone`, border `Land` and recursion `SicilianoSlotine` at a control rate [Hz].
    pub fn at_rate(rate_hz: f64) -> Self {
        Self {
            rate_hz,
            mode_rule: ModeRule::default(),
            border: Border::default(),
            recursion: Recursion::default(),
        }
    }

    /// The settings of the paper: rule `Paper`, border `Freeze`, recursion `Chiaverini`, 125 Hz.
    pub fn of_the_paper() -> Self {
        Self {
            rate_hz: 125.0,
            mode_rule: ModeRule::Paper,
            border: Border::Freeze,
            recursion: Recursion::Chiaverini,
        }
    }
}
