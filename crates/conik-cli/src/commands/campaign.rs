//! `conik campaign`: one scenario many times, and how often each property was kept.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

use conik_campaign::class::Class;
use conik_campaign::folder::Folder;
use conik_campaign::plan::{Plan, Starts, Varied};
use conik_campaign::report::grouped;
use conik_campaign::tally::{PROPERTIES_IN_WORDS, Tally};
use conik_campaign::work::Progress;
use conik_sim::scenario::Scenario;

use crate::arguments::{CampaignArguments, VariedArguments};
use crate::failure::Failure;
use crate::progress::Count;

/// Exit status of a command that Ctrl-C stopped.
const INTERRUPTED: u8 = 130;

/// Between two looks at how far it is.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// Runs the campaign, or goes on with it.
pub fn campaign(arguments: &CampaignArguments) -> Result<ExitCode, Failure> {
    let mut scenario = Scenario::load(&arguments.scenario)?;
    if arguments.overrides.is_any() {
        arguments.overrides.apply(&mut scenario)?;
    }
    let varied = varied(&arguments.varied)?;
    let plan = Plan::new(scenario, arguments.runs, arguments.seed, varied);
    let plan = plan.map_err(Failure::input)?;
    let out = out_dir(arguments);
    let folder = Folder::open(&out, &plan).map_err(Failure::input)?;
    if folder.is_finished() {
        if !arguments.quiet {
            let report = out.join("report.html");
            super::print(&format!("it is done already: {}\n", report.display()))?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let is_done = match &arguments.ray {
        Some(address) => on_ray(&out, address, arguments.quiet)?,
        None => here(&folder, arguments)?,
    };
    if !is_done {
        if !arguments.quiet {
            let open = folder.missing().len() as u64;
            let all = folder.plan().shards();
            super::print(&format!(
                "stopped: {} of {} shards are done; the same command goes on with the others\n",
                grouped(all - open),
                grouped(all),
            ))?;
        }
        return Ok(ExitCode::from(INTERRUPTED));
    }
    let tally = folder.finish().map_err(Failure::input)?;
    if !arguments.quiet {
        super::print(&summary(&tally, &out))?;
    }
    let of = |class: Class| tally.classes.get(&class).copied().unwrap_or(0);
    let in_doubt = of(Class::Unexplained) + of(Class::Fault);
    Ok(ExitCode::from(u8::from(in_doubt > 0)))
}

/// Runs what is missing on this machine. Returns whether all is done.
fn here(folder: &Folder, arguments: &CampaignArguments) -> Result<bool, Failure> {
    let stop = super::run::stop_on_ctrl_c()?;
    let jobs = match arguments.jobs {
        Some(jobs) => jobs.get(),
        None => thread::available_parallelism().map_or(1, std::num::NonZero::get),
    };
    let progress = Progress::default();
    let count = Count::new("runs", folder.plan().runs, arguments.quiet);
    let done = thread::scope(|scope| {
        let work = scope.spawn(|| folder.work(jobs, &progress));
        while !work.is_finished() {
            if stop.load(Ordering::Relaxed) {
                progress.stop.store(true, Ordering::Relaxed);
            }
            count.show(progress.done.load(Ordering::Relaxed));
            thread::sleep(LOOK_EVERY);
        }
        work.join()
    });
    count.finish();
    done.map_err(|_| Failure::run("a worker failed, see above"))?
        .map_err(Failure::input)
}

/// Has Python spread what is missing over a cluster. Returns whether all is done.
fn on_ray(out: &Path, address: &str, quiet: bool) -> Result<bool, Failure> {
    const NEEDS: &str = "--ray needs Python 3.10 or later with the packages `conik` and `ray`: \
        `pip install .` in a clone of conik, and `pip install ray`";
    let python = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let mut command = Command::new(&python);
    command
        .args(["-m", "conik.campaign"])
        .arg(out)
        .args(["--ray", address]);
    if quiet {
        command.arg("--quiet");
    }
    // Ctrl-C reaches it too, and it stops by itself.
    let _stop = super::run::stop_on_ctrl_c()?;
    let status = command.status().map_err(|error| {
        let python = python.to_string_lossy();
        Failure::input(format!("{NEEDS} ({python} cannot be started: {error})"))
    })?;
    match status.code() {
        Some(0) => Ok(true),
        Some(130) | None => Ok(false),
        Some(_) => Err(Failure::input(format!(
            "the cluster gave up, see above; {NEEDS}"
        ))),
    }
}

fn varied(arguments: &VariedArguments) -> Result<Varied, Failure> {
    let starts = match arguments.starts.as_str() {
        "same" => Starts::Same,
        "anywhere" => Starts::Anywhere,
        text => match text.parse::<f64>() {
            Ok(degrees) => Starts::Near(degrees.to_radians()),
            Err(_) => {
                return Err(Failure::input(format!(
                    "--starts: `{text}` is no place; give `anywhere`, `same`, or a number of degrees"
                )));
            }
        },
    };
    let servo_lag_s = match arguments.servo_lag_s[..] {
        [] => None,
        [lag] => Some([lag, lag]),
        [least, most] => Some([least, most]),
        _ => {
            return Err(Failure::input(
                "--servo-lag-s: give the least and the greatest lag, as 0.03,0.2",
            ));
        }
    };
    Ok(Varied {
        starts,
        obstacles_m: arguments.obstacles_m,
        targets_m: arguments.targets_m,
        rates_hz: arguments.rates_hz.clone(),
        servo_lag_s,
    })
}

fn out_dir(arguments: &CampaignArguments) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| {
        let stem = arguments.scenario.file_stem().unwrap_or_default();
        let name = format!("{}-campaign", stem.to_string_lossy());
        Path::new("out").join(name)
    })
}

/// The last words.
fn summary(tally: &Tally, out: &Path) -> String {
    let mut text = format!("{} runs\n", grouped(tally.runs));
    for (words, kept) in PROPERTIES_IN_WORDS.iter().zip(&tally.properties) {
        if kept.shown > 0 {
            text += &format!(
                "  {words}: {} of {} (95 %: broken in less than {:.3} %), worst {:.2e}\n",
                grouped(kept.kept),
                grouped(kept.shown),
                100.0 * kept.bound(),
                kept.worst,
            );
        }
    }
    for (class, count) in &tally.classes {
        text += &format!(
            "  {:>9} {}: {}\n",
            grouped(*count),
            class.name(),
            class.in_words()
        );
    }
    text + &format!("report: {}\n", out.join("report.html").display())
}
