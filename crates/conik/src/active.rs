//! Which set-based tasks are active: the mode, as a set of tasks.

use core::fmt;

use crate::task_id::TaskId;

/// The most tasks in a stack.
pub const MAX_TASKS: usize = 256;

const WORD: usize = u64::BITS as usize;

/// A set of tasks of a [`Stack`](crate::Stack), stored inline.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct ActiveSet {
    words: [u64; MAX_TASKS / WORD],
}

impl ActiveSet {
    /// No task.
    pub const EMPTY: Self = Self {
        words: [0; MAX_TASKS / WORD],
    };

    /// Adds a task.
    #[inline]
    pub fn insert(&mut self, task: TaskId) {
        self.words[task.index() / WORD] |= 1 << (task.index() % WORD);
    }

    /// Takes a task out.
    #[inline]
    pub fn remove(&mut self, task: TaskId) {
        self.words[task.index() / WORD] &= !(1 << (task.index() % WORD));
    }

    /// Whether a task is in the set.
    #[inline]
    pub fn contains(&self, task: TaskId) -> bool {
        self.words[task.index() / WORD] & 1 << (task.index() % WORD) != 0
    }

    /// Whether the two sets share a task.
    #[inline]
    pub fn intersects(&self, other: &Self) -> bool {
        self.words.iter().zip(&other.words).any(|(a, b)| a & b != 0)
    }

    /// The tasks in either set.
    #[inline]
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let mut words = self.words;
        for (word, other) in words.iter_mut().zip(&other.words) {
            *word |= other;
        }
        Self { words }
    }

    /// The tasks that are not in the other set.
    #[inline]
    #[must_use]
    pub fn without(&self, other: &Self) -> Self {
        let mut words = self.words;
        for (word, other) in words.iter_mut().zip(&other.words) {
            *word &= !other;
        }
        Self { words }
    }

    /// Whether no task is in the set.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.words == [0; MAX_TASKS / WORD]
    }

    /// Number of tasks in the set.
    pub fn len(&self) -> usize {
        self.words
            .iter()
            .map(|word| word.count_ones() as usize)
            .sum()
    }

    /// The tasks in list order.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = TaskId> + use<> {
        Members {
            rest: self.words,
            word: 0,
        }
    }
}

/// The members that have not come yet.
struct Members {
    rest: [u64; MAX_TASKS / WORD],
    word: usize,
}

impl Iterator for Members {
    type Item = TaskId;

    #[inline]
    fn next(&mut self) -> Option<TaskId> {
        loop {
            let rest = self.rest.get_mut(self.word)?;
            if *rest != 0 {
                let bit = rest.trailing_zeros() as usize;
                *rest &= *rest - 1;
                return Some(TaskId::new(self.word * WORD + bit));
            }
            self.word += 1;
        }
    }
}

impl FromIterator<TaskId> for ActiveSet {
    fn from_iter<I: IntoIterator<Item = TaskId>>(tasks: I) -> Self {
        let mut set = Self::EMPTY;
        for task in tasks {
            set.insert(task);
        }
        set
    }
}

impl fmt::Debug for ActiveSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set()
            .entries(self.iter().map(TaskId::index))
            .finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_come_back_in_list_order_across_words() {
        let members = [200, 3, 64, 63, 255, 0];
        let set: ActiveSet = members.into_iter().map(TaskId::new).collect();
        let back: alloc::vec::Vec<usize> = set.iter().map(TaskId::index).collect();
        assert_eq!(back, [0, 3, 63, 64, 200, 255]);
        assert_eq!(set.len(), 6);
    }

    #[test]
    fn removing_what_was_inserted_leaves_the_empty_set() {
        let mut set = ActiveSet::EMPTY;
        set.insert(TaskId::new(70));
        assert!(set.contains(TaskId::new(70)) && !set.is_empty());
        set.remove(TaskId::new(70));
        assert_eq!(set, ActiveSet::EMPTY);
    }
}
