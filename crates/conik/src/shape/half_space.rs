//! Everything on one side of a plane: a floor, a wall, a table.

use super::Measures;
use crate::geometry::{Pose, Vec3};

/// All points behind a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    pub(super) point: Vec3,
    pub(super) normal: Vec3,
}

impl HalfSpace {
    /// What lies behind the plane through `point` [m], as seen by one who looks against `normal`, which
    /// points out of it and may have any length but 0.
    pub fn new(point: impl Into<Vec3>, normal: impl Into<Vec3>) -> Self {
        Self {
            point: point.into(),
            normal: normal.into().normalized(),
        }
    }

    /// Normal of its plane, of length 1, out of it.
    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// A point of its plane [m].
    pub fn point(&self) -> Vec3 {
        self.point
    }

    /// How far a point [m] is in front of the plane [m], negative behind.
    #[inline]
    pub(super) fn height(&self, point: Vec3) -> f64 {
        self.normal.dot(point - self.point)
    }
}

impl Measures for HalfSpace {
    fn placed(&self, pose: &Pose) -> Self {
        Self {
            point: pose.transform(self.point),
            normal: pose.rotate(self.normal),
        }
    }

    fn extent(&self) -> f64 {
        f64::INFINITY
    }

    fn lengths(&self) -> [f64; 3] {
        [self.point.norm(), self.normal.norm(), 0.0]
    }
}
