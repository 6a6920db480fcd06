//! What has happened so far in a run that goes on, column by column, as a page wants it.

use std::collections::{BTreeMap, HashMap};

use conik::{ActiveSet, ModeOrder, Reason};
use conik_sim::columns::Columns;
use conik_sim::experiment::Experiment;
use conik_sim::live::Gliding;
use conik_sim::record::Record;

use crate::view::Ticks;

/// The rows of a run. Of a long one, older rows are thinned.
#[derive(Debug)]
pub(super) struct History {
    names: Vec<String>,
    columns: Vec<Vec<f32>>,
    t_s: Vec<f64>,
    mode: Vec<Option<u64>>,
    active: Vec<u32>,
    active_sets: Vec<Vec<String>>,
    known_sets: HashMap<ActiveSet, u32>,
    why: Vec<u32>,
    reasons: Vec<Vec<String>>,
    known_reasons: HashMap<Vec<String>, u32>,
    /// Rows of the run for each row here, at most.
    every: usize,
    /// Rows that were sent.
    sent: usize,
    tasks: Vec<String>,
    mode_order: ModeOrder,
    /// What was on its way in the last row.
    gliding: Vec<Gliding>,
    most: usize,
}

impl History {
    /// Nothing yet of a run that begins with this experiment; no more than about `most` rows are kept.
    pub(super) fn of(experiment: &Experiment, most: usize) -> Self {
        let stack = experiment.controller.stack();
        Self {
            names: Columns::new(stack).names(stack),
            columns: Vec::new(),
            t_s: Vec::new(),
            mode: Vec::new(),
            active: Vec::new(),
            active_sets: Vec::new(),
            known_sets: HashMap::new(),
            why: Vec::new(),
            reasons: Vec::new(),
            known_reasons: HashMap::new(),
            every: 1,
            sent: 0,
            tasks: stack
                .iter()
                .map(|(_, level)| level.name().to_owned())
                .collect(),
            mode_order: ModeOrder::new(stack),
            gliding: Vec::new(),
            most,
        }
    }

    /// Takes in a row. `true`: older rows were thinned, so that whoever has them needs them anew.
    pub(super) fn take(&mut self, record: &Record) -> bool {
        if self.columns.is_empty() {
            self.name_columns(record);
        }
        self.t_s.push((record.t_s * 1e9).round() / 1e9);
        self.mode.push(self.mode_order.number(&record.active));
        let set = self.set(&record.active);
        self.active.push(set);
        let why = self.reason(&record.reasons);
        self.why.push(why);
        let waypoint = [record.waypoint as f64];
        let measured = record.q_measured.as_ref();
        let numbers = waypoint
            .iter()
            .chain(&record.task_values)
            .copied()
            .chain(record.tool.to_array())
            .chain(record.q.iter().copied())
            .chain(record.qd.iter().copied())
            .chain(record.qdd.iter().copied())
            .chain(measured.into_iter().flat_map(|q| q.iter().copied()));
        for (column, number) in self.columns.iter_mut().zip(numbers) {
            column.push(single(number));
        }
        self.gliding.clone_from(&record.gliding);
        let is_full = self.t_s.len() > self.most;
        if is_full {
            self.thin();
        }
        is_full
    }

    /// The names of `log.csv`, in its order.
    fn name_columns(&mut self, record: &Record) {
        let tasks = std::mem::take(&mut self.names);
        let measured = record.q_measured.map(|_| ("q", "_measured_rad"));
        let groups = [("q", "_rad"), ("qd", "_rad_s"), ("qdd", "_rad_s2")];
        let joints = groups.into_iter().chain(measured).flat_map(|(name, unit)| {
            (1..=record.q.len()).map(move |joint| format!("{name}{joint}{unit}"))
        });
        let tool = ["x", "y", "z"].map(|axis| format!("tool_{axis}_m"));
        self.names = std::iter::once("waypoint".to_owned())
            .chain(tasks)
            .chain(tool)
            .chain(joints)
            .collect();
        self.columns = vec![Vec::new(); self.names.len()];
    }

    fn set(&mut self, active: &ActiveSet) -> u32 {
        if let Some(&known) = self.known_sets.get(active) {
            return known;
        }
        let number = number_of(self.active_sets.len());
        let names = active.iter().map(|task| self.tasks[task.index()].clone());
        self.active_sets.push(names.collect());
        self.known_sets.insert(*active, number);
        number
    }

    fn reason(&mut self, reasons: &[Reason]) -> u32 {
        let codes: Vec<String> = reasons.iter().map(|reason| self.code(reason)).collect();
        if let Some(&known) = self.known_reasons.get(&codes) {
            return known;
        }
        let number = number_of(self.reasons.len());
        self.reasons.push(codes.clone());
        self.known_reasons.insert(codes, number);
        number
    }

    /// As in `log.csv`.
    fn code(&self, reason: &Reason) -> String {
        let mut code = reason.word().to_owned();
        if let Some(task) = reason.task() {
            code = format!("{code}:{}", self.tasks[task.index()]);
        }
        if let Some(joint) = reason.joint() {
            code = format!("{code}:q{}", joint + 1);
        }
        code
    }

    /// Leaves out every second of the older rows, but for those at changes of mode.
    fn thin(&mut self) {
        let older = self.t_s.len() * 4 / 5;
        let changes: Vec<bool> = (0..self.t_s.len())
            .map(|row| row > 0 && self.active[row] != self.active[row - 1])
            .collect();
        let few = changes.iter().filter(|&&change| change).count() <= self.most / 8;
        let is_kept: Vec<bool> = (0..self.t_s.len())
            .map(|row| {
                let next = changes.get(row + 1).copied().unwrap_or_default();
                row >= older || row % 2 == 0 || few && (changes[row] || next)
            })
            .collect();
        keep(&mut self.t_s, &is_kept);
        keep(&mut self.mode, &is_kept);
        keep(&mut self.active, &is_kept);
        keep(&mut self.why, &is_kept);
        for column in &mut self.columns {
            keep(column, &is_kept);
        }
        self.every *= 2;
        self.sent = 0;
    }

    /// All rows, which count as sent.
    pub(super) fn all(&mut self) -> Ticks {
        self.rows(0)
    }

    /// The rows that were not sent yet, which now are; `None` if there are none.
    pub(super) fn unsent(&mut self) -> Option<Ticks> {
        (self.sent < self.t_s.len()).then(|| self.rows(self.sent))
    }

    fn rows(&mut self, from: usize) -> Ticks {
        self.sent = self.t_s.len();
        let (active, active_sets) = used(&self.active[from..], &self.active_sets);
        let (why, reasons) = used(&self.why[from..], &self.reasons);
        let names = self.names.iter().zip(&self.columns);
        let columns: BTreeMap<String, Vec<f32>> = names
            .map(|(name, column)| (name.clone(), column[from..].to_vec()))
            .collect();
        Ticks::from_columns(
            self.every,
            self.t_s[from..].to_vec(),
            self.mode[from..].to_vec(),
            (active, active_sets),
            (why, reasons),
            columns,
        )
    }

    /// What was on its way in the last row.
    pub(super) fn gliding(&self) -> &[Gliding] {
        &self.gliding
    }
}

/// Only those entries of a list that rows refer to, and the rows with their new numbers.
fn used(rows: &[u32], list: &[Vec<String>]) -> (Vec<u32>, Vec<Vec<String>>) {
    let mut numbers: HashMap<u32, u32> = HashMap::new();
    let mut kept = Vec::new();
    let renumbered = rows.iter().map(|&row| {
        *numbers.entry(row).or_insert_with(|| {
            kept.push(list[row as usize].clone());
            number_of(kept.len() - 1)
        })
    });
    let renumbered = renumbered.collect();
    (renumbered, kept)
}

/// No more than there are rows, which are far fewer than that.
fn number_of(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

fn keep<T>(column: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    column.retain(|_| kept.next().copied().unwrap_or(true));
}

fn single(number: f64) -> f32 {
    // Rounding is what is wanted.
    #[allow(clippy::cast_possible_truncation)]
    let single = number as f32;
    single
}
