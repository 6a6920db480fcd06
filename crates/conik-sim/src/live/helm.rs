//! Where a person tells the loop what to do: pause, go on, step, go slower, begin anew, go by another scenario.
//!
//! The loop never waits for anybody here, nor does it allocate or free memory: it looks at numbers, and takes
//! what was made ready for it if nobody is just putting it down.

use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::Duration;

use super::stretch::Stretch;

/// What a person asks of a run, and what of it is in force.
#[derive(Debug)]
pub struct Helm {
    arm: HelmedArm,
    has_begun: AtomicBool,
    is_paused: AtomicBool,
    is_restarting: AtomicBool,
    has_ended: AtomicBool,
    /// Single ticks that are still to be run while paused.
    ticks: AtomicU32,
    /// The speed asked for, as bits.
    speed: AtomicU64,
    next: Mutex<Option<Next>>,
    /// What was left; whoever hands over the next one takes it away.
    left: Mutex<Option<Box<Stretch>>>,
    revision: AtomicU64,
    changed: (Mutex<()>, Condvar),
}

/// Which arm it is that the loop drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum HelmedArm {
    Simulated,
    Outside,
}

/// What is to be taken up, and the number of the change that made it.
#[derive(Debug)]
struct Next {
    stretch: Box<Stretch>,
    revision: u64,
}

impl Helm {
    /// The slowest that a run can go without being paused, in its own time over that on the wall.
    pub const LEAST_SPEED: f64 = 0.05;

    /// Of an arm that exists in this program only. It stands and moves on at once, and begins when
    /// [`begin`](Self::begin) is called.
    pub fn of_simulated() -> Self {
        Self::new(HelmedArm::Simulated)
    }

    /// Of any other arm. It is slowed down and sped up gently.
    pub fn of_outside() -> Self {
        Self::new(HelmedArm::Outside)
    }

    fn new(arm: HelmedArm) -> Self {
        Self {
            arm,
            has_begun: AtomicBool::new(arm == HelmedArm::Outside),
            is_paused: AtomicBool::new(false),
            is_restarting: AtomicBool::new(false),
            has_ended: AtomicBool::new(false),
            ticks: AtomicU32::new(0),
            speed: AtomicU64::new(1f64.to_bits()),
            next: Mutex::new(None),
            left: Mutex::new(None),
            revision: AtomicU64::new(0),
            changed: (Mutex::new(()), Condvar::new()),
        }
    }

    /// Whether the arm exists in this program only.
    pub fn is_simulated(&self) -> bool {
        self.arm == HelmedArm::Simulated
    }

    /// Lets the run begin.
    pub fn begin(&self) {
        self.has_begun.store(true, Ordering::Release);
        self.wake();
    }

    /// Whether the run may have begun.
    pub fn has_begun(&self) -> bool {
        self.has_begun.load(Ordering::Acquire)
    }

    /// Stops the time of the run.
    pub fn pause(&self) {
        self.ticks.store(0, Ordering::Release);
        self.is_paused.store(true, Ordering::Release);
        self.wake();
    }

    /// Lets the time of the run go on.
    pub fn resume(&self) {
        self.is_paused.store(false, Ordering::Release);
        self.wake();
    }

    /// Runs so many ticks, and pauses. Simulated arms only.
    pub fn step(&self, ticks: u32) {
        self.is_paused.store(true, Ordering::Release);
        self.ticks.store(ticks, Ordering::Release);
        self.wake();
    }

    /// Whether the time of the run is stopped.
    pub fn is_paused(&self) -> bool {
        self.is_paused.load(Ordering::Acquire)
    }

    /// Sets how fast the time of the run goes, in that on the wall, at least [`Self::LEAST_SPEED`].
    /// An arm with a clock of its own goes no faster than that clock.
    pub fn set_speed(&self, factor: f64) {
        let factor = if factor.is_finite() { factor } else { 1.0 };
        let factor = factor.max(Self::LEAST_SPEED);
        self.speed.store(factor.to_bits(), Ordering::Release);
        self.wake();
    }

    /// How fast the time of the run goes while it is not paused, in that on the wall.
    pub fn speed(&self) -> f64 {
        f64::from_bits(self.speed.load(Ordering::Acquire))
    }

    /// Ends the run, for another one to begin from the start.
    pub fn restart(&self) {
        self.is_restarting.store(true, Ordering::Release);
        self.wake();
    }

    /// Whether the run has ended, or is to end, for another one to begin.
    pub fn is_restarting(&self) -> bool {
        self.is_restarting.load(Ordering::Acquire)
    }

    /// Another run begins: what was asked of the last one is done.
    pub fn begin_anew(&self) {
        *locked(&self.next) = None;
        *locked(&self.left) = None;
        self.ticks.store(0, Ordering::Release);
        self.is_restarting.store(false, Ordering::Release);
        self.has_ended.store(false, Ordering::Release);
    }

    /// Nothing is driven any more.
    pub fn end(&self) {
        self.has_ended.store(true, Ordering::Release);
    }

    /// Whether nothing is driven any more.
    pub fn has_ended(&self) -> bool {
        self.has_ended.load(Ordering::Acquire)
    }

    /// Hands over what the run is to go by from the next tick on, in the place of what was handed over
    /// before and not taken up.
    pub fn hand_over(&self, mut stretch: Box<Stretch>, revision: u64) {
        drop(locked(&self.left).take());
        let mut next = locked(&self.next);
        if let Some(skipped) = next.take() {
            stretch.skip(&skipped.stretch);
        }
        *next = Some(Next { stretch, revision });
    }

    /// The number of the change that is in force.
    pub fn revision(&self) -> u64 {
        self.revision.load(Ordering::Acquire)
    }

    /// Says which change is in force.
    pub fn set_revision(&self, revision: u64) {
        self.revision.store(revision, Ordering::Release);
    }

    /// Puts what is to be taken up, if there is anything and nobody is at it, into the place of `present`,
    /// after `take_over` has brought it up to date. The loop calls this before a tick.
    pub(crate) fn take_up<E>(
        &self,
        present: &mut Stretch,
        take_over: impl FnOnce(&mut Stretch, &Stretch) -> Result<(), E>,
    ) -> Result<(), E> {
        let (Some(mut left), Some(mut next)) = (try_locked(&self.left), try_locked(&self.next))
        else {
            return Ok(());
        };
        // What is left is freed by others; until they have, there is no place for it.
        if left.is_some() {
            return Ok(());
        }
        let Some(Next {
            mut stretch,
            revision,
        }) = next.take()
        else {
            return Ok(());
        };
        take_over(&mut stretch, present)?;
        std::mem::swap(present, &mut stretch);
        *left = Some(stretch);
        self.set_revision(revision);
        Ok(())
    }

    /// Takes one of the single ticks that are to be run, if there is one.
    pub(crate) fn take_tick(&self) -> bool {
        let taken = |ticks: u32| ticks.checked_sub(1);
        let order = Ordering::AcqRel;
        self.ticks
            .fetch_update(order, Ordering::Acquire, taken)
            .is_ok()
    }

    /// Waits, until anything is asked, or for that long.
    pub(crate) fn wait(&self, at_most: Duration) {
        let (lock, changed) = &self.changed;
        drop(changed.wait_timeout(locked(lock), at_most));
    }

    fn wake(&self) {
        let (lock, changed) = &self.changed;
        drop(locked(lock));
        changed.notify_all();
    }
}

/// What is behind a lock is whole whoever panicked with it in hand: it is replaced in one go.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn try_locked<T>(mutex: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    match mutex.try_lock() {
        Ok(guard) => Some(guard),
        Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
        Err(TryLockError::WouldBlock) => None,
    }
}
