//! What describes the robot: a built-in model or a URDF file, and where it stands.

use std::ffi::OsStr;
use std::path::Path;

use conik::{Frame, Pose, Robot, RobotError, Vec3};
use conik_urdf::{Described, Options, Place, UrdfError};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::config::RobotConfig;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robots::{RobotFacts, known_robots};
use super::table::{Entry, Table, unknown_name};
use super::urdf_file;

/// What describes the robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum RobotSource {
    /// The program knows it.
    Model {
        /// Name of a built-in robot.
        model: String,
    },
    /// A URDF file.
    Urdf(UrdfConfig),
}

/// A robot from a URDF file, and the file's text: what was run can be looked at without the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UrdfConfig {
    /// Path of the file, from the current directory.
    pub urdf: String,
    /// The link that stands still; `None`: the root.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    /// The tool, and further links that are moved.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tool: Vec<String>,
    /// What stands in the file.
    pub urdf_text: String,
}

/// Where the robot stands, and where on it the tool is. Angles are roll, pitch and yaw: about x, y and z
/// of the outer frame in turn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacesConfig {
    /// Position of the base in the world [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_position_m: Option<[f64; 3]>,
    /// Orientation of the base in the world [deg].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_rpy_deg: Option<[f64; 3]>,
    /// Position of the tool in the frame of the link that carries it [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tool_offset_m: Option<[f64; 3]>,
    /// Orientation of the tool in the frame of that link [deg].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tool_offset_rpy_deg: Option<[f64; 3]>,
}

/// Why there is no such robot.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DescriptionError {
    /// The model is unknown, or cannot be placed or limited so.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The URDF file has mistakes.
    #[error("{path}: {error}")]
    Urdf {
        /// Path of the file.
        path: String,
        /// What is wrong in it.
        error: UrdfError,
    },
}

/// A URDF file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Unreadable(String);

impl UrdfConfig {
    /// The robot of a URDF file, from `base` (`None`: the root) to `tool` and further tools.
    ///
    /// # Errors
    ///
    /// If the file cannot be read. What is wrong in it shows when the robot is made of it.
    pub fn load(path: &Path, base: Option<String>, tool: Vec<String>) -> Result<Self, Unreadable> {
        let urdf = path.to_string_lossy().into_owned();
        match urdf_file::read(path) {
            Ok(urdf_text) => Ok(Self {
                urdf,
                base,
                tool,
                urdf_text,
            }),
            Err(what) => Err(Unreadable(urdf + &what)),
        }
    }

    fn read(&self) -> Result<Described, UrdfError> {
        let options = Options {
            base: self.base.clone(),
            tools: self.tool.clone(),
        };
        conik_urdf::read(&self.urdf_text, &options)
    }
}

impl RobotConfig {
    /// The name of the model, or the path of the URDF file.
    pub fn name(&self) -> &str {
        match &self.source {
            RobotSource::Model { model } => model,
            RobotSource::Urdf(file) => &file.urdf,
        }
    }

    /// The name of the model, or that of the URDF file without its folders: a label for people.
    pub fn label(&self) -> &str {
        match &self.source {
            RobotSource::Model { model } => model,
            RobotSource::Urdf(file) => {
                let name = Path::new(&file.urdf).file_name();
                name.and_then(OsStr::to_str).unwrap_or(&file.urdf)
            }
        }
    }

    /// The robot as described, where it stands and with its tool; the limits are the description's.
    pub fn described(&self) -> Result<Robot, DescriptionError> {
        let robot = match &self.source {
            RobotSource::Model { model } => Robot::builtin(model)?,
            RobotSource::Urdf(file) => {
                let path = || file.urdf.clone();
                let described = file.read();
                described
                    .map_err(|error| DescriptionError::Urdf {
                        path: path(),
                        error,
                    })?
                    .robot
            }
        };
        let PlacesConfig {
            base_position_m,
            base_rpy_deg,
            tool_offset_m,
            tool_offset_rpy_deg,
        } = self.places;
        let mut robot = robot;
        if let Some(placement) = pose(tool_offset_m, tool_offset_rpy_deg) {
            let tool = free_name(&robot);
            robot = robot
                .with_frame(&tool, Frame::Tool, placement)?
                .with_tool(&tool)?;
        }
        if let Some(world_from_base) = pose(base_position_m, base_rpy_deg) {
            robot = robot.standing_at(world_from_base);
        }
        Ok(robot)
    }

    /// What of a URDF file was not taken as it stands, and what of it has no effect.
    pub fn notes(&self) -> Vec<String> {
        let RobotSource::Urdf(file) = &self.source else {
            return Vec::new();
        };
        let Ok(described) = file.read() else {
            return Vec::new();
        };
        let mut notes: Vec<String> = described.notes.iter().map(ToString::to_string).collect();
        if described.efforts.iter().any(Option::is_some) {
            let efforts = described.efforts.iter().zip(described.robot.joints());
            let shown: Vec<String> = efforts
                .filter_map(|(effort, joint)| Some(format!("{} {}", joint.name, (*effort)?)))
                .collect();
            notes.push(format!(
                "greatest efforts have no effect, conik commands motions [N·m, or N]: {}",
                shown.join(", ")
            ));
        }
        notes
    }
}

/// `tool`, or what no link of the robot is called.
fn free_name(robot: &Robot) -> String {
    let is_free = |name: &String| robot.frame(name).is_none();
    let numbered = (2..).map(|number| format!("tool_{number}"));
    let mut names = std::iter::once("tool".to_owned()).chain(numbered);
    // A robot has finitely many links.
    names.find(is_free).unwrap_or_default()
}

/// The pose that is given in one or both parts.
fn pose(position_m: Option<[f64; 3]>, rpy_deg: Option<[f64; 3]>) -> Option<Pose> {
    if position_m.is_none() && rpy_deg.is_none() {
        return None;
    }
    let turn = conik_urdf::turned(rpy_deg.unwrap_or_default().map(f64::to_radians));
    Some(Pose {
        origin: Vec3::from(position_m.unwrap_or_default()),
        ..turn
    })
}

/// Where descriptions of robots come from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sources<'a> {
    /// Where files are looked for.
    folder: &'a Path,
    /// One that was read already.
    known: Option<&'a UrdfConfig>,
}

impl<'a> Sources<'a> {
    /// Files, from a folder.
    pub(super) fn in_folder(folder: &'a Path) -> Self {
        Self {
            folder,
            known: None,
        }
    }

    /// What was read already, and files from the current directory.
    pub(super) fn knowing(known: &'a RobotSource) -> Self {
        let known = match known {
            RobotSource::Urdf(known) => Some(known),
            RobotSource::Model { .. } => None,
        };
        Self {
            folder: Path::new(""),
            known,
        }
    }

    /// The text of a URDF file.
    fn text(&self, path: &Path) -> Result<String, String> {
        let known = self.known.filter(|known| Path::new(&known.urdf) == path);
        known.map_or_else(
            || urdf_file::read(path),
            |known| Ok(known.urdf_text.clone()),
        )
    }
}

/// Reads what describes the robot, and what is known of it; `None` where that is wrong.
pub(super) fn read(
    table: &Table,
    sources: &Sources,
    found: &mut Mistakes,
) -> Option<(RobotSource, RobotFacts)> {
    match (table.has(&keys::MODEL), table.has(&keys::URDF)) {
        (true, true) => {
            mistaken(
                table,
                &keys::URDF,
                "both `model` and `urdf` are given",
                "a robot is described once: remove one of them",
                found,
            );
            None
        }
        (_, true) => read_urdf(table, sources, found),
        (has_model, false) => {
            for key in [&keys::BASE, &keys::TOOL, &keys::URDF_SHAPES] {
                if table.has(key) {
                    let what = format!("`{}` is for robots from URDF files", key.name);
                    mistaken(table, key, &what, "remove it, or give `urdf`", found);
                }
            }
            if has_model {
                return read_model(table, found);
            }
            let help = format!(
                "{}, or `{} = {}`",
                keys::MODEL.write_example(),
                keys::URDF.name,
                keys::URDF.example
            );
            mistaken(table, &keys::MODEL, "missing", &help, found);
            None
        }
    }
}

pub(super) fn mistaken(table: &Table, key: &Key, what: &str, help: &str, found: &mut Mistakes) {
    found.add(table.span_of(key), table.path_of(key), what, help);
}

fn read_model(table: &Table, found: &mut Mistakes) -> Option<(RobotSource, RobotFacts)> {
    let model = table.text(&keys::MODEL, found).given()?;
    let Some(robot) = known_robots().iter().find(|robot| robot.name == model) else {
        let names = known_robots().iter().map(|robot| robot.name.as_str());
        let (what, help) = unknown_name(model, names);
        let what = what.replace("unknown name", "unknown robot");
        mistaken(table, &keys::MODEL, &what, &help, found);
        return None;
    };
    let source = RobotSource::Model {
        model: model.to_owned(),
    };
    Some((source, robot.clone()))
}

fn read_urdf(
    table: &Table,
    sources: &Sources,
    found: &mut Mistakes,
) -> Option<(RobotSource, RobotFacts)> {
    let base = table.text(&keys::BASE, found);
    let base = base.map(|base| Some(base.to_owned())).or(None);
    let tool = table.names(&keys::TOOL, found).or(Vec::new());
    let path = match table.text(&keys::URDF, found) {
        Entry::Given(path) => sources.folder.join(path),
        _ => return None,
    };
    let path_text = path.to_string_lossy().into_owned();
    let urdf_text = match sources.text(&path) {
        Ok(text) => text,
        Err(what) => {
            let help = "give the path of a URDF file, from where the scenario's file is";
            mistaken(
                table,
                &keys::URDF,
                &format!("{path_text}{what}"),
                help,
                found,
            );
            return None;
        }
    };
    let config = UrdfConfig {
        urdf: path_text,
        base: base?,
        tool: tool?,
        urdf_text,
    };
    match config.read() {
        Ok(described) => {
            // The log parts its columns at `,` and joins the names of sets by `+`.
            // What writes from right to left on demand would turn lines of messages round.
            let is_bad = |c: char| {
                matches!(c, ',' | '+' | '"' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
                    || c.is_control()
            };
            let mut names = described.robot.joint_names();
            if let Some(name) = names.find(|name| name.contains(is_bad)) {
                let what = format!("{}: joint {name:?} cannot be named in the log", config.urdf);
                let help = "rename it: no commas, quotes, plus signs or line breaks";
                mistaken(table, &keys::URDF, &what, help, found);
                return None;
            }
            let facts = RobotFacts::of(&described.robot, described.robot.name());
            Some((RobotSource::Urdf(config), facts))
        }
        Err(error) => {
            note(table, &config.urdf, &error, found);
            None
        }
    }
}

/// Notes what is wrong in the URDF file, at the key that it concerns.
pub(super) fn note(table: &Table, path: &str, error: &UrdfError, found: &mut Mistakes) {
    let (key, place) = match &error.place {
        Place::Text {
            line,
            column,
            element,
        } if element.is_empty() => (&keys::URDF, format!("{path}:{line}:{column}: ")),
        Place::Text {
            line,
            column,
            element,
        } => (&keys::URDF, format!("{path}:{line}:{column}: {element}: ")),
        Place::Base => (&keys::BASE, format!("{path}: ")),
        Place::Tools => (&keys::TOOL, format!("{path}: ")),
    };
    mistaken(
        table,
        key,
        &format!("{place}{}", error.what),
        &error.help,
        found,
    );
}
