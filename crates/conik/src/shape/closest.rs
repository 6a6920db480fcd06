//! Closest points of two shapes: which pair is measured how.

use super::boxes;
use super::flat_ends;
use super::segment::Segment;
use super::{Cylinder, HalfSpace, Shape};
use crate::geometry::Vec3;

/// Below this distance [m] of two middle lines, or of a line and a box, the difference of the closest
/// points is too short to tell a direction.
pub(super) const NO_LENGTH: f64 = 1e-13;

/// How far two shapes are apart, and where they are closest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The distance [m], negative where they overlap.
    pub distance: f64,
    /// The gradient of the distance in the place of the first shape: the direction, of length 1, in which it
    /// moves away from the other. Shorter where a cylinder is a part of the overlap and what is deepest in
    /// the other shape is so deep that two sides of it count. Where closest points are not unique, that of one pair of them.
    pub normal: Vec3,
    /// The point of the first shape that is closest to the other, or deepest in it [m].
    pub on_first: Vec3,
    /// The point of the second shape that is closest to the first, or deepest in it [m].
    pub on_second: Vec3,
}

impl Closest {
    /// Of two points.
    #[inline]
    pub(super) fn of_points(on_first: Vec3, on_second: Vec3) -> Option<Self> {
        let away = on_first - on_second;
        let distance = away.norm();
        (distance > NO_LENGTH).then(|| Self {
            distance,
            normal: away * (1.0 / distance),
            on_first,
            on_second,
        })
    }

    /// The same, of the two shapes grown by a radius each.
    #[inline]
    pub(super) fn grown(self, first: f64, second: f64) -> Self {
        Self {
            distance: self.distance - first - second,
            on_first: self.on_first - self.normal * first,
            on_second: self.on_second + self.normal * second,
            ..self
        }
    }

    /// The same, of the second shape and the first.
    #[inline]
    pub(super) fn swapped(self) -> Self {
        Self {
            distance: self.distance,
            normal: -self.normal,
            on_first: self.on_second,
            on_second: self.on_first,
        }
    }
}

#[inline]
pub(super) fn between(first: &Shape, second: &Shape) -> Option<Closest> {
    if let (Some((a, a_radius)), Some((b, b_radius))) = (first.rounded(), second.rounded()) {
        return Some(segments(&a, &b).grown(a_radius, b_radius));
    }
    match (first, second) {
        (_, Shape::HalfSpace(half_space)) => above(first, half_space),
        (Shape::HalfSpace(half_space), _) => above(second, half_space).map(Closest::swapped),
        (Shape::Cuboid(a), Shape::Cuboid(b)) => Some(boxes::boxes(a, b)),
        (Shape::Cylinder(a), Shape::Cylinder(b)) => Some(cylinders(a, b)),
        (Shape::Cylinder(cylinder), Shape::Cuboid(cuboid)) => {
            Some(flat_ends::closest(cylinder, |point| cuboid.depth(point)))
        }
        (Shape::Cuboid(_), Shape::Cylinder(_)) => between(second, first).map(Closest::swapped),
        (_, Shape::Cuboid(cuboid)) => {
            let (axis, radius) = first.rounded()?;
            Some(boxes::segment_and_box(&axis, cuboid).grown(radius, 0.0))
        }
        (_, Shape::Cylinder(cylinder)) => {
            let (axis, radius) = first.rounded()?;
            Some(segment_and_cylinder(&axis, cylinder).grown(radius, 0.0))
        }
        (Shape::Cuboid(_) | Shape::Cylinder(_), _) => {
            // Not both at once, or this would not end.
            second.rounded()?;
            between(second, first).map(Closest::swapped)
        }
        (Shape::Sphere(_) | Shape::Capsule(_), Shape::Sphere(_) | Shape::Capsule(_)) => None,
    }
}

/// Of lines that cross, the normal is across both.
#[inline]
fn segments(a: &Segment, b: &Segment) -> Closest {
    let (on_first, on_second) = a.closest_points(b);
    Closest::of_points(on_first, on_second).unwrap_or_else(|| {
        let across = a.along.cross(b.along);
        let longer = if a.along == Vec3::ZERO {
            b.along
        } else {
            a.along
        };
        let normal = if across.norm() > 1e-12 * a.along.norm() * b.along.norm() {
            across.normalized()
        } else {
            Segment::across(longer)
        };
        Closest {
            distance: 0.0,
            normal,
            on_first,
            on_second,
        }
    })
}

fn above(shape: &Shape, half_space: &HalfSpace) -> Option<Closest> {
    let on_first = shape.farthest(-half_space.normal)?;
    let distance = half_space.height(on_first);
    Some(Closest {
        distance,
        normal: half_space.normal,
        on_first,
        on_second: on_first - half_space.normal * distance,
    })
}

/// Where they overlap, the deepest point of either in the other.
fn cylinders(a: &Cylinder, b: &Cylinder) -> Closest {
    let closest = flat_ends::closest(a, |point| b.depth(point));
    if closest.distance > 0.0 {
        return closest;
    }
    let of_other = flat_ends::closest(b, |point| a.depth(point));
    if of_other.distance < closest.distance {
        of_other.swapped()
    } else {
        closest
    }
}

fn segment_and_cylinder(segment: &Segment, cylinder: &Cylinder) -> Closest {
    let least = segment.least(|point| cylinder.depth(point));
    Closest {
        distance: least.value,
        normal: least.gradient,
        on_first: least.point,
        on_second: least.point - least.gradient * least.value,
    }
}
