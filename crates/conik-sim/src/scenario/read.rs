//! Reading a scenario: the tables of the file from top to bottom, then what concerns all tasks.

use std::path::Path;

use super::collision::{self, LinkShape};
use super::config::{LimitsConfig, Scenario};
use super::control::{self, ReadControl};
use super::fit;
use super::hierarchy;
use super::keys;
use super::mistake::{Mistakes, ScenarioErrors};
use super::names;
use super::robot;
use super::robot_source::{self, RobotSource, Sources};
use super::robots::RobotFacts;
use super::shape_distance::Scene;
use super::syntax;
use super::table::{Entry, Table};
use super::task::{self, ReadTask};
use super::ur;
use super::urdf_shapes;
use crate::joint_limits::limited_robot;

/// What a task must know of the tables above it; `None` where they are wrong.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surroundings<'r> {
    pub(super) robot: Option<&'r RobotFacts>,
    pub(super) rate_hz: Option<f64>,
    pub(super) duration_s: Option<f64>,
    pub(super) scene: Option<Scene<'r>>,
}

impl Scenario {
    /// Reads the text of a scenario file. A URDF file that it names is looked for in the current
    /// directory.
    ///
    /// # Errors
    ///
    /// Every independent mistake in the text, each with its place, its key, what is wrong and what
    /// would be right. Mistakes of TOML syntax hide all others.
    pub fn from_toml(text: &str) -> Result<Self, ScenarioErrors> {
        Self::from_toml_in(&Sources::in_folder(Path::new("")), text)
    }

    /// As [`from_toml`](Self::from_toml); where the text names the URDF file of `known`, that is taken and no file
    /// is read.
    ///
    /// # Errors
    ///
    /// As [`from_toml`](Self::from_toml).
    pub fn from_toml_knowing(known: &RobotSource, text: &str) -> Result<Self, ScenarioErrors> {
        Self::from_toml_in(&Sources::knowing(known), text)
    }

    /// As [`from_toml`](Self::from_toml); a URDF file is looked for in `sources`.
    pub(super) fn from_toml_in(sources: &Sources, text: &str) -> Result<Self, ScenarioErrors> {
        let entries = syntax::parse(text)?;
        let file = Table {
            path: String::new(),
            header: 0..0,
            entries: &entries,
        };
        let mut found = Mistakes::new(text);
        let scenario = read_file(&file, sources, &mut found);
        found.into_result(scenario)
    }

    /// Applies every check of [`Scenario::from_toml`] to a scenario that a program made or changed.
    ///
    /// # Errors
    ///
    /// As [`Scenario::from_toml`]; places are those in [`Scenario::to_toml`].
    pub fn check(&self) -> Result<(), ScenarioErrors> {
        Self::from_toml_knowing(&self.robot.source, &self.to_toml()).map(|_| ())
    }
}

/// How many joints have position limits, each of which is one more task of the controller.
fn position_limits(limits: &LimitsConfig, robot: Option<&RobotFacts>) -> usize {
    match &limits.position_limits_rad {
        Some(pairs) => pairs.iter().flatten().count(),
        None => robot.map_or(0, |robot| robot.position_limits),
    }
}

fn read_file(file: &Table, sources: &Sources, found: &mut Mistakes) -> Option<Scenario> {
    file.refuse_unknown_keys(&keys::FILE.iter().copied(), |_| None, found);
    let title = match file.text(&keys::TITLE, found) {
        Entry::Absent(_) => Some(None),
        entry => entry.given().map(|title| Some(title.to_owned())),
    };

    let robot_table = file.table(&keys::ROBOT, found).required(file, found);
    let named = robot_table
        .as_ref()
        .and_then(|table| robot_source::read(table, sources, found));
    let (source, facts) = named.unzip();
    let urdf = source.clone();
    let facts = facts.as_ref();
    let robot = robot_table
        .as_ref()
        .and_then(|table| robot::read(table, source, facts, found));

    let control = match file.table(&keys::CONTROL, found) {
        Entry::Absent(_) => ReadControl::default(),
        Entry::Wrong => ReadControl::unreadable(),
        Entry::Given(table) => control::read(&table, found),
    };

    let ur = match file.table(&keys::UR, found) {
        Entry::Absent(_) => Some(None),
        Entry::Wrong => None,
        Entry::Given(table) => ur::read(&table, facts, found).map(Some),
    };

    let limited = robot.as_ref().and_then(|robot| limited_robot(robot).ok());
    let of_urdf = |own: &[LinkShape], found: &mut Mistakes| {
        let table = robot_table.as_ref()?;
        urdf_shapes::read(table, urdf.as_ref(), own, found)
    };
    let collision = collision::read(file, of_urdf, limited.as_ref(), found);
    let sets = match (&collision, &limited) {
        (Some(collision), Some(robot)) => collision.tasks(robot),
        _ => Vec::new(),
    };

    // The tip of a tool with an offset is a link too.
    let placed = facts
        .zip(limited.as_ref())
        .map(|(facts, robot)| RobotFacts {
            link_names: robot.link_names().map(str::to_owned).collect(),
            ..facts.clone()
        });
    let surroundings = Surroundings {
        robot: placed.as_ref().or(facts),
        rate_hz: control.rate_hz,
        duration_s: control.whole.as_ref().map(|control| control.duration_s),
        scene: collision.as_ref().zip(limited.as_ref()).map(|it| Scene {
            collision: it.0,
            robot: it.1,
        }),
    };
    let tasks: Option<Vec<ReadTask>> =
        file.tables(&keys::TASK, found)
            .required(file, found)
            .map(|tables| {
                let tasks = tables
                    .iter()
                    .flat_map(|table| task::read(table, surroundings, found));
                tasks.collect()
            });
    if let Some(tasks) = &tasks {
        if tasks.is_empty() {
            file.missing(&keys::TASK, found);
        }
        let limits = robot
            .as_ref()
            .map_or(0, |robot| position_limits(&robot.limits, facts));
        names::check_free(tasks, &sets, found);
        hierarchy::check(tasks, limits + sets.len(), &control.groups, found);
    }

    let places = fit::Places::of(tasks.as_deref().unwrap_or_default());
    let scenario = Scenario {
        title: title?,
        robot: robot?,
        control: control.whole?,
        ur: ur?,
        collision: collision?,
        tasks: tasks?
            .into_iter()
            .map(|task| task.config)
            .collect::<Option<_>>()?,
    };
    if found.is_empty() {
        fit::check(&scenario, &places, file, found);
    }
    Some(scenario)
}
