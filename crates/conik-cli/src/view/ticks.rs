//! What happened in a run, tick by tick.

use std::collections::{BTreeMap, HashMap};

use conik_sim::log::Log;
use serde::Serialize;

use super::PROTOCOL;

/// More rows than this are thinned: six and a half minutes at 125 Hz. A page that holds an hour at
/// 500 Hz would need a gigabyte for what nobody can see.
pub const MOST_ROWS: usize = 50_000;

/// The ticks of a run, column by column; the columns of numbers are those of `log.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ticks {
    kind: &'static str,
    protocol: u32,
    /// Rows of the log for each row here, but for those at changes of mode, which are all here.
    every: usize,
    t_s: Vec<f64>,
    mode: Vec<Option<u64>>,
    /// Of each row a number into `active_sets`.
    active: Vec<u32>,
    /// Sets of active tasks, by name.
    active_sets: Vec<Vec<String>>,
    /// Of each row a number into `reasons`; empty if nobody wrote them down.
    why: Vec<u32>,
    /// What decided a tick, as codes.
    reasons: Vec<Vec<String>>,
    /// Single precision: a micrometre in ten metres, which is more than any picture shows.
    columns: BTreeMap<String, Vec<f32>>,
}

impl Ticks {
    /// Ticks of which the columns are there already; `active` and `why` with the lists that they refer to.
    pub(super) fn from_columns(
        every: usize,
        t_s: Vec<f64>,
        mode: Vec<Option<u64>>,
        (active, active_sets): (Vec<u32>, Vec<Vec<String>>),
        (why, reasons): (Vec<u32>, Vec<Vec<String>>),
        columns: BTreeMap<String, Vec<f32>>,
    ) -> Self {
        Self {
            kind: "ticks",
            protocol: PROTOCOL,
            every,
            t_s,
            mode,
            active,
            active_sets,
            why,
            reasons,
            columns,
        }
    }

    /// The ticks of a log, of which no more than about `most` rows are taken.
    pub fn of(log: &Log, most: usize) -> Self {
        let every = log.len().div_ceil(most.max(1)).max(1);
        let rows = rows(log, every, most);
        let (why, reasons) = reasons(log, &rows);
        let numbers = log.names().iter().filter(|name| *name != "t_s");
        // More than nine digits after the point is less than anybody's clock.
        let seconds = |row: &usize| (log.time_s()[*row] * 1e9).round() / 1e9;
        Self {
            kind: "ticks",
            protocol: PROTOCOL,
            every,
            t_s: rows.iter().map(seconds).collect(),
            mode: rows.iter().map(|&row| log.mode()[row]).collect(),
            active: rows.iter().map(|&row| log.active()[row]).collect(),
            active_sets: log.active_sets().to_vec(),
            why,
            reasons,
            columns: numbers
                .filter_map(|name| Some((name.clone(), single(log.column(name)?, &rows))))
                .collect(),
        }
    }
}

/// Every so many rows, the last one, and both rows at each change of mode while those are few.
fn rows(log: &Log, every: usize, most: usize) -> Vec<usize> {
    let active = log.active();
    let changes = |row: usize| row > 0 && active[row] != active[row - 1];
    let count = (1..active.len()).filter(|&row| changes(row)).count();
    let few = count <= most / 4;
    let last = active.len().saturating_sub(1);
    let is_kept = |&row: &usize| {
        row % every == 0 || row == last || few && (changes(row) || row < last && changes(row + 1))
    };
    (0..active.len()).filter(is_kept).collect()
}

fn reasons(log: &Log, rows: &[usize]) -> (Vec<u32>, Vec<Vec<String>>) {
    let mut known: HashMap<&[String], u32> = HashMap::new();
    let mut reasons: Vec<Vec<String>> = Vec::new();
    let mut number = |row: &usize| {
        let codes = log.why(*row);
        *known.entry(codes).or_insert_with(|| {
            reasons.push(codes.to_vec());
            // No more than there are rows, which are far fewer than that.
            u32::try_from(reasons.len() - 1).unwrap_or(u32::MAX)
        })
    };
    let why = rows.iter().map(&mut number).collect();
    (why, reasons)
}

fn single(column: &[f64], rows: &[usize]) -> Vec<f32> {
    // Rounding is what is wanted.
    #[allow(clippy::cast_possible_truncation)]
    let single = |&row: &usize| column[row] as f32;
    rows.iter().map(single).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::{Value, json};

    use super::*;

    fn log(name: &str, text: &str) -> Log {
        let path = std::env::temp_dir().join(format!("conik-ticks-{}-{name}", std::process::id()));
        fs::write(&path, text).unwrap();
        let log = Log::load(&path).unwrap();
        fs::remove_file(path).unwrap();
        log
    }

    #[test]
    fn columns_keep_their_names_and_what_is_missing_is_null() {
        let text = "t_s,mode,active,waypoint,a,q1_rad,why\n0.0,1,,0,0.1,2.5,\n0.008,2,a,0,,2.5,hold:a+corrected\n";
        let ticks = serde_json::to_value(Ticks::of(&log("small.csv", text), 10)).unwrap();
        assert_eq!(ticks["t_s"], json!([0.0, 0.008]));
        assert_eq!(ticks["mode"], json!([1, 2]));
        assert_eq!(ticks["active"], json!([0, 1]));
        assert_eq!(ticks["active_sets"], json!([[], ["a"]]));
        assert_eq!(ticks["why"], json!([0, 1]));
        assert_eq!(ticks["reasons"], json!([[], ["hold:a", "corrected"]]));
        let columns = ticks["columns"].as_object().unwrap();
        assert_eq!(
            columns.keys().collect::<Vec<_>>(),
            ["a", "q1_rad", "waypoint"]
        );
        assert_eq!(columns["a"][1], Value::Null);
        assert_eq!(columns["q1_rad"][0], json!(2.5));
        let text = serde_json::to_string(&Ticks::of(&log("small.csv", text), 10)).unwrap();
        assert!(text.contains("\"a\":[0.1,null]"), "shortest digits: {text}");
    }

    #[test]
    fn long_logs_are_thinned_but_not_at_changes_of_mode() {
        let mut text = "t_s,mode,active,waypoint,q1_rad,why\n".to_owned();
        for row in 0..1000 {
            let active = if (333..335).contains(&row) { "a" } else { "" };
            text += &format!("{:?},1,{active},0,{row},\n", f64::from(row) / 100.0);
        }
        let ticks = Ticks::of(&log("long.csv", &text), 100);
        assert_eq!(ticks.every, 10);
        assert_eq!(ticks.t_s.len(), 100 + 4 + 1);
        assert_eq!(ticks.columns["q1_rad"].len(), ticks.t_s.len());
        for time in [3.32, 3.33, 3.34, 3.35, 9.99] {
            assert!(ticks.t_s.contains(&time), "{time}");
        }
        assert_eq!(ticks.active.iter().filter(|&&id| id == 1).count(), 2);
    }

    #[test]
    fn run_that_flickers_is_thinned_all_the_same() {
        let mut text = "t_s,mode,active,waypoint,q1_rad,why\n".to_owned();
        for row in 0..1000 {
            let active = if row % 2 == 0 { "a" } else { "" };
            text += &format!("{:?},1,{active},0,{row},\n", f64::from(row) / 100.0);
        }
        assert_eq!(Ticks::of(&log("flicker.csv", &text), 100).t_s.len(), 101);
    }
}
