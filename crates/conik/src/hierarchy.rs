//! The joint velocity of a mode: null-space projections of one level under all levels above.
//!
//! With the rows of the active high-priority sets frozen on top, each further level adds
//! N J⁺ σ̇_ref, N the null-space projector of all rows above it: Eqs. (19) to (34) of the paper
//! (Chiaverini's singularity-robust form, ref. \[23\] there). Siciliano and Slotine's form adds
//! (J N)⁺ (σ̇_ref − J q̇) instead, q̇ being the velocity of the levels above, and is damped where J N
//! loses a direction.

use alloc::vec::Vec;

use crate::active::ActiveSet;
use crate::damping::Damping;
use crate::evaluation::Evaluation;
use crate::linalg::{Damped, MinimumNorm, RowSpace, add_scaled, copy, dot};
use crate::real::sqrt;
use crate::settings::{Recursion, Settings};
use crate::stack::{Goal, Stack};
use crate::task_id::TaskId;

/// Motions up to this length lose less than 1e-13 to rounding where they are projected [rad/s].
const LONG: f64 = 100.0;

#[derive(Debug)]
pub(crate) struct Hierarchy {
    /// Rows that the present candidate freezes, then, while a velocity is put together, the rows of
    /// the levels above the present one.
    above: RowSpace,
    /// J_S⁺ r_S of the frozen rows in the basis of `above`.
    frozen_rates: Vec<f64>,
    minimum_norm: MinimumNorm,
    damped: Damped,
    recursion: Recursion,
    period: f64,
    /// The equality tasks, and the sets below the first of them, in list order.
    lower: Vec<TaskId>,
    /// J⁺ σ̇_ref of each lower level: the same in every mode, so computed once per tick.
    asked: Vec<f64>,
    asked_known: Vec<bool>,
    /// Directions that each lower level had lost in the last velocity.
    lost: Vec<usize>,
    /// σ̇_ref of the level at hand.
    rate: Vec<f64>,
    /// N J⁺ σ̇_ref of the level at hand.
    projected: Vec<f64>,
    /// J N of the level at hand.
    rows: Vec<f64>,
    dof: usize,
}

impl Hierarchy {
    pub(crate) fn new(stack: &Stack, settings: &Settings) -> Self {
        let dof = stack.dof();
        let max_rows = stack
            .iter()
            .map(|(_, l)| l.task().dimension())
            .max()
            .unwrap_or(1);
        let lower: Vec<TaskId> = stack
            .iter()
            .map(|(id, _)| id)
            .filter(|&id| !stack.is_high_priority(id))
            .collect();
        Self {
            above: RowSpace::new(dof, max_rows),
            frozen_rates: alloc::vec![0.0; dof],
            minimum_norm: MinimumNorm::new(dof, max_rows),
            damped: Damped::new(dof, max_rows),
            recursion: settings.recursion,
            period: 1.0 / settings.rate_hz,
            rows: alloc::vec![0.0; max_rows * dof],
            asked: alloc::vec![0.0; lower.len() * dof],
            asked_known: alloc::vec![false; lower.len()],
            lost: alloc::vec![0; lower.len()],
            lower,
            rate: alloc::vec![0.0; max_rows],
            projected: alloc::vec![0.0; dof],
            dof,
        }
    }

    /// Forgets what belonged to another configuration.
    pub(crate) fn begin_tick(&mut self) {
        self.above.truncate(0);
        self.asked_known.fill(false);
    }

    /// Freezes a high-priority set: J q̇ = `rate`, which is zero unless its bound, or the task by
    /// itself, moves. `false` if its row depends on those frozen already: then freezing it changes
    /// nothing.
    pub(crate) fn freeze(
        &mut self,
        stack: &Stack,
        evaluation: &mut Evaluation,
        task: TaskId,
        rate: f64,
    ) -> bool {
        let rank = self.above.rank();
        let row = evaluation.jacobian(stack, task);
        if !self.above.push(row) {
            return false;
        }
        // The new direction q is orthogonal to the rows before it, so those keep their rates.
        let (before, added) = self.frozen_rates.split_at_mut(rank);
        if rate == 0.0 && before.iter().all(|rate| *rate == 0.0) {
            added[0] = 0.0;
            return true;
        }
        let direction = |k: usize| &self.above.basis_from(k)[..self.dof];
        let known: f64 = (0..rank).map(|k| before[k] * dot(row, direction(k))).sum();
        added[0] = (rate - known) / dot(row, direction(rank));
        true
    }

    /// J⁺ σ̇_ref of the one level below the sets, if there is just one and it is projected: the velocity
    /// of every mode is then N of it. `None` before the first velocity of a tick.
    pub(crate) fn asked_of_one_level(&self) -> Option<&[f64]> {
        (self.is_one_projected_level() && self.asked_known[0]).then_some(&self.asked[..])
    }

    /// The first level below the sets is always an equality task, active in every mode.
    #[inline]
    fn is_one_projected_level(&self) -> bool {
        self.recursion == Recursion::Chiaverini && self.lower.len() == 1
    }

    /// The lower levels that had lost directions in the last velocity, and how many.
    pub(crate) fn lost(&self) -> impl Iterator<Item = (TaskId, usize)> {
        let levels = self.lower.iter().copied().zip(self.lost.iter().copied());
        levels.filter(|(_, lost)| *lost > 0)
    }

    /// Number of independent frozen rows.
    pub(crate) fn frozen(&self) -> usize {
        self.above.rank()
    }

    /// Releases what was frozen after there were `frozen` rows.
    pub(crate) fn release_to(&mut self, frozen: usize) {
        self.above.truncate(frozen);
    }

    /// Whether the row of a low-priority set depends on the rows that stand above it when the
    /// high-priority sets of the mode are the frozen ones and its low-priority sets are those in
    /// `active`: then it makes no difference whether the set is active too.
    pub(crate) fn depends(
        &mut self,
        stack: &Stack,
        evaluation: &mut Evaluation,
        task: TaskId,
        active: &ActiveSet,
    ) -> bool {
        let frozen = self.above.rank();
        for &level in self.lower.iter().take_while(|&&level| level != task) {
            if stack[level].interval().is_none() || active.contains(level) {
                self.above.push_block(evaluation.jacobian(stack, level));
            }
        }
        let is_new = self.above.push(evaluation.jacobian(stack, task));
        self.above.truncate(frozen);
        !is_new
    }

    /// The velocity of the mode whose high-priority sets are the frozen ones and whose low-priority
    /// sets are those in `active`.
    pub(crate) fn velocity(
        &mut self,
        stack: &Stack,
        evaluation: &mut Evaluation,
        active: &ActiveSet,
        velocity: &mut [f64],
    ) {
        let frozen = self.above.rank();
        let frozen_rates = &self.frozen_rates[..frozen];
        let mut is_zero = frozen_rates.iter().all(|rate| *rate == 0.0);
        if is_zero && self.is_one_projected_level() {
            self.find_asked(stack, evaluation, 0);
            copy(velocity, &self.asked);
            project_strictly(&self.above, velocity);
            return;
        }
        if !is_zero {
            velocity.fill(0.0);
            for (k, rate) in frozen_rates.iter().enumerate() {
                add_scaled(velocity, *rate, &self.above.basis_from(k)[..self.dof]);
            }
        }
        let mut rows_missing: Option<TaskId> = None;
        for place in 0..self.lower.len() {
            let task = self.lower[place];
            if stack[task].interval().is_some() && !active.contains(task) {
                self.lost[place] = 0;
                continue;
            }
            // The rows of a level are stacked when there is a level below that must respect them.
            if let Some(previous) = rows_missing.replace(task) {
                self.above.push_block(evaluation.jacobian(stack, previous));
            }
            match self.recursion {
                Recursion::Chiaverini => {
                    self.find_asked(stack, evaluation, place);
                    self.add_projected(place, is_zero, velocity);
                }
                Recursion::SicilianoSlotine => {
                    if is_zero {
                        velocity.fill(0.0);
                    }
                    self.add_fitted(stack, evaluation, place, velocity);
                }
            }
            is_zero = false;
        }
        if is_zero {
            velocity.fill(0.0);
        }
        self.above.truncate(frozen);
    }

    /// J⁺ σ̇_ref, once per tick.
    #[inline]
    fn find_asked(&mut self, stack: &Stack, evaluation: &mut Evaluation, place: usize) {
        let asked = &mut self.asked[place * self.dof..][..self.dof];
        if !self.asked_known[place] {
            let task = self.lower[place];
            let rate = rate_asked(stack, evaluation, task, &mut self.rate);
            let jacobian = evaluation.jacobian(stack, task);
            let damping = stack[task]
                .damping()
                .or_else(Damping::of_search(Recursion::Chiaverini));
            self.lost[place] = if damping == Damping::None {
                rate.len() - self.minimum_norm.solve(jacobian, rate, asked)
            } else {
                asked.fill(0.0);
                let variable = self.period * sqrt(dot(rate, rate));
                self.damped.add(damping, jacobian, rate, variable, asked);
                self.damped.lost()
            };
            self.asked_known[place] = true;
        }
    }

    /// q̇ += N J⁺ σ̇_ref
    #[inline]
    fn add_projected(&mut self, place: usize, is_zero: bool, velocity: &mut [f64]) {
        let asked = &self.asked[place * self.dof..][..self.dof];
        if is_zero {
            copy(velocity, asked);
            project_strictly(&self.above, velocity);
        } else {
            copy(&mut self.projected, asked);
            self.add_strictly_below(velocity);
        }
    }

    /// q̇ += N v for the motion v at hand.
    fn add_strictly_below(&mut self, velocity: &mut [f64]) {
        project_strictly(&self.above, &mut self.projected);
        add_scaled(velocity, 1.0, &self.projected);
    }

    /// q̇ += (J N)⁺ (σ̇_ref − J q̇)
    fn add_fitted(
        &mut self,
        stack: &Stack,
        evaluation: &mut Evaluation,
        place: usize,
        velocity: &mut [f64],
    ) {
        let task = self.lower[place];
        let gap = rate_asked(stack, evaluation, task, &mut self.rate);
        let variable = self.period * sqrt(dot(gap, gap));
        let jacobian = evaluation.jacobian(stack, task);
        let rows = &mut self.rows[..jacobian.len()];
        rows.copy_from_slice(jacobian);
        for (gap, row) in gap.iter_mut().zip(rows.chunks_exact_mut(self.dof)) {
            *gap -= dot(row, velocity);
            self.above.project_out(row);
        }
        self.projected.fill(0.0);
        let motion = &mut self.projected;
        let damping = stack[task]
            .damping()
            .or_else(Damping::of_search(Recursion::SicilianoSlotine));
        let is_fixed = matches!(damping, Damping::Fixed(_));
        if is_fixed || self.damped.add_if_regular(rows, gap, motion).is_none() {
            self.damped.add(damping, rows, gap, variable, motion);
        }
        self.lost[place] = self.damped.lost();
        self.add_strictly_below(velocity);
    }
}

/// v ← N v. Near a singularity v may be so long that rounding leaves something of the rows above in N v;
/// the second time takes that out.
#[inline]
fn project_strictly(above: &RowSpace, v: &mut [f64]) {
    let is_long = dot(v, v) > LONG * LONG;
    above.project_out(v);
    if is_long {
        above.project_out(v);
    }
}

/// σ̇_ref of a level, as many entries as it has components.
fn rate_asked<'a>(
    stack: &Stack,
    evaluation: &Evaluation,
    task: TaskId,
    rate: &'a mut [f64],
) -> &'a mut [f64] {
    let rate = &mut rate[..stack[task].task().dimension()];
    match stack[task].goal() {
        Goal::Equality {
            desired_rate, gain, ..
        } => {
            let feed_forward = &desired_rate[..rate.len()];
            let errors = &evaluation.errors().of(task)[..rate.len()];
            for k in 0..rate.len() {
                rate[k] = feed_forward[k] + gain * errors[k];
            }
        }
        Goal::Set {
            interval,
            rates,
            gain,
            ..
        } => {
            // Eq. (28): towards the bound that was crossed. `Stack` insists on the gain.
            let sigma = evaluation.scalar(task);
            let (bound, moves) = if interval.is_nearer_to_min(sigma) {
                (interval.min, rates.min)
            } else {
                (interval.max, rates.max)
            };
            rate[0] = moves + gain.unwrap_or(0.0) * (bound - sigma);
        }
    }
    if evaluation.is_any_drifting() {
        for (rate, drift) in rate.iter_mut().zip(evaluation.drifts().of(task)) {
            *rate -= drift;
        }
    }
    rate
}
