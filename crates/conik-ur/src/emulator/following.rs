//! When `servoj` asks for what the arm cannot follow, which makes a protective stop.
//!
//! The thresholds of real controllers are not published: both are our choice.

use super::arm::six;
use crate::registers::JOINTS;
use conik_sim::servo::Servo;

/// How much more than its limit a joint may need before it counts: a ramp at the limit itself is
/// followed.
const SPEED_ALLOWANCE: f64 = 1.01;

/// Why a target cannot be followed; joints are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(super) enum NotFollowed {
    #[error("sudden change in target position: joint {joint} by {step} rad")]
    Jump { joint: usize, step: f64 },
    #[error(
        "the arm cannot follow: joint {joint} has needed more than {limit:.2} rad/s for {cycles} \
         cycles, now {speed:.2}"
    )]
    TooFast {
        joint: usize,
        limit: f64,
        speed: f64,
        cycles: u64,
    },
}

/// Watches the targets of `servoj`.
#[derive(Clone, Debug)]
pub(super) struct Following {
    /// The largest step from one target to the next [rad].
    largest_step: f64,
    /// Control cycles for which following may need more than the speed limit.
    patience: u64,
    /// The last target [rad]; none before the first and after the arm was told otherwise.
    target: Option<[f64; JOINTS]>,
    /// Control cycles in a row that needed more.
    too_fast: u64,
}

impl Following {
    pub(super) fn new(largest_step: f64, patience_s: f64, rate_hz: f64) -> Self {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates.
        let patience = (patience_s * rate_hz).round() as u64;
        Self {
            largest_step,
            patience,
            target: None,
            too_fast: 0,
        }
    }

    /// Whether the arm can follow this target for one cycle more.
    pub(super) fn check(
        &mut self,
        target: &[f64; JOINTS],
        servo: &Servo,
    ) -> Result<(), NotFollowed> {
        let from = self.target.unwrap_or(six(servo.q()));
        for joint in 0..JOINTS {
            let step = (target[joint] - from[joint]).abs();
            // Written so that no step to a target that is not finite is small.
            let is_small = step <= self.largest_step;
            if !is_small {
                let joint = joint + 1;
                return Err(NotFollowed::Jump { joint, step });
            }
        }
        self.target = Some(*target);
        let limits = servo.speed_limits();
        let needed = servo.speed_needed(&(*target).into());
        let too_fast = |(joint, speed): &(usize, f64)| *speed > limits[*joint] * SPEED_ALLOWANCE;
        let Some((joint, speed)) = needed.filter(too_fast) else {
            self.too_fast = 0;
            return Ok(());
        };
        self.too_fast += 1;
        if self.too_fast <= self.patience {
            return Ok(());
        }
        Err(NotFollowed::TooFast {
            joint: joint + 1,
            limit: limits[joint],
            speed,
            cycles: self.too_fast,
        })
    }

    /// The next target is held against where the arm is.
    pub(super) fn forget(&mut self) {
        (self.target, self.too_fast) = (None, 0);
    }
}
