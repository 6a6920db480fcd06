//! The five properties that Section VI of the paper confirms, watched on every tick, and what else
//! deserves a look.

mod observations;

use alloc::vec::Vec;

pub use observations::{JointHistory, Observations, Occurrence};

use crate::stack::Stack;
use crate::step::Step;
use crate::task_id::TaskId;

/// A property holds while its worst deviation is at most this [task's unit].
pub const PROPERTY_TOLERANCE: f64 = 1e-6;

/// Watches a run, tick by tick.
///
/// [`observe`](Self::observe) does not allocate.
#[derive(Clone, Debug)]
pub struct Monitor {
    histories: Vec<TaskHistory>,
    inside_stays: Deviation,
    outside_never_worse: Deviation,
    entered_stays: Deviation,
    low_priority_excess: Deviation,
    observations: Observations,
}

/// What one task has done so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaskHistory {
    /// Least value of a scalar task; +∞ before the first tick.
    pub min: f64,
    /// Greatest value of a scalar task; −∞ before the first tick.
    pub max: f64,
    /// Furthest outside its set; 0 if it never was.
    pub worst_violation: f64,
    /// Time of the first tick inside its set [s].
    pub entered_s: Option<f64>,
    /// Number of ticks in which it was active.
    pub active_ticks: u64,
    /// Norm of the error at the last tick, for an equality task.
    pub final_error: f64,
    /// Smallest violation so far: what a set that was never entered is held against.
    best_violation: f64,
    /// When it was furthest outside [s].
    worst_at_s: f64,
    /// Time of the last tick [s].
    last_s: f64,
    started_inside: bool,
}

/// The five properties, each with its worst moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// 1: equality tasks converge. `worst` is the largest error that is left at the last tick.
    pub equality_converges: Deviation,
    /// 2: high-priority sets that hold at the first tick hold at every tick. `worst` is the largest
    /// violation.
    pub inside_stays: Deviation,
    /// 3: high-priority sets that do not hold yet freeze or come closer. `worst` is the largest
    /// growth of a violation over the smallest one before it.
    pub outside_never_worse: Deviation,
    /// 4: high-priority sets that were entered later stay. `worst` is the largest violation after.
    pub entered_stays: Deviation,
    /// 5: low-priority sets are not guaranteed. `worst` is the largest violation of one after it
    /// had been inside, or at any time if it never was.
    pub low_priority_excess: Deviation,
}

/// The largest deviation from a property.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// How large [task's unit].
    pub worst: f64,
    /// When [s]; `None` if nothing deviated at all.
    pub at_s: Option<f64>,
    /// Which task.
    pub task: Option<TaskId>,
}

impl Deviation {
    /// Whether the property holds, to [`PROPERTY_TOLERANCE`].
    pub fn holds(&self) -> bool {
        self.worst <= PROPERTY_TOLERANCE
    }

    fn add(&mut self, amount: f64, t_s: f64, task: TaskId) {
        if amount > self.worst {
            *self = Self {
                worst: amount,
                at_s: Some(t_s),
                task: Some(task),
            };
        }
    }
}

impl TaskHistory {
    const BEFORE_THE_FIRST_TICK: Self = Self {
        min: f64::INFINITY,
        max: f64::NEG_INFINITY,
        worst_violation: 0.0,
        entered_s: None,
        active_ticks: 0,
        final_error: 0.0,
        best_violation: f64::INFINITY,
        worst_at_s: 0.0,
        last_s: 0.0,
        started_inside: false,
    };

    fn is_before_the_first_tick(&self) -> bool {
        self.best_violation == f64::INFINITY
    }
}

impl Monitor {
    /// A monitor for a run of this stack.
    pub fn new(stack: &Stack) -> Self {
        Self {
            histories: alloc::vec![TaskHistory::BEFORE_THE_FIRST_TICK; stack.len()],
            inside_stays: Deviation::default(),
            outside_never_worse: Deviation::default(),
            entered_stays: Deviation::default(),
            low_priority_excess: Deviation::default(),
            observations: Observations::new(stack),
        }
    }

    /// Takes in one tick: the state at time `t_s` [s], before the step, and the mode chosen there.
    pub fn observe(&mut self, stack: &Stack, step: &Step, t_s: f64) {
        self.observations.observe(stack, step, t_s);
        self.observe_properties(stack, step, t_s);
    }

    /// Takes in one tick for the [`properties`](Self::properties) and histories alone, which takes less time:
    /// [`observations`](Self::observations) do not see it.
    pub fn observe_properties(&mut self, stack: &Stack, step: &Step, t_s: f64) {
        for (id, level) in stack.iter() {
            let history = &mut self.histories[id.index()];
            history.last_s = t_s;
            if let &[value] = step.value(id) {
                history.min = history.min.min(value);
                history.max = history.max.max(value);
            }
            match level.interval() {
                None => history.final_error = step.error_norm(id),
                Some(set) => {
                    let violation = set.violation(step.value(id)[0]);
                    history.active_ticks += u64::from(step.active.contains(id));
                    self.observe_set(stack.is_high_priority(id), id, violation, t_s);
                }
            }
        }
    }

    fn observe_set(&mut self, high_priority: bool, id: TaskId, violation: f64, t_s: f64) {
        let history = &mut self.histories[id.index()];
        let inside = violation <= 0.0;
        if history.is_before_the_first_tick() {
            history.started_inside = inside;
        }
        if violation > history.worst_violation {
            history.worst_violation = violation;
            history.worst_at_s = t_s;
        }
        match (high_priority, history.entered_s.is_some()) {
            (true, true) if history.started_inside => self.inside_stays.add(violation, t_s, id),
            (true, true) => self.entered_stays.add(violation, t_s, id),
            (true, false) => {
                self.outside_never_worse
                    .add(violation - history.best_violation, t_s, id);
            }
            (false, true) => self.low_priority_excess.add(violation, t_s, id),
            (false, false) => {}
        }
        history.best_violation = history.best_violation.min(violation);
        if inside && history.entered_s.is_none() {
            history.entered_s = Some(t_s);
        }
    }

    /// Goes on where `before` was, in the same run, after a change of its stack. `places` has for each task
    /// its place in the stack of then; of a task with `is_new` it starts afresh what its set is held
    /// against, as it was another set. Does not allocate.
    ///
    /// # Panics
    /// If the stacks differ in the number of tasks or joints, or `places` has another length.
    pub fn take_over(&mut self, before: &Self, places: &[TaskId], is_new: impl Fn(TaskId) -> bool) {
        assert_eq!(
            places.len(),
            self.histories.len(),
            "one place for each task"
        );
        for (index, (history, place)) in self.histories.iter_mut().zip(places).enumerate() {
            *history = before.histories[place.index()];
            if is_new(TaskId::new(index)) {
                history.entered_s = None;
                history.best_violation = f64::INFINITY;
            }
        }
        let now = |then: Option<TaskId>| {
            let index = places.iter().position(|place| Some(*place) == then)?;
            Some(TaskId::new(index))
        };
        for (property, then) in [
            (&mut self.inside_stays, before.inside_stays),
            (&mut self.outside_never_worse, before.outside_never_worse),
            (&mut self.entered_stays, before.entered_stays),
            (&mut self.low_priority_excess, before.low_priority_excess),
        ] {
            *property = Deviation {
                task: now(then.task),
                ..then
            };
        }
        self.observations.take_over(&before.observations, now);
    }

    /// What was seen so far besides the five properties.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }

    /// What one task has done so far.
    pub fn history(&self, task: TaskId) -> &TaskHistory {
        &self.histories[task.index()]
    }

    /// The five properties over the ticks so far.
    pub fn properties(&self, stack: &Stack) -> Properties {
        let mut equality_converges = Deviation::default();
        let mut low_priority_excess = self.low_priority_excess;
        for (id, level) in stack.iter() {
            let history = &self.histories[id.index()];
            if level.interval().is_none() {
                equality_converges.add(history.final_error, history.last_s, id);
            } else if !stack.is_high_priority(id) && history.entered_s.is_none() {
                low_priority_excess.add(history.worst_violation, history.worst_at_s, id);
            }
        }
        Properties {
            equality_converges,
            inside_stays: self.inside_stays,
            outside_never_worse: self.outside_never_worse,
            entered_stays: self.entered_stays,
            low_priority_excess,
        }
    }
}
