//! Cylinders against boxes and other cylinders: how deep the cylinder is in what a convex function tells the
//! depth of points in.
//!
//! Apart, what is closest of a cylinder is on its wall, and then straight out from its axis, which is a
//! segment; or on one of its ends, which is a disc: chords of it are segments again, and the least of
//! each is a function that falls and rises from chord to chord. Which of them it is follows from
//! the slope of the least of each disc along the axis, which never falls. Where they overlap, the disc in which
//! the slope changes sign has the deepest point.

use super::closest::{Closest, NO_LENGTH};
use super::cylinder::Cylinder;
use super::descent::{self, Place};
use super::segment::Segment;
use crate::geometry::Vec3;
use crate::real::sin_cos;
use core::f64::consts::PI;

/// The point of a cylinder that is closest to something, or deepest in it, of which `depth` tells how far a
/// point is outside [m], negative inside, with the gradient of that: a convex function.
pub(super) fn closest(cylinder: &Cylinder, depth: impl Fn(Vec3) -> (f64, Vec3) + Copy) -> Closest {
    let [from, to] = cylinder.ends();
    let axis = Segment::new(from, to);
    let on_axis = axis.least(depth);
    if 0.0 < on_axis.t && on_axis.t < 1.0 && on_axis.value > cylinder.radius {
        let Place {
            value,
            gradient,
            point,
            ..
        } = on_axis;
        return Closest {
            distance: value - cylinder.radius,
            normal: gradient,
            on_first: point - gradient * cylinder.radius,
            on_second: point - gradient * value,
        };
    }
    // Chords towards what is closest: there the least of a disc is in the middle of the way.
    let aside = on_axis.gradient - cylinder.axis * cylinder.axis.dot(on_axis.gradient);
    let chords = if aside.norm() > 1e-9 {
        aside.normalized()
    } else {
        Segment::across(cylinder.axis)
    };
    let disc_at = |t: f64| {
        let disc = Disc {
            middle: axis.at(t),
            radius: cylinder.radius,
            chords,
            across: cylinder.axis.cross(chords),
        };
        let least = disc.least(depth);
        Place {
            t,
            slope: least.gradient.dot(axis.along),
            ..least
        }
    };
    // Most often the end nearest to what is closest is the one.
    let small = 1e-15 * axis.along.norm();
    let least = if on_axis.t < 0.5 {
        let low = disc_at(0.0);
        if low.slope >= 0.0 {
            low
        } else {
            descent::least(low, disc_at(1.0), small, disc_at)
        }
    } else {
        let high = disc_at(1.0);
        if high.slope <= 0.0 {
            high
        } else {
            descent::least(disc_at(0.0), high, small, disc_at)
        }
    };
    // What a rounding is above 0 has no direction: it is touched.
    let distance = if least.value < NO_LENGTH {
        least.value.min(0.0)
    } else {
        least.value
    };
    Closest {
        distance,
        normal: least.gradient,
        on_first: least.point,
        on_second: least.point - least.gradient * distance,
    }
}

/// A flat disc.
struct Disc {
    middle: Vec3,
    radius: f64,
    /// The direction of its chords, and the one from chord to chord, both of length 1.
    chords: Vec3,
    across: Vec3,
}

impl Disc {
    /// Where a convex function is least on the disc.
    ///
    /// The chord at angle φ is −cos φ of a radius away from the middle, and sin φ of a radius long on either
    /// side of it. Its least place moves on with the chord, at its ends along the rim.
    fn least(&self, depth: impl Fn(Vec3) -> (f64, Vec3) + Copy) -> Place {
        let on_chord = |angle: f64| {
            let (sin, cos) = sin_cos(angle);
            let (away, half) = (-cos * self.radius, sin * self.radius);
            let middle = self.middle + self.across * away;
            let chord = Segment {
                start: middle - self.chords * half,
                along: self.chords * (2.0 * half),
            };
            let least = chord.least(depth);
            let moves = self.across * half - self.chords * ((2.0 * least.t - 1.0) * away);
            Place {
                t: angle,
                slope: least.gradient.dot(moves),
                ..least
            }
        };
        // The first and the last chord are points of the rim: from there two ways lead on.
        let at_end = |angle: f64, outward: f64| {
            let point = self.middle + self.across * (outward * self.radius);
            let (value, gradient) = depth(point);
            let inward = (outward * gradient.dot(self.across)).max(0.0);
            Place {
                t: angle,
                value,
                gradient,
                point,
                slope: outward * self.radius * (gradient.dot(self.chords).abs() + inward),
            }
        };
        let small = 1e-15 * self.radius;
        descent::least(at_end(0.0, -1.0), at_end(PI, 1.0), small, on_chord)
    }
}
