//! The emulated controller's clock: one control cycle after another, in wall time or in lockstep.

use super::config::Pace;
use super::lock;
use super::world::Shared;
use std::time::{Duration, Instant};

/// How long lockstep waits for an answer before it passes over a cycle.
const LOCKSTEP_PATIENCE: Duration = Duration::from_secs(5);

/// A cycle in lockstep while there is nobody to wait for.
const LOCKSTEP_IDLE_CYCLE: Duration = Duration::from_millis(1);

/// A clock that is further behind than this was held up by the computer, as no controller's ever
/// is: it goes on from the present. If it rushed through the cycles that it missed, its clients,
/// which were held up as well, could answer none of them, and the arm would stop for want of
/// references.
const MOST_BEHIND: Duration = Duration::from_millis(10);

/// Runs until the emulator ends.
pub(super) fn run(shared: &Shared) {
    shared.hurry();
    match shared.pace {
        Pace::WallTime => run_in_wall_time(shared),
        Pace::Lockstep => run_in_lockstep(shared),
    }
}

/// Deadlines are multiples of the cycle from one beginning, so that no delay adds up.
fn run_in_wall_time(shared: &Shared) {
    let mut beginning = Instant::now();
    let mut cycles: u32 = 0;
    loop {
        cycles += 1;
        let mut deadline = beginning + Duration::from_secs_f64(f64::from(cycles) / shared.rate_hz);
        let now = Instant::now();
        let behind = now.saturating_duration_since(deadline);
        // The count is kept small too, long before it could overflow.
        if behind > MOST_BEHIND || cycles == u32::MAX {
            (beginning, cycles, deadline) = (now, 0, now);
        }
        let mut world = lock(&shared.world);
        if behind > MOST_BEHIND {
            let line = format!(
                "this computer held the clock up for {} ms",
                behind.as_millis()
            );
            world.controller.note(&line);
        }
        loop {
            if world.is_closing {
                return;
            }
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                break;
            }
            world = shared.wait(world, left);
        }
        world.cycle(shared.pace);
    }
}

fn run_in_lockstep(shared: &Shared) {
    let mut world = lock(&shared.world);
    while !world.is_closing {
        world.cycle(shared.pace);
        let (mut deadline, mut awaited) = (Instant::now() + LOCKSTEP_IDLE_CYCLE, false);
        if world.partner().is_some() {
            (deadline, awaited) = (Instant::now() + LOCKSTEP_PATIENCE, true);
        }
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            if world.is_closing || (awaited && !world.awaits_an_answer()) {
                break;
            }
            if left.is_zero() {
                if awaited {
                    world.forgive();
                }
                break;
            }
            world = shared.wait(world, left);
        }
    }
}
