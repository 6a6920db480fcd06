//! Panel: the arm in the scene at a few telling times, with what it keeps away from and where it looks.

use conik::{Kinematics, Robot, Shape};
use conik_sim::scenario::RobotSource;

use super::arm_parts::Arm;
use super::camera::Vector;
use super::cone;
use super::depth::Placed;
use super::lettering::seconds;
use super::moments::{self, Moment};
use super::path::legend;
use super::run::Run;
use super::scene::Scene;
use super::shading::{NEUTRAL, Paint};
use super::solid;
use super::stage::{Part, Stage};
use super::svg::{Marks, Picture};
use super::viewpoint::Viewpoint;

/// The panel with a legend of the modes; `None` if it cannot be told where the arm was.
pub fn panel(run: &Run, width: f64, height: f64) -> Option<Picture> {
    let scenario = &run.summary().settings.scenario;
    let robot = scenario.robot.described().ok()?;
    if robot.dof() != scenario.robot.q0_rad.len() {
        return None;
    }
    let further_tools = match &scenario.robot.source {
        RobotSource::Urdf(file) => &file.tool[..],
        RobotSource::Model { .. } => &[],
    };
    let arm = Arm::new(&robot, further_tools);
    let moments = moments::of(run, &robot, arm.size);
    let legend = legend(run, width);
    let mut picture = draw(run, &robot, &arm, &moments, width, height - legend.height)?;
    picture.marks.place((0.0, picture.height), &legend);
    picture.height += legend.height;
    Some(picture)
}

fn draw(
    run: &Run,
    robot: &Robot,
    arm: &Arm,
    moments: &[Moment],
    width: f64,
    height: f64,
) -> Option<Picture> {
    let last = moments.last()?;
    let mut kinematics = Kinematics::new(robot);
    let shells = shells(run);
    let (mut parts, mut cones, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    let mut lines: Vec<Vec<Vector>> = Vec::new();
    for (figure, moment) in moments.iter().enumerate() {
        let is_last = figure + 1 == moments.len();
        // The earlier, the lighter.
        let sheet = if is_last {
            1.0
        } else {
            0.24 + 0.3 * figure as f64 / moments.len() as f64
        };
        let mut put = |shape: Shape, paint: Paint<'static>, is_hull: bool| {
            parts.push(Part {
                placed: Placed {
                    shape,
                    figure: Some(figure),
                    is_hull,
                },
                paint,
                sheet,
                hides: is_last && !is_hull,
            });
        };
        let drawn = arm.at(&moment.q);
        for (shape, tint) in drawn.solids {
            put(shape, Paint::part(tint), false);
        }
        kinematics.update(&moment.q);
        for (link, shape) in &shells {
            if let Some(frame) = robot.frame(link) {
                let placed = shape.placed(kinematics.world_from(frame));
                put(placed, Paint::shell(NEUTRAL), true);
            }
        }
        lines.extend(drawn.lines);
        cones.extend(cone::of(
            run,
            robot,
            (moment.t_s, &kinematics),
            0.2 * arm.size,
            sheet,
        ));
        let tool = kinematics.world_from(conik::Frame::Tool).origin.to_array();
        // The start has a name already.
        if figure > 0 {
            notes.push((tool, format!("{:.1}\u{a0}s", moment.t_s)));
        }
    }
    let [x, y, z] = axes();
    let rim = |part: &Part| {
        let shape = &part.placed.shape;
        [solid::rim(shape, x, y), solid::rim(shape, y, z)].concat()
    };
    let points: Vec<Vector> = parts.iter().flat_map(rim).collect();
    let scene = Scene::with(run, &points);
    let screens: Vec<Shape> = parts
        .iter()
        .filter(|part| part.hides)
        .map(|part| part.placed.shape)
        .collect();
    let viewpoint = Viewpoint {
        scene: &scene,
        figures: &lines,
        last: arm.at(&last.q).lines,
        screens: &screens,
    };
    let stage = Stage {
        run,
        scene: &scene,
        parts,
        cones,
        notes,
        foot: Some(arm.base(&kinematics).origin.to_array()),
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

fn axes() -> [conik::Vec3; 3] {
    let world = conik::Pose::IDENTITY;
    [world.x_axis, world.y_axis, world.z_axis]
}

/// The shapes on links, and the links.
fn shells(run: &Run) -> Vec<(&str, Shape)> {
    let shapes = run.summary().settings.scenario.collision.shapes.iter();
    shapes
        .map(|it| (it.link.as_str(), it.geometry.shape()))
        .collect()
}

fn describe(moments: &[Moment]) -> String {
    let times: Vec<String> = moments.iter().map(|it| seconds(it.t_s)).collect();
    format!("The arm at {}, with the path of the tool", times.join(", "))
}
