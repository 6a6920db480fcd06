//! What the levels above have claimed of the arm's motions, so that lower levels do not undo it.
//!
//! A level claims its rows J: lower levels move only where J q̇ does not change. That is enough while J
//! has all its directions. A level that is about to lose one, at full stretch or against an
//! obstacle, has come to rest with what it asks unmet: with r = s − J q̇ and the multipliers μ of the
//! sides that push back,
//!
//! ```text
//! Jᵀ r + Σ μ a = 0
//! ```
//!
//! A motion v of a lower level along which J does not change *now* turns the left side by T C v,
//! C = Σ r ∇²σ + Σ μ ∇²σ_side, and the level above answers in the next tick with −T C v / d, where
//! d = s² + λ² + l₀² is what it is damped with in the direction that it is losing. Near its rest that
//! undoes all of v, and the arm would bounce with the full speed of the lower level. So such motions
//! are made dear to lower levels,
//!
//! ```text
//! + |K T C v / d|²
//! ```
//!
//! and what is left to them are motions along which the level above stays at rest, to second order.
//! While the level above has what it asks, r, μ and with them C are zero.

use alloc::vec::Vec;

use crate::linalg::{Damped, RowSpace};

/// K: how much dearer a motion is than the answer that it would provoke.
const DEAR: f64 = 100.0;

/// A level that has had its turn.
pub(crate) struct Turn<'a> {
    /// J, row after row.
    pub(crate) jacobian: &'a [f64],
    /// |r| [task's unit/s].
    pub(crate) unmet: f64,
}

#[derive(Debug)]
pub(crate) struct Claims {
    rows: RowSpace,
    /// Rows K T C / d of all levels above.
    dear: Vec<f64>,
    /// J beside what is claimed already and the sides that push back.
    beside: Vec<f64>,
    taken: RowSpace,
    damped: Damped,
    period: f64,
    dof: usize,
}

impl Claims {
    pub(crate) fn new(dof: usize, max_rows: usize, levels: usize, period: f64) -> Self {
        Self {
            rows: RowSpace::new(dof, max_rows),
            dear: Vec::with_capacity(levels * dof * dof),
            beside: Vec::with_capacity(max_rows * dof),
            taken: RowSpace::new(dof, max_rows),
            damped: Damped::new(dof, max_rows),
            period,
            dof,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.rows.truncate(0);
        self.dear.clear();
    }

    /// Rows that lower levels must not move.
    pub(crate) fn rows(&self) -> &RowSpace {
        &self.rows
    }

    /// Rows that lower levels move at a price: the square of how far.
    pub(crate) fn dear(&self) -> &[f64] {
        &self.dear
    }

    /// Claims the rows of a level.
    pub(crate) fn claim(&mut self, jacobian: &[f64]) {
        self.rows.push_block(jacobian);
    }

    /// Claims also that a level stays at rest, if it is losing a direction. `pushing` are the rows of the
    /// sides that push back on it; `curvature` writes C. Comes before [`claim`](Self::claim).
    pub(crate) fn claim_rest<'a>(
        &mut self,
        turn: &Turn<'_>,
        pushing: impl Iterator<Item = &'a [f64]>,
        curvature: impl FnOnce(&mut [f64]),
    ) {
        self.taken.copy_from(&self.rows);
        for row in pushing {
            self.taken.push(row);
        }
        self.beside.clear();
        self.beside.extend_from_slice(turn.jacobian);
        for row in self.beside.chunks_exact_mut(self.dof) {
            self.taken.project_out(row);
        }
        if self.damped.is_regular(&self.beside) {
            return;
        }
        let answer = self.damped.least_squared(&self.beside) + self.period * turn.unmet;
        let start = self.dear.len();
        self.dear.resize(start + self.dof * self.dof, 0.0);
        let rows = &mut self.dear[start..];
        curvature(rows);
        let price = DEAR * self.period / answer;
        for entry in rows {
            *entry *= price;
        }
    }
}
