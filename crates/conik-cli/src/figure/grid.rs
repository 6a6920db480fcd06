//! Many charts in one picture, side by side and below each other.

use super::chart::{LABEL, Layout};
use super::ink::Lettering;
use super::palette;
use super::svg::{Marks, Picture};

/// How charts are arranged in a picture.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    width: f64,
    columns: usize,
    cell: Layout,
}

impl Shape {
    /// The arrangement of `count` charts in a picture of that width: few of them large, many small.
    pub fn of(count: usize, width: f64) -> Self {
        let (columns, height) = match count {
            0..=1 => (1, 220.0),
            2..=6 => (2, 200.0),
            7..=18 => (3, 160.0),
            _ => (4, 140.0),
        };
        Self {
            width,
            columns,
            cell: Layout::alone(width / columns as f64, height),
        }
    }

    /// The layout of one chart.
    pub fn cell(&self) -> Layout {
        self.cell
    }
}

/// Puts the charts in rows. Without any, the picture says that there is no `kind`.
pub fn arrange(charts: &[Picture], shape: Shape, kind: &str) -> Picture {
    if charts.is_empty() {
        return nothing(shape.width, kind);
    }
    let rows = charts.len().div_ceil(shape.columns);
    let titles: Vec<&str> = charts.iter().map(|chart| chart.title.as_str()).collect();
    let title = if charts.len() <= 6 {
        titles.join("; ")
    } else {
        format!("{} charts, each a {kind} over time", charts.len())
    };
    let mut marks = Marks::default();
    for (nth, chart) in charts.iter().enumerate() {
        let column = (nth % shape.columns) as f64;
        let row = (nth / shape.columns) as f64;
        marks.place((column * shape.cell.width, row * shape.cell.height), chart);
    }
    Picture {
        width: shape.width,
        height: rows as f64 * shape.cell.height,
        title,
        marks,
    }
}

fn nothing(width: f64, kind: &str) -> Picture {
    let title = format!("This run has no {kind}");
    let mut marks = Marks::default();
    let style = Lettering::new(LABEL, palette::SOFT).anchored("middle");
    marks.text((width / 2.0, 34.0), &title, style);
    Picture {
        width,
        height: 60.0,
        title,
        marks,
    }
}
