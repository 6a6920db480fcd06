//! Reading an orientation: roll, pitch and yaw, or a quaternion.

use conik::{Pose, Vec3};

use super::direction::normalised;
use super::keys;
use super::mistake::Mistakes;
use super::table::{Entry, Table};

/// A quaternion of length 1, its real part first.
pub(super) type Quaternion = [f64; 4];

/// The desired orientation, which stands there in one way or the other.
pub(super) fn read(table: &Table, found: &mut Mistakes) -> Option<Quaternion> {
    let in_deg = table.vector(&keys::DESIRED_RPY_DEG, found);
    let as_quaternion = table.entry(&keys::DESIRED_QUATERNION_WXYZ, |value| {
        let numbers = value.numbers(&value.key.range(), found)?;
        let count = numbers.len();
        let unit = Quaternion::try_from(numbers).ok().and_then(normalised);
        if unit.is_none() {
            let what = if count == 4 {
                "the quaternion 0 is no orientation".to_owned()
            } else {
                format!("expected four numbers, w, x, y and z; found {count}")
            };
            let help = format!("any length but zero will do: {}", value.key.write_example());
            found.add(value.span(), &*value.path, what, help);
        }
        unit
    });
    match (in_deg, as_quaternion) {
        (Entry::Absent(_), Entry::Absent(_)) => {
            let key = &keys::DESIRED_RPY_DEG;
            let help = format!(
                "{}, or {}",
                key.write_example(),
                keys::DESIRED_QUATERNION_WXYZ.write_example()
            );
            let path = table.path_of(key);
            found.add(table.header.clone(), path, "missing", help);
            None
        }
        (angles, Entry::Absent(_)) => normalised(quaternion(angles.given()?)),
        (Entry::Absent(_), quaternion) => quaternion.given(),
        _ => {
            found.add(
                table.span_of(&keys::DESIRED_QUATERNION_WXYZ),
                table.path_of(&keys::DESIRED_QUATERNION_WXYZ),
                "both `desired_rpy_deg` and `desired_quaternion_wxyz` are given",
                "state it once: remove one of them",
            );
            None
        }
    }
}

/// The quaternion of roll, pitch and yaw [degrees], its real part not negative.
fn quaternion(rpy_deg: [f64; 3]) -> Quaternion {
    let rotation = Pose::from_rpy(rpy_deg.map(f64::to_radians)).rotation_vector();
    let half = 0.5 * rotation.norm();
    let per_length = if half == 0.0 {
        0.5
    } else {
        0.5 * half.sin() / half
    };
    let Vec3 { x, y, z } = rotation * per_length;
    [half.cos(), x, y, z]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quaternion_of_angles_is_the_same_orientation() {
        for rpy_deg in [
            [0.0, 0.0, 0.0],
            [180.0, 0.0, 0.0],
            [0.0, 90.0, -90.0],
            [10.0, -75.0, 130.0],
        ] {
            let expected = Pose::from_rpy(rpy_deg.map(f64::to_radians)).to_matrix();
            let found = Pose::from_quaternion_wxyz(quaternion(rpy_deg)).to_matrix();
            for (a, b) in expected.as_flattened().iter().zip(found.as_flattened()) {
                assert!((a - b).abs() < 1e-15, "{rpy_deg:?}: {a} {b}");
            }
        }
    }
}
