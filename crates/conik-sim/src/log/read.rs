//! Reads `log.csv` back: each column by its name, and which sets were active in which row.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Bytes of the longest line that is read, beyond what thousands of tasks need: a file without line
/// ends would else fill the memory.
const LONGEST_LINE: u64 = 1 << 20;

/// The log of one run, by columns.
///
/// An hour at 500 Hz is 1.8 million rows, so the active sets, of which few differ, are kept as
/// numbers into [`Log::active_sets`], and [`Log::load_columns`] leaves out what is not needed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    mode: Vec<Option<u64>>,
    active: Vec<u32>,
    active_sets: Vec<Vec<String>>,
    why: Vec<u32>,
    codes: Vec<Vec<String>>,
    truncated: bool,
}

impl Log {
    /// Reads every column of the file at `path`.
    ///
    /// A last line without a line end is left out: the run was killed while it wrote, and the
    /// line's last number may be cut. An empty cell reads as NaN.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, LogError> {
        Self::load_columns(path, |_| true)
    }

    /// As [`Log::load`], but of the columns of numbers only those that `keep` names. The time,
    /// the mode and the active sets are always read.
    pub fn load_columns(
        path: impl AsRef<Path>,
        keep: impl Fn(&str) -> bool,
    ) -> Result<Self, LogError> {
        let path = path.as_ref();
        let file = File::open(path).map_err(|source| LogError::Io {
            path: path.to_owned(),
            source,
        })?;
        Reader::new(path, BufReader::with_capacity(1 << 16, file)).read(keep)
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.active.len()
    }

    /// Whether there is no row at all.
    pub fn is_empty(&self) -> bool {
        self.active.is_empty()
    }

    /// Whether the last line was cut off and therefore left out.
    pub fn is_truncated(&self) -> bool {
        self.truncated
    }

    /// Time of each row [s].
    pub fn time_s(&self) -> &[f64] {
        self.column("t_s").unwrap_or_default()
    }

    /// Names of the columns of numbers that were kept, in the order of the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The column of that name, if there is one and it was kept.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let at = self.names.iter().position(|other| other == name)?;
        Some(&self.columns[at])
    }

    /// The columns `<stem>1<unit>`, `<stem>2<unit>`, ... as far as they go: `("q", "_rad")`.
    pub fn numbered(&self, stem: &str, unit: &str) -> Vec<&[f64]> {
        (1..)
            .map_while(|joint| self.column(&format!("{stem}{joint}{unit}")))
            .collect()
    }

    /// Number of the mode in each row; `None` where it would not fit 64 bits.
    pub fn mode(&self) -> &[Option<u64>] {
        &self.mode
    }

    /// Which sets were active in each row, as a number into [`Log::active_sets`].
    pub fn active(&self) -> &[u32] {
        &self.active
    }

    /// The codes of the reasons for what the tick of this row decided: none in a log without them.
    pub fn why(&self, row: usize) -> &[String] {
        let codes = self.why.get(row).map(|&id| id as usize);
        codes.map_or(&[], |id| &self.codes[id])
    }

    /// The sets of names that were active at some time, in order of first appearance.
    pub fn active_sets(&self) -> &[Vec<String>] {
        &self.active_sets
    }
}

/// Why a log could not be read.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// A column that every log has is not there.
    #[error("{}:1: there is no column `{column}`; is this the log.csv of a run?", path.display())]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// The column's name.
        column: &'static str,
    },
    /// Two columns have the same name.
    #[error("{}:1: the column `{column}` is there twice", path.display())]
    RepeatedColumn {
        /// The file.
        path: PathBuf,
        /// The column's name.
        column: String,
    },
    /// A line is longer than that of any log.
    #[error(
        "{}:{line}: this line has more than {LONGEST_LINE} bytes; is this the log.csv of a run?",
        path.display()
    )]
    LongLine {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
    },
    /// A row has more or fewer cells than the header.
    #[error("{}:{line}: {found} cells where the header has {expected}", path.display())]
    Width {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
        /// Cells in the header.
        expected: usize,
        /// Cells in this line.
        found: usize,
    },
    /// A cell is not what its column holds.
    #[error("{}:{line}: column `{column}`: `{cell}` is not {expected}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        cell: String,
        /// What should.
        expected: &'static str,
    },
}

/// What is done with the cells of a column.
#[derive(Clone, Copy)]
enum Use {
    /// Kept as the column of this index.
    Number(usize),
    Mode,
    Active,
    Why,
    Skip,
}

/// A log being read.
struct Reader<'a, R> {
    path: &'a Path,
    source: R,
    /// 1-based line last read.
    line: u64,
    header: Vec<String>,
    uses: Vec<Use>,
    known_sets: HashMap<String, u32>,
    known_codes: HashMap<String, u32>,
    log: Log,
}

impl<'a, R: BufRead> Reader<'a, R> {
    fn new(path: &'a Path, source: R) -> Self {
        Self {
            path,
            source,
            line: 0,
            header: Vec::new(),
            uses: Vec::new(),
            known_sets: HashMap::new(),
            known_codes: HashMap::new(),
            log: Log::default(),
        }
    }

    fn read(mut self, keep: impl Fn(&str) -> bool) -> Result<Log, LogError> {
        let mut text = String::new();
        self.next_line(&mut text)?;
        self.read_header(text.trim_end(), keep)?;
        while self.next_line(&mut text)? {
            if !text.ends_with('\n') {
                self.log.truncated = true;
                break;
            }
            let row = text.trim_end_matches(['\n', '\r']);
            if !row.is_empty() {
                self.read_row(row)?;
            }
        }
        Ok(self.log)
    }

    /// Whether there was one more line; it is in `text`, with its end.
    fn next_line(&mut self, text: &mut String) -> Result<bool, LogError> {
        text.clear();
        self.line += 1;
        let path = || self.path.to_owned();
        match (&mut self.source).take(LONGEST_LINE).read_line(text) {
            Ok(bytes) if bytes as u64 == LONGEST_LINE && !text.ends_with('\n') => {
                Err(LogError::LongLine {
                    path: path(),
                    line: self.line,
                })
            }
            Ok(bytes) => Ok(bytes > 0),
            Err(source) => Err(LogError::Io {
                path: path(),
                source,
            }),
        }
    }

    fn read_header(&mut self, text: &str, keep: impl Fn(&str) -> bool) -> Result<(), LogError> {
        self.header = text.split(',').map(str::to_owned).collect();
        for column in ["t_s", "mode", "active"] {
            if !self.header.iter().any(|name| name == column) {
                let path = self.path.to_owned();
                return Err(LogError::MissingColumn { path, column });
            }
        }
        for (at, name) in self.header.iter().enumerate() {
            if self.header[..at].contains(name) {
                return Err(LogError::RepeatedColumn {
                    path: self.path.to_owned(),
                    column: name.clone(),
                });
            }
            self.uses.push(match name.as_str() {
                "mode" => Use::Mode,
                "active" => Use::Active,
                "why" if keep("why") => Use::Why,
                "why" => Use::Skip,
                name if name == "t_s" || keep(name) => {
                    self.log.names.push(name.to_owned());
                    self.log.columns.push(Vec::new());
                    Use::Number(self.log.columns.len() - 1)
                }
                _ => Use::Skip,
            });
        }
        Ok(())
    }

    fn read_row(&mut self, row: &str) -> Result<(), LogError> {
        let found = row.split(',').count();
        if found != self.header.len() {
            return Err(LogError::Width {
                path: self.path.to_owned(),
                line: self.line,
                expected: self.header.len(),
                found,
            });
        }
        for (at, cell) in row.split(',').enumerate() {
            match self.uses[at] {
                Use::Skip => {}
                Use::Number(column) => {
                    let value = if cell.is_empty() {
                        f64::NAN
                    } else {
                        self.parse(at, cell, "a number")?
                    };
                    self.log.columns[column].push(value);
                }
                Use::Mode => {
                    let mode = if cell.is_empty() {
                        None
                    } else {
                        Some(self.parse(at, cell, "the number of a mode")?)
                    };
                    self.log.mode.push(mode);
                }
                Use::Active => {
                    let known = (&mut self.known_sets, &mut self.log.active_sets);
                    let id = number_of(known, cell);
                    self.log
                        .active
                        .push(id.ok_or_else(|| self.too_many(at, cell))?);
                }
                Use::Why => {
                    let known = (&mut self.known_codes, &mut self.log.codes);
                    let id = number_of(known, cell);
                    self.log
                        .why
                        .push(id.ok_or_else(|| self.too_many(at, cell))?);
                }
            }
        }
        Ok(())
    }

    fn too_many(&self, at: usize, cell: &str) -> LogError {
        self.bad_cell(at, cell, "one of at most 2^32")
    }

    fn parse<T: FromStr>(
        &self,
        at: usize,
        cell: &str,
        expected: &'static str,
    ) -> Result<T, LogError> {
        cell.parse().map_err(|_| self.bad_cell(at, cell, expected))
    }

    fn bad_cell(&self, at: usize, cell: &str, expected: &'static str) -> LogError {
        LogError::Cell {
            path: self.path.to_owned(),
            line: self.line,
            column: self.header[at].clone(),
            cell: cell.to_owned(),
            expected,
        }
    }
}

/// The number of a list of names joined by `+`: the one it has already, or the next; `None` if there
/// are no more numbers.
fn number_of(
    (known, lists): (&mut HashMap<String, u32>, &mut Vec<Vec<String>>),
    cell: &str,
) -> Option<u32> {
    if let Some(&id) = known.get(cell) {
        return Some(id);
    }
    let id = u32::try_from(lists.len()).ok()?;
    let names = cell.split('+').filter(|name| !name.is_empty());
    lists.push(names.map(str::to_owned).collect());
    known.insert(cell.to_owned(), id);
    Some(id)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "t_s,mode,active,waypoint,view,q1_rad,q2_rad\n";

    fn read(text: &str) -> Result<Log, LogError> {
        Reader::new(Path::new("log.csv"), text.as_bytes()).read(|_| true)
    }

    #[test]
    fn columns_are_found_by_name_and_sets_by_number() {
        let rows = "0,1,,0,0.5,1,2\n0.5,3,view+low,1,0.25,3,4\n1,,,1,,5,6\n";
        let log = read(&format!("{HEADER}{rows}")).unwrap();
        assert_eq!(log.time_s(), [0.0, 0.5, 1.0]);
        assert_eq!(log.mode(), [Some(1), Some(3), None]);
        assert_eq!(log.active(), [0, 1, 0]);
        assert_eq!(log.active_sets()[0], Vec::<String>::new());
        assert_eq!(log.active_sets()[1], ["view", "low"]);
        assert_eq!(
            log.numbered("q", "_rad"),
            [[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]
        );
        assert!(log.column("view").unwrap()[2].is_nan(), "empty cell");
        assert!(!log.is_truncated());
    }

    #[test]
    fn reasons_are_read_where_a_log_has_them() {
        let with = format!("{},why\n", HEADER.trim_end());
        let rows = "0,1,,0,0.5,1,2,\n1,1,,0,0.5,1,2,hold:view+speed:q3\n";
        let log = read(&format!("{with}{rows}")).unwrap();
        assert_eq!(log.why(0), [""; 0]);
        assert_eq!(log.why(1), ["hold:view", "speed:q3"]);
        assert_eq!(log.why(2), [""; 0], "no such row");
        assert_eq!(log.column("why"), None, "not a column of numbers");
        let without = read(&format!("{HEADER}0,1,,0,0.5,1,2\n")).unwrap();
        assert_eq!(without.why(0), [""; 0]);
    }

    #[test]
    fn last_line_of_a_killed_run_is_left_out() {
        for cut in ["1,2", "1,2,view,0,0.5,1,2"] {
            let log = read(&format!("{HEADER}0,1,,0,0.5,1,2\n{cut}")).unwrap();
            assert_eq!(log.len(), 1, "cut at `{cut}`");
            assert!(log.is_truncated());
        }
        assert!(read(HEADER.trim_end()).unwrap().is_empty());
    }

    #[test]
    fn line_ends_of_windows_are_read() {
        let log = read(&format!("{HEADER}0,1,,0,0.5,1,2\n").replace('\n', "\r\n")).unwrap();
        assert_eq!(log.column("q2_rad"), Some(&[2.0][..]));
    }

    #[test]
    fn errors_name_file_line_and_column() {
        for (text, message) in [
            (String::new(), "log.csv:1: there is no column `t_s`"),
            ("t_s,mode,active,a,a\n".into(), "column `a` is there twice"),
            (
                format!("{HEADER}0,1,\n"),
                "log.csv:2: 3 cells where the header has 7",
            ),
            (
                format!("{HEADER}0,1,,0,0.5,1,2\n1,1,,0,x,1,2\n"),
                "log.csv:3: column `view`: `x` is not a number",
            ),
            (
                format!("{HEADER}0,-1,,0,0.5,1,2\n"),
                "log.csv:2: column `mode`: `-1` is not the number of a mode",
            ),
        ] {
            let error = read(&text).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
        let error = Log::load("no/such/log.csv").unwrap_err().to_string();
        assert!(error.contains("no/such/log.csv"), "{error}");
    }

    #[test]
    fn line_without_end_is_not_read_to_its_end() {
        let endless = BufReader::new(HEADER.as_bytes().chain(io::repeat(b'0')));
        let error = Reader::new(Path::new("log.csv"), endless).read(|_| true);
        let error = error.unwrap_err().to_string();
        assert!(error.contains("log.csv:2: this line has more"), "{error}");
    }

    #[test]
    fn unwanted_columns_are_not_kept() {
        let text = format!("{HEADER}0,1,,0,0.5,1,2\n");
        let reader = Reader::new(Path::new("log.csv"), text.as_bytes());
        let log = reader.read(|name| name.starts_with('q')).unwrap();
        assert_eq!(log.column("view"), None);
        assert_eq!(log.time_s(), [0.0]);
        assert_eq!(log.column("q1_rad"), Some(&[1.0][..]));
    }
}
