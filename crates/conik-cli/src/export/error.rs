//! Why a run could not be exported.

use std::io;
use std::path::PathBuf;

use conik_sim::experiment::ExperimentError;
use conik_sim::log::LogError;
use mcap::McapError;
use parquet::errors::ParquetError;

use crate::figure::RunError;

/// Why a run could not be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The folder is none of a run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The log cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// What was run is not what this program can run.
    #[error("{}: the scenario in its summary cannot be made ready", dir.display())]
    Scenario {
        /// The folder.
        dir: PathBuf,
        /// What does not fit.
        source: Box<ExperimentError>,
    },
    /// The log is of another robot than the summary.
    #[error(
        "{}: there is no column `{column}`, which a robot of {joints} joints has; are log and summary of one run?",
        path.display()
    )]
    NoColumn {
        /// The log.
        path: PathBuf,
        /// The column's name.
        column: String,
        /// How many joints the summary's robot has.
        joints: usize,
    },
    /// What is written cannot be.
    #[error("cannot write: {0}")]
    Write(#[from] io::Error),
    /// More than the format has numbers for.
    #[error("the run does not fit the format: {0}")]
    Format(String),
    /// Somebody asked to stop.
    #[error("stopped; nothing was written")]
    Stopped,
}

impl From<McapError> for ExportError {
    fn from(error: McapError) -> Self {
        match error {
            McapError::Io(error) => Self::Write(error),
            other => Self::Format(other.to_string()),
        }
    }
}

impl From<ParquetError> for ExportError {
    fn from(error: ParquetError) -> Self {
        match error {
            ParquetError::External(cause) => match cause.downcast::<io::Error>() {
                Ok(error) => Self::Write(*error),
                Err(other) => Self::Format(other.to_string()),
            },
            other => Self::Format(other.to_string()),
        }
    }
}
