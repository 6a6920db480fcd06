//! How far the arm runs behind its reference, and how closely it follows once that is taken out.
//!
//! For lags of n ticks, in steps of a quarter, the squared differences of q(k) and q_ref(k − n) are
//! summed for each joint; between ticks the reference is interpolated. Since
//! Σ|q − q_ref|² = Σ|q|² + Σ|q_ref|² − 2 Σ q·q_ref, the least sum over all joints is where the two
//! are correlated most. A parabola through it and its neighbours gives the part of a tick.

use std::collections::VecDeque;

use conik::JointVec;

/// Lags tried, in ticks: 0.4 s at 500 Hz.
const LAGS: usize = 200;

/// Steps to a tick.
const PARTS: usize = 4;

/// Lags at which errors are kept: up to the last whole tick.
const STEPS: usize = (LAGS - 1) * PARTS;

/// Below this mean square the references did not move [rad²].
const STILL: f64 = 1e-10;

/// Sums up references and measurements, tick by tick.
#[derive(Clone, Debug)]
pub(crate) struct ServoDelay {
    /// The newest first.
    references: VecDeque<JointVec>,
    /// For each joint, its errors at each lag.
    joints: Vec<Vec<Error>>,
    ticks: u64,
}

/// The error of one joint at one lag.
#[derive(Clone, Copy, Debug, Default)]
struct Error {
    max: f64,
    squares: f64,
}

/// How closely the arm followed the reference of `delay` before.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Delayed {
    /// The delay [ticks].
    pub(crate) ticks: f64,
    /// Largest error of each joint [rad].
    pub(crate) max: Vec<f64>,
    /// Root mean square of each joint's error [rad].
    pub(crate) rms: Vec<f64>,
}

impl ServoDelay {
    pub(crate) fn new(joints: usize) -> Self {
        Self {
            references: VecDeque::with_capacity(LAGS + 1),
            joints: vec![vec![Error::default(); STEPS]; joints],
            ticks: 0,
        }
    }

    /// Takes in one tick.
    pub(crate) fn add(&mut self, reference: &JointVec, measured: &JointVec) {
        self.references.push_front(*reference);
        self.references.truncate(LAGS);
        // Every lag is summed over the same ticks, or their sums could not be compared.
        if self.references.len() < LAGS {
            return;
        }
        self.ticks += 1;
        for (joint, errors) in self.joints.iter_mut().enumerate() {
            let q = measured[joint];
            let mut at = q - self.references[0][joint];
            for (lag, errors) in errors.chunks_exact_mut(PARTS).enumerate() {
                let next = q - self.references[lag + 1][joint];
                for (part, error) in errors.iter_mut().enumerate() {
                    let here = at + (next - at) * part as f64 / PARTS as f64;
                    error.max = error.max.max(here.abs());
                    error.squares += here * here;
                }
                at = next;
            }
        }
    }

    /// `None` where the run was too short, the arm stood still, or no lag fits.
    pub(crate) fn found(&self) -> Option<Delayed> {
        // The parabola is laid through whole ticks: between them, interpolation smooths.
        let squares: Vec<f64> = (0..STEPS)
            .step_by(PARTS)
            .map(|step| self.joints.iter().map(|errors| errors[step].squares).sum())
            .collect();
        let ticks = self.ticks_of(&squares)?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 0 to STEPS.
        let step = ((ticks.max(0.0) * PARTS as f64).round() as usize).min(STEPS - 1);
        let at_delay = || self.joints.iter().map(|errors| errors[step]);
        Some(Delayed {
            ticks,
            max: at_delay().map(|error| error.max).collect(),
            rms: at_delay()
                .map(|error| (error.squares / self.ticks as f64).sqrt())
                .collect(),
        })
    }

    fn ticks_of(&self, squares: &[f64]) -> Option<f64> {
        let (best, least) = squares
            .iter()
            .copied()
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        let most = squares.iter().copied().fold(0.0, f64::max);
        if self.ticks == 0 || most - least <= STILL * self.ticks as f64 || best + 1 == squares.len()
        {
            return None;
        }
        let Some(before) = best.checked_sub(1).map(|before| squares[before]) else {
            return Some(0.0);
        };
        let after = squares[best + 1];
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

    /// An arm that follows a motion of two joints so many ticks late.
    fn followed(late_ticks: f64, ticks: u32, amplitude: f64) -> Option<Delayed> {
        let mut delay = ServoDelay::new(2);
        let q = |tick: f64| {
            JointVec::from([
                amplitude * (0.02 * tick).sin(),
                amplitude * (0.013 * tick).cos(),
            ])
        };
        for tick in 0..ticks {
            let tick = f64::from(tick);
            delay.add(&q(tick), &q(tick - late_ticks));
        }
        delay.found()
    }

    #[test]
    fn a_delay_is_found_to_a_part_of_a_tick_and_taken_out() {
        for late in [0.0, 1.0, 12.5, 50.3, 150.0] {
            let found = followed(late, 2000, 0.3).unwrap();
            assert!((found.ticks - late).abs() < 0.02, "{found:?} is not {late}");
            // At most an eighth of a tick is left of the delay, and what interpolation smooths.
            let left = 0.13 * 0.3 * 0.02 + 0.3 * 0.02 * 0.02 / 8.0;
            for (max, rms) in found.max.iter().zip(&found.rms) {
                assert!(rms <= max && *max <= left, "{found:?}");
            }
        }
    }

    #[test]
    fn what_is_no_delay_is_left() {
        let mut delay = ServoDelay::new(1);
        let q = |tick: f64| 0.3 * (0.02 * tick).sin();
        for tick in 0..3000 {
            let t = f64::from(tick);
            // Once, 10 mrad off.
            let off = if tick == 2000 { 0.01 } else { 0.0 };
            delay.add(&[q(t)].into(), &[q(t - 12.0) + off].into());
        }
        let found = delay.found().unwrap();
        assert!((found.max[0] - 0.01).abs() < 1e-3, "{found:?}");
        assert!(found.rms[0] < 1e-3, "{found:?}");
    }

    #[test]
    fn nothing_is_said_of_an_arm_that_did_not_move_or_not_for_long_enough() {
        assert_eq!(followed(12.0, 2000, 0.0), None);
        assert_eq!(followed(12.0, 150, 0.3), None);
        assert_eq!(followed(220.0, 2000, 0.3), None, "later than any lag tried");
    }
}
