//! The joints' ranges in a tick, where accelerations are limited: the speeds that each joint may choose
//! from.
//!
//! A range is what the acceleration leaves of the speeds about the last one, cut to the speed limit. Sets
//! come before accelerations: where the anchor had to leave a range, it reaches as far as the anchor.

use alloc::vec::Vec;

use crate::joints::JointVec;
use crate::limits::{Limits, Shortened, push_range, shorten};
use crate::linalg::VIOLATION;

#[derive(Debug)]
pub(crate) struct Ranges {
    least: JointVec,
    greatest: JointVec,
    /// Greatest speed, and greatest change of speed in a period.
    speed: JointVec,
    change: JointVec,
    anchor: JointVec,
}

/// The joints that cut a velocity short.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cut {
    pub(crate) by_speed: Option<Shortened>,
    pub(crate) by_acceleration: Option<Shortened>,
}

impl Ranges {
    /// No joint may move before [`set`](Self::set) says otherwise.
    pub(crate) fn new(dof: usize) -> Self {
        let still = JointVec::zeros(dof);
        Self {
            least: still,
            greatest: still,
            speed: still,
            change: still,
            anchor: still,
        }
    }

    /// The ranges about the last velocity, wide enough for the anchor.
    pub(crate) fn set(&mut self, limits: &Limits, before: &[f64], anchor: &[f64]) {
        self.anchor.copy_from_slice(anchor);
        for (joint, anchor) in anchor.iter().enumerate() {
            let (least, greatest) = limits.range(joint, Some(before));
            self.least[joint] = least.min(*anchor);
            self.greatest[joint] = greatest.max(*anchor);
            (_, self.speed[joint]) = limits.range(joint, None);
            self.change[joint] = limits.speed_change(joint);
        }
    }

    /// A velocity that keeps every set and every range.
    pub(crate) fn anchor(&self) -> &[f64] {
        &self.anchor
    }

    fn iter(&self) -> impl Iterator<Item = (f64, f64)> {
        let pairs = self.least.iter().zip(self.greatest.iter());
        pairs.map(|(least, greatest)| (*least, *greatest))
    }

    /// The ranges as rows a q̇ ≥ b.
    pub(crate) fn push_rows(&self, rows: &mut Vec<f64>, bounds: &mut Vec<f64>) {
        for (joint, range) in self.iter().enumerate() {
            push_range(self.least.len(), joint, range, rows, bounds);
        }
    }

    /// Takes back what rounding put beyond a range. NaN stays what it is.
    pub(crate) fn clamp(&self, velocity: &mut [f64]) {
        for ((least, greatest), speed) in self.iter().zip(velocity) {
            if *speed < least {
                *speed = least;
            } else if *speed > greatest {
                *speed = greatest;
            }
        }
    }

    /// The largest share f ≤ 1 of the way `from` → `to` on which no joint changes by more than its
    /// acceleration allows in a period, wherever in its range it stands.
    pub(crate) fn reach(&self, from: &[f64], to: &[f64]) -> f64 {
        let joints = from.iter().zip(to).zip(self.change.iter());
        let shares = joints.map(|((from, to), change)| change / (to - from).abs());
        shares.fold(1.0, f64::min)
    }

    /// Shortens `to` towards `from`, which is within the speed limits, until it is too.
    pub(crate) fn shorten_to_speed(&self, from: &[f64], to: &mut [f64]) -> Option<Shortened> {
        shorten(to, from, |joint| (-self.speed[joint], self.speed[joint]))
    }

    /// The joints that may have the least share of the way `from` → `to`: that of those that come to
    /// their speed limits, and that of those that come to the end of what their accelerations leave.
    pub(crate) fn cut(&self, from: &[f64], to: &[f64]) -> Cut {
        let mut cut = Cut::default();
        for (joint, (least, greatest)) in self.iter().enumerate() {
            let limit = if to[joint] > greatest + VIOLATION {
                greatest
            } else if to[joint] < least - VIOLATION {
                least
            } else {
                continue;
            };
            let share = (limit - from[joint]) / (to[joint] - from[joint]);
            let factor = share.clamp(0.0, 1.0);
            let found = if limit.abs() < self.speed[joint] {
                &mut cut.by_acceleration
            } else {
                &mut cut.by_speed
            };
            if found.is_none_or(|found| factor < found.factor) {
                *found = Some(Shortened { joint, factor });
            }
        }
        cut
    }
}
