//! Reads `log.csv` row by row: memory does not grow with its length.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::error::LogError;

/// Bytes of the longest line that is read, beyond what thousands of tasks need: a file without line
/// ends would else fill the memory.
pub(super) const LONGEST_LINE: u64 = 1 << 20;

/// The rows of a log, one after the other.
///
/// Of active sets and reasons few differ: a row has numbers of them, and [`LogRows::active_sets`] and
/// [`LogRows::codes`] are what was found so far.
#[derive(Debug)]
pub struct LogRows<R = BufReader<File>> {
    path: PathBuf,
    source: R,
    /// 1-based line last read.
    line: u64,
    /// The same, as it stands in the file.
    text: String,
    bytes: u64,
    header: Vec<String>,
    uses: Vec<Use>,
    names: Vec<String>,
    active_sets: Lists,
    codes: Lists,
    row: Row,
    is_truncated: bool,
}

/// One row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// The cells of the columns of [`LogRows::names`], in that order; NaN for an empty one.
    pub numbers: Vec<f64>,
    /// Number of the mode; `None` where it would not fit 64 bits.
    pub mode: Option<u64>,
    /// Which sets were active, as a number into [`LogRows::active_sets`].
    pub active: u32,
    /// What decided the tick, as a number into [`LogRows::codes`]; `None` in a log that does not tell.
    pub why: Option<u32>,
}

/// What is done with the cells of a column.
#[derive(Clone, Copy, Debug)]
enum Use {
    /// Kept as the number of this index.
    Number(usize),
    Mode,
    Active,
    Why,
    Skip,
}

impl LogRows {
    /// The rows of the file at `path`. Of the columns of numbers and the reasons, only those are read
    /// that `keep` names; the time, the mode and the active sets always are.
    pub fn open(path: impl AsRef<Path>, keep: impl Fn(&str) -> bool) -> Result<Self, LogError> {
        let path = path.as_ref();
        let file = File::open(path).map_err(|source| LogError::Io {
            path: path.to_owned(),
            source,
        })?;
        Self::read(path, BufReader::with_capacity(1 << 16, file), keep)
    }
}

impl<R: BufRead> LogRows<R> {
    /// The rows of `source`, which errors call `path`.
    pub(super) fn read(
        path: &Path,
        source: R,
        keep: impl Fn(&str) -> bool,
    ) -> Result<Self, LogError> {
        let mut rows = Self {
            path: path.to_owned(),
            source,
            line: 0,
            text: String::new(),
            bytes: 0,
            header: Vec::new(),
            uses: Vec::new(),
            names: Vec::new(),
            active_sets: Lists::default(),
            codes: Lists::default(),
            row: Row::default(),
            is_truncated: false,
        };
        rows.next_line()?;
        rows.read_header(keep)?;
        Ok(rows)
    }

    /// Goes on to the next row, if there is one.
    ///
    /// A last line without a line end is none: the run was killed while it wrote, and the line's last
    /// number may be cut.
    pub fn advance(&mut self) -> Result<bool, LogError> {
        while self.next_line()? {
            if !self.text.ends_with('\n') {
                self.is_truncated = true;
                return Ok(false);
            }
            if !self.text.trim_end_matches(['\n', '\r']).is_empty() {
                self.read_row()?;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The row that [`advance`](Self::advance) went to.
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// Names of the columns of numbers that are kept, in the order of the file; the time is among them.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether the file has a column of reasons, and it is kept.
    pub fn has_reasons(&self) -> bool {
        self.uses.iter().any(|it| matches!(it, Use::Why))
    }

    /// The sets of names of active tasks so far, in order of first appearance.
    pub fn active_sets(&self) -> &[Vec<String>] {
        &self.active_sets.lists
    }

    /// The lists of codes of reasons so far, in order of first appearance.
    pub fn codes(&self) -> &[Vec<String>] {
        &self.codes.lists
    }

    /// Whether the last line was cut off and therefore left out.
    pub fn is_truncated(&self) -> bool {
        self.is_truncated
    }

    /// How many bytes of the file were read.
    pub fn bytes_read(&self) -> u64 {
        self.bytes
    }

    /// What was found, without what finds it.
    pub(super) fn into_lists(self) -> (Vec<String>, Vec<Vec<String>>, Vec<Vec<String>>) {
        (self.names, self.active_sets.lists, self.codes.lists)
    }

    /// Whether there was one more line; it is in `text`, with its end.
    fn next_line(&mut self) -> Result<bool, LogError> {
        self.text.clear();
        self.line += 1;
        let path = || self.path.clone();
        let line = (&mut self.source)
            .take(LONGEST_LINE)
            .read_line(&mut self.text);
        match line {
            Ok(bytes) if bytes as u64 == LONGEST_LINE && !self.text.ends_with('\n') => {
                Err(LogError::LongLine {
                    path: path(),
                    line: self.line,
                })
            }
            Ok(bytes) => {
                self.bytes += bytes as u64;
                Ok(bytes > 0)
            }
            Err(source) => Err(LogError::Io {
                path: path(),
                source,
            }),
        }
    }

    fn read_header(&mut self, keep: impl Fn(&str) -> bool) -> Result<(), LogError> {
        let names = self.text.trim_end().split(',');
        self.header = names.map(str::to_owned).collect();
        for column in ["t_s", "mode", "active"] {
            if !self.header.iter().any(|name| name == column) {
                let path = self.path.clone();
                return Err(LogError::MissingColumn { path, column });
            }
        }
        for (at, name) in self.header.iter().enumerate() {
            if self.header[..at].contains(name) {
                return Err(LogError::RepeatedColumn {
                    path: self.path.clone(),
                    column: name.clone(),
                });
            }
            self.uses.push(match name.as_str() {
                "mode" => Use::Mode,
                "active" => Use::Active,
                "why" if keep("why") => Use::Why,
                "why" => Use::Skip,
                name if name == "t_s" || keep(name) => {
                    self.names.push(name.to_owned());
                    Use::Number(self.names.len() - 1)
                }
                _ => Use::Skip,
            });
        }
        self.row.numbers = vec![f64::NAN; self.names.len()];
        Ok(())
    }

    fn read_row(&mut self) -> Result<(), LogError> {
        let text = self.text.trim_end_matches(['\n', '\r']);
        let found = text.split(',').count();
        if found != self.header.len() {
            return Err(LogError::Width {
                path: self.path.clone(),
                line: self.line,
                expected: self.header.len(),
                found,
            });
        }
        for (at, cell) in text.split(',').enumerate() {
            let bad = |expected| self.bad_cell(at, cell, expected);
            match self.uses[at] {
                Use::Skip => {}
                Use::Number(_) | Use::Mode if cell.is_empty() => match self.uses[at] {
                    Use::Number(column) => self.row.numbers[column] = f64::NAN,
                    _ => self.row.mode = None,
                },
                Use::Number(column) => {
                    self.row.numbers[column] = parsed(cell).ok_or_else(|| bad("a number"))?;
                }
                Use::Mode => {
                    let mode = parsed(cell).ok_or_else(|| bad("the number of a mode"))?;
                    self.row.mode = Some(mode);
                }
                Use::Active => {
                    let id = self.active_sets.number_of(cell);
                    self.row.active = id.ok_or_else(|| self.bad_cell(at, cell, TOO_MANY))?;
                }
                Use::Why => {
                    let id = self.codes.number_of(cell);
                    self.row.why = Some(id.ok_or_else(|| self.bad_cell(at, cell, TOO_MANY))?);
                }
            }
        }
        Ok(())
    }

    fn bad_cell(&self, at: usize, cell: &str, expected: &'static str) -> LogError {
        LogError::Cell {
            path: self.path.clone(),
            line: self.line,
            column: self.header[at].clone(),
            cell: cell.to_owned(),
            expected,
        }
    }
}

fn parsed<T: FromStr>(cell: &str) -> Option<T> {
    cell.parse().ok()
}

const TOO_MANY: &str = "one of at most 2^32";

/// Lists of names joined by `+`, each with a number.
#[derive(Debug, Default)]
struct Lists {
    known: HashMap<String, u32>,
    lists: Vec<Vec<String>>,
}

impl Lists {
    /// The number that a cell has already, or the next; `None` if there are no more numbers.
    fn number_of(&mut self, cell: &str) -> Option<u32> {
        if let Some(&id) = self.known.get(cell) {
            return Some(id);
        }
        let id = u32::try_from(self.lists.len()).ok()?;
        let names = cell.split('+').filter(|name| !name.is_empty());
        self.lists.push(names.map(str::to_owned).collect());
        self.known.insert(cell.to_owned(), id);
        Some(id)
    }
}
