//! What a run of a campaign costs beside its controller's steps.
//!
//! `cargo run --release -p conik-campaign --example cost -- scenarios/paper/example2.toml [RUNS]`

use std::error::Error;
use std::time::{Duration, Instant};

use conik_campaign::flown::row;
use conik_campaign::plan::{Plan, Varied};
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Border, ModeRule, Recursion, Scenario};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which scenario?")?;
    let runs = arguments.next().map_or(Ok(200), |runs| runs.parse())?;
    let as_written = Scenario::from_toml(&std::fs::read_to_string(&path)?)?;
    let mut by_default = as_written.clone();
    by_default.control.mode_rule = ModeRule::Cone;
    by_default.control.border = Border::Land;
    by_default.control.recursion = Recursion::SicilianoSlotine;
    println!("{path}, {runs} runs each");
    measure("as it is", as_written, runs)?;
    measure(
        "with the default rule, border and recursion",
        by_default,
        runs,
    )
}

fn measure(what: &str, scenario: Scenario, runs: u64) -> Result<(), Box<dyn Error>> {
    let plan = Plan::new(scenario, runs, 1, Varied::default())?;
    let [mut steps, mut whole] = [Duration::ZERO; 2];
    let mut ticks = 0;
    // One after the other, so that what else the machine does slows both.
    for run in 0..runs {
        let mut experiment = Experiment::new(&plan.case(run)?.scenario)?;
        let began = Instant::now();
        ticks += stepped(&mut experiment)?;
        steps += began.elapsed();
        let began = Instant::now();
        row(&plan.case(run)?)?;
        whole += began.elapsed();
    }
    let per_run = |time: Duration| time.as_secs_f64() / runs as f64;
    println!(
        "{what}: {:.2} µs a step; a run {:.2} ms, its steps alone {:.2} ms: {:.2} times; {:.0} runs a second and core",
        1e6 * steps.as_secs_f64() / ticks as f64,
        1e3 * per_run(whole),
        1e3 * per_run(steps),
        per_run(whole) / per_run(steps),
        1.0 / per_run(whole),
    );
    Ok(())
}

/// The run with nothing but what its controller needs. Returns how many steps it had.
fn stepped(experiment: &mut Experiment) -> Result<u64, Box<dyn Error>> {
    let rate_hz = experiment.controller.settings().rate_hz;
    let mut q = experiment.q0;
    for tick in 0..=experiment.last_tick {
        experiment.move_world(tick as f64 / rate_hz)?;
        if let Some(visits) = &mut experiment.waypoints {
            let pose = visits.pose(experiment.controller.kinematics_at(&q));
            visits.advance(&pose, &mut experiment.controller.setpoints())?;
        }
        q = experiment.controller.step(&q)?.q_ref;
    }
    Ok(experiment.last_tick + 1)
}
