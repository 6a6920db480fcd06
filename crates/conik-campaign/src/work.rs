//! All shards of a campaign on one machine, and what is made of them.

use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::thread;

use conik_sim::experiment::Experiment;

use crate::flown::CaseError;
use crate::folder::{Folder, FolderError, write_whole};
use crate::report;
use crate::table::Table;
use crate::tally::Tally;
use crate::worst;

/// Where a campaign is.
#[derive(Debug, Default)]
pub struct Progress {
    /// Runs that are done, in this session and before.
    pub done: AtomicU64,
    /// Ends the work, when the runs at hand are done.
    pub stop: AtomicBool,
}

impl Folder {
    /// Runs what is missing with so many workers. Returns whether nothing is missing any more.
    ///
    /// # Errors
    ///
    /// The first error of a worker; the others end too.
    pub fn work(&self, jobs: usize, progress: &Progress) -> Result<bool, FolderError> {
        let missing = self.missing();
        let plan = self.plan();
        let open: u64 = missing.iter().map(|shard| runs(plan.runs_of(*shard))).sum();
        progress.done.store(plan.runs - open, Ordering::Relaxed);
        let next = AtomicUsize::new(0);
        let failed = Mutex::new(None);
        let has_failed = AtomicBool::new(false);
        let goes_on =
            || !progress.stop.load(Ordering::Relaxed) && !has_failed.load(Ordering::Relaxed);
        let work = || {
            while goes_on() {
                let Some(&shard) = missing.get(next.fetch_add(1, Ordering::Relaxed)) else {
                    break;
                };
                let mut here = 0;
                let lines = plan.shard(shard, || {
                    here += 1;
                    progress.done.fetch_add(1, Ordering::Relaxed);
                    goes_on()
                });
                let kept = match lines {
                    Ok(Some(lines)) => self.keep(shard, &lines),
                    // What was done of it is not kept.
                    Ok(None) => {
                        progress.done.fetch_sub(here, Ordering::Relaxed);
                        Ok(())
                    }
                    Err(error) => Err(error),
                };
                if let Err(error) = kept {
                    has_failed.store(true, Ordering::Relaxed);
                    let mut failed = failed.lock().unwrap_or_else(PoisonError::into_inner);
                    failed.get_or_insert(error);
                }
            }
        };
        thread::scope(|scope| {
            for _ in 0..jobs.clamp(1, missing.len().max(1)) {
                scope.spawn(work);
            }
        });
        match failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(self.missing().is_empty()),
        }
    }

    /// Writes `runs.parquet`, `report.html` and the worst cases, and takes the shards away. No shard may be
    /// missing.
    ///
    /// # Errors
    ///
    /// If a file cannot be read or written.
    pub fn finish(&self) -> Result<Tally, FolderError> {
        let plan = self.plan();
        let experiment = Experiment::new(&plan.scenario).map_err(|error| FolderError::Run {
            run: 0,
            source: Box::new(CaseError::Experiment(error)),
        })?;
        let path = self.file("runs.parquet");
        let beside = self.file("runs.part");
        let broken = |error: crate::table::TableError| FolderError::Broken {
            path: path.clone(),
            what: error.to_string(),
        };
        let mut table =
            Table::create(&beside, plan, experiment.controller.stack()).map_err(broken)?;
        let mut tally = Tally::default();
        let mut added = Ok(());
        self.rows(|row| {
            tally.take(&row);
            if added.is_ok() {
                added = table.add(&row);
            }
        })?;
        added.and_then(|()| table.finish()).map_err(broken)?;
        let io = |source| FolderError::Io {
            path: self.file(""),
            source,
        };
        worst::write(&self.file(""), plan, &tally).map_err(io)?;
        let page = report::page(plan, &tally);
        write_whole(&self.file("report.html"), page.as_bytes()).map_err(io)?;
        std::fs::rename(&beside, &path).map_err(io)?;
        self.tidy()?;
        Ok(tally)
    }

    /// Whether it is finished: the table is there, and no shards any more.
    pub fn is_finished(&self) -> bool {
        self.file("runs.parquet").is_file() && !self.has_shards()
    }
}

fn runs(runs: std::ops::Range<u64>) -> u64 {
    runs.end - runs.start
}
