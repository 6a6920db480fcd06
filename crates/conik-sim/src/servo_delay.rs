//! How far the arm runs behind its reference: the shift in time at which both agree best.
//!
//! For each lag of n ticks the squared differences of q(k) and q_ref(k − n) are summed over all
//! joints. Since Σ|q − q_ref|² = Σ|q|² + Σ|q_ref|² − 2 Σ q·q_ref, the least of them is where the
//! two are correlated most. A parabola through it and its neighbours gives the part of a tick.

use std::collections::VecDeque;

use conik::JointVec;

/// Lags tried, in ticks: 0.4 s at 500 Hz.
const LAGS: usize = 200;

/// Below this mean square the references did not move [rad²].
const STILL: f64 = 1e-10;

/// Sums up references and measurements, tick by tick.
#[derive(Clone, Debug)]
pub(crate) struct ServoDelay {
    /// The newest first.
    references: VecDeque<JointVec>,
    squares: Vec<f64>,
    ticks: u64,
}

impl Default for ServoDelay {
    fn default() -> Self {
        Self {
            references: VecDeque::with_capacity(LAGS + 1),
            squares: vec![0.0; LAGS],
            ticks: 0,
        }
    }
}

impl ServoDelay {
    /// Takes in one tick.
    pub(crate) fn add(&mut self, reference: &JointVec, measured: &JointVec) {
        self.references.push_front(*reference);
        self.references.truncate(LAGS);
        // Every lag is summed over the same ticks, or their sums could not be compared.
        if self.references.len() < LAGS {
            return;
        }
        self.ticks += 1;
        for (sum, reference) in self.squares.iter_mut().zip(&self.references) {
            for (q, q_ref) in measured.iter().zip(reference.iter()) {
                *sum += (q - q_ref) * (q - q_ref);
            }
        }
    }

    /// The delay [ticks]; `None` where the run was too short, the arm stood still, or no lag fits.
    pub(crate) fn ticks(&self) -> Option<f64> {
        let (best, least) = self
            .squares
            .iter()
            .copied()
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        let most = self.squares.iter().copied().fold(0.0, f64::max);
        if self.ticks == 0 || most - least <= STILL * self.ticks as f64 || best + 1 == LAGS {
            return None;
        }
        let Some(before) = best.checked_sub(1).map(|before| self.squares[before]) else {
            return Some(0.0);
        };
        let after = self.squares[best + 1];
        let curvature = before - 2.0 * least + after;
        let part = if curvature > 0.0 {
            0.5 * (before - after) / curvature
        } else {
            0.0
        };
        Some(best as f64 + part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn delay(late_ticks: f64, ticks: u32, amplitude: f64) -> Option<f64> {
        let mut delay = ServoDelay::default();
        let q = |tick: f64| {
            JointVec::from([
                1.0 + amplitude * (0.02 * tick).sin(),
                amplitude * (0.013 * tick).cos(),
            ])
        };
        for tick in 0..ticks {
            let tick = f64::from(tick);
            delay.add(&q(tick), &q(tick - late_ticks));
        }
        delay.ticks()
    }

    #[test]
    fn a_delay_is_found_to_a_part_of_a_tick() {
        for late in [0.0, 1.0, 12.5, 50.3, 150.0] {
            let found = delay(late, 2000, 0.3).unwrap();
            assert!((found - late).abs() < 0.02, "{found} is not {late}");
        }
    }

    #[test]
    fn nothing_is_said_of_an_arm_that_did_not_move_or_not_for_long_enough() {
        assert_eq!(delay(12.0, 2000, 0.0), None);
        assert_eq!(delay(12.0, 150, 0.3), None);
        assert_eq!(delay(220.0, 2000, 0.3), None, "later than any lag tried");
    }
}
