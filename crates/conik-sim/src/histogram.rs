//! How durations are distributed, counted as they come in: room for all is made beforehand, so that
//! counting neither allocates nor waits.
//!
//! Classes are 100 ns wide up to 102 µs and get wider with what they hold: at most 0.2 % of it.

use std::time::Duration;

use serde::{Deserialize, Serialize};

/// Width of the narrowest classes [ns].
const UNIT_NS: u128 = 100;
/// Classes to a doubling of the duration.
const PER_OCTAVE: usize = 512;
/// Doublings beyond the narrowest classes: up to 53 s.
const OCTAVES: usize = 19;
/// Classes altogether.
const CLASSES: usize = PER_OCTAVE * (OCTAVES + 2);

/// Durations, counted by classes.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    counts: Box<[u64]>,
    count: u64,
    min: Duration,
    max: Duration,
}

impl Default for Histogram {
    fn default() -> Self {
        Self {
            counts: vec![0; CLASSES].into_boxed_slice(),
            count: 0,
            min: Duration::MAX,
            max: Duration::ZERO,
        }
    }
}

impl Histogram {
    /// Takes in one duration.
    pub fn add(&mut self, duration: Duration) {
        self.counts[class(duration)] += 1;
        self.count += 1;
        self.min = self.min.min(duration);
        self.max = self.max.max(duration);
    }

    /// What was counted, in microseconds; `None` of nothing.
    pub fn distribution(&self) -> Option<Distribution> {
        if self.count == 0 {
            return None;
        }
        let (min, max) = (micros(self.min), micros(self.max));
        // The middle of the class in which the value lies, of which so many per mille are no larger.
        let per_mille = |share: u64| {
            let rank = (self.count * share).div_ceil(1000).max(1);
            let mut below = 0;
            let class = self.counts.iter().position(|count| {
                below += count;
                below >= rank
            });
            let class = class.unwrap_or(CLASSES - 1);
            f64::midpoint(edge_us(class), edge_us(class + 1)).clamp(min, max)
        };
        Some(Distribution {
            count: self.count,
            min,
            median: per_mille(500),
            p99: per_mille(990),
            p999: per_mille(999),
            max,
            classes: self
                .counts
                .iter()
                .enumerate()
                .filter(|(_, count)| **count > 0)
                .map(|(class, &count)| Class {
                    from: edge_us(class),
                    to: edge_us(class + 1),
                    count,
                })
                .collect(),
        })
    }
}

/// How durations are distributed [µs].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distribution {
    /// How many there were.
    pub count: u64,
    /// The shortest.
    pub min: f64,
    /// Half of them are no longer.
    pub median: f64,
    /// 99 % of them are no longer.
    pub p99: f64,
    /// 99.9 % of them are no longer.
    pub p999: f64,
    /// The longest.
    pub max: f64,
    /// Every class that is not empty, in order.
    pub classes: Vec<Class>,
}

/// Durations from `from` to `to` [µs].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Class {
    /// Least of the class [µs].
    pub from: f64,
    /// Least of the class after it [µs]; the last class of all holds what is longer, too.
    pub to: f64,
    /// How many.
    pub count: u64,
}

fn class(duration: Duration) -> usize {
    // Up to here classes are one unit wide.
    const LINEAR: usize = 2 * PER_OCTAVE;
    let units = usize::try_from(duration.as_nanos() / UNIT_NS).unwrap_or(usize::MAX);
    if units < LINEAR {
        return units;
    }
    let octaves = (units / LINEAR).ilog2() as usize + 1;
    (PER_OCTAVE * octaves + (units >> octaves)).min(CLASSES - 1)
}

/// Least duration of a class [µs].
fn edge_us(class: usize) -> f64 {
    let octaves = (class / PER_OCTAVE).saturating_sub(1);
    let units = (class - PER_OCTAVE * octaves) << octaves;
    units as f64 * UNIT_NS as f64 / 1e3
}

fn micros(duration: Duration) -> f64 {
    duration.as_nanos() as f64 / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_follow_each_other_without_a_gap_and_hold_what_they_say() {
        for octave in 0..33 {
            for nanos in [0, 1, 99, 100, 701, 1023].map(|add| (1_u64 << octave) * 100 + add) {
                let duration = Duration::from_nanos(nanos);
                let us = nanos as f64 / 1e3;
                let found = class(duration);
                let (from, to) = (edge_us(found), edge_us(found + 1));
                assert!(from <= us, "{us} µs in {from} to {to}");
                assert!(us < to || found == CLASSES - 1, "{us} µs in {from} to {to}");
                assert!(
                    to - from <= (0.002 * from).max(0.1 + 1e-9),
                    "{from} to {to}"
                );
            }
        }
        assert_eq!(class(Duration::MAX), CLASSES - 1);
        assert!(edge_us(CLASSES - 1) > 50e6);
    }

    #[test]
    fn shares_are_those_of_the_durations() {
        let mut histogram = Histogram::default();
        assert_eq!(histogram.distribution(), None);
        for us in 1..=1000_u64 {
            histogram.add(Duration::from_micros(10 * us));
        }
        let found = histogram.distribution().unwrap();
        let near = |value: f64, right: f64| (value - right).abs() <= 0.002 * right;
        assert_eq!((found.count, found.min, found.max), (1000, 10.0, 10_000.0));
        assert!(near(found.median, 5000.0), "{}", found.median);
        assert!(near(found.p99, 9900.0), "{}", found.p99);
        assert!(near(found.p999, 9990.0), "{}", found.p999);
        let counted: u64 = found.classes.iter().map(|class| class.count).sum();
        assert_eq!(counted, 1000);
        assert!(found.classes.is_sorted_by(|a, b| a.to <= b.from));
    }
}
