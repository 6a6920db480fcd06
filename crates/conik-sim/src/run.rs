//! The run loop: wait for the arm's cycle, decide, send, record.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use conik::{ActiveSet, Frame, JointVec, Monitor, Occurrence, Stack, Step, TaskId};

use crate::announced::Announcements;
use crate::arm::{Arm, ArmError, Feedback, Reference};
use crate::cycle_times::CycleTimes;
use crate::experiment::Experiment;
use crate::record::Record;
use crate::summary::Outcome;

/// How far a joint of the arm may be from the scenario's start [rad]. The run then begins where the
/// arm is; from further away it does not begin.
pub const START_TOLERANCE_RAD: f64 = 0.02;

/// Where the loop hands its records to. An error ends the run.
pub trait Sink {
    /// Takes one record. Must not block if the arm is a real one.
    fn take(&mut self, record: Record) -> Result<(), ArmError>;
}

impl<F: FnMut(Record) -> Result<(), ArmError>> Sink for F {
    fn take(&mut self, record: Record) -> Result<(), ArmError> {
        self(record)
    }
}

/// What is left when a run has ended.
#[derive(Debug)]
pub struct Ended {
    /// How it ended.
    pub outcome: Outcome,
    /// What the monitors saw.
    pub monitor: Monitor,
    /// Samples outside a set of which the tick before said nothing.
    pub unannounced: Occurrence,
    /// How the arm's cycles came and were answered; `None` where it has no clock of its own.
    pub cycles: Option<CycleTimes>,
    /// The experiment, in its last state.
    pub experiment: Experiment,
}

/// Runs an experiment on an arm until its end, a fault, or until `stop` is set. The arm is brought to
/// a stop in every case before this returns.
///
/// The loop is closed on the reference: `q` is the last reference and never a measurement (Fig. 2 of
/// the paper). The reference sent at tick k is q at t = k / rate, so that the first one is the pose
/// in which the arm already is.
pub fn run(
    mut experiment: Experiment,
    arm: &mut dyn Arm,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
) -> Ended {
    let stack = experiment.controller.stack();
    let mut watch = Watch {
        monitor: Monitor::new(stack),
        announcements: Announcements::new(stack),
    };
    let ended = drive(&mut experiment, &mut watch, arm, sink, stop);
    let stopped = arm.stop();
    let outcome = match ended.and_then(|completed| stopped.map(|()| completed)) {
        Ok(true) => Outcome::Completed,
        Ok(false) => Outcome::Interrupted,
        Err(fault) => Outcome::Fault {
            name: fault.name.to_owned(),
            detail: fault.detail,
        },
    };
    Ended {
        outcome,
        monitor: watch.monitor,
        unannounced: watch.announcements.unannounced(),
        cycles: arm.cycle_times().cloned(),
        experiment,
    }
}

/// Who looks on.
struct Watch {
    monitor: Monitor,
    announcements: Announcements,
}

impl Watch {
    fn observe(&mut self, stack: &Stack, step: &Step, t_s: f64) {
        self.monitor.observe(stack, step, t_s);
        self.announcements.observe(stack, step, t_s);
    }
}

/// `true` if the run went to its end, `false` if it was interrupted.
fn drive(
    experiment: &mut Experiment,
    watch: &mut Watch,
    arm: &mut dyn Arm,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
) -> Result<bool, ArmError> {
    let rate_hz = experiment.controller.settings().rate_hz;
    let present = arm.start(rate_hz)?;
    let mut q = begin_at(&present, &experiment.q0, experiment.from_here)?;
    let columns = Columns::new(experiment.controller.stack());
    experiment.controller.measure_on_demand();
    let mut last_active: Option<ActiveSet> = None;
    for tick in 0..=experiment.last_tick {
        if stop.load(Ordering::Relaxed) {
            return Ok(false);
        }
        let feedback = arm.next_cycle()?;
        let t_s = tick as f64 / rate_hz;
        experiment
            .move_world(t_s)
            .map_err(|error| ArmError::new("bad-target", error.to_string()))?;
        let mut record = decide(experiment, &columns, &q, &feedback)?;
        let step = experiment.controller.last_step();
        arm.send(&Reference {
            q,
            qd: step.qd,
            qdd: step.qdd,
        })?;
        watch.observe(experiment.controller.stack(), step, t_s);
        q = step.q_ref;

        record.tick = tick;
        record.t_s = t_s;
        record.mode_changed = last_active != Some(record.active);
        last_active = Some(record.active);
        sink.take(record)?;
    }
    Ok(true)
}

/// Where the run begins: in the arm's present pose, if that is the scenario's start or the run may begin
/// anywhere.
fn begin_at(present: &JointVec, q0: &JointVec, from_here: bool) -> Result<JointVec, ArmError> {
    if present.len() != q0.len() {
        return Err(ArmError::new(
            "wrong-arm",
            format!(
                "the arm has {} joints, the scenario's robot {}",
                present.len(),
                q0.len()
            ),
        ));
    }
    for (joint, (present, start)) in present.iter().zip(q0.iter()).enumerate() {
        let away = (present - start).abs();
        if !(from_here || away <= START_TOLERANCE_RAD) {
            return Err(ArmError::new(
                "start-away",
                format!(
                    "joint {} of the arm is at {present:.4} rad, the scenario starts at \
                     {start:.4} rad: move the arm there first (at most {START_TOLERANCE_RAD} rad \
                     away), begin where it stands with --from-here, or change the scenario's start",
                    joint + 1
                ),
            ));
        }
    }
    Ok(*present)
}

/// One step of the controller at q, and the record of it but for its place in the run.
fn decide(
    experiment: &mut Experiment,
    columns: &Columns,
    q: &JointVec,
    feedback: &Feedback,
) -> Result<Record, ArmError> {
    let controller = &mut experiment.controller;
    let kinematics = controller.kinematics_at(q);
    let tool = kinematics.world_from(Frame::Tool).origin;
    let (mut waypoint, mut reached) = (0, None);
    if let Some(waypoints) = &mut experiment.waypoints {
        let pose = waypoints.pose(kinematics);
        reached = waypoints
            .advance(&pose, &mut controller.setpoints())
            .map_err(|error| ArmError::new("bad-waypoint", error.to_string()))?;
        waypoint = waypoints.index();
    }
    let before = Instant::now();
    controller
        .step(q)
        .map_err(|error| ArmError::new("no-reference", error.to_string()))?;
    let step_ns = u64::try_from(before.elapsed().as_nanos()).unwrap_or(u64::MAX);
    // The log has all values, also those that the step had no need of.
    let step = controller.measure();
    Ok(Record {
        tick: 0,
        t_s: 0.0,
        active: step.active,
        mode_changed: false,
        waypoint,
        reached,
        task_values: columns.values(step),
        tool,
        q: *q,
        qd: step.qd,
        qdd: step.qdd,
        q_measured: feedback.q,
        reasons: step.reasons().to_vec(),
        speed_limited: step.speed_limit.is_some(),
        no_mode: step.no_mode,
        landed: step.landed,
        pivots: step.pivots,
        modes_evaluated: step.modes_evaluated,
        step_ns,
        missed_cycles: feedback.missed_cycles,
    })
}

/// Which numbers of the tasks stand in a record, in which order.
#[derive(Clone, Debug)]
pub struct Columns {
    scalars: Vec<TaskId>,
    equalities: Vec<TaskId>,
}

impl Columns {
    /// The columns of a stack: values of its scalar tasks, then errors of its equality tasks.
    pub fn new(stack: &Stack) -> Self {
        Self {
            scalars: stack
                .iter()
                .filter(|(_, level)| level.task().dimension() == 1)
                .map(|(id, _)| id)
                .collect(),
            equalities: stack
                .iter()
                .filter(|(_, level)| level.interval().is_none())
                .map(|(id, _)| id)
                .collect(),
        }
    }

    /// Names of the columns: `<task>`, then `<task>_error`.
    pub fn names(&self, stack: &Stack) -> Vec<String> {
        let values = self.scalars.iter().map(|&id| stack[id].name().to_owned());
        let errors = self
            .equalities
            .iter()
            .map(|&id| format!("{}_error", stack[id].name()));
        values.chain(errors).collect()
    }

    /// The value of a task of one component, as it stands in a record.
    pub fn value(&self, record: &Record, task: TaskId) -> Option<f64> {
        let index = self.scalars.iter().position(|&other| other == task)?;
        record.task_values.get(index).copied()
    }

    /// The norm of the error of an equality task, as it stands in a record.
    pub fn error(&self, record: &Record, task: TaskId) -> Option<f64> {
        record.task_values.get(self.error_index(task)?).copied()
    }

    fn error_index(&self, task: TaskId) -> Option<usize> {
        let index = self.equalities.iter().position(|&other| other == task)?;
        Some(self.scalars.len() + index)
    }

    fn values(&self, step: &Step) -> Vec<f64> {
        let values = self.scalars.iter().map(|&id| step.value(id)[0]);
        let errors = self.equalities.iter().map(|&id| step.error_norm(id));
        values.chain(errors).collect()
    }
}
