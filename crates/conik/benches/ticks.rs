//! The steps of Example 2, each in a call of `one_tick`, so that callgrind can count the
//! instructions of every single one: `docs/performance.md` has the commands.
//!
//! `cargo bench --bench ticks -- paper` takes the paper's rule, otherwise it is `cone` with `land`.

#[path = "../tests/paper/mod.rs"]
#[allow(dead_code, reason = "ticks are taken apart here")]
mod paper;

use std::hint::black_box;

use conik::{Border, Controller, ModeRule, Recursion, Settings};
use paper::Example;

const TICKS: usize = 7500;

fn main() {
    let settings = if std::env::args().any(|word| word == "paper") {
        Settings::of_the_paper()
    } else {
        Settings {
            mode_rule: ModeRule::Cone,
            border: Border::Land,
            recursion: Recursion::SicilianoSlotine,
            ..Settings::at_rate(125.0)
        }
    };
    let mut example = Example::new(2, paper::thesis(), settings);
    for _ in 0..TICKS {
        let tool = example
            .controller
            .kinematics_at(&example.q)
            .world_from(conik::Frame::Tool)
            .origin;
        example.waypoints.advance(tool);
        let target = example.waypoints.target().to_array();
        example
            .controller
            .setpoints()
            .set_desired(example.position, &target)
            .expect("finite");
        one_tick(&mut example.controller, &example.q);
        example.q = example.controller.last_step().q_ref;
    }
    println!("{TICKS} steps of example 2, {:?}", settings.mode_rule);
}

#[inline(never)]
fn one_tick(controller: &mut Controller, q: &[f64]) {
    black_box(controller.step(black_box(q)).expect("finite"));
}
