//! Running a whole scenario on the ideal arm.

use std::collections::HashMap;
use std::hash::Hash;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use conik::{ActiveSet, ModeOrder, Reason};
use conik_sim::arm::IdealArm;
use conik_sim::columns::Columns;
use conik_sim::experiment::Experiment;
use conik_sim::record::Record;
use conik_sim::scenario::Scenario;
use conik_sim::summarise::Summariser;
use conik_sim::summary::{Settings, Summary};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::{described, refused};
use crate::scenario;

/// After so many ticks it is asked whether somebody wants the run to end.
const LOOK_EVERY: u64 = 5000;

/// The rows of a run, column by column.
struct Table {
    task_names: Vec<String>,
    mode_order: ModeOrder,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    active: Index<ActiveSet>,
    reasons: Index<Vec<String>>,
}

/// Which of few different things each row has.
struct Index<T> {
    rows: Vec<i64>,
    known: HashMap<T, i64>,
    different: Vec<T>,
}

impl<T: Clone + Eq + Hash> Index<T> {
    fn new() -> Self {
        Self {
            rows: Vec::new(),
            known: HashMap::new(),
            different: Vec::new(),
        }
    }

    fn take(&mut self, thing: T) {
        let next = i64::try_from(self.different.len()).unwrap_or(i64::MAX);
        let number = *self.known.entry(thing.clone()).or_insert(next);
        if number == next {
            self.different.push(thing);
        }
        self.rows.push(number);
    }
}

impl Table {
    fn new(experiment: &Experiment) -> Self {
        let stack = experiment.controller.stack();
        let mut names: Vec<String> = ["t_s", "mode", "waypoint"].map(str::to_owned).into();
        names.extend(Columns::new(stack).names(stack));
        names.extend(["tool_x_m", "tool_y_m", "tool_z_m"].map(str::to_owned));
        for (name, unit) in [("q", "_rad"), ("qd", "_rad_s"), ("qdd", "_rad_s2")] {
            names.extend((1..=stack.dof()).map(|joint| format!("{name}{joint}{unit}")));
        }
        Self {
            task_names: stack
                .iter()
                .map(|(_, level)| level.name().to_owned())
                .collect(),
            mode_order: ModeOrder::new(stack),
            columns: vec![Vec::new(); names.len()],
            names,
            active: Index::new(),
            reasons: Index::new(),
        }
    }

    /// Adds a row.
    fn take(&mut self, record: &Record) {
        let mode = self.mode_order.number(&record.active);
        let first = [
            record.t_s,
            mode.map_or(f64::NAN, |mode| mode as f64),
            record.waypoint as f64,
        ];
        let joints = [record.q, record.qd, record.qdd];
        let values = first
            .iter()
            .chain(&record.task_values)
            .copied()
            .chain(record.tool.to_array())
            .chain(joints.iter().flat_map(|joints| joints.iter().copied()));
        for (column, value) in self.columns.iter_mut().zip(values) {
            column.push(value);
        }
        self.active.take(record.active);
        let code = |reason: &Reason| {
            let mut code = reason.word().to_owned();
            if let Some(task) = reason.task() {
                code += &format!(":{}", self.task_names[task.index()]);
            }
            if let Some(joint) = reason.joint() {
                code += &format!(":q{}", joint + 1);
            }
            code
        };
        self.reasons.take(record.reasons.iter().map(code).collect());
    }

    /// Names of the sets of each mode that occurred.
    fn active_sets(&self) -> Vec<Vec<&str>> {
        let named = |active: &ActiveSet| {
            let tasks = active.iter();
            tasks
                .map(|task| self.task_names[task.index()].as_str())
                .collect()
        };
        self.active.different.iter().map(named).collect()
    }
}

/// Runs a scenario and returns its columns, its active sets, its reasons, its summary and its text.
#[pyfunction]
#[pyo3(signature = (*, path=None, tables=None))]
pub fn run<'py>(
    py: Python<'py>,
    path: Option<PathBuf>,
    tables: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let scenario = match (path, tables) {
        (Some(path), _) => scenario::of_file(&path)?,
        (None, Some(tables)) => scenario::of_tables(tables)?,
        (None, None) => scenario::of_tables(&PyDict::new(py))?,
    };
    let mut interrupted = Ok(());
    let done = py.detach(|| ran(&scenario, &mut interrupted));
    interrupted?;
    let (table, summary) = done?;
    let out = PyDict::new(py);
    out.set_item("active_sets", table.active_sets())?;
    out.set_item("active", PyArray1::from_vec(py, table.active.rows))?;
    out.set_item("why", PyArray1::from_vec(py, table.reasons.rows))?;
    out.set_item("reasons", table.reasons.different)?;
    let columns = PyDict::new(py);
    for (name, values) in table.names.iter().zip(table.columns) {
        columns.set_item(name, PyArray1::from_vec(py, values))?;
    }
    out.set_item("columns", columns)?;
    let summary = serde_json::to_string(&summary).map_err(refused)?;
    out.set_item("summary", summary)?;
    out.set_item("toml", scenario.to_toml())?;
    Ok(out)
}

/// Runs it on an ideal arm. What is asked for meanwhile, Ctrl-C for instance, ends the run.
fn ran(scenario: &Scenario, interrupted: &mut PyResult<()>) -> PyResult<(Table, Summary)> {
    let experiment = Experiment::new(scenario).map_err(described)?;
    let stack = experiment.controller.stack();
    let settings = Settings {
        robot: "ideal".to_owned(),
        scenario: scenario.clone(),
        joint_names: experiment.robot.joint_names().map(str::to_owned).collect(),
        units: stack
            .iter()
            .map(|(_, level)| (level.name().to_owned(), level.task().unit().to_owned()))
            .collect(),
    };
    let mut table = Table::new(&experiment);
    let mut summariser = Summariser::new(stack, experiment.waypoint_count());
    let mut arm = IdealArm::at(experiment.q0);
    let stop = AtomicBool::new(false);
    let mut sink = |record: Record| {
        if record.tick.is_multiple_of(LOOK_EVERY) {
            let looked = Python::attach(signalled);
            stop.store(looked.is_err(), Ordering::Relaxed);
            if looked.is_err() {
                *interrupted = looked;
            }
        }
        summariser.take(&record);
        table.take(&record);
        Ok(())
    };
    let ended = conik_sim::run::run(experiment, &mut arm, &mut sink, &stop);
    let summary = summariser.finish(&ended, settings, env!("CARGO_PKG_VERSION"));
    Ok((table, summary))
}

/// What the system has asked for in the meantime.
fn signalled(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}
