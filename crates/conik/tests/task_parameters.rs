//! What tasks refuse, and what those ask for that are no plain differences: turns and speeds.

use conik::{
    Body, Controller, Elbow, Frame, FramePose, JacobianMut, Joint, JointKind, JointPosition,
    JointSpeed, JointVec, Kinematics, LookAt, Mimic, Orientation, OrientationAngle, Plane,
    PointingAngle, Pose, Posture, Robot, RobotBuilder, Settings, Stack, Task, Vec3,
};
use std::f64::consts::PI;

fn ur5() -> Robot {
    Robot::builtin("ur5-paper").expect("built in")
}

#[test]
fn parameters_that_say_nothing_are_refused() {
    let robot = ur5();
    let stretched = Pose {
        x_axis: Vec3::new(2.0, 0.0, 0.0),
        ..Pose::IDENTITY
    };
    let nowhere = Pose::at(Vec3::new(f64::NAN, 0.0, 0.0));
    let arm = [Frame::Link(1), Frame::Link(2), Frame::Tool];
    let mut turning = Orientation::of_tool(Pose::IDENTITY);
    turning.set_desired_turning(Pose::IDENTITY, [f64::INFINITY, 0.0, 0.0]);
    let mut moving = LookAt::of_tool_at([1.0; 3]);
    moving.set_point_moving([1.0; 3], [0.0, f64::NAN, 0.0]);
    let wrong: Vec<Box<dyn Task>> = vec![
        Box::new(Orientation::of_tool(stretched)),
        Box::new(turning),
        Box::new(OrientationAngle::of_tool_to(stretched)),
        Box::new(FramePose::of_tool(nowhere)),
        Box::new(Orientation::of(Frame::Link(99), Pose::IDENTITY)),
        Box::new(Orientation::of_tool(Pose::IDENTITY).relative_to(Frame::Tool)),
        Box::new(PointingAngle::of_tool_along([0.0; 3])),
        Box::new(PointingAngle::of_tool_along([1.0; 3]).with_axis([0.0; 3])),
        Box::new(PointingAngle::of_tool_along([f64::NAN; 3])),
        Box::new(LookAt::of_tool_at([f64::INFINITY, 0.0, 0.0])),
        Box::new(moving),
        Box::new(Plane::of_tool_to([0.0; 3], 0.1)),
        Box::new(Plane::of_tool_to([0.0, 0.0, 1.0], f64::NAN)),
        Box::new(Posture::of([0, 6])),
        Box::new(Posture::of([1, 2, 1])),
        Box::new(JointSpeed::of(6, 0.1)),
        Box::new(JointSpeed::of(0, f64::NAN)),
        Box::new(Elbow::of(arm, [0.0; 3])),
        Box::new(Elbow::of([arm[0], arm[0], arm[1]], [0.0, 0.0, 1.0])),
        Box::new(Elbow::of(
            [arm[0], Frame::Link(99), arm[1]],
            [0.0, 0.0, 1.0],
        )),
    ];
    for task in wrong {
        assert!(task.check(&robot).is_err(), "{task:?}");
    }
    let right: Vec<Box<dyn Task>> = vec![
        Box::new(Orientation::of_tool(Pose::from_rpy([0.1, 0.2, 0.3]))),
        Box::new(PointingAngle::of_tool_along([0.0, 0.0, 1e-9])),
        Box::new(Posture::of_all(&robot)),
        Box::new(Elbow::of(arm, [0.0, 0.0, 3.0])),
    ];
    for task in right {
        assert_eq!(task.check(&robot), Ok(()), "{task:?}");
    }
}

#[test]
fn empty_posture_is_no_task() {
    let robot = ur5();
    let mut stack = Stack::new(&robot);
    assert!(
        stack
            .equality("posture", Posture::of([]), &[], 1.0)
            .is_err()
    );
}

#[test]
fn joint_moves_at_its_speed_and_makes_nothing_up() {
    let robot = ur5();
    let start = [0.3, -1.2, 1.4, -0.6, 1.0, 0.2];
    let mut stack = Stack::new(&robot);
    stack
        .set("stop", JointPosition::of(5), ..=0.7)
        .expect("sound");
    let spin = stack
        .equality("spin", JointSpeed::of(5, 0.5), &[0.0], 3.0)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    let mut q = JointVec::from(start);
    let mut run = |seconds: u32, speed: Option<f64>| {
        if let Some(speed) = speed {
            let mut setpoints = controller.setpoints();
            let task = setpoints.task_mut::<JointSpeed>(spin).expect("a speed");
            task.set_speed(speed);
        }
        for _ in 0..125 * seconds {
            q = controller.step(&q).expect("finite").q_ref;
        }
        q[5]
    };
    // A second before the stop, two seconds at it, and from it.
    let moved = run(1, Some(0.3));
    // But for the damping near singularities.
    assert!((moved - 0.5).abs() < 1e-6, "{moved}");
    let stopped = run(3, Some(0.5));
    assert!((stopped - 0.7).abs() < 1e-6, "{stopped}");
    let back = run(1, Some(-0.25));
    assert!((back - (stopped - 0.25)).abs() < 1e-6, "{back}");
}

/// Shoulder, elbow and wrist on a joint that swivels them about the line between shoulder and wrist.
fn swivel() -> Robot {
    let mut robot = RobotBuilder::new("swivel");
    let arm = robot
        .joint(Body::FIXED, Pose::IDENTITY, Joint::revolute("swivel"))
        .expect("sound");
    for (name, place) in [
        ("shoulder", [0.0, 0.0, 0.0]),
        ("elbow", [0.2, 0.0, 0.3]),
        ("wrist", [0.0, 0.0, 0.6]),
    ] {
        let place = Pose::at(place.into());
        robot.link(name, arm, place).expect("sound");
    }
    robot.build().expect("sound")
}

#[test]
fn elbow_swivels_the_shorter_way_past_half_a_turn() {
    let robot = swivel();
    let elbow = Elbow::of(
        [Frame::Link(0), Frame::Link(1), Frame::Link(2)],
        [1.0, 0.0, 0.2],
    );
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&[0.4]);
    let mut value = [0.0];
    elbow.value(&kinematics, &mut value);
    assert!((value[0] - 0.4).abs() < 1e-15, "the joint is the angle");

    let mut stack = Stack::new(&robot);
    let task = stack.equality("elbow", elbow, &[-3.0], 2.0).expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    let mut q = JointVec::from([2.9]);
    for _ in 0..125 * 15 {
        q = controller.step(&q).expect("finite").q_ref;
        assert!(q[0] >= 2.9 - 1e-12, "{}: the long way", q[0]);
    }
    assert!((q[0] - (2.0 * PI - 3.0)).abs() < 1e-9, "{}", q[0]);
    assert!(controller.last_step().error_norm(task) < 1e-9);
}

#[test]
fn height_above_a_plane_counts_from_the_plane_and_falls_as_it_rises() {
    let robot = ur5();
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&[0.3, -1.2, 1.4, -0.6, 1.0, 0.2]);
    let tool = kinematics.world_from(Frame::Tool).origin;
    let mut plane = Plane::of_tool_to([0.0, 0.0, 2.0], 0.0);
    plane.set_offset_moving(0.1, 0.3);
    let (mut now, mut later) = ([0.0], [0.0]);
    plane.value(&kinematics, &mut now);
    plane.value_ahead(&kinematics, 0.5, &mut later);
    assert!((now[0] - (tool.z - 0.1)).abs() < 1e-15, "{now:?}");
    assert!((later[0] - (tool.z - 0.25)).abs() < 1e-15, "{later:?}");
}

/// A finger that follows the one joint at three times its speed.
fn follower() -> Robot {
    let mut robot = RobotBuilder::new("follower");
    let hand = robot
        .joint(Body::FIXED, Pose::IDENTITY, Joint::revolute("hand"))
        .expect("sound");
    let at = Pose::at(Vec3::new(0.0, 0.1, 0.0));
    let mimic = Mimic {
        joint: 0,
        multiplier: 3.0,
        offset: 0.0,
    };
    let finger = robot
        .follower_between(hand, at, (JointKind::Revolute, mimic, "finger"), at)
        .expect("sound");
    robot.link("tip", finger, at).expect("sound");
    robot.build().expect("sound")
}

#[test]
fn bounds_on_speeds_count_what_follows_a_joint() {
    let robot = follower();
    let mut kinematics = Kinematics::new(&robot);
    let tasks: Vec<Box<dyn Task>> = vec![
        Box::new(Plane::of_tool_to([1.0, 0.0, 0.0], 0.0)),
        Box::new(PointingAngle::of_tool_along([1.0, 0.0, 0.0]).with_axis([0.0, 1.0, 0.0])),
        Box::new(OrientationAngle::of_tool_to(Pose::IDENTITY)),
    ];
    for task in tasks {
        let mut steepest: f64 = 0.0;
        for i in 0..60 {
            kinematics.update(&[0.1 * f64::from(i)]);
            let mut row = [0.0];
            task.jacobian(&kinematics, &mut JacobianMut::new(&mut row, 1));
            steepest = steepest.max(row[0].abs());
        }
        let bound = task.steepness(&kinematics);
        assert!(steepest <= bound + 1e-12, "{task:?}: {steepest} > {bound}");
    }
}
