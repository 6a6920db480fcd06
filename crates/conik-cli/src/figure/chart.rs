//! A chart over time: frame, axes, curves, and the stretches of time in which something was so.

use super::axis::Axis;
use super::curve::{decimate, within};
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::placement::{Area, Placement};
use super::run::{Run, Span};
use super::svg::{Marks, Picture, Point};

/// Size of the numbers at the ticks [px].
pub const TICK: f64 = 10.5;
/// Size of remarks and axis labels [px].
pub const LABEL: f64 = 11.0;
/// Size of a chart's title [px].
pub const TITLE: f64 = 12.5;

/// The outer measures of a chart [px].
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Width, labels included.
    pub width: f64,
    /// Height, labels included.
    pub height: f64,
    /// From the left edge to the left axis.
    pub left: f64,
    /// Whether the time axis has numbers and a label, or is that of the chart below.
    pub time_labels: bool,
}

impl Layout {
    /// A chart that stands alone.
    pub fn alone(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            left: 58.0,
            time_labels: true,
        }
    }

    /// Between the axes [px].
    fn inner_width(&self) -> f64 {
        (self.width - self.left - 12.0).max(40.0)
    }
}

/// A chart being drawn.
pub struct Chart {
    layout: Layout,
    title: String,
    x_label: &'static str,
    x: Axis,
    y: Axis,
    corner: Point,
    size: Point,
    /// The marks so far.
    pub marks: Marks,
    /// Where there is room for labels.
    pub placement: Placement,
}

impl Chart {
    /// An empty chart of `run` with the value axis `y`.
    pub fn new(layout: Layout, title: &str, y_label: &str, run: &Run, y: Axis) -> Self {
        let (from_s, to_s) = run.period_s();
        let x = Axis::spanning(
            from_s,
            to_s,
            if layout.inner_width() < 260.0 { 4 } else { 7 },
        );
        Self::over(layout, title, (x, "time [s]"), (y, y_label))
    }

    /// An empty chart with these axes and labels.
    pub fn over(
        layout: Layout,
        title: &str,
        (x, x_label): (Axis, &'static str),
        (y, y_label): (Axis, &str),
    ) -> Self {
        let corner = (layout.left, 22.0);
        let below = if layout.time_labels { 36.0 } else { 8.0 };
        let size = (
            layout.inner_width(),
            (layout.height - corner.1 - below).max(20.0),
        );
        let page = Area { at: corner, size };
        let mut chart = Self {
            layout,
            title: title.to_owned(),
            x_label,
            x,
            y,
            corner,
            size,
            marks: Marks::default(),
            placement: Placement::within(page),
        };
        chart.draw_axes(y_label);
        chart
    }

    fn draw_axes(&mut self, y_label: &str) {
        let (left, top) = self.corner;
        let (right, bottom) = (left + self.size.0, top + self.size.1);
        let marks = &mut self.marks;
        let title = lettering::shorten(&self.title, lettering::BOLD * TITLE, self.size.0);
        marks.text(
            (left, top - 7.0),
            &title,
            Lettering::new(TITLE, palette::INK).bold(),
        );
        for (value, label) in self.x.ticks() {
            let x = left + self.size.0 * self.x.fraction(*value);
            marks.line((x, top), (x, bottom), Stroke::solid(palette::GRID, 1.0));
            marks.line(
                (x, bottom),
                (x, bottom + 4.0),
                Stroke::solid(palette::FRAME, 1.0),
            );
            if self.layout.time_labels {
                let style = Lettering::new(TICK, palette::SOFT).anchored("middle");
                marks.text((x, bottom + 15.0), label, style);
            }
        }
        let mut widest: f64 = 0.0;
        for (value, label) in self.y.ticks() {
            let y = bottom - self.size.1 * self.y.fraction(*value);
            marks.line((left, y), (right, y), Stroke::solid(palette::GRID, 1.0));
            marks.line(
                (left - 4.0, y),
                (left, y),
                Stroke::solid(palette::FRAME, 1.0),
            );
            let style = Lettering::new(TICK, palette::SOFT).anchored("end");
            marks.text((left - 7.0, y + 3.7), label, style);
            widest = widest.max(lettering::width(label, TICK));
        }
        if self.layout.time_labels {
            let style = Lettering::new(LABEL, palette::SOFT).anchored("middle");
            let middle = f64::midpoint(left, right);
            marks.text((middle, bottom + 30.0), self.x_label, style);
        }
        if !y_label.is_empty() {
            let x = (left - 7.0 - widest - 8.0).max(11.0);
            let y_label = lettering::shorten(y_label, LABEL, self.size.1 + 16.0);
            let style = Lettering::new(LABEL, palette::SOFT);
            marks.text_upwards((x, f64::midpoint(top, bottom)), &y_label, style);
        }
    }

    /// Where the time `t_s` and the value are.
    pub fn at(&self, t_s: f64, value: f64) -> Point {
        (
            self.corner.0 + self.size.0 * self.x.fraction(t_s),
            self.corner.1 + self.size.1 * (1.0 - self.y.fraction(value)),
        )
    }

    /// The area between the axes.
    pub fn plot(&self) -> Area {
        Area {
            at: self.corner,
            size: self.size,
        }
    }

    /// Tints each span from top to bottom in the colour of its mode.
    pub fn bands(&mut self, run: &Run, spans: &[Span]) {
        for span in spans {
            let from = self.at(span.from_s, 0.0).0;
            let to = self.at(span.to_s, 0.0).0.max(from + 0.6);
            let (top, height) = (self.corner.1, self.size.1);
            let colour = run.modes()[span.mode].colour;
            self.marks
                .rect((from, top), (to - from, height), colour, 0.16);
            self.marks.rect((from, top), (to - from, 4.0), colour, 1.0);
        }
    }

    /// The curve of a column of the log, with the parts within `spans` in their modes' colours.
    pub fn curve(&mut self, run: &Run, values: &[f64], spans: &[Span]) {
        let buckets = self.resolution();
        let points = decimate(run.log().time_s(), values, buckets);
        let places = self.places(&points);
        self.placement.avoid_curve(&places);
        self.marks
            .polyline(&places, Stroke::solid(palette::INK, 1.6));
        if let [(t_s, value)] = points[..] {
            let at = self.at(t_s, value);
            self.dot(at);
        }
        for span in spans {
            let part = within(&points, span.from_s, span.to_s);
            let colour = run.modes()[span.mode].colour;
            let places = self.places(&part);
            self.marks.polyline(&places, Stroke::solid(colour, 2.6));
        }
    }

    /// How many stretches of a curve can be told apart: two for each pixel, so that print is sharp.
    pub fn resolution(&self) -> usize {
        // Chart widths are a few hundred pixels.
        (0..999)
            .take_while(|&n| f64::from(n) < 2.0 * self.size.0)
            .count()
    }

    /// Where points of time and value are.
    pub fn places(&self, points: &[Point]) -> Vec<Point> {
        points
            .iter()
            .map(|&(t_s, value)| self.at(t_s, value))
            .collect()
    }

    /// A dot that stands for a single value.
    pub fn dot(&mut self, at: Point) {
        self.marks
            .circle(at, 3.2, palette::INK, Stroke::solid("#ffffff", 1.0));
    }

    /// A vertical line at `t_s`.
    pub fn instant(&mut self, t_s: f64, stroke: Stroke) -> f64 {
        let (x, _) = self.at(t_s, 0.0);
        let (top, bottom) = (self.corner.1, self.corner.1 + self.size.1);
        self.marks.line((x, top), (x, bottom), stroke);
        x
    }

    /// Height of a mark for the time at `x`: above the frame, or within it below the title.
    pub fn free_height_above(&self, x: f64) -> f64 {
        let title = lettering::BOLD * lettering::width(&self.title, TITLE);
        let top = self.corner.1;
        if x > self.corner.0 + title.min(self.size.0) + 14.0 {
            top - 9.0
        } else {
            top + 11.0
        }
    }

    /// A text at the first free one of `candidates`, if any is free.
    pub fn label(&mut self, candidates: &[(Point, Lettering)], text: &str) {
        if let Some(best) = self.placement.choose(candidates, text) {
            let (at, lettering) = candidates[best];
            self.marks.text(at, text, lettering.rimmed());
        }
    }

    /// The right end of the time axis, where the run ended before its time.
    pub fn early_end(&mut self, run: &Run) {
        let Some(word) = run.early_end() else { return };
        let x = self.instant(run.period_s().1, Stroke::solid(palette::ALARM, 2.0));
        let style = Lettering::new(LABEL, palette::ALARM).anchored("end").bold();
        let (top, height) = (self.corner.1, self.size.1);
        let word = lettering::shorten(&word, LABEL, self.size.0 - 20.0);
        let heights = [14.0, height - 6.0, height / 2.0];
        let candidates = heights.map(|y| ((x - 6.0, top + y), style));
        self.label(&candidates, &word);
    }

    /// The finished chart.
    pub fn finish(mut self, description: &str) -> Picture {
        let (left, top) = self.corner;
        let (right, bottom) = (left + self.size.0, top + self.size.1);
        let frame = [
            (left, top),
            (right, top),
            (right, bottom),
            (left, bottom),
            (left, top),
        ];
        self.marks
            .polyline(&frame, Stroke::solid(palette::FRAME, 1.0));
        Picture {
            width: self.layout.width,
            height: self.layout.height,
            title: description.to_owned(),
            marks: self.marks,
        }
    }
}
