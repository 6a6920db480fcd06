//! The folder of a campaign: its plan, the shards that are done, and in the end the table.
//!
//! A shard is a file with the rows of [`SHARD`] runs, one JSON text a line. It is written beside its place and then
//! moved there, so that one that is there is whole, whoever was interrupted. A campaign that is begun again goes on
//! with the shards that are missing.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::flown::{CaseError, row};
use crate::plan::Plan;
use crate::row::Row;

/// Runs in a shard.
pub const SHARD: u64 = 250;

/// A campaign's folder.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
    plan: Plan,
}

/// What goes wrong in a folder.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// A file cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Something else is there.
    #[error(
        "{}: another campaign was begun here: its {what} differs; give another folder, or remove this one",
        path.display()
    )]
    Other {
        /// The folder.
        path: PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// A file is not what this program writes.
    #[error("{}: {what}; remove the folder and begin again", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        what: String,
    },
    /// A run cannot be run.
    #[error("run {run}: {source}")]
    Run {
        /// Its number.
        run: u64,
        /// Why not.
        source: Box<CaseError>,
    },
}

impl Folder {
    /// The folder of this plan; what was done of it is kept.
    ///
    /// # Errors
    ///
    /// If it cannot be made, or another campaign has it.
    pub fn open(path: &Path, plan: &Plan) -> Result<Self, FolderError> {
        let folder = Self {
            path: path.to_owned(),
            plan: plan.clone(),
        };
        fs::create_dir_all(path).map_err(|source| io_error(path, source))?;
        let file = path.join("plan.json");
        match fs::read(&file) {
            Ok(bytes) => {
                let there: Plan = serde_json::from_slice(&bytes).map_err(|error| {
                    let what = format!("it is no plan: {error}");
                    FolderError::Broken { path: file, what }
                })?;
                match difference(&there, plan) {
                    None => Ok(folder),
                    Some(what) => Err(FolderError::Other {
                        path: path.to_owned(),
                        what,
                    }),
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let text = serde_json::to_vec_pretty(plan).map_err(io::Error::other);
                text.and_then(|text| write_whole(&file, &text))
                    .map_err(|source| io_error(&file, source))?;
                Ok(folder)
            }
            Err(source) => Err(io_error(&file, source)),
        }
    }

    /// The plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    fn shards(&self) -> PathBuf {
        self.path.join("shards")
    }

    fn shard_file(&self, shard: u64) -> PathBuf {
        self.shards().join(format!("{shard:06}.jsonl"))
    }

    /// Numbers of the shards that are not there yet.
    pub fn missing(&self) -> Vec<u64> {
        let shards = 0..self.plan.shards();
        shards
            .filter(|shard| !self.shard_file(*shard).is_file())
            .collect()
    }

    /// Keeps the rows of a shard.
    ///
    /// # Errors
    ///
    /// If they cannot be written.
    pub fn keep(&self, shard: u64, lines: &str) -> Result<(), FolderError> {
        let (shards, file) = (self.shards(), self.shard_file(shard));
        fs::create_dir_all(&shards).map_err(|source| io_error(&shards, source))?;
        write_whole(&file, lines.as_bytes()).map_err(|source| io_error(&file, source))
    }

    /// Every row, in the order of the runs; there must be no shard missing.
    ///
    /// # Errors
    ///
    /// If a shard cannot be read, or is not what this program writes.
    pub fn rows(&self, mut take: impl FnMut(Row)) -> Result<(), FolderError> {
        for shard in 0..self.plan.shards() {
            let path = self.shard_file(shard);
            let file = File::open(&path).map_err(|source| io_error(&path, source))?;
            let mut runs = self.plan.runs_of(shard);
            for line in BufReader::new(file).lines() {
                let line = line.map_err(|source| io_error(&path, source))?;
                let row: Result<Row, _> = serde_json::from_str(&line);
                let row = row.map_err(|error| FolderError::Broken {
                    path: path.clone(),
                    what: format!("it has a row that is none: {error}"),
                })?;
                if runs.next() != Some(row.run) {
                    let what = format!("run {} is not where it belongs", row.run);
                    return Err(FolderError::Broken { path, what });
                }
                take(row);
            }
            if let Some(run) = runs.next() {
                let what = format!("run {run} is missing");
                return Err(FolderError::Broken { path, what });
            }
        }
        Ok(())
    }

    /// Whether there are shards.
    pub(crate) fn has_shards(&self) -> bool {
        self.shards().exists()
    }

    /// Takes the shards away, when what they are for is written.
    ///
    /// # Errors
    ///
    /// If they cannot be removed.
    pub fn tidy(&self) -> Result<(), FolderError> {
        fs::remove_dir_all(self.shards()).map_err(|source| io_error(&self.shards(), source))
    }
}

impl Plan {
    /// How many shards there are.
    pub fn shards(&self) -> u64 {
        self.runs.div_ceil(SHARD)
    }

    /// The runs of a shard.
    pub fn runs_of(&self, shard: u64) -> Range<u64> {
        let from = shard * SHARD;
        from.min(self.runs)..(from + SHARD).min(self.runs)
    }

    /// Runs a shard: its rows as lines of JSON. `goes_on` is asked after each run.
    ///
    /// # Errors
    ///
    /// If one of its runs cannot be run. `Ok(None)`: it was not to go on.
    pub fn shard(
        &self,
        shard: u64,
        mut goes_on: impl FnMut() -> bool,
    ) -> Result<Option<String>, FolderError> {
        let mut lines = String::new();
        for run in self.runs_of(shard) {
            let failed = |error: CaseError| FolderError::Run {
                run,
                source: Box::new(error),
            };
            let case = self.case(run).map_err(|error| failed(error.into()))?;
            let row = row(&case).map_err(failed)?;
            let line = serde_json::to_string(&row).map_err(|error| FolderError::Broken {
                path: PathBuf::new(),
                what: error.to_string(),
            })?;
            lines += &line;
            lines.push('\n');
            if !goes_on() {
                return Ok(None);
            }
        }
        Ok(Some(lines))
    }
}

fn io_error(path: &Path, source: io::Error) -> FolderError {
    FolderError::Io {
        path: path.to_owned(),
        source,
    }
}

/// What two plans do not have in common.
fn difference(there: &Plan, plan: &Plan) -> Option<&'static str> {
    let differences = [
        ("format", there.format != plan.format),
        ("version of the program", there.version != plan.version),
        ("scenario", there.scenario != plan.scenario),
        ("number of runs", there.runs != plan.runs),
        ("seed", there.seed != plan.seed),
        ("what varies", there.varied != plan.varied),
    ];
    let found = differences.into_iter().find(|(_, differs)| *differs);
    found.map(|(what, _)| what)
}

/// Writes a file so that it is there whole or not at all.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let beside = path.with_extension(format!("{}.part", std::process::id()));
    let mut file = File::create(&beside)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    fs::rename(&beside, path)
}
