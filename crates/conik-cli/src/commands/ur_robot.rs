//! Whether a robot can be driven as an arm of Universal Robots.

use conik::{Joint, JointKind, Robot};
use conik_sim::scenario::{RobotSource, Scenario, UrModel};

use crate::failure::Failure;
use crate::layout::counted;

/// Joints of the arms of Universal Robots.
const UR_JOINTS: usize = 6;

/// What stands in the names of these joints in the maker's description, from the base on: prefixes are
/// before it, `_joint` behind it.
const IN_NAMES: [&str; UR_JOINTS] = [
    "shoulder_pan",
    "shoulder_lift",
    "elbow",
    "wrist_1",
    "wrist_2",
    "wrist_3",
];

/// Refuses a robot that a controller of Universal Robots cannot have, and warns of one that it does not.
pub fn refuse_others(arm: &str, scenario: &Scenario, robot: &Robot) -> Result<(), Failure> {
    let turns = |joint: &Joint| joint.kind == JointKind::Revolute;
    let name = scenario.robot.name();
    let try_ideal = "`--robot ideal` runs any robot";
    if robot.dof() != UR_JOINTS || !robot.joints().iter().all(turns) {
        let has = match robot.joints().iter().filter(|joint| !turns(joint)).count() {
            0 => joints(robot.dof()),
            sliding => format!("{}, of which {sliding} slide", joints(robot.dof())),
        };
        return Err(Failure::input(format!(
            "--robot {arm}: drives arms of Universal Robots, which have six joints that turn; {name} \
             has {has}: {try_ideal}"
        )));
    }
    if let Some(names) = out_of_order(robot) {
        return Err(Failure::input(format!(
            "--robot {arm}: the controller takes joints from base to wrist, {name} has them as {names}: \
             choose `base` and `tool` so that the base stands still, or {try_ideal}"
        )));
    }
    let of_file = matches!(scenario.robot.source, RobotSource::Urdf(_));
    if of_file && UrModel::in_name(robot.name()).is_none() {
        super::warn(&format!(
            "{name}: robot `{}` is none of Universal Robots by its name, and --robot {arm} drives it as \
             one; {try_ideal}",
            robot.name()
        ));
    }
    Ok(())
}

/// The joints' names, if they are those of a UR arm in another order: seen from its wrist, say.
fn out_of_order(robot: &Robot) -> Option<String> {
    let places: Option<Vec<usize>> = robot
        .joint_names()
        .map(|name| IN_NAMES.iter().position(|part| name.contains(part)))
        .collect();
    let is_in_order = places?.into_iter().eq(0..UR_JOINTS);
    let names = || robot.joint_names().collect::<Vec<_>>().join(", ");
    (!is_in_order).then(names)
}

fn joints(number: usize) -> String {
    counted(number as u64, "joint")
}
