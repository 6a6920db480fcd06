//! Reading an orientation: roll, pitch and yaw, or a quaternion.

use conik::{Pose, Vec3};

use super::direction::normalised;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::table::{Entry, Table};
use super::value::Value;

/// A quaternion of length 1, its real part first.
pub(super) type Quaternion = [f64; 4];

/// The desired orientation, which stands there in one way or the other.
pub(super) fn read(table: &Table, found: &mut Mistakes) -> Option<Quaternion> {
    let (rpy, wxyz) = (&keys::DESIRED_RPY_DEG, &keys::DESIRED_QUATERNION_WXYZ);
    let in_deg = table.vector(rpy, found).map(quaternion);
    let as_quaternion = table.entry(wxyz, |value| unit(value, found));
    in_one_way(table, (rpy, in_deg), (wxyz, as_quaternion), found)
}

/// The orientations of waypoints, which stand there in one way or the other.
pub(super) fn read_waypoints(table: &Table, found: &mut Mistakes) -> Option<Vec<Quaternion>> {
    let (rpy, wxyz) = (&keys::WAYPOINTS_RPY_DEG, &keys::WAYPOINTS_QUATERNION_WXYZ);
    let in_deg = table.points(rpy, found);
    let in_deg = in_deg.map(|turns| turns.into_iter().map(quaternion).collect());
    let as_quaternion = table.entry(wxyz, |value| {
        let members = value.lists("a list of four numbers", found)?;
        if members.is_empty() {
            let help = format!("give at least one: {}", value.key.write_example());
            found.add(value.span(), &*value.path, "the list is empty", help);
            return None;
        }
        // Every member is looked at, also after a wrong one.
        let units: Vec<_> = members.iter().map(|member| unit(member, found)).collect();
        units.into_iter().collect()
    });
    in_one_way(table, (rpy, in_deg), (wxyz, as_quaternion), found)
}

/// A quaternion of any length but zero, brought to length 1.
fn unit(value: &Value, found: &mut Mistakes) -> Option<Quaternion> {
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
}

/// What stands under one of two keys.
fn in_one_way<T>(
    table: &Table,
    (rpy, in_deg): (&Key, Entry<T>),
    (wxyz, as_quaternion): (&Key, Entry<T>),
    found: &mut Mistakes,
) -> Option<T> {
    match (in_deg, as_quaternion) {
        (Entry::Absent(_), Entry::Absent(_)) => {
            let help = format!("{}, or {}", rpy.write_example(), wxyz.write_example());
            found.add(table.header.clone(), table.path_of(rpy), "missing", help);
            None
        }
        (in_deg, Entry::Absent(_)) => in_deg.given(),
        (Entry::Absent(_), as_quaternion) => as_quaternion.given(),
        _ => {
            found.add(
                table.span_of(wxyz),
                table.path_of(wxyz),
                format!("both `{}` and `{}` are given", rpy.name, wxyz.name),
                "state it once: remove one of them",
            );
            None
        }
    }
}

/// The quaternion of length 1 of roll, pitch and yaw [degrees], its real part not negative.
fn quaternion(rpy_deg: [f64; 3]) -> Quaternion {
    let rotation = Pose::from_rpy(rpy_deg.map(f64::to_radians)).rotation_vector();
    let half = 0.5 * rotation.norm();
    let per_length = if half == 0.0 {
        0.5
    } else {
        0.5 * half.sin() / half
    };
    let Vec3 { x, y, z } = rotation * per_length;
    let wxyz = [half.cos(), x, y, z];
    normalised(wxyz).unwrap_or(wxyz)
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
