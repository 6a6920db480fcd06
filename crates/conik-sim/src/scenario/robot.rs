//! Reading `[robot]`.

use super::config::RobotConfig;
use super::keys;
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
    Some(RobotConfig {
        model: robot?.name.clone(),
        q0_rad: q0_rad?,
    })
}

/// The joint positions at the start, in either unit.
fn read_start(table: &Table, robot: Option<&RobotFacts>, found: &mut Mistakes) -> Option<Vec<f64>> {
    let in_rad = table.joint_numbers(&keys::Q0_RAD, robot, found);
    let in_deg = table.joint_numbers(&keys::Q0_DEG, robot, found);
    if in_rad.is_present() && in_deg.is_present() {
        found.add(
            table.span_of(&keys::Q0_RAD),
            table.path_of(&keys::Q0_RAD),
            "both `q0_deg` and `q0_rad` are given",
            "state the start once: remove one of them",
        );
        return None;
    }
    if in_rad.is_present() {
        return in_rad.given();
    }
    let degrees = in_deg.required(table, found)?;
    Some(degrees.into_iter().map(f64::to_radians).collect())
}
