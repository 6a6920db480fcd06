//! The worst runs as scenario files, ready to be run and looked at.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::class::Class;
use crate::folder::write_whole;
use crate::plan::Plan;
use crate::tally::Tally;

/// The file of a run of a class, from the folder of the campaign.
pub fn file(class: Class, run: u64) -> PathBuf {
    Path::new("worst").join(format!("{}-{run}.toml", class.name()))
}

/// Writes the examples of each class into the folder of the campaign.
///
/// # Errors
///
/// If a file cannot be written.
pub fn write(folder: &Path, plan: &Plan, tally: &Tally) -> io::Result<()> {
    let examples = tally.examples.iter();
    let examples: Vec<_> = examples
        .flat_map(|(class, runs)| runs.iter().map(|(_, run)| (*class, *run)))
        .collect();
    let there = folder.join("worst");
    if there.exists() {
        fs::remove_dir_all(&there)?;
    }
    if examples.is_empty() {
        return Ok(());
    }
    fs::create_dir_all(&there)?;
    for (class, run) in examples {
        let case = plan.case(run).map_err(io::Error::other)?;
        let mut scenario = case.scenario;
        let title = scenario.title.take().unwrap_or_default();
        let what = format!("run {run} of seed {}: {}", plan.seed, class.name());
        scenario.title = Some(if title.is_empty() {
            what
        } else {
            format!("{title}, {what}")
        });
        write_whole(
            &folder.join(file(class, run)),
            scenario.to_toml().as_bytes(),
        )?;
    }
    Ok(())
}
