//! Points, directions and poses in three dimensions.
//!
//! Poses are named by the two frames that they relate: `world_from_tool` takes coordinates in the
//! tool frame to coordinates in the world.

use core::ops::{Add, AddAssign, Mul, Neg, Sub};

use crate::real::{sin_cos, sqrt};

/// A point [m] or a direction in three dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3 {
    /// First coordinate.
    pub x: f64,
    /// Second coordinate.
    pub y: f64,
    /// Third coordinate.
    pub z: f64,
}

impl Vec3 {
    /// The origin, or no direction.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    /// A vector from its coordinates.
    #[inline]
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// Inner product.
    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Cross product, right-handed.
    #[inline]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Euclidean length.
    #[inline]
    pub fn norm(self) -> f64 {
        sqrt(self.dot(self))
    }

    /// The direction, with length 1. NaN for no direction.
    #[inline]
    #[must_use]
    pub fn normalized(self) -> Self {
        self * (1.0 / self.norm())
    }

    /// The direction, with length 1; zero where there is none.
    #[inline]
    #[must_use]
    pub(crate) fn direction_or_zero(self) -> Self {
        // Squares of smaller numbers are not normal.
        if self.norm() > 1e-150 {
            self.normalized()
        } else {
            Self::ZERO
        }
    }

    /// Whether every coordinate is a finite number.
    pub fn is_finite(self) -> bool {
        self.to_array().iter().all(|v| v.is_finite())
    }

    /// Whether the length is 1, to 1e-9: false of what a zero or infinite vector normalises to.
    pub(crate) fn is_unit(self) -> bool {
        (self.norm() - 1.0).abs() < 1e-9
    }

    /// The direction after a turn about `rotation` by its length [rad], right-handed (Rodrigues).
    #[must_use]
    pub fn turned_by(self, rotation: Self) -> Self {
        let angle = rotation.norm();
        if angle == 0.0 {
            return self;
        }
        let axis = rotation * (1.0 / angle);
        let (sin, cos) = sin_cos(angle);
        self * cos + axis.cross(self) * sin + axis * (axis.dot(self) * (1.0 - cos))
    }

    /// The coordinates as an array.
    #[inline]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }
}

impl From<[f64; 3]> for Vec3 {
    #[inline]
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl Add for Vec3 {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl AddAssign for Vec3 {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Vec3 {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Neg for Vec3 {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl Mul<f64> for Vec3 {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

/// Position and orientation of one frame in another: p ↦ R p + o.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The frame's x axis: first column of R.
    pub x_axis: Vec3,
    /// The frame's y axis: second column of R.
    pub y_axis: Vec3,
    /// The frame's z axis: third column of R.
    pub z_axis: Vec3,
    /// The frame's origin o [m].
    pub origin: Vec3,
}

impl Pose {
    /// Two frames that coincide.
    pub const IDENTITY: Self = Self {
        x_axis: Vec3::new(1.0, 0.0, 0.0),
        y_axis: Vec3::new(0.0, 1.0, 0.0),
        z_axis: Vec3::new(0.0, 0.0, 1.0),
        origin: Vec3::ZERO,
    };

    /// A frame turned as the outer one, with its origin at a point of it [m].
    pub const fn at(origin: Vec3) -> Self {
        Self {
            origin,
            ..Self::IDENTITY
        }
    }

    /// Whether it is a motion: finite, and its axes of length 1, at right angles, right-handed, to 1e-9.
    pub fn is_rigid(&self) -> bool {
        let (x, y, z) = (self.x_axis, self.y_axis, self.z_axis);
        let is_zero = |number: f64| number.abs() < 1e-9;
        let lengths = [x, y, z].iter().all(|axis| is_zero(axis.dot(*axis) - 1.0));
        let origin = self.origin.to_array();
        lengths && is_zero((x.cross(y) - z).norm()) && origin.iter().all(|v| v.is_finite())
    }

    /// The outer frame in the inner one.
    #[inline]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let (x, y, z) = (self.x_axis, self.y_axis, self.z_axis);
        Self {
            x_axis: Vec3::new(x.x, y.x, z.x),
            y_axis: Vec3::new(x.y, y.y, z.y),
            z_axis: Vec3::new(x.z, y.z, z.z),
            origin: self.unrotate(-self.origin),
        }
    }

    /// A direction given in the outer frame, in the inner one.
    #[inline]
    pub fn unrotate(&self, direction: Vec3) -> Vec3 {
        Vec3::new(
            self.x_axis.dot(direction),
            self.y_axis.dot(direction),
            self.z_axis.dot(direction),
        )
    }

    /// A point given in the outer frame, in the inner one.
    #[inline]
    pub fn untransform(&self, point: Vec3) -> Vec3 {
        self.unrotate(point - self.origin)
    }

    /// A direction given in the inner frame, in the outer one.
    #[inline]
    pub fn rotate(&self, direction: Vec3) -> Vec3 {
        self.x_axis * direction.x + self.y_axis * direction.y + self.z_axis * direction.z
    }

    /// A point given in the inner frame, in the outer one.
    #[inline]
    pub fn transform(&self, point: Vec3) -> Vec3 {
        self.rotate(point) + self.origin
    }

    /// The homogeneous matrix, row by row.
    pub fn to_matrix(&self) -> [[f64; 4]; 4] {
        let (x, y, z, o) = (self.x_axis, self.y_axis, self.z_axis, self.origin);
        [
            [x.x, y.x, z.x, o.x],
            [x.y, y.y, z.y, o.y],
            [x.z, y.z, z.z, o.z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    }
}

impl Mul for Pose {
    type Output = Self;

    /// `a_from_b * b_from_c == a_from_c`.
    fn mul(self, inner: Self) -> Self {
        Self {
            x_axis: self.rotate(inner.x_axis),
            y_axis: self.rotate(inner.y_axis),
            z_axis: self.rotate(inner.z_axis),
            origin: self.transform(inner.origin),
        }
    }
}
