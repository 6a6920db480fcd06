//! Reading `[robot]`.

use super::config::RobotConfig;
use super::key::Key;
use super::keys;
use super::limits;
use super::mistake::Mistakes;
use super::robot_source::{PlacesConfig, RobotSource};
use super::robots::RobotFacts;
use super::table::{Entry, Table};

/// Reads the whole table, once it is known which robot it names.
pub(super) fn read(
    table: &Table,
    source: Option<RobotSource>,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<RobotConfig> {
    table.refuse_unknown_keys(&keys::ROBOT_KEYS.iter().copied(), |_| None, found);
    let q0_rad = read_start(table, robot, found);
    let limits = limits::read(table, robot, found);
    let places = read_places(table, found);
    Some(RobotConfig {
        source: source?,
        places: places?,
        q0_rad: q0_rad?,
        limits: limits?,
    })
}

/// The joint positions at the start, in either unit.
fn read_start(table: &Table, robot: Option<&RobotFacts>, found: &mut Mistakes) -> Option<Vec<f64>> {
    let in_deg = table.joint_numbers(&keys::Q0_DEG, robot, found);
    let in_rad = table.joint_numbers(&keys::Q0_RAD, robot, found);
    let given = in_one_unit(table, &keys::Q0_DEG, in_deg, &keys::Q0_RAD, in_rad, found);
    let (positions, in_rad) = given.required(table, found)?;
    let positions = positions.into_iter().enumerate();
    Some(
        positions
            .map(|(joint, position)| of_joint(robot, joint, in_rad)(position))
            .collect(),
    )
}

/// What makes radians of an angle of a joint; lengths of one that slides are in [m] under every key.
pub(super) fn of_joint(robot: Option<&RobotFacts>, joint: usize, in_rad: ToRadians) -> ToRadians {
    let slides = robot.and_then(|robot| robot.slides.get(joint));
    match slides {
        Some(true) => |length| length,
        _ => in_rad,
    }
}

/// Where the robot stands, and where on it the tool is.
fn read_places(table: &Table, found: &mut Mistakes) -> Option<PlacesConfig> {
    let mut vector = |key| table.vector(key, found).map(Some).or(None);
    let (base_position_m, base_rpy_deg) =
        (vector(&keys::BASE_POSITION_M), vector(&keys::BASE_RPY_DEG));
    let (tool_offset_m, tool_rpy_deg) = (vector(&keys::TOOL_OFFSET_M), vector(&keys::TOOL_RPY_DEG));
    Some(PlacesConfig {
        base_position_m: base_position_m?,
        base_rpy_deg: base_rpy_deg?,
        tool_offset_m: tool_offset_m?,
        tool_offset_rpy_deg: tool_rpy_deg?,
    })
}

/// Makes radians of an angle in the unit in which it was given.
pub(super) type ToRadians = fn(f64) -> f64;

/// What stands under one of two keys, in degrees or in radians, with what makes it radians.
pub(super) fn in_one_unit<T>(
    table: &Table,
    deg: &Key,
    in_deg: Entry<T>,
    rad: &Key,
    in_rad: Entry<T>,
    found: &mut Mistakes,
) -> Entry<(T, ToRadians)> {
    match (in_deg, in_rad) {
        (in_deg, Entry::Absent(_)) => in_deg.map(|given| (given, f64::to_radians as _)),
        (Entry::Absent(_), in_rad) => in_rad.map(|given| (given, (|angle| angle) as _)),
        _ => {
            found.add(
                table.span_of(rad),
                table.path_of(rad),
                format!("both `{}` and `{}` are given", deg.name, rad.name),
                "state it once: remove one of them",
            );
            Entry::Wrong
        }
    }
}
