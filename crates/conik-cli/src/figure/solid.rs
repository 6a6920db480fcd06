//! Shapes as the viewer sees them: how far they reach on paper, and what they hide.

use conik::{Capsule, Shape, Vec3};

use super::camera::{Camera, Vector};
use super::svg::Point;

/// Corners of the polygon that stands for a circle.
const CORNERS: u32 = 32;

/// A dip into a shape by less than this part of its thickness is still in front of it: a tool that slides
/// along its surface dips into it by rounding or by a sample's length.
const DIP: f64 = 0.015;

/// Its middle [m]; of a half-space a point of its plane.
pub fn middle(shape: &Shape) -> Vec3 {
    match shape {
        Shape::Sphere(sphere) => sphere.center(),
        Shape::Capsule(capsule) => middle_of(capsule.ends()),
        Shape::Cuboid(cuboid) => cuboid.pose().origin,
        Shape::Cylinder(cylinder) => middle_of(cylinder.ends()),
        Shape::HalfSpace(half_space) => half_space.point(),
    }
}

fn middle_of([from, to]: [Vec3; 2]) -> Vec3 {
    (from + to) * 0.5
}

/// The most that a point of it is away from its middle [m].
fn reach(shape: &Shape) -> f64 {
    let half = |[from, to]: [Vec3; 2]| 0.5 * (to - from).norm();
    match shape {
        Shape::Sphere(sphere) => sphere.radius(),
        Shape::Capsule(capsule) => half(capsule.ends()) + capsule.radius(),
        Shape::Cuboid(cuboid) => 0.5 * cuboid.size().norm(),
        Shape::Cylinder(cylinder) => half(cylinder.ends()).hypot(cylinder.radius()),
        Shape::HalfSpace(_) => f64::INFINITY,
    }
}

/// Half of its least thickness [m].
fn depth(shape: &Shape) -> f64 {
    match shape {
        Shape::Sphere(sphere) => sphere.radius(),
        Shape::Capsule(capsule) => capsule.radius(),
        Shape::Cuboid(cuboid) => {
            let [x, y, z] = cuboid.size().to_array();
            0.5 * x.min(y).min(z)
        }
        Shape::Cylinder(cylinder) => {
            let [from, to] = cylinder.ends();
            cylinder.radius().min(0.5 * (to - from).norm())
        }
        Shape::HalfSpace(_) => 0.0,
    }
}

/// Points [m] whose hull, seen along the cross product of `right` and `up`, is that of the shape. A half-space
/// has none.
pub fn rim(shape: &Shape, right: Vec3, up: Vec3) -> Vec<Vector> {
    let ring = |centre: Vec3, a: Vec3, b: Vec3| {
        (0..CORNERS).map(move |nth| {
            let (sin, cos) =
                (f64::from(nth) / f64::from(CORNERS) * std::f64::consts::TAU).sin_cos();
            (centre + a * cos + b * sin).to_array()
        })
    };
    match shape {
        Shape::Sphere(sphere) => {
            let r = sphere.radius();
            ring(sphere.center(), right * r, up * r).collect()
        }
        Shape::Capsule(capsule) => {
            let r = capsule.radius();
            let ends = capsule.ends().into_iter();
            ends.flat_map(|end| ring(end, right * r, up * r)).collect()
        }
        Shape::Cuboid(_) => corners(shape).into_iter().map(Vec3::to_array).collect(),
        Shape::Cylinder(cylinder) => {
            let [from, to] = cylinder.ends();
            let (a, b) = across(to - from);
            let r = cylinder.radius();
            [from, to]
                .into_iter()
                .flat_map(|end| ring(end, a * r, b * r))
                .collect()
        }
        Shape::HalfSpace(_) => Vec::new(),
    }
}

/// The corners of a box, a bit of the index for each axis; none of another shape.
pub fn corners(shape: &Shape) -> Vec<Vec3> {
    let Shape::Cuboid(cuboid) = shape else {
        return Vec::new();
    };
    let (pose, half) = (cuboid.pose(), cuboid.size() * 0.5);
    let side = |nth: u32, axis: u32, size: f64| if nth >> axis & 1 == 1 { size } else { -size };
    let corner = |nth| {
        Vec3::new(
            side(nth, 0, half.x),
            side(nth, 1, half.y),
            side(nth, 2, half.z),
        )
    };
    (0..8).map(|nth| pose.transform(corner(nth))).collect()
}

/// Two directions of length 1 at right angles to `axis` and to each other.
pub fn across(axis: Vec3) -> (Vec3, Vec3) {
    let axis = if axis.norm() > 0.0 {
        axis.normalized()
    } else {
        Vec3::new(0.0, 0.0, 1.0)
    };
    // The coordinate axis that is least along it.
    let [x, y, z] = axis.to_array().map(f64::abs);
    let aside = if x <= y && x <= z {
        Vec3::new(1.0, 0.0, 0.0)
    } else if y <= z {
        Vec3::new(0.0, 1.0, 0.0)
    } else {
        Vec3::new(0.0, 0.0, 1.0)
    };
    let a = axis.cross(aside).normalized();
    (a, axis.cross(a))
}

/// Whether the shape stands between the viewer and the point.
pub fn hides(shape: &Shape, camera: &Camera, point: Vector) -> bool {
    let (from, toward) = (Vec3::from(point), camera.toward());
    let (away, reach) = (middle(shape) - from, reach(shape));
    let along = away.dot(toward);
    // A half-space is the floor, or a wall, of what is shown, and hides nothing of it.
    if !reach.is_finite() || along < -reach || (away - toward * along).norm() > reach {
        return false;
    }
    let sight: Shape = Capsule::new(from, from + toward * (along + reach), 0.0).into();
    let closest = sight.closest_to(shape);
    closest.is_some_and(|closest| closest.distance < -DIP * depth(shape))
}

/// Whether the first shape has to be painted before the second one: it is behind it, as far as can be told.
/// `None` where they are beside each other on paper, and it makes no difference.
pub fn is_behind(camera: &Camera, first: &Shape, second: &Shape) -> Option<bool> {
    let between = middle(second) - middle(first);
    let toward = camera.toward();
    let (right, up) = camera.project(between.to_array());
    if right.hypot(up) > reach(first) + reach(second) {
        return None;
    }
    // What is on different sides of a plane between them is sorted by the sides.
    let apart = first
        .closest_to(second)
        .filter(|closest| closest.distance > 0.0);
    let sorted = apart.map(|closest| -closest.normal.dot(toward));
    let nearer = sorted
        .filter(|nearer| nearer.abs() > 1e-6)
        .unwrap_or_else(|| between.dot(toward));
    Some(nearer > 0.0)
}

/// The hull of points on paper, in order around it.
pub fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.retain(|(x, y)| x.is_finite() && y.is_finite());
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let turns_right =
        |a: Point, b: Point, c: Point| (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0) <= 0.0;
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && turns_right(a, b, point)
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut around = half(&mut points.iter().copied());
    around.extend(half(&mut points.iter().rev().copied()));
    around
}

#[cfg(test)]
mod tests {
    use super::*;
    use conik::{Cuboid, Cylinder, HalfSpace, Pose, Sphere};

    #[test]
    fn a_sphere_hides_what_is_behind_or_inside_it_only() {
        let camera = Camera::at(0.0, 0.0);
        let sphere = Sphere::new([1.0, 0.0, 0.0], 0.5).into();
        for (point, hidden) in [
            ([0.0, 0.0, 0.0], true),
            ([1.0, 0.1, 0.0], true),
            ([2.0, 0.0, 0.0], false),
            ([0.0, 0.6, 0.0], false),
            ([1.499, 0.0, 0.0], false),
        ] {
            assert_eq!(hides(&sphere, &camera, point), hidden, "{point:?}");
        }
    }

    #[test]
    fn boards_and_posts_hide_what_is_behind_them_and_a_floor_nothing() {
        let camera = Camera::at(0.0, 0.0);
        let board = Cuboid::new(Pose::at(Vec3::new(1.0, 0.0, 0.0)), [0.02, 2.0, 1.0]);
        let post = Cylinder::new([1.0, 0.0, -0.5], [1.0, 0.0, 0.5], 0.1);
        let floor = HalfSpace::new([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let (board, post, floor) = (board.into(), post.into(), floor.into());
        for (point, by_board, by_post) in [
            ([0.0, 0.0, 0.0], true, true),
            ([0.0, 0.9, 0.45], true, false),
            ([0.0, 0.0, 0.55], false, false),
            ([1.2, 0.0, 0.0], false, false),
        ] {
            assert_eq!(hides(&board, &camera, point), by_board, "board, {point:?}");
            assert_eq!(hides(&post, &camera, point), by_post, "post, {point:?}");
            assert!(!hides(&floor, &camera, point));
        }
    }

    #[test]
    fn a_long_board_is_behind_what_stands_before_it_though_its_middle_is_nearer() {
        // The board leads toward the viewer, past the ball that is in front of its far end.
        let camera = Camera::at(0.0, 30.0);
        let board = Cuboid::new(Pose::at(Vec3::new(2.0, 0.0, 0.0)), [4.0, 0.5, 0.02]).into();
        let ball = Sphere::new([0.5, 0.0, 0.2], 0.1).into();
        assert_eq!(is_behind(&camera, &board, &ball), Some(true));
        assert_eq!(is_behind(&camera, &ball, &board), Some(false));
        let aside = Sphere::new([0.5, 5.0, 0.2], 0.1).into();
        assert_eq!(is_behind(&camera, &board, &aside), None);
    }

    #[test]
    fn a_rim_is_as_large_as_its_shape() {
        let (right, up) = (Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0));
        let half_turn = Pose::IDENTITY;
        let shapes: [(Shape, f64); 4] = [
            (Sphere::new([0.0; 3], 0.5).into(), 0.5),
            (Capsule::new([0.0; 3], [0.0, 0.0, 1.0], 0.25).into(), 1.25),
            (Cylinder::new([0.0; 3], [0.0, 0.0, 1.0], 0.25).into(), 1.0),
            (Cuboid::new(half_turn, [0.2, 0.4, 0.6]).into(), 0.3),
        ];
        for (shape, top) in shapes {
            let highest = rim(&shape, right, up).into_iter().map(|it| it[2]);
            let highest = highest.fold(f64::NEG_INFINITY, f64::max);
            assert!((highest - top).abs() < 1e-9, "{shape:?}: {highest}");
        }
    }

    #[test]
    fn hull_leaves_out_what_is_inside() {
        let around = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let inside = [(1.0, 1.0), (1.0, 0.0), (f64::NAN, 1.0)];
        assert_eq!(hull([around.as_slice(), &inside].concat()), around);
        assert_eq!(hull(vec![(1.0, 1.0); 5]), [(1.0, 1.0)]);
    }
}
