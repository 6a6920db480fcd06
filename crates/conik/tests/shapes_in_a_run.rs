//! Arms with shapes on their links keep them away from others, sample by sample.

use conik::{
    Capsule, Controller, Cuboid, Frame, JointVec, Pose, Position, Robot, Settings, ShapeDistance,
    Stack, TaskId, Vec3,
};

const LEAST: f64 = 0.02;

/// The forearm of the arm, from its elbow on, in the frame after the elbow.
fn forearm() -> Capsule {
    Capsule::new([0.0; 3], [0.392_25, 0.0, 0.0], 0.05)
}

struct Run {
    controller: Controller,
    q: JointVec,
    forearm: TaskId,
}

/// The tool is to go along a table, over which something hangs in the way of the forearm.
fn run() -> Run {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let q = JointVec::from([-0.84, -1.9, -1.5, -1.3, 1.5, 0.0]);
    let mut kinematics = conik::Kinematics::new(&robot);
    kinematics.update(&q);
    let tool = kinematics.world_from(Frame::Tool).origin;
    let middle = kinematics
        .world_from(Frame::Link(3))
        .transform(Vec3::new(0.2, 0.0, 0.0));
    // A quarter of a turn further about the base.
    let target = tool.turned_by(Vec3::new(0.0, 0.0, 1.2));
    let on_the_way = middle.turned_by(Vec3::new(0.0, 0.0, 0.6));
    let mut stack = Stack::new(&robot);
    let crate_ = Cuboid::new(Pose::at(on_the_way), [0.12, 0.12, 0.12]);
    let distance = ShapeDistance::between(Frame::Link(3), forearm(), crate_);
    let forearm = stack
        .set("forearm/crate", distance, LEAST..)
        .expect("sound");
    stack
        .equality("position", Position::of_tool(), &target.to_array(), 1.0)
        .expect("sound");
    let settings = Settings::at_rate(125.0);
    let controller = Controller::new(&robot, stack, settings).expect("sound");
    Run {
        controller,
        q,
        forearm,
    }
}

#[test]
fn forearm_slides_along_a_box_and_never_comes_closer() {
    let Run {
        mut controller,
        mut q,
        forearm,
    } = run();
    let (mut active, mut closest) = (0, f64::INFINITY);
    for tick in 0..125 * 20 {
        let step = controller.step(&q).expect("finite");
        let distance = step.value(forearm)[0];
        closest = distance.min(closest);
        assert!(distance >= LEAST, "{distance} at tick {tick}");
        if step.active.contains(forearm) {
            active += 1;
        }
        q = step.q_ref;
    }
    println!("{active} {closest}");
    assert!(active > 50, "it was in the way for {active} ticks");
    assert!(closest < LEAST + 1e-6, "{closest}");
}
