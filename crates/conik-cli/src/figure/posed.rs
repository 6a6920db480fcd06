//! The arm as it stands at one moment: its solids, the shapes on its links and its views, ready for a
//! stage.

use conik::{Kinematics, Pose, Robot, Shape};
use conik_sim::scenario::RobotSource;

use super::arm_parts::Arm;
use super::camera::Vector;
use super::cone::{self, Cone};
use super::depth::Placed;
use super::moments::Moment;
use super::run::Run;
use super::shading::{NEUTRAL, Paint};
use super::stage::Part;

/// Length of a cone that has no end, as part of the arm's size.
const CONE: f64 = 0.2;

/// The robot of a run, if it is the one that the log tells of.
pub fn robot_of(run: &Run) -> Option<Robot> {
    let scenario = &run.summary().settings.scenario;
    let robot = scenario.robot.described().ok()?;
    (robot.dof() == scenario.robot.q0_rad.len()).then_some(robot)
}

/// Whoever poses: the arm of a run.
#[derive(Debug)]
pub struct Poser<'a> {
    run: &'a Run,
    robot: &'a Robot,
    /// What of the arm is drawn.
    pub arm: Arm<'a>,
    /// The shapes on its links, and the links.
    shells: Vec<(&'a str, Shape)>,
}

/// How the arm at one moment stands among others.
#[derive(Clone, Copy, Debug)]
pub struct Role {
    /// Its number in the picture.
    pub figure: usize,
    /// Opacity of its sheet.
    pub sheet: f64,
    /// Whether it hides the path behind it.
    pub hides: bool,
}

/// The arm at one moment.
#[derive(Debug)]
pub struct Posed {
    /// Its solids.
    pub parts: Vec<Part>,
    /// Its views.
    pub cones: Vec<Cone>,
    /// Lines along its links.
    pub lines: Vec<Vec<Vector>>,
    /// The frame that it stands on.
    pub base: Pose,
    /// The frames at which its branches end, the tool first.
    pub tools: Vec<Pose>,
}

impl<'a> Poser<'a> {
    /// The arm of a run.
    pub fn new(run: &'a Run, robot: &'a Robot) -> Self {
        let scenario = &run.summary().settings.scenario;
        let further_tools = match &scenario.robot.source {
            RobotSource::Urdf(file) => &file.tool[..],
            RobotSource::Model { .. } => &[],
        };
        let shapes = scenario.collision.shapes.iter();
        Self {
            run,
            robot,
            arm: Arm::new(robot, further_tools),
            shells: shapes
                .map(|it| (it.link.as_str(), it.geometry.shape()))
                .collect(),
        }
    }

    /// The arm at a moment.
    pub fn at(&self, moment: &Moment, role: Role) -> Posed {
        let mut kinematics = Kinematics::new(self.robot);
        kinematics.update(&moment.q);
        let mut parts = Vec::new();
        let mut put = |shape: Shape, paint: Paint<'static>, is_hull: bool| {
            parts.push(Part {
                placed: Placed {
                    shape,
                    figure: Some(role.figure),
                    is_hull,
                },
                paint,
                sheet: role.sheet,
                hides: role.hides && !is_hull,
            });
        };
        let drawn = self.arm.at(&moment.q);
        for (shape, tint) in drawn.solids {
            put(shape, Paint::part(tint), false);
        }
        for (link, shape) in &self.shells {
            if let Some(frame) = self.robot.frame(link) {
                let placed = shape.placed(kinematics.world_from(frame));
                put(placed, Paint::shell(NEUTRAL), true);
            }
        }
        Posed {
            parts,
            cones: cone::of(
                self.run,
                self.robot,
                (moment.t_s, &kinematics),
                CONE * self.arm.size,
                role.sheet,
            ),
            lines: drawn.lines,
            base: self.arm.base(&kinematics),
            tools: self.arm.tools(&kinematics),
        }
    }
}
