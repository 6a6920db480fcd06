//! Every type of task that can be a set, kept by `cone` and `land` while the tool is sent across its border.

use conik::{
    Controller, Elbow, Frame, Interval, JacobianPart, JointVec, Kinematics, LookAt, Manipulability,
    OrientationAngle, Plane, PointingAngle, Position, Posture, Robot, Settings,
    SmallestSingularValue, Stack, Task,
};

const START: [f64; 6] = [0.3, -1.2, 1.4, -0.6, 1.0, 0.2];
/// What a set may be left by [task's unit]: nothing but rounding.
const KEPT: f64 = 1e-9;

fn value_of(robot: &Robot, task: &dyn Task, q: &[f64]) -> f64 {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let mut value = [f64::NAN];
    task.value(&kinematics, &mut value);
    value[0]
}

/// Sends the arm to the posture `to`, which lies outside the interval.
fn keep(task: impl Task + Copy, interval: Interval, to: &[f64; 6]) {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let label = format!("{task:?}");
    let is_outside = |value: f64| value < interval.min - KEPT || value > interval.max + KEPT;
    assert!(
        !is_outside(value_of(&robot, &task, &START)),
        "{label} starts outside"
    );
    let there = value_of(&robot, &task, to);
    assert!(
        is_outside(there),
        "{label}: {there} is not outside {interval:?}"
    );
    let mut stack = Stack::new(&robot);
    let set = stack.set("set", task, interval).expect("sound");
    stack
        .equality("posture", Posture::of_all(&robot), to, 2.0)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    let mut q = JointVec::from(START);
    let mut was_active = false;
    for tick in 0..600 {
        let step = controller.step(&q).expect("finite");
        let value = step.value(set)[0];
        assert!(!is_outside(value), "{label}, tick {tick}: {value}");
        was_active |= step.active.contains(set);
        q = step.q_ref;
    }
    assert!(was_active, "{label} was never at its border");
}

/// The side of the middle between start and end that the start is on.
fn near_half(task: &dyn Task, to: &[f64; 6]) -> Interval {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let (start, end) = (value_of(&robot, task, &START), value_of(&robot, task, to));
    let middle = 0.5 * (start + end);
    if start < end {
        Interval::from(..=middle)
    } else {
        Interval::from(middle..)
    }
}

fn keep_near_half(task: impl Task + Copy, to: &[f64; 6]) {
    keep(task, near_half(&task, to), to);
}

#[test]
fn sets_of_angles_are_kept() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&START);
    let tool = *kinematics.world_from(Frame::Tool);
    let ahead = tool.origin + tool.z_axis * 0.4;
    let to = [1.0, -0.8, 1.0, -1.4, 0.2, -0.6];
    // From where the angles have no derivative.
    keep_near_half(OrientationAngle::of_tool_to(tool), &to);
    keep_near_half(PointingAngle::of_tool_along(tool.z_axis), &to);
    keep_near_half(PointingAngle::of_tool_along(-tool.z_axis), &to);
    keep_near_half(LookAt::of_tool_at(ahead), &to);
    let seen = PointingAngle::between(Frame::Link(5), [0.3, -1.0, 0.2])
        .with_axis([1.0, 0.0, 0.4])
        .relative_to(Frame::Link(3));
    keep_near_half(seen, &to);
    let elbow = Elbow::of(
        [Frame::Link(1), Frame::Link(2), Frame::Tool],
        [0.3, 0.4, 1.0],
    );
    keep_near_half(elbow, &to);
}

#[test]
fn sets_of_heights_are_kept() {
    let down = [0.3, -1.2, 2.0, -0.6, 1.0, 0.2];
    keep_near_half(Plane::height_of_tool(), &down);
    let tilted = Plane::of_tool_to([0.3, 0.2, 1.0], 0.1).relative_to(Frame::Link(1));
    keep_near_half(tilted, &down);
}

#[test]
fn singularities_are_kept_away_from() {
    // Stretched, and with the wrist's first and last axis in line.
    let stretched = [0.3, -1.2, 0.0, -0.6, 1.0, 0.2];
    let aligned = [0.3, -1.2, 1.4, -0.6, 0.0, 0.2];
    for (part, to) in [
        (JacobianPart::Position, stretched),
        (JacobianPart::Pose, stretched),
        (JacobianPart::Pose, aligned),
    ] {
        let manipulability = Manipulability::of_tool(part);
        assert!(near_half(&manipulability, &to).min > 0.0, "{part:?}");
        keep_near_half(manipulability, &to);
        keep_near_half(SmallestSingularValue::of_tool(part), &to);
    }
}

#[test]
fn the_tool_is_sent_across_a_border_by_a_position_too() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let start = value_of(&robot, &Plane::height_of_tool(), &START);
    let set = stack
        .set("table", Plane::height_of_tool(), start - 0.02..)
        .expect("sound");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&START);
    let mut target = kinematics.world_from(Frame::Tool).origin;
    target.z -= 0.1;
    let position = stack
        .equality("position", Position::of_tool(), &target.to_array(), 1.0)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    let mut q = JointVec::from(START);
    for _ in 0..1500 {
        let step = controller.step(&q).expect("finite");
        assert!(step.value(set)[0] >= start - 0.02 - KEPT);
        q = step.q_ref;
    }
    let left = controller.last_step().error_norm(position);
    assert!((left - 0.08).abs() < 1e-6, "as near as it may come: {left}");
}
