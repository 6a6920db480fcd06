//! Boxes: against a line segment, and against each other.
//!
//! Apart, two boxes are closest at an edge of the one or at a corner of the other, each against the solid.
//! Overlapping, the shortest shift that takes them apart is across a face of one of them, or across an
//! edge of each: the fifteen separating axes (Gottschalk, Lin, Manocha, *OBBTree*, SIGGRAPH 1996).

use super::closest::{Closest, NO_LENGTH};
use super::cuboid::Cuboid;
use super::segment::Segment;
use crate::geometry::{Pose, Vec3};
use crate::task::AXES;

/// Edges that are as good as parallel have no direction across both: what is lost of the distance by
/// leaving them out is that much of a box's size.
const PARALLEL: f64 = 1e-12;

/// An axis counts if it is better by this [m]: across two edges that lie along a face it is that face's
/// normal again, and the boxes do not touch where those edges pass.
const TIE: f64 = 1e-13;

/// Along how many of its axes the first of two boxes has faces, and along how many edges.
const BOX: (usize, usize) = (3, 3);
const SEGMENT: (usize, usize) = (0, 1);

/// The closest points of a segment and a box.
pub(super) fn segment_and_box(segment: &Segment, cuboid: &Cuboid) -> Closest {
    let own = segment.placed(&cuboid.pose.inverse());
    let (on_segment, on_box) = own.closest_in(cuboid);
    let closest = Closest::of_points(on_segment, on_box).unwrap_or_else(|| {
        // The segment is a box without width, which has one edge.
        let length = own.along.norm();
        let x_axis = if length > 0.0 {
            own.along * (1.0 / length)
        } else {
            Vec3::new(1.0, 0.0, 0.0)
        };
        let y_axis = Segment::across(x_axis);
        let thin = Cuboid {
            pose: Pose {
                x_axis,
                y_axis,
                z_axis: x_axis.cross(y_axis),
                origin: own.at(0.5),
            },
            half: Vec3::new(0.5 * length, 0.0, 0.0),
        };
        separation(&thin, cuboid, SEGMENT)
    });
    in_world(closest, &cuboid.pose)
}

/// The closest points of two boxes.
pub(super) fn boxes(first: &Cuboid, second: &Cuboid) -> Closest {
    // All in the frame of the second.
    let pose = second.pose.inverse() * first.pose;
    let first_seen = Cuboid { pose, ..*first };
    let separation = separation(&first_seen, second, BOX);
    if separation.distance <= NO_LENGTH {
        return in_world(separation, &second.pose);
    }
    let mut closest = separation;
    closest.distance = f64::INFINITY;
    let mut take = |on_first: Vec3, on_second: Vec3| {
        if let Some(found) = Closest::of_points(on_first, on_second)
            && found.distance < closest.distance
        {
            closest = found;
        }
        closest.distance
    };
    let inverse = pose.inverse();
    let mut least = f64::INFINITY;
    for corner in second.corners() {
        least = take(
            pose.transform(first.nearest(inverse.transform(corner))),
            corner,
        );
    }
    for edge in first.edges() {
        let edge = edge.placed(&pose);
        let middle = edge.at(0.5);
        // No point of the edge is closer than this.
        let bound = (middle - second.nearest(middle)).norm() - 0.5 * edge.along.norm();
        if bound < least {
            let (on_first, on_second) = edge.closest_in(second);
            least = take(on_first, on_second);
        }
    }
    if closest.distance == f64::INFINITY {
        closest = separation;
    }
    in_world(closest, &second.pose)
}

fn in_world(closest: Closest, pose: &Pose) -> Closest {
    Closest {
        distance: closest.distance,
        normal: pose.rotate(closest.normal),
        on_first: pose.transform(closest.on_first),
        on_second: pose.transform(closest.on_second),
    }
}

/// The most that the boxes are apart along any of the fifteen axes [m], and where, in the frame of the
/// second. Where that is above 0 they are apart, though not always that little; where not, that is
/// how deep they overlap.
fn separation(first: &Cuboid, second: &Cuboid, (faces, edges): (usize, usize)) -> Closest {
    let pose = &first.pose;
    let first_axes = [pose.x_axis, pose.y_axis, pose.z_axis];
    let apart = |axis: Vec3| {
        let normal = axis * 1.0_f64.copysign(axis.dot(pose.origin));
        let own = second.corner(normal).dot(normal);
        let others = first.corner(pose.unrotate(-normal));
        (pose.transform(others).dot(normal) - own, normal)
    };
    let mut best = (f64::NEG_INFINITY, Vec3::ZERO, Side::First);
    let mut try_axis = |axis: Vec3, side: Side| {
        let (distance, normal) = apart(axis);
        if distance > best.0 + TIE {
            best = (distance, normal, side);
        }
    };
    for axis in first_axes.into_iter().take(faces) {
        try_axis(axis, Side::First);
    }
    for axis in AXES {
        try_axis(axis, Side::Second);
    }
    for (i, a) in first_axes.into_iter().take(edges).enumerate() {
        for (j, b) in AXES.into_iter().enumerate() {
            let across = a.cross(b);
            let length = across.norm();
            if length > PARALLEL {
                try_axis(across * (1.0 / length), Side::Edges(i, j));
            }
        }
    }
    let (distance, normal, side) = best;
    let on_second = || second.corner(normal);
    let of_first = || first.corner(pose.unrotate(-normal));
    let (on_first, on_second) = match side {
        Side::First => (on_second() + normal * distance, on_second()),
        Side::Second => {
            let corner = pose.transform(of_first());
            (corner, corner - normal * distance)
        }
        Side::Edges(i, j) => {
            let edge = first.edge(of_first(), i).placed(pose);
            let (point, _) = edge.closest_points(&second.edge(on_second(), j));
            (point, point - normal * distance)
        }
    };
    Closest {
        distance,
        normal,
        on_first,
        on_second,
    }
}

/// Whose side the normal is square to.
#[derive(Clone, Copy)]
enum Side {
    First,
    Second,
    /// An edge of each: along these axes.
    Edges(usize, usize),
}
