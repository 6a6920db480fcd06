//! A frame drawn over everything else: three arrows with their names, in the colours of the paper's Figure 5.

use conik::Pose;

use super::camera::View;
use super::ink::{Lettering, Stroke};
use super::palette::AXES_OF_PAPER;
use super::placement::{Area, Placement};
use super::svg::{Marks, Point};

/// Thickness of the axes and of the white rim around them [px].
const THICK: f64 = 2.4;
const RIM: f64 = 4.6;
/// An axis shorter than this on paper points at the viewer, or away [px].
const SHORT: f64 = 5.0;
/// Size of its name [px].
const NAME: f64 = 11.0;

/// Draws the frame with axes so long [m].
pub fn draw(pose: &Pose, length: f64, view: &View, marks: &mut Marks, placement: &mut Placement) {
    let axes = [pose.x_axis, pose.y_axis, pose.z_axis];
    let mut arrows: Vec<_> = axes
        .iter()
        .zip(AXES_OF_PAPER)
        .zip(["x", "y", "z"])
        .collect();
    // The nearest last.
    let nearness = |axis: &conik::Vec3| view.camera.nearness(axis.to_array());
    arrows.sort_by(|a, b| nearness(a.0.0).total_cmp(&nearness(b.0.0)));
    let origin = view.place(pose.origin.to_array());
    for ((axis, colour), name) in arrows {
        let tip = view.place((pose.origin + *axis * length).to_array());
        let (dx, dy) = (tip.0 - origin.0, tip.1 - origin.1);
        let long = dx.hypot(dy);
        if long < SHORT {
            marks.circle(origin, 3.2, colour, Stroke::solid("#ffffff", 1.2));
            continue;
        }
        let (ux, uy) = (dx / long, dy / long);
        arrow(origin, tip, (ux, uy), colour, marks);
        placement.avoid_curve(&[origin, tip]);
        let at = (tip.0 + 9.0 * ux, tip.1 + 9.0 * uy + 0.36 * NAME);
        let style = Lettering::new(NAME, colour).anchored("middle").bold();
        placement.avoid(Area::of_text(at, name, &style));
        marks.text(at, name, style.rimmed());
    }
}

fn arrow(from: Point, tip: Point, (ux, uy): Point, colour: &str, marks: &mut Marks) {
    let head = |long: f64, wide: f64| {
        let foot = (tip.0 - long * ux, tip.1 - long * uy);
        [
            tip,
            (foot.0 - wide * uy, foot.1 + wide * ux),
            (foot.0 + wide * uy, foot.1 - wide * ux),
        ]
    };
    let neck = (tip.0 - 4.0 * ux, tip.1 - 4.0 * uy);
    marks.line(from, tip, Stroke::solid("#ffffff", RIM));
    marks.line(from, neck, Stroke::solid(colour, THICK));
    marks.polygon(&head(8.0, 3.6), colour, 1.0);
}
