//! The run that is exported: its summary, the robot and the tasks, and the rows of its log.

use std::fs;
use std::path::{Path, PathBuf};

use conik::Robot;
use conik_sim::experiment::Experiment;
use conik_sim::log::LogRows;
use conik_sim::scenario::TaskConfig;
use conik_sim::summary::Summary;

use super::error::ExportError;
use crate::figure::RunError;
use crate::figure::run::load_summary;

/// A run folder. Its log is read row by row, as often as need be.
#[derive(Debug)]
pub struct Source {
    /// Its name, for whoever looks for the run.
    pub name: String,
    /// What the run amounts to.
    pub summary: Summary,
    /// The same as it stands in its file.
    pub summary_text: String,
    /// The robot that was driven.
    pub robot: Robot,
    /// Its tasks in decreasing priority.
    pub tasks: Vec<SourceTask>,
    log: PathBuf,
    bytes: u64,
}

/// A task, and which columns of the log are its.
#[derive(Clone, Debug)]
pub struct SourceTask {
    /// What it measures and what is asked of it.
    pub config: TaskConfig,
    /// Unit of its value and its error.
    pub unit: &'static str,
}

impl SourceTask {
    /// The column of the norm of its error, if it is an equality task.
    pub fn error_column(&self) -> String {
        format!("{}_error", self.config.name)
    }
}

/// Who is told how much is done, a share of 1; the answer is whether to go on.
pub type Watch<'a> = &'a mut dyn FnMut(f64) -> bool;

impl Source {
    /// The run in the folder `dir`.
    pub fn open(dir: &Path) -> Result<Self, ExportError> {
        let summary = load_summary(dir)?;
        let path = dir.join("summary.json");
        let summary_text =
            fs::read_to_string(&path).map_err(|source| RunError::Read { path, source })?;
        let scenario = &summary.settings.scenario;
        let experiment = Experiment::new(scenario).map_err(|source| ExportError::Scenario {
            dir: dir.to_owned(),
            source: Box::new(source),
        })?;
        let stack = experiment.controller.stack();
        let levels = stack.iter().zip(scenario.all_tasks());
        let tasks = levels.map(|((_, level), config)| SourceTask {
            unit: level.task().unit(),
            config,
        });
        let tasks = tasks.collect();
        let name = dir.canonicalize().unwrap_or(dir.to_owned());
        let name = name.file_name().unwrap_or(dir.as_os_str());
        let log = dir.join("log.csv");
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            robot: experiment.robot,
            tasks,
            bytes: fs::metadata(&log).map_or(0, |file| file.len()),
            log,
            summary,
            summary_text,
        })
    }

    /// The rows of the log, of which the columns are read that `keep` names.
    pub fn rows(&self, keep: impl Fn(&str) -> bool) -> Result<LogRows, ExportError> {
        Ok(LogRows::open(&self.log, keep)?)
    }

    /// What is wrong with a log of a header only.
    pub fn no_rows(&self) -> ExportError {
        let path = self.log.clone();
        RunError::NoRows { path }.into()
    }

    /// How much of the log was read, a share of 1.
    pub fn share(&self, rows: &LogRows) -> f64 {
        rows.bytes_read() as f64 / self.bytes.max(1) as f64
    }

    /// Places of the columns `<stem>1<unit>`, ... of all joints among the columns that are read.
    pub fn joint_columns(
        &self,
        rows: &LogRows,
        stem: &str,
        unit: &str,
    ) -> Result<Vec<usize>, ExportError> {
        let joints = self.robot.dof();
        let place = |joint: usize| {
            let column = format!("{stem}{joint}{unit}");
            place(rows, &column).ok_or_else(|| ExportError::NoColumn {
                path: self.log.clone(),
                column,
                joints,
            })
        };
        (1..=joints).map(place).collect()
    }
}

/// Place of a column among those that are read.
pub fn place(rows: &LogRows, column: &str) -> Option<usize> {
    rows.names().iter().position(|name| name == column)
}
