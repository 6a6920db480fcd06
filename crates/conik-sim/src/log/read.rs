//! Reads `log.csv` back: each column by its name, and which sets were active in which row.

use std::io::BufRead;
use std::path::Path;

use super::error::LogError;
use super::rows::LogRows;

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
        Self::collect(LogRows::open(path, keep)?)
    }

    fn collect<R: BufRead>(mut rows: LogRows<R>) -> Result<Self, LogError> {
        let mut log = Self {
            columns: vec![Vec::new(); rows.names().len()],
            ..Self::default()
        };
        while rows.advance()? {
            let row = rows.row();
            for (column, &value) in log.columns.iter_mut().zip(&row.numbers) {
                column.push(value);
            }
            log.mode.push(row.mode);
            log.active.push(row.active);
            log.why.extend(row.why);
        }
        log.truncated = rows.is_truncated();
        (log.names, log.active_sets, log.codes) = rows.into_lists();
        Ok(log)
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

#[cfg(test)]
mod tests {
    use std::io::{self, BufReader, Read};

    use super::*;

    const HEADER: &str = "t_s,mode,active,waypoint,view,q1_rad,q2_rad\n";

    fn read(text: &str) -> Result<Log, LogError> {
        read_columns(text, |_| true)
    }

    fn read_columns(text: &str, keep: impl Fn(&str) -> bool) -> Result<Log, LogError> {
        Log::collect(LogRows::read(Path::new("log.csv"), text.as_bytes(), keep)?)
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
        let rows = LogRows::read(Path::new("log.csv"), endless, |_| true).unwrap();
        let error = Log::collect(rows).unwrap_err().to_string();
        assert!(error.contains("log.csv:2: this line has more"), "{error}");
    }

    #[test]
    fn unwanted_columns_are_not_kept() {
        let text = format!("{HEADER}0,1,,0,0.5,1,2\n");
        let log = read_columns(&text, |name| name.starts_with('q')).unwrap();
        assert_eq!(log.column("view"), None);
        assert_eq!(log.time_s(), [0.0]);
        assert_eq!(log.column("q1_rad"), Some(&[1.0][..]));
    }
}
