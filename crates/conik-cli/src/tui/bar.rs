//! Bars: an interval with its bounds and the place of a value in it, on a line of text.

use ratatui_core::style::Style;
use ratatui_core::text::Span;

use super::ink::soft;
use super::scene::SceneTask;

/// What a bar shows, from end to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    from: f64,
    to: f64,
    min: Option<f64>,
    max: Option<f64>,
}

impl Scale {
    /// Of a task: what is allowed and what was seen, with some room; of an error from zero on.
    pub(super) fn of(task: &SceneTask, seen: (f64, f64)) -> Self {
        let finite = |bound: f64| bound.is_finite().then_some(bound);
        let (min, max) = match &task.interval {
            Some(set) => (finite(set.min), finite(set.max)),
            None => (Some(0.0), None),
        };
        let ends = [min, max, finite(seen.0), finite(seen.1)];
        let ends = ends.into_iter().flatten();
        let (from, to) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), end| {
            (from.min(end), to.max(end))
        });
        let room = if to > from { 0.08 * (to - from) } else { 1.0 };
        Self {
            from: from - room,
            to: to + room,
            min,
            max,
        }
    }

    /// Of a joint between two limits.
    pub(super) fn between(min: f64, max: f64) -> Self {
        Self {
            from: min,
            to: max,
            min: None,
            max: None,
        }
    }

    /// The place of a value among so many; values beyond the ends stand at them.
    fn place(&self, value: f64, width: usize) -> usize {
        let share = ((value - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        // Between 0 and the width; NaN becomes 0.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let place = (share * width.saturating_sub(1) as f64).round() as usize;
        place
    }
}

/// A bar of that width; of less than four places there is none.
pub(super) fn spans(scale: Scale, value: f64, width: usize, style: Style) -> Vec<Span<'static>> {
    if width < 4 || !value.is_finite() {
        return vec![Span::raw(" ".repeat(width))];
    }
    let place = |bound: Option<f64>| bound.map(|bound| scale.place(bound, width));
    let (min, max) = (place(scale.min), place(scale.max));
    let at = scale.place(value, width);
    let glyph = |here: usize| {
        if Some(here) == min || Some(here) == max {
            '┃'
        } else if min.is_some_and(|min| here < min) || max.is_some_and(|max| here > max) {
            '·'
        } else {
            '─'
        }
    };
    let before: String = (0..at).map(glyph).collect();
    let after: String = (at + 1..width).map(glyph).collect();
    // On its bound, a value must not hide that it is there.
    let here = if glyph(at) == '┃' { '◆' } else { '●' };
    vec![
        Span::styled(before, soft()),
        Span::styled(here.to_string(), style),
        Span::styled(after, soft()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(scale: Scale, value: f64, width: usize) -> String {
        let spans = spans(scale, value, width, Style::new());
        spans.iter().map(|span| span.content.as_ref()).collect()
    }

    #[test]
    fn value_stands_between_its_bounds_on_them_or_beyond() {
        let scale = Scale {
            from: 0.0,
            to: 10.0,
            min: Some(2.0),
            max: Some(8.0),
        };
        assert_eq!(text(scale, 5.0, 11), "··┃──●──┃··");
        assert_eq!(text(scale, 2.0, 11), "··◆─────┃··");
        assert_eq!(text(scale, 9.0, 11), "··┃─────┃●·");
        assert_eq!(text(scale, 99.0, 11), "··┃─────┃·●");
        assert_eq!(text(scale, f64::NAN, 11), " ".repeat(11));
        assert_eq!(text(scale, 5.0, 3), "   ");
    }
}
