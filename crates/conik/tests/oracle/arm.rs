//! A serial arm by homogeneous matrices: values and Jacobians of the tasks.

use conik::{DhRow, JointLimits, Robot};
use nalgebra::{DMatrix, DVector, Matrix4, Vector3};

use super::Measure;

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

/// Speed limit of every joint [rad/s].
pub const SPEED_LIMIT: f64 = std::f64::consts::PI;

/// Rows a, α, d of an arm of revolute joints.
#[derive(Clone, Debug)]
pub struct Arm(pub Vec<[f64; 3]>);

impl Arm {
    pub fn ur5() -> Self {
        Self(TABLE_I.to_vec())
    }

    pub fn dof(&self) -> usize {
        self.0.len()
    }

    /// The same arm for the crate.
    pub fn robot(&self) -> Robot {
        let rows = self.0.iter().map(|&[a, alpha, d]| DhRow::new(a, alpha, d));
        let arm = Robot::from_dh("arm", &rows.collect::<Vec<_>>()).expect("finite rows");
        let limits = JointLimits {
            speed: Some(SPEED_LIMIT),
            ..JointLimits::default()
        };
        arm.with_limits(|_, _| limits).expect("sound")
    }

    /// Base frame from each of the frames 0 to n.
    fn frames(&self, q: &[f64]) -> Vec<Matrix4<f64>> {
        let mut frames = vec![Matrix4::identity()];
        for (&[a, alpha, d], &theta) in self.0.iter().zip(q) {
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

    /// σ and J.
    pub fn measure(&self, measure: Measure, q: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        let frames = self.frames(q);
        let dof = self.dof();
        let (tool, axis) = (column(&frames[dof], 3), column(&frames[dof], 2));
        let stack = |entry: &dyn Fn(usize) -> Vector3<f64>| {
            DMatrix::from_columns(
                &(0..dof)
                    .map(|i| DVector::from_column_slice(entry(i).as_slice()))
                    .collect::<Vec<_>>(),
            )
        };
        let position = stack(&|i| column(&frames[i], 2).cross(&(tool - column(&frames[i], 3))));
        let turning = stack(&|i| column(&frames[i], 2).cross(&axis));
        let scalar = |value: f64, row: DMatrix<f64>| (DVector::from_element(1, value), row);
        let norm = |difference: Vector3<f64>, jacobian: &DMatrix<f64>| {
            let sigma = difference.norm();
            let row =
                DMatrix::from_row_slice(1, 3, difference.as_slice()) * (-1.0 / (sigma + EPSILON));
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
                let mut row = DMatrix::zeros(1, dof);
                row[i] = 1.0;
                scalar(q[i], row)
            }
        }
    }
}

fn column(frame: &Matrix4<f64>, k: usize) -> Vector3<f64> {
    frame.fixed_view::<3, 1>(0, k).into_owned()
}
