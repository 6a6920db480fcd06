//! Time of one step in each example of the paper, and of kinematics alone: `cargo bench`.
//!
//! Steps are replayed at the configurations of a whole run, once one by one (median, p99, max; each
//! figure includes reading the clock, whose own time is printed first) and once in batches of 100
//! (the median batch divided by 100). Pin it to one core to compare with another program.

#[path = "../tests/paper/mod.rs"]
mod paper;

use std::hint::black_box;
use std::time::Instant;

use conik::{FieldOfView, JacobianMut, JointVec, Kinematics, Position, Robot, Settings, Task};
use paper::Example;

const TICKS: usize = 7500;
const BATCH: usize = 100;
const ROUNDS: usize = 5;

fn main() {
    println!("reading the clock twice: {} ns", clock_ns());
    println!(
        "{:<38} {:>9} {:>9} {:>9} {:>9}",
        "[µs]", "median", "p99", "max", "batch"
    );
    kinematics();
    for (number, start) in [(1, "thesis"), (2, "thesis"), (3, "thesis"), (2, "bench")] {
        for settings in [Settings::of_the_paper(), Settings::at_rate(125.0)] {
            example(number, start, settings);
        }
    }
}

/// Fastest of many pairs of clock readings.
fn clock_ns() -> u128 {
    (0..100_000)
        .map(|_| Instant::now().elapsed().as_nanos())
        .min()
        .unwrap_or(0)
}

/// Forward kinematics with the 3×6 Jacobians of the tool's position and of its z axis.
fn kinematics() {
    let mut kinematics = Kinematics::new(&Robot::builtin("ur5-paper").expect("built in"));
    let mut jacobian = [0.0; 18];
    let view = FieldOfView::of_tool_along([1.0, 0.0, 0.0]);
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
    report(
        "forward kinematics + both Jacobians",
        &configurations,
        |q| {
            kinematics.update(black_box(q));
            Position::of_tool().jacobian(&kinematics, &mut JacobianMut::new(&mut jacobian, 6));
            black_box(&jacobian);
            for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
                kinematics.axis_row(conik::Frame::Tool, axis.into(), &mut jacobian[..6]);
                black_box(&jacobian);
            }
            let mut sigma = [0.0];
            view.value(&kinematics, &mut sigma);
            black_box(sigma);
        },
    );
}

fn example(number: u8, start: &str, settings: Settings) {
    let q0 = match start {
        "thesis" => paper::thesis(),
        _ => [
            -0.913_794, -2.850_336, -1.496_087, -1.936_762, -2.484_59, 1.611_513,
        ],
    };
    let mut example = Example::new(number, q0, settings);
    let run: Vec<(JointVec, [f64; 3])> = (0..TICKS)
        .map(|_| {
            let q = example.q;
            example.tick();
            (q, example.waypoints.target().to_array())
        })
        .collect();
    let name = format!("example {number}, {:?}, start {start}", settings.mode_rule).to_lowercase();
    let (position, mut controller) = (example.position, example.controller);
    report(&name, &run, |(q, target)| {
        controller
            .setpoints()
            .set_desired(position, target)
            .expect("finite");
        black_box(controller.step(black_box(q)).expect("finite"));
    });
}

fn report<T>(name: &str, inputs: &[T], mut work: impl FnMut(&T)) {
    // `cargo bench --bench step -- WORDS` measures only what has the words in its name.
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'))
        .collect();
    if !wanted.iter().all(|word| name.contains(word.as_str())) {
        return;
    }
    let mut single = Vec::new();
    let mut batches = Vec::new();
    for _ in 0..ROUNDS {
        for input in inputs {
            let before = Instant::now();
            work(input);
            single.push(before.elapsed().as_nanos());
        }
        for batch in inputs.chunks_exact(BATCH) {
            let before = Instant::now();
            batch.iter().for_each(&mut work);
            batches.push(before.elapsed().as_nanos());
        }
    }
    single.sort_unstable();
    batches.sort_unstable();
    let us = |ns: u128| ns as f64 / 1e3;
    println!(
        "{name:<38} {:>9.3} {:>9.3} {:>9.3} {:>9.3}",
        us(single[single.len() / 2]),
        us(single[single.len() * 99 / 100]),
        us(single[single.len() - 1]),
        us(batches[batches.len() / 2]) / BATCH as f64,
    );
}
