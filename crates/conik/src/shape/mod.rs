//! Primitive shapes, and how far any two of them are apart.
//!
//! Here live the shapes (one noun a file) and the closest points between two of them. Where a shape is
//! fixed to, and what is asked of a distance, is in [`ShapeDistance`](crate::ShapeDistance).
//!
//! | | sphere | capsule | box | cylinder | half-space |
//! |---|---|---|---|---|---|
//! | sphere, capsule | exact | exact | exact | outside exact | exact |
//! | box | | | exact | outside exact | exact |
//! | cylinder | | | | outside exact | exact |
//! | half-space | | | | | none |
//!
//! *Exact* holds of overlaps too: there the distance is the negative of the shortest shift that takes the
//! shapes apart. Of a capsule in a cylinder, of a cylinder in a box, and of the deeper of two cylinders in the
//! other, it is the negative of how deep the deepest point of the one is inside the other. That is never
//! more than that shift, nor than half the thickness of what it is inside; it is continuous, and 0
//! where they touch.
//!
//! Distances are from closed forms, or, where a cylinder leaves none, from roots of functions that never fall,
//! one in the other, each found to rounding in bounded work. They are not from a general solver for
//! convex shapes: those stop at a tolerance in the distance, and the normal, of which a Jacobian is made, is
//! then known to the square root of it only. What proves a distance right is not another solver but the
//! normal itself: the one shape lies on one side of the plane across it, the other on the other, and a
//! point of each is on it (`tests/shapes.rs`).

mod boxes;
mod capsule;
mod closest;
mod cuboid;
mod cylinder;
mod descent;
mod flat_ends;
mod half_space;
mod segment;
mod sphere;

pub use capsule::Capsule;
pub use closest::Closest;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use half_space::HalfSpace;
pub use sphere::Sphere;

use crate::geometry::{Pose, Vec3};

/// A primitive shape, given in the frame that it is fixed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A ball.
    Sphere(Sphere),
    /// A line segment with a radius.
    Capsule(Capsule),
    /// A box.
    Cuboid(Cuboid),
    /// A cylinder with flat ends.
    Cylinder(Cylinder),
    /// Everything behind a plane.
    HalfSpace(HalfSpace),
}

/// What every shape tells of itself.
trait Measures: Sized {
    /// The shape, in the frame that `pose` places its own frame in.
    fn placed(&self, pose: &Pose) -> Self;

    /// The most that a point of it is away from the origin of the frame that it is fixed to [m].
    fn extent(&self) -> f64;

    /// Numbers that must be finite and not negative if the shape is one.
    fn lengths(&self) -> [f64; 3];
}

/// Does the same with whatever shape it is.
macro_rules! for_each_shape {
    ($shape:expr, $it:ident => $what:expr) => {
        match $shape {
            Shape::Sphere($it) => $what,
            Shape::Capsule($it) => $what,
            Shape::Cuboid($it) => $what,
            Shape::Cylinder($it) => $what,
            Shape::HalfSpace($it) => $what,
        }
    };
}

impl Shape {
    /// The shape, in the frame that `pose` places its own frame in.
    #[inline]
    #[must_use]
    pub fn placed(&self, pose: &Pose) -> Self {
        for_each_shape!(self, shape => shape.placed(pose).into())
    }

    /// The most that a point of it is away from the origin of the frame that it is fixed to [m]; infinite
    /// for a half-space.
    pub fn extent(&self) -> f64 {
        for_each_shape!(self, shape => shape.extent())
    }

    /// How far two shapes of one frame are apart, and where; `None` for two shapes between which no
    /// distance [is to be had](Self::check_pair).
    #[inline]
    pub fn closest_to(&self, other: &Self) -> Option<Closest> {
        closest::between(self, other)
    }

    /// Whether it is a shape at all: finite, no length below 0, no direction of length 0, and whether a box's
    /// axes are at right angles; if not, the reason.
    pub fn check(&self) -> Result<(), &'static str> {
        let lengths = for_each_shape!(self, shape => shape.lengths());
        let is_bounded = !matches!(self, Self::HalfSpace(_));
        if lengths.iter().any(|v| !v.is_finite()) || is_bounded && !self.extent().is_finite() {
            return Err("a shape must be finite, and its directions must not be zero");
        }
        if lengths.iter().any(|v| *v < 0.0) {
            return Err("a shape's lengths must not be negative");
        }
        match self {
            Self::Cuboid(cuboid) if !cuboid.pose.is_rigid() => {
                Err("a box's axes must be of length 1 and at right angles")
            }
            _ => Ok(()),
        }
    }

    /// Whether there is a distance between the two; if not, the reason.
    pub fn check_pair(&self, other: &Self) -> Result<(), &'static str> {
        match (self, other) {
            (Self::HalfSpace(_), Self::HalfSpace(_)) => {
                Err("half-spaces have no end, and no distance to each other")
            }
            _ => Ok(()),
        }
    }

    /// The middle line and the radius of what is round.
    fn rounded(&self) -> Option<(segment::Segment, f64)> {
        match self {
            Self::Sphere(Sphere { center, radius }) => {
                Some((segment::Segment::new(*center, *center), *radius))
            }
            Self::Capsule(Capsule { axis, radius }) => Some((*axis, *radius)),
            _ => None,
        }
    }

    /// How round it is: the radius by which all of it was grown [m].
    pub(crate) fn rounding(&self) -> f64 {
        self.rounded().map_or(0.0, |(_, radius)| radius)
    }

    /// Its point farthest along a direction of length 1, if it has one.
    fn farthest(&self, direction: Vec3) -> Option<Vec3> {
        Some(match self {
            Self::Sphere(sphere) => sphere.center + direction * sphere.radius,
            Self::Capsule(capsule) => capsule.axis.farthest(direction) + direction * capsule.radius,
            Self::Cuboid(cuboid) => {
                let corner = cuboid.corner(cuboid.pose.unrotate(direction));
                cuboid.pose.transform(corner)
            }
            Self::Cylinder(cylinder) => cylinder.farthest(direction),
            Self::HalfSpace(_) => return None,
        })
    }
}

macro_rules! from_each {
    ($($shape:ident),*) => {$(
        impl From<$shape> for Shape {
            fn from(shape: $shape) -> Self {
                Self::$shape(shape)
            }
        }
    )*};
}

from_each!(Sphere, Capsule, Cuboid, Cylinder, HalfSpace);
