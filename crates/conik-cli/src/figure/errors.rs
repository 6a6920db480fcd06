//! Panel: the norm of each equality task's error over time, with the arrivals at the waypoints
//! (Fig. 4j for the field of view).

use conik_sim::scenario::{GoalConfig, TaskConfig};

use super::axis::{Axis, range};
use super::chart::{Chart, LABEL, Layout};
use super::grid;
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::quantity;
use super::run::{Run, is_set};
use super::svg::Picture;

/// The equality tasks in the paper's order: as in the list, the field of view last.
pub fn tasks(run: &Run) -> Vec<&TaskConfig> {
    let mut tasks: Vec<&TaskConfig> = run.tasks().iter().filter(|task| !is_set(task)).collect();
    tasks.sort_by_key(|task| quantity::is_view(task));
    tasks
}

/// The charts of all equality tasks in one picture.
pub fn panel(run: &Run, width: f64) -> Picture {
    let tasks = tasks(run);
    let shape = grid::Shape::of(tasks.len(), width);
    let charts: Vec<Picture> = tasks
        .into_iter()
        .map(|task| chart(run, task, shape.cell()))
        .collect();
    grid::arrange(&charts, shape, "equality task")
}

/// The chart of one equality task.
pub fn chart(run: &Run, task: &TaskConfig, layout: Layout) -> Picture {
    let values = run.error(&task.name).unwrap_or_default();
    let axis = axis_for(values, layout);
    let mut label = quantity::error_label(run, task);
    if axis.is_logarithmic() {
        label = label.replace("norm", "norm, log.");
    }
    let has_waypoints = matches!(task.goal, GoalConfig::Waypoints { .. });
    let mut chart = Chart::new(layout, &task.name, &label, run, axis);
    chart.curve(run, values, &[]);
    // Of a pose the error is in two units, and neither acceptance is a limit of it.
    if let GoalConfig::Waypoints {
        acceptance_m,
        acceptance_rad,
        ..
    } = task.goal
        && let (Some(one), None) | (None, Some(one)) = (acceptance_m, acceptance_rad)
    {
        acceptance(&mut chart, run, one);
    }
    if has_waypoints {
        arrivals(&mut chart, run);
    }
    chart.finish(&format!("{}: {label} over time", task.name))
}

/// Logarithmic if the error falls so far that a linear axis would show most of the run as zero.
fn axis_for(values: &[f64], layout: Layout) -> Axis {
    let ticks = if layout.height < 130.0 { 3 } else { 5 };
    let mut positive: Vec<f64> = values
        .iter()
        .copied()
        .filter(|v| v.is_finite() && *v > 0.0)
        .collect();
    let (_, high) = range(values.iter().copied());
    let rank = positive.len() / 5;
    if positive.len() < 10 {
        return Axis::around(0.0, high, ticks);
    }
    let (_, fifth, _) = positive.select_nth_unstable_by(rank, f64::total_cmp);
    if *fifth < high / 300.0 {
        let (low, _) = range(positive.iter().copied());
        Axis::decades(low, high, ticks)
    } else {
        Axis::around(0.0, high, ticks)
    }
}

/// The error at which the next waypoint is taken.
fn acceptance(chart: &mut Chart, run: &Run, error: f64) {
    let (from_s, to_s) = run.period_s();
    let (from, to) = (chart.at(from_s, error), chart.at(to_s, error));
    chart
        .marks
        .line(from, to, Stroke::dashed(palette::LIMIT, 1.2, "2 3"));
    let style = Lettering::new(LABEL, palette::LIMIT);
    let mut candidates = Vec::new();
    for y in [from.1 - 5.0, from.1 + 13.0] {
        candidates.push(((to.0 - 6.0, y), style.anchored("end")));
        candidates.push(((from.0 + 6.0, y), style));
        candidates.push(((f64::midpoint(from.0, to.0), y), style.anchored("middle")));
    }
    chart.label(
        &candidates,
        &format!("accepted below {}", lettering::number(error, 3)),
    );
}

/// A line with the waypoint's number at each arrival.
fn arrivals(chart: &mut Chart, run: &Run) {
    let mut last = f64::NEG_INFINITY;
    for (nth, t_s) in run.summary().waypoints_reached_s.iter().enumerate() {
        let Some(t_s) = *t_s else { continue };
        let x = chart.instant(t_s, Stroke::dashed(palette::SOFT, 1.0, "3 3"));
        // The numbers of waypoints that follow each other closely would cover each other.
        if x - last < 15.0 {
            continue;
        }
        last = x;
        let at = (x, chart.free_height_above(x));
        let style = Lettering::new(9.0, "#ffffff").anchored("middle").bold();
        chart
            .marks
            .circle(at, 6.5, palette::INK, Stroke::solid("#ffffff", 1.0));
        chart
            .marks
            .text((at.0, at.1 + 3.2), &(nth + 1).to_string(), style);
    }
}
