//! `conik run`: the main job. Drives an arm through a scenario and writes what became of it.
//!
//! The loop that drives the arm has a thread of its own and hands its records over a bounded channel;
//! the log, the summary and the progress line are made here and never hold it up.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, SyncSender, TrySendError};
use std::thread;

use conik_cli::report;
use conik_sim::arm::{Arm, ArmError, IdealArm};
use conik_sim::experiment::Experiment;
use conik_sim::log::{LogWriteError, LogWriter};
use conik_sim::record::Record;
use conik_sim::run::{self, Ended};
use conik_sim::scenario::{Scenario, UrModel};
use conik_sim::summarise::Summariser;
use conik_sim::summary::{Outcome, Settings, Summary};
use conik_ur::driver::recover::power_on;
use conik_ur::driver::{UrArm, UrConfig};
use conik_ur::emulator::{Emulator, EmulatorConfig, EmulatorError, Pace};
use conik_ur::realtime::Realtime;

use crate::arguments::RunArguments;
use crate::explain::Explanations;
use crate::failure::{Failure, with_causes};
use crate::layout::wrapped;
use crate::present;
use crate::progress::Progress;

/// Records that may wait for the log: eight seconds at 500 Hz.
const RECORDS_WAITING: usize = 4096;

/// Names of what stands beside the log.
const SUMMARY: &str = "summary.json";
const REPORT: &str = "report.html";

/// Exit status of a run that a person stopped, as shells have it for Ctrl-C.
const INTERRUPTED: u8 = 130;

/// Runs the scenario.
pub fn run(arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let mut scenario = Scenario::load(&arguments.scenario)?;
    arguments.overrides.apply(&mut scenario)?;
    let mut experiment = Experiment::new(&scenario).map_err(Failure::input)?;
    experiment.from_here = arguments.from_here;
    let explanations = Explanations::new(&arguments.explain, &experiment)?;
    let stop = stop_on_ctrl_c()?;
    let mut driven = arm(arguments, &scenario, &experiment)?;
    let out = out_dir(arguments);
    make_folder(&out)?;
    let log = LogWriter::create(&out.join("log.csv"), experiment.controller.stack())
        .map_err(cannot_log)?;
    clear(&out)?;
    let settings = settings(&scenario, &experiment, &arguments.robot);
    let begun = Summariser::begun(&experiment, settings.clone(), env!("CARGO_PKG_VERSION"));
    write_summary(&out, &begun).map_err(Failure::input)?;
    if !arguments.quiet {
        super::print(&present::heading(&scenario, &driven.arm.describe()))?;
    }
    let progress = Progress::new(&experiment, arguments.quiet);
    let listeners = Listeners {
        log,
        summariser: Summariser::new(experiment.controller.stack(), experiment.waypoint_count()),
        explanations,
        progress,
    };
    let urgently = driven.is_outside.then_some(!arguments.quiet);
    let finished = drive(experiment, driven.arm.as_mut(), listeners, urgently, &stop);
    drop(driven);
    finish(arguments, &out, settings, finished)
}

/// A flag that Ctrl-C sets.
pub fn stop_on_ctrl_c() -> Result<Arc<AtomicBool>, Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::run(format!("cannot listen for Ctrl-C: {error}")))?;
    Ok(stop)
}

fn out_dir(arguments: &RunArguments) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| {
        let name = arguments.scenario.file_stem().unwrap_or("run".as_ref());
        Path::new("out").join(name)
    })
}

fn make_folder(out: &Path) -> Result<(), Failure> {
    fs::create_dir_all(out).map_err(|error| {
        Failure::input(if out.exists() && !out.is_dir() {
            format!(
                "{} is not a folder; give another one with --out",
                out.display()
            )
        } else {
            format!(
                "cannot make the folder {}: {error}; give another one with --out",
                out.display()
            )
        })
    })
}

fn cannot_log(error: LogWriteError) -> Failure {
    match error {
        LogWriteError::Busy { .. } => {
            Failure::input(format!("{error}; give another folder with --out"))
        }
        LogWriteError::Io { .. } => Failure::input(error),
    }
}

/// Takes away what would tell of an earlier run beside this run's log.
fn clear(out: &Path) -> Result<(), Failure> {
    for name in [SUMMARY, REPORT] {
        let path = out.join(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(Failure::input(format!(
                    "cannot replace {}: {error}",
                    path.display()
                )));
            }
            _ => {}
        }
    }
    Ok(())
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

/// An arm, and what must live as long as it.
struct Driven {
    arm: Box<dyn Arm + Send>,
    /// Whether it may be one that moves, outside of this program.
    is_outside: bool,
    /// Ends when the arm has let go of it.
    _emulator: Option<Emulator>,
}

fn arm(
    arguments: &RunArguments,
    scenario: &Scenario,
    experiment: &Experiment,
) -> Result<Driven, Failure> {
    let rate_hz = scenario.control.rate_hz;
    if arguments.robot != "ideal" {
        super::ur_robot::refuse_others(&arguments.robot, scenario, &experiment.robot)?;
    }
    let (arm, emulator): (Box<dyn Arm + Send>, _) = match arguments.robot.as_str() {
        arm @ ("ideal" | "emulator") if arguments.from_here => {
            return Err(Failure::input(format!(
                "--from-here: the arm of --robot {arm} stands at the scenario's start; it is for \
                 --robot HOST"
            )));
        }
        "ideal" if arguments.dry_run => {
            return Err(Failure::input(
                "--dry-run: there is nothing to send to an ideal arm; it is for --robot HOST",
            ));
        }
        "ideal" => (Box::new(IdealArm::at(experiment.q0)), None),
        "emulator" => {
            let model = experiment.robot.name();
            let emulator = Emulator::start(EmulatorConfig {
                pace: if arguments.fast {
                    Pace::Lockstep
                } else {
                    Pace::WallTime
                },
                ..EmulatorConfig::for_robot(model, rate_hz, experiment.q0)
            })
            .map_err(|error| match error {
                EmulatorError::JointCount(joints) => Failure::input(format!(
                    "the emulator is a UR controller, whose arms have six joints, and {model} has \
                     {joints}: run it with --robot ideal"
                )),
                EmulatorError::BadSetting { .. } => Failure::input(format!(
                    "{error}; another `rate_hz` or --rate-hz, or --robot ideal, would do"
                )),
                error => Failure::input(error),
            })?;
            let mut config = emulator.driver_config();
            if let Some(settings) = &scenario.ur {
                config.apply(settings);
                // It is whatever the scenario needs.
                (config.series, config.model) = (None, None);
            }
            config.dry_run = arguments.dry_run;
            (Box::new(UrArm::new(config)), Some(emulator))
        }
        host => {
            let named = scenario.ur.as_ref().and_then(|ur| ur.host.as_deref());
            let host = if host == "ur" {
                named.ok_or_else(|| {
                    Failure::input(
                        "--robot ur: the scenario's [ur] names no `host`; add it, or give the \
                         host to --robot",
                    )
                })?
            } else {
                host
            };
            if arguments.fast {
                return Err(Failure::input(format!(
                    "--fast: the controller at {host} keeps its own time; --fast is for \
                     --robot emulator"
                )));
            }
            let mut config = UrConfig::new(host);
            if let Some(settings) = &scenario.ur {
                config.apply(settings);
            }
            config.robot = UrModel::in_name(experiment.robot.name());
            config.dry_run = arguments.dry_run;
            config.check_host().map_err(Failure::input)?;
            config
                .offset_ports(arguments.port_offset)
                .map_err(Failure::input)?;
            if arguments.power_on {
                power_on(&config, &mut super::recover::say).map_err(Failure::run)?;
            }
            (Box::new(UrArm::new(config).warning(super::warn)), None)
        }
    };
    Ok(Driven {
        arm,
        is_outside: emulator.is_none() && arguments.robot != "ideal",
        _emulator: emulator,
    })
}

/// Who takes in the records of a run.
struct Listeners {
    log: LogWriter,
    summariser: Summariser,
    explanations: Explanations,
    progress: Progress,
}

/// A run that has ended, and what was made of its records.
struct Finished {
    ended: Ended,
    summariser: Summariser,
    explanations: Explanations,
    written: Result<(), LogWriteError>,
    /// Keeps other runs out of the folder until the report is there.
    _log: LogWriter,
}

/// Drives the arm in a thread of its own; `urgently` asks for real-time priority, and says whether
/// to print what was granted.
fn drive(
    experiment: Experiment,
    arm: &mut (dyn Arm + Send),
    listeners: Listeners,
    urgently: Option<bool>,
    stop: &AtomicBool,
) -> Finished {
    let Listeners {
        mut log,
        mut summariser,
        mut explanations,
        mut progress,
    } = listeners;
    let (sender, records) = mpsc::sync_channel(RECORDS_WAITING);
    let mut written = Ok(());
    let ended = thread::scope(|scope| {
        let driver = scope.spawn(move || {
            let real_time = arm.is_real_time();
            if let Some(print) = urgently {
                let granted = Realtime::enter();
                if print {
                    // Nobody reading is no reason not to drive.
                    let _ = super::print(&wrapped("", &format!("driving with {granted}")));
                }
            }
            run::run(
                experiment,
                arm,
                &mut |record| hand_over(&sender, record, real_time),
                stop,
            )
        });
        for record in records {
            if written.is_ok() {
                written = log.write(&record);
                if written.is_err() {
                    stop.store(true, Ordering::Relaxed);
                }
            }
            summariser.take(&record);
            explanations.take(&record);
            progress.show(&record, summariser.present_mode());
        }
        match driver.join() {
            Ok(ended) => ended,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    progress.finish();
    Finished {
        ended,
        summariser,
        explanations,
        written: written.and_then(|()| log.finish()),
        _log: log,
    }
}

/// Hands a record to the log. An arm that moves on its own is never kept waiting.
fn hand_over(sender: &SyncSender<Record>, record: Record, real_time: bool) -> Result<(), ArmError> {
    let closed = || ArmError::new("log-closed", "the log takes no more records");
    if !real_time {
        return sender.send(record).map_err(|_| closed());
    }
    sender.try_send(record).map_err(|error| match error {
        TrySendError::Full(_) => ArmError::new(
            "log-overrun",
            format!("the log fell {RECORDS_WAITING} records behind: is the disk too slow?"),
        ),
        TrySendError::Disconnected(_) => closed(),
    })
}

/// Summary, report, the last words and the exit status.
fn finish(
    arguments: &RunArguments,
    out: &Path,
    settings: Settings,
    finished: Finished,
) -> Result<ExitCode, Failure> {
    let Finished {
        ended,
        summariser,
        explanations,
        written,
        _log,
    } = finished;
    let mut summary = summariser.finish(&ended, settings, env!("CARGO_PKG_VERSION"));
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
    if arguments.quiet {
        last_words.clear();
    }
    super::print(&(last_words + &explanations.in_words(&ended.experiment)))?;
    if !errors.is_empty() {
        return Err(Failure::run(errors.join("\nerror: ")));
    }
    Ok(match summary.outcome {
        Outcome::Interrupted => ExitCode::from(INTERRUPTED),
        Outcome::Completed | Outcome::Fault { .. } | Outcome::Running => ExitCode::SUCCESS,
    })
}

/// Writes the summary in one go: whoever is killed meanwhile leaves the one before.
fn write_summary(out: &Path, summary: &Summary) -> Result<(), String> {
    let path = out.join(SUMMARY);
    let part = out.join("summary.json.part");
    serde_json::to_string_pretty(summary)
        .map_err(io::Error::from)
        .and_then(|text| fs::write(&part, text + "\n"))
        .and_then(|()| fs::rename(&part, &path))
        .map_err(|error| {
            // What is left of it says nothing; if it cannot go either, that changes nothing.
            let _ = fs::remove_file(&part);
            format!("cannot write {}: {error}", path.display())
        })
}
