//! A finished run as the figures see it: its log, its summary, and when which mode was in force.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use conik::{Joint, JointKind};
use conik_sim::log::{Log, LogError};
use conik_sim::scenario::{GoalConfig, TaskConfig};
use conik_sim::summary::{ModeChange, Outcome, Summary};

use super::palette;

/// More stretches of one mode than this cannot be told apart in a picture.
const MOST_SPANS: usize = 400;

/// Bytes of the largest summary that is read: over a million changes of mode.
const LARGEST_SUMMARY: u64 = 1 << 28;

/// What a run folder holds.
#[derive(Clone, Debug)]
pub struct Run {
    log: Arc<Log>,
    summary: Arc<Summary>,
    until_s: f64,
    tasks: Vec<TaskConfig>,
    modes: Vec<Mode>,
    spans: Vec<Span>,
    joints_that_slide: Joints,
}

/// Sets that were active together at some time of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// 1-based number in the mode order; `None` where it would not fit 64 bits.
    pub number: Option<u64>,
    /// Names of the active sets, none for the mode in which every set is inactive.
    pub active: Vec<String>,
    /// Its colour in all figures of the run.
    pub colour: &'static str,
}

impl Mode {
    /// The active sets as people write them.
    pub fn label(&self) -> String {
        if self.active.is_empty() {
            "no set active".to_owned()
        } else {
            self.active.join(" + ")
        }
    }

    fn since(&self, span: &Span) -> ModeChange {
        ModeChange {
            t_s: span.from_s,
            mode: self.number,
            active: self.active.clone(),
        }
    }
}

/// A stretch of time in one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Its beginning [s].
    pub from_s: f64,
    /// Its end [s].
    pub to_s: f64,
    /// Index into [`Run::modes`].
    pub mode: usize,
}

impl Run {
    /// Reads `log.csv` and `summary.json` in the folder `dir`.
    pub fn load(dir: &Path) -> Result<Self, RunError> {
        // Accelerations and measurements appear in no figure.
        Self::load_columns(dir, |name| {
            !name.ends_with("_rad_s2") && !name.ends_with("_measured_rad")
        })
    }

    /// As [`Run::load`], with those columns of the log that `keep` names.
    pub fn load_columns(dir: &Path, keep: impl Fn(&str) -> bool) -> Result<Self, RunError> {
        let summary = load_summary(dir)?;
        let path = dir.join("log.csv");
        let log = Log::load_columns(&path, keep)?;
        if log.is_empty() {
            return Err(RunError::NoRows { path });
        }
        Ok(Self::new(log, summary))
    }

    /// A run from its log and its summary.
    pub fn new(log: Log, mut summary: Summary) -> Self {
        let modes = modes_of(&log);
        let spans = spans_of(&log);
        if summary.outcome == Outcome::Running {
            // Written before the first tick: the log knows more.
            summary.ended_at_s = log.time_s().last().copied().unwrap_or(0.0);
            summary.modes = spans
                .iter()
                .map(|span| modes[span.mode].since(span))
                .collect();
        }
        Self {
            tasks: summary.settings.scenario.all_tasks(),
            joints_that_slide: joints_that_slide(&summary),
            until_s: summary.ended_at_s,
            log: Arc::new(log),
            summary: Arc::new(summary),
            modes,
            spans,
        }
    }

    /// The same run as it looked at that time [s]: the path so far, and what moves where it was then.
    #[must_use]
    pub fn until(&self, t_s: f64) -> Self {
        Self {
            until_s: t_s,
            ..self.clone()
        }
    }

    /// The time that the scene is shown at [s]: the end of the run, but for [`Run::until`].
    pub fn until_s(&self) -> f64 {
        self.until_s
    }

    /// Whether it is shown up to its end.
    pub fn is_whole(&self) -> bool {
        self.until_s >= self.summary.ended_at_s
    }

    /// The log.
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// The summary.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }

    /// The tasks, the most important first; those of the joints' position limits among them.
    pub fn tasks(&self) -> &[TaskConfig] {
        &self.tasks
    }

    /// Unit of the joints' positions, or with `"/s"` of their velocities: `rad/s`, or of which what.
    pub fn joint_unit(&self, per: &str) -> String {
        match self.joints_that_slide {
            Joints::None => format!("rad{per}"),
            Joints::All => format!("m{per}"),
            Joints::Some => format!("rad{per}, of sliding joints m{per}"),
        }
    }

    /// The modes that occurred, in order of first appearance.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// When which mode was in force, in order of time.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// Time of the first and of the last row [s], at least a moment apart.
    pub fn period_s(&self) -> (f64, f64) {
        let (from, to) = super::axis::range(self.log.time_s().iter().copied());
        (from, if to > from { to } else { from + 1.0 })
    }

    /// The value of the task of that name over time, if it is scalar and was logged.
    pub fn value(&self, task: &str) -> Option<&[f64]> {
        self.log.column(task)
    }

    /// The norm of the error of the equality task of that name over time.
    pub fn error(&self, task: &str) -> Option<&[f64]> {
        self.log.column(&format!("{task}_error"))
    }

    /// When the set of that name was active, and in which mode; as [`Run::drawable_spans`].
    pub fn active_spans(&self, set: &str) -> Vec<Span> {
        let holds = |mode: &Mode| mode.active.iter().any(|name| name == set);
        let mut spans = self.drawable_spans();
        spans.retain(|span| holds(&self.modes[span.mode]));
        spans
    }

    /// Whether the mode changed too often for a picture to show each change.
    pub fn flickers(&self) -> bool {
        self.spans.len() > MOST_SPANS
    }

    /// [`Run::spans`]; of a flickering run, for each mode the short whiles in which it occurred,
    /// which then overlap those of other modes.
    pub fn drawable_spans(&self) -> Vec<Span> {
        if !self.flickers() {
            return self.spans.clone();
        }
        let (begin, end) = self.period_s();
        let while_s = (end - begin) / MOST_SPANS as f64;
        // For each mode its whiles so far; a span that begins within or right after the last of
        // them prolongs it.
        let mut whiles: Vec<Vec<Span>> = vec![Vec::new(); self.modes.len()];
        for &span in &self.spans {
            match whiles[span.mode].last_mut() {
                Some(last) if span.from_s - last.to_s < while_s => last.to_s = span.to_s,
                _ => whiles[span.mode].push(span),
            }
        }
        whiles.concat()
    }

    /// Whether nobody wrote how the run ended: only the log tells of it.
    pub fn was_cut_off(&self) -> bool {
        self.summary.outcome == Outcome::Running
    }

    /// A word on how the run ended, if it ended before its time and is shown up to there.
    pub fn early_end(&self) -> Option<String> {
        if !self.is_whole() {
            return None;
        }
        match &self.summary.outcome {
            Outcome::Completed => None,
            Outcome::Running => Some("cut off".to_owned()),
            Outcome::Interrupted => Some("interrupted".to_owned()),
            Outcome::Fault { name, .. } => Some(format!("fault: {name}")),
        }
    }

    /// What the run is called.
    pub fn title(&self) -> &str {
        self.summary
            .settings
            .scenario
            .title
            .as_deref()
            .unwrap_or("Run of Conik")
    }
}

/// Which of a robot's joints.
#[derive(Clone, Copy, Debug)]
enum Joints {
    None,
    Some,
    All,
}

fn joints_that_slide(summary: &Summary) -> Joints {
    let robot = summary.settings.scenario.robot.described();
    let slides = |joint: &Joint| joint.kind == JointKind::Prismatic;
    match robot {
        Ok(robot) if robot.joints().iter().all(slides) => Joints::All,
        Ok(robot) if robot.joints().iter().any(slides) => Joints::Some,
        _ => Joints::None,
    }
}

/// Whether the task is set-based.
pub fn is_set(task: &TaskConfig) -> bool {
    matches!(task.goal, GoalConfig::Set { .. })
}

/// Reads `summary.json` in the folder `dir`.
pub fn load_summary(dir: &Path) -> Result<Summary, RunError> {
    let path = dir.join("summary.json");
    match File::open(&path) {
        Ok(file) => read_summary(file, LARGEST_SUMMARY, path),
        Err(source) => Err(RunError::Read { path, source }),
    }
}

/// Reads no more than what a summary may have, so that an endless file has an end.
fn read_summary(source: impl Read, largest: u64, path: PathBuf) -> Result<Summary, RunError> {
    let mut text = BufReader::new(source.take(largest));
    match serde_json::from_reader(&mut text) {
        Ok(summary) => Ok(summary),
        Err(_) if text.get_ref().limit() == 0 => Err(RunError::Large { path, largest }),
        Err(source) if source.is_io() => Err(RunError::Read {
            path,
            source: source.into(),
        }),
        Err(source) => Err(RunError::Summary { path, source }),
    }
}

fn modes_of(log: &Log) -> Vec<Mode> {
    let mut modes: Vec<Mode> = log
        .active_sets()
        .iter()
        .map(|active| Mode {
            number: None,
            active: active.clone(),
            colour: palette::INK,
        })
        .collect();
    let mut seen = vec![false; modes.len()];
    let mut left = seen.len();
    for (&id, &number) in log.active().iter().zip(log.mode()) {
        let at = id as usize;
        if !seen[at] {
            seen[at] = true;
            modes[at].number = number;
            left -= 1;
            if left == 0 {
                break;
            }
        }
    }
    for (nth, mode) in modes
        .iter_mut()
        .filter(|mode| !mode.active.is_empty())
        .enumerate()
    {
        mode.colour = palette::mode(nth);
    }
    modes
}

fn spans_of(log: &Log) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    for (&t_s, &id) in log.time_s().iter().zip(log.active()) {
        if let Some(last) = spans.last_mut() {
            last.to_s = t_s;
            if last.mode == id as usize {
                continue;
            }
        }
        spans.push(Span {
            from_s: t_s,
            to_s: t_s,
            mode: id as usize,
        });
    }
    spans
}

/// Why a run folder could not be read.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The summary cannot be read.
    #[error("{}: cannot be read; is this the folder of a run?", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// The summary is not one.
    #[error("{}: not a summary of this version's format", path.display())]
    Summary {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        source: serde_json::Error,
    },
    /// The summary is larger than any.
    #[error("{}: larger than {largest} bytes; is this the folder of a run?", path.display())]
    Large {
        /// The file.
        path: PathBuf,
        /// What is read at most.
        largest: u64,
    },
    /// The log cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The log has a header only.
    #[error("{}: has no rows, so there is nothing to show", path.display())]
    NoRows {
        /// The file.
        path: PathBuf,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endless_summary_has_an_end() {
        let error = read_summary(io::repeat(b' '), 9999, "summary.json".into()).unwrap_err();
        assert!(error.to_string().contains("summary.json: larger than"));
    }
}
