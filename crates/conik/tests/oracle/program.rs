//! Strictly convex quadratic programs by Clarabel, an interior-point solver: shares neither method nor
//! code with the crate.
//!
//! An interior-point answer is as exact as its duality gap, and a gap of 1e-12 leaves 1e-6 in x. So
//! the rows that bind are read off it and solved for as equations; where that answer does not keep every
//! row, there is none.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::{DMatrix, DVector, RowDVector};

/// Gaps and residuals asked for, the next where one cannot be had.
const TOLERANCES: [f64; 3] = [1e-13, 1e-10, 1e-7];

/// Rows of which less is left than this are zero.
const ZERO: f64 = 1e-9;

/// Rows of which less is left than this are left by rounding, perhaps.
const NEARLY_ZERO: f64 = 1e-6;

/// A row of which less than this share is left beside others depends on them.
const DEPENDENT: f64 = 1e-7;

/// A row whose multiplier and slack are both below this times the root of the gap may neither push nor
/// have room.
const UNCLEAR: f64 = 30.0;

/// A row that is missed by less is kept.
const TOUCHING: f64 = 1e-12;

/// Largest violation of an equation's answer, and its largest difference from the interior point.
const SAME: (f64, f64) = (1e-9, 1e-4);

/// min ½ (x − x₀)ᵀ H (x − x₀) subject to A x ≥ b, with equality in the rows `equal`.
pub struct Program<'a> {
    pub hessian: &'a DMatrix<f64>,
    pub from: &'a DVector<f64>,
    pub rows: &'a DMatrix<f64>,
    pub bounds: &'a DVector<f64>,
    pub equal: &'a [usize],
}

/// The minimiser, and which of the one-sided rows push.
pub struct Answer {
    pub x: DVector<f64>,
    pub binding: Vec<usize>,
    /// Whether some row neither pushes nor has room.
    pub is_unclear: bool,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// No x keeps every row.
    Infeasible,
    /// The solver could not tell: a few in ten thousand programs whose rows leave no interior.
    Undecided,
}

impl Program<'_> {
    pub fn solve(&self) -> Result<Answer, Failure> {
        // With H = L Lᵀ and y = Lᵀ (x − x₀) the weight is one: the shortest y is wanted.
        let factor = self.hessian.clone().cholesky().expect("positive definite");
        let rows = factor
            .l()
            .solve_lower_triangular(&self.rows.transpose())
            .expect("positive definite")
            .transpose();
        let bounds = self.bounds - self.rows * self.from;
        // What the equations fix, and the motions that they leave free.
        let fixed = shortest(&rows, &bounds, self.equal);
        let missed = self
            .equal
            .iter()
            .map(|&i| (rows.row(i) * &fixed)[0] - bounds[i]);
        if missed.fold(0.0_f64, |worst, miss| worst.max(miss.abs())) > ZERO {
            return Err(Failure::Infeasible);
        }
        let free = null_space(&rows.select_rows(self.equal));
        let mut is_unclear = false;
        let (mut one_sided, mut within, mut missing) = (Vec::new(), Vec::new(), Vec::new());
        for i in (0..rows.nrows()).filter(|i| !self.equal.contains(i)) {
            let (row, miss) = (rows.row(i) * &free, bounds[i] - (rows.row(i) * &fixed)[0]);
            let length = row.norm();
            is_unclear |= (ZERO..NEARLY_ZERO).contains(&length);
            if length > ZERO {
                one_sided.push(i);
                missing.push(miss / length);
                within.push(row / length);
            } else if miss > ZERO {
                return Err(Failure::Infeasible);
            }
        }
        let (motion, pushes, unclear_push) =
            nearest(&within, &DVector::from_vec(missing), free.ncols())?;
        let step = factor
            .l()
            .tr_solve_lower_triangular(&(fixed + free * motion))
            .expect("positive definite");
        Ok(Answer {
            x: self.from + step,
            binding: pushes.into_iter().map(|k| one_sided[k]).collect(),
            is_unclear: is_unclear || unclear_push,
        })
    }
}

/// y, the rows that push, and whether some row neither pushes nor has room.
type Nearest = (DVector<f64>, Vec<usize>, bool);

/// min ½ |y|² subject to A y ≥ b, rows of length one.
fn nearest(
    rows: &[RowDVector<f64>],
    bounds: &DVector<f64>,
    size: usize,
) -> Result<Nearest, Failure> {
    if rows.is_empty() || bounds.max() <= TOUCHING {
        return Ok((DVector::zeros(size), Vec::new(), false));
    }
    let rows = DMatrix::from_rows(rows);
    let (y, binding, is_unclear) = interior(&rows, bounds)?;
    let exact = shortest(&rows, bounds, &binding);
    let worst = (bounds - &rows * &exact).max();
    let drift = (&exact - &y).norm() / (1.0 + y.norm());
    if worst > SAME.0 || drift > SAME.1 {
        return Err(Failure::Undecided);
    }
    Ok((exact, binding, is_unclear))
}

/// The interior point of min ½ |y|² subject to A y ≥ b, and the rows whose multiplier exceeds their slack.
fn interior(rows: &DMatrix<f64>, bounds: &DVector<f64>) -> Result<Nearest, Failure> {
    let (count, size) = rows.shape();
    let dense: Vec<Vec<f64>> = rows
        .row_iter()
        .map(|row| row.iter().map(|entry| -entry).collect())
        .collect();
    for tolerance in TOLERANCES {
        let settings = DefaultSettings {
            verbose: false,
            tol_gap_abs: tolerance,
            tol_gap_rel: tolerance,
            tol_feas: tolerance,
            ..DefaultSettings::default()
        };
        let mut solver = DefaultSolver::new(
            &CscMatrix::identity(size),
            &vec![0.0; size],
            &CscMatrix::from(&dense),
            (-bounds).as_slice(),
            &[NonnegativeConeT(count)],
            settings,
        )
        .expect("sound dimensions");
        solver.solve();
        let solution = &solver.solution;
        match solution.status {
            SolverStatus::Solved => {
                let binding = (0..count).filter(|&i| solution.z[i] > solution.s[i]);
                // At the interior point the product of the two is the gap's share of the row.
                let unclear = UNCLEAR * tolerance.sqrt();
                let is_unclear = (0..count).any(|i| solution.z[i].max(solution.s[i]) < unclear);
                let y = DVector::from_column_slice(&solution.x);
                return Ok((y, binding.collect(), is_unclear));
            }
            SolverStatus::PrimalInfeasible => return Err(Failure::Infeasible),
            _ => {}
        }
    }
    Err(Failure::Undecided)
}

/// The shortest y that meets the chosen rows with equality; dependent ones are taken to agree.
fn shortest(rows: &DMatrix<f64>, bounds: &DVector<f64>, chosen: &[usize]) -> DVector<f64> {
    let mut y = DVector::zeros(rows.ncols());
    let mut directions = DMatrix::zeros(0, rows.ncols());
    for &i in chosen {
        if let Some(direction) = beside(&directions, &rows.rows(i, 1).into_owned()) {
            let missing = bounds[i] - (rows.row(i) * &y)[0];
            y += direction.transpose() * (missing / (rows.row(i) * direction.transpose())[0]);
            directions = stacked(&directions, &direction);
        }
    }
    y
}

/// Columns that span what moves none of the rows.
pub fn null_space(rows: &DMatrix<f64>) -> DMatrix<f64> {
    let size = rows.ncols();
    if size == 0 {
        return DMatrix::zeros(0, 0);
    }
    let directions = row_space(rows);
    let projector = DMatrix::identity(size, size) - directions.transpose() * &directions;
    let eigen = projector.symmetric_eigen();
    let free: Vec<usize> = (0..size).filter(|&k| eigen.eigenvalues[k] > 0.5).collect();
    eigen.eigenvectors.select_columns(&free)
}

/// Orthonormal rows that span what the rows span.
pub fn row_space(rows: &DMatrix<f64>) -> DMatrix<f64> {
    let mut directions = DMatrix::zeros(0, rows.ncols());
    for i in 0..rows.nrows() {
        if let Some(direction) = beside(&directions, &rows.rows(i, 1).into_owned()) {
            directions = stacked(&directions, &direction);
        }
    }
    directions
}

/// The direction of what is left of a row beside orthonormal ones.
fn beside(directions: &DMatrix<f64>, row: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let length = row.norm();
    let project = |row: &DMatrix<f64>| row - (row * directions.transpose()) * directions;
    let left = project(&project(row));
    let share = left.norm();
    (share > DEPENDENT * length).then(|| left / share)
}

/// One matrix above another.
pub fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let rows: Vec<_> = above.row_iter().chain(below.row_iter()).collect();
    if rows.is_empty() {
        return DMatrix::zeros(0, above.ncols());
    }
    DMatrix::from_rows(&rows)
}
