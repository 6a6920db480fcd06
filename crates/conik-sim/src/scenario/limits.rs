//! Reading the limits in `[robot]`, which override the model's.

use super::config::LimitsConfig;
use super::joints::Pair;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robot::{in_one_unit, of_joint};
use super::robots::RobotFacts;
use super::table::Table;

/// The limits; `None` where something in them is wrong.
pub(super) fn read(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<LimitsConfig> {
    let position = read_positions(table, robot, found);
    let speed = read_most(
        table,
        &keys::SPEED_LIMITS_DEG,
        &keys::SPEED_LIMITS_RAD,
        robot,
        found,
    );
    let acceleration = read_most(
        table,
        &keys::ACCELERATION_LIMITS_DEG,
        &keys::ACCELERATION_LIMITS_RAD,
        robot,
        found,
    );
    Some(LimitsConfig {
        position_limits_rad: position?,
        speed_limits_rad_per_s: speed?,
        acceleration_limits_rad_per_s2: acceleration?,
    })
}

/// `Some(None)` where the model's hold, `None` where something is wrong.
type Given<T> = Option<Option<T>>;

fn read_positions(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Given<Vec<Pair>> {
    let (deg, rad) = (&keys::POSITION_LIMITS_DEG, &keys::POSITION_LIMITS_RAD);
    let in_deg = table.joint_pairs(deg, robot, found);
    let in_rad = table.joint_pairs(rad, robot, found);
    in_one_unit(table, deg, in_deg, rad, in_rad, found)
        .map(|(pairs, to_rad)| {
            let pairs = pairs.into_iter().enumerate();
            Some(
                pairs
                    .map(|(joint, pair)| pair.map(|pair| pair.map(of_joint(robot, joint, to_rad))))
                    .collect(),
            )
        })
        .or(None)
}

fn read_most(
    table: &Table,
    deg: &'static Key,
    rad: &'static Key,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Given<Vec<f64>> {
    let in_deg = table.number_or_joint_numbers(deg, robot, found);
    let in_rad = table.number_or_joint_numbers(rad, robot, found);
    in_one_unit(table, deg, in_deg, rad, in_rad, found)
        .map(|(most, to_rad)| {
            let most = most.into_iter().enumerate();
            Some(
                most.map(|(joint, most)| of_joint(robot, joint, to_rad)(most))
                    .collect(),
            )
        })
        .or(None)
}
