//! Reading `[robot]`.

use super::config::RobotConfig;
use super::key::Key;
use super::keys;
use super::limits;
use super::mistake::Mistakes;
use super::robots::{RobotFacts, known_robots};
use super::table::{Entry, Table, unknown_name};

/// What is known of the robot that the table names; `None` if it names none that is known.
pub(super) fn read_model(table: &Table, found: &mut Mistakes) -> Option<&'static RobotFacts> {
    let model = match table.text(&keys::MODEL, found) {
        Entry::Absent(_) => {
            // A robot described otherwise is not a forgotten model: the key says what is wrong.
            let described = keys::ROBOT_KEYS_NOT_YET
                .iter()
                .any(|key| table.entries.contains_key(*key));
            if !described {
                table.missing(&keys::MODEL, found);
            }
            return None;
        }
        entry => entry.given()?,
    };
    let robot = known_robots().iter().find(|robot| robot.name == model);
    if robot.is_none() {
        let (what, help) = unknown_name(
            model,
            known_robots().iter().map(|robot| robot.name.as_str()),
        );
        let what = what.replace("unknown name", "unknown robot");
        found.add(
            table.span_of(&keys::MODEL),
            table.path_of(&keys::MODEL),
            what,
            help,
        );
    }
    robot
}

/// Reads the whole table, once it is known which robot it names.
pub(super) fn read(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<RobotConfig> {
    let not_yet = |name: &str| {
        keys::ROBOT_KEYS_NOT_YET.contains(&name).then(|| {
            (
                format!("this version does not have `{name}` yet"),
                format!("it has built-in robots: {}", keys::MODEL.write_example()),
            )
        })
    };
    table.refuse_unknown_keys(&keys::ROBOT_KEYS.iter().copied(), not_yet, found);
    let q0_rad = read_start(table, robot, found);
    let limits = limits::read(table, robot, found);
    Some(RobotConfig {
        model: robot?.name.clone(),
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
    Some(positions.into_iter().map(in_rad).collect())
}

/// Makes radians of an angle in the unit in which it was given.
type ToRadians = fn(f64) -> f64;

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
