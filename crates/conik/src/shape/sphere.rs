//! Ball around a point.

use super::Measures;
use crate::geometry::{Pose, Vec3};

/// All points within a radius of a centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    pub(super) center: Vec3,
    pub(super) radius: f64,
}

impl Sphere {
    /// A ball of `radius` [m], which may be 0, about `center` [m] in the frame that it is fixed to.
    pub fn new(center: impl Into<Vec3>, radius: f64) -> Self {
        Self {
            center: center.into(),
            radius,
        }
    }

    /// Its centre [m].
    pub fn center(&self) -> Vec3 {
        self.center
    }

    /// Its radius [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Measures for Sphere {
    fn placed(&self, pose: &Pose) -> Self {
        Self {
            center: pose.transform(self.center),
            ..*self
        }
    }

    fn extent(&self) -> f64 {
        self.center.norm() + self.radius
    }

    fn lengths(&self) -> [f64; 3] {
        [self.radius; 3]
    }
}
