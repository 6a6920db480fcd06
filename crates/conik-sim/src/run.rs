//! The run loop: wait for the arm's cycle, decide, send, record.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use conik::{ActiveSet, Frame, JointVec, Monitor, Occurrence, StackError, Step};

use crate::arm::{Arm, ArmError, Feedback, Reference};
use crate::cycle_times::CycleTimes;
use crate::experiment::Experiment;
use crate::live::{Helm, Pace, Stretch, Turn};
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
    experiment: Experiment,
    arm: &mut dyn Arm,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
) -> Ended {
    run_steered(Stretch::first(experiment), arm, sink, stop, None)
}

/// The same, paused and changed by whoever is at `helm`. What is left has the numbers of the tasks in the last
/// stretch of the run, records those in the first one.
pub fn run_steered(
    mut stretch: Stretch,
    arm: &mut dyn Arm,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
    helm: Option<&Helm>,
) -> Ended {
    let ended = drive(&mut stretch, arm, sink, stop, helm);
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
        monitor: stretch.monitor,
        unannounced: stretch.announcements.unannounced(),
        cycles: arm.cycle_times().cloned(),
        experiment: stretch.experiment,
    }
}

/// `true` if the run went to its end, `false` if it was interrupted.
fn drive(
    stretch: &mut Stretch,
    arm: &mut dyn Arm,
    sink: &mut dyn Sink,
    stop: &AtomicBool,
    helm: Option<&Helm>,
) -> Result<bool, ArmError> {
    let rate_hz = stretch.experiment.controller.settings().rate_hz;
    let present = arm.start(rate_hz)?;
    let experiment = &stretch.experiment;
    let mut way = Way::at(&begin_at(&present, &experiment.q0, experiment.from_here)?);
    let mut pace = Pace::new(helm, arm.is_real_time(), experiment.period_s());
    let mut last_active: Option<ActiveSet> = None;
    let (mut tick, mut missed_cycles) = (0, 0);
    loop {
        if !pace.wait(stop) {
            return Ok(false);
        }
        let feedback = arm.next_cycle()?;
        missed_cycles += feedback.missed_cycles;
        if let Turn::Between { share, speed } = pace.turn() {
            arm.send(&way.reference(share, speed))?;
            continue;
        }
        let t_s = tick as f64 / rate_hz;
        let bad_target = |error: StackError| ArmError::new("bad-target", error.to_string());
        if let Some(helm) = helm {
            helm.take_up(stretch, |next, present| next.take_over(present, t_s))
                .map_err(bad_target)?;
        }
        let gliding = stretch.gliding();
        stretch.experiment.move_world(t_s).map_err(bad_target)?;
        let q = way.to;
        let mut record = decide(stretch, &q, &feedback)?;
        let step = stretch.experiment.controller.last_step();
        arm.send(&Reference {
            q,
            qd: step.qd,
            qdd: step.qdd,
        })?;
        way = Way {
            from: q,
            to: step.q_ref,
            qd: step.qd,
        };
        stretch.observe(t_s);

        record.tick = tick;
        record.t_s = t_s;
        record.missed_cycles = std::mem::take(&mut missed_cycles);
        record.mode_changed = last_active != Some(record.active);
        last_active = Some(record.active);
        record.revision = helm.map_or(0, Helm::revision);
        record.gliding = gliding;
        sink.take(record)?;
        if tick >= stretch.experiment.last_tick {
            return Ok(true);
        }
        tick += 1;
    }
}

/// The way of one period, from a sample to the next [rad].
#[derive(Clone, Copy, Debug)]
struct Way {
    from: JointVec,
    to: JointVec,
    qd: JointVec,
}

impl Way {
    /// Standing still.
    fn at(q: &JointVec) -> Self {
        Self {
            from: *q,
            to: *q,
            qd: JointVec::zeros(q.len()),
        }
    }

    /// Where to be after a `share` of it, with time going at `speed`.
    fn reference(&self, share: f64, speed: f64) -> Reference {
        let mut reference = Reference {
            q: self.from,
            qd: self.qd,
            qdd: JointVec::zeros(self.qd.len()),
        };
        for (q, (from, to)) in reference
            .q
            .iter_mut()
            .zip(self.from.iter().zip(self.to.iter()))
        {
            *q = from + share * (to - from);
        }
        for qd in reference.qd.iter_mut() {
            *qd *= speed;
        }
        reference
    }
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
fn decide(stretch: &mut Stretch, q: &JointVec, feedback: &Feedback) -> Result<Record, ArmError> {
    let experiment = &mut stretch.experiment;
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
    controller.measure();
    let step = stretch.experiment.controller.last_step();
    Ok(Record {
        tick: 0,
        t_s: 0.0,
        active: stretch.active(step),
        mode_changed: false,
        waypoint,
        reached,
        task_values: stretch.values(step),
        tool,
        q: *q,
        qd: step.qd,
        qdd: step.qdd,
        q_measured: feedback.q,
        reasons: stretch.reasons(step),
        speed_limited: step.speed_limit.is_some(),
        no_mode: step.no_mode,
        landed: step.landed,
        pivots: step.pivots,
        modes_evaluated: step.modes_evaluated,
        step_ns,
        missed_cycles: 0,
        revision: 0,
        gliding: Vec::new(),
    })
}

impl Stretch {
    /// Lets the monitors see the tick that was decided last, at `t_s` [s].
    fn observe(&mut self, t_s: f64) {
        let controller = &self.experiment.controller;
        let (stack, step): (_, &Step) = (controller.stack(), controller.last_step());
        self.monitor.observe(stack, step, t_s);
        self.announcements.observe(stack, step, t_s);
    }
}
