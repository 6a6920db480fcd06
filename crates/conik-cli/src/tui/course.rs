//! What is known of a run up to now: its last record, and its course over time in a bounded memory.

use std::time::Duration;

use conik::ActiveSet;
use conik_sim::histogram::Histogram;
use conik_sim::record::Record;
use conik_sim::summary::Outcome;

use super::scene::Scene;

/// Pieces of equal length into which the time of a run is cut.
pub(super) const PIECES: usize = 480;

/// A run up to now.
#[derive(Clone, Debug, Default)]
pub(super) struct Course {
    /// The last tick.
    pub(super) record: Option<Record>,
    /// Modes in the order in which they occurred first.
    pub(super) modes: Vec<Mode>,
    /// From the start up to now.
    pub(super) pieces: Vec<Piece>,
    /// The least and the greatest that was seen of each number of a record's tasks.
    pub(super) seen: Vec<(f64, f64)>,
    pub(super) steps: Histogram,
    pub(super) missed_cycles: u64,
    /// How it ended, if it has.
    pub(super) outcome: Option<Outcome>,
}

/// A mode that occurred.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mode {
    pub(super) active: ActiveSet,
    /// Its place among the modes that have an active set; `None` of that without.
    pub(super) nth: Option<usize>,
}

/// A piece of the time of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    /// Modes by their place in [`Course::modes`], and for how many ticks.
    pub(super) modes: Vec<(usize, u32)>,
    /// The numbers of the tasks in its last tick.
    pub(super) values: Vec<f64>,
}

impl Course {
    /// Takes in one tick.
    pub(super) fn take(&mut self, scene: &Scene, record: &Record) {
        let mode = self.mode(&record.active);
        let ticks = scene.last_tick.saturating_add(1);
        let at = u128::from(record.tick) * PIECES as u128 / u128::from(ticks);
        let at = usize::try_from(at).map_or(PIECES - 1, |at| at.min(PIECES - 1));
        if self.pieces.len() <= at {
            // Ticks longer than a piece fill those that they pass.
            let before = self.pieces.last().cloned().unwrap_or_default();
            self.pieces.resize(at, before);
            self.pieces.push(Piece::default());
        }
        let piece = &mut self.pieces[at];
        match piece.modes.iter_mut().find(|(other, _)| *other == mode) {
            Some((_, ticks)) => *ticks += 1,
            None => piece.modes.push((mode, 1)),
        }
        piece.values.clone_from(&record.task_values);
        if self.seen.is_empty() {
            self.seen = vec![(f64::INFINITY, f64::NEG_INFINITY); record.task_values.len()];
        }
        for ((least, greatest), value) in self.seen.iter_mut().zip(&record.task_values) {
            *least = least.min(*value);
            *greatest = greatest.max(*value);
        }
        self.steps.add(Duration::from_nanos(record.step_ns));
        self.missed_cycles += record.missed_cycles;
        match &mut self.record {
            Some(last) => last.clone_from(record),
            None => self.record = Some(record.clone()),
        }
    }

    /// The place of a mode in the order of occurrence.
    fn mode(&mut self, active: &ActiveSet) -> usize {
        // That of the last tick, most of the time.
        if let Some(at) = self.modes.iter().position(|mode| mode.active == *active) {
            return at;
        }
        let others = self.modes.iter().filter(|mode| mode.nth.is_some()).count();
        self.modes.push(Mode {
            active: *active,
            nth: (!active.is_empty()).then_some(others),
        });
        self.modes.len() - 1
    }

    /// The mode that lasted longest in pieces from `from` up to, not including, `to`, by its place.
    pub(super) fn mode_between(&self, from: usize, to: usize) -> Option<usize> {
        let to = to.min(self.pieces.len());
        let mut ticks = vec![0u64; self.modes.len()];
        for (mode, more) in self.pieces.get(from..to)?.iter().flat_map(|it| &it.modes) {
            ticks[*mode] += u64::from(*more);
        }
        let longest = (0..ticks.len()).max_by_key(|&mode| ticks[mode])?;
        (ticks[longest] > 0).then_some(longest)
    }
}
