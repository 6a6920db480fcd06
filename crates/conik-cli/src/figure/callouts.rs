//! The words in the scene in three dimensions: where the path starts and ends, which waypoint and
//! which obstacle is which.

use conik::Shape;

use super::axis::range;
use super::camera::View;
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::path::LABEL;
use super::placement::Placement;
use super::run::Run;
use super::scene::Scene;
use super::solid;
use super::svg::{Marks, Point};
use super::wall;

/// More obstacles than this are drawn without their names.
const MOST_NAMED: usize = 16;

/// Colour of the names of things.
const NAME: &str = "#3b4754";

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
    name_walls(scene, view, marks, placement);
    name_moving(run, scene, view, marks, placement);
    for sight in &scene.around.sights {
        let name = lettering::shorten(&sight.name, LABEL, 130.0);
        let style = Lettering::new(LABEL, NAME);
        label(view.place(sight.to), 7.0, &name, style, marks, placement);
    }
    // So many names would hide what they name.
    if scene.standing().count() <= MOST_NAMED {
        for obstacle in scene.standing() {
            name_shape(&obstacle.name, &obstacle.shape, view, marks, placement);
        }
        for cell in &scene.around.cells {
            let top = (cell.middle + cell.half).to_array();
            let style = Lettering::new(LABEL, NAME);
            label(view.place(top), 3.0, &cell.name, style, marks, placement);
        }
        for bound in &scene.around.bounds {
            let (x, y) = view.place(bound.centre);
            let rim = (x, y - view.scale * bound.radius);
            let style = Lettering::new(LABEL, NAME);
            label(rim, 2.0, &bound.name, style, marks, placement);
        }
    }
}

/// Sets a word beside a point.
pub fn note(at: Point, text: &str, marks: &mut Marks, placement: &mut Placement) {
    let style = Lettering::new(LABEL, palette::SOFT);
    label(at, 9.0, text, style, marks, placement);
}

/// Names a shape on it, if the name is no wider than it is, or else beside it.
fn name_shape(
    name: &str,
    shape: &Shape,
    view: &View,
    marks: &mut Marks,
    placement: &mut Placement,
) {
    let name = lettering::shorten(name, LABEL, 130.0);
    let (x, y) = view.place(solid::middle(shape).to_array());
    let [right, up] = view.camera.frame().map(Into::into);
    let rim = solid::rim(shape, right, up);
    let rim: Vec<Point> = rim.into_iter().map(|point| view.place(point)).collect();
    let (left, end) = range(rim.iter().map(|place| place.0));
    let (top, bottom) = range(rim.iter().map(|place| place.1));
    let style = Lettering::new(LABEL, NAME).anchored("middle");
    let half = 0.5 * (bottom - top);
    let is_inside = end - left > 1.2 * lettering::width(&name, LABEL) && half > 0.8 * LABEL;
    let candidates = if is_inside {
        [0.5, 0.65, 0.3, 0.0, -0.4].map(|part| ((x, y + part * half + 4.0), style))
    } else {
        [
            ((x, bottom + 13.0), style),
            ((x, top - 6.0), style),
            ((end + 5.0, y + 4.0), style.anchored("start")),
            ((left - 5.0, y + 4.0), style.anchored("end")),
            ((x, bottom + 27.0), style),
        ]
    };
    if let Some(best) = placement.choose(&candidates, &name) {
        let (at, style) = candidates[best];
        marks.text(at, &name, style.rimmed());
    }
}

/// Names planes near a corner of what is drawn of them.
fn name_walls(scene: &Scene, view: &View, marks: &mut Marks, placement: &mut Placement) {
    for it in scene.around.walls.iter().take(MOST_NAMED) {
        let corners = wall::piece(it, scene);
        let places: Vec<Point> = corners.iter().map(|it| view.place(it.to_array())).collect();
        let count = places.len().max(1) as f64;
        let middle = places
            .iter()
            .fold((0.0, 0.0), |sum, at| (sum.0 + at.0, sum.1 + at.1));
        let middle = (middle.0 / count, middle.1 / count);
        let name = lettering::shorten(&it.name, LABEL, 130.0);
        let style = Lettering::new(LABEL, NAME).anchored("middle");
        let toward =
            |(x, y): Point, part: f64| (x + part * (middle.0 - x), y + part * (middle.1 - y) + 4.0);
        let inward = [0.2, 0.35, 0.5].into_iter();
        let candidates: Vec<(Point, Lettering)> = inward
            .flat_map(|part| places.iter().map(move |&at| (toward(at, part), style)))
            .collect();
        if let Some(best) = placement.choose(&candidates, &name) {
            marks.text(candidates[best].0, &name, style.rimmed());
        }
    }
}

/// Names what moves where it was at the start and where it is at the end, or at the time shown.
fn name_moving(
    run: &Run,
    scene: &Scene,
    view: &View,
    marks: &mut Marks,
    placement: &mut Placement,
) {
    let moving = scene.around.obstacles.iter();
    for obstacle in moving.filter(|it| it.moved.is_some()).take(MOST_NAMED) {
        let here = if run.is_whole() { ", end" } else { "" };
        let places = [(obstacle.shape, here), (obstacle.at_start(), ", start")];
        for (shape, when) in places {
            let name = format!("{}{when}", obstacle.name);
            name_shape(&name, &shape, view, marks, placement);
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
