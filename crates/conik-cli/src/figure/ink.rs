//! How marks look: the stroke of a line, the lettering of a text.

use std::fmt::{self, Display};

use super::markup::Decimal;

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Stroke<'a> {
    /// Colour.
    pub colour: &'a str,
    /// Width [px].
    pub width: f64,
    /// Lengths of dashes and gaps [px]; empty for a continuous line.
    pub dashes: &'a str,
}

impl<'a> Stroke<'a> {
    /// A continuous line.
    pub fn solid(colour: &'a str, width: f64) -> Self {
        Self {
            colour,
            width,
            dashes: "",
        }
    }

    /// A dashed line.
    pub fn dashed(colour: &'a str, width: f64, dashes: &'a str) -> Self {
        Self {
            colour,
            width,
            dashes,
        }
    }
}

impl Display for Stroke<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = Decimal(self.width);
        write!(f, "stroke=\"{}\" stroke-width=\"{width}\"", self.colour)?;
        if !self.dashes.is_empty() {
            write!(f, " stroke-dasharray=\"{}\"", self.dashes)?;
        }
        Ok(())
    }
}

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub struct Lettering<'a> {
    /// Size [px].
    pub size: f64,
    /// Colour.
    pub colour: &'a str,
    /// `start`, `middle` or `end`: which part of the text stands at the place.
    pub anchor: &'static str,
    /// Whether it is bold.
    pub bold: bool,
    /// Whether a white rim keeps it readable over lines.
    pub rim: bool,
}

impl<'a> Lettering<'a> {
    /// Plain text that starts at its place.
    pub fn new(size: f64, colour: &'a str) -> Self {
        Self {
            size,
            colour,
            anchor: "start",
            bold: false,
            rim: false,
        }
    }

    /// The same, anchored elsewhere.
    #[must_use]
    pub fn anchored(self, anchor: &'static str) -> Self {
        Self { anchor, ..self }
    }

    /// The same in bold.
    #[must_use]
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same with a white rim.
    #[must_use]
    pub fn rimmed(self) -> Self {
        Self { rim: true, ..self }
    }
}
