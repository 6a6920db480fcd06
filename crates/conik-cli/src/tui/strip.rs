//! What was, over the time of the run: the modes in their colours, and the selected task.

use ratatui_core::text::{Line, Span};

use super::course::{Course, PIECES};
use super::ink::{Ink, bold, soft};
use super::list::Row;
use super::scene::Scene;
use crate::report::units::quantity;

/// What stands before the strips.
const LABEL: usize = 6;
/// From the least value to the greatest.
const HEIGHTS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// The pieces of time that stand in a place of a strip.
fn pieces(place: usize, width: usize) -> (usize, usize) {
    let from = place * PIECES / width;
    (from, ((place + 1) * PIECES / width).max(from + 1))
}

/// The letter of a mode, which tells it from others without colour.
fn letter(nth: Option<usize>) -> char {
    let Some(nth) = nth else { return '·' };
    let letters = ('A'..='Z').chain('a'..='z');
    letters.chain(['*']).nth(nth.min(52)).unwrap_or('*')
}

/// The modes over time, and a line that says what they are.
pub(super) fn modes(scene: &Scene, course: &Course, ink: Ink, width: usize) -> [Line<'static>; 2] {
    let room = width.saturating_sub(LABEL);
    let mut strip = vec![Span::styled("mode  ", soft())];
    for place in 0..room {
        let (from, to) = pieces(place, room);
        let mode = course.mode_between(from, to).map(|at| course.modes[at]);
        strip.push(match mode {
            Some(mode) => Span::styled(letter(mode.nth).to_string(), ink.mode(mode.nth)),
            None => Span::raw(" "),
        });
    }
    [Line::from(strip), legend(scene, course, ink)]
}

/// The present mode first: what it is called in the strip, its number, its sets.
fn legend(scene: &Scene, course: &Course, ink: Ink) -> Line<'static> {
    let present = course.record.as_ref().map(|record| record.active);
    let mut modes = course.modes.clone();
    modes.sort_by_key(|mode| Some(mode.active) != present);
    let mut spans = vec![Span::styled("now   ", soft())];
    for (nth, mode) in modes.iter().enumerate() {
        let number = scene.mode_order.number(&mode.active);
        let number = number.map_or("–".to_owned(), |number| number.to_string());
        let names = mode
            .active
            .iter()
            .filter_map(|id| scene.tasks.get(id.index()));
        let names: Vec<_> = names.map(|task| task.name.as_str()).collect();
        let names = if names.is_empty() {
            "no set active".to_owned()
        } else {
            names.join(" + ")
        };
        spans.push(Span::styled(
            letter(mode.nth).to_string(),
            ink.mode(mode.nth),
        ));
        let text = format!(" mode {number}: {names}   ");
        spans.push(Span::styled(text, if nth == 0 { bold() } else { soft() }));
    }
    Line::from(spans)
}

/// What is shown of the selected task, over time, between the least and the greatest that was seen.
pub(super) fn sparkline(
    scene: &Scene,
    course: &Course,
    selected: Row,
    width: usize,
) -> Line<'static> {
    let task = match selected {
        Row::Task(at) => scene.tasks.get(at),
        Row::Group(..) => None,
    };
    let column = task.and_then(|task| Some((task, task.column?)));
    let Some((task, column)) = column else {
        return Line::default();
    };
    let Some(&(least, greatest)) = course.seen.get(column) else {
        return Line::default();
    };
    let ends = format!(
        " {} … {}",
        quantity(least, task.unit),
        quantity(greatest, task.unit)
    );
    let what = if task.interval.is_some() {
        "value "
    } else {
        "error "
    };
    let room = width.saturating_sub(LABEL);
    let mut text = String::new();
    for place in 0..room {
        // The same time as in the strip of modes below.
        let (from, _) = pieces(place, room);
        let value = course.pieces.get(from).and_then(|it| it.values.get(column));
        text.push(value.map_or(' ', |value| height(*value, least, greatest)));
    }
    // The ends stand where there is nothing yet, if there is room.
    let (drawn, length) = (text.trim_end().chars().count(), ends.chars().count());
    if drawn + length <= room {
        text = text.chars().take(drawn).collect::<String>() + &ends;
    }
    Line::from(vec![Span::styled(what, soft()), Span::raw(text)])
}

fn height(value: f64, least: f64, greatest: f64) -> char {
    if !value.is_finite() {
        return ' ';
    }
    let share = if greatest > least {
        (value - least) / (greatest - least)
    } else {
        0.0
    };
    // Between 0 and 7.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let place = (share.clamp(0.0, 1.0) * 7.0).round() as usize;
    HEIGHTS[place.min(7)]
}
