//! Distances of shapes carry their own proof: no plane across another direction holds the two farther apart,
//! and one point of each lies on the planes across the normal.

use conik::{Capsule, Closest, Cuboid, Cylinder, HalfSpace, Pose, Shape, Sphere, Vec3};
use proptest::prelude::*;

/// Rounding of lengths of about a metre, and what it does to a normal over a centimetre.
const EXACT: f64 = 1e-12;

fn vector(size: f64) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3::from)
}

fn pose(size: f64) -> impl Strategy<Value = Pose> {
    (vector(size), vector(2.0)).prop_map(|(origin, turn)| Pose {
        x_axis: Vec3::new(1.0, 0.0, 0.0).turned_by(turn),
        y_axis: Vec3::new(0.0, 1.0, 0.0).turned_by(turn),
        z_axis: Vec3::new(0.0, 0.0, 1.0).turned_by(turn),
        origin,
    })
}

fn sphere() -> impl Strategy<Value = Shape> {
    (vector(0.6), 0.0..0.3).prop_map(|(center, radius)| Sphere::new(center, radius).into())
}

fn capsule() -> impl Strategy<Value = Shape> {
    (vector(0.6), vector(0.6), 0.0..0.2)
        .prop_map(|(from, to, radius)| Capsule::new(from, to, radius).into())
}

fn cuboid() -> impl Strategy<Value = Shape> {
    (pose(0.6), prop::array::uniform3(0.0..0.6))
        .prop_map(|(pose, size)| Cuboid::new(pose, size).into())
}

fn cylinder() -> impl Strategy<Value = Shape> {
    (vector(0.6), vector(0.6), 0.01..0.3)
        .prop_map(|(from, to, radius)| Cylinder::new(from, to, radius).into())
}

fn half_space() -> impl Strategy<Value = Shape> {
    (vector(0.6), vector(1.0)).prop_map(|(point, normal)| HalfSpace::new(point, normal).into())
}

fn bounded() -> impl Strategy<Value = Shape> {
    prop_oneof![sphere(), capsule(), cuboid(), cylinder()]
}

fn any_shape() -> impl Strategy<Value = Shape> {
    prop_oneof![sphere(), capsule(), cuboid(), cylinder(), half_space()]
}

/// How far a shape reaches along a direction of length 1 [m].
fn support(shape: &Shape, n: Vec3) -> f64 {
    match shape {
        Shape::Sphere(sphere) => sphere.center().dot(n) + sphere.radius(),
        Shape::Capsule(capsule) => {
            let [from, to] = capsule.ends();
            from.dot(n).max(to.dot(n)) + capsule.radius()
        }
        Shape::Cuboid(cuboid) => {
            let (pose, size) = (cuboid.pose(), cuboid.size());
            let reach = |axis: Vec3, size: f64| axis.dot(n).abs() * size / 2.0;
            pose.origin.dot(n)
                + reach(pose.x_axis, size.x)
                + reach(pose.y_axis, size.y)
                + reach(pose.z_axis, size.z)
        }
        Shape::Cylinder(cylinder) => {
            let [from, to] = cylinder.ends();
            let axis = (to - from).normalized();
            let across = (n - axis * axis.dot(n)).norm();
            from.dot(n).max(to.dot(n)) + cylinder.radius() * across
        }
        Shape::HalfSpace(half_space) => {
            let off = (n - half_space.normal()).norm();
            if off < 1e-9 {
                half_space.point().dot(n)
            } else {
                f64::INFINITY
            }
        }
    }
}

/// How far two planes across `n` hold the shapes apart [m].
fn gap(first: &Shape, second: &Shape, n: Vec3) -> f64 {
    -support(first, -n) - support(second, n)
}

fn measured(first: &Shape, second: &Shape) -> Closest {
    first.closest_to(second).expect("a pair with a distance")
}

/// By how much a shape is grown about its middle line [m].
fn rounding(shape: &Shape) -> f64 {
    match shape {
        Shape::Sphere(sphere) => sphere.radius(),
        Shape::Capsule(capsule) => capsule.radius(),
        _ => 0.0,
    }
}

/// Whether overlaps of the two are measured by their shortest shift.
fn is_exact_inside(first: &Shape, second: &Shape) -> bool {
    let is_cylinder = |shape: &Shape| matches!(shape, Shape::Cylinder(_));
    let is_plane = |shape: &Shape| matches!(shape, Shape::HalfSpace(_));
    !is_cylinder(first) && !is_cylinder(second) || is_plane(first) || is_plane(second)
}

fn assert_proved(first: &Shape, second: &Shape) -> Result<(), TestCaseError> {
    let Closest {
        distance,
        normal,
        on_first,
        on_second,
    } = measured(first, second);
    let apart = on_first - on_second - normal * distance;
    prop_assert!(
        apart.norm() < EXACT,
        "points are not {distance} apart along {normal:?}"
    );
    if distance > 0.0 || is_exact_inside(first, second) {
        prop_assert!((normal.norm() - 1.0).abs() < EXACT);
        let gap = gap(first, second, normal);
        // A normal over a short way is known less well.
        let middles = distance + rounding(first) + rounding(second);
        let tolerance = EXACT + 1e-15 / middles.abs().max(1e-9);
        prop_assert!(
            (gap - distance).abs() < tolerance,
            "{gap} along the normal, not {distance}"
        );
        for (shape, point, n) in [(first, on_first, -normal), (second, on_second, normal)] {
            let off = support(shape, n) - point.dot(n);
            prop_assert!(
                off.abs() < tolerance,
                "{point:?} is {off} from the side of {shape:?}"
            );
        }
    }
    Ok(())
}

fn pairs() -> impl Strategy<Value = (Shape, Shape)> {
    (any_shape(), any_shape())
        .prop_filter("pairs with a distance", |(a, b)| a.check_pair(b).is_ok())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn normal_proves_the_distance((first, second) in pairs()) {
        assert_proved(&first, &second)?;
    }

    /// Together with the proof: overlaps are not taken for deeper than they are.
    #[test]
    fn no_other_direction_holds_shapes_farther_apart(
        (first, second) in pairs(),
        n in vector(1.0),
    ) {
        let distance = measured(&first, &second).distance;
        let gap = gap(&first, &second, n.normalized());
        prop_assert!(gap <= distance + EXACT, "{gap} is more than {distance}");
    }

    #[test]
    fn distance_is_the_same_from_the_other_side((first, second) in pairs()) {
        let (there, back) = (measured(&first, &second), measured(&second, &first));
        prop_assert!((there.distance - back.distance).abs() < EXACT);
    }

    #[test]
    fn moving_both_shapes_changes_nothing((first, second) in pairs(), pose in pose(2.0)) {
        let before = measured(&first, &second);
        let after = measured(&first.placed(&pose), &second.placed(&pose));
        prop_assert!((before.distance - after.distance).abs() < 1e-11);
    }

    /// Along any shift the distance changes by no more than its length, also where shapes begin to overlap.
    #[test]
    fn distance_changes_by_no_more_than_a_shift(
        (first, second) in pairs(),
        shift in vector(0.2),
    ) {
        let shifted = first.placed(&Pose::at(shift));
        let (before, after) = (measured(&first, &second), measured(&shifted, &second));
        let change = (after.distance - before.distance).abs();
        prop_assert!(change <= shift.norm() + EXACT, "{change} by {shift:?}");
    }

    /// Convex functions lie above their tangents.
    #[test]
    fn normal_is_the_gradient_of_the_distance_to_a_ball(
        shape in any_shape(),
        center in vector(0.8),
        shift in vector(0.5),
    ) {
        let at = |center: Vec3| measured(&Sphere::new(center, 0.05).into(), &shape);
        let (here, there) = (at(center), at(center + shift));
        prop_assert!(there.distance >= here.distance + here.normal.dot(shift) - EXACT);
    }

    #[test]
    fn shapes_side_by_side_have_a_distance(
        shape in bounded(),
        length in 0.0..1.0_f64,
        tilt in prop::sample::select(vec![0.0, 1e-16, 1e-12, 1e-8, 1e-4]),
    ) {
        let along = [
            Capsule::new([-length, 0.0, 0.0], [length, 0.0, 0.0], 0.1),
            Capsule::new([-0.5, 0.4, 0.0], [0.5, 0.4, tilt], 0.1),
            Capsule::new([0.0; 3], [0.0; 3], 0.1),
            Capsule::new([0.0, -0.3, tilt], [0.0, 0.3, -tilt], 0.1),
        ];
        let boxes = [
            Cuboid::new(Pose::IDENTITY, [2.0 * length, 0.2, 0.2]),
            Cuboid::new(Pose::at(Vec3::new(0.3, 0.4, 0.0)), [1.0, 0.2, 0.2 + tilt]),
        ];
        let shapes: Vec<Shape> = along.into_iter().map(Shape::from)
            .chain(boxes.into_iter().map(Shape::from))
            .chain([shape, Cylinder::new([0.0, 0.0, -0.2], [0.0, 0.0, 0.2], 0.1).into()])
            .collect();
        for first in &shapes {
            for second in &shapes {
                if first.check_pair(second).is_ok() {
                    assert_proved(first, second)?;
                }
            }
        }
    }
}

#[test]
fn distances_are_those_that_can_be_told_at_a_glance() {
    let floor = HalfSpace::new([0.0, 0.0, 0.1], [0.0, 0.0, 7.0]);
    let ball = Sphere::new([0.0, 0.0, 1.0], 0.2);
    let rod = Capsule::new([-1.0, 0.0, 2.0], [1.0, 0.0, 2.0], 0.1);
    let cube = Cuboid::new(Pose::at(Vec3::new(0.0, 3.0, 2.0)), [2.0, 2.0, 2.0]);
    let far_cube = Cuboid::new(Pose::at(Vec3::new(5.0, 7.0, 2.0)), [2.0, 2.0, 2.0]);
    let can = Cylinder::new([0.0, 0.0, 4.0], [0.0, 0.0, 5.0], 0.5);
    let lying = Cylinder::new([-1.0, 0.0, 7.0], [3.0, 0.0, 7.0], 0.25);
    let stout = Cylinder::new([3.0, 0.0, 8.0], [3.0, 0.0, 8.5], 2.0);
    let cases: [(Shape, Shape, f64); 19] = [
        // Wall, end and rim against face, edge and corner, then against each other.
        (lying.into(), cube.into(), 20.0_f64.sqrt() - 0.25),
        (can.into(), cube.into(), (1.5_f64.powi(2) + 1.0).sqrt()),
        (cube.into(), can.into(), (1.5_f64.powi(2) + 1.0).sqrt()),
        (can.into(), lying.into(), 1.75),
        (lying.into(), can.into(), 1.75),
        (
            can.into(),
            stout.into(),
            (0.5_f64.powi(2) + 3.0_f64.powi(2)).sqrt(),
        ),
        (lying.into(), stout.into(), 0.75),
        (
            can.into(),
            Cylinder::new([0.0, 0.0, 4.9], [0.0, 0.0, 6.0], 0.1).into(),
            -0.1,
        ),
        (ball.into(), floor.into(), 0.7),
        (rod.into(), floor.into(), 1.8),
        (cube.into(), floor.into(), 0.9),
        (can.into(), floor.into(), 3.9),
        (ball.into(), rod.into(), 0.7),
        (rod.into(), cube.into(), 1.9),
        (cube.into(), far_cube.into(), 13.0_f64.sqrt()),
        (rod.into(), can.into(), 1.9),
        (ball.into(), can.into(), 2.8),
        // Deep inside: the nearest way out.
        (Sphere::new([0.0, 3.5, 2.0], 0.1).into(), cube.into(), -0.6),
        (Sphere::new([0.1, 0.0, 4.5], 0.1).into(), can.into(), -0.5),
    ];
    for (first, second, expected) in cases {
        let found = measured(&first, &second).distance;
        assert!(
            (found - expected).abs() < 1e-14,
            "{first:?}, {second:?}: {found}"
        );
    }
}

#[test]
fn middles_in_one_place_have_a_finite_normal() {
    let origin = [0.0; 3];
    let x = [1.0, 0.0, 0.0];
    let shapes: [Shape; 6] = [
        Sphere::new(origin, 0.1).into(),
        Sphere::new(origin, 0.0).into(),
        Capsule::new([-1.0, 0.0, 0.0], x, 0.1).into(),
        Cuboid::new(Pose::IDENTITY, [0.2, 0.0, 0.4]).into(),
        Cylinder::new([-1.0, 0.0, 0.0], x, 0.1).into(),
        HalfSpace::new(origin, x).into(),
    ];
    for first in &shapes {
        for second in &shapes {
            if first.check_pair(second).is_err() {
                continue;
            }
            let closest = measured(first, second);
            assert!(
                closest.distance <= 1e-12,
                "{first:?}, {second:?}: {closest:?}"
            );
            for point in [closest.normal, closest.on_first, closest.on_second] {
                assert!(
                    point.norm().is_finite(),
                    "{first:?}, {second:?}: {closest:?}"
                );
            }
        }
    }
}

#[test]
fn what_is_no_shape_is_refused() {
    let no_shapes: [Shape; 6] = [
        Sphere::new([0.0; 3], -0.1).into(),
        Sphere::new([f64::NAN, 0.0, 0.0], 0.1).into(),
        Capsule::new([0.0; 3], [f64::INFINITY, 0.0, 0.0], 0.1).into(),
        Cylinder::new([1.0; 3], [1.0; 3], 0.1).into(),
        HalfSpace::new([0.0; 3], [0.0; 3]).into(),
        Cuboid::new(
            Pose {
                x_axis: Vec3::ZERO,
                ..Pose::IDENTITY
            },
            [1.0; 3],
        )
        .into(),
    ];
    for shape in no_shapes {
        assert!(shape.check().is_err(), "{shape:?}");
    }
}
