//! One axis: which values it shows, where its ticks are and what they say.

use super::lettering;

/// One axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    logarithmic: bool,
    ticks: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis from `low` to `high` with about `count` ticks, exactly as long as said.
    pub fn spanning(low: f64, high: f64, count: usize) -> Self {
        let (low, high) = widened(low, high);
        Self {
            low,
            high,
            logarithmic: false,
            ticks: linear_ticks(low, high, count),
        }
    }

    /// A linear axis with some room around the values `low` to `high`.
    pub fn around(low: f64, high: f64, count: usize) -> Self {
        let (low, high) = widened(low, high);
        let room = 0.07 * (high - low);
        // A quantity that is never negative is not given a negative axis.
        let floor = if low >= 0.0 { 0.0 } else { f64::NEG_INFINITY };
        Self::spanning((low - room).max(floor), high + room, count)
    }

    /// A logarithmic axis around the positive values `low` to `high`, over at most 12 decades.
    pub fn decades(low: f64, high: f64, count: usize) -> Self {
        let top = high.log10();
        let bottom = low.log10().max(top - 12.0);
        let room = 0.05 * (top - bottom).max(1.0);
        let (bottom, top) = (bottom - room, top + room);
        let mut ticks = Vec::new();
        let mut stride = 1;
        while (top - bottom) / f64::from(stride) > count as f64 {
            stride += 1;
        }
        for exponent in -320..=308_i32 {
            let value = f64::from(exponent);
            if exponent % stride == 0 && (bottom..=top).contains(&value) {
                ticks.push((10_f64.powi(exponent), lettering::power_of_ten(exponent)));
            }
        }
        Self {
            low: 10_f64.powf(bottom),
            high: 10_f64.powf(top),
            logarithmic: true,
            ticks,
        }
    }

    /// An axis with one tick for each of `count` things, at 0, 1, 2, ...
    pub fn listing(labels: Vec<String>) -> Self {
        let high = labels.len() as f64 - 0.5;
        Self {
            low: -0.5,
            high: high.max(0.5),
            logarithmic: false,
            ticks: (0..).map(f64::from).zip(labels).collect(),
        }
    }

    /// Least value shown.
    pub fn low(&self) -> f64 {
        self.low
    }

    /// Greatest value shown.
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Values and labels of the ticks.
    pub fn ticks(&self) -> &[(f64, String)] {
        &self.ticks
    }

    /// Whether the axis counts in powers of ten.
    pub fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Where `value` is between the low end (0) and the high end (1); NaN stays NaN, all else is
    /// kept on the axis.
    pub fn fraction(&self, value: f64) -> f64 {
        let of = |value: f64| {
            if self.logarithmic {
                value.max(self.low).log10()
            } else {
                value
            }
        };
        if value.is_nan() {
            return value;
        }
        ((of(value) - of(self.low)) / (of(self.high) - of(self.low))).clamp(0.0, 1.0)
    }
}

/// The least and greatest finite value, (0, 1) if there is none.
pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if low <= high { (low, high) } else { (0.0, 1.0) }
}

/// A constant is shown in the middle of an axis, not on one of no length; and noise in the last
/// digits of a constant is not blown up to fill the chart.
fn widened(low: f64, high: f64) -> (f64, f64) {
    // Halves, so that the extremes of f64 do not overflow.
    let middle = low / 2.0 + high / 2.0;
    let least = (1e-4 * middle.abs()).max(1e-9);
    if high - low >= least && (high - low).is_finite() {
        (low, high)
    } else if (high - low).is_finite() {
        let half = if middle == 0.0 {
            1.0
        } else {
            (0.1 * middle.abs()).max(1e-9)
        };
        (middle - half, middle + half)
    } else {
        (-1e300, 1e300)
    }
}

fn linear_ticks(low: f64, high: f64, count: usize) -> Vec<(f64, String)> {
    let step = nice_step((high - low) / count.max(1) as f64);
    let decimals = decimals_of(step);
    let mut ticks = Vec::new();
    let mut nth = (low / step - 1e-6).ceil();
    while nth * step <= high + 1e-6 * step && ticks.len() < 4 * count.max(1) {
        let value = nth * step;
        ticks.push((value, tick_label(value, step, decimals)));
        nth += 1.0;
    }
    ticks
}

/// The least of 1, 2, 5 times a power of ten that is not below `raw`.
pub fn nice_step(raw: f64) -> f64 {
    let power = 10_f64.powf(raw.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= raw * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

/// Decimals that a multiple of `step` needs.
pub fn decimals_of(step: f64) -> usize {
    (0..12)
        .find(|&decimals| step >= 0.999 * 10_f64.powi(-decimals))
        .and_then(|decimals| usize::try_from(decimals).ok())
        .unwrap_or(12)
}

fn tick_label(value: f64, step: f64, decimals: usize) -> String {
    if value.abs() < 1e-6 * step {
        "0".to_owned()
    } else if value.abs() >= 1e6 || decimals > 5 {
        lettering::number(value, 4)
    } else {
        lettering::minus(&format!("{value:.decimals$}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks().iter().map(|tick| tick.1.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(
            labels(&Axis::spanning(0.0, 60.0, 6)),
            ["0", "10", "20", "30", "40", "50", "60"]
        );
        assert_eq!(
            labels(&Axis::spanning(-0.11, 0.12, 4)),
            ["−0.1", "0", "0.1"]
        );
        assert_eq!(
            labels(&Axis::decades(1e-6, 1.0, 4)),
            ["10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]
        );
    }

    #[test]
    fn a_constant_has_an_axis() {
        for value in [0.0, 0.18, -3.0, 1e300, f64::MAX] {
            let axis = Axis::around(value, value, 4);
            assert!(axis.low() < axis.high(), "{value}");
            assert!((0.0..=1.0).contains(&axis.fraction(value)), "{value}");
            assert!(!axis.ticks().is_empty(), "{value}");
        }
        assert_eq!(range([f64::NAN, f64::INFINITY]), (0.0, 1.0));
    }

    #[test]
    fn extremes_of_the_number_range_do_not_hang() {
        let axis = Axis::around(f64::MIN, f64::MAX, 4);
        assert!(axis.ticks().len() < 20);
        assert!(axis.fraction(f64::NAN).is_nan());
    }
}
