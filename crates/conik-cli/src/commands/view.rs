//! `conik view`: the page that shows a scenario while it runs, or replays runs.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use conik_cli::view::Recording;
use conik_cli::view::live::{Arm, Live};
use conik_cli::view::server::{Place, Server};
use conik_sim::arm::{ArmError, IdealArm};
use conik_sim::experiment::Experiment;
use conik_sim::live::Stretch;
use conik_sim::record::Record;
use conik_sim::run;
use conik_sim::scenario::Scenario;

use crate::arguments::ViewArguments;
use crate::failure::{Failure, with_causes};
use crate::watched::{Watched, cannot_listen, name};

/// Serves the page until Ctrl-C.
pub fn view(arguments: &ViewArguments) -> Result<ExitCode, Failure> {
    match arguments.paths.as_slice() {
        [scenario] if !scenario.is_dir() => watch(arguments, scenario),
        paths => match paths.iter().find(|path| path.is_file()) {
            Some(file) => Err(Failure::input(format!(
                "{} is a file; only folders that `conik run` wrote can be compared",
                file.display()
            ))),
            None => replay(arguments),
        },
    }
}

fn place(arguments: &ViewArguments) -> Place {
    Place {
        address: arguments.listen,
        port: arguments.port,
    }
}

/// Shows what was run.
fn replay(arguments: &ViewArguments) -> Result<ExitCode, Failure> {
    if arguments.overrides.is_any() {
        return Err(Failure::input(
            "what was run cannot be changed: options that override the scenario are for a scenario file",
        ));
    }
    let recording =
        Recording::load(&arguments.paths).map_err(|error| Failure::input(with_causes(&error)))?;
    let stop = super::run::stop_on_ctrl_c()?;
    let place = place(arguments);
    let server = Server::with_recording(place, &recording);
    let server = server.map_err(|error| cannot_listen(place, &error))?;
    drop(recording);
    super::print(&format!("{}\n", server.url()))?;
    say_that_it_stays(arguments)?;
    server
        .serve(&stop)
        .map_err(|error| Failure::run(format!("cannot serve the page: {error}")))?;
    Ok(ExitCode::SUCCESS)
}

fn say_that_it_stays(arguments: &ViewArguments) -> Result<(), Failure> {
    if !arguments.quiet {
        super::print("the page is there until Ctrl-C\n")?;
    }
    Ok(())
}

/// Runs a scenario with an ideal arm, from when somebody looks, without an end unless one is asked for.
fn watch(arguments: &ViewArguments, path: &Path) -> Result<ExitCode, Failure> {
    let mut scenario = Scenario::load(path)?;
    arguments.overrides.apply(&mut scenario)?;
    let arm = Arm::Simulated { has_clock: false };
    let live = Live::new(&name(path), &scenario, arm, "ideal").map_err(Failure::input)?;
    let stop = super::run::stop_on_ctrl_c()?;
    let watched = Watched::serve(live, place(arguments), &stop)?;
    say_that_it_stays(arguments)?;
    let has_end = arguments.overrides.duration_s.is_some();
    loop {
        run_once(&scenario, watched.live(), has_end, &stop)?;
        if !watched.live().helm().is_restarting() || stop.load(Ordering::Relaxed) {
            return watched.stay(Ok(ExitCode::SUCCESS), true, &stop);
        }
        scenario = watched.live().begin_anew().map_err(Failure::input)?;
    }
}

fn run_once(
    scenario: &Scenario,
    live: &Live,
    has_end: bool,
    stop: &Arc<AtomicBool>,
) -> Result<(), Failure> {
    let mut experiment = Experiment::changeable(scenario).map_err(Failure::input)?;
    if !has_end {
        experiment.last_tick = u64::MAX;
    }
    let mut arm = IdealArm::at(experiment.q0);
    let mut take = |record: Record| {
        live.take(&record);
        Ok::<(), ArmError>(())
    };
    let stretch = Stretch::first(experiment);
    let ended = run::run_steered(stretch, &mut arm, &mut take, stop, Some(live.helm()));
    if !live.helm().is_restarting() {
        live.end(ended.outcome);
    }
    Ok(())
}
