//! From text to TOML tables: mistakes of syntax, in words and with the key that they concern.

use toml::de::DeTable;

use super::mistake::{Mistakes, ScenarioErrors, floor_char, quoted};

/// In a text up to this size all mistakes of syntax are looked for, in a greater one the first.
const MOST_SEARCHED: usize = 64 * 1024;

/// The file's tables, with their places.
pub(super) fn parse(text: &str) -> Result<DeTable<'_>, ScenarioErrors> {
    let first = match DeTable::parse(text) {
        Ok(tables) => return Ok(tables.into_inner()),
        Err(error) => error,
    };
    let all = if text.len() <= MOST_SEARCHED {
        DeTable::parse_recoverable(text).1
    } else {
        vec![]
    };
    // After an unclosed bracket nothing else can be told apart, but a mistake within one value
    // stands for itself.
    let of_its_own = |message: &str| {
        message.contains("duplicate key") || message.contains("string values must be quoted")
    };
    let mut found = Mistakes::new(text);
    let only_first = !of_its_own(first.message());
    note(text, &first, &mut found);
    if !only_first {
        for error in all.iter().filter(|error| **error != first) {
            if of_its_own(error.message()) {
                note(text, error, &mut found);
            }
        }
    }
    found.into_result(None)
}

fn note(text: &str, error: &toml::de::Error, found: &mut Mistakes) {
    let span = error.span().unwrap_or(0..0);
    let piece = text.get(span.clone()).unwrap_or("");
    let key = key_at(text, span.start);
    let message = error.message();
    let help = help_for(message, piece);
    found.add(span, key, format!("not valid TOML: {message}"), help);
}

/// What would be right, by what the parser says is wrong.
fn help_for(message: &str, piece: &str) -> String {
    if message.contains("string values must be quoted") {
        if piece.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
            format!(
                "a number stands without unit; text stands in quotes: {}",
                quoted(piece)
            )
        } else {
            format!("write {}", quoted(piece))
        }
    } else if message.contains("duplicate key") {
        "a key stands once in its table: remove one (each task begins with its own `[[task]]`)"
            .to_owned()
    } else if message.contains("unclosed") || message.contains("missing comma") {
        "close what was opened, and put commas between the members of a list".to_owned()
    } else if message.contains("recurs") {
        "nothing in a scenario is nested so deeply".to_owned()
    } else {
        "write lines of the form `key = value` under headers like `[robot]`".to_owned()
    }
}

/// The key of the line in which a mistake of syntax stands, with its table: `control.rate_hz`.
fn key_at(text: &str, byte: usize) -> String {
    let byte = floor_char(text, byte);
    let line_start = text[..byte].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[line_start..].lines().next().unwrap_or("");
    let header = |line: &str| {
        let name = line.trim().strip_prefix('[')?.trim_start_matches('[');
        let name = name.split([']', '#']).next().unwrap_or("").trim();
        is_plain(name).then(|| name.to_owned())
    };
    if let Some(table) = header(line) {
        return table;
    }
    let table = text[..line_start].lines().rev().find_map(header);
    let table = table.map(|name| {
        // Which of the tasks: `task[3]`.
        let count = text[..line_start]
            .lines()
            .filter(|line| line.trim().starts_with("[[") && header(line).as_deref() == Some(&*name))
            .count();
        if count > 0 {
            format!("{name}[{count}]")
        } else {
            name
        }
    });
    let key = line.split(['=', '#']).next().unwrap_or("").trim();
    match table {
        Some(table) if is_plain(key) => format!("{table}.{key}"),
        Some(table) => table,
        None if is_plain(key) => key.to_owned(),
        None => String::new(),
    }
}

/// A bare or dotted key of ordinary length.
fn is_plain(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    !name.is_empty() && name.len() <= 64 && name.chars().all(plain)
}
