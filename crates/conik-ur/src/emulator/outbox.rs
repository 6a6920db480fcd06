//! What waits to be written to one client: all answers, and only the newest package of outputs.
//!
//! A client that reads slowly thus gets fewer packages but never an old one, and whoever puts
//! something in never waits.

use super::lock;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};

/// Answers that may wait; a client that asks on and on without reading is cut off.
const MOST_ANSWERS: usize = 256;

#[derive(Debug, Default)]
pub(super) struct Outbox {
    waiting: Mutex<Waiting>,
    changed: Condvar,
    /// Whether to write one byte at a time.
    one_byte: AtomicBool,
}

#[derive(Debug, Default)]
struct Waiting {
    answers: VecDeque<Vec<u8>>,
    newest: Option<Vec<u8>>,
    is_finishing: bool,
    is_closed: bool,
}

impl Outbox {
    /// Adds an answer behind all others.
    pub(super) fn answer(&self, bytes: Vec<u8>) {
        let mut waiting = lock(&self.waiting);
        waiting.answers.push_back(bytes);
        waiting.is_closed |= waiting.answers.len() > MOST_ANSWERS;
        self.changed.notify_all();
    }

    /// Puts a package of outputs in the place of an older one.
    pub(super) fn offer(&self, package: Vec<u8>) {
        lock(&self.waiting).newest = Some(package);
        self.changed.notify_all();
    }

    /// The most bytes to write in one go.
    pub(super) fn portion(&self) -> usize {
        if self.one_byte.load(Ordering::Relaxed) {
            1
        } else {
            usize::MAX
        }
    }

    /// Whether to write one byte at a time.
    pub(super) fn set_one_byte(&self, on: bool) {
        self.one_byte.store(on, Ordering::Relaxed);
    }

    /// Whether nothing but what waits is written any more.
    pub(super) fn is_ending(&self) -> bool {
        let waiting = lock(&self.waiting);
        waiting.is_closed || waiting.is_finishing
    }

    /// Ends it once all answers are written.
    pub(super) fn finish(&self) {
        lock(&self.waiting).is_finishing = true;
        self.changed.notify_all();
    }

    /// Ends it; what waits is not written any more.
    pub(super) fn close(&self) {
        lock(&self.waiting).is_closed = true;
        self.changed.notify_all();
    }

    /// What waits, without waiting for more.
    #[cfg(test)]
    pub(super) fn take_all(&self) -> Vec<Vec<u8>> {
        let mut waiting = lock(&self.waiting);
        let newest = waiting.newest.take();
        waiting.answers.drain(..).chain(newest).collect()
    }

    /// Waits for something to write; `None` once it is closed.
    pub(super) fn take(&self) -> Option<Vec<u8>> {
        let mut waiting = lock(&self.waiting);
        loop {
            if waiting.is_closed {
                return None;
            }
            if let Some(bytes) = waiting.answers.pop_front() {
                return Some(bytes);
            }
            if waiting.is_finishing {
                waiting.is_closed = true;
                return None;
            }
            if let Some(bytes) = waiting.newest.take() {
                return Some(bytes);
            }
            waiting = self
                .changed
                .wait(waiting)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_newest_package_waits_but_every_answer_does() {
        let outbox = Outbox::default();
        outbox.offer(vec![1]);
        outbox.answer(vec![10]);
        outbox.offer(vec![2]);
        outbox.answer(vec![11]);
        let taken: Vec<_> = (0..3).map(|_| outbox.take().unwrap()).collect();
        assert_eq!(taken, [[10], [11], [2]]);
    }

    #[test]
    fn a_client_that_never_reads_its_answers_is_cut_off() {
        let outbox = Outbox::default();
        for _ in 0..=MOST_ANSWERS {
            outbox.answer(vec![0]);
        }
        assert_eq!(outbox.take(), None);
    }
}
