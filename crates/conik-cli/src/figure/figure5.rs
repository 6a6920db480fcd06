//! The paper's Figure 5 for one run: the arm at a few times, each in a picture of its own, all seen from the
//! same place, with the frames of its base and its tools.

use conik::{Pose, Sphere, Vec3};

use super::arm::outline;
use super::camera::Vector;
use super::depth::Placed;
use super::frame;
use super::ink::{Lettering, Stroke};
use super::lettering::{BOLD, seconds, shorten};
use super::moments::{self, Moment};
use super::palette;
use super::path::{LABEL, legend};
use super::posed::{Posed, Poser, Role, robot_of};
use super::run::Run;
use super::scene::Scene;
use super::shading::Paint;
use super::stage::{Part, Stage};
use super::svg::{Marks, Picture};
use super::viewpoint::Viewpoint;

/// More times than this are too small to be seen.
pub const MOST: usize = 12;

/// Width of the whole, and of its largest cell [px].
const WIDTH: f64 = 920.0;
const WIDEST: f64 = 640.0;
/// More cells than this stand three abreast, fewer two.
const FEW: usize = 6;
/// Room for the words above a cell, and for the key of the axes [px].
const CAPTION: f64 = 22.0;
const KEY: f64 = 22.0;
/// Length of the axes of the base and of a tool, as parts of the arm's size.
const BASE_AXES: f64 = 0.24;
const TOOL_AXES: f64 = 0.13;

/// The whole figure at the times `at_s` or, without any, at telling ones; `None` if it cannot be told where
/// the arm was.
pub fn picture(run: &Run, at_s: &[f64]) -> Option<Picture> {
    let robot = robot_of(run)?;
    let mut poser = Poser::new(run, &robot);
    // They are drawn over everything else.
    poser.arm.shows_axes = false;
    let moments = moments::chosen(run, &robot, at_s, poser.arm.size);
    let role = Role {
        figure: 0,
        sheet: 1.0,
        hides: true,
    };
    let posed: Vec<Posed> = moments.iter().map(|it| poser.at(it, role)).collect();
    if posed.is_empty() {
        return None;
    }
    let abreast = if posed.len() > FEW {
        3
    } else {
        posed.len().min(2)
    };
    let width = (WIDTH / abreast as f64).min(WIDEST);
    let cells = cells(run, &poser, &moments, posed, width);
    let (high, rows) = (CAPTION + cells[0].height, cells.len().div_ceil(abreast));
    let mut marks = Marks::default();
    for (nth, (cell, moment)) in cells.iter().zip(&moments).enumerate() {
        let (column, row) = (nth % abreast, nth / abreast);
        let (x, y) = (column as f64 * width, row as f64 * high);
        caption(run, moment, (x + 14.0, y + 16.0), width - 24.0, &mut marks);
        marks.place((x, y + CAPTION), cell);
    }
    let (across, top) = (width * abreast as f64, high * rows as f64);
    key((16.0, top + 10.0), &mut marks);
    let legend = legend(run, across);
    marks.place((0.0, top + KEY), &legend);
    let times: Vec<String> = moments.iter().map(|it| seconds(it.t_s)).collect();
    Some(Picture {
        width: across,
        height: top + KEY + legend.height,
        title: format!(
            "{}: the arm at {}, with the frames of its base and its tool",
            run.title(),
            times.join(", ")
        ),
        marks,
    })
}

/// The arm at each moment, on one stage: nothing but what moved looks different.
fn cells(
    run: &Run,
    poser: &Poser,
    moments: &[Moment],
    posed: Vec<Posed>,
    width: f64,
) -> Vec<Picture> {
    let mut parts: Vec<Part> = posed.iter().flat_map(|it| it.parts.clone()).collect();
    let size = poser.arm.size;
    // The arrows must be on the picture too.
    parts.extend(posed.iter().flat_map(|it| tips(it, size)));
    let lines: Vec<Vec<Vector>> = posed.iter().flat_map(|it| it.lines.clone()).collect();
    let whole = Scene::with(run, &outline(&parts));
    let viewpoint = Viewpoint {
        scene: &whole,
        figures: &lines,
        last: lines.clone(),
        screens: &[],
    };
    let view_deg = viewpoint.best_deg();
    let stage = Stage {
        run,
        scene: &whole,
        parts,
        cones: posed.iter().flat_map(|it| it.cones.clone()).collect(),
        notes: Vec::new(),
        foot: None,
        axes: palette::AXES_OF_PAPER,
    };
    let height = stage.height(view_deg, width, width);
    let cell = |(moment, posed): (&Moment, Posed)| {
        let run = run.until(moment.t_s);
        let scene = Scene {
            low: whole.low,
            high: whole.high,
            step: whole.step,
            ..Scene::with(&run, &outline(&posed.parts))
        };
        let frames = frames(&posed, size);
        let (view, mut placement) = stage.view(view_deg, width, height);
        let mut marks = Marks::default();
        let stage = Stage {
            run: &run,
            scene: &scene,
            parts: posed.parts,
            cones: posed.cones,
            notes: Vec::new(),
            foot: Some(posed.base.origin.to_array()),
            axes: palette::AXES_OF_PAPER,
        };
        stage.paint(&view, &mut marks, &mut placement);
        for (pose, length) in frames {
            frame::draw(&pose, length, &view, &mut marks, &mut placement);
        }
        Picture {
            width,
            height,
            title: String::new(),
            marks,
        }
    };
    moments.iter().zip(posed).map(cell).collect()
}

/// The frames of base and tools, and how long their axes are [m].
fn frames(posed: &Posed, size: f64) -> Vec<(Pose, f64)> {
    let tools = posed.tools.iter().map(|&tool| (tool, TOOL_AXES * size));
    let base = (posed.base, BASE_AXES * size);
    [base].into_iter().chain(tools).collect()
}

/// What is as large as the tips of the frames' axes.
fn tips(posed: &Posed, size: f64) -> Vec<Part> {
    let tip = |point: Vec3| Part {
        placed: Placed {
            shape: Sphere::new(point.to_array(), 1e-3 * size).into(),
            figure: None,
            is_hull: false,
        },
        paint: Paint::part(palette::INK),
        sheet: 1.0,
        hides: false,
    };
    let of_frame = |(pose, length): (Pose, f64)| {
        let axes = [pose.x_axis, pose.y_axis, pose.z_axis];
        axes.map(|axis| tip(pose.origin + axis * length))
    };
    frames(posed, size).into_iter().flat_map(of_frame).collect()
}

/// The time, and what was active then.
fn caption(run: &Run, moment: &Moment, at: (f64, f64), room: f64, marks: &mut Marks) {
    let spans = run.spans().iter().rev();
    let mode = spans
        .filter(|span| span.from_s <= moment.t_s)
        .map(|span| &run.modes()[span.mode])
        .next();
    let time = format!("t = {}", seconds(moment.t_s));
    let bold = Lettering::new(12.0, palette::INK).bold();
    marks.text(at, &time, bold);
    let Some(mode) = mode else { return };
    let x = at.0 + BOLD * super::lettering::width(&time, 12.0) + 10.0;
    let label = shorten(&mode.label(), LABEL, room - (x - at.0));
    marks.text((x, at.1), &label, Lettering::new(LABEL, mode.colour));
}

/// Which colour is which axis.
fn key((mut x, y): (f64, f64), marks: &mut Marks) {
    let style = Lettering::new(LABEL, palette::INK);
    let words = "axes of base and tool, in the colours of the paper:";
    marks.text((x, y + 4.0), words, style);
    x += super::lettering::width(words, LABEL) + 10.0;
    for (name, colour) in ["x", "y", "z"].into_iter().zip(palette::AXES_OF_PAPER) {
        marks.line((x, y), (x + 18.0, y), Stroke::solid(colour, 2.4));
        marks.text((x + 23.0, y + 4.0), name, style);
        x += 42.0;
    }
}
