//! Whether the controller's clock and our answers keep pace: what is late, and what is no clock.

use super::fault::{CLOCK_JUMP, REFERENCES_LATE};
use conik_sim::arm::ArmError;
use std::time::{Duration, Instant};

/// Watches over the time between packages, and between a package and its answer.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    /// Period of the references [s].
    pub(super) cycle_s: f64,
    /// Cycles without a reference that the servo program bridges.
    pub(super) bridged_cycles: u32,
    /// How much further than ours the controller's clock may go from one package to the next.
    pub(super) leap_allowed: Duration,
    /// Whether the controller's clock runs while a reference is computed.
    pub(super) real_time: bool,
}

/// When a package was made, and when it came.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stamp {
    /// The controller's clock [s].
    pub(super) timestamp: f64,
    /// Ours.
    pub(super) came: Instant,
}

impl Pace {
    /// The cycles without a reference between two packages, of which `passed_over` came at once
    /// with the later one.
    pub(super) fn missed(
        &self,
        before: Stamp,
        now: Stamp,
        passed_over: u64,
    ) -> Result<u64, ArmError> {
        goes_on(before, now)?;
        let elapsed = now.timestamp - before.timestamp;
        let here = now.came.saturating_duration_since(before.came);
        if elapsed - here.as_secs_f64() > self.leap_allowed.as_secs_f64() {
            return Err(clock_jump(before, now));
        }
        let by_clock = whole_cycles(elapsed / self.cycle_s).saturating_sub(1);
        let missed = passed_over.max(by_clock);
        if missed > u64::from(self.bridged_cycles) {
            return Err(self.late(&format!("{missed} cycles went by without a reference")));
        }
        Ok(missed)
    }

    /// Whether the answer to a package may still be sent after this time.
    pub(super) fn answer_after(&self, taken: Duration) -> Result<(), ArmError> {
        let bridged_s = f64::from(self.bridged_cycles) * self.cycle_s;
        if self.real_time && taken.as_secs_f64() > bridged_s {
            let taken = taken.as_secs_f64();
            return Err(self.late(&format!("the reference took {taken:.3} s to make")));
        }
        Ok(())
    }

    /// By now the servo program is stopping the arm.
    fn late(&self, what: &str) -> ArmError {
        let cycles = self.bridged_cycles;
        let detail = format!(
            "{what}; at most {cycles} cycles ({:.3} s) are bridged: look for what delayed this \
             computer or the network",
            f64::from(cycles) * self.cycle_s
        );
        ArmError::new(REFERENCES_LATE, detail)
    }
}

/// Whether the clock went on at all: enough before the first reference, when nobody counts.
pub(super) fn goes_on(before: Stamp, now: Stamp) -> Result<(), ArmError> {
    if now.timestamp > before.timestamp {
        Ok(())
    } else {
        Err(clock_jump(before, now))
    }
}

fn clock_jump(before: Stamp, now: Stamp) -> ArmError {
    let what = if now.timestamp > before.timestamp {
        "it leapt ahead of this computer's clock"
    } else {
        "it was restarted or stood still"
    };
    let detail = format!(
        "the controller's clock went from {:.3} s to {:.3} s: {what}",
        before.timestamp, now.timestamp
    );
    ArmError::new(CLOCK_JUMP, detail)
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates; never negative here.
fn whole_cycles(cycles: f64) -> u64 {
    cycles.round() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    const PACE: Pace = Pace {
        cycle_s: 0.008,
        bridged_cycles: 5,
        leap_allowed: Duration::from_millis(500),
        real_time: true,
    };

    #[test]
    fn what_is_late_is_told_from_what_is_no_clock() {
        let came = Instant::now();
        // Time on the controller's clock [s], on ours [ms], packages passed over, and the verdict.
        for (elapsed, here, passed_over, verdict) in [
            (0.008, 8, 0, Ok(0)),
            (0.048, 0, 5, Ok(5)),
            (0.048, 0, 0, Ok(5)),
            (0.008, 48, 0, Ok(0)),
            (0.056, 56, 0, Err(REFERENCES_LATE)),
            (2.0, 2000, 0, Err(REFERENCES_LATE)),
            (0.4, 8, 0, Err(REFERENCES_LATE)),
            (0.6, 8, 0, Err(CLOCK_JUMP)),
            (0.0, 8, 0, Err(CLOCK_JUMP)),
            (-1.0, 8, 0, Err(CLOCK_JUMP)),
            (f64::NAN, 8, 0, Err(CLOCK_JUMP)),
        ] {
            let before = Stamp {
                timestamp: 60.0,
                came,
            };
            let now = Stamp {
                timestamp: 60.0 + elapsed,
                came: came + Duration::from_millis(here),
            };
            let missed = PACE.missed(before, now, passed_over);
            let missed = missed.map_err(|fault| fault.name);
            assert_eq!(missed, verdict, "{elapsed} s there, {here} ms here");
        }
    }

    #[test]
    fn an_answer_is_late_where_time_passes_on_its_own() {
        let late = Duration::from_millis(41);
        PACE.answer_after(Duration::from_millis(40)).unwrap();
        let fault = PACE.answer_after(late).unwrap_err();
        assert_eq!(fault.name, REFERENCES_LATE);
        let lockstep = Pace {
            real_time: false,
            ..PACE
        };
        lockstep.answer_after(late).unwrap();
    }
}
