//! The numbers of the modes, as the paper prints them.
//!
//! Fewest active sets first, then list order, struck-out modes not counted: in Example 2, {} is
//! mode 1, {a} 2, {b} 3, {c} 4, {a, c} 5 and {b, c} 6, because {a, b} and {a, b, c} are struck out.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::stack::Stack;
use crate::task_id::TaskId;

/// How many branches a count may take before it is given up. Exclusions among few tasks need a
/// handful; no count should hold up a program for a number that only people read.
const MOST_BRANCHES: usize = 100_000;

/// Numbers the modes of a stack.
#[derive(Clone, Debug)]
pub struct ModeOrder {
    sets: Vec<SetTask>,
}

#[derive(Clone, Debug)]
struct SetTask {
    id: TaskId,
    excluded: ActiveSet,
}

impl ModeOrder {
    /// The order for the set-based tasks and exclusions of a stack.
    pub fn new(stack: &Stack) -> Self {
        let sets = stack
            .iter()
            .filter(|(_, level)| level.interval().is_some())
            .map(|(id, level)| SetTask {
                id,
                excluded: *level.excluded(),
            })
            .collect();
        Self { sets }
    }

    /// 1-based number of the mode in which just these tasks are active. `None` if it is struck out
    /// (the rule `Cone` heeds no exclusions), if it does not fit 64 bits, or if the exclusions are
    /// too entangled to be counted.
    pub fn number(&self, active: &ActiveSet) -> Option<u64> {
        let members = || self.sets.iter().filter(|set| active.contains(set.id));
        if members().any(|set| set.excluded.intersects(active)) {
            return None;
        }
        let size = active.len();
        let mut count = Count {
            sets: &self.sets,
            branches: 0,
        };
        let mut before = 0_u64;
        for smaller in 0..size {
            before = before.checked_add(count.subsets(smaller, 0, ActiveSet::EMPTY)?)?;
        }
        let mut closed = ActiveSet::EMPTY;
        let mut missing = size;
        for (i, set) in self.sets.iter().enumerate() {
            if missing == 0 {
                break;
            }
            if active.contains(set.id) {
                closed = closed.union(&set.excluded);
                missing -= 1;
            } else if !closed.contains(set.id) {
                // Every mode that has this task instead, with what it shares with `active` so far.
                let closed_with = closed.union(&set.excluded);
                before = before.checked_add(count.subsets(missing - 1, i + 1, closed_with)?)?;
            }
        }
        before.checked_add(1)
    }

    /// Number of modes; `None` if it does not fit 64 bits, or if the exclusions are too entangled to
    /// be counted.
    pub fn count(&self) -> Option<u64> {
        let mut count = Count {
            sets: &self.sets,
            branches: 0,
        };
        (0..=self.sets.len()).try_fold(0_u64, |sum, size| {
            sum.checked_add(count.subsets(size, 0, ActiveSet::EMPTY)?)
        })
    }
}

struct Count<'a> {
    sets: &'a [SetTask],
    branches: usize,
}

impl Count<'_> {
    /// Number of ways to choose `size` tasks from number `from` on, none of them in `closed` and no
    /// two excluding each other.
    fn subsets(&mut self, size: usize, from: usize, closed: ActiveSet) -> Option<u64> {
        self.branches += 1;
        if self.branches > MOST_BRANCHES {
            return None;
        }
        let open = |set: &&SetTask| !closed.contains(set.id);
        let open_set: ActiveSet = self.sets[from..]
            .iter()
            .filter(open)
            .map(|set| set.id)
            .collect();
        let entangled = self.sets[from..]
            .iter()
            .filter(open)
            .find(|set| set.excluded.intersects(&open_set));
        let Some(set) = entangled else {
            return binomial(open_set.len(), size);
        };
        // Without the entangled task, and with it.
        let mut without = closed;
        without.insert(set.id);
        let with = without.union(&set.excluded);
        let fewer = match size {
            0 => 0,
            _ => self.subsets(size - 1, from, with)?,
        };
        self.subsets(size, from, without)?.checked_add(fewer)
    }
}

fn binomial(n: usize, k: usize) -> Option<u64> {
    if k > n {
        return Some(0);
    }
    let mut value = 1_u128;
    for i in 0..k.min(n - k) {
        // Exact: the product of i + 1 consecutive numbers is divisible by (i + 1)!.
        value = value.checked_mul((n - i) as u128)? / (i as u128 + 1);
    }
    u64::try_from(value).ok()
}
