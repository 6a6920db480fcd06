//! Lays out text for a terminal: tables, prose, counts.

/// Lines of prose are broken here: the least width of a terminal.
const WIDTH: usize = 80;

/// `1 cycle`, `2 cycles`.
pub fn counted(number: u64, noun: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {noun}{plural}")
}

/// Prose in lines of at most [`WIDTH`], the first after `indent`, the others below it.
pub fn wrapped(indent: &str, prose: &str) -> String {
    let mut text = String::new();
    let mut line = indent.to_owned();
    let mut is_empty = true;
    for word in prose.split(' ') {
        if !is_empty && line.chars().count() + 1 + word.chars().count() > WIDTH {
            text += &line;
            text.push('\n');
            line = " ".repeat(indent.chars().count());
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line += word;
        is_empty = false;
    }
    text + &line + "\n"
}

/// Columns side by side, the first row a heading. What is longer than a line stands out of its column:
/// names may have any length, and the width of a format is a 16-bit number.
pub fn table<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| {
        rows.iter()
            .map(|row| row[column].chars().count())
            .max()
            .unwrap_or(0)
            .min(WIDTH)
    };
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let mut line = String::from(" ");
        for (cell, width) in row.iter().zip(widths) {
            line += &format!(" {cell:<width$} ");
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prose_is_broken_between_words_and_stays_indented() {
        let prose = "a dozen words ".repeat(12);
        let text = wrapped("  - ", prose.trim_end());
        assert!(text.starts_with("  - a dozen"));
        assert!(text.lines().skip(1).all(|line| line.starts_with("    ")));
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH));
        let words: Vec<&str> = text.split_whitespace().skip(1).collect();
        assert_eq!(words.join(" "), prose.trim_end());
    }

    #[test]
    fn names_of_any_length_stand_in_a_table() {
        let name = "x".repeat(100_000);
        let rows = [["task", "kind"], [&name, "set"]];
        let text = table(&rows.map(|row| row.map(str::to_owned)));
        assert!(text.ends_with(&format!("  {name}  set\n")));
    }

    #[test]
    fn word_longer_than_a_line_stays_whole() {
        let word = "x".repeat(2 * WIDTH);
        assert_eq!(wrapped("  ", &word), format!("  {word}\n"));
    }
}
