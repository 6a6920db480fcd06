//! Whether the controller makes packages as often as it was asked to, by its own clock.

use super::fault::RATE_NOT_POSSIBLE;
use conik_sim::arm::ArmError;

/// With fewer packages nothing is said: a few may be late or left out.
const ENOUGH: usize = 10;

/// Packages beyond this number tell nothing new.
const MOST: usize = 100;

/// The clock's steps from package to package.
#[derive(Clone, Debug, Default)]
pub(super) struct RateCheck {
    steps_s: Vec<f64>,
}

impl RateCheck {
    /// Takes in that the clock went on by so much over so many packages.
    pub(super) fn add(&mut self, elapsed_s: f64, packages: u64) {
        if self.steps_s.len() < MOST && packages > 0 {
            self.steps_s.push(elapsed_s / packages as f64);
        }
    }

    /// Whether most packages come a period apart.
    pub(super) fn check(mut self, period_s: f64) -> Result<(), ArmError> {
        if self.steps_s.len() < ENOUGH {
            return Ok(());
        }
        self.steps_s.sort_by(f64::total_cmp);
        let median = self.steps_s[self.steps_s.len() / 2];
        if (0.75..1.5).contains(&(median / period_s)) {
            return Ok(());
        }
        let detail = format!(
            "packages were asked for every {:.3} ms, and by the controller's clock one is made \
             every {:.3} ms: ask for a rate that it can keep (--rate-hz)",
            1e3 * period_s,
            1e3 * median
        );
        Err(ArmError::new(RATE_NOT_POSSIBLE, detail))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_controller_that_does_not_keep_the_rate_is_told_from_one_that_was_late() {
        let check = |steps: &[(f64, u64)]| {
            let mut rate = RateCheck::default();
            for step in steps {
                rate.add(step.0, step.1);
            }
            rate.check(0.002).map_err(|fault| fault.name)
        };
        assert_eq!(check(&[(0.002, 1); 10]), Ok(()));
        assert_eq!(check(&[(0.006, 3); 10]), Ok(()), "passed over, but made");
        let mut late = [(0.002, 1); 15];
        late[3] = (0.050, 1);
        late[9].0 = 0.0004;
        assert_eq!(check(&late), Ok(()));
        assert_eq!(check(&[(0.008, 1); 10]), Err(RATE_NOT_POSSIBLE));
        assert_eq!(check(&[(0.001, 1); 10]), Err(RATE_NOT_POSSIBLE));
        assert_eq!(check(&[(0.008, 1); 9]), Ok(()), "too few to tell");
    }
}
