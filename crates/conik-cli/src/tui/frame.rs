//! What stands where on the screen, from the title down to the keys.

use std::collections::BTreeSet;
use std::ops::Range;

use conik_sim::summary::Outcome;
use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::text::{Line, Span};

use super::course::Course;
use super::ink::{Ink, bold, soft};
use super::list::{self, Row, Widths};
use super::scene::Scene;
use super::standing::{Standing, standing};
use super::{joints, strip};
use crate::figure::lettering::number;

/// What whoever looks has chosen.
#[derive(Clone, Debug)]
pub(super) struct Looks {
    pub(super) selected: Row,
    /// The first task of each group that is open.
    pub(super) open: BTreeSet<usize>,
    pub(super) has_help: bool,
    /// What is shown in the place of what is now.
    pub(super) frozen: Option<Box<Course>>,
    /// What the arm warned of last.
    pub(super) warning: Option<String>,
    /// Whether the run is about to be stopped.
    pub(super) is_stopping: bool,
}

impl Default for Looks {
    fn default() -> Self {
        Self {
            selected: Row::Task(0),
            open: BTreeSet::new(),
            has_help: false,
            frozen: None,
            warning: None,
            is_stopping: false,
        }
    }
}

/// What the keys do.
const HELP: [&str; 12] = [
    "q, Ctrl-C   stop the run; the arm is brought to a stop. After the end: leave",
    "↑ ↓, k j    select a task or a group; the lines below tell of it",
    "Enter       open or fold a group of joint limits or of pairs of shapes",
    "p           freeze what is shown, or go on. The arm moves on all the same",
    "?           this page, or back",
    "",
    "■ HELD      an active set: the tasks below would push it out",
    "▲ driven    an active set of low priority, driven back to its border",
    "! OUTSIDE   a set that is not inside, and not active",
    "· inside    a set that is inside and not active",
    "→           an equality task: its error and, at ┃, zero",
    "bars        ┃ bounds, ● the value, ◆ the value on a bound, · what is not allowed",
];

/// Draws everything.
pub(super) fn draw(buffer: &mut Buffer, scene: &Scene, now: &Course, looks: &Looks, ink: Ink) {
    let area = *buffer.area();
    let course = looks.frozen.as_deref().unwrap_or(now);
    let width = usize::from(area.width);
    let head = head(scene, course, looks, ink, width);
    if looks.has_help {
        let help = HELP.iter().map(|line| Line::from(format!(" {line}")));
        let lines = head.into_iter().take(1).chain([Line::default()]);
        let lines: Vec<_> = lines.chain(help).collect();
        put(buffer, area, 0, &lines);
        put(buffer, area, last(area), &[keys(looks, now)]);
        return;
    }
    let rows = list::rows(scene, course, &looks.open);
    let at = place(&rows, looks.selected);
    let selected = rows.get(at).copied().unwrap_or(looks.selected);
    let mut foot = about(scene, course, selected, width);
    foot.push(strip::sparkline(scene, course, selected, width));
    foot.extend(strip::modes(scene, course, ink, width));
    // A low terminal keeps the list and goes without joints.
    if area.height >= 20 {
        foot.extend(joints::lines(scene, course, ink, width));
    }
    foot.push(keys(looks, now));
    let height = usize::from(area.height);
    // Three lines of the list go before all of that but the keys.
    let kept = height.saturating_sub(head.len() + 3).max(1);
    foot.drain(..foot.len().saturating_sub(kept));
    let room = height.saturating_sub(head.len() + foot.len());
    let visible = visible(rows.len(), at, room);
    let widths = Widths::of(width.saturating_sub(1), scene);
    let listed = visible.map(|nth| {
        let mut line = match rows[nth] {
            Row::Task(task) => list::task_line((scene, course), task, widths, ink),
            Row::Group(from, to) => {
                let is_open = looks.open.contains(&from);
                list::group_line((scene, course), (from, to), is_open, ink)
            }
        };
        let pointer = if nth == at { ">" } else { " " };
        line.spans.insert(0, Span::styled(pointer, bold()));
        line
    });
    let listed: Vec<_> = listed.collect();
    let foot_at = height.saturating_sub(foot.len());
    put(buffer, area, 0, &head);
    put(buffer, area, head.len(), &listed);
    put(buffer, area, foot_at, &foot);
}

fn last(area: Rect) -> usize {
    usize::from(area.height.saturating_sub(1))
}

/// Puts lines below each other, cut where the screen ends.
fn put(buffer: &mut Buffer, area: Rect, from: usize, lines: &[Line<'_>]) {
    for (y, line) in (from..usize::from(area.height)).zip(lines) {
        // Below the height, which is one.
        let y = u16::try_from(y).unwrap_or(u16::MAX);
        buffer.set_line(area.x, area.y.saturating_add(y), line, area.width);
    }
}

fn head(
    scene: &Scene,
    course: &Course,
    looks: &Looks,
    ink: Ink,
    width: usize,
) -> Vec<Line<'static>> {
    let mut lines = vec![
        Line::from(Span::styled(list::fitted(&scene.title, width), bold())),
        Line::from(Span::styled(scene.robot.clone(), soft())),
        Line::from(Span::styled(scene.rules.clone(), soft())),
    ];
    let t_s = course.record.as_ref().map_or(0.0, |record| record.t_s);
    let clock = format!("{t_s:.2} of {} s ", number(scene.duration_s, 6));
    let share = if scene.duration_s > 0.0 {
        t_s / scene.duration_s
    } else {
        1.0
    };
    let (text, style) = match (&course.outcome, &looks.frozen) {
        (_, Some(_)) => (
            "view frozen, the arm is NOT; p: go on".to_owned(),
            ink.alarm(),
        ),
        (None, None) if looks.is_stopping => ("stopping the arm".to_owned(), bold()),
        (None, None) if course.record.is_none() => ("starting".to_owned(), bold()),
        (None | Some(Outcome::Running), None) => ("running".to_owned(), bold()),
        (Some(Outcome::Completed), None) => ("ended".to_owned(), bold()),
        (Some(Outcome::Interrupted), None) => ("stopped by hand".to_owned(), bold()),
        (Some(Outcome::Fault { name, .. }), None) => (format!("FAULT {name}"), ink.alarm()),
    };
    let taken = clock.chars().count() + text.chars().count() + 2;
    let mut line = vec![Span::raw(clock)];
    line.extend(progress(share, width.saturating_sub(taken).min(30)));
    line.push(Span::styled(format!(" {text}"), style));
    lines.push(Line::from(line));
    lines.push(Line::from(numbers(course)));
    if let Some(Outcome::Fault { detail, .. }) = &course.outcome {
        let folded = folded(detail, width, 2).into_iter();
        lines.extend(folded.map(|line| Line::from(Span::styled(line, ink.alarm()))));
    }
    let warning = looks.warning.iter();
    lines.extend(warning.map(|it| Line::from(format!("warning: {it}"))));
    lines
}

fn progress(share: f64, width: usize) -> [Span<'static>; 2] {
    // Between 0 and the width.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let done = (share.clamp(0.0, 1.0) * width as f64).round() as usize;
    [
        Span::raw("━".repeat(done)),
        Span::styled("╌".repeat(width - done.min(width)), soft()),
    ]
}

/// Times of the steps, missed cycles, and what decided the tick besides the tasks.
fn numbers(course: &Course) -> String {
    let mut text = match course.steps.distribution() {
        Some(times) => format!("step {:.1} µs, longest {:.0} µs", times.median, times.max),
        None => "no step yet".to_owned(),
    };
    text += &format!("; cycles missed: {}", course.missed_cycles);
    let reasons = course.record.iter().flat_map(|record| &record.reasons);
    let said = reasons.filter(|it| it.task().is_none()).find_map(|reason| {
        let joint = reason.joint().map_or(0, |joint| joint + 1);
        Some(match reason.word() {
            "speed" => format!("slowed for the speed limit of joint {joint}"),
            "acceleration" => {
                format!("changes slowly, for the acceleration limit of joint {joint}")
            }
            "acceleration-exceeded" => format!("joint {joint} accelerates beyond its limit"),
            "corrected" => "corrected, to land inside every set".to_owned(),
            "halved" => "halved, to land inside every set".to_owned(),
            "cautious" => "slow, because a tick before had to stand still".to_owned(),
            "still" => "STANDS STILL: no velocity lands inside every set".to_owned(),
            "no-mode" => "STANDS STILL: the exclusions leave no mode".to_owned(),
            _ => return None,
        })
    });
    if let Some(said) = said {
        text += &format!("; {said}");
    }
    text
}

/// The part of a list of so many lines, in so much room, in which the selected line is.
fn visible(count: usize, at: usize, room: usize) -> Range<usize> {
    if count <= room {
        return 0..count;
    }
    // The next ones are seen before they are selected.
    let above = (at + 1).saturating_sub(room - room / 3).min(count - room);
    above..above + room
}

/// Where the selected line is; that of its group if it is folded away.
pub(super) fn place(rows: &[Row], selected: Row) -> usize {
    let holds = |row: &Row| match (*row, selected) {
        (row, selected) if row == selected => true,
        (Row::Group(from, to), Row::Task(task)) => (from..to).contains(&task),
        _ => false,
    };
    let exactly = rows.iter().position(|row| *row == selected);
    exactly.or_else(|| rows.iter().position(holds)).unwrap_or(0)
}

/// What there is to say of the selected task: two lines.
fn about(scene: &Scene, course: &Course, selected: Row, width: usize) -> Vec<Line<'static>> {
    let text = match (selected, &course.record) {
        (Row::Task(at), Some(record)) => scene.tasks.get(at).map(|task| {
            let Standing { short, long, .. } = standing(task, record, list::shown(record, task));
            let asked = list::asked(scene, record, task);
            let why = if long.is_empty() {
                format!("{short}.")
            } else {
                long
            };
            format!("{}, {asked}: {why}", task.name)
        }),
        (Row::Group(..), _) => Some("Enter opens or folds the group.".to_owned()),
        (Row::Task(_), None) => None,
    };
    let mut lines = folded(&text.unwrap_or_default(), width, 2);
    lines.resize(2, String::new());
    lines.into_iter().map(Line::from).collect()
}

/// Text in lines of that width, no more than `most` of them.
fn folded(text: &str, width: usize, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.len() - 1;
        let length = lines[line].chars().count();
        if length > 0 && length + 1 + word.chars().count() > width {
            lines.push(word.to_owned());
        } else {
            let space = if length > 0 { " " } else { "" };
            lines[line] += &format!("{space}{word}");
        }
    }
    if lines.len() > most {
        lines.truncate(most);
        let line = lines.pop().unwrap_or_default() + " …";
        lines.push(list::fitted(&line, width.min(line.chars().count())));
    }
    lines
}

fn keys(looks: &Looks, now: &Course) -> Line<'static> {
    let quit = if now.outcome.is_some() {
        "q leave"
    } else {
        "q stop the arm"
    };
    let freeze = if looks.frozen.is_some() {
        "p go on"
    } else {
        "p freeze view"
    };
    let text = if looks.has_help {
        format!("{quit}   ? back")
    } else {
        format!("{quit}   ↑↓ select   Enter open   {freeze}   ? help")
    };
    Line::from(Span::styled(text, soft()))
}
