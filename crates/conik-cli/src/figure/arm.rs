//! Panel: the arm in the scene at a few telling times, with what it keeps away from and where it looks.

use conik::Shape;

use super::camera::Vector;
use super::lettering::seconds;
use super::moments::{self, Moment};
use super::palette;
use super::path::legend;
use super::posed::{Poser, Role, robot_of};
use super::run::Run;
use super::scene::Scene;
use super::solid;
use super::stage::{Part, Stage};
use super::svg::{Marks, Picture};
use super::viewpoint::Viewpoint;

/// The panel with a legend of the modes, at the times `at_s` or, without any, at telling ones; `None` if it
/// cannot be told where the arm was.
pub fn panel(run: &Run, at_s: &[f64], width: f64, height: f64) -> Option<Picture> {
    let robot = robot_of(run)?;
    let poser = Poser::new(run, &robot);
    let moments = moments::chosen(run, &robot, at_s, poser.arm.size);
    let legend = legend(run, width);
    let mut picture = draw(run, &poser, &moments, width, height - legend.height)?;
    picture.marks.place((0.0, picture.height), &legend);
    picture.height += legend.height;
    Some(picture)
}

fn draw(run: &Run, poser: &Poser, moments: &[Moment], width: f64, height: f64) -> Option<Picture> {
    let (mut parts, mut cones, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    let mut lines: Vec<Vec<Vector>> = Vec::new();
    let mut last = None;
    for (figure, moment) in moments.iter().enumerate() {
        let is_last = figure + 1 == moments.len();
        let role = Role {
            figure,
            // The earlier, the lighter.
            sheet: if is_last {
                1.0
            } else {
                0.24 + 0.3 * figure as f64 / moments.len() as f64
            },
            hides: is_last,
        };
        let posed = poser.at(moment, role);
        // The start has a name already.
        if moment.t_s > run.period_s().0 {
            let tool = posed.tools.first()?.origin.to_array();
            notes.push((tool, format!("{:.1}\u{a0}s", moment.t_s)));
        }
        parts.extend(posed.parts);
        cones.extend(posed.cones);
        lines.extend(posed.lines.clone());
        last = Some((posed.lines, posed.base));
    }
    let (last, base) = last?;
    let scene = Scene::with(run, &outline(&parts));
    let screens: Vec<Shape> = parts
        .iter()
        .filter(|part| part.hides)
        .map(|part| part.placed.shape)
        .collect();
    let viewpoint = Viewpoint {
        scene: &scene,
        figures: &lines,
        last,
        screens: &screens,
    };
    let stage = Stage {
        run,
        scene: &scene,
        parts,
        cones,
        notes,
        foot: Some(base.origin.to_array()),
        axes: palette::AXES,
    };
    let height = stage.height(viewpoint.best_deg(), width, height);
    let (view, mut placement) = stage.view(viewpoint.best_deg(), width, height);
    let mut marks = Marks::default();
    stage.paint(&view, &mut marks, &mut placement);
    Some(Picture {
        width,
        height,
        title: describe(moments),
        marks,
    })
}

/// Points around the parts, as far out as they reach along the axes of the world.
pub(super) fn outline(parts: &[Part]) -> Vec<Vector> {
    let world = conik::Pose::IDENTITY;
    let [x, y, z] = [world.x_axis, world.y_axis, world.z_axis];
    let rim = |part: &Part| {
        let shape = &part.placed.shape;
        [solid::rim(shape, x, y), solid::rim(shape, y, z)].concat()
    };
    parts.iter().flat_map(rim).collect()
}

fn describe(moments: &[Moment]) -> String {
    let times: Vec<String> = moments.iter().map(|it| seconds(it.t_s)).collect();
    format!("The arm at {}, with the path of the tool", times.join(", "))
}
