//! What the levels above have claimed of the arm's motions, so that lower levels do not undo it.
//!
//! A level claims its rows J: lower levels move only where J q̇ does not change. That is enough while J
//! has all its directions. A level that is about to lose one, at full stretch, against an obstacle or
//! to the levels above, has come to rest with what it asks unmet: with r = s − J q̇, the multipliers μ
//! of the sides that push back and ν of the rows A of the levels above,
//!
//! ```text
//! Jᵀ r + Σ μ a + Aᵀ ν = 0
//! ```
//!
//! A motion v of a lower level along which no row changes *now* turns the left side by T C v,
//! C = Σ r ∇²σ + Σ μ ∇²σ_side + Σ ν ∇²σ_above, and the level answers in the next tick with −T C v / d,
//! where d = s² + λ² + l₀² is what it is damped with in the direction that it is losing. Near its rest
//! that undoes all of v, and the arm would bounce with the full speed of the lower level. So such
//! motions are made dear to lower levels,
//!
//! ```text
//! + |K T C v / d|²
//! ```
//!
//! and what is left to them are motions along which the level stays at rest, to second order. While
//! it has what it asks, r, μ and ν are zero, and C with them.

use alloc::vec::Vec;

use crate::kinematics::Kinematics;
use crate::linalg::{Damped, RowSpace, add_scaled, dot};
use crate::real::sqrt;
use crate::sides::{Side, Sides};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// K: how much dearer a motion is than the answer that it would provoke.
const DEAR: f64 = 100.0;

/// A level that has had its turn.
pub(crate) struct Turn<'a> {
    pub(crate) task: TaskId,
    /// J, row after row.
    pub(crate) jacobian: &'a [f64],
    /// r [task's unit/s].
    pub(crate) unmet: &'a [f64],
}

#[derive(Debug)]
pub(crate) struct Claims {
    rows: RowSpace,
    /// The levels that have claimed, and all their rows as they are.
    levels: Vec<TaskId>,
    stacked: Vec<f64>,
    /// Rows K T C / d of all levels above.
    dear: Vec<f64>,
    /// J beside what is claimed already and the sides that push back.
    beside: Vec<f64>,
    taken: RowSpace,
    /// Jᵀ r + Σ μ a.
    gradient: Vec<f64>,
    /// ν, row by row.
    multipliers: Vec<f64>,
    damped: Damped,
    period: f64,
    dof: usize,
}

impl Claims {
    /// For the levels `lower`, the largest of which has `max_rows` rows.
    pub(crate) fn new(stack: &Stack, lower: &[TaskId], max_rows: usize, period: f64) -> Self {
        let dof = stack.dof();
        let all_rows = lower
            .iter()
            .map(|&task| stack[task].task().dimension())
            .sum();
        Self {
            rows: RowSpace::new(dof, max_rows),
            levels: Vec::with_capacity(lower.len()),
            stacked: Vec::with_capacity(all_rows * dof),
            dear: Vec::with_capacity(lower.len() * dof * dof),
            beside: Vec::with_capacity(max_rows * dof),
            taken: RowSpace::new(dof, max_rows),
            gradient: Vec::with_capacity(dof),
            multipliers: Vec::with_capacity(all_rows),
            damped: Damped::new(dof, all_rows),
            period,
            dof,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.rows.truncate(0);
        self.levels.clear();
        self.stacked.clear();
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
    pub(crate) fn claim(&mut self, turn: &Turn<'_>) {
        self.rows.push_block(turn.jacobian);
        self.levels.push(turn.task);
        self.stacked.extend_from_slice(turn.jacobian);
    }

    /// Claims also that a level stays at rest, if it is losing a direction. `multipliers` says, for a
    /// side, how hard it pushes back on the level; not at all if it is not positive. Comes before
    /// [`claim`](Self::claim).
    pub(crate) fn claim_rest(
        &mut self,
        stack: &Stack,
        kinematics: &Kinematics,
        turn: &Turn<'_>,
        sides: &Sides,
        multiplier: impl Fn(Side) -> f64,
    ) {
        let pushing = || {
            let pushes = sides
                .iter()
                .map(|(side, row)| (side, row, multiplier(side)));
            pushes.filter(|(_, _, push)| *push > 0.0)
        };
        self.taken.copy_from(&self.rows);
        for (_, row, _) in pushing() {
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
        let unmet = sqrt(dot(turn.unmet, turn.unmet));
        let answer = self.damped.least_squared(&self.beside) + self.period * unmet;
        self.gradient.clear();
        self.gradient.resize(self.dof, 0.0);
        for (row, unmet) in turn.jacobian.chunks_exact(self.dof).zip(turn.unmet) {
            add_scaled(&mut self.gradient, *unmet, row);
        }
        for (_, row, push) in pushing() {
            add_scaled(&mut self.gradient, push, row);
        }
        self.damped
            .balance(&self.stacked, &self.gradient, &mut self.multipliers);
        let start = self.dear.len();
        self.dear.resize(start + self.dof * self.dof, 0.0);
        let rows = &mut self.dear[start..];
        let mut add = |task: TaskId, weights: &[f64]| {
            let task = stack[task].task();
            task.add_curvature(kinematics, weights, rows);
        };
        add(turn.task, turn.unmet);
        for (side, _, push) in pushing() {
            add(side.task, &[side.inward(push)]);
        }
        let mut multipliers = &self.multipliers[..];
        for &level in &self.levels {
            let (its, others) = multipliers.split_at(stack[level].task().dimension());
            add(level, its);
            multipliers = others;
        }
        // The level answers only where sides and the levels above leave it free: P C, P = I − those.
        for row in rows.chunks_exact_mut(self.dof) {
            self.taken.project_out(row);
        }
        transpose(rows, self.dof);
        let price = DEAR * self.period / answer;
        for entry in rows {
            *entry *= price;
        }
    }
}

fn transpose(square: &mut [f64], n: usize) {
    for i in 0..n {
        for j in 0..i {
            square.swap(i * n + j, j * n + i);
        }
    }
}
