//! The rules `paper` and `border` by full enumeration: all 2ⁿ modes, Moore-Penrose pseudoinverses by the
//! eigenvectors of JᵀJ.

use std::cell::Cell;

use conik::Recursion;
use nalgebra::{DMatrix, DVector};

use super::arm::{Arm, SPEED_LIMIT};
use super::cone::damping;
use super::program::stacked;
use super::{Goal, Task, high_priority};

/// A task that changes slower than this [unit/s] stands still.
const STILL: f64 = 1e-12;

/// The pseudoinverse (JᵀJ)⁺ Jᵀ. Lowers `conditioning` to the smallest ratio of a singular value that counts
/// to the largest one.
fn pinv(matrix: &DMatrix<f64>, conditioning: &Cell<f64>) -> DMatrix<f64> {
    if matrix.nrows() == 0 {
        return DMatrix::zeros(matrix.ncols(), 0);
    }
    let eigen = (matrix.transpose() * matrix).symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let mut inverse = DMatrix::zeros(matrix.ncols(), matrix.ncols());
    for (value, vector) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        if *value > 1e-12 * largest {
            conditioning.set(conditioning.get().min((value / largest).sqrt()));
            inverse += vector * vector.transpose() / *value;
        }
    }
    inverse * matrix.transpose()
}

/// What a scene asks the oracle.
pub struct Scene<'a> {
    pub arm: &'a Arm,
    pub tasks: &'a [Task],
    /// Pairs of sets that may not be active together.
    pub exclusive: &'a [(usize, usize)],
    /// Only sets at or outside their border may be active.
    pub border: bool,
    pub recursion: Recursion,
    pub period: f64,
}

type Measured = [(DVector<f64>, DMatrix<f64>)];

impl Scene<'_> {
    /// Velocity of a mode: N J⁺ σ̇_ref or (J N)⁺ (σ̇_ref − J q̇) for each level, N from the stacked rows above.
    fn velocity(&self, measured: &Measured, active: u32, conditioning: &Cell<f64>) -> DVector<f64> {
        let dof = self.arm.dof();
        let first_equality = high_priority(self.tasks);
        let mut above = DMatrix::zeros(0, dof);
        for (i, (_, jacobian)) in measured.iter().enumerate().take(first_equality) {
            if active & 1 << i != 0 {
                above = stacked(&above, jacobian);
            }
        }
        let mut sum = DVector::zeros(dof);
        for (i, task) in self.tasks.iter().enumerate().skip(first_equality) {
            let (sigma, jacobian) = &measured[i];
            let error = match &task.goal {
                Goal::Equality(desired) => DVector::from_column_slice(desired) - sigma,
                Goal::Set(..) if active & 1 << i == 0 => continue,
                &Goal::Set(min, max) => {
                    let sigma = sigma[0];
                    let nearest = if (sigma - min).abs() < (sigma - max).abs() {
                        min
                    } else {
                        max
                    };
                    DVector::from_element(1, nearest - sigma)
                }
            };
            let asked = error * task.gain;
            let null = DMatrix::identity(dof, dof) - pinv(&above, conditioning) * &above;
            sum += if self.recursion == Recursion::Chiaverini {
                null * pinv(jacobian, conditioning) * asked
            } else {
                let rows = jacobian * &null;
                let nothing = DMatrix::zeros(dof, dof);
                let weight = damping(&rows, &nothing, self.period * asked.norm());
                let normal = rows.transpose() * &rows + weight;
                let pull = rows.transpose() * (asked - jacobian * &sum);
                // Frozen rows move by what rounding leaves, 1e-16 / l₀², unless it is taken out.
                null * normal.cholesky().expect("positive definite").solve(&pull)
            };
            above = stacked(&above, jacobian);
        }
        sum
    }

    /// The modes in the order "fewest active, then list order".
    fn modes(&self) -> Vec<Vec<usize>> {
        let sets: Vec<usize> = (0..self.tasks.len())
            .filter(|&i| self.tasks[i].bounds().is_some())
            .collect();
        let members = |bits: u32| {
            let chosen = (0..sets.len()).filter(move |k| bits & 1 << k != 0);
            chosen.map(|k| sets[k]).collect::<Vec<_>>()
        };
        let allowed = |mode: &Vec<usize>| {
            let both = |&(a, b): &(usize, usize)| mode.contains(&a) && mode.contains(&b);
            !self.exclusive.iter().any(both)
        };
        let mut modes: Vec<_> = (0_u32..1 << sets.len())
            .map(members)
            .filter(allowed)
            .collect();
        modes.sort_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
        modes
    }

    /// Whether the rule allows a task to be active at `q`.
    pub fn may_be_active(&self, task: usize, q: &[f64]) -> bool {
        self.tasks[task].bounds().is_some_and(|(min, max)| {
            let sigma = self.arm.measure(self.tasks[task].measure, q).0[0];
            !self.border || sigma <= min || sigma >= max
        })
    }

    /// The first mode that keeps every inactive set.
    pub fn step(&self, q: &[f64]) -> Prescribed {
        let conditioning = Cell::new(1.0);
        let measured: Vec<_> = self
            .tasks
            .iter()
            .map(|task| self.arm.measure(task.measure, q))
            .collect();
        let is_inside = |i: usize| {
            let (min, max) = self.tasks[i].bounds().expect("a set");
            measured[i].0[0] > min && measured[i].0[0] < max
        };
        for mode in self.modes() {
            if self.border && mode.iter().any(|&i| is_inside(i)) {
                continue;
            }
            let active = mode.iter().fold(0, |bits, i| bits | 1 << i);
            let f = self.velocity(&measured, active, &conditioning);
            let passes = |i: usize| {
                let Some((min, max)) = self.tasks[i].bounds() else {
                    return true;
                };
                let sigma = measured[i].0[0];
                let rate = (&measured[i].1 * &f)[0];
                if (STILL * 0.1..STILL * 100.0).contains(&rate.abs()) {
                    conditioning.set(0.0);
                }
                let rate = if rate.abs() <= STILL { 0.0 } else { rate };
                mode.contains(&i)
                    || is_inside(i)
                    || (sigma <= min && rate >= 0.0)
                    || (sigma >= max && rate <= 0.0)
            };
            if (0..self.tasks.len()).all(passes) {
                return Prescribed {
                    active: Some(active),
                    qd: within_speed_limit(f),
                    conditioning: conditioning.get(),
                };
            }
        }
        Prescribed {
            active: None,
            qd: DVector::zeros(self.arm.dof()),
            conditioning: conditioning.get(),
        }
    }
}

/// What the method prescribes at one configuration.
pub struct Prescribed {
    /// A bit for each active task; `None` if the exclusions leave no mode.
    pub active: Option<u32>,
    pub qd: DVector<f64>,
    /// Smallest ratio of a singular value to the largest one of its matrix: what rounding is
    /// magnified by. 0 where rounding decides whether a task stands still.
    pub conditioning: f64,
}

/// The whole velocity, scaled so that no joint exceeds its limit.
pub fn within_speed_limit(qd: DVector<f64>) -> DVector<f64> {
    let scale = qd
        .iter()
        .fold(1.0_f64, |scale, speed| scale.min(SPEED_LIMIT / speed.abs()));
    qd * scale
}
