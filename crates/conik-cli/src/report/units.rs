//! Quantities in the unit in which they read well: millimetres where metres are small.

use crate::figure::lettering::number;

/// `value` in `unit` as people write it.
pub fn quantity(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    let size = value.abs();
    let (scale, shown) = match unit {
        "m" if size == 0.0 || size >= 1.0 => (1.0, "m"),
        "m" if size >= 1e-3 => (1e3, "mm"),
        "m" if size >= 1e-6 => (1e6, "µm"),
        "m" => (1e9, "nm"),
        "rad" if size > 0.0 && size < 1e-3 => (1e6, "µrad"),
        "rad" if size > 0.0 && size < 0.1 => (1e3, "mrad"),
        "-" => (1.0, ""),
        other => (1.0, other),
    };
    let text = number(value * scale, 3);
    if shown.is_empty() {
        text
    } else {
        format!("{text}\u{a0}{shown}")
    }
}

/// `value` in `unit` as the scenario has it, to four digits: a limit should be recognised.
pub fn limit(value: f64, unit: &str) -> String {
    let text = number(value, 4);
    if unit == "-" {
        text
    } else {
        format!("{text}\u{a0}{unit}")
    }
}

/// A quantity that may be missing.
pub fn optional(value: Option<f64>, unit: &str) -> String {
    value.map_or_else(|| "–".to_owned(), |value| quantity(value, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_lengths_are_in_small_units() {
        for (value, unit, text) in [
            (690e-6, "m", "690 µm"),
            (0.00198, "m", "1.98 mm"),
            (3.09e-7, "m", "309 nm"),
            (0.0, "m", "0 m"),
            (1.25, "m", "1.25 m"),
            (0.0021, "-", "0.0021"),
            (3.1e-4, "rad", "310 µrad"),
            (f64::NAN, "m", "–"),
        ] {
            assert_eq!(quantity(value, unit), text.replace(' ', "\u{a0}"));
        }
        assert_eq!(limit(0.2622, "-"), "0.2622");
        assert_eq!(limit(0.18, "m"), "0.18\u{a0}m");
    }
}
