//! Time of one distance of each pair of shapes, and of a step that keeps 200 pairs apart:
//! `cargo bench --bench shapes`, or `cargo bench --bench shapes -- WORDS` as for the bench `step`.

mod timing;

use std::hint::black_box;

use conik::{
    Capsule, Controller, Cuboid, Cylinder, Frame, HalfSpace, JointVec, Pose, Position, Robot,
    Settings, Shape, ShapeDistance, Sphere, Stack, TaskId, Vec3,
};
use timing::{is_wanted, report};

const PAIRS: usize = 200;
const TICKS: usize = 2000;

fn main() {
    timing::heading();
    distances();
    for on_demand in [true, false] {
        for (name, near) in [("all far away", false), ("some near by", true)] {
            step(name, near, on_demand);
        }
    }
}

/// Of shapes in a thousand places, most of them apart.
fn distances() {
    let turned = |x: f64| Pose {
        x_axis: Vec3::new(0.6, 0.8, 0.0),
        y_axis: Vec3::new(-0.8, 0.6, 0.0),
        ..Pose::at(Vec3::new(x, 0.3, 0.2))
    };
    let shapes: [(&str, Shape); 5] = [
        ("sphere", Sphere::new([0.1, 0.2, 0.3], 0.05).into()),
        (
            "capsule",
            Capsule::new([0.0; 3], [0.4, 0.1, 0.0], 0.05).into(),
        ),
        ("box", Cuboid::new(turned(0.1), [0.3, 0.2, 0.1]).into()),
        (
            "cylinder",
            Cylinder::new([0.0; 3], [0.1, 0.2, 0.4], 0.1).into(),
        ),
        (
            "half-space",
            HalfSpace::new([0.0; 3], [0.1, 0.2, 1.0]).into(),
        ),
    ];
    let poses: Vec<Pose> = (0..1000)
        .map(|i| {
            let angle = f64::from(i) * 0.37;
            let turn = Vec3::new(angle.sin(), angle.cos(), 0.3) * (f64::from(i) * 0.01);
            Pose {
                x_axis: Vec3::new(1.0, 0.0, 0.0).turned_by(turn),
                y_axis: Vec3::new(0.0, 1.0, 0.0).turned_by(turn),
                z_axis: Vec3::new(0.0, 0.0, 1.0).turned_by(turn),
                origin: Vec3::new(angle.cos(), angle.sin(), 0.4) * 0.7,
            }
        })
        .collect();
    for (i, (a, first)) in shapes.iter().enumerate() {
        for (b, second) in &shapes[i..] {
            let name = format!("distance of {a} and {b}");
            if first.check_pair(second).is_ok() && is_wanted(&name) {
                report(&name, &poses, |pose| {
                    black_box(first.placed(black_box(pose)).closest_to(second));
                });
            }
        }
    }
}

/// Four capsules on an arm against fifty boxes, while the tool goes round in a circle.
fn step(name: &str, near: bool, on_demand: bool) {
    let measured = if on_demand { "needed" } else { "all" };
    let name = format!("step with {PAIRS} pairs, {name}, {measured} measured");
    if !is_wanted(&name) {
        return;
    }
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let links = [
        (2, Capsule::new([0.0, 0.0, 0.13], [0.425, 0.0, 0.13], 0.06)),
        (3, Capsule::new([0.0, 0.0, 0.02], [0.392, 0.0, 0.02], 0.05)),
        (5, Capsule::new([0.0; 3], [0.0; 3], 0.05)),
        (6, Capsule::new([0.0, 0.0, -0.03], [0.0; 3], 0.04)),
    ];
    for i in 0..PAIRS / links.len() {
        let angle = i as f64 * 0.7;
        let far = if near && i % 10 == 0 {
            0.72
        } else {
            1.6 + 0.01 * i as f64
        };
        let place = Vec3::new(far * angle.cos(), far * angle.sin(), -0.25);
        let obstacle = Cuboid::new(Pose::at(place), [0.2, 0.15, 0.3]);
        for (link, shape) in links {
            let distance = ShapeDistance::between(Frame::Link(link), shape, obstacle);
            stack
                .set(&format!("{link}/{i}"), distance, 0.01..)
                .expect("sound");
        }
    }
    let start = [0.486, -0.066, -0.25];
    let position = stack
        .equality("position", Position::of_tool(), &start, 1.5)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    if on_demand {
        controller.measure_on_demand();
    }
    let mut q = JointVec::from([-0.84, -2.76, -1.88, -1.57, -1.48, 0.0]);
    let run: Vec<(JointVec, [f64; 3])> = (0..TICKS)
        .map(|k| {
            let (sin, cos) = (k as f64 / 250.0).sin_cos();
            let target = [0.45 * cos, 0.45 * sin, -0.25];
            let here = q;
            q = tick(&mut controller, position, &here, &target);
            (here, target)
        })
        .collect();
    report(&name, &run, |(q, target)| {
        black_box(tick(&mut controller, position, black_box(q), target));
    });
}

fn tick(
    controller: &mut Controller,
    position: TaskId,
    q: &JointVec,
    target: &[f64; 3],
) -> JointVec {
    controller
        .setpoints()
        .set_desired(position, target)
        .expect("finite");
    controller.step(q).expect("finite").q_ref
}
