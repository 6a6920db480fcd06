//! First derivatives: rows of the Jacobians of points, of axes and of orientations.

use super::{Kinematics, Motion};
use crate::geometry::Vec3;

/// Of a pair of neighbouring joints, x, y and z of ω and of v: at unit speed, each moves a point p of a
/// later link at ω × p + v. Side by side, so that both are worked on at once.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TwoTwists {
    pub(super) turn: [[f64; 2]; 3],
    pub(super) slide: [[f64; 2]; 3],
}

impl Kinematics {
    /// The Jacobian of a point [m], Eq. (5) of the paper: `rows` is its x, y and z row, each of one entry
    /// per joint [m/rad, or 1 for a prismatic joint]. The point is where it is in the world now, and
    /// `motion` says what it moves with.
    #[inline]
    pub fn point_rows(&self, motion: Motion, point: Vec3, rows: [&mut [f64]; 3]) {
        let [x, y, z] = rows;
        self.fill_row(motion, x, |TwoTwists { turn, slide }, i| {
            turn[1][i] * point.z - turn[2][i] * point.y + slide[0][i]
        });
        self.fill_row(motion, y, |TwoTwists { turn, slide }, i| {
            turn[2][i] * point.x - turn[0][i] * point.z + slide[1][i]
        });
        self.fill_row(motion, z, |TwoTwists { turn, slide }, i| {
            turn[0][i] * point.y - turn[1][i] * point.x + slide[2][i]
        });
    }

    /// One row of the Jacobian of a point [m]: `row · q̇` is its speed [m/s] along `direction`.
    #[inline]
    pub fn point_row(&self, motion: Motion, point: Vec3, direction: Vec3, row: &mut [f64]) {
        // direction · (ω × p + v) = ω · (p × direction) + v · direction
        let moment = point.cross(direction);
        self.fill_row(motion, row, |TwoTwists { turn, slide }, i| {
            let by_turning = turn[0][i] * moment.x + turn[1][i] * moment.y + turn[2][i] * moment.z;
            let by_sliding =
                slide[0][i] * direction.x + slide[1][i] * direction.y + slide[2][i] * direction.z;
            by_turning + by_sliding
        });
    }

    /// One row of the Jacobian of an orientation: `row · q̇` is the angular velocity [rad/s] about
    /// `direction`.
    #[inline]
    pub fn turn_row(&self, motion: Motion, direction: Vec3, row: &mut [f64]) {
        self.fill_row(motion, row, |TwoTwists { turn, .. }, i| {
            turn[0][i] * direction.x + turn[1][i] * direction.y + turn[2][i] * direction.z
        });
    }

    /// One row of the Jacobian of a unit vector `axis` that is fixed to a frame: `row · q̇` is its rate
    /// [1/s] along `direction`. Eq. (14) of the paper is three such rows.
    #[inline]
    pub fn axis_row(&self, motion: Motion, axis: Vec3, direction: Vec3, row: &mut [f64]) {
        // direction · (ω × axis) = ω · (axis × direction)
        self.turn_row(motion, axis.cross(direction), row);
    }

    /// The joint that moves a body, and how far per unit of it.
    pub(super) fn drive(&self, body: usize) -> (usize, f64) {
        let drive = self.drives.get(body);
        drive.map_or((body, 1.0), |drive| (drive.joint, drive.multiplier))
    }

    /// Fills `row` two joints at a time.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "the entries are a few operations each, and so is a call"
    )]
    fn fill_row(&self, motion: Motion, row: &mut [f64], entry: impl Fn(&TwoTwists, usize) -> f64) {
        if !self.drives.is_empty() {
            return self.sum_row(motion, row, entry);
        }
        let (pairs, last) = row.as_chunks_mut::<2>();
        if let (Ok(pairs), Some(twists)) = (
            <&mut [_; 3]>::try_from(&mut *pairs),
            self.twists.first_chunk(),
        ) {
            // Six joints are the common case, and a loop of known length the fast one.
            fill_pairs::<3>(pairs, twists, &entry);
        } else {
            for (values, twists) in pairs.iter_mut().zip(&self.twists) {
                *values = [entry(twists, 0), entry(twists, 1)];
            }
        }
        if let ([value], Some(twists)) = (last, self.twists.last()) {
            *value = entry(twists, 0);
        }
        if motion.forward != self.all {
            keep_between(motion, row);
        }
    }

    /// Fills `row` where some bodies follow others: each adds to the entry of the joint that moves it.
    #[cold]
    fn sum_row(&self, motion: Motion, row: &mut [f64], entry: impl Fn(&TwoTwists, usize) -> f64) {
        row.fill(0.0);
        for (i, drive) in self.drives.iter().enumerate() {
            let rate = motion.sign(i) * drive.multiplier;
            if rate != 0.0 {
                row[drive.joint] += rate * entry(&self.twists[i / 2], i % 2);
            }
        }
    }
}

/// Of a row that counts every joint as one that moves the frame, what those between the two make.
#[inline(never)]
fn keep_between(motion: Motion, row: &mut [f64]) {
    for (i, value) in row.iter_mut().enumerate() {
        *value *= motion.sign(i);
    }
}

#[inline]
fn fill_pairs<const N: usize>(
    pairs: &mut [[f64; 2]; N],
    twists: &[TwoTwists; N],
    entry: impl Fn(&TwoTwists, usize) -> f64,
) {
    for (values, twists) in pairs.iter_mut().zip(twists) {
        *values = [entry(twists, 0), entry(twists, 1)];
    }
}

impl TwoTwists {
    #[inline]
    pub(super) fn set(&mut self, which: usize, turn: Vec3, slide: Vec3) {
        for axis in 0..3 {
            self.turn[axis][which] = turn.to_array()[axis];
            self.slide[axis][which] = slide.to_array()[axis];
        }
    }

    pub(super) fn get(&self, which: usize) -> (Vec3, Vec3) {
        let of = |parts: &[[f64; 2]; 3]| Vec3::from(parts.map(|pair| pair[which]));
        (of(&self.turn), of(&self.slide))
    }
}
