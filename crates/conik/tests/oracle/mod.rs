//! The method written down a second time, as plainly as the paper prints it: homogeneous matrices,
//! Moore-Penrose pseudoinverses by the eigenvectors of JᵀJ, all 2ⁿ modes. Shares no code with
//! the crate.

use std::cell::Cell;

use nalgebra::{DMatrix, DVector, Matrix4, Vector3};

/// ε in Eqs. (10) and (17).
const EPSILON: f64 = 1e-9;

/// A row a, α, d of Table I.
const TABLE_I: [[f64; 3]; 6] = [
    [0.0, std::f64::consts::FRAC_PI_2, 0.089],
    [-0.425, 0.0, 0.0],
    [-0.392, 0.0, 0.0],
    [0.0, std::f64::consts::FRAC_PI_2, 0.109],
    [0.0, -std::f64::consts::FRAC_PI_2, 0.095],
    [0.0, 0.0, 0.082],
];

#[derive(Clone, Copy, Debug)]
pub enum Measure {
    Position,
    Coordinate(usize),
    Distance([f64; 3]),
    FieldOfView([f64; 3]),
    Joint(usize),
}

#[derive(Clone, Debug)]
pub enum Goal {
    Equality(Vec<f64>),
    Set(f64, f64),
}

#[derive(Clone, Debug)]
pub struct Task {
    pub measure: Measure,
    pub goal: Goal,
    pub gain: f64,
}

/// Base frame from each of the frames 0 to 6.
fn frames(q: &[f64]) -> Vec<Matrix4<f64>> {
    let mut frames = vec![Matrix4::identity()];
    for (&[a, alpha, d], &theta) in TABLE_I.iter().zip(q) {
        let (st, ct) = theta.sin_cos();
        let (sa, ca) = alpha.sin_cos();
        #[rustfmt::skip]
        let link = Matrix4::new(
            ct, -st * ca, st * sa, a * ct,
            st, ct * ca, -ct * sa, a * st,
            0.0, sa, ca, d,
            0.0, 0.0, 0.0, 1.0,
        );
        frames.push(frames.last().unwrap() * link);
    }
    frames
}

fn column(frame: &Matrix4<f64>, k: usize) -> Vector3<f64> {
    frame.fixed_view::<3, 1>(0, k).into_owned()
}

/// σ and J.
pub fn measure(measure: Measure, q: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
    let frames = frames(q);
    let (tool, axis) = (column(&frames[6], 3), column(&frames[6], 2));
    let stack = |entry: &dyn Fn(usize) -> Vector3<f64>| {
        DMatrix::from_columns(
            &(0..6)
                .map(|i| DVector::from_column_slice(entry(i).as_slice()))
                .collect::<Vec<_>>(),
        )
    };
    let position = stack(&|i| column(&frames[i], 2).cross(&(tool - column(&frames[i], 3))));
    let turning = stack(&|i| column(&frames[i], 2).cross(&axis));
    let scalar = |value: f64, row: DMatrix<f64>| (DVector::from_element(1, value), row);
    let norm = |difference: Vector3<f64>, jacobian: &DMatrix<f64>| {
        let sigma = difference.norm();
        let row = DMatrix::from_row_slice(1, 3, difference.as_slice()) * (-1.0 / (sigma + EPSILON));
        (DVector::from_element(1, sigma), row * jacobian)
    };
    match measure {
        Measure::Position => (DVector::from_column_slice(tool.as_slice()), position),
        Measure::Coordinate(k) => scalar(tool[k], position.rows(k, 1).into_owned()),
        Measure::Distance(point) => norm(Vector3::from(point) - tool, &position),
        Measure::FieldOfView(direction) => {
            norm(Vector3::from(direction).normalize() - axis, &turning)
        }
        Measure::Joint(i) => {
            let mut row = DMatrix::zeros(1, 6);
            row[i] = 1.0;
            scalar(q[i], row)
        }
    }
}

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

/// Velocity of a mode: the sum of N J⁺ σ̇_ref, N from the stacked rows above.
fn velocity(
    tasks: &[Task],
    measured: &[(DVector<f64>, DMatrix<f64>)],
    active: u32,
    conditioning: &Cell<f64>,
) -> DVector<f64> {
    let first_equality = tasks
        .iter()
        .position(|task| matches!(task.goal, Goal::Equality(_)))
        .unwrap_or(tasks.len());
    let mut above = DMatrix::zeros(0, 6);
    let append = |above: &DMatrix<f64>, rows: &DMatrix<f64>| {
        let mut larger = above.clone().insert_rows(above.nrows(), rows.nrows(), 0.0);
        larger.rows_mut(above.nrows(), rows.nrows()).copy_from(rows);
        larger
    };
    for (i, (_, jacobian)) in measured.iter().enumerate().take(first_equality) {
        if active & 1 << i != 0 {
            above = append(&above, jacobian);
        }
    }
    let mut sum = DVector::zeros(6);
    for (i, task) in tasks.iter().enumerate().skip(first_equality) {
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
        let null = DMatrix::identity(6, 6) - pinv(&above, conditioning) * &above;
        sum += null * pinv(jacobian, conditioning) * error * task.gain;
        above = append(&above, jacobian);
    }
    sum
}

/// What the method prescribes at one configuration.
pub struct Prescribed {
    /// A bit for each active task.
    pub active: u32,
    pub qd: DVector<f64>,
    /// Smallest ratio of a singular value to the largest one of its matrix: what rounding is
    /// magnified by.
    pub conditioning: f64,
}

/// The first mode in the order "fewest active, then list order" that keeps every inactive set.
/// `border` lets only sets at or outside their border be active.
pub fn step(tasks: &[Task], q: &[f64], border: bool) -> Prescribed {
    let conditioning = Cell::new(1.0);
    let measured: Vec<_> = tasks.iter().map(|task| measure(task.measure, q)).collect();
    let sets: Vec<usize> = (0..tasks.len())
        .filter(|&i| matches!(tasks[i].goal, Goal::Set(..)))
        .collect();
    let bounds = |i: usize| match tasks[i].goal {
        Goal::Set(min, max) => (min, max),
        Goal::Equality(_) => unreachable!(),
    };
    let mut modes: Vec<Vec<usize>> = (0_u32..1 << sets.len())
        .map(|bits| {
            (0..sets.len())
                .filter(|k| bits & 1 << k != 0)
                .map(|k| sets[k])
                .collect()
        })
        .collect();
    modes.sort_by(|a: &Vec<usize>, b| (a.len(), a).cmp(&(b.len(), b)));
    for mode in modes {
        let inside = |i: usize| {
            let (min, max) = bounds(i);
            measured[i].0[0] > min && measured[i].0[0] < max
        };
        if border && mode.iter().any(|&i| inside(i)) {
            continue;
        }
        let active = mode.iter().fold(0, |bits, i| bits | 1 << i);
        let f = velocity(tasks, &measured, active, &conditioning);
        let passes = sets.iter().filter(|i| !mode.contains(i)).all(|&i| {
            let (min, max) = bounds(i);
            let sigma = measured[i].0[0];
            let rate = (&measured[i].1 * &f)[0];
            let rate = if rate.abs() <= 1e-12 { 0.0 } else { rate };
            inside(i) || (sigma <= min && rate >= 0.0) || (sigma >= max && rate <= 0.0)
        });
        if passes {
            // The whole velocity within π rad/s for every joint.
            let scale = f
                .iter()
                .fold(1.0_f64, |s, v| s.min(std::f64::consts::PI / v.abs()));
            return Prescribed {
                active,
                qd: f * scale,
                conditioning: conditioning.get(),
            };
        }
    }
    unreachable!("the mode with every set active has nothing to test")
}
