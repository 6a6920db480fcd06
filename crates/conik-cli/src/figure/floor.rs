//! The floor of the scene in three dimensions: its grid in metres, the shadows on it, the ruler of
//! heights, and the axes of the base frame.

use conik::Pose;

use super::axis::decimals_of;
use super::camera::{Camera, Vector, View};
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::path::LABEL;
use super::placement::{Area, Placement};
use super::scene::Scene;
use super::solid;
use super::svg::{Marks, Point};

const TICK: f64 = 10.0;
const SHADOW: &str = "#8e99a6";

/// Width of the widest number on the rulers of the floor [px].
pub fn widest_number(scene: &Scene) -> f64 {
    let ends = [scene.low, scene.high].into_iter().flatten();
    let widths = ends.map(|value| lettering::width(&number(value, scene.step), TICK));
    widths.fold(0.0, f64::max)
}

/// A number on a ruler; the step tells how exact it has to be.
fn number(value: f64, step: f64) -> String {
    if (value / step).round() == 0.0 {
        return "0".to_owned();
    }
    let decimals = decimals_of(step);
    lettering::minus(&format!("{value:.decimals$}"))
}

/// Draws floor, grid, rulers and shadows.
pub fn draw(scene: &Scene, view: &View, marks: &mut Marks, placement: &mut Placement) {
    let (low, high) = (scene.low, scene.high);
    let corner = |x: f64, y: f64| view.place([x, y, low[2]]);
    let corners = [
        corner(low[0], low[1]),
        corner(high[0], low[1]),
        corner(high[0], high[1]),
        corner(low[0], high[1]),
    ];
    marks.polygon(&corners, "#f5f7f9", 1.0);
    for x in lines(low[0], high[0], scene.step) {
        let stroke = Stroke::solid("#dfe4e9", 0.8);
        marks.line(corner(x, low[1]), corner(x, high[1]), stroke);
    }
    for y in lines(low[1], high[1], scene.step) {
        let stroke = Stroke::solid("#dfe4e9", 0.8);
        marks.line(corner(low[0], y), corner(high[0], y), stroke);
    }
    shadows(scene, view, marks);

    // The edges of the floor towards the viewer carry the numbers.
    let near = nearest_corner(scene, &view.camera);
    let far = [0, 1].map(|k| low[k] + high[k] - near[k]);
    let left = leftmost_corner(scene, &view.camera);
    let (left_x, left_y) = view.place(left);
    let mut rulers = Rulers {
        scene,
        view,
        marks,
        placement,
    };
    rulers.ruler(0, near, corner(near[0], far[1]), "x [m]");
    rulers.ruler(1, near, corner(far[0], near[1]), "y [m]");
    rulers.ruler(2, left, (left_x + 1.0, left_y), "z [m]");
}

/// The corner of the floor next to the viewer.
fn nearest_corner(scene: &Scene, camera: &Camera) -> Vector {
    corner_where(scene, |corner| camera.nearness(corner))
}

/// The corner of the floor that appears leftmost: there stands the ruler of heights.
pub fn leftmost_corner(scene: &Scene, camera: &Camera) -> Vector {
    corner_where(scene, |corner| -camera.project(corner).0)
}

fn corner_where(scene: &Scene, most: impl Fn(Vector) -> f64) -> Vector {
    let (low, high) = (scene.low, scene.high);
    let mut best = low;
    for corner in [
        [high[0], low[1], low[2]],
        [low[0], high[1], low[2]],
        [high[0], high[1], low[2]],
    ] {
        if most(corner) > most(best) {
            best = corner;
        }
    }
    best
}

fn lines(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step - 0.01).ceil();
    // The box is about ten steps long.
    (0..200)
        .map(|nth| (first + f64::from(nth)) * step)
        .take_while(|value| *value <= high + 0.01 * step)
        .collect()
}

struct Rulers<'a> {
    scene: &'a Scene,
    view: &'a View,
    marks: &'a mut Marks,
    placement: &'a mut Placement,
}

impl Rulers<'_> {
    /// A ruler along axis `k` from `begin` on; its labels point away from `inward`.
    fn ruler(&mut self, k: usize, begin: Vector, inward: Point, name: &str) {
        let (low, high, step) = (self.scene.low[k], self.scene.high[k], self.scene.step);
        let at = |value: f64| {
            let mut point = begin;
            point[k] = value;
            self.view.place(point)
        };
        let (from, to) = (at(low), at(high));
        let corner = self.view.place(begin);
        let (dx, dy) = (corner.0 - inward.0, corner.1 - inward.1);
        let length = dx.hypot(dy).max(1e-9);
        let out = (dx / length, dy / length);
        let pixels = (to.0 - from.0).hypot(to.1 - from.1) * step / (high - low);
        let stride = (if k == 2 { 20.0 } else { 34.0 } / pixels.max(0.1)).ceil();
        self.marks
            .line(from, to, Stroke::solid(palette::FRAME, 1.0));
        for value in lines(low, high, step) {
            // Counted from zero, so that round numbers keep their labels.
            let whole = (value / step).round();
            let (x, y) = at(value);
            let tip = (x + 4.0 * out.0, y + 4.0 * out.1);
            self.marks
                .line((x, y), tip, Stroke::solid(palette::FRAME, 1.0));
            if whole.rem_euclid(stride) != 0.0 || (k == 2 && value - low < 0.3 * step) {
                continue;
            }
            self.write(
                (x + 9.0 * out.0, y + 9.0 * out.1),
                out,
                &number(value, step),
                TICK,
            );
        }
        let (x, y) = if k == 2 {
            (to.0, to.1 - 9.0)
        } else {
            let away = 32.0;
            let middle = (f64::midpoint(from.0, to.0), f64::midpoint(from.1, to.1));
            (middle.0 + away * out.0, middle.1 + away * out.1)
        };
        let out = if k == 2 { (0.0, -1.0) } else { out };
        self.write((x, y), out, name, LABEL);
    }

    fn write(&mut self, at: Point, out: Point, text: &str, size: f64) {
        let anchor = match out.0 {
            x if x > 0.35 => "start",
            x if x < -0.35 => "end",
            _ => "middle",
        };
        let style = Lettering::new(size, palette::SOFT).anchored(anchor);
        let at = (at.0, at.1 + size * (0.36 + 0.4 * out.1));
        self.placement.avoid(Area::of_text(at, text, &style));
        self.marks.text(at, text, style);
    }
}

/// Where things stand over the floor: what tells near and high from far and low.
fn shadows(scene: &Scene, view: &View, marks: &mut Marks) {
    let on_floor = |point: Vector| view.place([point[0], point[1], scene.low[2]]);
    for obstacle in scene.standing() {
        let rim = solid::rim(
            &obstacle.shape,
            Pose::IDENTITY.x_axis,
            Pose::IDENTITY.y_axis,
        );
        let rim: Vec<Point> = rim.into_iter().map(on_floor).collect();
        marks.polygon(&solid::hull(rim), SHADOW, 0.22);
    }
    for piece in &scene.path {
        let places: Vec<Point> = piece.points.iter().map(|&point| on_floor(point)).collect();
        marks.polyline(&places, Stroke::solid("#c3cad2", 1.3));
    }
    for target in &scene.targets {
        let (foot, top) = (on_floor(target.point), view.place(target.point));
        marks.line(foot, top, Stroke::dashed("#aab3bd", 0.8, "2 2"));
    }
}

/// The tips of the base frame's axes as they are drawn, long enough to be seen.
pub fn axes(scene: &Scene) -> [Vector; 3] {
    let (low, high) = (scene.low, scene.high);
    let size = 0.16 * (high[0] - low[0]).max(high[1] - low[1]);
    [[size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]]
}

/// The axes of the base frame at its origin.
pub fn triad(scene: &Scene, view: &View, marks: &mut Marks, placement: &mut Placement) {
    let origin = view.place([0.0; 3]);
    let foot = view.place([0.0, 0.0, scene.low[2]]);
    marks.line(foot, origin, Stroke::dashed("#aab3bd", 0.8, "2 2"));
    for (tip, name) in axes(scene).into_iter().zip(["x", "y", "z"]) {
        let tip = view.place(tip);
        marks.line(origin, tip, Stroke::solid(palette::INK, 1.4));
        placement.avoid_curve(&[origin, tip]);
        let (dx, dy) = (tip.0 - origin.0, tip.1 - origin.1);
        let length = dx.hypot(dy);
        if length < 4.0 {
            continue;
        }
        let (ux, uy) = (dx / length, dy / length);
        let head = [
            (tip.0 + 5.0 * ux, tip.1 + 5.0 * uy),
            (tip.0 - 2.8 * uy, tip.1 + 2.8 * ux),
            (tip.0 + 2.8 * uy, tip.1 - 2.8 * ux),
        ];
        marks.polygon(&head, palette::INK, 1.0);
        let style = Lettering::new(LABEL, palette::INK).anchored("middle");
        let at = (tip.0 + 13.0 * ux, tip.1 + 13.0 * uy + 3.5);
        placement.avoid(Area::of_text(at, name, &style));
        marks.text(at, name, style.rimmed());
    }
    let style = Lettering::new(LABEL, palette::INK);
    let (x, y) = origin;
    let candidates = [
        ((x + 6.0, y - 7.0), style),
        ((x - 6.0, y - 7.0), style.anchored("end")),
        ((x, y + 16.0), style.anchored("middle")),
        ((x + 8.0, y + 14.0), style),
        ((x - 8.0, y + 14.0), style.anchored("end")),
    ];
    if let Some(best) = placement.choose(&candidates, scene.origin) {
        let (at, style) = candidates[best];
        marks.text(at, scene.origin, style.rimmed());
    }
}
