//! What the controller has to say: lines for the log, and messages for those who listen.

use std::collections::VecDeque;

/// Lines that the log holds.
const LINES: usize = 500;

/// Messages that wait for a control cycle to carry them away.
const MESSAGES: usize = 16;

/// A message for every client.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Message {
    pub(super) text: String,
    /// The line of a program that it is about.
    pub(super) script_line: Option<u32>,
}

/// The log; old lines fall out.
#[derive(Debug, Default)]
pub(super) struct Log {
    lines: VecDeque<String>,
    messages: Vec<Message>,
}

impl Log {
    /// Adds a line, with the controller's time [s].
    pub(super) fn note(&mut self, time_s: f64, line: &str) {
        if self.lines.len() == LINES {
            self.lines.pop_front();
        }
        self.lines.push_back(format!("{time_s:.3} s: {line}"));
    }

    /// Adds a line and tells the clients; those above some in one cycle are noted only.
    pub(super) fn tell(&mut self, time_s: f64, message: Message) {
        self.note(time_s, &message.text);
        if self.messages.len() < MESSAGES {
            self.messages.push(message);
        }
    }

    pub(super) fn lines(&self) -> impl DoubleEndedIterator<Item = &String> {
        self.lines.iter()
    }

    /// The messages since the last call.
    pub(super) fn take_messages(&mut self) -> Vec<Message> {
        std::mem::take(&mut self.messages)
    }
}
