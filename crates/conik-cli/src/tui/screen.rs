//! The thread that draws, the only one that writes to the terminal while there is a view.

use std::io::{self, BufWriter, Stdout};
use std::mem::ManuallyDrop;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::Receiver;
use std::thread;
use std::time::Duration;

use ratatui_core::terminal::Terminal;
use ratatui_crossterm::CrosstermBackend;
use ratatui_crossterm::crossterm::{cursor, execute, terminal};

use super::Shared;
use super::frame::{self, Looks};
use super::ink::Ink;
use super::keys::Key;

/// Between two pictures.
const EVERY: Duration = Duration::from_millis(100);

/// What is drawn, and by whose choice.
#[derive(Debug)]
pub(super) struct Screen {
    shared: Arc<Shared>,
    pressed: Receiver<Key>,
    looks: Looks,
    ink: Ink,
}

impl Screen {
    pub(super) fn new(shared: Arc<Shared>, pressed: Receiver<Key>) -> Self {
        Self {
            shared,
            pressed,
            looks: Looks::default(),
            ink: Ink::of_environment(),
        }
    }

    /// Draws until the view is closed or the terminal is gone.
    pub(super) fn show(mut self) {
        // A terminal that is gone shows nothing; the run goes on.
        if self.draw_all().is_err() {
            self.shared.is_gone.store(true, Ordering::Relaxed);
        }
        restore(&self.shared);
    }

    fn draw_all(&mut self) -> io::Result<()> {
        execute!(io::stdout(), terminal::EnterAlternateScreen, cursor::Hide)?;
        let out: BufWriter<Stdout> = BufWriter::with_capacity(1 << 16, io::stdout());
        // Let go, it would tell that it cannot show the cursor of a terminal that is gone.
        let mut terminal = ManuallyDrop::new(Terminal::new(CrosstermBackend::new(out))?);
        while !self.shared.is_closing.load(Ordering::Relaxed) {
            while let Ok(key) = self.pressed.try_recv() {
                key.press(&mut self.looks, &self.shared.scene, &self.shared.course());
            }
            self.looks.warning = self.shared.warnings.last();
            self.looks.is_stopping = self.shared.stop.load(Ordering::Relaxed);
            // The course is looked at while the picture is made, and not while it is written.
            terminal.draw(|frame| {
                let course = self.shared.course();
                let scene = &self.shared.scene;
                frame::draw(frame.buffer_mut(), scene, &course, &self.looks, self.ink);
            })?;
            thread::park_timeout(EVERY);
        }
        Ok(())
    }
}

/// Gives the terminal back.
pub(super) fn restore(shared: &Shared) {
    // If it is gone there is nothing to restore.
    let _ = execute!(io::stdout(), terminal::LeaveAlternateScreen, cursor::Show);
    let _ = terminal::disable_raw_mode();
    shared.is_restored.store(true, Ordering::Release);
}
