//! Limits of the joints' speeds and accelerations.
//!
//! A velocity that exceeds a limit is shortened as a whole, towards one that keeps every set (its
//! [`Anchor`](crate::anchor::Anchor)): what lies between two velocities that keep a set keeps it too,
//! while clamping single joints would turn J q̇ out of its cone. Sets come before accelerations.
//!
//! With rule `Cone` and limited accelerations each level is chosen within the limits instead
//! ([`Ranges`](crate::ranges::Ranges)): shortening the whole velocity would leave the equality tasks.

use alloc::vec::Vec;

use crate::linalg::exceeds;
use crate::robot::Robot;

/// A joint at whose limit the velocity was shortened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortened {
    /// Index of the joint.
    pub joint: usize,
    /// What is left of the way from the anchor to the velocity asked for, in [0, 1). Where standing
    /// still keeps every set and accelerations are not limited, the factor on the whole velocity. With
    /// rule `Cone` and limited accelerations, what this joint has left of the way that the first level
    /// which was cut short asks of it.
    pub factor: f64,
}

/// A joint that accelerated beyond its limit, because a set could not have been kept otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exceeded {
    /// Index of the joint.
    pub joint: usize,
    /// Its acceleration in units of its limit, above 1.
    pub times: f64,
}

#[derive(Debug)]
pub(crate) struct Limits {
    speed: Vec<f64>,
    /// Greatest change of speed in a period; `None` if no joint has an acceleration limit.
    speed_change: Option<Vec<f64>>,
    period: f64,
}

impl Limits {
    pub(crate) fn new(robot: &Robot, period: f64) -> Self {
        let joints = || robot.joints().iter().map(|joint| joint.limits);
        Self {
            period,
            speed: joints()
                .map(|limits| limits.speed.unwrap_or(f64::INFINITY))
                .collect(),
            speed_change: joints()
                .any(|limits| limits.acceleration.is_some())
                .then(|| {
                    joints()
                        .map(|limits| limits.acceleration.unwrap_or(f64::INFINITY) * period)
                        .collect()
                }),
        }
    }

    /// Greatest acceleration of each joint, infinite where there is none; `None` if no joint has one.
    pub(crate) fn accelerations(&self) -> Option<Vec<f64>> {
        let changes = self.speed_change.as_ref()?;
        Some(changes.iter().map(|change| change / self.period).collect())
    }

    pub(crate) fn has_acceleration(&self) -> bool {
        self.speed_change.is_some()
    }

    /// Greatest change of a joint's speed in a period, infinite where there is none.
    pub(crate) fn speed_change(&self, joint: usize) -> f64 {
        let changes = self.speed_change.as_ref();
        changes.map_or(f64::INFINITY, |changes| changes[joint])
    }

    /// Least and greatest speed of a joint, and whether the acceleration is asked too.
    pub(crate) fn range(&self, joint: usize, before: Option<&[f64]>) -> (f64, f64) {
        let speed = self.speed[joint];
        match (&self.speed_change, before) {
            (Some(change), Some(before)) => (
                (before[joint] - change[joint]).max(-speed),
                (before[joint] + change[joint]).min(speed),
            ),
            _ => (-speed, speed),
        }
    }

    /// The ranges of all joints as rows a q̇ ≥ b.
    pub(crate) fn push_rows(
        &self,
        before: Option<&[f64]>,
        rows: &mut Vec<f64>,
        bounds: &mut Vec<f64>,
    ) {
        let dof = self.speed.len();
        for joint in 0..dof {
            push_range(dof, joint, self.range(joint, before), rows, bounds);
        }
    }

    /// Shortens a velocity towards `anchor` until every joint is within its speed limit.
    pub(crate) fn shorten_to_speed(&self, qd: &mut [f64], anchor: &[f64]) -> Option<Shortened> {
        // Almost always none is too fast.
        if !exceeds(qd, &self.speed) {
            return None;
        }
        shorten(qd, anchor, |joint| self.range(joint, None))
    }

    /// Shortens a velocity towards `anchor` until every joint is within its acceleration limit.
    pub(crate) fn shorten_to_acceleration(
        &self,
        qd: &mut [f64],
        anchor: &[f64],
        before: &[f64],
    ) -> Option<Shortened> {
        self.speed_change.as_ref()?;
        shorten(qd, anchor, |joint| self.range(joint, Some(before)))
    }

    /// The joints that exceed their acceleration limits, given the accelerations.
    pub(crate) fn exceeded(&self, qdd: &[f64]) -> impl Iterator<Item = Exceeded> {
        let changes = self.speed_change.as_deref().unwrap_or_default();
        let joints = qdd.iter().zip(changes).enumerate();
        let times = joints.map(|(joint, (qdd, change))| Exceeded {
            joint,
            times: (qdd * self.period).abs() / change,
        });
        times.filter(|exceeded| exceeded.times > 1.0 + ROUNDING)
    }
}

/// The range of a joint as rows a q̇ ≥ b, one for each end that is finite.
pub(crate) fn push_range(
    dof: usize,
    joint: usize,
    (least, greatest): (f64, f64),
    rows: &mut Vec<f64>,
    bounds: &mut Vec<f64>,
) {
    for (sign, bound) in [(1.0, least), (-1.0, -greatest)] {
        if bound.is_finite() {
            let start = rows.len();
            rows.resize(start + dof, 0.0);
            rows[start + joint] = sign;
            bounds.push(bound);
        }
    }
}

/// Rounding is not an exceeded limit.
const ROUNDING: f64 = 1e-9;

/// v ← anchor + f (v − anchor) with the largest f ≤ 1 that brings every joint into its range. A joint
/// of which not even the anchor is in range decides nothing but that.
pub(crate) fn shorten(
    qd: &mut [f64],
    anchor: &[f64],
    range: impl Fn(usize) -> (f64, f64),
) -> Option<Shortened> {
    let mut tightest: Option<Shortened> = None;
    for (joint, (speed, from)) in qd.iter().zip(anchor).enumerate() {
        let (least, greatest) = range(joint);
        let beyond = if *speed > greatest {
            greatest
        } else if *speed < least {
            least
        } else {
            continue;
        };
        let factor = ((beyond - from) / (speed - from)).clamp(0.0, 1.0);
        if tightest.is_none_or(|found| factor < found.factor) {
            tightest = Some(Shortened { joint, factor });
        }
    }
    if let Some(Shortened { factor, .. }) = tightest {
        for (speed, from) in qd.iter_mut().zip(anchor) {
            *speed = from + factor * (*speed - from);
        }
    }
    tightest
}
