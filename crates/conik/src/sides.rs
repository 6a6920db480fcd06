//! One-sided rows of set-based tasks: how far inside a bound a task is, and how it moves there.
//!
//! The lower side of a set is a = J, the upper one a = −J; `inside` is the distance to the bound in
//! force, positive inside. With period T the next value is inside, to first order, if
//! a q̇ ≥ (m − inside) / T, m being the margin that sets are held inside.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::border::MARGIN;
use crate::cone::Interval;
use crate::evaluation::Evaluation;
use crate::linalg::copy;
use crate::stack::Stack;
use crate::task_id::TaskId;

/// One side of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Side {
    pub(crate) task: TaskId,
    pub(crate) is_upper: bool,
}

impl Side {
    /// Both sides of a task.
    pub(crate) fn both(task: TaskId) -> [Self; 2] {
        [false, true].map(|is_upper| Self { task, is_upper })
    }

    /// Distance from a value to this side of a set, positive inside.
    #[inline]
    pub(crate) fn inside(self, set: &Interval, sigma: f64) -> f64 {
        if self.is_upper {
            set.max - sigma
        } else {
            sigma - set.min
        }
    }

    /// A rate of σ as a rate into the set.
    #[inline]
    pub(crate) fn inward(self, rate: f64) -> f64 {
        if self.is_upper { -rate } else { rate }
    }

    /// A number for each side of each task.
    pub(crate) fn number(self) -> usize {
        2 * self.task.index() + usize::from(self.is_upper)
    }
}

/// Which sides are held: a set of sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Held {
    lower: ActiveSet,
    upper: ActiveSet,
}

impl Held {
    pub(crate) fn contains(&self, side: Side) -> bool {
        if side.is_upper {
            self.upper.contains(side.task)
        } else {
            self.lower.contains(side.task)
        }
    }

    pub(crate) fn insert(&mut self, side: Side) {
        if side.is_upper {
            self.upper.insert(side.task);
        } else {
            self.lower.insert(side.task);
        }
    }

    pub(crate) fn remove(&mut self, side: Side) {
        if side.is_upper {
            self.upper.remove(side.task);
        } else {
            self.lower.remove(side.task);
        }
    }

    #[must_use]
    pub(crate) fn union(&self, other: &Self) -> Self {
        Self {
            lower: self.lower.union(&other.lower),
            upper: self.upper.union(&other.upper),
        }
    }

    #[must_use]
    pub(crate) fn without(&self, other: &Self) -> Self {
        Self {
            lower: self.lower.without(&other.lower),
            upper: self.upper.without(&other.upper),
        }
    }

    /// The tasks of which a side is held.
    pub(crate) fn tasks(&self) -> ActiveSet {
        self.lower.union(&self.upper)
    }
}

/// The sides that matter in a tick, with their rows.
#[derive(Debug)]
pub(crate) struct Sides {
    list: Vec<Side>,
    /// Room for the rows of all sides; those of `list` stand first.
    rows: Vec<f64>,
    dof: usize,
}

impl Sides {
    pub(crate) fn new(stack: &Stack) -> Self {
        let sets = stack
            .iter()
            .filter(|(_, level)| level.interval().is_some())
            .count();
        Self {
            list: Vec::with_capacity(2 * sets),
            rows: alloc::vec![0.0; 2 * sets * stack.dof()],
            dof: stack.dof(),
        }
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
    }

    /// Adds a side with its row.
    pub(crate) fn push(&mut self, stack: &Stack, evaluation: &mut Evaluation, side: Side) {
        let jacobian = evaluation.jacobian(stack, side.task);
        let row = &mut self.rows[self.list.len() * self.dof..][..self.dof];
        self.list.push(side);
        copy(row, jacobian);
        if side.is_upper {
            for entry in row {
                *entry = -*entry;
            }
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (Side, &[f64])> {
        self.list
            .iter()
            .copied()
            .zip(self.rows.chunks_exact(self.dof))
    }

    pub(crate) fn get(&self, i: usize) -> Side {
        self.list[i]
    }

    /// The row that was added last.
    pub(crate) fn last_row(&self) -> &[f64] {
        &self.rows[(self.list.len() - 1) * self.dof..][..self.dof]
    }

    pub(crate) fn rows(&self) -> &[f64] {
        &self.rows[..self.list.len() * self.dof]
    }
}

/// The rate [unit/s] at which a side is `MARGIN` inside at the end of the period, to first order.
#[inline]
pub(crate) fn landing_rate(inside: f64, period: f64) -> f64 {
    (MARGIN - inside) / period
}
