//! Campaigns: shards, wherever they are run, and what is made of them.

use std::num::NonZero;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

use conik_campaign::folder::Folder;
use conik_campaign::plan::{Plan, Starts, Varied};
use conik_campaign::tally::PROPERTIES;
use conik_campaign::work::Progress;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::{described, refused};
use crate::scenario;

/// Between two looks at whether somebody wants it to end.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// A plan as text.
#[pyfunction]
#[pyo3(signature = (
    *, path, tables, runs, seed, starts, near, obstacles, targets, rates_hz, servo_lag, control
))]
#[expect(clippy::too_many_arguments, reason = "one for each that Python has")]
pub fn campaign_plan(
    path: Option<PathBuf>,
    tables: Option<&Bound<'_, PyDict>>,
    runs: u64,
    seed: u64,
    starts: &str,
    near: f64,
    obstacles: f64,
    targets: f64,
    rates_hz: Vec<f64>,
    servo_lag: Option<[f64; 2]>,
    control: &Bound<'_, PyDict>,
) -> PyResult<String> {
    let scenario = match (path, tables) {
        (Some(path), _) => scenario::of_file(&path)?,
        (None, Some(tables)) => scenario::of_tables(tables)?,
        (None, None) => return Err(described("a campaign needs a scenario")),
    };
    let scenario = scenario::with_control(&scenario, control)?;
    let varied = Varied {
        starts: match starts {
            "anywhere" => Starts::Anywhere,
            "same" => Starts::Same,
            _ => Starts::Near(near),
        },
        obstacles_m: obstacles,
        targets_m: targets,
        rates_hz,
        servo_lag_s: servo_lag,
    };
    let plan = Plan::new(scenario, runs, seed, varied).map_err(described)?;
    serde_json::to_string(&plan).map_err(refused)
}

fn plan_of(text: &str) -> PyResult<Plan> {
    serde_json::from_str(text).map_err(refused)
}

/// The shards of a plan that are missing in its folder, which is begun if need be, how many there are, and how many
/// runs have been done.
#[pyfunction]
pub fn campaign_missing(dir: PathBuf, plan: &str) -> PyResult<(Vec<u64>, u64, u64)> {
    let folder = Folder::open(&dir, &plan_of(plan)?).map_err(refused)?;
    if folder.is_finished() {
        return Ok((Vec::new(), folder.plan().shards(), folder.plan().runs));
    }
    let missing = folder.missing();
    let plan = folder.plan();
    let open: u64 = missing.iter().map(|shard| runs(plan, *shard)).sum();
    Ok((missing, plan.shards(), plan.runs - open))
}

/// How many runs a shard has.
#[pyfunction]
pub fn campaign_runs(plan: &str, shard: u64) -> PyResult<u64> {
    Ok(runs(&plan_of(plan)?, shard))
}

fn runs(plan: &Plan, shard: u64) -> u64 {
    let runs = plan.runs_of(shard);
    runs.end - runs.start
}

/// Runs one shard: its rows as text.
#[pyfunction]
pub fn campaign_shard(py: Python<'_>, plan: &str, shard: u64) -> PyResult<String> {
    let plan = plan_of(plan)?;
    let lines = py.detach(|| plan.shard(shard, || true)).map_err(refused)?;
    Ok(lines.unwrap_or_default())
}

/// Keeps the rows of a shard in the folder.
#[pyfunction]
pub fn campaign_keep(dir: PathBuf, plan: &str, shard: u64, lines: &str) -> PyResult<()> {
    let folder = Folder::open(&dir, &plan_of(plan)?).map_err(refused)?;
    folder.keep(shard, lines).map_err(refused)
}

/// Runs what is missing on this machine; `show` is told now and then how many runs are done. Ctrl-C ends it.
#[pyfunction]
#[pyo3(signature = (dir, plan, jobs, show))]
pub fn campaign_work(
    py: Python<'_>,
    dir: PathBuf,
    plan: &str,
    jobs: Option<usize>,
    show: Py<PyAny>,
) -> PyResult<()> {
    let folder = Folder::open(&dir, &plan_of(plan)?).map_err(refused)?;
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    let jobs = jobs.unwrap_or_else(cores);
    let progress = Progress::default();
    let mut interrupted = Ok(());
    let done = py.detach(|| {
        thread::scope(|scope| {
            let work = scope.spawn(|| folder.work(jobs, &progress));
            while !work.is_finished() {
                thread::sleep(LOOK_EVERY);
                let looked = Python::attach(|py| {
                    py.check_signals()?;
                    show.call1(py, (progress.done.load(Ordering::Relaxed),))
                        .map(drop)
                });
                if let (Err(error), true) = (looked, interrupted.is_ok()) {
                    interrupted = Err(error);
                    progress.stop.store(true, Ordering::Relaxed);
                }
            }
            work.join()
        })
    });
    interrupted?;
    let done = done.map_err(|_| refused("a worker failed"))?;
    done.map(drop).map_err(refused)
}

/// Writes the table, the report and the worst cases, and returns what they come to.
#[pyfunction]
pub fn campaign_finish<'py>(
    py: Python<'py>,
    dir: PathBuf,
    plan: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let folder = Folder::open(&dir, &plan_of(plan)?).map_err(refused)?;
    let tally = py.detach(|| folder.finish()).map_err(refused)?;
    let out = PyDict::new(py);
    out.set_item("runs", tally.runs)?;
    let classes = PyDict::new(py);
    for (class, count) in &tally.classes {
        classes.set_item(class.name(), count)?;
    }
    out.set_item("classes", classes)?;
    let properties = PyDict::new(py);
    for (name, kept) in PROPERTIES.iter().zip(&tally.properties) {
        let property = PyDict::new(py);
        property.set_item("shown", kept.shown)?;
        property.set_item("kept", kept.kept)?;
        property.set_item("worst", kept.worst)?;
        property.set_item("bound", kept.bound())?;
        properties.set_item(name, property)?;
    }
    out.set_item("properties", properties)?;
    Ok(out)
}
