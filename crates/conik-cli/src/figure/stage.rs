//! The scene painted from back to front: floor and walls, then solids from far to near, each after the parts
//! of the path that it stands in front of.

use conik::{Pose, Shape, Sphere, Vec3};

use super::axis::range;
use super::callouts;
use super::camera::{Camera, Vector, View};
use super::cone::Cone;
use super::depth::{Placed, back_to_front};
use super::floor;
use super::ink::Stroke;
use super::obstacles::Cell;
use super::palette;
use super::placement::{Area, Placement};
use super::run::Run;
use super::scene::{Scene, Target};
use super::shading::{self, Paint};
use super::solid;
use super::svg::{Marks, Point};
use super::wall;

/// Room above and below what is drawn, for labels [px].
const TOP: f64 = 22.0;
const BOTTOM: f64 = 46.0;

/// A solid of a figure that stands in the scene.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Its shape and its figure.
    pub placed: Placed,
    /// How it is painted.
    pub paint: Paint<'static>,
    /// Opacity of the sheet that all of its figure is on.
    pub sheet: f64,
    /// Whether the path is hidden behind it.
    pub hides: bool,
}

/// A picture of the scene.
#[derive(Debug)]
pub struct Stage<'a> {
    /// The run.
    pub run: &'a Run,
    /// Its scene.
    pub scene: &'a Scene,
    /// What stands in it besides.
    pub parts: Vec<Part>,
    /// Views of the tool.
    pub cones: Vec<Cone>,
    /// Words at points.
    pub notes: Vec<(Vector, String)>,
    /// What stands above the floor, and should not seem to float.
    pub foot: Option<Vector>,
    /// Colours of the axes that the tool should have at a target.
    pub axes: [&'static str; 3],
}

impl Stage<'_> {
    /// The height that a picture of that width needs, if it is less than `most` [px].
    pub fn height(&self, view_deg: (f64, f64), width: f64, most: f64) -> f64 {
        let (view, _) = self.view(view_deg, width, most);
        let outline = self.outline(&view.camera);
        let (top, bottom) = range(outline.into_iter().map(|point| view.place(point).1));
        most.min(bottom - top + TOP + BOTTOM)
    }

    /// The view that fits a picture of that size [px], and the labels that are placed on it.
    pub fn view(&self, view_deg: (f64, f64), width: f64, height: f64) -> (View, Placement) {
        let camera = Camera::at(view_deg.0, view_deg.1);
        let numbers = floor::widest_number(self.scene);
        let view = View::fitting(
            camera,
            &self.outline(&camera),
            (58.0_f64.max(numbers + 14.0), TOP),
            (width - 34.0_f64.max(numbers + 14.0), height - BOTTOM),
        );
        let page = Area {
            at: (2.0, 2.0),
            size: (width - 4.0, height - 4.0),
        };
        (view, Placement::within(page))
    }

    /// Paints it all.
    pub fn paint(&self, view: &View, marks: &mut Marks, placement: &mut Placement) {
        let solids = self.solids();
        let tints = solids.iter().map(|part| part.paint.tint);
        marks.raw(&shading::definitions(tints));
        floor::draw(self.scene, view, marks, placement);
        let (back, front): (Vec<_>, Vec<_>) = self
            .scene
            .around
            .walls
            .iter()
            .partition(|it| wall::is_in_back(it, view));
        for it in back {
            wall::draw(it, self.scene, view, marks);
        }
        self.shadow(view, marks);
        self.keep_words_off(view, placement);
        self.trace(view, marks);
        self.paint_solids(&solids, view, marks, placement);
        for cone in &self.cones {
            cone.draw(view, marks);
        }
        for it in front {
            wall::draw(it, self.scene, view, marks);
        }
        callouts::draw(self.run, self.scene, view, marks, placement);
        for (point, note) in &self.notes {
            callouts::note(view.place(*point), note, marks, placement);
        }
    }

    /// Labels should not stand on the parts that are there to stay.
    fn keep_words_off(&self, view: &View, placement: &mut Placement) {
        let [right, up] = view.camera.frame().map(Vec3::from);
        for part in self.parts.iter().filter(|part| part.hides) {
            let rim = solid::rim(&part.placed.shape, right, up).into_iter();
            placement.avoid_curve(&solid::hull(rim.map(|point| view.place(point)).collect()));
        }
    }

    /// What the parts that are there to stay throw on the floor.
    fn shadow(&self, view: &View, marks: &mut Marks) {
        let parts = self.parts.iter().filter(|part| part.hides);
        marks.open_sheet(0.16);
        for part in parts {
            let (x, y) = (Pose::IDENTITY.x_axis, Pose::IDENTITY.y_axis);
            let rim = solid::rim(&part.placed.shape, x, y).into_iter();
            let floor = rim.map(|it| view.place([it[0], it[1], self.scene.low[2]]));
            marks.polygon(&solid::hull(floor.collect()), "#5f6b78", 1.0);
        }
        marks.close_sheet();
        if let Some([x, y, z]) = self.foot {
            let floor = view.place([x, y, self.scene.low[2]]);
            let dashes = Stroke::dashed("#8e99a6", 1.0, "3 3");
            marks.line(floor, view.place([x, y, z]), dashes);
        }
    }

    /// Obstacles, where those that move were, and the parts.
    fn solids(&self) -> Vec<Part> {
        let mut solids = Vec::new();
        for obstacle in &self.scene.around.obstacles {
            let mut put = |shape: Shape, paint, hides| {
                solids.push(Part {
                    placed: Placed {
                        shape,
                        figure: None,
                        is_hull: false,
                    },
                    paint,
                    sheet: 1.0,
                    hides,
                });
            };
            let paint = Paint::obstacle(obstacle.tint);
            if obstacle.moved.is_some() {
                put(obstacle.at_start(), Paint::past(obstacle.tint), false);
            }
            put(obstacle.shape, paint, obstacle.moved.is_none());
        }
        solids.extend(&self.parts);
        solids
    }

    fn paint_solids(
        &self,
        solids: &[Part],
        view: &View,
        marks: &mut Marks,
        placement: &mut Placement,
    ) {
        let placed: Vec<Placed> = solids.iter().map(|part| part.placed).collect();
        let order = back_to_front(&view.camera, &placed);
        let sorted: Vec<&Part> = order.iter().map(|&nth| &solids[nth]).collect();
        // How many solids are painted before a point: those before the first that hides it.
        let layer = |point: Vector| {
            let hides =
                |part: &&Part| part.hides && solid::hides(&part.placed.shape, &view.camera, point);
            sorted.iter().position(hides).unwrap_or(sorted.len())
        };
        let strokes = self.strokes(view, &layer);
        let mut layers: Vec<Marks> = vec![Marks::default(); sorted.len() + 1];
        for (depth, mode, points) in &strokes {
            let mode = &self.run.modes()[*mode];
            let width = if mode.active.is_empty() { 1.9 } else { 3.4 };
            layers[*depth].polyline(points, Stroke::solid(mode.colour, width));
            placement.avoid_curve(points);
        }
        if self.scene.shows_base {
            let layer = &mut layers[layer([0.0; 3])];
            floor::triad(self.scene, view, layer, placement);
        }
        for target in &self.scene.targets {
            let at = view.place(target.point);
            let radius = (view.scale * target.acceptance).max(3.0);
            let layer = &mut layers[layer(target.point)];
            layer.circle(at, radius, "none", Stroke::solid(palette::INK, 1.1));
            layer.circle(at, 1.4, palette::INK, Stroke::solid(palette::INK, 0.0));
            for (tip, colour) in self.axes_at(target) {
                layer.line(at, view.place(tip), Stroke::dashed(colour, 1.3, "4 1.5"));
            }
        }
        let mut sheet: Option<usize> = None;
        for (depth, between) in layers.iter().enumerate() {
            let part = sorted.get(depth);
            let figure = part
                .filter(|part| part.sheet < 1.0)
                .and_then(|part| part.placed.figure);
            let is_other = sheet != figure || !between.is_empty();
            if sheet.is_some() && is_other {
                marks.close_sheet();
                sheet = None;
            }
            marks.append(between);
            let Some(part) = part else { continue };
            if figure.is_some() && is_other {
                marks.open_sheet(part.sheet);
                sheet = figure;
            }
            shading::draw(view, &part.placed.shape, part.paint, marks);
        }
        if sheet.is_some() {
            marks.close_sheet();
        }
    }

    /// The tips and colours of the axes that the tool should have at a target.
    fn axes_at(&self, target: &Target) -> impl Iterator<Item = (Vector, &'static str)> {
        let (low, high) = (self.scene.low, self.scene.high);
        let length = 0.07 * (Vec3::from(high) - Vec3::from(low)).norm();
        let point = Vec3::from(target.point);
        let axes = target.turn.map(|it| [it.x_axis, it.y_axis, it.z_axis]);
        let tips = axes.into_iter().flatten();
        tips.map(move |axis| (point + axis * length).to_array())
            .zip(self.axes)
    }

    /// The ways of what moves, and what is looked at.
    fn trace(&self, view: &View, marks: &mut Marks) {
        for obstacle in &self.scene.around.obstacles {
            let Some(moved) = obstacle.moved else {
                continue;
            };
            let to = solid::middle(&obstacle.shape).to_array();
            let from = [0, 1, 2].map(|k| to[k] - moved[k]);
            arrow(view.place(from), view.place(to), marks);
        }
        for target in &self.scene.targets {
            arrow(view.place(target.from), view.place(target.point), marks);
        }
        for sight in &self.scene.around.sights {
            let (from, to) = (view.place(sight.from), view.place(sight.to));
            arrow(from, to, marks);
            let (x, y) = to;
            let ink = Stroke::solid(palette::INK, 1.3);
            marks.circle(to, 4.5, "#ffffff", ink);
            marks.line((x - 7.5, y), (x + 7.5, y), ink);
            marks.line((x, y - 7.5), (x, y + 7.5), ink);
        }
        let stroke = Stroke::dashed(palette::LIMIT, 1.2, "6 4");
        for [from, to] in self.scene.around.cells.iter().flat_map(Cell::edges) {
            marks.line(view.place(from), view.place(to), stroke);
        }
        for bound in &self.scene.around.bounds {
            let radius = view.scale * bound.radius;
            marks.circle(view.place(bound.centre), radius, "none", stroke);
        }
    }

    /// Points that must be on the picture: what is drawn, not the corners of an empty box around it.
    fn outline(&self, camera: &Camera) -> Vec<Vector> {
        let scene = self.scene;
        let (low, high) = (scene.low, scene.high);
        let floor = [low[0], high[0]].map(|x| [low[1], high[1]].map(|y| [x, y, low[2]]));
        let mut points: Vec<Vector> = floor.concat();
        points.extend(scene.path.iter().flat_map(|piece| &piece.points));
        let targets = scene.targets.iter();
        points.extend(targets.clone().flat_map(|it| [it.from, it.point]));
        points.extend(targets.flat_map(|it| self.axes_at(it).map(|(tip, _)| tip)));
        let sights = scene.around.sights.iter();
        points.extend(sights.flat_map(|sight| [sight.from, sight.to]));
        points.extend(self.cones.iter().flat_map(Cone::rim));
        let [right, up] = camera.frame().map(Into::into);
        let parts = self.parts.iter().map(|part| part.placed.shape);
        for shape in scene.shapes().chain(parts) {
            points.extend(solid::rim(&shape, right, up));
        }
        for it in &scene.around.walls {
            points.extend(wall::piece(it, scene).into_iter().map(Vec3::to_array));
        }
        points.extend(scene.around.cells.iter().flat_map(Cell::edges).flatten());
        for bound in &scene.around.bounds {
            let sphere = Sphere::new(bound.centre, bound.radius).into();
            points.extend(solid::rim(&sphere, right, up));
        }
        if scene.shows_base {
            points.push([0.0; 3]);
            points.extend(floor::axes(scene));
        }
        let left = floor::leftmost_corner(scene, camera);
        points.push([left[0], left[1], high[2]]);
        points
    }

    /// The path cut where its mode or its place among the solids changes.
    fn strokes(
        &self,
        view: &View,
        layer: &impl Fn(Vector) -> usize,
    ) -> Vec<(usize, usize, Vec<Point>)> {
        let mut strokes: Vec<(usize, usize, Vec<Point>)> = Vec::new();
        for piece in &self.scene.path {
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
                    let cut = std::mem::replace(&mut stroke, vec![place]);
                    strokes.push((depth, piece.mode, cut));
                    depth = next;
                }
            }
            strokes.push((depth, piece.mode, stroke));
        }
        // Where several modes lie over each other, the one with active sets is on top.
        strokes.sort_by_key(|stroke| !self.run.modes()[stroke.1].active.is_empty());
        strokes
    }
}

/// A dashed way with a head at its end.
fn arrow(from: Point, to: Point, marks: &mut Marks) {
    const WAY: &str = "#5f6b78";
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx.hypot(dy);
    if length < 8.0 {
        return;
    }
    let (ux, uy) = (dx / length, dy / length);
    marks.line(from, to, Stroke::dashed(WAY, 1.2, "4 3"));
    marks.circle(from, 2.0, "#ffffff", Stroke::solid(WAY, 1.2));
    let head = [
        to,
        (to.0 - 9.0 * ux - 3.6 * uy, to.1 - 9.0 * uy + 3.6 * ux),
        (to.0 - 9.0 * ux + 3.6 * uy, to.1 - 9.0 * uy - 3.6 * ux),
    ];
    marks.polygon(&head, WAY, 1.0);
}
