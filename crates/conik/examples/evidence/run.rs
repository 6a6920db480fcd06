//! One scene under one combination of rule, border and recursion, and what became of it.

use std::time::{Duration, Instant};

use conik::{ActiveSet, Controller, JointVec, Robot, Settings, StackError, Step, Vec3, Waypoints};

use crate::chain::{Chain, minus, norm};
use crate::scene::{ACCEPTANCE, Scene, Set};
use crate::stationary;

/// A joint that moves slower than this is at rest [rad/s].
const AT_REST: f64 = 1e-5;

/// Velocities below this do not count as reversed [rad/s].
const SLOW: f64 = 0.02;

/// A set is at its border when its value is this near to it, or outside [task's unit]. Borders are
/// held 1e-7 inside.
const AT_BORDER: f64 = 2e-6;

/// Room that a set which has not been entered is given once: a margin, and gains too small to follow.
const GIVEN_ONCE: f64 = 5e-7;

/// What became of a scene.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    pub mode_changes: usize,
    /// Of these in the last quarter of the run.
    pub late_changes: usize,
    /// Of these between two ticks in which every joint was at rest.
    pub changes_at_rest: usize,
    /// Per high-priority set, the furthest outside after it had been inside; `None` if it never was.
    pub violations: Vec<Option<f64>>,
    /// The most by which a high-priority set that had never been inside got worse than its best value.
    pub worsened: f64,
    pub waypoints_s: Vec<Option<f64>>,
    pub peak_speed: f64,
    /// Without the first tick, which sets out from rest.
    pub peak_acceleration: f64,
    /// Changes of sign of a joint's velocity from one tick to the next.
    pub reversals: usize,
    /// Changes of direction of a joint in the last quarter of the run.
    pub late_swings: usize,
    pub final_speed: f64,
    pub final_error: f64,
    /// By how much |e| would still fall a radian, at the last tick [m/rad].
    pub could_fall: f64,
    pub times: Vec<Duration>,
    pub most_pivots: usize,
    pub most_kinematics: usize,
    pub halvings: usize,
    pub stood_still: usize,
    pub broke: bool,
}

impl Outcome {
    /// Whether the arm had stopped short of its waypoint.
    pub fn stopped(&self) -> bool {
        self.final_speed < AT_REST && self.final_error > 5e-3
    }

    /// Whether it had stopped where it could have gone on: a centimetre for every radian.
    pub fn stopped_falsely(&self) -> bool {
        self.stopped() && self.could_fall > 1e-2
    }

    /// The worst violation of an entered set.
    pub fn worst(&self) -> f64 {
        self.violations
            .iter()
            .flatten()
            .fold(f64::NEG_INFINITY, |worst, v| worst.max(*v))
    }

    pub fn median_time(&mut self) -> Duration {
        self.times.sort_unstable();
        self.times[self.times.len() / 2]
    }
}

/// Bounds in force of a set, as the definition of the guarantee has them.
struct Watched {
    set: Set,
    entered: bool,
    best: f64,
    worst: f64,
}

/// Runs a scene. `seen` is called after each tick with the chain at q.
pub fn run(
    scene: &Scene,
    settings: Settings,
    mut seen: impl FnMut(usize, &Chain, &Step),
) -> Result<Outcome, StackError> {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let (stack, position) = scene.stack(&robot)?;
    let mut controller = Controller::new(&robot, stack, settings).expect("sound settings");
    let points = scene.waypoints.iter().copied().map(Vec3::from).collect();
    let mut waypoints = Waypoints::new(points, ACCEPTANCE).expect("there are two");
    let mut watched: Vec<Watched> = scene.high.iter().map(Watched::new).collect();
    let ticks = scene.ticks();
    let mut outcome = Outcome {
        waypoints_s: vec![None; scene.waypoints.len()],
        times: Vec::with_capacity(ticks),
        ..Outcome::default()
    };
    let mut q = JointVec::from(scene.q0);
    let mut before: Option<(ActiveSet, JointVec)> = None;
    let mut directions = [0.0_f64; 6];
    for tick in 0..=ticks {
        let chain = Chain::at(&q);
        for watched in &mut watched {
            watched.observe(&chain, &mut outcome);
        }
        if let Some(reached) = waypoints.advance(chain.tool().into()) {
            outcome.waypoints_s[reached] = Some(tick as f64 / settings.rate_hz);
        }
        let target = waypoints.target().to_array();
        controller
            .setpoints()
            .set_desired(position, &target)
            .expect("finite");
        let clock = Instant::now();
        let Ok(step) = controller.step(&q) else {
            outcome.broke = true;
            break;
        };
        outcome.times.push(clock.elapsed());
        seen(tick, &chain, step);
        let is_late = 4 * tick >= 3 * ticks;
        if let Some((active, qd)) = &before {
            outcome.count(active, qd, step, is_late);
        }
        for (direction, speed) in directions.iter_mut().zip(step.qd.iter()) {
            if speed.abs() > SLOW {
                let turned = *direction * speed < 0.0;
                outcome.late_swings += usize::from(turned && is_late);
                *direction = *speed;
            }
        }
        outcome.take_in(step);
        before = Some((step.active, step.qd));
        if tick == ticks {
            outcome.end(&watched, &chain, target, &step.qd);
        }
        q = step.q_ref;
    }
    outcome.violations = watched
        .iter()
        .map(|w| w.entered.then_some(w.worst))
        .collect();
    Ok(outcome)
}

impl Outcome {
    fn count(&mut self, active: &ActiveSet, qd: &JointVec, step: &Step, is_late: bool) {
        let slow = |qd: &JointVec| qd.iter().all(|v| v.abs() < AT_REST);
        if *active != step.active {
            self.mode_changes += 1;
            self.late_changes += usize::from(is_late);
            self.changes_at_rest += usize::from(slow(qd) && slow(&step.qd));
        }
        for (old, new) in qd.iter().zip(step.qd.iter()) {
            let is_fast = old.abs() > SLOW && new.abs() > SLOW;
            self.reversals += usize::from(is_fast && old * new < 0.0);
        }
        for acceleration in step.qdd.iter() {
            self.peak_acceleration = self.peak_acceleration.max(acceleration.abs());
        }
    }

    fn take_in(&mut self, step: &Step) {
        let largest = |v: &JointVec| v.largest().map_or(0.0, |(_, magnitude)| magnitude);
        self.broke |= !step.qd.is_finite() || !step.q_ref.is_finite();
        self.peak_speed = self.peak_speed.max(largest(&step.qd));
        self.final_speed = largest(&step.qd);
        self.most_pivots = self.most_pivots.max(step.pivots);
        self.most_kinematics = self.most_kinematics.max(step.landed.kinematics);
        self.halvings += step.landed.halvings;
        self.stood_still += usize::from(step.landed.stood_still);
    }

    fn end(&mut self, watched: &[Watched], chain: &Chain, target: [f64; 3], qd: &JointVec) {
        let error = minus(target, chain.tool());
        self.final_error = norm(error);
        if qd.iter().any(|v| v.abs() >= AT_REST) {
            return;
        }
        let inward: Vec<[f64; 6]> = watched
            .iter()
            .flat_map(|watched| watched.inward_rows(chain))
            .collect();
        let left = stationary::residual(chain.moved_along(error), &inward);
        self.could_fall = left / self.final_error.max(1e-12);
    }
}

impl Watched {
    fn new(set: &Set) -> Self {
        Self {
            set: *set,
            entered: false,
            best: f64::INFINITY,
            worst: f64::NEG_INFINITY,
        }
    }

    fn observe(&mut self, chain: &Chain, outcome: &mut Outcome) {
        let outside = self.set.outside(chain.value(self.set.measure));
        self.entered |= outside <= 0.0;
        if self.entered {
            self.worst = self.worst.max(outside);
        } else if self.best.is_finite() {
            outcome.worsened = outcome.worsened.max(outside - self.best - GIVEN_ONCE);
        }
        self.best = self.best.min(outside);
    }

    /// Inward rows of the bounds that the set lies on. Of a set that was never entered the best value
    /// so far is the bound.
    fn inward_rows(&self, chain: &Chain) -> Vec<[f64; 6]> {
        let sigma = chain.value(self.set.measure);
        let row = chain.row(self.set.measure);
        let room = if self.entered {
            0.0
        } else {
            self.best.max(0.0)
        };
        let mut rows = Vec::new();
        if sigma <= self.set.min - room + AT_BORDER {
            rows.push(row);
        }
        if sigma >= self.set.max + room - AT_BORDER {
            rows.push(row.map(|entry| -entry));
        }
        rows
    }
}
