//! Drives an arm in a thread of its own, and hands the records to those who listen.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, SyncSender, TrySendError};
use std::thread;

use conik_cli::tui::Tui;
use conik_cli::view::live::Live;
use conik_sim::arm::{Arm, ArmError};
use conik_sim::live::Stretch;
use conik_sim::log::{LogWriteError, LogWriter};
use conik_sim::record::Record;
use conik_sim::run::{self, Ended};
use conik_sim::summarise::Summariser;
use conik_ur::realtime::Realtime;

use crate::commands;
use crate::explain::Explanations;
use crate::layout::wrapped;
use crate::progress::Progress;

/// Records that may wait for the log: eight seconds at 500 Hz.
const RECORDS_WAITING: usize = 4096;

/// Who takes in the records of a run.
pub(super) struct Listeners<'a> {
    pub(super) log: LogWriter,
    pub(super) summariser: Summariser,
    pub(super) explanations: Explanations,
    pub(super) progress: Progress,
    /// Those who watch, and may change what is run.
    pub(super) live: Option<&'a Live>,
    /// The view in this terminal.
    pub(super) tui: Option<&'a Tui>,
}

/// A run that has ended, and what was made of its records.
pub(super) struct Finished {
    pub(super) ended: Ended,
    pub(super) summariser: Summariser,
    pub(super) explanations: Explanations,
    pub(super) written: Result<(), LogWriteError>,
    /// Keeps other runs out of the folder until the report is there.
    pub(super) _log: LogWriter,
}

/// Drives the arm in a thread of its own; `urgently` asks for real-time priority, and says whether
/// to print what was granted.
pub(super) fn drive(
    stretch: Stretch,
    arm: &mut (dyn Arm + Send),
    listeners: Listeners<'_>,
    urgently: Option<bool>,
    stop: &AtomicBool,
) -> Finished {
    let Listeners {
        mut log,
        mut summariser,
        mut explanations,
        mut progress,
        live,
        tui,
    } = listeners;
    let (sender, records) = mpsc::sync_channel(RECORDS_WAITING);
    let mut written = Ok(());
    let ended = thread::scope(|scope| {
        let driver = scope.spawn(move || {
            let real_time = arm.is_real_time();
            if let Some(print) = urgently {
                let granted = Realtime::enter();
                if print {
                    // Nobody reading is no reason not to drive.
                    let _ = commands::print(&wrapped("", &format!("driving with {granted}")));
                }
            }
            run::run_steered(
                stretch,
                arm,
                &mut |record| hand_over(&sender, record, real_time),
                stop,
                live.map(Live::helm),
            )
        });
        for record in records {
            if written.is_ok() {
                written = log.write(&record);
                if written.is_err() {
                    stop.store(true, Ordering::Relaxed);
                }
            }
            summariser.take(&record);
            if let Some(live) = live {
                live.take(&record);
            }
            if let Some(tui) = tui {
                tui.take(&record);
            }
            explanations.take(&record);
            progress.show(&record, summariser.present_mode());
        }
        match driver.join() {
            Ok(ended) => ended,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    progress.finish();
    Finished {
        ended,
        summariser,
        explanations,
        written: written.and_then(|()| log.finish()),
        _log: log,
    }
}

/// Hands a record to the log. An arm that moves on its own is never kept waiting.
fn hand_over(sender: &SyncSender<Record>, record: Record, real_time: bool) -> Result<(), ArmError> {
    let closed = || ArmError::new("log-closed", "the log takes no more records");
    if !real_time {
        return sender.send(record).map_err(|_| closed());
    }
    sender.try_send(record).map_err(|error| match error {
        TrySendError::Full(_) => ArmError::new(
            "log-overrun",
            format!("the log fell {RECORDS_WAITING} records behind: is the disk too slow?"),
        ),
        TrySendError::Disconnected(_) => closed(),
    })
}
