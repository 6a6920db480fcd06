//! When packages came, against when the controller's clock says that they were made.
//!
//! Lateness is what a package took beyond the quickest ones. The two clocks may go at slightly
//! different rates; that drift is taken out first, by a line through all packages.

use std::time::Duration;

/// One package: when it was made and when it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// The controller's clock [s].
    pub timestamp: f64,
    /// Our clock, since the first package was waited for.
    pub came: Duration,
    /// Packages that had been waiting with it and were older.
    pub passed_over: u64,
}

/// How some durations are distributed [µs].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The shortest.
    pub min: f64,
    /// Half of them are shorter.
    pub median: f64,
    /// 99 % of them are shorter.
    pub p99: f64,
    /// 99.9 % of them are shorter.
    pub p999: f64,
    /// The longest.
    pub max: f64,
}

/// What a series of packages says of computer and link.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// Packages read.
    pub packages: usize,
    /// Cycles of which no package was read in time: never sent, or passed over for a newer one.
    pub missed: u64,
    /// The part of them of which the packages came, but too late.
    pub passed_over: u64,
    /// Packages of a cycle that had been seen before, or of one before it.
    pub repeated: u64,
    /// From one package to the next [µs].
    pub period_us: Spread,
    /// Later than the quickest [µs].
    pub lateness_us: Spread,
    /// How many packages were later than each of [`Timing::BOUNDS_US`]; the last entry counts all
    /// beyond the last bound.
    pub histogram: [u64; Timing::BOUNDS_US.len() + 1],
    /// How much faster the controller's clock goes than ours [millionths].
    pub drift_ppm: f64,
}

impl Timing {
    /// Upper bounds of the classes of lateness [µs].
    pub const BOUNDS_US: [f64; 8] = [50.0, 100.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0];

    /// The timing of packages that ought to come every `cycle_s`; `None` of fewer than three.
    pub fn of(arrivals: &[Arrival], cycle_s: f64) -> Option<Self> {
        if arrivals.len() < 3 {
            return None;
        }
        let periods: Vec<f64> = arrivals
            .windows(2)
            .map(|pair| 1e6 * (pair[1].came.as_secs_f64() - pair[0].came.as_secs_f64()))
            .collect();
        let (mut missed, mut repeated) = (0, 0);
        for pair in arrivals.windows(2) {
            let cycles = (pair[1].timestamp - pair[0].timestamp) / cycle_s;
            if cycles < 0.5 {
                repeated += 1;
            } else {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
                // Positive, and saturates.
                let cycles = cycles.round() as u64;
                missed += cycles - 1;
            }
        }
        let (lateness, drift) = lateness(arrivals);
        let mut histogram = [0; Self::BOUNDS_US.len() + 1];
        for late in &lateness {
            let class = Self::BOUNDS_US.iter().position(|bound| late <= bound);
            histogram[class.unwrap_or(Self::BOUNDS_US.len())] += 1;
        }
        Some(Self {
            packages: arrivals.len(),
            missed,
            passed_over: arrivals[1..]
                .iter()
                .map(|package| package.passed_over)
                .sum(),
            repeated,
            period_us: Spread::of(periods)?,
            lateness_us: Spread::of(lateness)?,
            histogram,
            drift_ppm: 1e6 * drift,
        })
    }
}

impl Spread {
    /// The distribution of these values; `None` without any.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        let per_mille = |per_mille: usize| values[(last * per_mille).div_ceil(1000)];
        Some(Self {
            min: values[0],
            median: per_mille(500),
            p99: per_mille(990),
            p999: per_mille(999),
            max: values[last],
        })
    }
}

/// How much later than the quickest each package came [µs], and the drift of the clocks.
fn lateness(arrivals: &[Arrival]) -> (Vec<f64>, f64) {
    let start = arrivals[0];
    let points: Vec<(f64, f64)> = arrivals
        .iter()
        .map(|package| {
            let ours = package.came.as_secs_f64() - start.came.as_secs_f64();
            let theirs = package.timestamp - start.timestamp;
            (theirs, ours - theirs)
        })
        .collect();
    let slope = slope(&points);
    let residuals = points.iter().map(|(x, y)| y - slope * x);
    let quickest = residuals.clone().fold(f64::INFINITY, f64::min);
    let late = residuals.map(|y| 1e6 * (y - quickest)).collect();
    // Ours grows faster than theirs where theirs is slow.
    (late, -slope)
}

/// The slope of the line through points by least squares; 0 where there is none.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
    let (x, y) = (x / count, y / count);
    let (xx, xy) = points.iter().fold((0.0, 0.0), |sum, point| {
        let (dx, dy) = (point.0 - x, point.1 - y);
        (sum.0 + dx * dx, sum.1 + dx * dy)
    });
    if xx > 0.0 { xy / xx } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYCLE: f64 = 0.002;

    fn arrivals(late_us: impl Fn(u32) -> u64, count: u32) -> Vec<Arrival> {
        (0..count)
            .map(|cycle| Arrival {
                timestamp: 60.0 + CYCLE * f64::from(cycle),
                came: Duration::from_micros(300 + 2000 * u64::from(cycle) + late_us(cycle)),
                passed_over: 0,
            })
            .collect()
    }

    fn near(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance, "{a} is not {b}");
    }

    #[test]
    fn lateness_counts_from_the_quickest_package() {
        // Every tenth package is 700 µs late.
        let late = arrivals(|cycle| if cycle % 10 == 5 { 700 } else { 0 }, 1000);
        let timing = Timing::of(&late, CYCLE).unwrap();
        assert_eq!((timing.packages, timing.missed), (1000, 0));
        near(timing.lateness_us.min, 0.0, 1e-6);
        near(timing.lateness_us.median, 0.0, 1.0);
        near(timing.lateness_us.p99, 700.0, 1.0);
        assert_eq!(timing.histogram, [900, 0, 0, 0, 100, 0, 0, 0, 0]);
        near(timing.period_us.min, 1300.0, 1e-3);
        near(timing.period_us.median, 2000.0, 1e-3);
        near(timing.period_us.max, 2700.0, 1e-3);
    }

    #[test]
    fn clocks_that_drift_apart_are_not_late() {
        let mut packages = arrivals(|_| 0, 5000);
        for package in &mut packages {
            package.timestamp = 60.0 + (package.timestamp - 60.0) * (1.0 + 80e-6);
        }
        let timing = Timing::of(&packages, CYCLE).unwrap();
        near(timing.drift_ppm, 80.0, 0.1);
        assert!(timing.lateness_us.max < 1.0, "{timing:?}");
    }

    #[test]
    fn cycles_missed_and_repeated_are_counted() {
        let mut packages = arrivals(|_| 0, 100);
        packages.remove(50);
        packages.drain(20..23);
        packages[30].passed_over = 3;
        packages[60].timestamp = packages[59].timestamp;
        let timing = Timing::of(&packages, CYCLE).unwrap();
        // The package after the repeated one seems two cycles later.
        assert_eq!((timing.missed, timing.repeated), (1 + 3 + 1, 1));
        assert_eq!(timing.passed_over, 3);
        assert_eq!(Timing::of(&packages[..2], CYCLE), None);
    }
}
