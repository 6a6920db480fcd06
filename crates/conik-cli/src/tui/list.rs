//! The tasks in priority order. Joint limits and pairs of shapes, of which there may be hundreds, stand
//! together in one line each, below which those that are active, or outside, show.

use std::collections::BTreeSet;

use conik_sim::joint_limits::LIMIT;
use conik_sim::record::Record;
use ratatui_core::style::Modifier;
use ratatui_core::text::{Line, Span};

use super::bar::{self, Scale};
use super::course::Course;
use super::ink::{Ink, soft};
use super::scene::{Scene, SceneTask};
use super::standing::{Standing, State, inside, standing};
use crate::report::units::quantity;

/// Fewer tasks of a kind than this are no group.
const FEW: usize = 3;
/// Further out than this a task of a folded group shows [task's unit].
const OUT: f64 = 1e-6;

/// A line of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Row {
    /// A task, by its place.
    Task(usize),
    /// The head of a group: places of its first task and of what follows its last.
    Group(usize, usize),
}

/// The number that is shown of a task: its value, or the norm of its error.
pub(super) fn shown(record: &Record, task: &SceneTask) -> f64 {
    let value = task.column.and_then(|at| record.task_values.get(at));
    value.copied().unwrap_or(f64::NAN)
}

/// The lines that there are, by which groups are open: those of which the first task is named.
pub(super) fn rows(scene: &Scene, course: &Course, open: &BTreeSet<usize>) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut from = 0;
    let tasks = &scene.tasks;
    while from < tasks.len() {
        let kind = tasks[from].kind;
        let alike = |task: &&SceneTask| task.kind.is_some() && task.kind == kind;
        let to = from + tasks[from..].iter().take_while(alike).count().max(1);
        if to - from < FEW {
            rows.extend((from..to).map(Row::Task));
        } else {
            rows.push(Row::Group(from, to));
            let is_shown = |&at: &usize| {
                let stands_out = |record: &Record| {
                    let task = &tasks[at];
                    let margin = inside(task, shown(record, task));
                    record.active.contains(task.id) || margin.is_some_and(|it| it < -OUT)
                };
                open.contains(&from) || course.record.as_ref().is_some_and(stands_out)
            };
            rows.extend((from..to).filter(is_shown).map(Row::Task));
        }
        from = to;
    }
    rows
}

/// Widths of the columns in a line of the list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Widths {
    name: usize,
    /// 0: what is asked is left out.
    asked: usize,
    value: usize,
    bar: usize,
}

/// What stands before the name and what is kept for the state.
const NUMBER: usize = 6;
const STATE: usize = 20;

impl Widths {
    /// For a line of that width. What is asked goes where it is narrow: the selected task tells it.
    pub(super) fn of(width: usize, scene: &Scene) -> Self {
        let longest = scene.tasks.iter().map(|task| task.name.chars().count());
        let longest = longest.max().unwrap_or(0);
        let (most, asked) = if width < 76 { (12, 0) } else { (16, 15) };
        let (name, value) = (longest.clamp(8, most + width.saturating_sub(80) / 4), 10);
        let spaces = if asked > 0 { 4 } else { 3 };
        let taken = NUMBER + name + asked + value + STATE + spaces;
        Self {
            name,
            asked,
            value,
            bar: width.saturating_sub(taken).min(60),
        }
    }
}

/// Text cut or filled to a width.
pub(super) fn fitted(text: &str, width: usize) -> String {
    let length = text.chars().count();
    if length <= width {
        return format!("{text:<width$}");
    }
    let kept: String = text.chars().take(width.saturating_sub(1)).collect();
    if width == 0 { kept } else { kept + "…" }
}

/// A task's line.
pub(super) fn task_line(
    (scene, course): (&Scene, &Course),
    at: usize,
    widths: Widths,
    ink: Ink,
) -> Line<'static> {
    let task = &scene.tasks[at];
    let mut spans = vec![Span::raw(format!("{:>3} ", at + 1))];
    let Some(record) = &course.record else {
        spans.push(Span::raw(fitted(&task.name, widths.name)));
        return Line::from(spans);
    };
    let value = shown(record, task);
    let Standing { state, short, .. } = standing(task, record, value);
    let style = ink.state(state);
    let name = if state == State::Inside || state == State::Equality {
        Span::raw(fitted(&task.name, widths.name))
    } else {
        Span::styled(
            fitted(&task.name, widths.name),
            style.add_modifier(Modifier::BOLD),
        )
    };
    spans.extend([Span::styled(format!("{} ", state.mark()), style), name]);
    if widths.asked > 0 {
        let asked = asked(scene, record, task);
        spans.push(Span::styled(
            format!(" {}", fitted(&asked, widths.asked)),
            soft(),
        ));
    }
    let value_text = quantity(value, task.unit);
    spans.push(Span::raw(format!(
        " {value_text:>width$} ",
        width = widths.value
    )));
    let scale = Scale::of(task, seen(course, task));
    spans.extend(bar::spans(scale, value, widths.bar, style));
    spans.push(Span::styled(format!(" {short}"), style));
    Line::from(spans)
}

/// What is asked of a task now.
pub(super) fn asked(scene: &Scene, record: &Record, task: &SceneTask) -> String {
    task.asked
        .clone()
        .unwrap_or_else(|| format!("waypoint {} of {}", record.waypoint + 1, scene.waypoints))
}

/// The least and the greatest that was seen of what is shown of a task.
fn seen(course: &Course, task: &SceneTask) -> (f64, f64) {
    let seen = task.column.and_then(|at| course.seen.get(at));
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    seen.copied().unwrap_or(none)
}

/// A group's line.
pub(super) fn group_line(
    (scene, course): (&Scene, &Course),
    (from, to): (usize, usize),
    is_open: bool,
    ink: Ink,
) -> Line<'static> {
    let tasks = &scene.tasks[from..to];
    let fold = if is_open { '▾' } else { '▸' };
    let kind = tasks[0].kind.unwrap_or_default();
    let title = format!("{fold} {}–{} {} {kind}", from + 1, to, to - from);
    let mut spans = vec![Span::raw(format!(" {title}  "))];
    let Some(record) = &course.record else {
        return Line::from(spans);
    };
    let held = tasks.iter().filter(|it| record.active.contains(it.id));
    let held = held.count();
    let margins = tasks.iter().filter_map(|task| {
        let margin = inside(task, shown(record, task))?;
        Some((margin, task))
    });
    let nearest = margins.min_by(|a, b| a.0.total_cmp(&b.0));
    let (text, state) = match nearest {
        _ if held > 0 => (format!("{held} HELD"), State::Held),
        Some((margin, _)) if margin < -OUT => ("OUTSIDE".to_owned(), State::Outside),
        _ => ("all inside".to_owned(), State::Inside),
    };
    spans.push(Span::styled(
        format!("{} {text}", state.mark()),
        ink.state(state),
    ));
    if let Some((margin, task)) = nearest {
        let name = task.name.strip_prefix(LIMIT).unwrap_or(&task.name);
        let amount = quantity(margin, task.unit);
        spans.push(Span::styled(
            format!("  nearest to its border: {name}, {amount}"),
            soft(),
        ));
    }
    Line::from(spans)
}
