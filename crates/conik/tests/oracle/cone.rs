//! The first tick of the rule `cone`, level by level: the program of each level with dense matrices, from
//! its definition, solved by an interior point.
//!
//! A fresh controller holds nothing yet and knows no multipliers, so its first tick follows from the
//! configuration alone.

use conik::Recursion;
use nalgebra::{DMatrix, DVector};

use super::arm::Arm;
use super::enumeration::within_speed_limit;
use super::program::{Answer, Failure, Program, null_space, row_space, stacked};
use super::{Goal, Task, high_priority};

/// l₀ and ε of the damping.
const STRICT: f64 = 1e-3;
const SINGULAR: f64 = 0.2;
/// Least λ² of a level below others.
const LOWER: f64 = 0.04;
/// What sets are held inside their bounds with border `land` [task's unit].
const MARGIN: f64 = 1e-7;
/// A held side moves inward if it is faster than this [unit/s].
const INWARD: f64 = 1e-7;

/// What a scene asks the oracle.
pub struct Scene<'a> {
    pub arm: &'a Arm,
    pub tasks: &'a [Task],
    pub recursion: Recursion,
    /// Border `land` instead of `freeze`.
    pub land: bool,
    pub period: f64,
}

/// What the rule prescribes.
pub struct Prescribed {
    /// q̇ before it lands, within the speed limits.
    pub qd: DVector<f64>,
    /// A bit for each active task; `None` where the rows that bind depend on each other, so that
    /// several choices of them hold the same.
    pub active: Option<u32>,
    /// Whether a row neither pushes nor has room, so that rounding decides whether it is active.
    pub is_unclear: bool,
    /// The one-sided rows that every level kept.
    pub rows: DMatrix<f64>,
    pub bounds: Vec<f64>,
}

/// One side of a set: a q̇ ≥ b.
struct Side {
    task: usize,
    row: DMatrix<f64>,
    bound: f64,
    is_held: bool,
}

/// R = l₀² I + λ² (I − P − Σ wⱼ yⱼ yⱼᵀ), yⱼ and sⱼ from the eigenvectors of AᵀA, wⱼ = min(1, (sⱼ / ε)²).
pub fn damping(usable: &DMatrix<f64>, held: &DMatrix<f64>, lambda_squared: f64) -> DMatrix<f64> {
    let dof = usable.ncols();
    let eigen = (usable.transpose() * usable).symmetric_eigen();
    let mut damped = DMatrix::identity(dof, dof) - held;
    for (squared, direction) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        let weight = (squared.max(0.0) / (SINGULAR * SINGULAR)).min(1.0);
        damped -= direction * direction.transpose() * weight;
    }
    DMatrix::identity(dof, dof) * (STRICT * STRICT) + damped * lambda_squared
}

/// Jᵀ (J Jᵀ + shift I)⁻¹ s, or J⁺ s where nothing has to be damped.
fn least_squares(jacobian: &DMatrix<f64>, asked: &DVector<f64>, period: f64) -> DVector<f64> {
    let count = jacobian.nrows();
    let gram = jacobian * jacobian.transpose();
    let least = gram.clone().symmetric_eigen().eigenvalues.min().max(0.0);
    let shift = if least > SINGULAR * SINGULAR {
        0.0
    } else {
        let lambda_squared = period * asked.norm();
        lambda_squared * (1.0 - least / (SINGULAR * SINGULAR)) + STRICT * STRICT
    };
    let gram = gram + DMatrix::identity(count, count) * shift;
    jacobian.transpose() * gram.cholesky().expect("positive definite").solve(asked)
}

/// A level: what it asks, and what is above it.
struct Level<'a> {
    scene: &'a Scene<'a>,
    jacobian: &'a DMatrix<f64>,
    asked: DVector<f64>,
    from: &'a DVector<f64>,
    above: &'a DMatrix<f64>,
    sides: &'a [Side],
}

impl Level<'_> {
    /// The level's program; `held` are the sides that the damping counts on.
    fn solve(&self, held: &[usize], equal: &[usize]) -> Result<Answer, Failure> {
        let dof = self.from.len();
        let free = null_space(self.above);
        let (hessian, minimiser) = if self.scene.recursion == Recursion::Chiaverini {
            let motion = least_squares(self.jacobian, &self.asked, self.scene.period);
            let size = free.ncols();
            (DMatrix::identity(size, size), free.transpose() * motion)
        } else {
            let held = self.rows_of(held);
            let above = row_space(self.above);
            let taken = row_space(&stacked(&above, &held));
            let on_taken = taken.transpose() * &taken;
            let on_held = &on_taken - above.transpose() * &above;
            let usable = self.jacobian * (DMatrix::identity(dof, dof) - &on_taken);
            let least = if self.above.nrows() > 0 { LOWER } else { 0.0 };
            let lambda_squared = (self.scene.period * self.asked.norm()).max(least);
            let weight = damping(&usable, &on_held, lambda_squared);
            let rows = self.jacobian * &free;
            let hessian = rows.transpose() * &rows + free.transpose() * weight * &free;
            let gap = &self.asked - self.jacobian * self.from;
            let pull = rows.transpose() * gap;
            let factor = hessian.clone().cholesky().expect("positive definite");
            (hessian, factor.solve(&pull))
        };
        let all: Vec<usize> = (0..self.sides.len()).collect();
        let rows = self.rows_of(&all);
        let bounds: Vec<f64> = self.sides.iter().map(|side| side.bound).collect();
        let answer = Program {
            hessian: &hessian,
            from: &minimiser,
            rows: &(&rows * &free),
            bounds: &(DVector::from_vec(bounds) - rows * self.from),
            equal,
        }
        .solve()?;
        Ok(Answer {
            x: self.from + free * answer.x,
            ..answer
        })
    }

    /// Whether the level has lost a direction and asks for something in it: the levels below then let it
    /// rest, by the second derivatives of its task, which are not in this definition.
    fn rests(&self, answer: &Answer) -> bool {
        let dof = self.from.len();
        let taken = row_space(&stacked(self.above, &self.rows_of(&answer.binding)));
        let usable = self.jacobian * (DMatrix::identity(dof, dof) - taken.transpose() * &taken);
        let least = (&usable * usable.transpose()).symmetric_eigenvalues().min();
        least < SINGULAR * SINGULAR * (1.0 + 1e-6)
    }

    fn rows_of(&self, sides: &[usize]) -> DMatrix<f64> {
        let none = DMatrix::zeros(0, self.from.len());
        sides
            .iter()
            .fold(none, |rows, &i| stacked(&rows, &self.sides[i].row))
    }

    /// The level's answer: what the damping counted on and the answer releases is counted on no more,
    /// unless it would then be held again; then it is held.
    fn descend(&self, is_unclear: &mut bool) -> Result<Answer, Failure> {
        let held = |i: &usize| self.sides[*i].is_held;
        let counted_on: Vec<usize> = (0..self.sides.len()).filter(held).collect();
        // Of rows that depend on each other, several choices hold the same.
        let rows = self.rows_of(&counted_on);
        *is_unclear |= row_space(&rows).nrows() < rows.nrows();
        let first = self.solve(&counted_on, &[])?;
        *is_unclear |= first.is_unclear;
        if self.scene.recursion == Recursion::Chiaverini {
            return Ok(first);
        }
        let (mut released, mut remaining) = (Vec::new(), Vec::new());
        for &i in &counted_on {
            let speed = (&self.sides[i].row * &first.x)[0] - self.sides[i].bound;
            *is_unclear |= (speed - INWARD).abs() < INWARD / 2.0;
            if speed > INWARD && !first.binding.contains(&i) {
                released.push(i);
            } else {
                remaining.push(i);
            }
        }
        if released.is_empty() {
            return Ok(first);
        }
        let second = self.solve(&remaining, &[])?;
        *is_unclear |= second.is_unclear;
        let returning: Vec<usize> = second
            .binding
            .iter()
            .copied()
            .filter(|i| counted_on.contains(i))
            .collect();
        if !returning.iter().any(|i| released.contains(i)) {
            return Ok(second);
        }
        let third = self.solve(&counted_on, &returning)?;
        *is_unclear |= third.is_unclear;
        Ok(third)
    }
}

impl Scene<'_> {
    /// b of a side of a high-priority set `inside` within its bound; `None` if it binds nothing.
    fn bound(&self, inside: f64) -> Option<f64> {
        if !self.land {
            return (inside <= 0.0).then_some(0.0);
        }
        // A set that has not been entered is held where it is.
        inside.is_finite().then(|| match inside {
            outside if outside < 0.0 => 0.0,
            inside => ((MARGIN - inside) / self.period).min(0.0),
        })
    }

    /// The sides of the high-priority sets that bind.
    fn high_priority_sides(&self, measured: &[(DVector<f64>, DMatrix<f64>)]) -> Vec<Side> {
        let mut sides = Vec::new();
        for (i, task) in self
            .tasks
            .iter()
            .enumerate()
            .take(high_priority(self.tasks))
        {
            let (min, max) = task.bounds().expect("a set");
            let (sigma, row) = (measured[i].0[0], &measured[i].1);
            for (inside, row) in [(sigma - min, row.clone()), (max - sigma, -row)] {
                if let Some(bound) = self.bound(inside) {
                    sides.push(Side {
                        task: i,
                        row,
                        bound,
                        is_held: false,
                    });
                }
            }
        }
        sides
    }

    /// The first tick at `q`.
    pub fn first_tick(&self, q: &[f64]) -> Result<Prescribed, Failure> {
        let measured: Vec<_> = self
            .tasks
            .iter()
            .map(|task| self.arm.measure(task.measure, q))
            .collect();
        let first_equality = high_priority(self.tasks);
        let mut sides = self.high_priority_sides(&measured);
        let mut qd = DVector::zeros(self.arm.dof());
        let mut above = DMatrix::zeros(0, self.arm.dof());
        let mut active = 0;
        let mut is_unclear = false;
        let mut one_rests = false;
        for (i, task) in self.tasks.iter().enumerate().skip(first_equality) {
            let (sigma, jacobian) = &measured[i];
            let asked = match &task.goal {
                Goal::Equality(desired) => {
                    (DVector::from_column_slice(desired) - sigma) * task.gain
                }
                &Goal::Set(min, max) => {
                    let rate = (jacobian * &qd)[0];
                    let lower = (sigma[0] - min, 1.0);
                    let upper = (max - sigma[0], -1.0);
                    let mut asked = None;
                    for (inside, sign) in [lower, upper] {
                        let kept = if inside < 0.0 {
                            0.0
                        } else {
                            -inside / self.period
                        };
                        is_unclear |= (sign * rate - kept).abs() < 1e-9;
                        if sign * rate < kept {
                            active |= 1 << i;
                            let back = if inside < 0.0 {
                                -task.gain * inside
                            } else {
                                kept
                            };
                            asked = Some(DVector::from_element(1, sign * back));
                            break;
                        }
                        if kept.is_finite() {
                            sides.push(Side {
                                task: i,
                                row: jacobian * sign,
                                bound: kept,
                                is_held: false,
                            });
                        }
                    }
                    let Some(asked) = asked else { continue };
                    asked
                }
            };
            let level = Level {
                scene: self,
                jacobian,
                asked,
                from: &qd,
                above: &above,
                sides: &sides,
            };
            is_unclear |= one_rests;
            match level.descend(&mut is_unclear) {
                Ok(answer) => {
                    one_rests |=
                        self.recursion == Recursion::SicilianoSlotine && level.rests(&answer);
                    qd = answer.x;
                    for i in answer.binding {
                        sides[i].is_held = true;
                    }
                }
                Err(Failure::Infeasible) => {}
                Err(Failure::Undecided) => return Err(Failure::Undecided),
            }
            above = stacked(&above, jacobian);
        }
        for side in sides.iter().filter(|side| side.is_held) {
            active |= 1 << side.task;
        }
        let none = || DMatrix::zeros(0, self.arm.dof());
        let held = sides.iter().filter(|side| side.is_held);
        let held = held.fold(none(), |rows, side| stacked(&rows, &side.row));
        Ok(Prescribed {
            qd: within_speed_limit(qd),
            active: (row_space(&held).nrows() == held.nrows()).then_some(active),
            is_unclear,
            rows: sides
                .iter()
                .fold(none(), |rows, side| stacked(&rows, &side.row)),
            bounds: sides.iter().map(|side| side.bound).collect(),
        })
    }
}
