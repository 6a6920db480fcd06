//! Box with right angles, turned and placed anyhow.

use super::Measures;
use super::segment::Segment;
use crate::geometry::{Pose, Vec3};
use crate::task::AXES;

/// A box about the origin of a frame of its own, along that frame's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    pub(super) pose: Pose,
    pub(super) half: Vec3,
}

impl Cuboid {
    /// A box with edges of lengths `size` [m], each of which may be 0, along the axes of `pose`, with its
    /// middle at that frame's origin.
    pub fn new(pose: Pose, size: impl Into<Vec3>) -> Self {
        Self {
            pose,
            half: size.into() * 0.5,
        }
    }

    /// A frame at its middle, along its edges.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Lengths of its edges [m].
    pub fn size(&self) -> Vec3 {
        self.half * 2.0
    }

    /// The point of the box, in its own frame, that is farthest along a direction of that frame.
    #[inline]
    pub(super) fn corner(&self, direction: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = self.half;
        Vec3::new(
            x.copysign(direction.x),
            y.copysign(direction.y),
            z.copysign(direction.z),
        )
    }

    /// The point of the box nearest to a point, both in the box's frame.
    #[inline]
    pub(super) fn nearest(&self, point: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = self.half;
        Vec3::new(
            point.x.max(-x).min(x),
            point.y.max(-y).min(y),
            point.z.max(-z).min(z),
        )
    }

    /// How far a point is outside [m], negative inside, with the gradient of that.
    ///
    /// Convex in the point: inside, the nearest face counts.
    pub(super) fn depth(&self, point: Vec3) -> (f64, Vec3) {
        let own = self.pose.untransform(point);
        let away = own - self.nearest(own);
        let distance = away.norm();
        if distance > 0.0 {
            return (distance, self.pose.rotate(away * (1.0 / distance)));
        }
        let faces = own.to_array().into_iter().zip(self.half.to_array());
        let mut best = (f64::NEG_INFINITY, Vec3::ZERO);
        for (axis, (along, half)) in AXES.into_iter().zip(faces) {
            let height = along.abs() - half;
            if height > best.0 {
                best = (height, axis * 1.0_f64.copysign(along));
            }
        }
        (best.0, self.pose.rotate(best.1))
    }

    /// The edge through a corner along one of the axes, in the box's frame.
    pub(super) fn edge(&self, corner: Vec3, axis: usize) -> Segment {
        let along = AXES[axis];
        let middle = corner - along * corner.dot(along);
        let half = along * self.half.dot(along);
        Segment::new(middle - half, middle + half)
    }

    /// Its twelve edges, in its own frame.
    pub(super) fn edges(&self) -> impl Iterator<Item = Segment> + '_ {
        (0..12).map(|i| self.edge(self.corner_at(CORNERS_OF_EDGES[i / 4][i % 4]), i / 4))
    }

    /// Its eight corners, in its own frame.
    pub(super) fn corners(&self) -> impl Iterator<Item = Vec3> + '_ {
        (0..8).map(|i| self.corner_at(i))
    }

    /// The corner on the far side along each axis whose bit is set.
    fn corner_at(&self, bits: usize) -> Vec3 {
        let side = |axis: usize| if bits >> axis & 1 == 1 { 1.0 } else { -1.0 };
        self.corner(Vec3::new(side(0), side(1), side(2)))
    }
}

/// Of the four edges along each axis, a corner.
const CORNERS_OF_EDGES: [[usize; 4]; 3] = [[0, 2, 4, 6], [0, 1, 4, 5], [0, 1, 2, 3]];

impl Measures for Cuboid {
    fn placed(&self, pose: &Pose) -> Self {
        Self {
            pose: *pose * self.pose,
            ..*self
        }
    }

    fn extent(&self) -> f64 {
        self.pose.origin.norm() + self.half.norm()
    }

    fn lengths(&self) -> [f64; 3] {
        self.half.to_array()
    }
}
