//! What the keys do.

mod keyboard;

use std::io;
use std::sync::atomic::Ordering;
use std::sync::mpsc::SyncSender;
use std::time::Duration;

use ratatui_crossterm::crossterm::event::{
    self, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers,
};

use keyboard::Keyboard;

use super::Shared;
use super::course::Course;
use super::frame::{self, Looks};
use super::list::{self, Row};
use super::scene::Scene;

/// Between two looks at whether the view is to end.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    /// To stop the run, or to leave the view of one that has ended.
    Quit,
    Up,
    Down,
    Open,
    Freeze,
    Help,
    /// The terminal has another size.
    Resized,
}

impl Key {
    fn of(event: &Event) -> Option<Self> {
        let Event::Key(KeyEvent {
            code,
            modifiers,
            kind: KeyEventKind::Press | KeyEventKind::Repeat,
            ..
        }) = event
        else {
            return matches!(event, Event::Resize(..)).then_some(Self::Resized);
        };
        match code {
            KeyCode::Char('c') if modifiers.contains(KeyModifiers::CONTROL) => Some(Self::Quit),
            KeyCode::Char('q') => Some(Self::Quit),
            KeyCode::Up | KeyCode::Char('k') => Some(Self::Up),
            KeyCode::Down | KeyCode::Char('j') => Some(Self::Down),
            KeyCode::Enter | KeyCode::Char(' ') => Some(Self::Open),
            KeyCode::Char('p') => Some(Self::Freeze),
            KeyCode::Char('?' | 'h') => Some(Self::Help),
            _ => None,
        }
    }

    /// Does what it asks for, but for [`Quit`](Self::Quit), which is nothing that is seen.
    pub(super) fn press(self, looks: &mut Looks, scene: &Scene, now: &Course) {
        match self {
            Self::Up | Self::Down => {
                let course = looks.frozen.as_deref().unwrap_or(now);
                let rows = list::rows(scene, course, &looks.open);
                let at = frame::place(&rows, looks.selected);
                let to = if self == Self::Up {
                    at.saturating_sub(1)
                } else {
                    (at + 1).min(rows.len().saturating_sub(1))
                };
                looks.selected = rows.get(to).copied().unwrap_or(looks.selected);
            }
            Self::Open => {
                let course = looks.frozen.as_deref().unwrap_or(now);
                let rows = list::rows(scene, course, &looks.open);
                let row = rows.get(frame::place(&rows, looks.selected));
                if let Some(&Row::Group(from, to)) = row {
                    looks.selected = Row::Group(from, to);
                    if !looks.open.remove(&from) {
                        looks.open.insert(from);
                    }
                }
            }
            Self::Freeze => {
                looks.frozen = match looks.frozen {
                    Some(_) => None,
                    None => Some(Box::new(now.clone())),
                };
            }
            Self::Help => looks.has_help = !looks.has_help,
            Self::Quit | Self::Resized => {}
        }
    }
}

/// Reads keys until the view is closed. Where none can be read, nobody is waited for after the run.
pub(super) fn read(shared: &Shared, pressed: &SyncSender<Key>) {
    if read_all(shared, pressed).is_err() {
        shared.is_gone.store(true, Ordering::Relaxed);
    }
}

fn read_all(shared: &Shared, pressed: &SyncSender<Key>) -> io::Result<()> {
    let keyboard = Keyboard::find()?;
    while !shared.is_closing.load(Ordering::Relaxed) {
        keyboard.wait(LOOK_EVERY)?;
        if !event::poll(Duration::ZERO)? {
            continue;
        }
        match Key::of(&event::read()?) {
            Some(Key::Quit) => {
                let has_ended = shared.course().outcome.is_some();
                shared.is_left.store(true, Ordering::Relaxed);
                if !has_ended {
                    shared.stop.store(true, Ordering::Relaxed);
                }
            }
            // One too many for a terminal that takes nothing is forgotten.
            Some(key) => {
                let _ = pressed.try_send(key);
            }
            None => {}
        }
        shared.wake();
    }
    Ok(())
}
