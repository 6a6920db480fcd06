//! Panel: the mode over time, a staircase between the modes that occurred (Fig. 4d-f).

use super::axis::Axis;
use super::chart::{Chart, Layout, TICK};
use super::curve::decimate;
use super::ink::Stroke;
use super::lettering;
use super::run::Run;
use super::svg::{Picture, Point};

/// Height of a row for one mode [px].
const ROW: f64 = 26.0;

/// The panel by itself.
pub fn panel(run: &Run, width: f64) -> Picture {
    chart(
        run,
        Layout {
            width,
            height: natural_height(run) + 28.0,
            left: label_room(run).min(0.4 * width),
            time_labels: true,
        },
    )
}

/// Height at which every mode has a row of its own, time labels not counted [px].
pub fn natural_height(run: &Run) -> f64 {
    let modes = run.modes().len() as f64;
    30.0 + (modes * ROW).clamp(2.5 * ROW, 30.0 * ROW)
}

/// Room that the labels of the modes would like left of the axis [px].
pub fn label_room(run: &Run) -> f64 {
    let widths = labels(run, f64::INFINITY)
        .into_iter()
        .map(|label| lettering::width(&label, TICK));
    widths.fold(40.0, f64::max) + 14.0
}

/// The staircase in a given frame.
pub fn chart(run: &Run, layout: Layout) -> Picture {
    let mut labels = labels(run, layout.left - 12.0);
    let rows = rows(run);
    let dense = (layout.height - 60.0) / (labels.len() as f64) < 11.0;
    if dense {
        // Too many to be read: every other, every third, ... keeps its label.
        let stride = (11.0 * labels.len() as f64 / (layout.height - 60.0).max(11.0)).ceil();
        for (nth, label) in labels.iter_mut().enumerate() {
            if nth as f64 % stride != 0.0 {
                label.clear();
            }
        }
    }
    let mut chart = Chart::new(layout, "active mode", "", run, Axis::listing(labels));
    let stairs = stairs(&chart, run, &rows);
    chart.placement.avoid_curve(&stairs);
    chart.marks.polyline(&stairs, Stroke::solid("#8c959f", 1.0));
    for span in run.drawable_spans() {
        let from = chart.at(span.from_s, rows[span.mode]);
        let to = chart.at(span.to_s, rows[span.mode]);
        let to = (to.0.max(from.0 + 1.0), to.1);
        let colour = run.modes()[span.mode].colour;
        chart
            .marks
            .polyline(&[from, to], Stroke::solid(colour, 3.4));
    }
    chart.early_end(run);
    let title = format!(
        "Active mode over time; {} modes, {} changes",
        run.modes().len(),
        run.spans().len().saturating_sub(1)
    );
    chart.finish(&title)
}

/// The line that joins the modes. Of a flickering run, so many of its steps as can be told apart.
fn stairs(chart: &Chart, run: &Run, rows: &[f64]) -> Vec<Point> {
    if run.flickers() {
        let of_tick: Vec<f64> = run
            .log()
            .active()
            .iter()
            .map(|&id| rows[id as usize])
            .collect();
        return chart.places(&decimate(run.log().time_s(), &of_tick, chart.resolution()));
    }
    run.spans()
        .iter()
        .flat_map(|span| [span.from_s, span.to_s].map(|t_s| chart.at(t_s, rows[span.mode])))
        .collect()
}

/// For each mode of the run its row, counted from the bottom: by number, as far as they have one.
fn rows(run: &Run) -> Vec<f64> {
    let mut rows = vec![0.0; run.modes().len()];
    for (row, mode) in in_order(run).into_iter().enumerate() {
        rows[mode] = row as f64;
    }
    rows
}

fn in_order(run: &Run) -> Vec<usize> {
    let mut order: Vec<usize> = (0..run.modes().len()).collect();
    order.sort_by_key(|&at| (run.modes()[at].number.unwrap_or(u64::MAX), at));
    order
}

fn labels(run: &Run, room: f64) -> Vec<String> {
    in_order(run)
        .into_iter()
        .map(|at| {
            let mode = &run.modes()[at];
            let number = mode
                .number
                .map_or(String::new(), |number| format!("\u{2002}{number}"));
            let names = mode.label();
            let room = room - lettering::width(&number, TICK);
            format!("{}{number}", lettering::shorten(&names, TICK, room))
        })
        .collect()
}
