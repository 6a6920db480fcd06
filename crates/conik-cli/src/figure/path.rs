//! Panel: the tool's path in three dimensions among obstacles and waypoints (Fig. 4a-c).

use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::run::Run;
use super::scene::Scene;
use super::stage::Stage;
use super::svg::{Marks, Picture};
use super::viewpoint::Viewpoint;

/// Size of labels [px].
pub const LABEL: f64 = 11.0;

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
    let stage = Stage {
        run,
        scene,
        parts: Vec::new(),
        cones: Vec::new(),
        notes: Vec::new(),
        foot: None,
        axes: palette::AXES,
    };
    let (view, mut placement) = stage.view(view_deg(scene), width, height);
    let mut marks = Marks::default();
    stage.paint(&view, &mut marks, &mut placement);
    Picture {
        width,
        height,
        title: describe(scene),
        marks,
    }
}

/// From where the scene is looked at, azimuth and elevation.
pub fn view_deg(scene: &Scene) -> (f64, f64) {
    let viewpoint = Viewpoint {
        scene,
        figures: &[],
        last: Vec::new(),
        screens: &[],
    };
    viewpoint.best_deg()
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
    let obstacles = scene.around.obstacles.len() + scene.around.walls.len();
    let waypoints = scene.targets.len();
    format!(
        "Path of the tool in three dimensions, with {obstacles} obstacles and {waypoints} waypoints"
    )
}
