//! Cuts a program's text into words, numbers, texts and symbols.

use super::error::{Fault, ScriptError};
use std::fmt;

/// One piece of a program.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// A name or a keyword.
    Word(String),
    Integer(i32),
    Float(f64),
    Text(String),
    /// An operator, a bracket or a comma; `p[` opens a pose.
    Symbol(&'static str),
    /// The end of a line, outside of brackets.
    LineEnd,
    /// The end of the text.
    End,
}

/// Longer ones stand before their beginnings.
const SYMBOLS: [&str; 21] = [
    "==", "!=", "<=", ">=", "(", ")", "[", "]", "+", "-", "*", "/", "%", "<", ">", "=", ",", ":",
    "{", "}", ".",
];

impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => write!(f, "'{word}'"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Float(value) => write!(f, "{value:?}"),
            Self::Text(text) => write!(f, "\"{text}\""),
            Self::Symbol(symbol) => write!(f, "'{symbol}'"),
            Self::LineEnd => f.write_str("the end of the line"),
            Self::End => f.write_str("the end of the program"),
        }
    }
}

/// The tokens of a text, each with the number of its line; [`Token::End`] is the last.
pub(super) fn tokens(text: &str) -> Result<Vec<(Token, u32)>, ScriptError> {
    let mut tokens = Vec::new();
    let (mut line, mut open_brackets) = (1_u32, 0_u32);
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        match next {
            '\n' => {
                if open_brackets == 0 {
                    tokens.push((Token::LineEnd, line));
                }
                line = line.saturating_add(1);
                rest = &rest[1..];
                continue;
            }
            // A comment, or a label by which the pendant shows where a program is.
            '#' | '$' => {
                rest = &rest[rest.find('\n').unwrap_or(rest.len())..];
                continue;
            }
            _ if next.is_whitespace() => {
                rest = &rest[next.len_utf8()..];
                continue;
            }
            _ => {}
        }
        let (token, length) = token(rest).map_err(|fault| fault.at(line))?;
        match token {
            Token::Symbol("(" | "[" | "p[") => open_brackets += 1,
            Token::Symbol(")" | "]") => open_brackets = open_brackets.saturating_sub(1),
            _ => {}
        }
        tokens.push((token, line));
        rest = &rest[length..];
    }
    tokens.push((Token::LineEnd, line));
    tokens.push((Token::End, line));
    Ok(tokens)
}

/// The token at the beginning of `rest`, and its length in bytes.
fn token(rest: &str) -> Result<(Token, usize), Fault> {
    let first = rest.chars().next().unwrap_or(' ');
    if first.is_ascii_digit() || (first == '.' && followed_by_digit(rest)) {
        return number(rest);
    }
    if first.is_ascii_alphabetic() || first == '_' {
        let length = length_while(rest, |c| c.is_ascii_alphanumeric() || c == '_');
        if &rest[..length] == "p" && rest[length..].starts_with('[') {
            return Ok((Token::Symbol("p["), 2));
        }
        return Ok((Token::Word(rest[..length].to_owned()), length));
    }
    if first == '"' {
        let inside = rest[1..].lines().next().unwrap_or_default();
        let length = inside.find('"').ok_or(Fault::OpenText)?;
        return Ok((Token::Text(inside[..length].to_owned()), length + 2));
    }
    let symbol = SYMBOLS.into_iter().find(|symbol| rest.starts_with(symbol));
    let symbol = symbol.ok_or(Fault::Character(first))?;
    Ok((Token::Symbol(symbol), symbol.len()))
}

fn followed_by_digit(rest: &str) -> bool {
    rest[1..].starts_with(|c: char| c.is_ascii_digit())
}

fn length_while(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

/// Digits, a point, digits, an exponent; without point and exponent it is an integer.
fn number(rest: &str) -> Result<(Token, usize), Fault> {
    let digits = |from: usize| from + length_while(&rest[from..], |c| c.is_ascii_digit());
    let mut end = digits(0);
    let mut is_integer = true;
    if rest[end..].starts_with('.') {
        is_integer = false;
        end = digits(end + 1);
    }
    if rest[end..].starts_with(['e', 'E']) {
        let sign = usize::from(rest[end + 1..].starts_with(['+', '-']));
        let exponent_end = digits(end + 1 + sign);
        if exponent_end > end + 1 + sign {
            (is_integer, end) = (false, exponent_end);
        }
    }
    let written = &rest[..end];
    let bad = || Fault::Number(written.to_owned());
    let token = if is_integer {
        Token::Integer(written.parse().map_err(|_| bad())?)
    } else {
        let value: f64 = written.parse().map_err(|_| bad())?;
        Token::Float(
            Some(value)
                .filter(|value| value.is_finite())
                .ok_or_else(bad)?,
        )
    };
    Ok((token, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<Token> {
        let tokens = tokens(text).unwrap();
        tokens.into_iter().map(|(token, _)| token).collect()
    }

    #[test]
    fn numbers_names_texts_and_symbols_come_apart() {
        let word = |word: &str| Token::Word(word.to_owned());
        assert_eq!(
            read("x1=p[.5,2e-3]<=10 # \"no\"\n\"a # b\""),
            [
                word("x1"),
                Token::Symbol("="),
                Token::Symbol("p["),
                Token::Float(0.5),
                Token::Symbol(","),
                Token::Float(0.002),
                Token::Symbol("]"),
                Token::Symbol("<="),
                Token::Integer(10),
                Token::LineEnd,
                Token::Text("a # b".to_owned()),
                Token::LineEnd,
                Token::End,
            ]
        );
    }

    #[test]
    fn lines_go_on_inside_of_brackets_and_are_counted_there() {
        let tokens = tokens("a = [1,\n 2]\nb").unwrap();
        assert_eq!(
            tokens
                .iter()
                .filter(|(token, _)| *token == Token::LineEnd)
                .count(),
            2
        );
        assert!(tokens.contains(&(Token::Word("b".to_owned()), 3)));
    }

    #[test]
    fn what_is_no_word_is_refused_with_its_line() {
        for (text, fault) in [
            ("\n?", Fault::Character('?')),
            ("\n\"open\n\"", Fault::OpenText),
            ("\n1e999", Fault::Number("1e999".to_owned())),
            ("\n2147483648", Fault::Number("2147483648".to_owned())),
        ] {
            assert_eq!(tokens(text), Err(fault.at(2)), "{text:?}");
        }
    }
}
