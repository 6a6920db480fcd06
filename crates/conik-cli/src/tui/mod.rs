//! The view of a run in a terminal: `conik run SCENARIO --tui`.
//!
//! The thread that writes the log hands every record to [`Tui::take`], which notes it and returns. A thread
//! of its own draws ten times a second and is the only one that writes to the terminal; another one reads
//! the keys. So a terminal that takes nothing any more, a stalled SSH connection for instance, holds up
//! the drawing and nothing else: the arm is driven, the log is written, and `q` is still heard.

mod bar;
mod course;
mod frame;
mod ink;
mod joints;
mod keys;
mod list;
mod scene;
mod screen;
mod standing;
mod strip;
#[cfg(test)]
mod tests;
mod warnings;

use std::io::{self, IsTerminal};
use std::panic;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread::{self, JoinHandle, Thread};
use std::time::{Duration, Instant};

use conik_sim::record::Record;
use conik_sim::summary::Outcome;
use ratatui_crossterm::crossterm::terminal;

use course::Course;
pub use scene::Scene;
use screen::Screen;
pub use warnings::Warnings;

/// A terminal that takes nothing for so long is left as it is.
const PATIENCE: Duration = Duration::from_secs(2);
/// Between two looks at whether somebody has had enough.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// The view of a run. The terminal is as it was when this is dropped.
#[derive(Debug)]
pub struct Tui {
    shared: Arc<Shared>,
    screen: Option<JoinHandle<()>>,
    keys: Option<JoinHandle<()>>,
}

/// Why there is no view.
#[derive(Debug, thiserror::Error)]
pub enum TuiError {
    /// Standard output goes elsewhere.
    #[error(
        "--tui: standard output is no terminal; run it in one (over SSH: `ssh -t`), or without --tui"
    )]
    NoTerminal,
    /// The terminal does not do what it is asked for.
    #[error("--tui: the terminal cannot be used: {0}")]
    Terminal(#[from] io::Error),
}

/// What the threads have in common.
#[derive(Debug)]
struct Shared {
    scene: Scene,
    course: Mutex<Course>,
    warnings: Warnings,
    /// Ends the run.
    stop: Arc<AtomicBool>,
    /// Nobody wants to look any more.
    is_left: AtomicBool,
    /// There is no terminal any more: it was hung up.
    is_gone: AtomicBool,
    /// The view is to end.
    is_closing: AtomicBool,
    /// The terminal is as it was.
    is_restored: AtomicBool,
    /// The thread that draws.
    screen: OnceLock<Thread>,
}

impl Shared {
    fn course(&self) -> MutexGuard<'_, Course> {
        // Whatever a thread left there when it failed can be shown.
        self.course.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Has what is new drawn now.
    fn wake(&self) {
        if let Some(screen) = self.screen.get() {
            screen.unpark();
        }
    }

    /// Ends the view; `false` if the terminal takes nothing.
    fn close(&self) -> bool {
        self.is_closing.store(true, Ordering::Relaxed);
        self.wake();
        let begin = Instant::now();
        while !self.is_restored.load(Ordering::Acquire) {
            if begin.elapsed() > PATIENCE {
                // What can be put right without writing to it.
                let _ = terminal::disable_raw_mode();
                return false;
            }
            thread::sleep(Duration::from_millis(1));
        }
        true
    }
}

impl Tui {
    /// Whether there can be a view.
    ///
    /// # Errors
    ///
    /// If standard output is no terminal.
    pub fn check() -> Result<(), TuiError> {
        if io::stdout().is_terminal() {
            Ok(())
        } else {
            Err(TuiError::NoTerminal)
        }
    }

    /// Takes the terminal and shows the run in it, until this is dropped. `q` sets `stop`.
    ///
    /// # Errors
    ///
    /// If the terminal cannot be used.
    pub fn start(
        scene: Scene,
        warnings: Warnings,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, TuiError> {
        Self::check()?;
        let shared = Arc::new(Shared {
            scene,
            course: Mutex::default(),
            warnings,
            stop: Arc::clone(stop),
            is_left: AtomicBool::new(false),
            is_gone: AtomicBool::new(false),
            is_closing: AtomicBool::new(false),
            is_restored: AtomicBool::new(false),
            screen: OnceLock::new(),
        });
        terminal::enable_raw_mode()?;
        let (sender, pressed) = mpsc::sync_channel(64);
        let screen = Screen::new(Arc::clone(&shared), pressed);
        let started = thread::Builder::new()
            .name("screen".to_owned())
            .spawn(move || screen.show());
        let screen = match started {
            Ok(screen) => screen,
            Err(error) => {
                let _ = terminal::disable_raw_mode();
                return Err(error.into());
            }
        };
        // Nobody else sets it.
        let _ = shared.screen.set(screen.thread().clone());
        restore_before_panics_are_told(&shared, screen.thread().id());
        let mut tui = Self {
            shared: Arc::clone(&shared),
            screen: Some(screen),
            keys: None,
        };
        let reading = thread::Builder::new()
            .name("keys".to_owned())
            .spawn(move || keys::read(&shared, &sender));
        tui.keys = Some(reading?);
        Ok(tui)
    }

    /// Notes one tick.
    pub fn take(&self, record: &Record) {
        self.shared.course().take(&self.shared.scene, record);
    }

    /// Shows how the run ended until somebody presses q, or has stopped the run by hand; then gives
    /// the terminal back. Returns `false` if the terminal takes nothing any more: printing to it would fail, or
    /// wait for ever.
    pub fn stay(&mut self, outcome: &Outcome) -> bool {
        self.shared.course().outcome = Some(outcome.clone());
        self.shared.wake();
        let is_over = || {
            let shared = &self.shared;
            shared.is_left.load(Ordering::Relaxed)
                || shared.is_gone.load(Ordering::Relaxed)
                || shared.stop.load(Ordering::Relaxed)
                || shared.is_restored.load(Ordering::Relaxed)
        };
        while !is_over() {
            thread::sleep(LOOK_EVERY);
        }
        self.close() && !self.shared.is_gone.load(Ordering::Relaxed)
    }

    fn close(&mut self) -> bool {
        let is_restored = self.shared.close();
        // They end by themselves; one that failed has said so. A terminal that was hung up the moment a key
        // was read holds that thread for ever.
        if let Some(keys) = self.keys.take() {
            let begin = Instant::now();
            while !keys.is_finished() && begin.elapsed() < PATIENCE {
                thread::sleep(Duration::from_millis(1));
            }
        }
        if let Some(screen) = self.screen.take().filter(|_| is_restored) {
            let _ = screen.join();
        }
        is_restored
    }
}

impl Drop for Tui {
    fn drop(&mut self) {
        if self.screen.is_some() {
            self.close();
        }
    }
}

/// What is told of a panic would be lost with the view.
fn restore_before_panics_are_told(shared: &Arc<Shared>, screen: thread::ThreadId) {
    let shared = Arc::clone(shared);
    let tell = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        if thread::current().id() == screen {
            shared.is_closing.store(true, Ordering::Relaxed);
            screen::restore(&shared);
        } else {
            shared.close();
        }
        tell(panic);
    }));
}
