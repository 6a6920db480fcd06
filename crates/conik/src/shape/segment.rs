//! Line segments: the middle lines of capsules, and the edges of boxes.

use super::cuboid::Cuboid;
use super::descent::{self, Place};
use crate::geometry::{Pose, Vec3};

/// The points start + t · along, 0 ≤ t ≤ 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) start: Vec3,
    pub(super) along: Vec3,
}

impl Segment {
    pub(super) fn new(start: Vec3, end: Vec3) -> Self {
        Self {
            start,
            along: end - start,
        }
    }

    #[inline]
    pub(super) fn at(&self, t: f64) -> Vec3 {
        self.start + self.along * t
    }

    pub(super) fn end(&self) -> Vec3 {
        self.start + self.along
    }

    #[inline]
    pub(super) fn placed(&self, pose: &Pose) -> Self {
        Self {
            start: pose.transform(self.start),
            along: pose.rotate(self.along),
        }
    }

    /// The end that is farther along a direction.
    pub(super) fn farthest(&self, direction: Vec3) -> Vec3 {
        if self.along.dot(direction) > 0.0 {
            self.end()
        } else {
            self.start
        }
    }

    /// A direction of length 1 across another one, whichever; along x if that is none.
    pub(super) fn across(direction: Vec3) -> Vec3 {
        let [x, y, z] = direction.to_array().map(f64::abs);
        let least = if x <= y && x <= z {
            Vec3::new(1.0, 0.0, 0.0)
        } else if y <= z {
            Vec3::new(0.0, 1.0, 0.0)
        } else {
            Vec3::new(0.0, 0.0, 1.0)
        };
        let across = direction.cross(least);
        if across.norm() > 0.0 {
            across.normalized()
        } else {
            Vec3::new(1.0, 0.0, 0.0)
        }
    }

    /// The closest points of two segments, on this one and on the other.
    ///
    /// Where the two lines come closest if that is on both, else an end of one of them. Of parallel
    /// segments whose points are closest all along a stretch it is a pair within that.
    #[inline]
    pub(super) fn closest_points(&self, other: &Self) -> (Vec3, Vec3) {
        let between = self.start - other.start;
        let (u, v) = (self.along, other.along);
        let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
        let (ub, vb) = (u.dot(between), v.dot(between));
        let on_segment = |t: f64| t.clamp(0.0, 1.0);
        // Where on this one, for a place on the other, and the other way round; 0 on what is a point.
        let s_of = |t: f64| on_segment(ratio(uv * t - ub, uu));
        let t_of = |s: f64| on_segment(ratio(uv * s + vb, vv));
        // As it stands, and not in inner products: of nearly parallel lines they would cancel.
        let across = u.cross(v);
        let s = on_segment(ratio(-across.dot(between.cross(v)), across.dot(across)));
        let t = t_of(s);
        let s = s_of(t);
        (self.at(s), other.at(t))
    }

    /// Where on the segment it is closest to a box, and the point of the box there, in the box's frame.
    ///
    /// The slope of the squared distance is piecewise linear along the segment and never falls: between
    /// the breaks on both sides of where it is 0, that place is exact.
    #[inline]
    pub(super) fn closest_in(&self, cuboid: &Cuboid) -> (Vec3, Vec3) {
        let slope = |t: f64| {
            let point = self.at(t);
            self.along.dot(point - cuboid.nearest(point))
        };
        let (mut low, mut high) = ((0.0, slope(0.0)), (1.0, slope(1.0)));
        let t = if low.1 >= 0.0 {
            0.0
        } else if high.1 <= 0.0 {
            1.0
        } else {
            let (start, along) = (self.start.to_array(), self.along.to_array());
            for (axis, half) in cuboid.half.to_array().into_iter().enumerate() {
                for face in [-half, half] {
                    let t = (face - start[axis]) / along[axis];
                    // Never so where the segment is parallel to the face.
                    if low.0 < t && t < high.0 {
                        let here = slope(t);
                        *(if here < 0.0 { &mut low } else { &mut high }) = (t, here);
                    }
                }
            }
            low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1)
        };
        let point = self.at(t);
        (point, cuboid.nearest(point))
    }

    /// Where a convex function, of which `at` gives value and gradient, is least along the segment.
    pub(super) fn least(&self, at: impl Fn(Vec3) -> (f64, Vec3)) -> Place {
        let place = |t: f64| {
            let point = self.at(t);
            let (value, gradient) = at(point);
            Place {
                t,
                value,
                gradient,
                point,
                slope: gradient.dot(self.along),
            }
        };
        let small = 1e-15 * self.along.norm();
        descent::least(place(0.0), place(1.0), small, place)
    }
}

/// The ratio; 0 where it would be none.
#[inline]
fn ratio(above: f64, below: f64) -> f64 {
    if below > 0.0 { above / below } else { 0.0 }
}
