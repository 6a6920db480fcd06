//! Line segment with a radius: a cylinder with round ends.

use super::Measures;
use super::segment::Segment;
use crate::geometry::{Pose, Vec3};

/// All points within a radius of a line segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    pub(super) axis: Segment,
    pub(super) radius: f64,
}

impl Capsule {
    /// The points within `radius` [m], which may be 0, of the segment between two points [m] of the frame
    /// that it is fixed to. The points may be the same: then it is a sphere.
    pub fn new(from: impl Into<Vec3>, to: impl Into<Vec3>, radius: f64) -> Self {
        Self {
            axis: Segment::new(from.into(), to.into()),
            radius,
        }
    }

    /// Where its axis begins and ends [m].
    pub fn ends(&self) -> [Vec3; 2] {
        [self.axis.start, self.axis.end()]
    }

    /// Its radius [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Measures for Capsule {
    fn placed(&self, pose: &Pose) -> Self {
        Self {
            axis: self.axis.placed(pose),
            ..*self
        }
    }

    fn extent(&self) -> f64 {
        let [from, to] = self.ends();
        from.norm().max(to.norm()) + self.radius
    }

    fn lengths(&self) -> [f64; 3] {
        [self.radius, self.axis.along.norm(), 0.0]
    }
}
