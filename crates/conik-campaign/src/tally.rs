//! How many runs kept what, and how sure that makes us.

use std::collections::BTreeMap;

use crate::class::Class;
use crate::row::Row;

/// Names of the five properties, in the order of the paper's Section VI.
pub const PROPERTIES: [&str; 5] = [
    "equality_converges",
    "inside_stays",
    "outside_never_worse",
    "entered_stays",
    "low_priority_excess",
];

/// What they say.
pub const PROPERTIES_IN_WORDS: [&str; 5] = [
    "1: all equality tasks come to what they are asked",
    "2: high-priority sets that hold at the start hold for ever",
    "3: those that do not are never further out than before",
    "4: once entered, they stay",
    "5: low-priority sets are kept (not promised)",
];

/// Standard deviations of the normal distribution below which 95 % lie.
const Z_95: f64 = 1.644_853_626_951_472_7;

/// How often one property was kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Kept {
    /// Runs that could show it.
    pub shown: u64,
    /// Runs that kept it.
    pub kept: u64,
    /// Worst deviation of all [task's unit], and the run.
    pub worst: f64,
    /// That run.
    pub worst_run: u64,
}

impl Kept {
    /// With 95 % confidence, the share of all such runs that break it is below this (Wilson, 1927).
    pub fn bound(&self) -> f64 {
        let shown = self.shown as f64;
        if self.shown == 0 {
            return 1.0;
        }
        let broken = 1.0 - self.kept as f64 / shown;
        let z2 = Z_95 * Z_95;
        let spread = (broken * (1.0 - broken) / shown + z2 / (4.0 * shown * shown)).sqrt();
        ((broken + z2 / (2.0 * shown) + Z_95 * spread) / (1.0 + z2 / shown)).min(1.0)
    }
}

/// What all runs of a campaign come to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many there were.
    pub runs: u64,
    /// The five properties.
    pub properties: [Kept; 5],
    /// Runs of each class.
    pub classes: BTreeMap<Class, u64>,
    /// For each class the runs that say most of it: the worst ones, at most [`EXAMPLES`].
    pub examples: BTreeMap<Class, Vec<(f64, u64)>>,
    /// When the last waypoint was reached, of those runs in which it was [s].
    pub arrived_s: Vec<f64>,
    /// Mode changes of each run.
    pub mode_changes: Vec<u64>,
}

/// Runs that are kept of each class as examples.
pub const EXAMPLES: usize = 3;

impl Tally {
    /// Takes in one run.
    pub fn take(&mut self, row: &Row) {
        self.runs += 1;
        for ((kept, held), worst) in self.properties.iter_mut().zip(row.kept).zip(row.worst) {
            let Some(held) = held else { continue };
            kept.shown += 1;
            kept.kept += u64::from(held);
            if worst > kept.worst {
                (kept.worst, kept.worst_run) = (worst, row.run);
            }
        }
        *self.classes.entry(row.class).or_default() += 1;
        if row.class != Class::None {
            let examples = self.examples.entry(row.class).or_default();
            examples.push((severity(row), row.run));
            // The worst first; of equals that of the lower number.
            examples.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            examples.truncate(EXAMPLES);
        }
        self.arrived_s.extend(row.arrived_s);
        self.mode_changes.push(row.mode_changes);
    }

    /// Runs that no class explains.
    pub fn unexplained(&self) -> u64 {
        self.classes.get(&Class::Unexplained).copied().unwrap_or(0)
    }
}

/// How bad a failure is, among those of its class.
fn severity(row: &Row) -> f64 {
    let measured = row.measured_violations.iter().flatten().copied();
    match row.class {
        Class::ServoLag => measured.fold(0.0, f64::max),
        Class::Freeze | Class::Announced => row.worst[1..4].iter().copied().fold(0.0, f64::max),
        _ => row.worst[0],
    }
}

/// The value below which so large a share of the numbers lies.
pub fn quantile(numbers: &mut [f64], share: f64) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let last = numbers.len().checked_sub(1)?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the list"
    )]
    let at = (share.clamp(0.0, 1.0) * last as f64).round() as usize;
    numbers.get(at).copied()
}
