//! Distances of shapes change no faster than their bound says, however far the arm goes: sets far inside
//! are left alone by it.

use conik::{
    Body, Capsule, Cuboid, Cylinder, Frame, HalfSpace, Joint, JointKind, Kinematics, Mimic, Pose,
    Robot, RobotBuilder, Shape, ShapeDistance, Sphere, Task, Vec3,
};
use proptest::prelude::*;

/// A short arm, on which shapes are as long as the arm, with a joint that turns a link 2.5 times as far as
/// the joint that it follows.
fn short_arm() -> Robot {
    let along = |x: f64| Pose::at(Vec3::new(x, 0.0, 0.0));
    let upright = Pose {
        x_axis: Vec3::new(1.0, 0.0, 0.0),
        y_axis: Vec3::new(0.0, 0.0, 1.0),
        z_axis: Vec3::new(0.0, -1.0, 0.0),
        origin: Vec3::new(0.1, 0.0, 0.05),
    };
    let mut robot = RobotBuilder::new("short");
    let shoulder = robot.joint(Body::FIXED, along(0.2), Joint::revolute("shoulder"));
    let shoulder = shoulder.expect("sound");
    let elbow = robot.joint(shoulder, upright, Joint::revolute("elbow"));
    let elbow = elbow.expect("sound");
    let follows = Mimic {
        joint: 1,
        multiplier: 2.5,
        offset: 0.2,
    };
    let finger = (JointKind::Revolute, follows, "finger");
    let finger = robot.follower_between(elbow, along(0.05), finger, Pose::IDENTITY);
    let finger = finger.expect("sound");
    for (name, body) in [
        ("base", Body::FIXED),
        ("shoulder", shoulder),
        ("elbow", elbow),
        ("finger", finger),
    ] {
        robot.link(name, body, along(0.02)).expect("sound");
    }
    robot.build().expect("sound")
}

fn vector(size: f64) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-size..size).prop_map(Vec3::from)
}

fn shape() -> impl Strategy<Value = Shape> {
    (0..5, vector(0.8), vector(0.8), 0.01..0.3_f64).prop_map(|(kind, a, b, size)| match kind {
        0 => Sphere::new(a, size).into(),
        1 => Capsule::new(a, b, size).into(),
        2 => Cuboid::new(Pose::at(a), [size, 2.0 * size, 0.1]).into(),
        3 => Cylinder::new(a, b, size).into(),
        _ => HalfSpace::new(a, b).into(),
    })
}

/// Shapes on two different links, or on a link and in the world, and a shift of the second.
fn distance(links: usize) -> impl Strategy<Value = ShapeDistance> {
    let pair =
        (shape(), shape()).prop_filter("a pair with a distance", |(a, b)| a.check_pair(b).is_ok());
    (pair, 1..links, 0..links, vector(0.5)).prop_map(|((a, b), link, other, shift)| {
        let distance = ShapeDistance::between(Frame::Link(link), a, b);
        let mut distance = match other {
            0 => distance,
            other if other == link => distance.relative_to(Frame::Link(0)),
            other => distance.relative_to(Frame::Link(other)),
        };
        distance.set_shift_moving(shift, Vec3::ZERO);
        distance
    })
}

fn assert_bounded(
    robot: &Robot,
    distance: &ShapeDistance,
    from: &[f64],
    change: &[f64],
) -> Result<(), TestCaseError> {
    let mut kinematics = Kinematics::new(robot);
    let mut value_at = |q: &[f64]| {
        kinematics.update(q);
        let mut value = [0.0];
        distance.value(&kinematics, &mut value);
        (value[0], distance.steepness(&kinematics))
    };
    let to: Vec<f64> = from.iter().zip(change).map(|(q, dq)| q + dq).collect();
    let ((here, steepness), (there, _)) = (value_at(from), value_at(&to));
    let way: f64 = change.iter().map(|dq| dq.abs()).sum();
    let (changed, most) = ((there - here).abs(), steepness * way);
    prop_assert!(
        changed <= most * (1.0 + 1e-9) + 1e-11,
        "{changed} over {way} rad, not {most}"
    );
    Ok(())
}

/// A way of any length, of all joints or of one alone.
fn way(joints: usize) -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    let size = prop::sample::select(vec![1e-4, 0.01, 0.3, 2.0]);
    let joint = prop::collection::vec(-1.0..1.0, joints);
    let start = prop::collection::vec(-3.0..3.0, joints);
    (start, joint, size, 0..=joints).prop_map(|(start, joint, size, only)| {
        let moves = |i: usize| only == joint.len() || only == i;
        let each = joint.iter().enumerate();
        let change = each.map(|(i, dq)| if moves(i) { dq * size } else { 0.0 });
        (start, change.collect())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn distance_on_a_long_arm_is_no_steeper_than_its_bound(
        distance in distance(7),
        (from, change) in way(6),
    ) {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        assert_bounded(&robot, &distance, &from, &change)?;
    }

    #[test]
    fn distance_on_a_short_arm_is_no_steeper_than_its_bound(
        distance in distance(4),
        (from, change) in way(2),
    ) {
        assert_bounded(&short_arm(), &distance, &from, &change)?;
    }
}
