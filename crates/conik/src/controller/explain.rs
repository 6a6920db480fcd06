//! The reasons of a tick, gathered from what the rule and the landing found.

use super::{Controller, Rule};
use crate::active::ActiveSet;
use crate::linalg::dot;
use crate::reason::Reason;
use crate::sides::Side;
use crate::step::Step;
use crate::task_id::TaskId;

impl Controller {
    /// Why the tick came out as it did.
    pub(super) fn explain(&mut self, was_active: &ActiveSet, is_cut_off: bool) {
        self.step.reasons.clear();
        let active = self.step.active;
        for task in active.iter() {
            let reason = self.why_active(task);
            self.step.add_reason(reason);
        }
        if *was_active != active {
            for task in was_active.iter().filter(|&task| !active.contains(task)) {
                let reason = self.why_let_go(task);
                self.step.add_reason(reason);
            }
        }
        match &self.rule {
            Rule::Search(search) => add_lost(&mut self.step, search.lost()),
            Rule::Nearest(nearest) => add_lost(&mut self.step, nearest.lost()),
        }
        if self.step.acceleration_exceeded.is_some() {
            let qdd = self.step.qdd;
            for exceeded in self.limits.exceeded(&qdd) {
                self.step.add_reason(Reason::AccelerationExceeded(exceeded));
            }
        }
        self.step.explain_motion();
        if self.step.no_mode {
            self.step.add_reason(Reason::NoMode);
        }
        if is_cut_off {
            self.step.add_reason(Reason::OutOfPivots);
        }
    }

    fn why_active(&mut self, task: TaskId) -> Reason {
        let sigma = self.here.scalar(task);
        let set = self.stack.interval_of_set(task);
        let is_upper = !set.is_nearer_to_min(sigma);
        let side = Side { task, is_upper };
        let crossing_rate = match &self.rule {
            Rule::Search(search) => {
                if !self.borders.is_at_border(task, sigma) {
                    self.here.measure(&self.stack);
                    let sigma = self.here.scalar(task);
                    let [lower, upper] = Side::both(task).map(|side| side.inside(&set, sigma));
                    return Reason::HoldsInside {
                        task,
                        inside: lower.min(upper),
                    };
                }
                search.leaving(task).abs()
            }
            Rule::Nearest(nearest) => nearest.crossing(side),
        };
        let is_frozen = matches!(self.rule, Rule::Search(_))
            && self.borders.are_at_ease()
            && self.stack.is_high_priority(task);
        Reason::Holds {
            task,
            is_upper,
            crossing: crossing_rate * self.period,
            // What is frozen stands still.
            rate: if is_frozen {
                0.0
            } else {
                self.inward_rate(side)
            },
        }
    }

    fn why_let_go(&mut self, task: TaskId) -> Reason {
        let set = self.stack.interval_of_set(task);
        let is_upper = !set.is_nearer_to_min(self.here.scalar(task));
        let side = Side { task, is_upper };
        Reason::LetsGo {
            task,
            inward: self.inward_rate(side).max(0.0),
        }
    }

    /// How fast this tick's velocity takes a side inward, relative to its bound [task's unit/s].
    fn inward_rate(&mut self, side: Side) -> f64 {
        let moves = self.here.drift(side.task) - self.borders.bound_rate(side);
        let row = self.here.jacobian(&self.stack, side.task);
        side.inward(dot(row, &self.step.qd) + moves)
    }
}

fn add_lost(step: &mut Step, lost: impl Iterator<Item = (TaskId, usize)>) {
    for (task, directions) in lost {
        step.add_reason(Reason::LosesRank { task, directions });
    }
}
