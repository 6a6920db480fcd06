//! Where the joints are, between their limits.

use ratatui_core::text::{Line, Span};

use super::bar::{self, Scale};
use super::course::Course;
use super::ink::Ink;
use super::list::fitted;
use super::scene::{Scene, SceneJoint};
use super::standing::State;

/// Width of a joint's name, its position, and the bar and the space that follow.
const NAME: usize = 12;
const POSITION: usize = 8;
const LEAST: usize = 26;

/// As few lines as hold them all, no more than three.
pub(super) fn lines(scene: &Scene, course: &Course, ink: Ink, width: usize) -> Vec<Line<'static>> {
    let a_line = (width / LEAST).max(1);
    let cell = width / a_line;
    let Some(record) = &course.record else {
        return Vec::new();
    };
    let joints: Vec<_> = scene.joints.iter().zip(record.q.iter()).collect();
    let rows = joints.chunks(a_line).take(3);
    let line = |row: &[(&SceneJoint, &f64)]| {
        let spans = row.iter().flat_map(|(joint, q)| one(joint, **q, ink, cell));
        Line::from(spans.collect::<Vec<_>>())
    };
    rows.map(line).collect()
}

fn one(joint: &SceneJoint, q: f64, ink: Ink, cell: usize) -> Vec<Span<'static>> {
    let position = if joint.is_revolute {
        format!("{:.1}°", q.to_degrees())
    } else {
        format!("{:.1} mm", 1e3 * q)
    };
    let name = joint.name.strip_suffix("_joint").unwrap_or(&joint.name);
    let name = fitted(name, NAME);
    let mut spans = vec![Span::raw(format!("{name}{position:>POSITION$} "))];
    let width = cell.saturating_sub(NAME + POSITION + 2);
    match joint.limits {
        Some((min, max)) => {
            let is_out = !(min..=max).contains(&q);
            let state = if is_out {
                State::Outside
            } else {
                State::Inside
            };
            let scale = Scale::between(min, max);
            spans.extend(bar::spans(scale, q, width, ink.state(state)));
        }
        None => spans.push(Span::raw(fitted("", width))),
    }
    spans.push(Span::raw(" "));
    spans
}
