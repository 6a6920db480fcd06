//! The robots that need no file, each from the figures that its maker publishes.
//!
//! One file per maker, with its sources. Every robot has its maker's name for a joint and, beside the
//! frames of its table (`link_0` to `link_n`), the frames that people know by name; `docs/robots.md`
//! lists them.

mod franka;
mod kinova;
mod kuka;
mod paper;
mod universal_robots;

use alloc::string::ToString;

use super::{Joint, JointKind, JointLimits, Robot, RobotError};

pub use universal_robots::UrArm;

/// A robot that needs no file.
struct Builtin {
    name: &'static str,
    /// Where its figures are from, in a line.
    source: &'static str,
    build: fn() -> Result<Robot, RobotError>,
}

const fn entry(
    name: &'static str,
    source: &'static str,
    build: fn() -> Result<Robot, RobotError>,
) -> Builtin {
    Builtin {
        name,
        source,
        build,
    }
}

const PAPER: &str = "Moe et al. 2015, Table I";

const ALL: [Builtin; 14] = [
    entry(paper::NAME, PAPER, paper::robot),
    entry(UrArm::UR3.name, UrArm::SOURCE, || UrArm::UR3.robot()),
    entry(UrArm::UR5.name, UrArm::SOURCE, || UrArm::UR5.robot()),
    entry(UrArm::UR10.name, UrArm::SOURCE, || UrArm::UR10.robot()),
    entry(UrArm::UR3E.name, UrArm::SOURCE, || UrArm::UR3E.robot()),
    entry(UrArm::UR5E.name, UrArm::SOURCE, || UrArm::UR5E.robot()),
    entry(UrArm::UR10E.name, UrArm::SOURCE, || UrArm::UR10E.robot()),
    entry(UrArm::UR16E.name, UrArm::SOURCE, || UrArm::UR16E.robot()),
    entry(UrArm::UR20.name, UrArm::SOURCE, || UrArm::UR20.robot()),
    entry(UrArm::UR30.name, UrArm::SOURCE, || UrArm::UR30.robot()),
    entry("panda", franka::SOURCE, franka::panda),
    entry("fr3", franka::SOURCE, franka::fr3),
    entry("iiwa14", kuka::SOURCE, kuka::iiwa14),
    entry("gen3", kinova::SOURCE, kinova::gen3),
];

fn find(name: &str) -> Result<&'static Builtin, RobotError> {
    const { &ALL }
        .iter()
        .find(|builtin| builtin.name == name)
        .ok_or_else(|| RobotError::Unknown {
            name: name.to_string(),
        })
}

impl Robot {
    /// A built-in robot by its name.
    pub fn builtin(name: &str) -> Result<Self, RobotError> {
        (find(name)?.build)()
    }

    /// Names that [`builtin`](Self::builtin) knows.
    pub fn builtin_names() -> [&'static str; ALL.len()] {
        ALL.map(|builtin| builtin.name)
    }

    /// Whose figures a built-in robot has, and where they are printed.
    pub fn builtin_source(name: &str) -> Result<&'static str, RobotError> {
        Ok(find(name)?.source)
    }
}

fn revolute(name: &str, limits: JointLimits) -> Joint {
    Joint {
        name: name.to_string(),
        kind: JointKind::Revolute,
        limits,
    }
}

/// Limits that are the same either way, published in degrees: position, if there is a limit, and speed.
fn in_degrees(position_deg: Option<f64>, speed_deg_per_s: f64) -> JointLimits {
    JointLimits {
        position: position_deg.map(|most| (-most.to_radians(), most.to_radians())),
        speed: Some(speed_deg_per_s.to_radians()),
        acceleration: None,
    }
}
