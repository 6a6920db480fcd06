//! When the loop ticks: at every cycle of the arm, or as a person at the helm wants it.
//!
//! An arm without a clock of its own waits for the time of the run. One with a clock needs a reference in each
//! of its cycles, also while the time of the run goes slower: it is then led along the straight way from one
//! sample to the next.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::helm::Helm;

/// How long an arm outside this program takes to come to rest, or to full speed [s].
const RAMP_S: f64 = 0.25;

/// Between two looks at whether to stop, at most.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// A run that fell this far behind the clock on the wall does not try to catch up.
const LATE: Duration = Duration::from_millis(100);

/// What to do in a cycle of the arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Turn {
    /// A tick.
    Tick,
    /// None: lead the arm on its way to where the last tick sent it.
    Between {
        /// Share of the way behind it, in [0, 1).
        share: f64,
        /// How fast time goes, in that of the arm's clock.
        speed: f64,
    },
}

/// Decides when the loop ticks.
#[derive(Debug)]
pub(crate) struct Pace<'a> {
    helm: Option<&'a Helm>,
    has_clock: bool,
    period_s: f64,
    /// When the next tick of an arm without a clock is due.
    due: Instant,
    speed: f64,
    share: f64,
}

impl<'a> Pace<'a> {
    pub(crate) fn new(helm: Option<&'a Helm>, has_clock: bool, period_s: f64) -> Self {
        Self {
            helm,
            has_clock,
            period_s,
            due: Instant::now(),
            speed: helm.map_or(1.0, |helm| f64::from(!helm.is_simulated())),
            share: 0.0,
        }
    }

    /// Waits until an arm without a clock is to tick. `false`: the run is to end instead.
    pub(crate) fn wait(&mut self, stop: &AtomicBool) -> bool {
        loop {
            if stop.load(Ordering::Relaxed) || self.helm.is_some_and(Helm::is_restarting) {
                return false;
            }
            let Some(helm) = self.helm.filter(|_| !self.has_clock) else {
                return true;
            };
            let now = Instant::now();
            if !helm.has_begun() || helm.is_paused() {
                if helm.has_begun() && helm.take_tick() {
                    self.due = now;
                    return true;
                }
                self.due = now;
                helm.wait(LOOK_EVERY);
                continue;
            }
            let period = Duration::from_secs_f64(self.period_s / helm.speed());
            if now >= self.due {
                let is_late = now - self.due > LATE;
                self.due = if is_late { now } else { self.due } + period;
                return true;
            }
            helm.wait((self.due - now).min(LOOK_EVERY));
        }
    }

    /// What to do in this cycle of the arm.
    pub(crate) fn turn(&mut self) -> Turn {
        let Some(helm) = self.helm.filter(|_| self.has_clock) else {
            return Turn::Tick;
        };
        let is_running = helm.has_begun() && !helm.is_paused();
        let wanted = if is_running {
            helm.speed().min(1.0)
        } else {
            0.0
        };
        if helm.is_simulated() {
            self.speed = wanted;
            if wanted == 0.0 && helm.has_begun() && helm.take_tick() {
                self.share = 0.0;
                return Turn::Tick;
            }
        } else {
            let most = self.period_s / RAMP_S;
            self.speed += (wanted - self.speed).clamp(-most, most);
        }
        self.share += self.speed;
        if self.share < 1.0 {
            return Turn::Between {
                share: self.share,
                speed: self.speed,
            };
        }
        // At full speed references are the samples themselves, which were checked.
        self.share = if self.speed < 1.0 {
            self.share - 1.0
        } else {
            0.0
        };
        Turn::Tick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turns(pace: &mut Pace, cycles: usize) -> Vec<Turn> {
        (0..cycles).map(|_| pace.turn()).collect()
    }

    fn way(turns: &[Turn]) -> f64 {
        let ticks = turns.iter().filter(|turn| **turn == Turn::Tick).count();
        let rest = match turns.last() {
            Some(Turn::Between { share, .. }) => *share,
            _ => 0.0,
        };
        ticks as f64 + rest
    }

    #[test]
    fn without_a_helm_every_cycle_is_a_tick() {
        let mut pace = Pace::new(None, true, 0.008);
        assert!(pace.wait(&AtomicBool::new(false)));
        assert_eq!(turns(&mut pace, 3), [Turn::Tick; 3]);
    }

    #[test]
    fn outside_arm_comes_to_rest_gently_and_back_to_its_samples() {
        let helm = Helm::of_outside();
        let mut pace = Pace::new(Some(&helm), true, 0.01);
        assert_eq!(turns(&mut pace, 2), [Turn::Tick; 2]);
        helm.pause();
        let slowing = turns(&mut pace, 40);
        // Half of the way of the ramp's 25 cycles at full speed.
        assert!((way(&slowing) - 12.0).abs() <= 1.0, "{slowing:?}");
        let (mut last, mut since) = (1.0, 0);
        for turn in &slowing {
            since += 1;
            if let Turn::Between { share, speed } = *turn {
                assert!((0.0..1.0).contains(&share));
                let slowest = last - 0.04 * f64::from(since);
                assert!(speed <= last && speed >= slowest - 1e-12, "{slowing:?}");
                (last, since) = (speed, 0);
            }
        }
        assert!(last.abs() < 1e-12, "it stands");
        helm.resume();
        turns(&mut pace, 30);
        assert_eq!(turns(&mut pace, 3), [Turn::Tick; 3]);
    }

    #[test]
    fn simulated_arm_with_a_clock_stands_at_once_and_steps() {
        let helm = Helm::of_simulated();
        let mut pace = Pace::new(Some(&helm), true, 0.008);
        let waiting = pace.turn();
        assert!(matches!(waiting, Turn::Between { speed: 0.0, .. }));
        helm.begin();
        helm.pause();
        let held = turns(&mut pace, 3);
        assert!(
            held.iter()
                .all(|turn| matches!(turn, Turn::Between { speed: 0.0, .. }))
        );
        helm.step(2);
        let stepped = turns(&mut pace, 4);
        assert_eq!(stepped[..2], [Turn::Tick; 2]);
        assert!(matches!(stepped[3], Turn::Between { share: 0.0, .. }));
        helm.resume();
        helm.set_speed(0.25);
        assert_eq!(way(&turns(&mut pace, 40)), 10.0);
    }

    #[test]
    fn arm_without_a_clock_waits_for_the_first_who_looks() {
        let helm = Helm::of_simulated();
        let mut pace = Pace::new(Some(&helm), false, 1e-4);
        let stop = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let waiting = scope.spawn(|| pace.wait(&stop));
            assert!(!helm.has_begun());
            helm.begin();
            assert!(waiting.join().unwrap());
        });
        helm.pause();
        stop.store(true, Ordering::Relaxed);
        assert!(!pace.wait(&stop));
    }
}
