//! All that the page reads: one run, or two to be compared.

use std::path::{Path, PathBuf};

use conik_sim::experiment::ExperimentError;
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
    ticks: Ticks,
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
                ticks,
            }],
        }
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
        let scene = Scene::of_run(run.summary()).map_err(|source| ViewError::Scenario {
            dir: dir.to_owned(),
            source: Box::new(source),
        })?;
        let name = dir.canonicalize().unwrap_or(dir.to_owned());
        let name = name.file_name().unwrap_or(dir.as_os_str());
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            scene,
            ticks: Ticks::of(run.log(), MOST_ROWS),
        })
    }
}
