//! `conik run`: the main job. Drives an arm through a scenario and writes what became of it.
//!
//! The loop that drives the arm has a thread of its own and hands its records over a bounded channel;
//! the log, the summary and the progress line are made here and never hold it up.

mod arm;
mod drive;
mod folder;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use conik_cli::report;
use conik_cli::tui::{self, Tui, Warnings};
use conik_cli::view::live::Live;
use conik_sim::experiment::Experiment;
use conik_sim::live::Stretch;
use conik_sim::log::LogWriter;
use conik_sim::scenario::Scenario;
use conik_sim::summarise::Summariser;
use conik_sim::summary::{Outcome, Settings};

use crate::arguments::RunArguments;
use crate::explain::Explanations;
use crate::failure::{Failure, with_causes};
use crate::present;
use crate::progress::Progress;
use crate::watched::Watched;

pub use arm::Driven;
use drive::{Finished, Listeners};
use folder::{cannot_log, clear, make_folder, out_dir, write_summary};

/// Exit status of a run that a person stopped, as shells have it for Ctrl-C.
const INTERRUPTED: u8 = 130;

/// Runs the scenario and, if it is to be watched, shows it until Ctrl-C.
pub fn run(arguments: &RunArguments) -> Result<ExitCode, Failure> {
    if arguments.tui {
        Tui::check().map_err(Failure::input)?;
    }
    let mut scenario = Scenario::load(&arguments.scenario)?;
    arguments.overrides.apply(&mut scenario)?;
    let stop = stop_on_ctrl_c()?;
    let mut watched = None;
    loop {
        let done = run_once(arguments, &scenario, &mut watched, &stop);
        let Some(page) = watched.take() else {
            return done;
        };
        if !page.live().helm().is_restarting() || stop.load(Ordering::Relaxed) {
            return page.stay(done, arguments.quiet, &stop);
        }
        scenario = page.live().begin_anew().map_err(Failure::input)?;
        watched = Some(page);
    }
}

/// One run, from the start of the scenario. Who watches is asked in when everything is ready.
fn run_once(
    arguments: &RunArguments,
    scenario: &Scenario,
    watched: &mut Option<Watched>,
    stop: &Arc<AtomicBool>,
) -> Result<ExitCode, Failure> {
    let experiment = if arguments.watch.view {
        Experiment::changeable(scenario)
    } else {
        Experiment::new(scenario)
    };
    let mut experiment = experiment.map_err(Failure::input)?;
    experiment.from_here = arguments.from_here;
    let explanations = Explanations::new(&arguments.explain, &experiment)?;
    let warnings = Warnings::default();
    let mut driven = arm::arm(arguments, scenario, &experiment, &warnings)?;
    let out = out_dir(arguments);
    make_folder(&out)?;
    let log = LogWriter::create(&out.join("log.csv"), experiment.controller.stack())
        .map_err(cannot_log)?;
    clear(&out)?;
    let settings = settings(scenario, &experiment, &arguments.robot);
    let begun = Summariser::begun(&experiment, settings.clone(), env!("CARGO_PKG_VERSION"));
    write_summary(&out, &begun).map_err(Failure::input)?;
    if watched.is_none() && arguments.watch.view {
        *watched = Some(Watched::run(arguments, scenario, &driven, stop)?);
    }
    let live = watched.as_ref().map(Watched::live);
    if !arguments.quiet {
        super::print(&present::heading(scenario, &driven.arm.describe()))?;
    }
    let tui = if arguments.tui {
        let scene = tui::Scene::new(scenario, &experiment, &driven.arm.describe());
        Some(Tui::start(scene, warnings.clone(), stop).map_err(Failure::input)?)
    } else {
        None
    };
    let listeners = Listeners {
        log,
        summariser: Summariser::new(experiment.controller.stack(), experiment.waypoint_count()),
        explanations,
        progress: Progress::new(&experiment, arguments.quiet || arguments.tui),
        live,
        tui: tui.as_ref(),
    };
    let urgently = driven
        .is_outside
        .then_some(!arguments.quiet && !arguments.tui);
    let stretch = Stretch::first(experiment);
    let finished = drive::drive(stretch, driven.arm.as_mut(), listeners, urgently, stop);
    drop(driven);
    if live.is_some_and(|live| live.helm().is_restarting()) && !stop.load(Ordering::Relaxed) {
        return Ok(ExitCode::SUCCESS);
    }
    let shown = tui.map(|tui| (tui, warnings));
    finish(arguments, &out, settings, finished, live, shown)
}

/// A flag that Ctrl-C sets.
pub fn stop_on_ctrl_c() -> Result<Arc<AtomicBool>, Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::run(format!("cannot listen for Ctrl-C: {error}")))?;
    Ok(stop)
}

fn settings(scenario: &Scenario, experiment: &Experiment, robot: &str) -> Settings {
    let stack = experiment.controller.stack();
    Settings {
        robot: robot.to_owned(),
        scenario: scenario.clone(),
        joint_names: experiment.robot.joint_names().map(str::to_owned).collect(),
        units: stack
            .iter()
            .map(|(_, level)| (level.name().to_owned(), level.task().unit().to_owned()))
            .collect(),
    }
}

/// Summary, report, the last words and the exit status.
fn finish(
    arguments: &RunArguments,
    out: &Path,
    settings: Settings,
    finished: Finished,
    live: Option<&Live>,
    shown: Option<(Tui, Warnings)>,
) -> Result<ExitCode, Failure> {
    let Finished {
        ended,
        summariser,
        explanations,
        written,
        _log,
    } = finished;
    let mut summary = summariser.finish(&ended, settings, env!("CARGO_PKG_VERSION"));
    if let Some(live) = live {
        summary.changes = live.changes();
    }
    let mut errors = summary.faults();
    let drawable = written.is_ok() && !summary.modes.is_empty();
    if let Err(error) = written {
        errors.push(error.to_string());
        if !matches!(summary.outcome, Outcome::Fault { .. }) {
            summary.outcome = Outcome::Fault {
                name: "log-failed".to_owned(),
                detail: error.to_string(),
            };
        }
    }
    if let Some(live) = live {
        live.end(summary.outcome.clone());
    }
    if let Err(error) = write_summary(out, &summary) {
        errors.push(error);
    }
    let mut last_words = present::summary(&summary, &ended.experiment);
    // Where there is no row, or not every row could be written, there is nothing right to draw.
    if drawable {
        match report::write(out) {
            Ok(path) => last_words += &format!("report: {}\n", path.display()),
            Err(error) => errors.push(with_causes(&error)),
        }
    }
    if let Some((mut tui, warnings)) = shown {
        if !tui.stay(&summary.outcome) {
            // Nobody reads what would be printed, nor what went wrong: the summary has it.
            return Ok(status(&summary.outcome, &errors));
        }
        for warning in warnings.all() {
            super::warn(&warning);
        }
    }
    if arguments.quiet {
        last_words.clear();
    }
    super::print(&(last_words + &explanations.in_words(&ended.experiment)))?;
    if !errors.is_empty() {
        return Err(Failure::run(errors.join("\nerror: ")));
    }
    Ok(status(&summary.outcome, &errors))
}

/// The exit status of a run that ended so, with these errors.
fn status(outcome: &Outcome, errors: &[String]) -> ExitCode {
    match outcome {
        _ if !errors.is_empty() => ExitCode::FAILURE,
        Outcome::Interrupted => ExitCode::from(INTERRUPTED),
        Outcome::Completed | Outcome::Fault { .. } | Outcome::Running => ExitCode::SUCCESS,
    }
}
