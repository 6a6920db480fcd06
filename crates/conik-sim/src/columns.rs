//! Which numbers of the tasks stand in a record, in which order.

use conik::{Stack, Step, TaskId};

use crate::record::Record;

/// Values of the scalar tasks of a stack, then errors of its equality tasks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    scalars: Vec<TaskId>,
    equalities: Vec<TaskId>,
}

impl Columns {
    /// The columns of a stack, in the order of its tasks.
    pub fn new(stack: &Stack) -> Self {
        let in_order: Vec<TaskId> = stack.iter().map(|(id, _)| id).collect();
        Self::in_order(stack, &in_order)
    }

    /// The columns of a stack, its tasks in that order.
    pub(crate) fn in_order(stack: &Stack, tasks: &[TaskId]) -> Self {
        let those = |is_in: fn(&conik::Level) -> bool| {
            let tasks = tasks.iter().copied();
            tasks.filter(|&id| is_in(&stack[id])).collect()
        };
        Self {
            scalars: those(|level| level.task().dimension() == 1),
            equalities: those(|level| level.interval().is_none()),
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
        let index = self.equalities.iter().position(|&other| other == task)?;
        record.task_values.get(self.scalars.len() + index).copied()
    }

    pub(crate) fn values(&self, step: &Step) -> Vec<f64> {
        let values = self.scalars.iter().map(|&id| step.value(id)[0]);
        let errors = self.equalities.iter().map(|&id| step.error_norm(id));
        values.chain(errors).collect()
    }
}
