//! Whether a robot can be driven as an arm of Universal Robots.

use conik::{Joint, JointKind, Robot};
use conik_sim::scenario::{RobotSource, Scenario, UrModel};

use crate::failure::Failure;
use crate::layout::counted;

/// Joints of the arms of Universal Robots.
const UR_JOINTS: usize = 6;

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

fn joints(number: usize) -> String {
    counted(number as u64, "joint")
}
