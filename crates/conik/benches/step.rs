//! Time of one step in each example of the paper, in scenes with many sets and many joints, of
//! kinematics alone, and of a step written by hand: `cargo bench --bench step`, or
//! `cargo bench --bench step -- WORDS` for what has the words in its name.
//!
//! Steps are replayed at the configurations of a whole run, once one by one (median, p99, max; each
//! figure includes reading the clock, whose own time is printed first) and once in batches of 100
//! (the median batch divided by 100). Pin it to one core to compare with another program.

mod hand;
#[path = "../tests/paper/mod.rs"]
mod paper;
mod scene;
mod timing;

use std::hint::black_box;

use conik::{
    Border, JacobianMut, JointVec, Kinematics, ModeRule, Position, Recursion, Robot, Settings, Task,
};
use paper::Example;
use scene::Scene;
use timing::{is_wanted, report};

const TICKS: usize = 7500;
const SCENE_TICKS: usize = 5000;
/// The circle begins anew after so many ticks.
const CIRCLE_TICKS: usize = 1100;

/// A start with the view at its border [rad].
const VIEW_AT_BORDER: [f64; 6] = [
    -0.913_794, -2.850_336, -1.496_087, -1.936_762, -2.484_59, 1.611_513,
];

fn main() {
    timing::heading();
    kinematics();
    for (name, start) in [("thesis", paper::thesis()), ("view", VIEW_AT_BORDER)] {
        by_hand(name, start);
        for number in 1..=3 {
            for (rule, settings) in all_settings() {
                example(number, name, start, rule, settings);
            }
        }
    }
    for (name, text) in [
        ("6x48", include_str!("scene/6x48.txt")),
        ("30x6", include_str!("scene/30x6.txt")),
    ] {
        for (rule, settings) in all_settings() {
            scene(name, text, rule, settings);
        }
    }
}

fn all_settings() -> [(&'static str, Settings); 3] {
    let default = Settings {
        mode_rule: ModeRule::Cone,
        border: Border::Land,
        recursion: Recursion::SicilianoSlotine,
        ..Settings::at_rate(125.0)
    };
    let border = Settings {
        mode_rule: ModeRule::Border,
        ..Settings::of_the_paper()
    };
    [
        ("paper", Settings::of_the_paper()),
        ("border", border),
        ("cone, land", default),
    ]
}

/// Forward kinematics with the 3×6 Jacobians of the tool's position and of its z axis.
fn kinematics() {
    let mut random = 0x9e37_79b9_u32;
    let configurations: Vec<[f64; 6]> = (0..TICKS)
        .map(|_| {
            std::array::from_fn(|_| {
                random ^= random << 13;
                random ^= random >> 17;
                random ^= random << 5;
                f64::from(random) / f64::from(u32::MAX) * 6.0 - 3.0
            })
        })
        .collect();
    let name = "kinematics with both Jacobians";
    if is_wanted(name) {
        let mut kinematics = Kinematics::new(&Robot::builtin("ur5-paper").expect("built in"));
        let mut point = [0.0; 18];
        let mut axis = [0.0; 18];
        report(name, &configurations, |q| {
            kinematics.update(black_box(q));
            Position::of_tool().jacobian(&kinematics, &mut JacobianMut::new(&mut point, 6));
            let motion = kinematics.motion(conik::Frame::Tool);
            let z_axis = kinematics.world_from(conik::Frame::Tool).z_axis;
            for (row, direction) in axis.chunks_exact_mut(6).zip(UNIT) {
                kinematics.axis_row(motion, z_axis, direction.into(), row);
            }
            black_box((&point, &axis));
        });
    }
    let name = "kinematics with both Jacobians, by hand";
    if is_wanted(name) {
        report(name, &configurations, |q| {
            let arm = hand::arm(black_box(q));
            black_box((hand::position_rows(&arm), hand::axis_rows(&arm)));
        });
    }
}

const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A run of an example, tick by tick: where it was, and where it was to go.
fn run(example: &mut Example) -> Vec<(JointVec, [f64; 3])> {
    (0..TICKS)
        .map(|_| {
            let q = example.q;
            example.tick();
            (q, example.waypoints.target().to_array())
        })
        .collect()
}

fn by_hand(start_name: &str, start: [f64; 6]) {
    let name = format!("example 2, by hand, start {start_name}");
    if !is_wanted(&name) {
        return;
    }
    let mut example = Example::new(2, start, Settings::of_the_paper());
    let run: Vec<([f64; 6], [f64; 3])> = run(&mut example)
        .into_iter()
        .map(|(q, target)| (std::array::from_fn(|i| q[i]), target))
        .collect();
    report(&name, &run, |(q, target)| {
        black_box(hand::step(black_box(q), *target));
    });
}

fn example(number: u8, start_name: &str, start: [f64; 6], rule: &str, settings: Settings) {
    let name = format!("example {number}, {rule}, start {start_name}");
    if !is_wanted(&name) {
        return;
    }
    let mut example = Example::new(number, start, settings);
    let run = run(&mut example);
    let (position, mut controller) = (example.position, example.controller);
    let mut target_in_use = None;
    report(&name, &run, |(q, target)| {
        if target_in_use.replace(*target) != Some(*target) {
            controller
                .setpoints()
                .set_desired(position, target)
                .expect("finite");
        }
        black_box(controller.step(black_box(q)).expect("finite"));
    });
}

fn scene(name: &str, text: &str, rule: &str, settings: Settings) {
    let name = format!("joints x sets {name}, {rule}");
    if !is_wanted(&name) {
        return;
    }
    let mut scene = Scene::new(text, settings);
    let run: Vec<(JointVec, [f64; 3])> = (0..SCENE_TICKS)
        .map(|k| {
            let (q, target) = (scene.q, scene.target((k % CIRCLE_TICKS) as f64 / 125.0));
            scene.tick(target);
            (q, target)
        })
        .collect();
    let (position, mut controller) = (scene.position, scene.controller);
    report(&name, &run, |(q, target)| {
        controller
            .setpoints()
            .set_desired(position, target)
            .expect("finite");
        black_box(controller.step(black_box(q)).expect("finite"));
    });
}
