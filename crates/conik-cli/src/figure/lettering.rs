//! How wide a text will be, how to shorten it, and how numbers are written.
//!
//! No font is read: the widths are those of Helvetica's characters, rounded up, which are also
//! Arial's and Liberation Sans'.

/// Width of `text` set in `size` [px].
pub fn width(text: &str, size: f64) -> f64 {
    size * text.chars().map(em).sum::<f64>()
}

/// How much wider than plain text bold text is.
pub const BOLD: f64 = 1.1;

fn em(character: char) -> f64 {
    match character {
        'i' | 'j' | 'l' | '\'' | '|' => 0.23,
        ' ' | '\u{a0}' | '.' | ',' | ':' | ';' | '/' | 'I' | 't' | 'f' | '[' | ']' | '!' => 0.28,
        'r' | '-' | '(' | ')' | '⁻' | '⁰'..='⁹' | '¹' | '²' | '³' => 0.34,
        's' | 'c' | 'k' | 'v' | 'x' | 'y' | 'z' => 0.5,
        'm' | 'M' => 0.84,
        'w' | 'A'..='Z' => 0.72,
        '\u{1100}'.. => 1.0,
        _ => 0.56,
    }
}

/// `text`, or as much of it as fits `room` [px] with its middle left out: the ends of names are
/// what tells them apart.
pub fn shorten(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let characters: Vec<char> = text.chars().collect();
    let mut kept = characters.len();
    while kept > 2 {
        kept -= 1;
        let head: String = characters[..kept.div_ceil(2)].iter().collect();
        let tail: String = characters[characters.len() - kept / 2..].iter().collect();
        let short = format!("{}…{}", head.trim_end(), tail.trim_start());
        if width(&short, size) <= room {
            return short;
        }
    }
    "…".to_owned()
}

/// `value` with `digits` significant digits; powers of ten where zeros would be counted.
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{:.*e}", digits.saturating_sub(1), value);
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    let Ok(exponent) = exponent.parse::<i32>() else {
        return scientific;
    };
    if (-3..6).contains(&exponent) {
        let decimals = usize::try_from(i32::try_from(digits).unwrap_or(1) - 1 - exponent);
        let text = format!("{value:.*}", decimals.unwrap_or(0));
        return minus(trim_zeros(&text));
    }
    minus(&format!(
        "{} × {}",
        trim_zeros(mantissa),
        power_of_ten(exponent)
    ))
}

/// 10 to the `exponent`, as it is printed.
pub fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let raised = digits.chars().map(|digit| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    });
    format!("10{}", raised.collect::<String>())
}

/// A time [s], to the millisecond; it does not break across lines.
pub fn seconds(t_s: f64) -> String {
    format!("{}\u{a0}s", trim_zeros(&format!("{t_s:.3}")))
}

fn trim_zeros(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// The hyphen that machines write for minus, as a minus.
pub fn minus(text: &str) -> String {
    text.replacen('-', "−", 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_in_print() {
        for (value, text) in [
            (0.0, "0"),
            (0.18, "0.18"),
            (-0.2622, "−0.262"),
            (690e-6, "6.9 × 10⁻⁴"),
            (12345.0, "12345"),
            (-3.0e9, "−3 × 10⁹"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(number(value, 3), text);
        }
    }

    #[test]
    fn a_name_too_long_keeps_both_its_ends() {
        let short = shorten("obstacle_with_a_long_name_number_17", 10.0, 90.0);
        assert!(
            short.starts_with("obst") && short.ends_with("17"),
            "{short}"
        );
        assert!(width(&short, 10.0) <= 90.0);
        assert_eq!(shorten("view", 10.0, 90.0), "view");
        assert_eq!(shorten("view", 10.0, 1.0), "…");
    }
}
