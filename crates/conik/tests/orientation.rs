//! Orientations in closed loop: from every angle, also half a turn, and after a desired one that turns.

use conik::{
    Controller, Frame, FramePose, JointVec, Kinematics, Orientation, OrientationAngle, Pose, Robot,
    Settings, Stack, TaskId, Vec3,
};
use std::f64::consts::PI;

const START: [f64; 6] = [0.3, -1.2, 1.4, -0.6, 1.0, 0.2];

fn tool_at(robot: &Robot, q: &[f64]) -> Pose {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    *kinematics.world_from(Frame::Tool)
}

/// The tool turned about an axis of the world.
fn turned(tool: &Pose, axis: [f64; 3], angle: f64) -> Pose {
    Pose::turned(Vec3::from(axis).normalized() * angle) * *tool
}

fn controller(robot: &Robot, desired: Pose) -> (Controller, TaskId, TaskId) {
    let mut stack = Stack::new(robot);
    let orientation = stack
        .equality("orientation", Orientation::of_tool(desired), &[0.0; 3], 2.0)
        .expect("sound");
    // Only to look on: from 0 to π it is always inside.
    let angle = stack
        .set_with_gain("angle", OrientationAngle::of_tool_to(desired), ..=4.0, 1.0)
        .expect("sound");
    let controller = Controller::new(robot, stack, Settings::at_rate(125.0)).expect("sound");
    (controller, orientation, angle)
}

#[test]
fn orientation_converges_the_shorter_way_from_half_a_turn() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let tool = tool_at(&robot, &START);
    for degrees in [179.9_f64, 180.0, 179.999_999, 90.0, 1e-7] {
        for axis in [[0.0, 0.0, 1.0], [1.0, -1.0, 0.3], [-0.2, 1.0, 0.0]] {
            let desired = turned(&tool, axis, degrees.to_radians());
            let (mut controller, orientation, angle) = controller(&robot, desired);
            let mut q = JointVec::from(START);
            let mut last = f64::INFINITY;
            for tick in 0..125 * 15 {
                let step = controller.step(&q).expect("finite");
                let now = step.value(angle)[0];
                assert!(
                    now <= last + 1e-9,
                    "{degrees} {axis:?}, tick {tick}: {last} to {now}"
                );
                last = now;
                q = step.q_ref;
            }
            let left = controller.last_step().error_norm(orientation);
            assert!(left < 1e-9, "{degrees} {axis:?}: {left}");
        }
    }
}

#[test]
fn a_desired_pose_that_moves_is_followed_without_lag() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let tool = tool_at(&robot, &START);
    let (velocity, turning) = (Vec3::new(0.02, -0.03, 0.01), Vec3::new(0.1, 0.2, -0.15));
    let desired_at = |t: f64| Pose {
        origin: tool.origin + velocity * t,
        ..Pose::turned(turning * t) * tool
    };
    let mut stack = Stack::new(&robot);
    let pose = stack
        .equality("pose", FramePose::of_tool(tool), &[0.0; 6], 2.0)
        .expect("sound");
    let rate = 125.0;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(rate)).expect("sound");
    let mut q = JointVec::from(START);
    let mut worst: f64 = 0.0;
    for tick in 0..250 {
        let mut setpoints = controller.setpoints();
        let task = setpoints.task_mut::<FramePose>(pose).expect("a pose");
        task.set_desired_moving(desired_at(f64::from(tick) / rate), velocity, turning);
        let step = controller.step(&q).expect("finite");
        worst = worst.max(step.error_norm(pose));
        q = step.q_ref;
    }
    // What remains is the bend of the arm's path within a tick. Without feed-forward it would be 0.1.
    assert!(worst < 1e-4, "{worst}");
}

#[test]
fn what_turns_on_through_half_a_turn_does_not_jump_within_a_tick() {
    use conik::Task;
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&START);
    let tool = tool_at(&robot, &START);
    let mut task = Orientation::of_tool(tool);
    let turning = Vec3::new(0.0, 0.0, -1.0);
    task.set_desired_turning(turned(&tool, [0.0, 0.0, -1.0], PI - 0.002), turning);
    let (mut now, mut later) = ([0.0; 3], [0.0; 3]);
    task.value(&kinematics, &mut now);
    task.value_ahead(&kinematics, 0.008, &mut later);
    let rate = (later[2] - now[2]) / 0.008;
    assert!((rate - 1.0).abs() < 1e-9, "{now:?} {later:?}");
}

#[test]
fn a_tool_keeps_its_pose_in_a_frame_that_moves_it() {
    // The wrist's own pose in the forearm is a matter of the joints between them alone.
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&START);
    let forearm_from_tool =
        kinematics.world_from(Frame::Link(3)).inverse() * *kinematics.world_from(Frame::Tool);
    let mut stack = Stack::new(&robot);
    let seen = Orientation::of_tool(forearm_from_tool).relative_to(Frame::Link(3));
    let orientation = stack.equality("seen", seen, &[0.0; 3], 2.0).expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    let mut q = JointVec::from(START);
    q[0] += 0.7;
    q[1] -= 0.4;
    assert!(controller.step(&q).expect("finite").error_norm(orientation) < 1e-14);
    q[4] += 0.3;
    assert!((controller.step(&q).expect("finite").error_norm(orientation) - 0.3).abs() < 1e-14);
}
