//! How a task is named between the caller and the controller.

/// A task's place in its stack: 0 is the highest priority.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TaskId(usize);

impl TaskId {
    pub(crate) const fn new(index: usize) -> Self {
        Self(index)
    }

    /// The place as a number, counted from 0.
    pub const fn index(self) -> usize {
        self.0
    }
}
