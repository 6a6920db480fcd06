//! The words in the scene in three dimensions: where the path starts and ends, which waypoint and
//! which obstacle is which.

use super::camera::View;
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::path::LABEL;
use super::placement::Placement;
use super::run::Run;
use super::scene::Scene;
use super::svg::{Marks, Point};

/// More obstacles than this are drawn without their names.
const MOST_NAMED: usize = 16;

/// Marks the ends of the path and names what is in the scene, where there is room.
pub fn draw(run: &Run, scene: &Scene, view: &View, marks: &mut Marks, placement: &mut Placement) {
    if let Some((start, end)) = scene.ends() {
        let place = view.place(start);
        marks.circle(place, 4.0, "#ffffff", Stroke::solid(palette::INK, 1.8));
        let style = Lettering::new(LABEL, palette::INK);
        label(place, 6.0, "start", style, marks, placement);
        let place = view.place(end);
        let (colour, word) = match run.early_end() {
            None => (palette::INK, String::new()),
            Some(word) => (palette::ALARM, word),
        };
        marks.circle(place, 4.0, colour, Stroke::solid("#ffffff", 1.2));
        let word = lettering::shorten(&word, LABEL, 150.0);
        label(
            place,
            6.0,
            &word,
            Lettering::new(LABEL, colour).bold(),
            marks,
            placement,
        );
    }
    for (nth, target) in scene.targets.iter().enumerate() {
        let radius = (view.scale * target.acceptance).max(3.0);
        let style = Lettering::new(12.0, palette::INK).bold();
        let number = (nth + 1).to_string();
        label(
            view.place(target.point),
            radius + 2.0,
            &number,
            style,
            marks,
            placement,
        );
    }
    name_moving(scene, view, marks, placement);
    // So many names would hide what they name.
    let named = if scene.spheres.len() <= MOST_NAMED {
        &scene.spheres[..]
    } else {
        &[]
    };
    for sphere in named {
        let name = lettering::shorten(&sphere.name, LABEL, 130.0);
        let (x, y) = view.place(sphere.centre);
        let radius = view.scale * sphere.radius;
        let style = Lettering::new(LABEL, "#3b4754").anchored("middle");
        let inside = radius > 0.6 * lettering::width(&name, LABEL);
        let candidates = if inside {
            [0.5, 0.65, 0.3, 0.0, -0.4].map(|part| ((x, y + part * radius + 4.0), style))
        } else {
            [13.0, -6.0, 27.0, -20.0, 41.0].map(|off| {
                (
                    if off > 0.0 {
                        (x, y + radius + off)
                    } else {
                        (x, y - radius + off)
                    },
                    style,
                )
            })
        };
        if let Some(best) = placement.choose(&candidates, &name) {
            let style = if inside { style } else { style.rimmed() };
            marks.text(candidates[best].0, &name, style);
        }
    }
}

/// Names what moves where it was at the start and where it is at the end.
fn name_moving(scene: &Scene, view: &View, marks: &mut Marks, placement: &mut Placement) {
    let style = Lettering::new(LABEL, "#3b4754");
    for sphere in scene.moving.iter().take(MOST_NAMED) {
        let name = lettering::shorten(&sphere.name, LABEL, 130.0);
        for (at, when) in [(sphere.from, "start"), (sphere.to, "end")] {
            let text = format!("{name}, {when}");
            label(view.place(at), 3.0, &text, style, marks, placement);
        }
    }
}

/// Sets a label beside a thing of that radius, where there is room.
fn label(
    at: Point,
    radius: f64,
    text: &str,
    style: Lettering,
    marks: &mut Marks,
    placement: &mut Placement,
) {
    if text.is_empty() {
        return;
    }
    let drop = 0.36 * style.size;
    let (near, far) = (radius + 3.0, radius + 4.0);
    let candidates = [
        ((at.0 + near, at.1 + drop), style),
        ((at.0 - near, at.1 + drop), style.anchored("end")),
        ((at.0, at.1 - far), style.anchored("middle")),
        ((at.0, at.1 + far + 2.0 * drop), style.anchored("middle")),
        ((at.0 + near, at.1 - far), style),
        ((at.0 - near, at.1 - far), style.anchored("end")),
        ((at.0 + near, at.1 + far + 2.0 * drop), style),
        (
            (at.0 - near, at.1 + far + 2.0 * drop),
            style.anchored("end"),
        ),
    ];
    if let Some(best) = placement.choose(&candidates, text) {
        let (at, style) = candidates[best];
        marks.text(at, text, style.rimmed());
    }
}
