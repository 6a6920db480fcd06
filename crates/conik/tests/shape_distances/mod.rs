//! Distances of shapes for the table of every task.

use conik::{
    Capsule, Cuboid, Cylinder, Frame, HalfSpace, Pose, Shape, ShapeDistance, Sphere, Task, Vec3,
};

/// Shapes of every kind on links and in the world, each pair that is measured in a way of its own.
pub fn shape_distances() -> Vec<(&'static str, Box<dyn Task>)> {
    let capsule = Capsule::new([0.0, 0.1, 0.0], [0.3, 0.0, 0.1], 0.05);
    let ball = Sphere::new([0.0, 0.05, 0.1], 0.06);
    let turned = Pose {
        x_axis: Vec3::new(0.6, 0.8, 0.0),
        y_axis: Vec3::new(-0.8, 0.6, 0.0),
        ..Pose::at(Vec3::new(0.5, 0.4, 0.3))
    };
    let cuboid = Cuboid::new(turned, [0.3, 0.2, 0.1]);
    // Arms of random reach are in it more often than not.
    let large = Cuboid::new(turned, [1.6, 2.2, 1.9]);
    let cylinder = Cylinder::new([-0.4, 0.2, 0.0], [-0.5, 0.3, 0.6], 0.1);
    let floor = HalfSpace::new([0.0, 0.0, -0.4], [0.1, 0.2, 1.0]);
    let hand = Cuboid::new(Pose::IDENTITY, [0.1, 0.15, 0.05]);
    let of = |frame, shape: Shape, other: Shape| ShapeDistance::between(frame, shape, other);
    let (second, fourth) = (Frame::Link(2), Frame::Link(4));
    let between: [(&'static str, ShapeDistance); 12] = [
        (
            "shapes: ball, ball",
            of(second, ball.into(), Sphere::new([0.4; 3], 0.1).into()),
        ),
        (
            "shapes: capsule, box",
            of(fourth, capsule.into(), cuboid.into()),
        ),
        (
            "shapes: capsule, large box",
            of(fourth, capsule.into(), large.into()),
        ),
        (
            "shapes: capsule, cylinder",
            of(fourth, capsule.into(), cylinder.into()),
        ),
        (
            "shapes: capsule, floor",
            of(fourth, capsule.into(), floor.into()),
        ),
        (
            "shapes: box, box",
            of(Frame::Tool, hand.into(), cuboid.into()),
        ),
        (
            "shapes: box, large box",
            of(Frame::Tool, hand.into(), large.into()),
        ),
        (
            "shapes: cylinder, floor",
            of(Frame::Tool, cylinder.into(), floor.into()),
        ),
        (
            "shapes: capsules on two links",
            of(Frame::Tool, capsule.into(), capsule.into()).relative_to(second),
        ),
        (
            "shapes: a box on a link, a ball",
            of(fourth, ball.into(), hand.into()).relative_to(Frame::Link(1)),
        ),
        (
            "shapes: a plane on a link, a box",
            of(second, floor.into(), hand.into()).relative_to(Frame::Tool),
        ),
        (
            "shapes: the world's box and a link's",
            of(Frame::World, cuboid.into(), hand.into()).relative_to(fourth),
        ),
    ];
    let boxed = |(name, task)| (name, Box::new(task) as Box<dyn Task>);
    between.into_iter().map(boxed).collect()
}
