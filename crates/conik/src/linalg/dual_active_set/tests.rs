//! The dual active set against an interior-point solver, on random programs of every kind.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::{Constraints, DualActiveSet, Solution};

#[path = "../../../tests/oracle/program.rs"]
#[allow(dead_code, reason = "the rule's oracle needs more of it")]
mod program;
use program::{Failure, Program};

/// Largest difference of x where both solvers have an answer.
const TOLERANCE: f64 = 1e-8;

/// What row i is made of.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Fresh,
    /// A multiple, of either sign, of an earlier row.
    Parallel(usize, f64),
    /// The sum of two earlier rows.
    Sum(usize, usize),
    Zero,
}

/// How the bound of a row is chosen, beside a point that all rows are to keep.
#[derive(Clone, Copy, Debug)]
enum Bound {
    /// So far inside.
    Slack(f64),
    /// Through the point itself: in a corner of many rows all but a few are redundant.
    Touching,
    Equality,
}

/// A random program.
#[derive(Clone, Debug)]
struct Scene {
    dof: usize,
    /// Dimension of the motions that are free.
    dimension: usize,
    kinds: Vec<(Kind, Bound)>,
    entries: Vec<f64>,
    /// Whether bounds are moved at random, so that perhaps nothing keeps them.
    shifts: Option<Vec<f64>>,
}

fn kind() -> impl Strategy<Value = Kind> {
    prop_oneof![
        6 => Just(Kind::Fresh),
        2 => (0..40_usize, prop_oneof![-3.0..-0.3, 0.3..3.0_f64]).prop_map(|(i, f)| Kind::Parallel(i, f)),
        2 => (0..40_usize, 0..40_usize).prop_map(|(i, j)| Kind::Sum(i, j)),
        1 => Just(Kind::Zero),
    ]
}

fn bound() -> impl Strategy<Value = Bound> {
    prop_oneof![
        4 => (0.01..1.0_f64).prop_map(Bound::Slack),
        4 => Just(Bound::Touching),
        1 => Just(Bound::Equality),
    ]
}

fn scene(may_be_infeasible: bool) -> impl Strategy<Value = Scene> {
    (2..=10_usize, 0..=20_usize).prop_flat_map(move |(dof, rows)| {
        let entries = prop::collection::vec(-1.0..1.0_f64, dof * (3 * dof + rows + 2));
        let kinds = prop::collection::vec((kind(), bound()), rows);
        let shifts = prop::collection::vec(-0.5..0.5_f64, rows);
        (1..=dof, kinds, entries, shifts).prop_map(move |(dimension, kinds, entries, shifts)| {
            Scene {
                dof,
                dimension,
                kinds,
                entries,
                shifts: may_be_infeasible.then_some(shifts),
            }
        })
    })
}

/// A scene as matrices.
struct Matrices {
    hessian: DMatrix<f64>,
    /// Rows that span the free motions.
    free: DMatrix<f64>,
    from: DVector<f64>,
    rows: DMatrix<f64>,
    bounds: DVector<f64>,
    equal: Vec<usize>,
}

impl Scene {
    fn matrices(&self) -> Matrices {
        let dof = self.dof;
        let mut rest = self.entries.chunks_exact(dof);
        let mut next = || DVector::from_column_slice(rest.next().expect("enough entries"));
        let square: Vec<_> = (0..dof).map(|_| next()).collect();
        let square = DMatrix::from_columns(&square);
        let hessian = &square * square.transpose() + DMatrix::identity(dof, dof) * 0.05;
        let turned: Vec<_> = (0..dof).map(|_| next()).collect();
        let turned = DMatrix::from_columns(&turned).qr().q().transpose();
        let free = turned.rows(0, self.dimension).into_owned();
        let from = next();
        let kept = &from + free.transpose() * next().rows(0, self.dimension);
        let mut rows: Vec<DVector<f64>> = Vec::new();
        let mut bounds = Vec::new();
        let mut equal = Vec::new();
        for (i, &(kind, bound)) in self.kinds.iter().enumerate() {
            let row = match kind {
                Kind::Parallel(j, factor) if i > 0 => &rows[j % i] * factor,
                Kind::Sum(j, k) if i > 0 => &rows[j % i] + &rows[k % i],
                Kind::Zero => DVector::zeros(dof),
                _ => next(),
            };
            let slack = match bound {
                Bound::Slack(slack) => slack,
                Bound::Touching => 0.0,
                Bound::Equality => {
                    equal.push(i);
                    0.0
                }
            };
            let shift = self.shifts.as_ref().map_or(0.0, |shifts| shifts[i]);
            bounds.push(row.dot(&kept) - slack + shift);
            rows.push(row);
        }
        let rows = rows.iter().map(DVector::transpose).collect::<Vec<_>>();
        Matrices {
            rows: if rows.is_empty() {
                DMatrix::zeros(0, dof)
            } else {
                DMatrix::from_rows(&rows)
            },
            hessian,
            free,
            from,
            bounds: DVector::from_vec(bounds),
            equal,
        }
    }
}

impl Matrices {
    /// x by the interior-point solver.
    fn expected(&self) -> Result<DVector<f64>, Failure> {
        let program = Program {
            hessian: &(&self.free * &self.hessian * self.free.transpose()),
            from: &DVector::zeros(self.free.nrows()),
            rows: &(&self.rows * self.free.transpose()),
            bounds: &(&self.bounds - &self.rows * &self.from),
            equal: &self.equal,
        };
        Ok(&self.from + self.free.transpose() * program.solve()?.x)
    }

    /// x and the solver that found it.
    fn found(&self, pivots: &mut usize) -> (Solution, DVector<f64>, DualActiveSet) {
        let dof = self.from.len();
        let mut solver = DualActiveSet::new(dof);
        let within = (&self.free * &self.hessian * self.free.transpose())
            .cholesky()
            .expect("definite");
        let basis = within
            .l()
            .solve_lower_triangular(&self.free)
            .expect("definite");
        solver
            .basis_mut(self.free.nrows())
            .copy_from_slice(basis.transpose().as_slice());
        let mut x = self.from.clone();
        let rows = self.rows.transpose();
        let constraints = Constraints {
            rows: rows.as_slice(),
            bounds: self.bounds.as_slice(),
            equalities: &self.equal,
        };
        let solution = solver.solve(x.as_mut_slice(), constraints, pivots);
        (solution, x, solver)
    }

    /// Σ μ a − H (x − x₀) on the free motions: zero at a stationary point.
    fn gradient(&self, x: &DVector<f64>, solver: &DualActiveSet) -> DVector<f64> {
        let mut gradient = -&self.hessian * (x - &self.from);
        for (&i, multiplier) in solver.active().iter().zip(solver.multipliers()) {
            gradient += self.rows.row(i).transpose() * *multiplier;
        }
        &self.free * gradient
    }
}

/// Always the same programs: what the interior point makes of the most degenerate ones is not foreseen.
fn config() -> ProptestConfig {
    ProptestConfig {
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::with_cases(1000)
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn minimisers_agree_with_an_interior_point_solver(scene in scene(false)) {
        let matrices = scene.matrices();
        let expected = matrices.expected();
        prop_assume!(!matches!(expected, Err(Failure::Undecided)));
        let expected = expected.expect("feasible by construction");
        let mut pivots = 200;
        let (solution, x, solver) = matrices.found(&mut pivots);
        prop_assert_eq!(solution, Solution::Optimal);
        prop_assert!((&x - &expected).amax() <= TOLERANCE * (1.0 + x.amax()), "{} instead of {}", x, expected);
        // The conditions for a minimum, which need no other solver.
        let slack = &matrices.rows * &x - &matrices.bounds;
        for (i, slack) in slack.iter().enumerate() {
            prop_assert!(*slack >= -1e-9, "row {} violated by {}", i, slack);
            prop_assert!(!matrices.equal.contains(&i) || slack.abs() <= 1e-9);
        }
        for (i, multiplier) in solver.active().iter().zip(solver.multipliers()) {
            prop_assert!(*multiplier >= -1e-9 || matrices.equal.contains(i), "{}", multiplier);
            prop_assert!(slack[*i].abs() <= 1e-9, "an active row binds");
        }
        let gradient = matrices.gradient(&x, &solver).amax();
        prop_assert!(gradient <= 1e-8 * (1.0 + x.amax()), "{}", gradient);
    }

    #[test]
    fn programs_without_an_answer_are_recognised(scene in scene(true)) {
        let matrices = scene.matrices();
        let mut pivots = 200;
        let (solution, x, _) = matrices.found(&mut pivots);
        match matrices.expected() {
            Err(Failure::Undecided) => {}
            Err(Failure::Infeasible) => prop_assert_eq!(solution, Solution::Infeasible),
            Ok(expected) => {
                prop_assert_eq!(solution, Solution::Optimal);
                prop_assert!((&x - &expected).amax() <= TOLERANCE * (1.0 + x.amax()));
            }
        }
    }

    #[test]
    fn the_cap_on_pivots_is_never_exceeded(scene in scene(true), cap in 0..6_usize) {
        let matrices = scene.matrices();
        let mut needed = 200;
        let (solution, ..) = matrices.found(&mut needed);
        let needed = 200 - needed;
        let mut pivots = cap;
        let (capped, x, _) = matrices.found(&mut pivots);
        prop_assert!(x.iter().all(|v| v.is_finite()));
        if needed <= cap {
            prop_assert_eq!((capped, cap - pivots), (solution, needed));
        } else {
            prop_assert_eq!((capped, pivots), (Solution::OutOfPivots, 0));
        }
    }
}

/// Both kinds of answer come up, so that the tests above compare something.
#[test]
fn random_programs_are_of_both_kinds() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let feasible = (0..200)
        .filter(|_| {
            let scene = scene(true)
                .new_tree(&mut runner)
                .expect("no filters")
                .current();
            scene.matrices().expected().is_ok()
        })
        .count();
    assert!((40..160).contains(&feasible), "{feasible} of 200");
}
