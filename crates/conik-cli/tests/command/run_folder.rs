//! Reads what `conik run` wrote, without the code that wrote it.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// `log.csv`, cell by cell.
#[derive(Debug)]
pub struct Rows {
    pub header: String,
    pub rows: Vec<Vec<String>>,
}

impl Rows {
    /// Of the run in `folder`. Every line must be whole.
    pub fn of(folder: &Path) -> Self {
        let text = fs::read_to_string(folder.join("log.csv")).unwrap();
        assert!(text.ends_with('\n'), "the last line is cut off");
        let mut lines = text.lines();
        let header = lines.next().unwrap().to_owned();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect();
        let rows: Vec<Vec<String>> = lines.map(cells).collect();
        let width = header.split(',').count();
        assert!(rows.iter().all(|row| row.len() == width), "ragged rows");
        Self { header, rows }
    }

    /// Where the column of that name stands.
    pub fn at(&self, name: &str) -> usize {
        let found = self.header.split(',').position(|column| column == name);
        found.unwrap_or_else(|| panic!("no column {name}"))
    }

    /// The numbers of one column.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        let at = self.at(name);
        self.rows
            .iter()
            .map(|row| row[at].parse().unwrap())
            .collect()
    }

    /// `{t_s, mode, active}` at the start and wherever the mode changes, as the summary has it.
    pub fn modes(&self) -> Vec<Value> {
        let mut modes = vec![];
        let mut last = None;
        for row in &self.rows {
            let (t_s, mode, active) = (&row[0], &row[1], &row[2]);
            if last.replace((mode, active)) != Some((mode, active)) {
                let names: Vec<&str> = active.split('+').filter(|name| !name.is_empty()).collect();
                modes.push(serde_json::json!({
                    "t_s": t_s.parse::<f64>().unwrap(),
                    "mode": mode.parse::<u64>().unwrap(),
                    "active": names,
                }));
            }
        }
        modes
    }

    /// Row k is at t = k / rate, from the first row to the last.
    #[track_caller]
    pub fn assert_complete(&self, rate_hz: f64) {
        for (k, t_s) in self.numbers("t_s").into_iter().enumerate() {
            assert_eq!(t_s, k as f64 / rate_hz, "row {k}");
        }
    }
}

/// `summary.json` of the run in `folder`.
pub fn summary(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("summary.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}
