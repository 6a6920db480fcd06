//! `conik robots`: the built-in robots, and what is known of one.

use std::process::ExitCode;

use conik::{Joint, JointKind, Kinematics, Robot};

use crate::arguments::RobotsArguments;
use crate::failure::Failure;
use crate::layout::{counted, table, wrapped};

/// Lists the robots, or describes one.
pub fn robots(arguments: &RobotsArguments) -> Result<ExitCode, Failure> {
    let text = match &arguments.name {
        Some(name) => description(name),
        None => list(),
    };
    super::print(&text.map_err(Failure::input)?)
}

fn list() -> Result<String, conik::RobotError> {
    let mut rows = vec![["robot", "joints", "reach", "source"].map(str::to_owned)];
    for name in Robot::builtin_names() {
        let robot = Robot::builtin(name)?;
        rows.push([
            name.to_owned(),
            robot.dof().to_string(),
            reach(&robot),
            Robot::builtin_source(name)?.to_owned(),
        ]);
    }
    Ok(format!("{}\nnow: conik robots NAME\n", table(&rows)))
}

/// No frame is further from a joint that moves it than the links between them are long.
fn reach(robot: &Robot) -> String {
    format!("≤ {:.2} m", Kinematics::new(robot).reach())
}

fn description(name: &str) -> Result<String, conik::RobotError> {
    let robot = Robot::builtin(name)?;
    let source = Robot::builtin_source(name)?;
    let mut rows = vec![["joint", "", "position", "speed", "acceleration"].map(str::to_owned)];
    rows.extend(robot.joints().iter().map(joint));
    let links: Vec<&str> = robot.link_names().collect();
    let count = u64::try_from(robot.dof()).unwrap_or(u64::MAX);
    Ok([
        format!(
            "robot {name}, {}, tool `{}`\n",
            counted(count, "joint"),
            robot.tool_name()
        ),
        wrapped("  ", &format!("source: {source}")),
        format!("\n{}\n", table(&rows)),
        wrapped("  ", &format!("frames: {}", links.join(", "))),
    ]
    .concat())
}

fn joint(joint: &Joint) -> [String; 5] {
    let (per_unit, unit, unlimited, kind) = match joint.kind {
        JointKind::Revolute => (1_f64.to_degrees(), "°", "without end", "revolute"),
        JointKind::Prismatic => (1.0, " m", "unlimited", "prismatic"),
    };
    let limits = joint.limits;
    let at_most = |limit: Option<f64>, unit: String| match limit {
        Some(limit) => format!("≤ {:.1}{unit}", limit * per_unit),
        None => "–".to_owned(),
    };
    [
        joint.name.clone(),
        kind.to_owned(),
        limits
            .position
            .map_or(unlimited.to_owned(), |(least, most)| {
                format!("{:.1}…{:.1}{unit}", least * per_unit, most * per_unit)
            }),
        at_most(limits.speed, format!("{unit}/s")),
        at_most(limits.acceleration, format!("{unit}/s²")),
    ]
}
