//! What deserves a look besides the five properties: rank, leaks, needless freezing, standstill, flicker,
//! and the limits of the joints.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::reason::Reason;
use crate::stack::Stack;
use crate::step::Step;
use crate::task_id::TaskId;

/// Joint speeds below this count as none [rad/s or m/s].
const STILL: f64 = 1e-4;

/// Errors above this count as not reached [task's unit].
const NOT_REACHED: f64 = 1e-3;

/// How long the arm has to stand still before it counts as stuck [s].
const STUCK_AFTER_S: f64 = 1.0;

/// A frozen task that moves slower than this moves at the level of rounding [task's unit/s].
const LEAK: f64 = 1e-9;

/// Mode changes that are remembered: more in one second are not told apart.
const MOST_CHANGES: usize = 1000;

/// Something that happened in some ticks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Occurrence {
    /// In how many.
    pub ticks: u64,
    /// How much of it in the worst of them.
    pub worst: f64,
    /// When the worst was [s].
    pub at_s: Option<f64>,
    /// Which task, if it is about one.
    pub task: Option<TaskId>,
    /// When it was last [s].
    pub latest_s: Option<f64>,
}

impl Occurrence {
    /// Takes in that it happened, how much, and when [s]. What happens to several tasks in one tick
    /// counts as one tick.
    pub fn add(&mut self, amount: f64, t_s: f64, task: Option<TaskId>) {
        if self.latest_s != Some(t_s) {
            self.ticks += 1;
            self.latest_s = Some(t_s);
        }
        if self.at_s.is_none() || amount > self.worst {
            self.worst = amount;
            self.at_s = Some(t_s);
            self.task = task;
        }
    }
}

/// What one joint's limits did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointHistory {
    /// Ticks in which the velocity was shortened for its speed limit.
    pub speed_limited_ticks: u64,
    /// Ticks in which the velocity was shortened for its acceleration limit.
    pub acceleration_limited_ticks: u64,
    /// Ticks in which a set made it accelerate beyond its limit, and by which factor at worst.
    pub acceleration_exceeded: Occurrence,
    /// Greatest speed, either way [rad/s or m/s].
    pub fastest: f64,
    /// Greatest acceleration, either way [rad/s² or m/s²].
    pub hardest: f64,
}

/// What was seen in a run besides the five properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Observations {
    /// A level had fewer directions than its task has components; `worst`: how many fewer.
    pub rank_lost: Occurrence,
    /// A frozen high-priority set moved; `worst`: how fast, to first order [task's unit/s]. Only with
    /// border `Freeze`: `Land` moves a held set on purpose, to where the next sample is inside.
    pub frozen_moves: Occurrence,
    /// A set strictly inside was frozen; `worst`: how far inside [task's unit].
    pub frozen_inside: Occurrence,
    /// The arm stood still with a set at its border and an equality task not reached: a local minimum,
    /// or a deadlock; `worst`: what was left of the error [task's unit].
    pub stuck: Occurrence,
    /// A set was announced to go outside; `worst`: by how much [task's unit].
    pub went_outside: Occurrence,
    /// No velocity was found that lands inside every set, so the arm stood still for a period.
    pub stood_still: Occurrence,
    /// The mode changed; `worst`: how often within one second.
    pub mode_changes: Occurrence,
    /// The joints, base to tool.
    pub joints: Vec<JointHistory>,
    recent_changes: Vec<f64>,
    oldest_change: usize,
    last_active: Option<ActiveSet>,
    still_since_s: Option<f64>,
}

impl Observations {
    pub(super) fn new(stack: &Stack) -> Self {
        let none = Occurrence::default();
        Self {
            rank_lost: none,
            frozen_moves: none,
            frozen_inside: none,
            stuck: none,
            went_outside: none,
            stood_still: none,
            mode_changes: none,
            joints: alloc::vec![JointHistory::default(); stack.dof()],
            recent_changes: Vec::with_capacity(MOST_CHANGES),
            oldest_change: 0,
            last_active: None,
            still_since_s: None,
        }
    }

    /// Goes on where `before` was; `now` gives the number of a task that had another one then.
    pub(super) fn take_over(
        &mut self,
        before: &Self,
        now: impl Fn(Option<TaskId>) -> Option<TaskId>,
    ) {
        for (seen, then) in [
            (&mut self.rank_lost, before.rank_lost),
            (&mut self.frozen_moves, before.frozen_moves),
            (&mut self.frozen_inside, before.frozen_inside),
            (&mut self.stuck, before.stuck),
            (&mut self.went_outside, before.went_outside),
            (&mut self.stood_still, before.stood_still),
            (&mut self.mode_changes, before.mode_changes),
        ] {
            *seen = Occurrence {
                task: now(then.task),
                ..then
            };
        }
        self.joints.copy_from_slice(&before.joints);
        self.recent_changes.clear();
        self.recent_changes
            .extend_from_slice(&before.recent_changes);
        self.oldest_change = before.oldest_change;
        self.last_active = before.last_active.map(|active| {
            let mut renumbered = ActiveSet::EMPTY;
            for task in active.iter().filter_map(|task| now(Some(task))) {
                renumbered.insert(task);
            }
            renumbered
        });
        self.still_since_s = before.still_since_s;
    }

    pub(super) fn observe(&mut self, stack: &Stack, step: &Step, t_s: f64) {
        for reason in step.reasons() {
            self.observe_reason(stack, step, reason, t_s);
        }
        for (joint, (speed, acceleration)) in step.qd.iter().zip(step.qdd.iter()).enumerate() {
            let history = &mut self.joints[joint];
            history.fastest = history.fastest.max(speed.abs());
            history.hardest = history.hardest.max(acceleration.abs());
        }
        if self.last_active.is_some_and(|last| last != step.active) {
            self.observe_change(t_s);
        }
        self.last_active = Some(step.active);
        self.observe_standstill(stack, step, t_s);
    }

    fn observe_reason(&mut self, stack: &Stack, step: &Step, reason: &Reason, t_s: f64) {
        match *reason {
            Reason::Holds { task, rate, .. } => {
                let is_frozen = step.landed.kinematics == 0 && stack.is_high_priority(task);
                let is_outside = !stack.interval_of_set(task).contains(step.value(task)[0]);
                let recovers = stack.recovers(task) && is_outside;
                if is_frozen && !recovers && rate.abs() > LEAK {
                    self.frozen_moves.add(rate.abs(), t_s, Some(task));
                }
            }
            Reason::HoldsInside { task, inside } => {
                self.frozen_inside.add(inside, t_s, Some(task));
            }
            Reason::LosesRank { task, directions } => {
                let directions = u32::try_from(directions).unwrap_or(u32::MAX);
                self.rank_lost.add(f64::from(directions), t_s, Some(task));
            }
            Reason::SpeedLimit(limit) => self.joints[limit.joint].speed_limited_ticks += 1,
            Reason::AccelerationLimit(limit) => {
                self.joints[limit.joint].acceleration_limited_ticks += 1;
            }
            Reason::AccelerationExceeded(exceeded) => {
                let history = &mut self.joints[exceeded.joint];
                history.acceleration_exceeded.add(exceeded.times, t_s, None);
            }
            Reason::GoesOutside(outside) => {
                self.went_outside.add(outside.by, t_s, Some(outside.task));
            }
            Reason::StandsStill => self.stood_still.add(1.0, t_s, None),
            Reason::LetsGo { .. }
            | Reason::Corrected(_)
            | Reason::Halved(_)
            | Reason::Cautious(_)
            | Reason::NoMode
            | Reason::OutOfPivots => {}
        }
    }

    /// Counts the changes of the last second in a ring.
    fn observe_change(&mut self, t_s: f64) {
        if self.recent_changes.len() < MOST_CHANGES {
            self.recent_changes.push(t_s);
        } else {
            self.recent_changes[self.oldest_change] = t_s;
            self.oldest_change = (self.oldest_change + 1) % MOST_CHANGES;
        }
        let is_recent = |time: &&f64| t_s - **time < 1.0;
        let count = self.recent_changes.iter().filter(is_recent).count();
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        self.mode_changes.add(f64::from(count), t_s, None);
    }

    fn observe_standstill(&mut self, stack: &Stack, step: &Step, t_s: f64) {
        let unreached = stack
            .iter()
            .filter(|(_, level)| level.interval().is_none())
            .map(|(id, _)| (id, step.error_norm(id)))
            .find(|(_, error)| *error > NOT_REACHED);
        let is_still = step.qd.iter().all(|speed| speed.abs() < STILL);
        match unreached {
            Some((task, error)) if is_still && !step.active.is_empty() => {
                let since = *self.still_since_s.get_or_insert(t_s);
                if t_s - since >= STUCK_AFTER_S {
                    self.stuck.add(error, t_s, Some(task));
                }
            }
            _ => self.still_since_s = None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_happens_to_two_tasks_in_one_tick_is_one_tick() {
        let (upper, lower) = (TaskId::new(0), TaskId::new(1));
        let mut lost = Occurrence::default();
        for tick in 0..3 {
            let t_s = f64::from(tick) / 125.0;
            lost.add(1.0, t_s, Some(upper));
            lost.add(2.0, t_s, Some(lower));
        }
        assert_eq!(lost.ticks, 3);
        assert_eq!((lost.worst, lost.at_s), (2.0, Some(0.0)));
        assert_eq!(lost.task, Some(lower));
    }
}
