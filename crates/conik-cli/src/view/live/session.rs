//! One run that goes on: what it is about, what has happened, what is asked of it.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use conik_sim::experiment::{Experiment, ExperimentError};
use conik_sim::live::Helm;
use conik_sim::record::Record;
use conik_sim::scenario::Scenario;
use conik_sim::summary::{ChangeMade, Outcome};
use tokio::sync::broadcast;
use tokio_tungstenite::tungstenite::Utf8Bytes;

use super::allowed::Allowed;
use super::history::History;
use super::message::{Glide, LiveScene, LiveTicks, Stage, State, Told, json};
use super::step_times::StepTimes;
use crate::view::{MOST_ROWS, Recording, Scene, Ticks};

/// Bundles that may wait for a client: two seconds' worth. One that is further behind is cut off.
const BUNDLES_WAITING: usize = 64;

/// How long the state may go untold.
const TELL_STATE_EVERY: Duration = Duration::from_secs(1);

/// Which arm is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arm {
    /// One that exists in this program only.
    Simulated {
        /// Whether it has a clock of its own, so that it cannot go faster than that.
        has_clock: bool,
    },
    /// Any other.
    Outside {
        /// Whether those who watch may change what it does.
        may_edit: bool,
    },
}

/// A run that goes on, for all who watch it.
#[derive(Debug)]
pub struct Live {
    /// Where the loop is told what to do.
    pub(super) helm: Helm,
    pub(super) arm: Arm,
    /// Name of the scenario, and of the arm.
    pub(super) name: String,
    pub(super) arm_name: String,
    viewers: AtomicUsize,
    session: Mutex<Session>,
    bundles: broadcast::Sender<Utf8Bytes>,
}

/// What is known of the run.
#[derive(Debug)]
pub(super) struct Session {
    /// As it was read, as the run began, and as it is now.
    pub(super) original: Scenario,
    pub(super) first: Scenario,
    pub(super) present: Scenario,
    pub(super) revision: u64,
    /// How often the run was begun anew.
    pub(super) restarts: u64,
    pub(super) scene: Scene,
    pub(super) from_s: f64,
    /// By what name to tell of each task that glides.
    gliding_names: Vec<String>,
    history: History,
    is_to_reset: bool,
    steps: StepTimes,
    deadline_misses: u64,
    pub(super) t_s: f64,
    pub(super) outcome: Option<Outcome>,
    pub(super) made: Vec<(u64, ChangeMade)>,
    told: Option<(Instant, State)>,
}

impl Live {
    /// A run of this scenario, which has not begun. `name` is the scenario's, `arm_name` as in the summary.
    pub fn new(
        name: &str,
        scenario: &Scenario,
        arm: Arm,
        arm_name: &str,
    ) -> Result<Self, ExperimentError> {
        let may_change = arm != Arm::Outside { may_edit: false };
        let scene = Scene::live(scenario, arm_name, may_change)?;
        let experiment = Experiment::new(scenario)?;
        let (bundles, _) = broadcast::channel(BUNDLES_WAITING);
        Ok(Self {
            helm: match arm {
                Arm::Simulated { .. } => Helm::of_simulated(),
                Arm::Outside { .. } => Helm::of_outside(),
            },
            arm,
            name: name.to_owned(),
            arm_name: arm_name.to_owned(),
            viewers: AtomicUsize::new(0),
            session: Mutex::new(Session {
                original: scenario.clone(),
                first: scenario.clone(),
                present: scenario.clone(),
                revision: 0,
                restarts: 0,
                scene,
                from_s: 0.0,
                gliding_names: gliding_names(scenario),
                history: History::of(&experiment, MOST_ROWS),
                is_to_reset: false,
                steps: StepTimes::default(),
                deadline_misses: 0,
                t_s: 0.0,
                outcome: None,
                made: Vec::new(),
                told: None,
            }),
            bundles,
        })
    }

    /// Where the loop is told what to do.
    pub fn helm(&self) -> &Helm {
        &self.helm
    }

    /// Takes in a tick.
    pub fn take(&self, record: &Record) {
        let session = &mut *self.session();
        session.t_s = record.t_s;
        session.deadline_misses += record.missed_cycles;
        session.steps.add(record.step_ns);
        session.is_to_reset |= session.history.take(record);
        let unseen = session.made.iter_mut().rev();
        for (revision, made) in unseen.take_while(|(_, made)| made.t_s.is_none()) {
            if *revision <= record.revision {
                made.t_s = Some(record.t_s);
            }
        }
    }

    /// The run has ended.
    pub fn end(&self, outcome: Outcome) {
        self.helm.end();
        self.session().outcome = Some(outcome);
    }

    /// The changes that were in force at some time.
    pub fn changes(&self) -> Vec<ChangeMade> {
        let session = self.session();
        let made = session.made.iter().map(|(_, made)| made);
        made.filter(|made| made.t_s.is_some()).cloned().collect()
    }

    /// Another run begins, by the scenario as it is now, which is returned.
    ///
    /// # Errors
    /// None that did not come up when it was changed.
    pub fn begin_anew(&self) -> Result<Scenario, ExperimentError> {
        let session = &mut *self.session();
        let scenario = session.present.clone();
        session.history = History::of(&Experiment::new(&scenario)?, MOST_ROWS);
        session.gliding_names = gliding_names(&scenario);
        session.first = scenario.clone();
        session.restarts += 1;
        session.is_to_reset = true;
        session.t_s = 0.0;
        session.from_s = 0.0;
        session.deadline_misses = 0;
        session.outcome = None;
        session.made.clear();
        self.helm.begin_anew();
        self.helm.set_revision(session.revision);
        self.send(&session.scene_message(&self.name, false));
        Ok(scenario)
    }

    /// What happened so far, as of a recorded run.
    pub(in crate::view) fn recording(&self) -> String {
        let (scene, ticks) = {
            let session = &mut *self.session();
            self.send_unsent(session);
            (session.scene.clone(), session.history.all())
        };
        // Much to write: who takes in the next tick is not to wait for it.
        Recording::of_live(&self.name, scene, ticks).to_json()
    }

    /// Sends to all clients what is new.
    pub(in crate::view) fn send_bundle(&self) {
        let session = &mut *self.session();
        self.send_unsent(session);
        let state = self.state(session);
        let is_told = session.told.as_ref().is_some_and(|(when, told)| {
            *told
                == State {
                    t_s: told.t_s,
                    step_time_us: told.step_time_us,
                    ..state.clone()
                }
                && when.elapsed() < TELL_STATE_EVERY
        });
        if !is_told {
            self.send(&json(&Told::State(state.clone())));
            session.told = Some((Instant::now(), state));
        }
    }

    fn send_unsent(&self, session: &mut Session) {
        if self.bundles.receiver_count() == 0 {
            return;
        }
        if std::mem::take(&mut session.is_to_reset) {
            self.send(&json(&session.all_ticks(true)));
        } else if let Some(ticks) = session.history.unsent() {
            self.send(&json(&session.live_ticks(ticks, false)));
        }
    }

    /// Nobody there is no error.
    pub(super) fn send(&self, message: &str) {
        let _ = self.bundles.send(message.into());
    }

    /// What a new client is told first, and everything after.
    pub(super) fn greet(&self) -> (Vec<String>, broadcast::Receiver<Utf8Bytes>) {
        self.viewers.fetch_add(1, Ordering::Relaxed);
        self.helm.begin();
        let (scene, ticks, state, bundles) = {
            let session = &mut *self.session();
            self.send_unsent(session);
            // What others would have to be told anew, this one is told at first.
            session.is_to_reset &= self.bundles.receiver_count() > 0;
            (
                session.scene_message(&self.name, true),
                session.all_ticks(true),
                self.state(session),
                self.bundles.subscribe(),
            )
        };
        let (ticks, state) = (json(&ticks), json(&Told::State(state)));
        (vec![json(&Told::hello()), scene, ticks, state], bundles)
    }

    /// A client is gone.
    pub(super) fn leave(&self) {
        self.viewers.fetch_sub(1, Ordering::Relaxed);
    }

    fn state(&self, session: &Session) -> State {
        let has_ended = session.outcome.is_some();
        let allowed = Allowed::with(self.arm, has_ended);
        State {
            running: match () {
                () if has_ended => Stage::Ended,
                () if !self.helm.has_begun() => Stage::Waiting,
                () if self.helm.is_paused() => Stage::Paused,
                () => Stage::Running,
            },
            t_s: session.t_s,
            speed: self.helm.speed(),
            allowed: allowed.acts,
            refusal: allowed.refusal,
            step_time_us: session.steps.summary(),
            deadline_misses: session.deadline_misses,
            outcome: session.outcome.clone(),
            viewers: self.viewers.load(Ordering::Relaxed),
            revision: self.helm.revision(),
            edited: session.present != session.original,
        }
    }

    /// What is behind the lock is numbers and text; whoever panicked with it in hand left it no worse.
    pub(super) fn session(&self) -> MutexGuard<'_, Session> {
        self.session.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Session {
    pub(super) fn scene_message(&self, name: &str, with_robot: bool) -> String {
        let without = (!with_robot).then(|| self.scene.without_robot());
        json(&LiveScene {
            scene: without.as_ref().unwrap_or(&self.scene),
            name,
            revision: self.revision,
            from_s: self.from_s,
        })
    }

    /// Everything that has happened.
    fn all_ticks(&mut self, reset: bool) -> LiveTicks {
        let ticks = self.history.all();
        self.live_ticks(ticks, reset)
    }

    fn live_ticks(&self, ticks: Ticks, reset: bool) -> LiveTicks {
        let mut gliding: Vec<Glide> = Vec::new();
        for it in self.history.gliding() {
            let name = &self.gliding_names[it.task.index()];
            // An obstacle of many pairs moves once.
            if !gliding.iter().any(|known| known.name == *name) {
                gliding.push(Glide::of(name, it));
            }
        }
        LiveTicks {
            ticks,
            reset,
            gliding,
        }
    }
}

/// The name of each task or, where it keeps an obstacle away, that of the obstacle.
fn gliding_names(scenario: &Scenario) -> Vec<String> {
    let obstacles = &scenario.collision.obstacles;
    let is_obstacle = |name: &String| obstacles.iter().any(|it| it.name == *name);
    let tasks = scenario.all_tasks().into_iter();
    tasks
        .map(|task| {
            let between = scenario.between(&task).into_iter().flatten();
            between.into_iter().find(is_obstacle).unwrap_or(task.name)
        })
        .collect()
}
