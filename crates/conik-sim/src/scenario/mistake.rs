//! A mistake in a scenario file: where it is, what is wrong and what would be right.

use std::fmt;
use std::ops::Range;
use std::path::Path;

use thiserror::Error;

/// At most so many mistakes are kept; the rest is counted. A file of noise must not print
/// megabytes.
const MOST_KEPT: usize = 50;

/// At most so many characters of the file are repeated in a message.
const MOST_QUOTED: usize = 48;

/// One mistake in a scenario file.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}, column {column}: {}{what}; {help}", prefix(.key))]
pub struct Mistake {
    /// The bytes of the text that it is about; on character boundaries, may be empty.
    pub span: Range<usize>,
    /// Line of the span's start, from 1.
    pub line: usize,
    /// Column of the span's start in characters, from 1.
    pub column: usize,
    /// Dotted path of the key, list positions from 1: `control.rate_hz`, `task[3] "view".max`.
    /// Empty where the mistake belongs to no key.
    pub key: String,
    /// What is wrong.
    pub what: String,
    /// What would be right.
    pub help: String,
}

fn prefix(key: &str) -> String {
    if key.is_empty() {
        String::new()
    } else {
        format!("{key}: ")
    }
}

/// Every independent mistake found in a scenario file, in the order of the file; never none.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub struct ScenarioErrors {
    mistakes: Vec<Mistake>,
    more: usize,
}

impl ScenarioErrors {
    /// The mistakes, in the order of the file. There is at least one.
    pub fn mistakes(&self) -> &[Mistake] {
        &self.mistakes
    }

    /// How many more were found than are listed.
    pub fn more(&self) -> usize {
        self.more
    }

    /// The messages with the file and place in front of each, as compilers write them.
    pub(super) fn located(&self, path: &Path) -> String {
        let line = |mistake: &Mistake| {
            let Mistake {
                line,
                column,
                key,
                what,
                help,
                ..
            } = mistake;
            format!(
                "{}:{line}:{column}: {}{what}; {help}",
                path.display(),
                prefix(key)
            )
        };
        self.joined(self.mistakes.iter().map(line))
    }

    /// The messages without line and column, for what was not read from a file.
    pub fn without_places(&self) -> String {
        let line = |mistake: &Mistake| {
            let Mistake {
                key, what, help, ..
            } = mistake;
            format!("{}{what}; {help}", prefix(key))
        };
        self.joined(self.mistakes.iter().map(line))
    }

    fn joined(&self, lines: impl Iterator<Item = String>) -> String {
        let more = (self.more > 0).then(|| format!("and {} more mistakes", self.more));
        lines.chain(more).collect::<Vec<_>>().join("\n")
    }
}

impl fmt::Display for ScenarioErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.joined(self.mistakes.iter().map(Mistake::to_string)))
    }
}

/// The mistakes found so far while a text is read.
#[derive(Debug)]
pub(super) struct Mistakes<'t> {
    text: &'t str,
    kept: Vec<Mistake>,
    more: usize,
}

impl<'t> Mistakes<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self {
            text,
            kept: Vec::new(),
            more: 0,
        }
    }

    /// Notes a mistake.
    pub(super) fn add(
        &mut self,
        span: Range<usize>,
        key: impl Into<String>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) {
        if self.is_full() {
            self.more += 1;
            return;
        }
        let start = floor_char(self.text, span.start);
        let end = ceil_char(self.text, span.end).max(start);
        let mistake = Mistake {
            span: start..end,
            line: 0,
            column: 0,
            key: key.into(),
            what: what.into(),
            help: help.into(),
        };
        // Sets that come of one task of the file share its mistakes.
        if !self.kept.contains(&mistake) {
            self.kept.push(mistake);
        }
    }

    /// Nothing was found wrong so far.
    pub(super) fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Further mistakes are only counted: work that makes a better message is wasted.
    pub(super) fn is_full(&self) -> bool {
        self.kept.len() >= MOST_KEPT
    }

    /// `made`, if nothing was found wrong; otherwise all that was found, with line and column.
    pub(super) fn into_result<T>(mut self, made: Option<T>) -> Result<T, ScenarioErrors> {
        match made {
            Some(made) if self.kept.is_empty() => return Ok(made),
            None if self.kept.is_empty() => {
                // What could not be made has noted why. Should that ever be untrue: no panic.
                self.add(0..0, "", "cannot be read", "this is a defect of the reader");
            }
            _ => {}
        }
        self.kept.sort_by_key(|mistake| mistake.span.start);
        for mistake in &mut self.kept {
            (mistake.line, mistake.column) = line_and_column(self.text, mistake.span.start);
        }
        Err(ScenarioErrors {
            mistakes: self.kept,
            more: self.more,
        })
    }
}

/// Line and column, both from 1, of a byte of the text; columns count characters.
pub(super) fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..floor_char(text, byte)];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
    (line, before[line_start..].chars().count() + 1)
}

/// The last character boundary at or before a byte.
pub(super) fn floor_char(text: &str, byte: usize) -> usize {
    let candidates = (0..=byte.min(text.len())).rev();
    first_boundary(text, candidates).unwrap_or(0)
}

/// The first character boundary at or after a byte.
fn ceil_char(text: &str, byte: usize) -> usize {
    let candidates = byte.min(text.len())..=text.len();
    first_boundary(text, candidates).unwrap_or(text.len())
}

fn first_boundary(text: &str, mut candidates: impl Iterator<Item = usize>) -> Option<usize> {
    candidates.find(|byte| text.is_char_boundary(*byte))
}

/// A piece of the file in quotes, shortened where it is long, with nothing in it that could upset
/// a terminal.
pub(super) fn quoted(text: &str) -> String {
    let mut short: String = text.chars().take(MOST_QUOTED).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("{short:?}")
}

#[cfg(test)]
mod tests {
    use super::{Mistakes, line_and_column, quoted};

    #[test]
    fn lines_and_columns_count_from_one_and_in_characters() {
        let text = "a\nüb\r\nc";
        assert_eq!(line_and_column(text, 0), (1, 1));
        assert_eq!(line_and_column(text, 4), (2, 2));
        assert_eq!(line_and_column(text, text.len()), (3, 2));
        assert_eq!(line_and_column("", 0), (1, 1));
    }

    #[test]
    fn spans_are_brought_into_the_text_and_onto_characters() {
        let text = "aü";
        let mut found = Mistakes::new(text);
        found.add(2..99, "k", "w", "h");
        let errors = found
            .into_result(Some(()))
            .expect_err("one mistake was added");
        assert_eq!(errors.mistakes()[0].span, 1..3);
    }

    #[test]
    fn the_same_mistake_is_told_once() {
        let mut found = Mistakes::new("xy");
        for span in [0..1, 0..1, 1..2, 0..1] {
            found.add(span, "k", "w", "h");
        }
        let errors = found.into_result(Some(())).expect_err("there are two");
        assert_eq!((errors.mistakes().len(), errors.more()), (2, 0));
    }

    #[test]
    fn noise_is_counted_and_cut_short() {
        let mut found = Mistakes::new("x");
        for nth in 0..1000 {
            found.add(0..1, "k", format!("w {nth}"), "h");
        }
        let errors = found
            .into_result(Some(()))
            .expect_err("mistakes were added");
        assert_eq!(errors.mistakes().len() + errors.more(), 1000);
        assert!(errors.to_string().len() < 5_000);
        assert!(quoted(&"\u{1b}".repeat(1_000_000)).len() < 1_000);
    }
}
