//! Writing a scenario as a file that reads back to the same scenario.

use std::fmt::Write;

use super::choice::Choice;
use super::collision::Collision;
use super::config::{
    Control, GoalConfig, LimitsConfig, RobotConfig, Scenario, TaskConfig, TaskKind,
};
use super::damping;
use super::geometry::Geometry;
use super::key::Key;
use super::keys;
use super::motion;
use super::robot_source::{PlacesConfig, RobotSource, UrdfConfig};
use super::written::written;

impl Scenario {
    /// The scenario as the text of a scenario file: every setting of robot and control
    /// stands in it, defaults too.
    pub fn to_toml(&self) -> String {
        let mut file = Lines::default();
        if let Some(title) = &self.title {
            file.line(keys::TITLE.name, &text(title));
        }
        write_robot(&self.robot, &mut file);
        write_control(&self.control, &mut file);
        if let Some(ur) = &self.ur {
            file.header(&keys::UR);
            for (key, value) in ur.written() {
                file.line(key.name, &value);
            }
        }
        write_collision(&self.collision, &mut file);
        for task in &self.tasks {
            write_task(task, &mut file);
        }
        file.text
    }
}

impl RobotConfig {
    /// The robot as the table `[robot]` of a scenario file.
    pub fn to_toml(&self) -> String {
        let mut file = Lines::default();
        write_robot(self, &mut file);
        file.text
    }
}

/// The lines of the file written so far.
#[derive(Default)]
struct Lines {
    text: String,
}

impl Lines {
    fn header(&mut self, key: &Key) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
        self.text.push_str(key.example);
        self.text.push('\n');
    }

    fn line(&mut self, name: &str, value: &str) {
        for part in [name, " = ", value, "\n"] {
            self.text.push_str(part);
        }
    }

    fn number(&mut self, key: &Key, value: f64) {
        self.line(key.name, &number(value));
    }
}

fn write_robot(robot: &RobotConfig, file: &mut Lines) {
    file.header(&keys::ROBOT);
    match &robot.source {
        RobotSource::Model { model } => file.line(keys::MODEL.name, &text(model)),
        RobotSource::Urdf(UrdfConfig {
            urdf, base, tool, ..
        }) => {
            file.line(keys::URDF.name, &text(urdf));
            if let Some(base) = base {
                file.line(keys::BASE.name, &text(base));
            }
            if !tool.is_empty() {
                file.line(keys::TOOL.name, &list(tool.iter().map(|name| text(name))));
            }
        }
    }
    let PlacesConfig {
        base_position_m,
        base_rpy_deg,
        tool_offset_m,
        tool_offset_rpy_deg,
    } = &robot.places;
    for (key, place) in [
        (&keys::BASE_POSITION_M, base_position_m),
        (&keys::BASE_RPY_DEG, base_rpy_deg),
        (&keys::TOOL_OFFSET_M, tool_offset_m),
        (&keys::TOOL_RPY_DEG, tool_offset_rpy_deg),
    ] {
        if let Some(place) = place {
            file.line(key.name, &vector(place));
        }
    }
    file.line(keys::Q0_RAD.name, &vector(&robot.q0_rad));
    let LimitsConfig {
        position_limits_rad,
        speed_limits_rad_per_s,
        acceleration_limits_rad_per_s2,
    } = &robot.limits;
    if let Some(limits) = position_limits_rad {
        let pair = |pair: &Option<[f64; 2]>| vector(pair.as_ref().map_or(&[], |pair| &pair[..]));
        let pairs = list(limits.iter().map(pair));
        file.line(keys::POSITION_LIMITS_RAD.name, &pairs);
    }
    for (key, limits) in [
        (&keys::SPEED_LIMITS_RAD, speed_limits_rad_per_s),
        (
            &keys::ACCELERATION_LIMITS_RAD,
            acceleration_limits_rad_per_s2,
        ),
    ] {
        if let Some(limits) = limits {
            file.line(key.name, &vector(limits));
        }
    }
}

fn write_control(control: &Control, file: &mut Lines) {
    file.header(&keys::CONTROL);
    file.number(&keys::RATE_HZ, control.rate_hz);
    file.number(&keys::DURATION_S, control.duration_s);
    file.line(keys::MODE_RULE.name, &text(control.mode_rule.name()));
    file.line(keys::BORDER.name, &text(control.border.name()));
    file.line(keys::RECURSION.name, &text(control.recursion.name()));
    let group = |names: &Vec<String>| list(names.iter().map(|name| text(name)));
    file.line(
        keys::EXCLUSIVE.name,
        &list(control.exclusive.iter().map(group)),
    );
}

fn write_collision(collision: &Collision, file: &mut Lines) {
    for shape in &collision.shapes {
        file.header(&keys::SHAPE);
        file.line(keys::NAME.name, &text(&shape.name));
        file.line(keys::LINK.name, &text(&shape.link));
        write_geometry(&shape.geometry, file);
    }
    for obstacle in &collision.obstacles {
        file.header(&keys::OBSTACLE);
        file.line(keys::NAME.name, &text(&obstacle.name));
        write_geometry(&obstacle.geometry, file);
        if let Some(distance_m) = obstacle.distance_m {
            file.number(&keys::DISTANCE_M, distance_m);
        }
        for (name, value) in motion::written(&obstacle.motion) {
            file.line(name, &value);
        }
    }
    if let Some(own) = &collision.self_collision {
        file.header(&keys::SELF_COLLISION);
        file.number(&keys::DISTANCE_M, own.distance_m);
        let group = |names: &Vec<String>| list(names.iter().map(|name| text(name)));
        file.line(keys::EXCLUDE.name, &list(own.exclude.iter().map(group)));
    }
}

fn write_geometry(geometry: &Geometry, file: &mut Lines) {
    file.line(keys::TYPE.name, &text(geometry.type_name()));
    for (name, value) in geometry.written() {
        file.line(name, &value);
    }
}

fn write_task(task: &TaskConfig, file: &mut Lines) {
    file.header(&keys::TASK);
    file.line(keys::NAME.name, &text(&task.name));
    let (type_name, values) = written(&task.kind);
    file.line(keys::TYPE.name, &text(type_name));
    // Where it goes first is the first of its waypoints.
    let visits = task.goal.waypoint_count().is_some();
    let own = values.into_iter().filter(|_| !visits);
    let own = own.chain(task.frames.written());
    for (name, value) in own.chain(motion::written(&task.motion)) {
        file.line(name, &value);
    }
    match &task.goal {
        GoalConfig::Waypoints {
            waypoints_m,
            waypoints_quaternion_wxyz,
            acceptance_m,
            acceptance_rad,
            gain_per_s,
        } => {
            if !waypoints_m.is_empty() {
                let points = list(waypoints_m.iter().map(|point| vector(point)));
                file.line(keys::WAYPOINTS_M.name, &points);
            }
            if !waypoints_quaternion_wxyz.is_empty() {
                let turns = list(waypoints_quaternion_wxyz.iter().map(|turn| vector(turn)));
                file.line(keys::WAYPOINTS_QUATERNION_WXYZ.name, &turns);
            }
            for (key, acceptance) in [
                (&keys::ACCEPTANCE_M, acceptance_m),
                (&keys::ACCEPTANCE_RAD, acceptance_rad),
            ] {
                if let Some(acceptance) = acceptance {
                    file.number(key, *acceptance);
                }
            }
            file.number(&keys::GAIN_PER_S, *gain_per_s);
        }
        GoalConfig::Desired {
            desired,
            gain_per_s,
        } => {
            match (&task.kind, desired.as_slice()) {
                (TaskKind::Orientation { .. } | TaskKind::Pose { .. }, _) => {}
                (TaskKind::JointSpeed { .. }, _) => return write_damping(task, file),
                (TaskKind::Posture { .. }, positions) => {
                    file.line(keys::DESIRED_RAD.name, &vector(positions));
                }
                (TaskKind::Position, point) => file.line(keys::TARGET_M.name, &vector(point)),
                (_, [value]) => file.number(&keys::DESIRED, *value),
                (_, values) => file.line(keys::DESIRED.name, &vector(values)),
            }
            file.number(&keys::GAIN_PER_S, *gain_per_s);
        }
        GoalConfig::Set {
            min,
            max,
            recovery_per_s,
            gain_per_s,
        } => {
            for (key, value) in [
                (&keys::MIN, min),
                (&keys::MAX, max),
                (&keys::RECOVERY_PER_S, recovery_per_s),
                (&keys::GAIN_PER_S, gain_per_s),
            ] {
                if let Some(value) = value {
                    file.number(key, *value);
                }
            }
        }
    }
    write_damping(task, file);
}

fn write_damping(task: &TaskConfig, file: &mut Lines) {
    if let Some((key, value)) = damping::written(task.damping) {
        file.line(key.name, &value);
    }
}

/// The shortest decimal that reads back to the same number.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        "nan".to_owned()
    } else {
        format!("{value:?}")
    }
}

pub(super) fn vector(values: &[f64]) -> String {
    list(values.iter().map(|value| number(*value)))
}

fn list(members: impl Iterator<Item = String>) -> String {
    format!("[{}]", members.collect::<Vec<_>>().join(", "))
}

/// A basic string of TOML.
pub(super) fn text(content: &str) -> String {
    let mut quoted = String::from("\"");
    for c in content.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            _ if c.is_control() => {
                // Writing into a string cannot fail.
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            _ => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
