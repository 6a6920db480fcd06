//! Tasks: what a controller measures. What it asks of them is in [`Stack`](crate::Stack).
//!
//! A task is a function σ(q) ∈ ℝᵐ of the configuration with an exact Jacobian J = ∂σ/∂q. One file
//! per task; each starts with its equation.

mod coordinate;
mod distance;
mod elbow;
mod field_of_view;
mod frame_jacobian;
mod frame_pose;
mod joint;
mod joint_speed;
mod look_at;
mod manipulability;
mod norm;
mod orientation;
mod plane;
mod pointing_angle;
mod position;
mod posture;
mod seen;
mod shape_distance;
mod smallest_singular_value;

use core::any::Any;
use core::fmt::Debug;

pub use coordinate::{Axis, Coordinate};
pub use distance::Distance;
pub use elbow::Elbow;
pub use field_of_view::FieldOfView;
pub use frame_jacobian::JacobianPart;
pub use frame_pose::FramePose;
pub use joint::JointPosition;
pub use joint_speed::JointSpeed;
pub use look_at::LookAt;
pub use manipulability::Manipulability;
pub use orientation::{Orientation, OrientationAngle};
pub use plane::Plane;
pub use pointing_angle::PointingAngle;
pub use position::Position;
pub use posture::Posture;
pub use shape_distance::ShapeDistance;
pub use smallest_singular_value::SmallestSingularValue;

use crate::geometry::Vec3;
use crate::kinematics::Kinematics;
use crate::robot::Robot;
use seen::Seen;

/// Where a length [m] or a sine is smaller, no direction follows from it, and derivatives that divide by it
/// are taken to be zero.
const NEARLY_ZERO: f64 = 1e-9;

/// A task: its value and its Jacobian in a configuration.
///
/// `examples/05_own_task.rs` in the repository has one of a user's own, in thirty lines.
///
/// Implementations must not allocate, and must give finite numbers for every finite configuration.
/// What they give depends on the configuration and on the task's own parameters alone, which change
/// only through [`Setpoints::task_mut`](crate::Setpoints::task_mut), not behind a shared reference:
/// what was computed for a configuration is used again in it.
pub trait Task: Any + Debug + Send {
    /// Number of components m. Set-based tasks have one.
    fn dimension(&self) -> usize;

    /// Writes σ(q), `dimension` numbers, into `value`.
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]);

    /// Writes J(q) = ∂σ/∂q, `dimension` rows of one entry per joint.
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>);

    /// Writes the error σ̃ between a desired value and the present one; their difference unless
    /// the task's values are not a vector space.
    fn error(&self, desired: &[f64], value: &[f64], error: &mut [f64]) {
        for ((error, desired), value) in error.iter_mut().zip(desired).zip(value) {
            *error = desired - value;
        }
    }

    /// Whether the task's own parameters move: a point, a direction. Its value then changes though the
    /// robot does not.
    fn is_moving(&self) -> bool {
        false
    }

    /// Writes the value that σ will have `ahead_s` [s] from now if the robot stays where it is. Asked
    /// only of a task that [`is_moving`](Self::is_moving).
    fn value_ahead(&self, kinematics: &Kinematics, _ahead_s: f64, value: &mut [f64]) {
        self.value(kinematics, value);
    }

    /// How strongly the task bends: an estimate of the second derivative of σ along a joint motion of
    /// 1 rad [task's unit/rad²], where its value is `sigma`. The damping at a border is chosen by it.
    fn bend(&self, _sigma: f64) -> f64 {
        1.0
    }

    /// Adds Σᵢ wᵢ ∇²σᵢ(q), the second derivatives of the components, each with its weight, to `hessian`: one
    /// row of one entry per joint for each joint.
    ///
    /// Where a level cannot have what it asks, tasks below it keep to motions that do not turn against
    /// it what it is left with; those follow from second derivatives. A task that adds nothing, as
    /// the default does, is taken to be linear.
    fn add_curvature(&self, _kinematics: &Kinematics, _weights: &[f64], _hessian: &mut [f64]) {}

    /// A bound on how fast the value can change [task's unit/rad]: |J q̇| ≤ steepness · Σ|q̇ᵢ| in every
    /// configuration, not only the one that `kinematics` is at: see [`Kinematics::reach`] and
    /// [`Kinematics::span`]. A set that is so far inside that it cannot be left within a tick costs no
    /// Jacobian; infinity, of which nothing follows, if no bound is known.
    fn steepness(&self, _kinematics: &Kinematics) -> f64 {
        f64::INFINITY
    }

    /// Whether its value takes so long to compute that it is worth while to remember where it need not
    /// be known: see [`Controller::measure_on_demand`](crate::Controller::measure_on_demand).
    fn is_costly(&self) -> bool {
        false
    }

    /// Unit of the value, for people: `m`, `rad`, `-`.
    fn unit(&self) -> &'static str;

    /// Whether the task makes sense on this robot; if not, the reason.
    fn check(&self, robot: &Robot) -> Result<(), &'static str>;
}

/// The axes of a frame, in it.
pub(crate) const AXES: [Vec3; 3] = [
    Vec3::new(1.0, 0.0, 0.0),
    Vec3::new(0.0, 1.0, 0.0),
    Vec3::new(0.0, 0.0, 1.0),
];

/// Where a task writes its Jacobian: m rows of one entry per joint.
#[derive(Debug)]
pub struct JacobianMut<'a> {
    entries: &'a mut [f64],
    dof: usize,
}

impl<'a> JacobianMut<'a> {
    /// A Jacobian over `entries`, row after row, `dof` entries each.
    #[inline]
    pub fn new(entries: &'a mut [f64], dof: usize) -> Self {
        Self { entries, dof }
    }

    /// Row `i`, one entry per joint.
    ///
    /// # Panics
    /// If the task has no such component.
    #[inline]
    pub fn row(&mut self, i: usize) -> &mut [f64] {
        &mut self.entries[i * self.dof..][..self.dof]
    }

    /// The first N rows at once, one entry per joint.
    ///
    /// # Panics
    /// If the task has fewer components.
    #[inline]
    pub fn rows<const N: usize>(&mut self) -> [&mut [f64]; N] {
        let mut rest = &mut *self.entries;
        core::array::from_fn(|_| {
            let (row, below) = core::mem::take(&mut rest).split_at_mut(self.dof);
            rest = below;
            row
        })
    }
}

/// Adds weight · (row ⊗ row) to a square matrix of the size of `row`.
fn add_outer(hessian: &mut [f64], weight: f64, row: &[f64]) {
    for (line, a) in hessian.chunks_exact_mut(row.len()).zip(row) {
        for (entry, b) in line.iter_mut().zip(row) {
            *entry += weight * a * b;
        }
    }
}
