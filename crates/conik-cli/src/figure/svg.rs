//! Writes SVG: the few marks that the figures are made of, as text with the same bytes every time.
//!
//! The `plotters` crate would draw the charts, but its SVG backend places every point on a whole
//! pixel: a slow curve becomes a staircase as soon as the picture is enlarged or printed, and the
//! path in three dimensions, with spheres that shade, is not a chart. The marks needed are few.

use std::fmt::{self, Write};

use super::ink::{Lettering, Stroke};
use super::markup::{Decimal, Escaped, Opacity};

/// A place in a picture [px], x to the right and y down.
pub type Point = (f64, f64);

/// The typefaces asked for; none is embedded, text stays text.
const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// A finished picture: it stands alone, in a page, or as a panel of another picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width [px].
    pub width: f64,
    /// Height [px].
    pub height: f64,
    /// What it shows, in a sentence, for those who do not see it.
    pub title: String,
    /// The marks.
    pub marks: Marks,
}

impl Picture {
    /// The picture as an SVG file.
    pub fn to_file(&self) -> String {
        let mut svg = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        svg.push_str(&self.to_inline("xmlns=\"http://www.w3.org/2000/svg\" ", true));
        svg.push('\n');
        svg
    }

    /// The picture as an element of a page. The page is the paper, so no background is drawn.
    pub fn to_html(&self) -> String {
        self.to_inline("", false)
    }

    fn to_inline(&self, namespace: &str, background: bool) -> String {
        let (width, height) = (Decimal(self.width), Decimal(self.height));
        let title = Escaped(&self.title);
        let paper = if background {
            format!("<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n")
        } else {
            String::new()
        };
        format!(
            "<svg {namespace}viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             role=\"img\" aria-label=\"{title}\" font-family=\"{FONT}\">\n<title>{title}</title>\n\
             {paper}{}</svg>",
            self.marks.0
        )
    }
}

/// Marks, the later ones over the earlier ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks(String);

impl Marks {
    /// A straight line.
    pub fn line(&mut self, from: Point, to: Point, stroke: Stroke) {
        self.put(format_args!(
            "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {stroke}/>",
            Decimal(from.0),
            Decimal(from.1),
            Decimal(to.0),
            Decimal(to.1)
        ));
    }

    /// A line through points, interrupted where a point is not finite.
    pub fn polyline(&mut self, points: &[Point], stroke: Stroke) {
        let mut path = String::new();
        let mut pen_down = false;
        for &(x, y) in points {
            if x.is_finite() && y.is_finite() {
                let command = if pen_down { 'L' } else { 'M' };
                let _ = write!(path, "{command}{} {}", Decimal(x), Decimal(y));
                pen_down = true;
            } else {
                pen_down = false;
            }
        }
        if !path.is_empty() {
            self.put(format_args!(
                "<path d=\"{path}\" fill=\"none\" {stroke} stroke-linejoin=\"round\" \
                 stroke-linecap=\"{}\"/>",
                if stroke.dashes.is_empty() {
                    "round"
                } else {
                    "butt"
                }
            ));
        }
    }

    /// A filled polygon.
    pub fn polygon(&mut self, points: &[Point], fill: &str, opacity: f64) {
        let mut list = String::new();
        for &(x, y) in points {
            let _ = write!(list, "{},{} ", Decimal(x), Decimal(y));
        }
        self.put(format_args!(
            "<polygon points=\"{}\" fill=\"{fill}\"{}/>",
            list.trim_end(),
            Opacity(opacity)
        ));
    }

    /// A filled rectangle, from its upper left corner.
    pub fn rect(&mut self, at: Point, size: Point, fill: &str, opacity: f64) {
        self.put(format_args!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{fill}\"{}/>",
            Decimal(at.0),
            Decimal(at.1),
            Decimal(size.0.max(0.0)),
            Decimal(size.1.max(0.0)),
            Opacity(opacity)
        ));
    }

    /// A circle, filled (or not: `none`) and outlined.
    pub fn circle(&mut self, centre: Point, radius: f64, fill: &str, outline: Stroke) {
        self.put(format_args!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\" {outline}/>",
            Decimal(centre.0),
            Decimal(centre.1),
            Decimal(radius)
        ));
    }

    /// A translucent circle with an outline.
    pub fn disc(&mut self, centre: Point, radius: f64, fill: &str, opacity: f64, outline: Stroke) {
        self.put(format_args!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\"{} {outline}/>",
            Decimal(centre.0),
            Decimal(centre.1),
            Decimal(radius),
            Opacity(opacity)
        ));
    }

    /// A translucent ellipse with an outline, its half axes turned by an angle [degrees].
    pub fn ellipse(
        &mut self,
        centre: Point,
        half_axes: Point,
        turn: f64,
        fill: &str,
        opacity: f64,
        outline: Stroke,
    ) {
        self.put(format_args!(
            "<ellipse rx=\"{}\" ry=\"{}\" transform=\"translate({} {})rotate({})\" fill=\"{fill}\"{} \
             {outline}/>",
            Decimal(half_axes.0),
            Decimal(half_axes.1),
            Decimal(centre.0),
            Decimal(centre.1),
            Decimal(turn),
            Opacity(opacity)
        ));
    }

    /// A translucent polygon with an outline.
    pub fn face(&mut self, points: &[Point], fill: &str, opacity: f64, outline: Stroke) {
        let mut path = String::new();
        for &(x, y) in points {
            let command = if path.is_empty() { 'M' } else { 'L' };
            let _ = write!(path, "{command}{} {}", Decimal(x), Decimal(y));
        }
        self.put(format_args!(
            "<path d=\"{path}Z\" fill=\"{fill}\"{} {outline} stroke-linejoin=\"round\"/>",
            Opacity(opacity)
        ));
    }

    /// A path given as SVG writes it, in axes that begin at a place and are turned [degrees].
    pub fn turned(
        &mut self,
        path: &str,
        at: Point,
        turn: f64,
        fill: &str,
        opacity: f64,
        outline: Stroke,
    ) {
        self.put(format_args!(
            "<path d=\"{path}\" transform=\"translate({} {})rotate({})\" fill=\"{fill}\"{} {outline}/>",
            Decimal(at.0),
            Decimal(at.1),
            Decimal(turn),
            Opacity(opacity)
        ));
    }

    /// The marks to come, as one sheet of that opacity, up to [`close_sheet`](Self::close_sheet).
    pub fn open_sheet(&mut self, opacity: f64) {
        self.put(format_args!("<g opacity=\"{}\">", Decimal(opacity)));
    }

    /// Ends what [`open_sheet`](Self::open_sheet) began.
    pub fn close_sheet(&mut self) {
        self.put(format_args!("</g>"));
    }

    /// A line of text whose baseline is at `at`.
    pub fn text(&mut self, at: Point, text: &str, lettering: Lettering) {
        self.set_text(at, text, lettering, "");
    }

    /// A line of text that reads upwards, centred at `at`.
    pub fn text_upwards(&mut self, at: Point, text: &str, lettering: Lettering) {
        let turn = format!(
            " transform=\"rotate(-90 {} {})\"",
            Decimal(at.0),
            Decimal(at.1)
        );
        self.set_text(at, text, lettering.anchored("middle"), &turn);
    }

    fn set_text(&mut self, at: Point, text: &str, lettering: Lettering, extra: &str) {
        let bold = if lettering.bold {
            " font-weight=\"bold\""
        } else {
            ""
        };
        let rim = if lettering.rim {
            " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\""
        } else {
            ""
        };
        self.put(format_args!(
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\"{bold}{rim}{extra}>{}</text>",
            Decimal(at.0),
            Decimal(at.1),
            Decimal(lettering.size),
            lettering.colour,
            lettering.anchor,
            Escaped(text)
        ));
    }

    /// Another picture as a part of this one, its upper left corner at `at`.
    pub fn place(&mut self, at: Point, picture: &Picture) {
        self.put(format_args!(
            "<g transform=\"translate({} {})\">\n{}</g>",
            Decimal(at.0),
            Decimal(at.1),
            picture.marks.0
        ));
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Further marks, over these.
    pub fn append(&mut self, further: &Self) {
        self.0.push_str(&further.0);
    }

    /// Marks written elsewhere, as they are.
    pub fn raw(&mut self, svg: &str) {
        self.put(format_args!("{svg}"));
    }

    fn put(&mut self, mark: fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{mark}");
    }
}
