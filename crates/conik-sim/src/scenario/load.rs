//! Loading a scenario file: what can go wrong before its text can be read.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::config::Scenario;
use super::mistake::{ScenarioErrors, line_and_column};
use super::robot_source::Sources;

/// A scenario file may be this long. The longest that makes sense, hundreds of tasks and thousands
/// of waypoints, is a tenth of it.
pub const MAX_FILE_BYTES: usize = 4_000_000;

/// Why a scenario file could not be loaded.
#[derive(Debug, Error)]
pub enum LoadError {
    /// The file is not there, or may not be read.
    #[error("{}: cannot be read: {source}; give the path of a scenario file", .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The path leads to a directory.
    #[error("{}: is a directory; give the path of a scenario file", .path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
    },
    /// The file is longer than [`MAX_FILE_BYTES`].
    #[error("{}: is longer than {MAX_FILE_BYTES} bytes; is it a scenario file?", .path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
    },
    /// The file is not UTF-8 text.
    #[error(
        "{}:{line}:{column}: is not UTF-8 text from here on; save it as UTF-8", .path.display()
    )]
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// Line of the first wrong byte, from 1.
        line: usize,
        /// Column of the first wrong byte in characters, from 1.
        column: usize,
    },
    /// The text has mistakes.
    #[error("{}", .errors.located(path))]
    Mistakes {
        /// The file.
        path: PathBuf,
        /// Its text, into which the spans of the mistakes point.
        text: String,
        /// The mistakes.
        errors: ScenarioErrors,
    },
}

impl Scenario {
    /// Loads a scenario file.
    ///
    /// # Errors
    ///
    /// Whatever keeps the file from being a scenario; every message names the file.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, LoadError> {
        let path = path.as_ref();
        let text = read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::from_toml_in(&Sources::in_folder(folder), &text).map_err(|errors| {
            LoadError::Mistakes {
                path: path.to_owned(),
                text,
                errors,
            }
        })
    }
}

fn read_text(path: &Path) -> Result<String, LoadError> {
    let unreadable = |source| LoadError::Unreadable {
        path: path.to_owned(),
        source,
    };
    if fs::metadata(path).map_err(unreadable)?.is_dir() {
        return Err(LoadError::Directory {
            path: path.to_owned(),
        });
    }
    // The limit holds for devices and pipes too, whose length nobody knows beforehand.
    let limit = MAX_FILE_BYTES as u64 + 1;
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(limit)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(LoadError::TooLong {
            path: path.to_owned(),
        });
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.as_bytes()[..valid]);
        let (line, column) = line_and_column(&text, valid);
        LoadError::NotUtf8 {
            path: path.to_owned(),
            line,
            column,
        }
    })
}
