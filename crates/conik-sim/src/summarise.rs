//! Puts the summary together, tick by tick.

use std::collections::BTreeMap;

use conik::{ActiveSet, Deviation, Goal, JointVec, Monitor, Reason, Stack};

use crate::cycle_times::CycleTimes;
use crate::experiment::Experiment;
use crate::monitors::Monitors;
use crate::record::Record;
use crate::run::Ended;
use crate::scenario::Border;
use crate::servo_delay::ServoDelay;
use crate::summary::{
    FORMAT, Landing, ModeChange, Outcome, Properties, Property, Settings, StepTime, StepWork,
    Summary, TaskSummary, Tracking,
};

/// Takes in the records of a run and, at its end, gives the summary.
#[derive(Clone, Debug)]
pub struct Summariser {
    task_names: Vec<String>,
    mode_order: conik::ModeOrder,
    modes: Vec<ModeChange>,
    reached: Vec<Option<f64>>,
    step_ns: Vec<u64>,
    last: Option<(f64, JointVec)>,
    tracking: Option<TrackingSum>,
    deadline_misses: u64,
    speed_limited_ticks: u64,
    no_mode_ticks: u64,
    landing: Landing,
    step_work_max: StepWork,
    held: Vec<Held>,
    last_active: ActiveSet,
}

/// How one set was held.
#[derive(Clone, Copy, Debug, Default)]
struct Held {
    times: u64,
    largest_crossing: f64,
}

#[derive(Clone, Debug)]
struct TrackingSum {
    max: JointVec,
    squares: JointVec,
    ticks: u64,
    delay: ServoDelay,
}

impl Summariser {
    /// A summary of a run of this stack with so many waypoints.
    pub fn new(stack: &Stack, waypoints: usize) -> Self {
        Self {
            task_names: stack
                .iter()
                .map(|(_, level)| level.name().to_owned())
                .collect(),
            mode_order: conik::ModeOrder::new(stack),
            modes: Vec::new(),
            reached: vec![None; waypoints],
            step_ns: Vec::new(),
            last: None,
            tracking: None,
            deadline_misses: 0,
            speed_limited_ticks: 0,
            no_mode_ticks: 0,
            landing: Landing::default(),
            step_work_max: StepWork::default(),
            held: vec![Held::default(); stack.len()],
            last_active: ActiveSet::EMPTY,
        }
    }

    /// Takes in one tick.
    pub fn take(&mut self, record: &Record) {
        if record.mode_changed {
            self.modes.push(ModeChange {
                t_s: record.t_s,
                mode: self.mode_order.number(&record.active),
                active: record
                    .active
                    .iter()
                    .map(|task| self.task_names[task.index()].clone())
                    .collect(),
            });
        }
        if let Some(reached) = record.reached.and_then(|index| self.reached.get_mut(index)) {
            *reached = Some(record.t_s);
        }
        self.step_ns.push(record.step_ns);
        self.last = Some((record.t_s, record.q));
        self.deadline_misses += record.missed_cycles;
        self.speed_limited_ticks += u64::from(record.speed_limited);
        self.no_mode_ticks += u64::from(record.no_mode);
        self.landing.add(record);
        self.step_work_max.raise(record);
        self.take_held(record);
        if let Some(measured) = record.q_measured {
            let still = JointVec::zeros(measured.len());
            self.tracking
                .get_or_insert_with(|| TrackingSum {
                    max: still,
                    squares: still,
                    ticks: 0,
                    delay: ServoDelay::new(measured.len()),
                })
                .add(&record.q, &measured);
        }
    }

    fn take_held(&mut self, record: &Record) {
        for task in record.active.iter() {
            let is_new = !self.last_active.contains(task);
            self.held[task.index()].times += u64::from(is_new);
        }
        self.last_active = record.active;
        for reason in &record.reasons {
            if let Reason::Holds { task, crossing, .. } = *reason {
                let held = &mut self.held[task.index()];
                held.largest_crossing = held.largest_crossing.max(crossing);
            }
        }
    }

    /// The mode that was chosen last.
    pub fn present_mode(&self) -> Option<&ModeChange> {
        self.modes.last()
    }

    /// What can be said of a run before its first tick.
    pub fn begun(experiment: &Experiment, settings: Settings, version: &str) -> Summary {
        let stack = experiment.controller.stack();
        Self::new(stack, experiment.waypoint_count()).summary(
            experiment,
            &Monitor::new(stack),
            Outcome::Running,
            settings,
            version,
        )
    }

    /// The summary of the run that has ended.
    pub fn finish(self, ended: &Ended, settings: Settings, version: &str) -> Summary {
        let mut summary = self.summary(
            &ended.experiment,
            &ended.monitor,
            ended.outcome.clone(),
            settings,
            version,
        );
        summary.monitors = Some(Monitors::of(ended));
        summary.cycles = ended.cycles.as_ref().and_then(CycleTimes::summary);
        summary
    }

    fn summary(
        self,
        experiment: &Experiment,
        monitor: &Monitor,
        outcome: Outcome,
        settings: Settings,
        version: &str,
    ) -> Summary {
        let ticked = self.last.is_some();
        let lands = settings.scenario.control.border == Border::Land;
        let (ended_at_s, final_q) = self.last.unwrap_or((0.0, experiment.q0));
        let seen = monitor.properties(experiment.controller.stack());
        Summary {
            format: FORMAT,
            version: version.to_owned(),
            settings,
            outcome,
            ended_at_s,
            monitors: None,
            tasks: self.tasks(experiment, monitor, ticked),
            properties: properties(&seen, experiment.controller.stack(), ticked),
            modes: self.modes,
            waypoints_reached_s: self.reached,
            final_q_rad: final_q.to_vec(),
            step_time_us: step_time(self.step_ns),
            deadline_misses: self.deadline_misses,
            cycles: None,
            tracking: self.tracking.map(|sum| sum.finish(experiment.period_s())),
            speed_limited_ticks: self.speed_limited_ticks,
            no_mode_ticks: self.no_mode_ticks,
            landing: lands.then_some(self.landing),
            step_work_max: self.step_work_max,
            changes: Vec::new(),
        }
    }

    /// What became of each task. A person may have put them into another order than that in which they are
    /// counted here.
    fn tasks(
        &self,
        experiment: &Experiment,
        monitor: &Monitor,
        ticked: bool,
    ) -> BTreeMap<String, TaskSummary> {
        let period = experiment.period_s();
        let stack = experiment.controller.stack();
        let held = |name: &str| {
            let place = self.task_names.iter().position(|task| task == name);
            place.map_or(Held::default(), |place| self.held[place])
        };
        stack
            .iter()
            .map(|(id, level)| {
                let history = monitor.history(id);
                let held = held(level.name());
                let is_set = matches!(level.goal(), Goal::Set { .. });
                let summary = TaskSummary {
                    min: history.min.is_finite().then_some(history.min),
                    max: history.max.is_finite().then_some(history.max),
                    worst_violation: is_set.then_some(history.worst_violation),
                    entered_set_s: history.entered_s,
                    final_error: (ticked && !is_set).then_some(history.final_error),
                    active_s: is_set.then_some(history.active_ticks as f64 * period),
                    held_times: is_set.then_some(held.times),
                    largest_crossing: is_set.then_some(held.largest_crossing),
                };
                (level.name().to_owned(), summary)
            })
            .collect()
    }
}

impl Landing {
    fn add(&mut self, record: &Record) {
        self.corrected_ticks += u64::from(record.landed.corrections > 0);
        self.halvings += record.landed.halvings as u64;
        self.stood_still_ticks += u64::from(record.landed.stood_still);
    }
}

impl StepWork {
    fn raise(&mut self, record: &Record) {
        self.landing_trials = self.landing_trials.max(record.landed.kinematics);
        self.pivots = self.pivots.max(record.pivots);
        self.modes = self.modes.max(record.modes_evaluated);
    }
}

impl TrackingSum {
    fn add(&mut self, reference: &JointVec, measured: &JointVec) {
        for i in 0..reference.len() {
            let error = measured[i] - reference[i];
            self.max[i] = self.max[i].max(error.abs());
            self.squares[i] += error * error;
        }
        self.ticks += 1;
        self.delay.add(reference, measured);
    }

    fn finish(self, period_s: f64) -> Tracking {
        let ticks = self.ticks as f64;
        let delayed = self.delay.found();
        Tracking {
            max_rad: self.max.to_vec(),
            rms_rad: self
                .squares
                .iter()
                .map(|sum| (sum / ticks).sqrt())
                .collect(),
            delay_s: delayed.as_ref().map(|found| found.ticks * period_s),
            delayed_max_rad: delayed.as_ref().map(|found| found.max.clone()),
            delayed_rms_rad: delayed.map(|found| found.rms),
        }
    }
}

/// Without a single tick nothing was shown to hold.
fn properties(properties: &conik::Properties, stack: &Stack, ticked: bool) -> Properties {
    let property = |deviation: &Deviation| Property {
        holds: ticked && deviation.holds(),
        worst: deviation.worst,
        at_s: deviation.at_s,
        task: deviation.task.map(|task| stack[task].name().to_owned()),
    };
    Properties {
        equality_converges: property(&properties.equality_converges),
        inside_stays: property(&properties.inside_stays),
        outside_never_worse: property(&properties.outside_never_worse),
        entered_stays: property(&properties.entered_stays),
        low_priority_excess: property(&properties.low_priority_excess),
    }
}

fn step_time(mut step_ns: Vec<u64>) -> StepTime {
    step_ns.sort_unstable();
    let at = |share: usize| {
        let index = step_ns.len().saturating_sub(1) * share / 100;
        step_ns.get(index).map_or(0.0, |&ns| ns as f64 / 1e3)
    };
    StepTime {
        median: at(50),
        p99: at(99),
        max: at(100),
    }
}
