//! Reading what concerns several joints: which, and where they are to be.

use super::config::Part;
use super::keys;
use super::mistake::Mistakes;
use super::robot::{in_one_unit, of_joint};
use super::robots::RobotFacts;
use super::table::Table;

/// 1-based numbers of the joints of a posture.
pub(super) fn joints(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<Vec<usize>> {
    let all = || (1..=robot.map_or(0, |robot| robot.joint_names.len())).collect();
    let Some(list) = table.value(&keys::JOINTS) else {
        return Some(all());
    };
    let members = list.members(keys::JOINTS.holds.expected(), found)?;
    if members.is_empty() {
        let help = keys::JOINTS.write_example();
        found.add(list.span(), &*list.path, "the list is empty", help);
        return None;
    }
    // Every member is looked at, also after a wrong one.
    let joints: Vec<_> = members
        .iter()
        .map(|member| member.joint(robot, found))
        .collect();
    let joints: Vec<usize> = joints.into_iter().collect::<Option<_>>()?;
    let repeated = (0..joints.len()).find(|&i| joints[..i].contains(&joints[i]));
    if let Some(i) = repeated {
        let (span, path) = (members[i].span(), &*members[i].path);
        let what = format!("joint {} stands in the list twice", joints[i]);
        found.add(span, path, what, "remove one of them");
        return None;
    }
    Some(joints)
}

/// Where the joints of a posture are to be [rad or m].
pub(super) fn desired(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<Vec<f64>> {
    let in_deg = table.any_joint_numbers(&keys::DESIRED_DEG, found);
    let in_rad = table.any_joint_numbers(&keys::DESIRED_RAD, found);
    let (deg, rad) = (&keys::DESIRED_DEG, &keys::DESIRED_RAD);
    let given = in_one_unit(table, deg, in_deg, rad, in_rad, found);
    let (positions, in_rad) = given.required(table, found)?;
    let named = table
        .value(&keys::JOINTS)
        .and_then(|list| Some(list.toml.get_ref().as_array()?.len()));
    let joints = named.or(robot.map(|robot| robot.joint_names.len()))?;
    if positions.len() != joints {
        let key = if table.has(deg) { deg } else { rad };
        found.add(
            table.span_of(key),
            table.path_of(key),
            format!(
                "the posture is of {joints} joints, found {} numbers",
                positions.len()
            ),
            format!("give {joints} numbers, or name in `joints` which ones they are of"),
        );
        return None;
    }
    // What is wrong with the list itself has been noted where it was read.
    let chosen = self::joints(table, robot, &mut Mistakes::new(""))?;
    let positions = positions.into_iter().zip(chosen);
    Some(
        positions
            .map(|(position, joint)| of_joint(robot, joint - 1, in_rad)(position))
            .collect(),
    )
}

/// Which rows of a Jacobian count, if the robot has as many joints.
pub(super) fn part(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<Part> {
    let part = table.choice(&keys::PART, found).or(Part::default())?;
    let rows = match part {
        Part::Position | Part::Orientation => 3,
        Part::Pose => 6,
    };
    let joints = robot?.joint_names.len();
    if joints < rows {
        found.add(
            table.span_of(&keys::PART),
            table.path_of(&keys::PART),
            format!("{joints} joints cannot move {rows} ways: the value would always be 0"),
            "take a part with fewer rows",
        );
        return None;
    }
    Some(part)
}
