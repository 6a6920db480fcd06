//! Cylinder with flat ends.

use super::Measures;
use super::segment::Segment;
use crate::geometry::{Pose, Vec3};

/// All points within a radius of an axis, between two planes at right angles to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    pub(super) middle: Vec3,
    /// Of length 1.
    pub(super) axis: Vec3,
    pub(super) half_length: f64,
    pub(super) radius: f64,
}

impl Cylinder {
    /// A cylinder of `radius` [m], which may be 0, about the line between the middles of its ends [m], two
    /// different points of the frame that it is fixed to.
    pub fn new(from: impl Into<Vec3>, to: impl Into<Vec3>, radius: f64) -> Self {
        let (from, to) = (from.into(), to.into());
        Self {
            middle: (from + to) * 0.5,
            axis: (to - from).normalized(),
            half_length: (to - from).norm() * 0.5,
            radius,
        }
    }

    /// The middles of its ends [m].
    pub fn ends(&self) -> [Vec3; 2] {
        let half = self.axis * self.half_length;
        [self.middle - half, self.middle + half]
    }

    /// Its radius [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The point of it that is farthest along a direction.
    pub(super) fn farthest(&self, direction: Vec3) -> Vec3 {
        let along = self.axis.dot(direction);
        let across = direction - self.axis * along;
        let length = across.norm();
        // Where the end lies square to the direction, its middle is as far as all the rest of it.
        let rim = if length > 1e-12 * direction.norm() {
            across * (self.radius / length)
        } else {
            Vec3::ZERO
        };
        self.middle + self.axis * self.half_length.copysign(along) + rim
    }

    /// How far a point is outside [m], negative inside, with the gradient of that.
    ///
    /// Convex in the point: inside, the nearer of wall and end counts.
    pub(super) fn depth(&self, point: Vec3) -> (f64, Vec3) {
        let from_middle = point - self.middle;
        let along = self.axis.dot(from_middle);
        let across = from_middle - self.axis * along;
        let distance = across.norm();
        let outward = if distance > 0.0 {
            across * (1.0 / distance)
        } else {
            Segment::across(self.axis)
        };
        let end = self.axis * 1.0_f64.copysign(along);
        let (wall, cap) = (distance - self.radius, along.abs() - self.half_length);
        if wall > 0.0 && cap > 0.0 {
            let from_rim = Vec3::new(wall, cap, 0.0).norm();
            let gradient = outward * (wall / from_rim) + end * (cap / from_rim);
            (from_rim, gradient)
        } else if wall > cap {
            (wall, outward)
        } else {
            (cap, end)
        }
    }
}

impl Measures for Cylinder {
    fn placed(&self, pose: &Pose) -> Self {
        Self {
            middle: pose.transform(self.middle),
            axis: pose.rotate(self.axis),
            ..*self
        }
    }

    fn extent(&self) -> f64 {
        let [from, to] = self.ends();
        from.norm().max(to.norm()) + self.radius
    }

    fn lengths(&self) -> [f64; 3] {
        [self.radius, self.half_length, self.axis.norm()]
    }
}
