//! The reasons of a tick, gathered from what the rule and the landing found.

use super::{Controller, MAX_PIVOTS, Rule};
use crate::active::ActiveSet;
use crate::linalg::dot;
use crate::reason::Reason;
use crate::sides::Side;
use crate::task_id::TaskId;

impl Controller {
    /// Why the tick came out as it did.
    pub(super) fn explain(&mut self, was_active: &ActiveSet) {
        self.step.reasons.clear();
        let active = self.step.active;
        for task in active.iter() {
            let reason = self.why_active(task);
            self.step.add_reason(reason);
        }
        for task in was_active.iter() {
            if !active.contains(task) {
                let reason = self.why_let_go(task);
                self.step.add_reason(reason);
            }
        }
        self.step.explain_motion();
        if self.step.no_mode {
            self.step.add_reason(Reason::NoMode);
        }
        if self.step.pivots == MAX_PIVOTS {
            self.step.add_reason(Reason::OutOfPivots);
        }
    }

    fn why_active(&self, task: TaskId) -> Reason {
        let sigma = self.here.scalar(task);
        let set = self.stack.interval_of_set(task);
        let is_upper = !set.is_nearer_to_min(sigma);
        let rate = match &self.rule {
            Rule::Search(search) => {
                if !self.borders.is_at_border(task, sigma) {
                    let [lower, upper] = Side::both(task).map(|side| side.inside(&set, sigma));
                    return Reason::HoldsInside {
                        task,
                        inside: lower.min(upper),
                    };
                }
                search.leaving(task).abs()
            }
            Rule::Nearest(nearest) => nearest.crossing(Side { task, is_upper }),
        };
        Reason::Holds {
            task,
            is_upper,
            crossing: rate * self.period,
        }
    }

    fn why_let_go(&mut self, task: TaskId) -> Reason {
        let set = self.stack.interval_of_set(task);
        let is_upper = !set.is_nearer_to_min(self.here.scalar(task));
        let side = Side { task, is_upper };
        let moves = self.here.drift(task) - self.borders.bound_rate(side);
        let rate = dot(self.here.jacobian(&self.stack, task), &self.step.qd) + moves;
        Reason::LetsGo {
            task,
            inward: side.inward(rate).max(0.0),
        }
    }
}
