//! One vector per task of a stack, side by side in one piece of memory.

use alloc::vec::Vec;

use crate::linalg::{copy, not_finite};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// A vector of each task's dimension for each task: values, errors.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TaskVectors {
    /// Where each task's entries begin; one more at the end.
    starts: Vec<usize>,
    entries: Vec<f64>,
}

impl TaskVectors {
    pub(crate) fn zeros(stack: &Stack) -> Self {
        let mut starts = Vec::with_capacity(stack.len() + 1);
        let mut rows = 0;
        starts.push(rows);
        for (_, level) in stack.iter() {
            rows += level.task().dimension();
            starts.push(rows);
        }
        Self {
            starts,
            entries: alloc::vec![0.0; rows],
        }
    }

    #[inline]
    pub(crate) fn of(&self, task: TaskId) -> &[f64] {
        &self.entries[self.starts[task.index()]..self.starts[task.index() + 1]]
    }

    #[inline]
    pub(crate) fn of_mut(&mut self, task: TaskId) -> &mut [f64] {
        &mut self.entries[self.starts[task.index()]..self.starts[task.index() + 1]]
    }

    /// The first `count` entries.
    #[inline]
    pub(crate) fn first(&self, count: usize) -> &[f64] {
        &self.entries[..count]
    }

    /// The first task with an entry that is not a finite number.
    pub(crate) fn not_finite(&self) -> Option<TaskId> {
        let entry = not_finite(&self.entries)?;
        let task = self.starts.iter().rposition(|&start| start <= entry)?;
        Some(TaskId::new(task))
    }

    #[inline]
    pub(crate) fn copy_from(&mut self, other: &Self) {
        copy(&mut self.entries, &other.entries);
    }
}
