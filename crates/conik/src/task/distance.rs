//! Distance to a point: σ = √((p_o − p)ᵀ(p_o − p)), Eqs. (9) and (10): collision avoidance.

use super::{DENOMINATOR_EPSILON, JacobianMut, Task, add_outer, check_frame};
use crate::geometry::Vec3;
use crate::joints::JointVec;
use crate::kinematics::{Frame, Kinematics};

/// Distance of the origin of a frame to a point of the base frame [m].
///
/// At the point itself the direction is undefined and the Jacobian is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    frame: Frame,
    point: Vec3,
    velocity: Vec3,
}

impl Distance {
    /// Distance of the tool to `point` [m].
    pub fn of_tool_to(point: impl Into<Vec3>) -> Self {
        Self::between(Frame::Tool, point)
    }

    /// Distance of any frame's origin to `point` [m].
    pub fn between(frame: Frame, point: impl Into<Vec3>) -> Self {
        Self {
            frame,
            point: point.into(),
            velocity: Vec3::ZERO,
        }
    }

    /// The point in the base frame [m].
    pub fn point(&self) -> Vec3 {
        self.point
    }

    /// Velocity of the point in the base frame [m/s].
    pub fn velocity(&self) -> Vec3 {
        self.velocity
    }

    /// Puts the point somewhere else [m], at rest.
    pub fn set_point(&mut self, point: impl Into<Vec3>) {
        self.set_point_moving(point, Vec3::ZERO);
    }

    /// Says where the point is now [m] and how it moves [m/s]. Until the next call it is taken to move
    /// on at that velocity within each tick, so call this before every tick.
    pub fn set_point_moving(&mut self, point: impl Into<Vec3>, velocity: impl Into<Vec3>) {
        self.point = point.into();
        self.velocity = velocity.into();
    }

    #[inline]
    fn away_from_point(&self, kinematics: &Kinematics) -> Vec3 {
        kinematics.base_from(self.frame).origin - self.point
    }
}

impl Task for Distance {
    fn dimension(&self) -> usize {
        1
    }

    #[inline]
    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.away_from_point(kinematics).norm();
    }

    #[inline]
    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let away = self.away_from_point(kinematics);
        let direction = away * (1.0 / (away.norm() + DENOMINATOR_EPSILON));
        kinematics.point_row(self.frame, direction, jacobian.row(0));
    }

    /// ∇²σ = Σₖ nₖ ∇²vₖ + Jᵀ (I − n nᵀ) J / σ for σ = |v|, n = v / σ.
    fn add_curvature(&self, kinematics: &Kinematics, weights: &[f64], hessian: &mut [f64]) {
        let away = self.away_from_point(kinematics);
        let sigma = away.norm() + DENOMINATOR_EPSILON;
        let along = away * (1.0 / sigma);
        kinematics.add_point_curvature(self.frame, along * weights[0], hessian);
        let mut add_bend = |direction: Vec3, weight: f64| {
            let mut row = JointVec::zeros(kinematics.dof());
            kinematics.point_row(self.frame, direction, &mut row);
            add_outer(hessian, weight / sigma, &row);
        };
        for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            add_bend(axis.into(), weights[0]);
        }
        add_bend(along, -weights[0]);
    }

    fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO
    }

    fn value_ahead(&self, kinematics: &Kinematics, ahead_s: f64, value: &mut [f64]) {
        value[0] = (self.away_from_point(kinematics) - self.velocity * ahead_s).norm();
    }

    fn bend(&self, sigma: f64) -> f64 {
        1.0 / (sigma + DENOMINATOR_EPSILON)
    }

    fn steepness(&self, reach: f64) -> f64 {
        reach
    }

    fn unit(&self) -> &'static str {
        "m"
    }

    fn check(&self, dof: usize) -> Result<(), &'static str> {
        check_frame(self.frame, dof)?;
        if self.point.to_array().iter().all(|v| v.is_finite()) {
            Ok(())
        } else {
            Err("the point must be finite")
        }
    }
}
