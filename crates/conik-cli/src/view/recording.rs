//! All that the page reads: one run, or two to be compared.

use std::path::{Path, PathBuf};

use conik_sim::experiment::ExperimentError;
use conik_sim::live::ChangeError;
use conik_sim::summary::ChangeMade;
use serde::Serialize;

use super::PROTOCOL;
use super::scene::Scene;
use super::ticks::{MOST_ROWS, Ticks};
use crate::figure::{Run, RunError};

/// Runs to be looked at side by side.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recording {
    kind: &'static str,
    protocol: u32,
    runs: Vec<RecordedRun>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct RecordedRun {
    /// Name of its folder.
    name: String,
    scene: Scene,
    /// The scenes after changes that people made.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    later: Vec<LaterScene>,
    ticks: Ticks,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct LaterScene {
    from_s: f64,
    #[serde(flatten)]
    scene: Scene,
}

/// Why a run cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The folder cannot be read.
    #[error(transparent)]
    Run(#[from] RunError),
    /// What was run is not what this program can run.
    #[error("{}: the scenario in its summary cannot be made ready", dir.display())]
    Scenario {
        /// The folder.
        dir: PathBuf,
        /// What does not fit.
        source: Box<ExperimentError>,
    },
    /// What was changed while it ran does not fit what was run.
    #[error("{}: the changes in its summary do not fit its scenario", dir.display())]
    Changes {
        /// The folder.
        dir: PathBuf,
        /// Why not.
        source: ChangeError,
    },
}

impl Recording {
    /// The runs in the folders `dirs`.
    pub fn load<P: AsRef<Path>>(dirs: &[P]) -> Result<Self, ViewError> {
        let runs = dirs.iter().map(|dir| RecordedRun::load(dir.as_ref()));
        Ok(Self {
            kind: "recording",
            protocol: PROTOCOL,
            runs: runs.collect::<Result<_, _>>()?,
        })
    }

    /// A run that goes on, as it is now.
    pub(super) fn of_live(name: &str, scene: Scene, ticks: Ticks) -> Self {
        Self {
            kind: "recording",
            protocol: PROTOCOL,
            runs: vec![RecordedRun {
                name: name.to_owned(),
                scene,
                later: Vec::new(),
                ticks,
            }],
        }
    }

    /// The run in the folder `dir` that is in memory, of which no more than about `most` rows are taken.
    pub fn of(dir: &Path, run: &Run, most: usize) -> Result<Self, ViewError> {
        Ok(Self {
            kind: "recording",
            protocol: PROTOCOL,
            runs: vec![RecordedRun::of(dir, run, most)?],
        })
    }

    /// As the page reads it.
    pub fn to_json(&self) -> String {
        // Names are text, and the rest numbers and lists: nothing that JSON does not have.
        serde_json::to_string(self).unwrap_or_default()
    }
}

impl RecordedRun {
    fn load(dir: &Path) -> Result<Self, ViewError> {
        let run = Run::load_columns(dir, |_| true)?;
        Self::of(dir, &run, MOST_ROWS)
    }

    fn of(dir: &Path, run: &Run, most: usize) -> Result<Self, ViewError> {
        let summary = run.summary();
        let unready = |source| ViewError::Scenario {
            dir: dir.to_owned(),
            source: Box::new(source),
        };
        let scene = Scene::of_run(summary).map_err(unready)?;
        let (settings, changes) = (&summary.settings, &summary.changes);
        let later = ChangeMade::scenarios(changes, &settings.scenario);
        let later = later.map_err(|source| ViewError::Changes {
            dir: dir.to_owned(),
            source,
        })?;
        let later = later.iter().map(|(from_s, scenario)| {
            let scene = Scene::new(scenario, &settings.robot)?;
            Ok(LaterScene {
                from_s: *from_s,
                scene: scene.without_robot(),
            })
        });
        let later = later.collect::<Result<_, _>>().map_err(unready)?;
        let name = dir.canonicalize().unwrap_or(dir.to_owned());
        let name = name.file_name().unwrap_or(dir.as_os_str());
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            scene,
            later,
            ticks: Ticks::of(run.log(), most),
        })
    }
}
