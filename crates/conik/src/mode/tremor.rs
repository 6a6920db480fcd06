//! Tremor: a level whose motion turns back from tick to tick.
//!
//! The λ² of a level (see `level`) is an estimate of what one tick needs to come to rest. Where it is too
//! small, because a row turns quickly or leans on others, each tick overshoots the rest and the next
//! one comes back. That shows: a joint turns back at once. The level's λ² is then doubled, and while
//! nothing turns back it falls again. Only directions that are being lost are damped, so a level that
//! can have what it asks feels nothing of this.

use alloc::vec::Vec;

/// Joint speeds below this are no tremor [rad/s or m/s].
const FELT: f64 = 1e-3;

/// What is left of the surplus of λ² after a tick in which nothing turned back.
const EASING: f64 = 0.98;

/// λ² is raised to at most so many times the estimate.
const MOST: f64 = 1e6;

#[derive(Debug)]
pub(super) struct Tremor {
    /// What each level added to the velocity in the last tick.
    motions: Vec<f64>,
    /// How many times its estimate each level's λ² is.
    factors: Vec<f64>,
    dof: usize,
}

impl Tremor {
    pub(super) fn new(levels: usize, dof: usize) -> Self {
        Self {
            motions: alloc::vec![0.0; levels * dof],
            factors: alloc::vec![1.0; levels],
            dof,
        }
    }

    /// How many times its estimate the λ² of a level is to be.
    pub(super) fn factor(&self, level: usize) -> f64 {
        self.factors[level]
    }

    /// Takes in what a level added to `from`, the velocity of the levels above.
    pub(super) fn observe(&mut self, level: usize, from: &[f64], velocity: &[f64]) {
        let motions = &mut self.motions[level * self.dof..][..self.dof];
        let mut turns_back = false;
        for ((before, from), velocity) in motions.iter_mut().zip(from).zip(velocity) {
            let now = velocity - from;
            turns_back |= (now > FELT && *before < -FELT) || (now < -FELT && *before > FELT);
            *before = now;
        }
        let factor = &mut self.factors[level];
        *factor = if turns_back {
            (2.0 * *factor).min(MOST)
        } else {
            1.0 + EASING * (*factor - 1.0)
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STILL: [f64; 2] = [0.0, 0.0];

    #[test]
    fn a_level_that_turns_back_stiffens_and_eases_when_it_no_longer_does() {
        let mut tremor = Tremor::new(2, 2);
        for tick in 0..4 {
            let speed = if tick % 2 == 0 { 0.01 } else { -0.01 };
            tremor.observe(1, &STILL, &[1.0, speed]);
        }
        assert_eq!(tremor.factor(1), 8.0, "it turned back three times");
        assert_eq!(tremor.factor(0), 1.0, "the other level did not");
        for _ in 0..500 {
            tremor.observe(1, &STILL, &[1.0, 0.01]);
        }
        assert!(tremor.factor(1) < 1.001);
    }

    #[test]
    fn what_the_levels_above_do_is_not_its_tremor() {
        let mut tremor = Tremor::new(1, 2);
        for speed in [0.5, -0.5, 0.5] {
            tremor.observe(0, &[speed, 0.0], &[speed + 0.1, 0.0]);
        }
        assert_eq!(tremor.factor(0), 1.0);
    }

    #[test]
    fn rounding_is_no_tremor_and_stiffening_has_an_end() {
        let mut tremor = Tremor::new(1, 1);
        for tick in 0..100 {
            let sign = if tick % 2 == 0 { 1.0 } else { -1.0 };
            tremor.observe(0, &[0.0], &[sign * 0.5 * FELT]);
        }
        assert_eq!(tremor.factor(0), 1.0);
        for tick in 0..100 {
            let sign = if tick % 2 == 0 { 1.0 } else { -1.0 };
            tremor.observe(0, &[0.0], &[sign]);
        }
        assert_eq!(tremor.factor(0), MOST);
    }
}
