//! What was seen in a run besides the five properties: `monitors` in `summary.json`.

use conik::{Observations, Occurrence};
use serde::{Deserialize, Serialize};

use crate::experiment::Experiment;
use crate::joint_limits::LIMIT;
use crate::run::Ended;

/// What was seen in a run besides the five properties.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Monitors {
    /// A level had fewer directions than its task has components; `worst`: how many fewer.
    pub rank_lost: Sighting,
    /// A frozen high-priority set moved; `worst`: how fast [task's unit/s]. Watched with border
    /// `freeze` only: `land` moves a held set on purpose.
    pub frozen_moves: Sighting,
    /// A set strictly inside was frozen; `worst`: how far inside [task's unit].
    pub frozen_inside: Sighting,
    /// The arm stood still with a set at its border and an equality task not reached: a local
    /// minimum; `worst`: the error left [task's unit].
    pub stuck: Sighting,
    /// A set was announced to be left; `worst`: by how much [task's unit]. Watched with border `land`.
    pub went_outside: Sighting,
    /// A set was left without that; `worst`: by how much [task's unit]. Watched with border `land`.
    pub unannounced: Sighting,
    /// No velocity was found that lands inside every set, so that the arm stood still. Watched with
    /// border `land`.
    pub stood_still: Sighting,
    /// The mode changed; `worst`: how often within one second.
    pub mode_changes: Sighting,
    /// What each joint's limits did, base to tool.
    pub joints: Vec<JointMonitor>,
}

/// What one monitor saw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sighting {
    /// In a word.
    pub verdict: Verdict,
    /// In how many ticks.
    pub ticks: u64,
    /// For how long [s].
    pub for_s: f64,
    /// How much of it in the worst of them.
    pub worst: f64,
    /// When the worst was [s].
    pub at_s: Option<f64>,
    /// Which task it was about then.
    pub task: Option<String>,
}

/// What a monitor says in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It looked, and there was nothing.
    Never,
    /// There was something.
    Seen,
    /// It makes no sense under these settings.
    NotWatched,
}

/// What the limits of one joint did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointMonitor {
    /// Name of the joint.
    pub joint: String,
    /// How long its position limits were held [s].
    pub position_limited_s: f64,
    /// How long the velocity was shortened for its speed limit [s].
    pub speed_limited_s: f64,
    /// How long the change of velocity was shortened for its acceleration limit [s].
    pub acceleration_limited_s: f64,
    /// A set made it accelerate beyond its limit; `worst`: by which factor.
    pub acceleration_exceeded: Sighting,
    /// Greatest speed, either way [rad/s or m/s].
    pub fastest: f64,
    /// Greatest acceleration, either way [rad/s² or m/s²].
    pub hardest: f64,
}

impl Monitors {
    /// What was seen in a run that has ended.
    pub fn of(ended: &Ended) -> Self {
        let experiment = &ended.experiment;
        let seen = ended.monitor.observations();
        let lands = experiment.controller.settings().border == conik::Border::Land;
        let sighting = |occurrence: &Occurrence, watched| sighting(experiment, occurrence, watched);
        Self {
            rank_lost: sighting(&seen.rank_lost, true),
            frozen_moves: sighting(&seen.frozen_moves, !lands),
            frozen_inside: sighting(&seen.frozen_inside, true),
            stuck: sighting(&seen.stuck, true),
            went_outside: sighting(&seen.went_outside, lands),
            unannounced: sighting(&ended.unannounced, lands),
            stood_still: sighting(&seen.stood_still, lands),
            mode_changes: sighting(&seen.mode_changes, true),
            joints: joints(ended, seen),
        }
    }
}

impl Sighting {
    /// Whether there was something.
    pub fn is_seen(&self) -> bool {
        self.verdict == Verdict::Seen
    }
}

impl JointMonitor {
    /// Whether any of the joint's limits bound.
    pub fn was_limited(&self) -> bool {
        let bound = [
            self.position_limited_s,
            self.speed_limited_s,
            self.acceleration_limited_s,
        ];
        bound.iter().any(|&time| time > 0.0) || self.acceleration_exceeded.is_seen()
    }
}

fn sighting(experiment: &Experiment, occurrence: &Occurrence, is_watched: bool) -> Sighting {
    let verdict = match (is_watched, occurrence.ticks) {
        (false, _) => Verdict::NotWatched,
        (true, 0) => Verdict::Never,
        (true, _) => Verdict::Seen,
    };
    let stack = experiment.controller.stack();
    let seen = if is_watched {
        *occurrence
    } else {
        Occurrence::default()
    };
    Sighting {
        verdict,
        ticks: seen.ticks,
        for_s: seen.ticks as f64 * experiment.period_s(),
        worst: seen.worst,
        at_s: seen.at_s,
        task: seen.task.map(|task| stack[task].name().to_owned()),
    }
}

fn joints(ended: &Ended, seen: &Observations) -> Vec<JointMonitor> {
    let experiment = &ended.experiment;
    let time = |ticks: u64| ticks as f64 * experiment.period_s();
    let names = experiment.robot.joint_names();
    let joints = names.zip(&seen.joints).map(|(name, history)| {
        let limit = experiment
            .controller
            .stack()
            .find(&format!("{LIMIT}{name}"));
        let held = limit.map_or(0, |limit| ended.monitor.history(limit).active_ticks);
        JointMonitor {
            joint: name.to_owned(),
            position_limited_s: time(held),
            speed_limited_s: time(history.speed_limited_ticks),
            acceleration_limited_s: time(history.acceleration_limited_ticks),
            acceleration_exceeded: sighting(experiment, &history.acceleration_exceeded, true),
            fastest: history.fastest,
            hardest: history.hardest,
        }
    });
    joints.collect()
}
