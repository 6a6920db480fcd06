//! Time of a step of an arm with 6 joints, and of one with 30, that carries 48 sets and keeps 200 pairs of
//! shapes apart while its tool follows a circle: `cargo bench --bench scale`.

mod scene;
mod timing;

use std::hint::black_box;

use conik::{
    Capsule, Cuboid, Frame, JointPosition, JointVec, Kinematics, Plane, Pose, Robot, Settings,
    ShapeDistance, Stack, Vec3,
};
use scene::Scene;
use timing::{is_wanted, report};

const SETS: usize = 48;
/// Obstacles, and links with a shape each.
const OBSTACLES: usize = 20;
const SHAPES: usize = 10;
const TICKS: usize = 1000;
const RATE_HZ: f64 = 125.0;

fn main() {
    timing::heading();
    let scenes = [
        (include_str!("scene/6x48.txt"), 6),
        (include_str!("scene/30x6.txt"), 30),
    ];
    for (text, joints) in scenes {
        for (name, is_near) in [("far", false), ("some near", true)] {
            let name = format!("{joints} joints, {SETS} sets, 200 pairs {name}");
            if is_wanted(&name) {
                run(&name, text, is_near);
            }
        }
    }
}

fn run(name: &str, text: &str, is_near: bool) {
    let mut scene = Scene::crowded(text, Settings::at_rate(RATE_HZ), |robot, q, stack| {
        fill(robot, stack);
        add_pairs(robot, q, stack, is_near);
    });
    scene.controller.measure_on_demand();
    let (mut kinematics, mut pivots, mut active) = (0, 0, 0);
    let run: Vec<(JointVec, [f64; 3])> = (0..TICKS)
        .map(|tick| {
            let input = (scene.q, scene.target(tick as f64 / RATE_HZ));
            scene.tick(input.1);
            let step = scene.controller.last_step();
            kinematics = kinematics.max(1 + step.landed.kinematics);
            pivots = pivots.max(step.pivots);
            active = active.max(step.active.len());
            input
        })
        .collect();
    report(name, &run, |(q, target)| {
        scene.q = *black_box(q);
        scene.tick(*target);
    });
    println!(
        "{:<46} at most {kinematics} kinematics and {pivots} pivots a tick, {active} sets active",
        ""
    );
}

/// Sets that can become active, until there are enough: ranges of the joints, and heights of links.
fn fill(robot: &Robot, stack: &mut Stack) {
    for joint in 0..robot.dof() {
        if stack.len() < SETS {
            let set = stack.set(
                &format!("range {joint}"),
                JointPosition::of(joint),
                -3.0..=3.0,
            );
            set.expect("sound");
        }
    }
    for link in 1.. {
        if stack.len() >= SETS {
            break;
        }
        let height = Plane::height_of(Frame::Link(link));
        let set = stack.set(&format!("height {link}"), height, -1.0..);
        set.expect("a link of the robot");
    }
}

/// Capsules on the last links against boxes around the arm, every fifth of which is near it at the start.
fn add_pairs(robot: &Robot, q: &[f64], stack: &mut Stack, is_near: bool) {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let links = robot.dof();
    let origin = |link: usize| kinematics.world_from(Frame::Link(link)).origin;
    let farthest = (0..=links).map(|link| origin(link).norm());
    let farthest = farthest.fold(0.0, f64::max);
    for i in 0..OBSTACLES {
        let angle = i as f64 * 0.7;
        let around = Vec3::new(angle.cos(), angle.sin(), 0.3 * angle.sin());
        let place = if is_near && i % 5 == 0 {
            origin(links - i % links) + around * 0.3
        } else {
            around * (farthest + 0.8 + 0.02 * i as f64)
        };
        let obstacle = Cuboid::new(Pose::at(place), [0.2, 0.15, 0.3]);
        for k in 0..SHAPES {
            let link = links - k % links;
            let along = Vec3::new(0.03 * (1 + k / links) as f64, 0.0, 0.0);
            let shape = Capsule::new([0.0; 3], along, 0.03);
            let distance = ShapeDistance::between(Frame::Link(link), shape, obstacle);
            let set = stack.set(&format!("{k}/{i}"), distance, 0.01..);
            set.expect("sound");
        }
    }
}
