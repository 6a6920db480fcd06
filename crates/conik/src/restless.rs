//! An arm that turns back from tick to tick because sets that pull against each other cannot all be kept.
//!
//! One of them moves, or none of this would arise. Each tick then finds the velocity of the least
//! violation, and where the rows of two sets are all but opposite, that leaps from one end of the joints'
//! ranges to the other. It helps no set, and no arm should do it: while it goes on, the velocity changes
//! by a smaller and smaller share of what is asked.

/// Joint speeds below this do not count as turning back [rad/s or m/s].
const FELT: f64 = 1e-2;

/// A single turn is none: the share is used once this many times less than all is left of it.
const ROUSED: f64 = 3.0;

/// And until so little is missing from all.
const CALM: f64 = 1.01;

/// No share is smaller than one part in this.
const MOST: f64 = 1e3;

/// In this time, what is missing from all of it falls to some third, if nothing turns back [s].
const EASES_IN: f64 = 0.35;

#[derive(Debug)]
pub(crate) struct Restless {
    /// How many times less than all of a change of velocity is allowed.
    factor: f64,
    /// Whether it counts.
    is_roused: bool,
    /// What is left of the surplus of the factor after a period.
    easing: f64,
}

impl Restless {
    pub(crate) fn new(period: f64) -> Self {
        Self {
            factor: 1.0,
            is_roused: false,
            easing: 1.0 / (1.0 + period / EASES_IN),
        }
    }

    /// A tick in which nothing turned back.
    pub(crate) fn ease(&mut self) {
        self.factor = 1.0 + self.easing * (self.factor - 1.0);
        self.is_roused &= self.factor > CALM;
    }

    /// Turns the velocity of a tick that must leave a set into a steadier one, nearer to the one `before`.
    /// `false` if it is to stay as it is.
    pub(crate) fn steady(&mut self, qd: &mut [f64], before: &[f64]) -> bool {
        let turned_back = |(now, before): (&f64, &f64)| {
            now * before < 0.0 && now.abs() > FELT && before.abs() > FELT
        };
        if qd.iter().zip(before).any(turned_back) {
            self.factor = (2.0 * self.factor).min(MOST);
            self.is_roused |= self.factor >= ROUSED;
        } else {
            self.ease();
        }
        if !self.is_roused {
            return false;
        }
        for (speed, before) in qd.iter_mut().zip(before) {
            *speed = before + (*speed - before) / self.factor;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steadied(restless: &mut Restless, qd: f64, before: f64) -> f64 {
        let mut qd = [qd];
        restless.steady(&mut qd, &[before]);
        qd[0]
    }

    #[test]
    fn a_single_turn_is_none_and_each_further_one_halves_what_is_left() {
        let mut restless = Restless::new(0.008);
        assert_eq!(steadied(&mut restless, -3.0, 3.0), -3.0);
        assert_eq!(steadied(&mut restless, 3.0, -3.0), -3.0 + 6.0 / 4.0);
        assert_eq!(steadied(&mut restless, -3.0, 3.0), 3.0 - 6.0 / 8.0);
        for _ in 0..100 {
            restless.steady(&mut [3.0], &[-3.0]);
        }
        assert_eq!(steadied(&mut restless, -3.0, 3.0), 3.0 - 6.0 / MOST);
    }

    #[test]
    fn what_goes_on_is_followed() {
        let mut restless = Restless::new(0.008);
        for _ in 0..3 {
            restless.steady(&mut [3.0], &[-3.0]);
        }
        let mut before = 0.0;
        for _ in 0..200 {
            before = steadied(&mut restless, 0.5, before);
        }
        assert!((before - 0.5).abs() < 1e-9, "{before}");
    }

    #[test]
    fn it_eases_at_every_rate_alike_and_then_needs_two_turns_again() {
        for rate in [50_u32, 1000] {
            let mut restless = Restless::new(1.0 / f64::from(rate));
            for _ in 0..2 {
                restless.steady(&mut [-3.0], &[3.0]);
            }
            for _ in 0..rate / 4 {
                restless.ease();
            }
            let share = steadied(&mut restless, 1.0, 0.0);
            assert!((share - 0.4).abs() < 0.02, "{share} at {rate} Hz");
            for _ in 0..4 * rate {
                restless.ease();
            }
            assert_eq!(steadied(&mut restless, -3.0, 3.0), -3.0);
        }
    }

    #[test]
    fn rounding_does_not_turn_back() {
        let mut restless = Restless::new(0.008);
        for tick in 0..100 {
            let sign = if tick % 2 == 0 { 1.0 } else { -1.0 };
            let mut qd = [sign * 0.5 * FELT, 1.0];
            assert!(!restless.steady(&mut qd, &[-sign * 0.5 * FELT, 1.0]));
        }
    }
}
