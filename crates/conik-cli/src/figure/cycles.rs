//! Panel: how long the cycles of the arm and the answers to them took, as histograms.

use conik_sim::cycle_times::CycleSummary;
use conik_sim::histogram::Distribution;

use super::axis::{Axis, nice_step};
use super::chart::{Chart, LABEL, Layout};
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::run::Run;
use super::svg::{Marks, Picture};

/// Bars to a chart, about.
const BARS: f64 = 48.0;

/// The time between packages beside the time from a package to its answer; `None` of a run on an
/// arm without a clock of its own.
pub fn panel(run: &Run, width: f64) -> Option<Picture> {
    let cycles = run.summary().cycles.as_ref()?;
    let layout = Layout::alone(width / 2.0, 230.0);
    let mut marks = Marks::default();
    for (nth, (title, distribution)) in both(cycles).into_iter().enumerate() {
        if let Some(distribution) = distribution {
            let at = (layout.width * nth as f64, 0.0);
            marks.place(at, &chart(title, distribution, layout));
        }
    }
    Some(Picture {
        width,
        height: layout.height,
        title: "Histograms of the time between packages and of the time to their answers"
            .to_owned(),
        marks,
    })
}

fn both(cycles: &CycleSummary) -> [(&'static str, Option<&Distribution>); 2] {
    [
        ("from package to package", Some(&cycles.period_us)),
        ("from package to answer", cycles.answer_us.as_ref()),
    ]
}

/// One distribution as bars over time, their heights on a logarithmic scale: what is rare matters.
fn chart(title: &str, distribution: &Distribution, layout: Layout) -> Picture {
    let bars = Bars::of(distribution);
    let most = bars.counts.iter().copied().max().unwrap_or(1).max(1) as f64;
    let x = Axis::spanning(
        bars.from,
        bars.to(),
        if layout.width < 330.0 { 4 } else { 6 },
    );
    let y = Axis::decades(0.8, most.max(10.0), 5);
    let mut chart = Chart::over(layout, title, (x, "time [µs]"), (y, "cycles, log."));
    let floor = chart.plot().at.1 + chart.plot().size.1;
    for (nth, &count) in bars.counts.iter().enumerate() {
        if count == 0 {
            continue;
        }
        let from = bars.from + bars.width * nth as f64;
        let (left, top) = chart.at(from, count as f64);
        let (right, _) = chart.at(from + bars.width, count as f64);
        let size = ((right - left - 0.6).max(0.6), floor - top);
        chart.marks.rect((left, top), size, palette::INK, 0.75);
    }
    let median = Stroke::dashed(palette::ALARM, 1.2, "4 2.5");
    chart.instant(distribution.median, median);
    let words = [
        format!("median {} µs", lettering::number(distribution.median, 4)),
        format!("99.9 % ≤ {} µs", lettering::number(distribution.p999, 4)),
        format!("longest {} µs", lettering::number(distribution.max, 4)),
    ];
    let (left, top) = chart.plot().at;
    let right = left + chart.plot().size.0;
    for (nth, words) in words.iter().enumerate() {
        let style = Lettering::new(LABEL, palette::SOFT)
            .anchored("end")
            .rimmed();
        let at = (right - 8.0, top + 15.0 + 14.0 * nth as f64);
        chart.marks.text(at, words, style);
    }
    if bars.beyond > 0 {
        let words = format!("{} beyond", bars.beyond);
        let style = Lettering::new(LABEL, palette::ALARM)
            .anchored("end")
            .bold()
            .rimmed();
        chart.marks.text((right - 8.0, floor - 6.0), &words, style);
    }
    chart.finish(&format!("Histogram of the time {title}"))
}

/// Equally wide bars: those of nearly all cycles. What is far beyond is counted, not shown, or all
/// else would be one bar.
struct Bars {
    /// Where the first begins [µs].
    from: f64,
    /// Width of each [µs].
    width: f64,
    counts: Vec<u64>,
    /// Cycles beyond the last.
    beyond: u64,
}

impl Bars {
    fn of(distribution: &Distribution) -> Self {
        let Distribution {
            min,
            median,
            p99,
            max,
            ..
        } = *distribution;
        // Twice as wide as nearly all: a lone straggler is counted, not drawn.
        let to = max.min(p99 + (p99 - min).max(0.1 * median));
        let width = nice_step(((to - min) / BARS).max(0.1));
        let from = (min / width).floor() * width;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates.
        let bar = |us: f64| ((us - from) / width).max(0.0) as usize;
        let mut counts = vec![0; bar(to) + 1];
        let mut beyond = 0;
        for class in &distribution.classes {
            // A class lies where its middle does: it is narrower than a bar, or nearly so.
            let middle = f64::midpoint(class.from, class.to).clamp(min, max);
            match counts.get_mut(bar(middle)) {
                Some(count) => *count += class.count,
                None => beyond += class.count,
            }
        }
        Self {
            from,
            width,
            counts,
            beyond,
        }
    }

    fn to(&self) -> f64 {
        self.from + self.width * self.counts.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use conik_sim::histogram::Histogram;
    use std::time::Duration;

    fn bars(us: impl Iterator<Item = u64>) -> Bars {
        let mut histogram = Histogram::default();
        us.for_each(|us| histogram.add(Duration::from_micros(us)));
        Bars::of(&histogram.distribution().unwrap())
    }

    #[test]
    fn every_cycle_is_in_a_bar_or_counted_beyond() {
        for (far, beyond) in [(2060, 0), (80_000, 1)] {
            let steady = (0..5000).map(|cycle| 1950 + cycle % 100);
            let bars = bars(steady.chain([far]));
            assert_eq!(bars.beyond, beyond, "one at {far} µs");
            assert_eq!(bars.counts.iter().sum::<u64>() + beyond, 5001);
            assert!(
                (20..200).contains(&bars.counts.len()),
                "{}",
                bars.counts.len()
            );
            assert!(bars.from <= 1950.0 && bars.to() >= 2050.0);
        }
        let constant = bars([8000; 3].into_iter());
        assert_eq!(
            (constant.counts.iter().sum::<u64>(), constant.beyond),
            (3, 0)
        );
    }
}
