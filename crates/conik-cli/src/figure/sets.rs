//! Panel: each set-based task over time, with its limits, its forbidden side and the stretches of
//! time in which it was active (Fig. 4g-i, and 4k-l for the field of view).

use conik_sim::joint_limits::LIMIT;
use conik_sim::scenario::{GoalConfig, TaskConfig, TaskKind};

use super::axis::{Axis, range};
use super::chart::{Chart, LABEL, Layout};
use super::grid;
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::quantity;
use super::run::{Run, is_set};
use super::svg::Picture;

/// Where there are more sets than this, those between shapes are drawn that bound.
const MOST_AT_A_GLANCE: usize = 12;

/// The set-based tasks in the paper's order: as in the list, the field of view last. Of the joints'
/// position limits only those that bound, and of many pairs of shapes too.
pub fn tasks(run: &Run) -> Vec<&TaskConfig> {
    let (mut sets, _) = told_apart(run);
    sets.sort_by_key(|task| quantity::is_view(task));
    sets
}

/// What has a chart.
pub fn kind(run: &Run) -> &'static str {
    if pairs_left_out(run) > 0 {
        "set-based task that came to its limit"
    } else {
        "set-based task"
    }
}

/// How many pairs of shapes are left out because they never came to their limit.
pub fn pairs_left_out(run: &Run) -> usize {
    told_apart(run).1
}

/// The sets to be drawn, and how many pairs of shapes are not.
fn told_apart(run: &Run) -> (Vec<&TaskConfig>, usize) {
    let bound = |task: &TaskConfig| {
        let mut modes = run.modes().iter().flat_map(|mode| &mode.active);
        modes.any(|set| *set == task.name)
    };
    let sets = run.tasks().iter().filter(|task| is_set(task));
    let mut sets: Vec<&TaskConfig> = sets
        .filter(|task| !task.name.starts_with(LIMIT) || bound(task))
        .collect();
    let all = sets.len();
    if all > MOST_AT_A_GLANCE {
        sets.retain(|task| !matches!(task.kind, TaskKind::Shapes(_)) || bound(task));
    }
    let left_out = all - sets.len();
    (sets, left_out)
}

/// The charts of all sets in one picture.
pub fn panel(run: &Run, width: f64) -> Picture {
    let sets = tasks(run);
    let shape = grid::Shape::of(sets.len(), width);
    let charts: Vec<Picture> = sets
        .into_iter()
        .map(|task| chart(run, task, shape.cell()))
        .collect();
    grid::arrange(&charts, shape, kind(run))
}

/// The chart of one set-based task.
pub fn chart(run: &Run, task: &TaskConfig, layout: Layout) -> Picture {
    let (min, max) = limits(task);
    let values = run.value(&task.name).unwrap_or_default();
    let (low, high) = range(values.iter().copied());
    let (low, high) = range([low, high].into_iter().chain(min).chain(max));
    let ticks = if layout.height < 130.0 { 3 } else { 5 };
    let axis = Axis::around(low, high, ticks);
    let label = quantity::value_label(run, task);
    let spans = run.active_spans(&task.name);
    let mut chart = Chart::new(layout, &task.name, &label, run, axis);
    shade(&mut chart, min, max);
    chart.bands(run, &spans);
    chart.curve(run, values, &spans);
    if values.is_empty() {
        let plot = chart.plot();
        let middle = (plot.at.0 + plot.size.0 / 2.0, plot.at.1 + plot.size.1 / 2.0);
        let style = Lettering::new(LABEL, palette::SOFT).anchored("middle");
        chart.marks.text(middle, "not in the log", style);
    }
    limit_line(&mut chart, run, "min", min, 13.0, -5.0);
    limit_line(&mut chart, run, "max", max, -5.0, 13.0);
    entry(&mut chart, run, task, values);
    chart.finish(&format!("{}: {label} over time with its limits", task.name))
}

fn limits(task: &TaskConfig) -> (Option<f64>, Option<f64>) {
    match task.goal {
        GoalConfig::Set { min, max, .. } => (min, max),
        _ => (None, None),
    }
}

fn shade(chart: &mut Chart, min: Option<f64>, max: Option<f64>) {
    let plot = chart.plot();
    let bottom = plot.at.1 + plot.size.1;
    if let Some(min) = min {
        let y = chart.at(0.0, min).1;
        chart
            .marks
            .rect((plot.at.0, y), (plot.size.0, bottom - y), "#8c959f", 0.2);
    }
    if let Some(max) = max {
        let y = chart.at(0.0, max).1;
        chart
            .marks
            .rect(plot.at, (plot.size.0, y - plot.at.1), "#8c959f", 0.2);
    }
}

/// The dashed line of a limit, its label on the forbidden side if there is room.
fn limit_line(chart: &mut Chart, run: &Run, word: &str, limit: Option<f64>, away: f64, back: f64) {
    let Some(limit) = limit else { return };
    let (from_s, to_s) = run.period_s();
    let (from, to) = (chart.at(from_s, limit), chart.at(to_s, limit));
    chart
        .marks
        .line(from, to, Stroke::dashed(palette::LIMIT, 1.4, "6 4"));
    let style = Lettering::new(LABEL, palette::LIMIT);
    let mut candidates = Vec::new();
    for offset in [away, back] {
        let y = from.1 + offset;
        candidates.push(((to.0 - 6.0, y), style.anchored("end")));
        candidates.push(((from.0 + 6.0, y), style));
        for part in [0.75, 0.5, 0.25] {
            let x = from.0 + part * (to.0 - from.0);
            candidates.push(((x, y), style.anchored("middle")));
        }
    }
    chart.label(
        &candidates,
        &format!("{word} {}", lettering::number(limit, 4)),
    );
}

/// Marks when the set was first entered, unless the run began inside it.
fn entry(chart: &mut Chart, run: &Run, task: &TaskConfig, values: &[f64]) {
    let summary = run.summary().tasks.get(&task.name);
    let Some(t_s) = summary.and_then(|task| task.entered_set_s) else {
        return;
    };
    let (begin, _) = run.period_s();
    let row = run.log().time_s().partition_point(|&time| time < t_s);
    let Some(&value) = values.get(row) else {
        return;
    };
    if t_s <= begin || !value.is_finite() {
        return;
    }
    let at = chart.at(t_s, value);
    chart
        .marks
        .circle(at, 3.6, "#ffffff", Stroke::solid(palette::INK, 1.6));
    let style = Lettering::new(LABEL, palette::INK);
    let candidates = [
        ((at.0 + 8.0, at.1 - 6.0), style),
        ((at.0 + 8.0, at.1 + 14.0), style),
        ((at.0 - 8.0, at.1 + 14.0), style.anchored("end")),
        ((at.0 - 8.0, at.1 - 6.0), style.anchored("end")),
        ((at.0 + 8.0, at.1 - 24.0), style),
        ((at.0 + 8.0, at.1 + 30.0), style),
    ];
    chart.label(&candidates, &format!("entered {}", lettering::seconds(t_s)));
}
