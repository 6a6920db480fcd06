//! What of a description was not taken as it stands.

use std::fmt;

use crate::element::Element;
use crate::error::listed;

/// One thing that was left out, held still or taken otherwise than it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Line of the first element that it is about, from 1.
    pub line: usize,
    /// What was done, and why.
    pub text: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.text)
    }
}

/// The notes made so far: one for each thing to say, with all the names that it is said of.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    kinds: Vec<Kind>,
}

#[derive(Debug)]
struct Kind {
    line: usize,
    text: String,
    names: Vec<String>,
}

impl Notes {
    /// Notes `text` of an element of this name.
    pub(crate) fn add(&mut self, element: &Element, name: &str, text: impl Into<String>) {
        let text = text.into();
        if let Some(kind) = self.kinds.iter_mut().find(|kind| kind.text == text) {
            kind.names.push(name.to_owned());
        } else {
            self.kinds.push(Kind {
                line: element.place().0,
                text,
                names: vec![name.to_owned()],
            });
        }
    }

    /// All that was noted, in the order of the text.
    pub(crate) fn finish(self) -> Vec<Note> {
        let notes = self.kinds.into_iter().map(|kind| Note {
            line: kind.line,
            text: format!(
                "{}: {}",
                listed(kind.names.iter().map(String::as_str)),
                kind.text
            ),
        });
        let mut notes: Vec<Note> = notes.collect();
        notes.sort_by_key(|note| note.line);
        notes
    }
}
