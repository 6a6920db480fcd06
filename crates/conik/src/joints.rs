//! A vector with one entry per joint, stored inline so that the control loop never touches the heap.

use core::fmt;
use core::ops::{Deref, DerefMut};

/// The most joints that a robot may have.
pub const MAX_JOINTS: usize = 32;

/// One number per joint: positions [rad or m], velocities, accelerations or limits.
///
/// The length is a run-time fact of the robot; the storage is inline, so the vector is `Copy` and
/// can be sent through a ring buffer. It reads and writes as a slice.
#[derive(Clone, Copy)]
pub struct JointVec {
    values: [f64; MAX_JOINTS],
    len: usize,
}

/// More than [`MAX_JOINTS`] values were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0} joints; at most {MAX_JOINTS} are supported")]
pub struct TooManyJoints(pub usize);

impl JointVec {
    /// `len` zeros.
    ///
    /// # Panics
    /// If `len` exceeds [`MAX_JOINTS`]; lengths come from a [`Robot`](crate::Robot), which cannot.
    #[must_use]
    pub fn zeros(len: usize) -> Self {
        assert!(len <= MAX_JOINTS, "{}", TooManyJoints(len));
        Self {
            values: [0.0; MAX_JOINTS],
            len,
        }
    }

    /// The same values in a vector of its own.
    pub fn from_slice(values: &[f64]) -> Result<Self, TooManyJoints> {
        if values.len() > MAX_JOINTS {
            return Err(TooManyJoints(values.len()));
        }
        let mut joints = Self::zeros(values.len());
        joints.copy_from_slice(values);
        Ok(joints)
    }

    /// Whether every entry is a finite number.
    pub fn is_finite(&self) -> bool {
        self.iter().all(|value| value.is_finite())
    }

    /// The entry of largest magnitude, as (index, magnitude); `None` for no joints.
    pub fn largest(&self) -> Option<(usize, f64)> {
        self.iter()
            .map(|value| value.abs())
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl<const N: usize> From<[f64; N]> for JointVec {
    fn from(values: [f64; N]) -> Self {
        const { assert!(N <= MAX_JOINTS) }
        let mut joints = Self::zeros(N);
        joints.copy_from_slice(&values);
        joints
    }
}

impl Deref for JointVec {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.values[..self.len]
    }
}

impl DerefMut for JointVec {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.len]
    }
}

impl PartialEq for JointVec {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl fmt::Debug for JointVec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
