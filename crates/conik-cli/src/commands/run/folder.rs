//! The folder that a run writes to.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use conik_sim::log::LogWriteError;
use conik_sim::summary::Summary;

use crate::arguments::RunArguments;
use crate::failure::Failure;

/// Names of what stands beside the log.
const SUMMARY: &str = "summary.json";
const REPORT: &str = "report.html";

/// Where these arguments want it.
pub(super) fn out_dir(arguments: &RunArguments) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| {
        let name = arguments.scenario.file_stem().unwrap_or("run".as_ref());
        Path::new("out").join(name)
    })
}

pub(super) fn make_folder(out: &Path) -> Result<(), Failure> {
    fs::create_dir_all(out).map_err(|error| {
        Failure::input(if out.exists() && !out.is_dir() {
            format!(
                "{} is not a folder; give another one with --out",
                out.display()
            )
        } else {
            format!(
                "cannot make the folder {}: {error}; give another one with --out",
                out.display()
            )
        })
    })
}

pub(super) fn cannot_log(error: LogWriteError) -> Failure {
    match error {
        LogWriteError::Busy { .. } => {
            Failure::input(format!("{error}; give another folder with --out"))
        }
        LogWriteError::Io { .. } => Failure::input(error),
    }
}

/// Takes away what would tell of an earlier run beside this run's log.
pub(super) fn clear(out: &Path) -> Result<(), Failure> {
    for name in [SUMMARY, REPORT] {
        let path = out.join(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(Failure::input(format!(
                    "cannot replace {}: {error}",
                    path.display()
                )));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Writes the summary in one go: whoever is killed meanwhile leaves the one before.
pub(super) fn write_summary(out: &Path, summary: &Summary) -> Result<(), String> {
    let path = out.join(SUMMARY);
    let part = out.join("summary.json.part");
    serde_json::to_string_pretty(summary)
        .map_err(io::Error::from)
        .and_then(|text| fs::write(&part, text + "\n"))
        .and_then(|()| fs::rename(&part, &path))
        .map_err(|error| {
            // What is left of it says nothing; if it cannot go either, that changes nothing.
            let _ = fs::remove_file(&part);
            format!("cannot write {}: {error}", path.display())
        })
}
