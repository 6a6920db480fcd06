//! Leaving unmeasured what a tick has no need of, and measuring it when it is asked for.

use super::Controller;
use crate::step::Step;

impl Controller {
    /// From now on [`step`](Self::step) spares itself the values of sets that are costly to measure
    /// ([`Task::is_costly`](crate::Task::is_costly)), above the first equality task, and so far inside that
    /// no velocity of the tick can take them to their bound. References and all else are the same to the bit, but
    /// [`Step::value`] of such a set is NaN until [`measure`](Self::measure) is called.
    ///
    /// A [`Monitor`](crate::Monitor) wants all values.
    ///
    /// Where joints have acceleration limits it changes nothing: there all sets are looked at from afar.
    pub fn measure_on_demand(&mut self) {
        if !self.limits.has_acceleration() {
            self.here.measure_on_demand(&self.stack);
            self.there.measure_on_demand(&self.stack);
        }
    }

    /// The last tick, with the values that it had no need of. To be called before a task is changed.
    pub fn measure(&mut self) -> &Step {
        let unmeasured = core::mem::take(&mut self.step.unmeasured);
        if !unmeasured.is_empty() {
            let kinematics = self.here.kinematics_at(&self.q);
            for task in unmeasured.iter() {
                let value = self.step.values.of_mut(task);
                self.stack[task].task().value(kinematics, value);
            }
        }
        &self.step
    }
}
