//! Panel: the tool's path in three dimensions among obstacles and waypoints (Fig. 4a-c).
//!
//! Painted from back to front: floor and shadows, then the spheres from far to near, each after
//! the parts of the path that it stands in front of.

use super::callouts;
use super::camera::{Camera, Vector, View};
use super::floor;
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::placement::{Area, Placement};
use super::run::Run;
use super::scene::{MovingSphere, Scene, Sphere};
use super::svg::{Marks, Picture, Point};

/// Size of labels [px].
pub const LABEL: f64 = 11.0;

/// Outline and way of what moves.
const MOVING: &str = "#5f6b78";

/// Light from the upper left, on all spheres the same.
const SHADE: &str = "<defs><radialGradient id=\"sphere\" cx=\"0.5\" cy=\"0.5\" r=\"0.5\" fx=\"0.33\" fy=\"0.28\">\
<stop offset=\"0\" stop-color=\"#f4f7fa\" stop-opacity=\"0.78\"/>\
<stop offset=\"0.55\" stop-color=\"#bcc6d1\" stop-opacity=\"0.74\"/>\
<stop offset=\"1\" stop-color=\"#6f7d8c\" stop-opacity=\"0.8\"/></radialGradient></defs>";

/// The panel by itself, with a legend of the modes.
pub fn panel(run: &Run, width: f64, height: f64) -> Picture {
    let scene = Scene::of(run);
    let legend = legend(run, width);
    let mut picture = draw(run, &scene, width, height - legend.height);
    picture.marks.place((0.0, height - legend.height), &legend);
    picture.height = height;
    picture
}

/// The scene without a legend.
pub fn draw(run: &Run, scene: &Scene, width: f64, height: f64) -> Picture {
    let (azimuth_deg, elevation_deg) = scene.best_view_deg();
    let camera = Camera::at(azimuth_deg, elevation_deg);
    let view = View::fitting(
        camera,
        &outline(scene, &camera),
        (58.0, 22.0),
        (width - 34.0, height - 46.0),
    );
    let mut marks = Marks::default();
    marks.raw(SHADE);
    let page = Area {
        at: (2.0, 2.0),
        size: (width - 4.0, height - 4.0),
    };
    let mut placement = Placement::within(page);
    floor::draw(scene, &view, &mut marks, &mut placement);

    for sphere in &scene.moving {
        draw_moving(&view, sphere, &mut marks);
    }
    let mut spheres: Vec<&Sphere> = scene.spheres.iter().collect();
    spheres.sort_by(|a, b| {
        camera
            .nearness(a.centre)
            .total_cmp(&camera.nearness(b.centre))
    });
    // How many spheres are painted before a point: those behind it.
    let layer = |point: Vector| {
        let hides = |sphere: &&Sphere| {
            sphere.is_obstacle && camera.is_behind(point, sphere.centre, sphere.radius)
        };
        spheres.iter().position(hides).unwrap_or(spheres.len())
    };
    let strokes = layered_strokes(run, scene, &view, &layer);
    for depth in 0..=spheres.len() {
        for (_, mode, points) in strokes.iter().filter(|stroke| stroke.0 == depth) {
            let mode = &run.modes()[*mode];
            let width = if mode.active.is_empty() { 1.9 } else { 3.4 };
            marks.polyline(points, Stroke::solid(mode.colour, width));
            placement.avoid_curve(points);
        }
        if scene.shows_base && layer([0.0; 3]) == depth {
            floor::triad(scene, &view, &mut marks, &mut placement);
        }
        for target in &scene.targets {
            if layer(target.point) == depth {
                draw_target(&view, target.point, target.acceptance, &mut marks);
            }
        }
        if let Some(sphere) = spheres.get(depth) {
            draw_sphere(&view, sphere, &mut marks);
        }
    }
    callouts::draw(run, scene, &view, &mut marks, &mut placement);
    Picture {
        width,
        height,
        title: describe(scene),
        marks,
    }
}

/// Points that must be on the picture: what is drawn, not the corners of an empty box around it.
fn outline(scene: &Scene, camera: &Camera) -> Vec<Vector> {
    let (low, high) = (scene.low, scene.high);
    let floor = [low[0], high[0]].map(|x| [low[1], high[1]].map(|y| [x, y, low[2]]));
    let mut points: Vec<Vector> = floor.concat();
    points.extend(scene.path.iter().flat_map(|piece| &piece.points));
    points.extend(scene.targets.iter().map(|target| target.point));
    let moving = scene.moving.iter();
    let moving = moving.flat_map(|sphere| [sphere.from, sphere.to].map(|at| (at, sphere.radius)));
    let obstacles = scene
        .obstacles()
        .map(|sphere| (sphere.centre, sphere.radius));
    for (centre, radius) in obstacles.chain(moving) {
        for direction in camera.frame() {
            for reach in [-radius, radius] {
                points.push([0, 1, 2].map(|k| centre[k] + reach * direction[k]));
            }
        }
    }
    if scene.shows_base {
        points.push([0.0; 3]);
        points.extend(floor::axes(scene));
    }
    let left = floor::leftmost_corner(scene, camera);
    points.push([left[0], left[1], high[2]]);
    points
}

/// The path cut where its mode or its place among the spheres changes.
fn layered_strokes(
    run: &Run,
    scene: &Scene,
    view: &View,
    layer: &impl Fn(Vector) -> usize,
) -> Vec<(usize, usize, Vec<Point>)> {
    let mut strokes: Vec<(usize, usize, Vec<Point>)> = Vec::new();
    for piece in &scene.path {
        let mut points = piece
            .points
            .iter()
            .map(|&point| (layer(point), view.place(point)));
        let Some((mut depth, first)) = points.next() else {
            continue;
        };
        let mut stroke = vec![first];
        for (next, place) in points {
            stroke.push(place);
            if next != depth {
                strokes.push((
                    depth,
                    piece.mode,
                    std::mem::replace(&mut stroke, vec![place]),
                ));
                depth = next;
            }
        }
        strokes.push((depth, piece.mode, stroke));
    }
    // Where several modes lie over each other, the one with active sets is on top.
    strokes.sort_by_key(|stroke| !run.modes()[stroke.1].active.is_empty());
    strokes
}

fn draw_sphere(view: &View, sphere: &Sphere, marks: &mut Marks) {
    let (centre, radius) = (view.place(sphere.centre), view.scale * sphere.radius);
    if sphere.is_obstacle {
        marks.circle(
            centre,
            radius,
            "url(#sphere)",
            Stroke::solid("#5f6b78", 0.8),
        );
    } else {
        marks.circle(
            centre,
            radius,
            "none",
            Stroke::dashed(palette::LIMIT, 1.2, "6 4"),
        );
    }
}

/// Dashed where it was at the start, whole where it is at the end, and its way between.
fn draw_moving(view: &View, sphere: &MovingSphere, marks: &mut Marks) {
    let (from, to) = (view.place(sphere.from), view.place(sphere.to));
    let radius = view.scale * sphere.radius;
    let dashed = Stroke::dashed(MOVING, 1.2, "4 3");
    marks.circle(from, radius, "none", dashed);
    marks.circle(to, radius, "url(#sphere)", Stroke::solid(MOVING, 1.0));
    marks.line(from, to, dashed);
    marks.circle(from, 2.0, "#ffffff", Stroke::solid(MOVING, 1.2));
    marks.circle(to, 2.4, MOVING, Stroke::solid(MOVING, 0.0));
}

fn draw_target(view: &View, point: Vector, acceptance: f64, marks: &mut Marks) {
    let at = view.place(point);
    let radius = (view.scale * acceptance).max(3.0);
    marks.circle(at, radius, "none", Stroke::solid(palette::INK, 1.1));
    marks.circle(at, 1.4, palette::INK, Stroke::solid(palette::INK, 0.0));
}

/// Which colour of the path is which mode.
pub fn legend(run: &Run, width: f64) -> Picture {
    const LINE: f64 = 18.0;
    let mut marks = Marks::default();
    let (mut x, mut y) = (16.0, 10.0);
    for mode in run.modes().iter().take(12) {
        let text = lettering::shorten(&mode.label(), LABEL, 0.7 * width);
        let needed = 24.0 + lettering::width(&text, LABEL) + 14.0;
        if x + needed > width && x > 16.0 {
            (x, y) = (16.0, y + LINE);
        }
        let thickness = if mode.active.is_empty() { 1.9 } else { 3.4 };
        marks.line((x, y), (x + 18.0, y), Stroke::solid(mode.colour, thickness));
        marks.text(
            (x + 24.0, y + 4.0),
            &text,
            Lettering::new(LABEL, palette::INK),
        );
        x += needed;
    }
    Picture {
        width,
        height: y + LINE - 4.0,
        title: String::new(),
        marks,
    }
}

fn describe(scene: &Scene) -> String {
    let obstacles = scene.obstacles().count() + scene.moving.len();
    let waypoints = scene.targets.len();
    format!(
        "Path of the tool in three dimensions, with {obstacles} obstacles and {waypoints} waypoints"
    )
}
