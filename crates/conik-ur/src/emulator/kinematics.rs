//! Where the tool is: forward kinematics from the arm's published Denavit-Hartenberg parameters.

use crate::model::{ArmFacts, TWISTS};
use crate::registers::JOINTS;

/// Rotation by rows, and position [m].
type Frame = ([[f64; 3]; 3], [f64; 3]);

/// Position [m] and rotation vector [rad] of the flange in the base.
pub(super) fn pose(arm: &ArmFacts, q: &[f64; JOINTS]) -> [f64; 6] {
    let (rotation, p) = frames(arm, q)[JOINTS];
    let w = rotation_vector(&rotation);
    [p[0], p[1], p[2], w[0], w[1], w[2]]
}

/// Linear [m/s] and angular [rad/s] velocity of the flange in the base.
pub(super) fn twist(arm: &ArmFacts, q: &[f64; JOINTS], qd: &[f64; JOINTS]) -> [f64; 6] {
    let frames = frames(arm, q);
    let (_, tool) = frames[JOINTS];
    let mut twist = [0.0; 6];
    for ((rotation, origin), speed) in frames.iter().zip(qd) {
        let axis = [rotation[0][2], rotation[1][2], rotation[2][2]];
        let lever = std::array::from_fn(|i| tool[i] - origin[i]);
        let moved = cross(&axis, &lever);
        for i in 0..3 {
            twist[i] += moved[i] * speed;
            twist[3 + i] += axis[i] * speed;
        }
    }
    twist
}

/// The frame before each joint and, last, that of the flange.
fn frames(arm: &ArmFacts, q: &[f64; JOINTS]) -> [Frame; JOINTS + 1] {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut frames = [(identity, [0.0; 3]); JOINTS + 1];
    for joint in 0..JOINTS {
        let (rotation, origin) = frames[joint];
        let ((s, c), (sa, ca)) = (q[joint].sin_cos(), TWISTS[joint].sin_cos());
        let turn = [[c, -s * ca, s * sa], [s, c * ca, -c * sa], [0.0, sa, ca]];
        let length = arm.lengths[joint];
        let step = [length * c, length * s, arm.offsets[joint]];
        let next = std::array::from_fn(|row| {
            std::array::from_fn(|column| (0..3).map(|k| rotation[row][k] * turn[k][column]).sum())
        });
        let place = std::array::from_fn(|row| {
            origin[row] + (0..3).map(|k| rotation[row][k] * step[k]).sum::<f64>()
        });
        frames[joint + 1] = (next, place);
    }
    frames
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Through the quaternion with the largest component in front, which is safe at half a turn too.
fn rotation_vector(r: &[[f64; 3]; 3]) -> [f64; 3] {
    let trace = r[0][0] + r[1][1] + r[2][2];
    let largest = (0..3)
        .max_by(|a, b| r[*a][*a].total_cmp(&r[*b][*b]))
        .unwrap_or(0);
    let (mut vector, mut scalar);
    if trace > r[largest][largest] {
        scalar = 1.0 + trace;
        vector = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    } else {
        let (i, j, k) = (largest, (largest + 1) % 3, (largest + 2) % 3);
        scalar = r[k][j] - r[j][k];
        vector = [0.0; 3];
        vector[i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
        vector[j] = r[j][i] + r[i][j];
        vector[k] = r[k][i] + r[i][k];
    }
    if scalar < 0.0 {
        scalar = -scalar;
        vector = vector.map(|v| -v);
    }
    let sine = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
    if sine < 1e-12 {
        return [0.0; 3];
    }
    let angle = 2.0 * sine.atan2(scalar);
    vector.map(|v| v / sine * angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use conik_sim::scenario::{UrModel, UrSeries};
    use std::f64::consts::FRAC_PI_2;

    fn ur5() -> &'static ArmFacts {
        ArmFacts::of(UrModel::Ur5, UrSeries::Cb3).unwrap()
    }

    /// At zero the maker's model stretches along −x with the tool towards −y.
    #[test]
    fn the_arm_at_zero_is_stretched() {
        let pose = pose(ur5(), &[0.0; 6]);
        let expected = [-0.81725, -0.191_45, -0.005_491, FRAC_PI_2, 0.0, 0.0];
        for (have, need) in pose.iter().zip(expected) {
            assert!((have - need).abs() < 1e-9, "{pose:?}");
        }
    }

    #[test]
    fn the_velocity_is_the_poses_derivative() {
        let q = [0.3, -1.2, 1.4, -0.7, 0.9, 0.2];
        let qd = [0.5, -0.3, 0.2, 0.7, -0.6, 0.4];
        let h = 1e-6;
        let at = |side: f64| {
            pose(
                ur5(),
                &std::array::from_fn(|joint| q[joint] + side * h * qd[joint]),
            )
        };
        let (before, after) = (at(-1.0), at(1.0));
        let twist = twist(ur5(), &q, &qd);
        for axis in 0..3 {
            let slope = (after[axis] - before[axis]) / (2.0 * h);
            assert!((slope - twist[axis]).abs() < 1e-8, "axis {axis}");
        }
    }
}
