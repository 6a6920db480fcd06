//! How the cycles of an arm came and were answered, as the thread that answers them counts it.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::histogram::{Distribution, Histogram};

/// The cycles of a run so far. Counting allocates nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CycleTimes {
    period: Histogram,
    answer: Histogram,
    missed: u64,
    repeated: u64,
}

impl CycleTimes {
    /// A package came so long after the one before.
    pub fn came_after(&mut self, period: Duration) {
        self.period.add(period);
    }

    /// Its reference was written so long after it came.
    pub fn answered_after(&mut self, time: Duration) {
        self.answer.add(time);
    }

    /// So many cycles went by of which no package was answered.
    pub fn missed(&mut self, cycles: u64) {
        self.missed += cycles;
    }

    /// A package came again, or an older one.
    pub fn repeated(&mut self) {
        self.repeated += 1;
    }

    /// What the summary says of it; `None` where no package followed another.
    pub fn summary(&self) -> Option<CycleSummary> {
        Some(CycleSummary {
            period_us: self.period.distribution()?,
            answer_us: self.answer.distribution(),
            missed: self.missed,
            repeated: self.repeated,
        })
    }
}

/// How the cycles came and were answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CycleSummary {
    /// From one package of the arm to the next [µs].
    pub period_us: Distribution,
    /// From a package to its reference's being written [µs]; `None` where there was none.
    pub answer_us: Option<Distribution>,
    /// Cycles of which no package was answered.
    pub missed: u64,
    /// Packages that came again, or of a cycle before the last.
    pub repeated: u64,
}
