//! Colours on a terminal: those of the figures, as well as the terminal has them, or none.

use std::env;

use ratatui_core::style::{Color, Modifier, Style};

use super::standing::State;
use crate::figure::palette;

/// What colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    None,
    /// The 256 that nearly every terminal has.
    Indexed,
    Full,
}

/// Colours of the figures, and those of the 256 that are nearest to them.
const NEAREST: [(&str, u8); 6] = [
    ("#D55E00", 166),
    ("#0072B2", 32),
    ("#009E73", 36),
    ("#CC79A7", 175),
    ("#E69F00", 178),
    ("#56B4E9", 74),
];
/// The nearest to every other one, which are greys.
const GREY: u8 = 245;

impl Ink {
    /// What the terminal has, by its environment. Any `NO_COLOR` that is not empty: none.
    pub(super) fn of_environment() -> Self {
        let of = |name| env::var(name).unwrap_or_default();
        Self::of(&of("NO_COLOR"), &of("COLORTERM"))
    }

    fn of(no_color: &str, color_term: &str) -> Self {
        match color_term {
            _ if !no_color.is_empty() => Self::None,
            "truecolor" | "24bit" => Self::Full,
            _ => Self::Indexed,
        }
    }

    fn colour(self, hex: &str) -> Option<Color> {
        let nearest = NEAREST.iter().find(|(other, _)| *other == hex);
        match self {
            Self::None => None,
            Self::Indexed => Some(Color::Indexed(nearest.map_or(GREY, |(_, index)| *index))),
            Self::Full => {
                let part = |at| u8::from_str_radix(hex.get(at..at + 2)?, 16).ok();
                Some(Color::Rgb(part(1)?, part(3)?, part(5)?))
            }
        }
    }

    /// Letters in a colour of the figures.
    pub(super) fn letters(self, hex: &str) -> Style {
        self.colour(hex)
            .map_or(Style::new(), |colour| Style::new().fg(colour))
    }

    /// Dark letters on a mode's colour; `None`: the mode without an active set.
    pub(super) fn mode(self, nth: Option<usize>) -> Style {
        let Some(nth) = nth else {
            return Style::new().add_modifier(Modifier::DIM);
        };
        self.colour(palette::mode(nth))
            .map_or(Style::new(), |colour| {
                Style::new().fg(Color::Black).bg(colour)
            })
    }

    /// How a task stands.
    pub(super) fn state(self, state: State) -> Style {
        let style = |hex| self.letters(hex);
        match state {
            State::Held => style("#E69F00").add_modifier(Modifier::BOLD),
            State::Driven => style("#CC79A7").add_modifier(Modifier::BOLD),
            State::Outside => style("#D55E00").add_modifier(Modifier::BOLD),
            State::Inside => style("#009E73"),
            State::Equality => style("#56B4E9"),
        }
    }

    /// What ended badly.
    pub(super) fn alarm(self) -> Style {
        self.letters("#D55E00").add_modifier(Modifier::BOLD)
    }
}

/// What matters less.
pub(super) fn soft() -> Style {
    Style::new().add_modifier(Modifier::DIM)
}

/// What matters more.
pub(super) fn bold() -> Style {
    Style::new().add_modifier(Modifier::BOLD)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_color_leaves_no_colour_and_else_the_terminal_says_which() {
        assert_eq!(Ink::of("1", "truecolor"), Ink::None);
        assert_eq!(Ink::of("", "truecolor"), Ink::Full);
        assert_eq!(Ink::of("", ""), Ink::Indexed);
        assert_eq!(Ink::None.mode(Some(0)).bg, None);
        assert_eq!(
            Ink::Full.mode(Some(0)).bg,
            Some(Color::Rgb(0xd5, 0x5e, 0x00))
        );
    }

    #[test]
    fn every_mode_of_the_figures_has_a_colour_of_its_own() {
        let colours: Vec<_> = (0..6).map(|nth| Ink::Indexed.mode(Some(nth)).bg).collect();
        for (nth, colour) in colours.iter().enumerate() {
            assert!(!colours[..nth].contains(colour), "mode {nth}");
        }
    }
}
