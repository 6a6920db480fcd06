//! What keeps a text from being a robot: where, what, and what would be right.

use std::fmt;

/// Why a description could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}{what}; {help}")]
pub struct UrdfError {
    /// What the error is about.
    pub place: Place,
    /// What is wrong.
    pub what: String,
    /// What would be right.
    pub help: String,
}

/// What an error is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// Something in the text.
    Text {
        /// From 1.
        line: usize,
        /// In characters, from 1.
        column: usize,
        /// The element, as `joint "elbow"`, with its attribute if it is one's fault; empty where the
        /// text is no XML.
        element: String,
    },
    /// The base asked for.
    Base,
    /// The tools asked for.
    Tools,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text {
                line,
                column,
                element,
            } if element.is_empty() => write!(f, "line {line}, column {column}: "),
            Self::Text {
                line,
                column,
                element,
            } => write!(f, "line {line}, column {column}: {element}: "),
            Self::Base => f.write_str("base: "),
            Self::Tools => f.write_str("tool: "),
        }
    }
}

/// At most so many names are listed in a message.
const MOST_LISTED: usize = 16;
/// At most so many characters of the text are repeated in a message.
const MOST_QUOTED: usize = 48;

/// A piece of the text in quotes, cut short, with nothing in it that could upset a terminal.
pub(crate) fn quoted(text: &str) -> String {
    let mut short: String = text.chars().take(MOST_QUOTED).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("{short:?}")
}

/// Names one after the other, cut short.
pub(crate) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names = names.into_iter();
    let shown: Vec<String> = names.by_ref().take(MOST_LISTED).map(quoted).collect();
    match names.count() {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}
