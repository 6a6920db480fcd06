//! The paper's Figure 4 for one run, in one picture: the path, and beside it, over one time axis,
//! the mode, the sets, and the field of view last.

use conik_sim::scenario::TaskConfig;

use super::chart::{Layout, TITLE};
use super::ink::Lettering;
use super::palette;
use super::quantity;
use super::run::{Run, is_set};
use super::svg::{Marks, Picture};
use super::{errors, lettering, mode, path, sets};

const WIDTH: f64 = 920.0;
/// The column of the path.
const LEFT: f64 = 430.0;
/// More charts than this are not stacked but laid out in rows below.
const MOST_STACKED: usize = 5;
/// Height of a chart in the stack [px], its time labels not counted.
const CHART: f64 = 128.0;
/// What time labels add to a chart's height [px].
const TIME_LABELS: f64 = 28.0;

/// The whole figure.
pub fn picture(run: &Run) -> Picture {
    let mut marks = Marks::default();
    let top = heading(run, &mut marks);
    let height = if sets::tasks(run).len() <= MOST_STACKED && errors::tasks(run).len() <= 3 {
        stacked(run, &mut marks, top)
    } else {
        tabled(run, &mut marks, top)
    };
    Picture {
        width: WIDTH,
        height,
        title: format!(
            "{}: path of the tool, active mode, set-based tasks and errors",
            run.title()
        ),
        marks,
    }
}

fn heading(run: &Run, marks: &mut Marks) -> f64 {
    let title = lettering::shorten(run.title(), lettering::BOLD * 15.0, WIDTH - 40.0);
    marks.text(
        (14.0, 24.0),
        &title,
        Lettering::new(15.0, palette::INK).bold(),
    );
    let Some(word) = run.early_end() else {
        return 36.0;
    };
    let word = format!("{word} at {}", lettering::seconds(run.summary().ended_at_s));
    let word = lettering::shorten(&word, lettering::BOLD * 13.0, WIDTH - 40.0);
    marks.text(
        (14.0, 44.0),
        &word,
        Lettering::new(13.0, palette::ALARM).bold(),
    );
    56.0
}

/// Path and equality tasks on the left; mode, sets and the view on the right.
fn stacked(run: &Run, marks: &mut Marks, top: f64) -> f64 {
    let equalities = errors::tasks(run);
    let (views, others): (Vec<&TaskConfig>, Vec<&TaskConfig>) = equalities
        .into_iter()
        .partition(|task| quantity::is_view(task));
    let mut right = sets::tasks(run);
    right.extend(views);
    let mode_height = mode::natural_height(run);
    let right_height = mode_height + right.len() as f64 * CHART + TIME_LABELS;
    let left_height = LEFT + others.len() as f64 * (CHART + TIME_LABELS);
    let height = right_height.max(left_height);

    let path_height = height - others.len() as f64 * (CHART + TIME_LABELS);
    let path_height = path_height.min(1.25 * LEFT);
    titled(
        marks,
        (0.0, top),
        "tool path",
        &path::panel(run, LEFT, path_height - 20.0),
    );
    let spare = height - path_height;
    for (nth, task) in others.iter().enumerate() {
        let each = spare / others.len() as f64;
        let layout = Layout::alone(LEFT, each.min(1.6 * CHART));
        let chart = errors::chart(run, task, layout);
        marks.place((0.0, top + path_height + nth as f64 * each), &chart);
    }

    let each = if right.is_empty() {
        0.0
    } else {
        (height - mode_height - TIME_LABELS) / right.len() as f64
    };
    let left = mode::label_room(run).clamp(64.0, 150.0);
    let mut y = top;
    let layout = |height: f64, time_labels: bool| Layout {
        width: WIDTH - LEFT - 10.0,
        height: if time_labels {
            height + TIME_LABELS
        } else {
            height
        },
        left,
        time_labels,
    };
    marks.place(
        (LEFT + 10.0, y),
        &mode::chart(run, layout(mode_height, right.is_empty())),
    );
    y += mode_height;
    for (nth, task) in right.iter().enumerate() {
        let layout = layout(each, nth + 1 == right.len());
        let chart = if is_set(task) {
            sets::chart(run, task, layout)
        } else {
            errors::chart(run, task, layout)
        };
        marks.place((LEFT + 10.0, y), &chart);
        y += each;
    }
    top + height + 6.0
}

/// Path beside the mode, everything else in rows below.
fn tabled(run: &Run, marks: &mut Marks, top: f64) -> f64 {
    let mode_height = mode::natural_height(run) + TIME_LABELS;
    let height = mode_height.max(LEFT);
    titled(
        marks,
        (0.0, top),
        "tool path",
        &path::panel(run, LEFT, LEFT - 20.0),
    );
    let layout = Layout {
        width: WIDTH - LEFT - 10.0,
        height: mode_height.max(200.0),
        left: mode::label_room(run).clamp(64.0, 200.0),
        time_labels: true,
    };
    marks.place((LEFT + 10.0, top), &mode::chart(run, layout));
    let mut y = top + height + 10.0;
    for panel in [sets::panel(run, WIDTH), errors::panel(run, WIDTH)] {
        marks.place((0.0, y), &panel);
        y += panel.height + 6.0;
    }
    y
}

fn titled(marks: &mut Marks, at: (f64, f64), title: &str, picture: &Picture) {
    let style = Lettering::new(TITLE, palette::INK).bold();
    marks.text((at.0 + 14.0, at.1 + 15.0), title, style);
    marks.place((at.0, at.1 + 20.0), picture);
}
