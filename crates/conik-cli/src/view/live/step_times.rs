//! Times of the last steps of the controller, for those who watch.

use std::collections::VecDeque;

use conik_sim::summary::StepTime;

/// How many steps are looked at.
const STEPS: usize = 1000;

/// Times of the last steps [ns].
#[derive(Debug, Default)]
pub(super) struct StepTimes {
    last: VecDeque<u64>,
}

impl StepTimes {
    pub(super) fn add(&mut self, step_ns: u64) {
        if self.last.len() == STEPS {
            self.last.pop_front();
        }
        self.last.push_back(step_ns);
    }

    /// Median, 99 % and greatest; `None` before the first step.
    pub(super) fn summary(&self) -> Option<StepTime> {
        let mut sorted: Vec<u64> = self.last.iter().copied().collect();
        sorted.sort_unstable();
        let at = |share: usize| {
            let time = *sorted.get(sorted.len().checked_sub(1)? * share / 100)?;
            Some(time as f64 / 1e3)
        };
        Some(StepTime {
            median: at(50)?,
            p99: at(99)?,
            max: at(100)?,
        })
    }
}
