//! How well do the rules work? Random scenes and the paper's examples, under every combination of mode
//! rule, border and recursion, as tables in Markdown.
//!
//! ```text
//! cargo run --release -p conik --example evidence -- --scenes 1000 --jobs 2
//! cargo run --release -p conik --example evidence -- --paper
//! cargo run --release -p conik --example evidence -- --scenes 10000 --combo cone/land/siciliano-slotine
//! cargo run --release -p conik --example evidence -- --only 17 --combo cone/land/siciliano-slotine
//! ```
//!
//! Scenes whose outcome is not as it should be are named on standard error while it runs; `--only`
//! prints the course of one of them. Values are recomputed by a second kinematics (`chain`), stops are
//! judged by a second solver (`stationary`).

mod arguments;
mod chain;
mod combo;
mod course;
mod examples;
#[path = "../../tests/paper/mod.rs"]
mod paper;
mod random;
mod run;
mod scene;
mod stationary;
mod table;
mod trace;

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use arguments::Arguments;
use combo::Combo;
use run::Outcome;
use scene::Scene;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse(std::env::args().skip(1))?;
    if arguments.paper {
        examples::print(&arguments.combos);
    } else if let Some(index) = arguments.only {
        for combo in &arguments.combos {
            trace::print(arguments.seed, index, *combo, arguments.from_tick)?;
        }
    } else {
        table::print_head(arguments.scenes, arguments.seed);
        for combo in &arguments.combos {
            let outcomes = campaign(&arguments, *combo);
            table::print_row(*combo, &outcomes);
        }
    }
    Ok(())
}

/// All scenes under one combination, in the order of their numbers whatever the number of jobs.
fn campaign(arguments: &Arguments, combo: Combo) -> Vec<(Scene, Outcome)> {
    let next = AtomicU64::new(arguments.first);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= arguments.first + arguments.scenes {
                        break;
                    }
                    let scene = Scene::random(arguments.seed, index);
                    let mut outcome = run::run(&scene, combo.settings(scene.rate_hz), |_, _, _| {})
                        .expect("random scenes are sound");
                    let median = outcome.median_time();
                    let slowest = outcome.times.last().copied().unwrap_or_default();
                    outcome.times = vec![median, slowest];
                    if let Some(complaint) = table::complaint(&scene, &outcome) {
                        eprintln!("{combo} scene {index}: {complaint}");
                    }
                    done.lock()
                        .expect("no job panics")
                        .push((index, scene, outcome));
                }
            });
        }
    });
    let mut done = done.into_inner().expect("no job panics");
    done.sort_by_key(|(index, _, _)| *index);
    done.into_iter()
        .map(|(_, scene, outcome)| (scene, outcome))
        .collect()
}
