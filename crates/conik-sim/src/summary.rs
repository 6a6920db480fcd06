//! What a run amounts to: `summary.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::cycle_times::CycleSummary;
use crate::live::{Change, ChangeError};
use crate::monitors::Monitors;
use crate::scenario::Scenario;

/// Version of the layout of `summary.json` and `log.csv`.
pub const FORMAT: u32 = 1;

/// What a run amounts to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// [`FORMAT`].
    pub format: u32,
    /// Version of the program.
    pub version: String,
    /// The settings in force: the scenario after defaults and command-line overrides.
    pub settings: Settings,
    /// How the run ended.
    pub outcome: Outcome,
    /// Time of the last row of the log [s].
    pub ended_at_s: f64,
    /// The mode at t = 0 and every change of it.
    pub modes: Vec<ModeChange>,
    /// What became of each task, by name.
    pub tasks: BTreeMap<String, TaskSummary>,
    /// When each waypoint was reached [s], the last one's included; `None` if never.
    pub waypoints_reached_s: Vec<Option<f64>>,
    /// The five properties of Section VI of the paper.
    pub properties: Properties,
    /// Joint references at the last row [rad].
    pub final_q_rad: Vec<f64>,
    /// Time of the controller's step alone [µs].
    pub step_time_us: StepTime,
    /// Cycles of the arm's clock that went by without a reference.
    pub deadline_misses: u64,
    /// How the arm's cycles came and were answered; `None` where it has no clock of its own.
    #[serde(default)]
    pub cycles: Option<CycleSummary>,
    /// How closely the arm followed; `None` where nothing measures.
    pub tracking: Option<Tracking>,
    /// Ticks in which the speed limit of a joint scaled the velocity down.
    pub speed_limited_ticks: u64,
    /// Ticks in which no mode kept every set, so that the arm stood still.
    pub no_mode_ticks: u64,
    /// What it took to land inside the sets; `None` with border `freeze`, which does not.
    #[serde(default)]
    pub landing: Option<Landing>,
    /// What was seen besides the properties; `None` while the run goes on.
    #[serde(default)]
    pub monitors: Option<Monitors>,
    /// The most work of one step.
    #[serde(default)]
    pub step_work_max: StepWork,
    /// What people changed while the run went on; `settings` has the scenario from before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub changes: Vec<ChangeMade>,
}

/// A change of the scenario while the run went on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChangeMade {
    /// The first tick for which it held [s]; `None`: it was not in force yet.
    pub t_s: Option<f64>,
    /// What was changed; nothing where all changes were taken back.
    pub changes: Vec<Change>,
}

impl ChangeMade {
    /// The scenario in force after each of these, which were made one after the other, and since when [s];
    /// `first` is that from before.
    ///
    /// # Errors
    ///
    /// If one of them does not fit what was there.
    pub fn scenarios(
        changes: &[Self],
        first: &Scenario,
    ) -> Result<Vec<(f64, Scenario)>, ChangeError> {
        let mut scenarios: Vec<(f64, Scenario)> = Vec::new();
        for Self { t_s, changes } in changes {
            let from_s = t_s.unwrap_or_default();
            let present = scenarios.last().map_or(first, |(_, scenario)| scenario);
            let changed = match changes.as_slice() {
                [] => first.clone(),
                changes => present.changed(changes, from_s)?.0,
            };
            scenarios.push((from_s, changed));
        }
        Ok(scenarios)
    }

    /// These changes.
    pub fn of(changes: Vec<Change>) -> Self {
        Self { t_s: None, changes }
    }

    /// The scenario became again what it was before anybody changed it.
    pub fn all_taken_back() -> Self {
        Self::of(Vec::new())
    }
}

/// The settings in force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The arm that was driven: `ideal`, `emulator`, or a host.
    pub robot: String,
    /// The scenario after defaults and overrides.
    pub scenario: Scenario,
    /// Names of the joints, base to tool.
    pub joint_names: Vec<String>,
    /// Unit of each scalar task's value, by name: `m`, `rad`, `-`.
    pub units: BTreeMap<String, String>,
}

/// How the run ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Outcome {
    /// It has not, or nobody was left to say how: what is written at the start of every run.
    Running,
    /// The whole duration was run.
    Completed,
    /// A person stopped it.
    Interrupted,
    /// A fault stopped it.
    Fault {
        /// The fault's short name.
        name: String,
        /// What happened.
        detail: String,
    },
}

/// From this time on, these set-based tasks are active.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeChange {
    /// Since when [s].
    pub t_s: f64,
    /// 1-based number in the mode order; `None` where it would not fit 64 bits.
    pub mode: Option<u64>,
    /// Names of the active set-based tasks, in list order.
    pub active: Vec<String>,
}

/// What became of one task.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TaskSummary {
    /// Least value seen; `None` for a task of more than one dimension.
    pub min: Option<f64>,
    /// Greatest value seen; `None` for a task of more than one dimension.
    pub max: Option<f64>,
    /// Furthest outside its set [task's unit], 0 if never outside; `None` for an equality task.
    pub worst_violation: Option<f64>,
    /// First time inside its set [s]; `None` if never, or for an equality task.
    pub entered_set_s: Option<f64>,
    /// Norm of the error at the end; `None` for a set-based task, or without a single tick.
    pub final_error: Option<f64>,
    /// For how long it was active [s]; `None` for an equality task.
    pub active_s: Option<f64>,
    /// How often it became active; `None` for an equality task.
    #[serde(default)]
    pub held_times: Option<u64>,
    /// How much further out it would have been at the end of a period, let go, at most [task's unit];
    /// `None` for an equality task.
    #[serde(default)]
    pub largest_crossing: Option<f64>,
}

/// The five properties that the paper's Section VI confirms.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Properties {
    /// 1: all equality tasks converge to their desired value.
    pub equality_converges: Property,
    /// 2: high-priority sets that hold at the start hold for ever.
    pub inside_stays: Property,
    /// 3: high-priority sets that do not hold at the start freeze or come closer.
    pub outside_never_worse: Property,
    /// 4: once entered, they stay.
    pub entered_stays: Property,
    /// 5: low-priority sets may be left; how far.
    pub low_priority_excess: Property,
}

/// One property: kept or not, and its worst moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Property {
    /// `worst` is at most 1e-6 in the task's unit, and there was a tick that could show it.
    pub holds: bool,
    /// The largest deviation from the property [task's unit].
    pub worst: f64,
    /// When that was [s].
    pub at_s: Option<f64>,
    /// Which task it was.
    pub task: Option<String>,
}

/// Time of the controller's step alone [µs].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepTime {
    /// Half of the steps took less.
    pub median: f64,
    /// 99 % of the steps took less.
    pub p99: f64,
    /// The slowest.
    pub max: f64,
}

/// What it took, over the whole run, that every sample lies inside the sets entered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Landing {
    /// Ticks in which the velocity was corrected, because a set would have been left by what is not
    /// linear in one period's motion.
    pub corrected_ticks: u64,
    /// How often the velocity was halved, because corrections did not do.
    pub halvings: u64,
    /// Ticks in which the arm stood still, because halving did not do either.
    pub stood_still_ticks: u64,
}

/// The most work of one step, each figure by itself. What bounds them stands at
/// [`Controller`](conik::Controller).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StepWork {
    /// Configurations tried in order to land; 0 with border `freeze`.
    pub landing_trials: usize,
    /// Pivots of the quadratic programs: those of rule `cone` and those of border `land`.
    pub pivots: usize,
    /// Modes of which the velocity was computed, by the rules `paper` and `border`.
    pub modes: usize,
}

/// How closely the arm followed its reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tracking {
    /// Largest |q_measured − q_ref| of each joint [rad].
    pub max_rad: Vec<f64>,
    /// Root mean square of q_measured − q_ref of each joint [rad].
    pub rms_rad: Vec<f64>,
    /// How far the arm ran behind its reference [s]: the lag at which both agree best; `None` where
    /// it moved too little or too short to tell.
    #[serde(default)]
    pub delay_s: Option<f64>,
    /// Largest error of each joint once the delay is taken out, to an eighth of a tick [rad]; `None`
    /// where there is no delay.
    #[serde(default)]
    pub delayed_max_rad: Option<Vec<f64>>,
    /// Root mean square of the same [rad].
    #[serde(default)]
    pub delayed_rms_rad: Option<Vec<f64>>,
}
