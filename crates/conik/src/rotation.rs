//! Orientations in other forms than axes: rotation vectors, quaternions, roll, pitch and yaw.

use crate::geometry::{Pose, Vec3};
use crate::real::{atan2, sin_cos, sqrt};

impl Pose {
    /// A frame turned about `rotation` by its length [rad], with its origin where it was.
    #[must_use]
    pub fn turned(rotation: Vec3) -> Self {
        Self {
            x_axis: Self::IDENTITY.x_axis.turned_by(rotation),
            y_axis: Self::IDENTITY.y_axis.turned_by(rotation),
            z_axis: Self::IDENTITY.z_axis.turned_by(rotation),
            origin: Vec3::ZERO,
        }
    }

    /// A frame turned about the outer x axis (roll), then the outer y axis (pitch), then the outer z axis
    /// (yaw) [rad], as in URDF: R = Rz Ry Rx.
    pub fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> Self {
        let about = |x: f64, y: f64, z: f64| Self::turned(Vec3::new(x, y, z));
        about(0.0, 0.0, yaw) * about(0.0, pitch, 0.0) * about(roll, 0.0, 0.0)
    }

    /// The orientation of a quaternion w + x i + y j + z k of any length but zero, of which nothing but NaN
    /// follows.
    pub fn from_quaternion_wxyz([w, x, y, z]: [f64; 4]) -> Self {
        let v = Vec3::new(x, y, z);
        // Scaled first: squares of very great or very small numbers would leave the range of a double.
        let largest = [w, x, y, z].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let (w, v) = (w / largest, v * (1.0 / largest));
        let twice = 2.0 / (w * w + v.dot(v));
        let turn = |axis: Vec3| axis + (v.cross(axis) * w + v.cross(v.cross(axis))) * twice;
        Self {
            x_axis: turn(Self::IDENTITY.x_axis),
            y_axis: turn(Self::IDENTITY.y_axis),
            z_axis: turn(Self::IDENTITY.z_axis),
            origin: Vec3::ZERO,
        }
    }

    /// The rotation vector of the orientation, log R: the axis of the turn, its angle [rad] in [0, π] for
    /// its length. Accurate at every angle; at π, where the axis may point either way, one of the two.
    pub fn rotation_vector(&self) -> Vec3 {
        let (w, v) = self.quaternion();
        let length = v.norm();
        // For a turn that small, sine and angle are the same.
        let angle_per_length = if length < 1e-150 {
            2.0
        } else {
            2.0 * atan2(length, w) / length
        };
        v * angle_per_length
    }

    /// The orientation as a quaternion w + x i + y j + z k of length 1, w not negative.
    pub fn to_quaternion_wxyz(&self) -> [f64; 4] {
        let (w, Vec3 { x, y, z }) = self.quaternion();
        [w, x, y, z]
    }

    /// Real and imaginary part of the unit quaternion of the orientation, the real part not negative. Of
    /// the four that could be divided by, the greatest component is (Shepperd 1978).
    fn quaternion(&self) -> (f64, Vec3) {
        let (x, y, z) = (self.x_axis, self.y_axis, self.z_axis);
        let beside = Vec3::new(y.z - z.y, z.x - x.z, x.y - y.x);
        let squares = [
            x.x + y.y + z.z,
            x.x - y.y - z.z,
            y.y - z.z - x.x,
            z.z - x.x - y.y,
        ];
        let greatest = (1..4).fold(
            0,
            |best, i| {
                if squares[i] > squares[best] { i } else { best }
            },
        );
        let twice = sqrt(1.0 + squares[greatest]);
        let (w, v) = match greatest {
            0 => (twice * twice, beside),
            1 => (beside.x, Vec3::new(twice * twice, y.x + x.y, z.x + x.z)),
            2 => (beside.y, Vec3::new(y.x + x.y, twice * twice, z.y + y.z)),
            _ => (beside.z, Vec3::new(z.x + x.z, z.y + y.z, twice * twice)),
        };
        let sign = if w < 0.0 { -0.5 } else { 0.5 };
        (w * sign / twice, v * (sign / twice))
    }
}

/// The transpose of the inverse of SO(3)'s left Jacobian at a rotation vector φ, applied to a direction:
/// d/dt φ = J⁻¹ ω for the angular velocity ω in the outer frame (Solà, Deray and Atchuthan, *A micro Lie
/// theory*, Eq. 146):
///
/// J⁻ᵀ = I + ½ [φ]ₓ + (1/θ² − cot(θ/2) / (2θ)) [φ]ₓ²
pub(crate) fn inverse_left_jacobian_transposed(rotation: Vec3, direction: Vec3) -> Vec3 {
    let squared = rotation.dot(rotation);
    let factor = if squared < 2.5e-3 {
        // The difference of two large numbers; its series, exact to 1e-15 here.
        1.0 / 12.0 + squared * (1.0 / 720.0 + squared * (1.0 / 30240.0 + squared / 1_209_600.0))
    } else {
        let half = 0.5 * sqrt(squared);
        let (sin, cos) = sin_cos(half);
        (1.0 - half * cos / sin) / squared
    };
    let once = rotation.cross(direction);
    direction + once * 0.5 + rotation.cross(once) * factor
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;
    use proptest::prelude::*;

    fn difference(a: Vec3, b: Vec3) -> f64 {
        (a - b).norm()
    }

    proptest! {
        #[test]
        fn logarithm_undoes_the_turn(
            axis in prop::array::uniform3(-1.0..1.0_f64),
            angle in prop_oneof![0.0..3.1_f64, 0.0..1e-6_f64, (0.0..1e-6_f64).prop_map(|x| PI - x)],
        ) {
            prop_assume!(Vec3::from(axis).norm() > 0.01);
            let rotation = Vec3::from(axis).normalized() * angle;
            let found = Pose::turned(rotation).rotation_vector();
            // So near to π either way round is right.
            let off = difference(found, rotation);
            let other_way = (found + rotation).norm();
            prop_assert!(off < 4e-15 || PI - angle < 1e-15 && other_way < 4e-15, "{off:e}");
        }

        #[test]
        fn quaternion_is_the_turn(axis in prop::array::uniform3(-1.0..1.0_f64), angle in -9.0..9.0_f64) {
            prop_assume!(Vec3::from(axis).norm() > 0.01);
            let axis = Vec3::from(axis).normalized();
            let (sin, cos) = sin_cos(0.5 * angle);
            for scale in [1.0, -3.0, 1e200, 1e-200] {
                let [x, y, z] = (axis * sin).to_array();
                let found = Pose::from_quaternion_wxyz([cos, x, y, z].map(|part| part * scale));
                let expected = Pose::turned(axis * angle);
                prop_assert!(difference(found.x_axis, expected.x_axis) < 1e-14);
                prop_assert!(difference(found.y_axis, expected.y_axis) < 1e-14);
                prop_assert!(difference(found.z_axis, expected.z_axis) < 1e-14);
            }
        }
    }

    #[test]
    fn quaternions_lead_back_to_their_orientations() {
        let half = 0.5_f64.sqrt();
        let quarter = Pose::turned(Vec3::new(0.0, 0.0, 0.5 * PI)).to_quaternion_wxyz();
        for (found, expected) in quarter.into_iter().zip([half, 0.0, 0.0, half]) {
            assert!((found - expected).abs() < 1e-15, "{quarter:?}");
        }
        for angle in [0.0, 1e-9, 1.0, 3.0, PI, -2.0, 9.0] {
            let turned = Pose::turned(Vec3::new(0.6, -0.48, 0.64) * angle);
            let quaternion = turned.to_quaternion_wxyz();
            let back = Pose::from_quaternion_wxyz(quaternion);
            assert!(quaternion[0] >= 0.0, "{quaternion:?}");
            for (found, expected) in [
                (back.x_axis, turned.x_axis),
                (back.y_axis, turned.y_axis),
                (back.z_axis, turned.z_axis),
            ] {
                assert!(difference(found, expected) < 1e-14, "angle {angle}");
            }
        }
    }

    #[test]
    fn roll_comes_first_and_yaw_last() {
        // Roll takes y to z, pitch z to x, and yaw x to y.
        let quarter = 0.5 * PI;
        let pose = Pose::from_rpy([quarter, quarter, quarter]);
        assert!(difference(pose.y_axis, Vec3::new(0.0, 1.0, 0.0)) < 1e-15);
        let pose = Pose::from_rpy([quarter, 0.0, quarter]);
        assert!(difference(pose.y_axis, Vec3::new(0.0, 0.0, 1.0)) < 1e-15);
    }

    #[test]
    fn half_a_turn_has_a_vector() {
        for axis in [
            Vec3::new(1.0, 0.0, 0.0),
            Vec3::new(0.0, -1.0, 0.0),
            Vec3::new(0.0, 0.6, 0.8),
        ] {
            // Exactly: R = 2 a aᵀ − I.
            let column = |e: Vec3| axis * (2.0 * axis.dot(e)) - e;
            let pose = Pose {
                x_axis: column(Pose::IDENTITY.x_axis),
                y_axis: column(Pose::IDENTITY.y_axis),
                z_axis: column(Pose::IDENTITY.z_axis),
                origin: Vec3::ZERO,
            };
            let found = pose.rotation_vector();
            assert!((found.norm() - PI).abs() < 1e-15);
            assert!(found.cross(axis).norm() < 1e-15);
        }
    }

    #[test]
    fn series_and_formula_agree_where_they_meet() {
        let direction = Vec3::new(0.3, -0.4, 0.8);
        let at = |squared: f64| {
            let rotation = Vec3::new(0.0, sqrt(squared), 0.0);
            inverse_left_jacobian_transposed(rotation, direction)
        };
        assert!(difference(at(2.5e-3 * (1.0 - 1e-15)), at(2.5e-3 * (1.0 + 1e-15))) < 1e-15);
    }
}
