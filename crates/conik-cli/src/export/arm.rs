//! The arm as it is shown: a limb from each joint to those that it carries, a drum about each axis.

use conik::{Capsule, Cuboid, Cylinder, JointKind, Pose, Robot, Shape, Vec3};

use super::frames::FrameTree;
use super::primitive::{self, Colour, colour};
use super::protobuf::Message;

/// Radius of the first limb, and of the last, as a share of the arm's length.
const THICK: f64 = 0.045;
const THIN: f64 = 0.022;

/// The robot's bodies as shapes, each in the body's own frame.
#[derive(Debug)]
pub struct Arm {
    parts: Vec<(usize, Shape, Part)>,
    /// From its base along its joints to the tool [m].
    pub length: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Limb,
    Joint,
}

impl Part {
    fn colour(self) -> Colour {
        match self {
            Self::Limb => colour("#9aa7b5", 1.0),
            Self::Joint => colour("#3d5f82", 1.0),
        }
    }
}

impl Arm {
    /// The arm of that robot.
    pub fn of(robot: &Robot) -> Self {
        let length = length(robot);
        let mut arm = Self {
            parts: Vec::new(),
            length,
        };
        for (index, body) in robot.bodies().iter().enumerate() {
            let radius = arm.radius(robot, index + 1);
            let (at, axis) = (body.placement.origin, body.placement.z_axis);
            arm.limb(body.parent, start(robot, body.parent), at, radius);
            match body.kind {
                JointKind::Revolute => {
                    let half = axis * (1.4 * radius);
                    let drum = Cylinder::new(at - half, at + half, 1.3 * radius);
                    arm.parts.push((body.parent, drum.into(), Part::Joint));
                }
                JointKind::Prismatic => {
                    let limits = robot.joints()[body.drive.joint].limits.position;
                    let way = |position: f64| body.drive.multiplier * position + body.drive.offset;
                    let (low, high) =
                        limits.map_or((0.0, 0.0), |(low, high)| (way(low), way(high)));
                    arm.limb(body.parent, at + axis * low, at + axis * high, 0.5 * radius);
                    let side = 2.4 * radius;
                    let slide = Cuboid::new(body.joint_from_body.inverse(), [side, side, side]);
                    arm.parts.push((index + 1, slide.into(), Part::Joint));
                }
            }
        }
        let tool = &robot.links()[robot.tool()];
        let body = tool.body.index();
        let radius = 0.8 * arm.radius(robot, body);
        arm.limb(body, start(robot, body), tool.placement.origin, radius);
        arm
    }

    /// Adds an entity for each body to a `foxglove.SceneUpdate`.
    pub fn show(&self, frames: &FrameTree, update: &mut Message) {
        let mut bodies: Vec<usize> = self.parts.iter().map(|part| part.0).collect();
        bodies.sort_unstable();
        bodies.dedup();
        for body in bodies {
            let (frame, placement) = frames.of_body(body);
            let frame_from_body = placement.inverse();
            let id = format!("arm/{frame}");
            primitive::entity(update, (frame, &id), 0, |entity| {
                for (_, shape, part) in self.parts.iter().filter(|part| part.0 == body) {
                    let placed = shape.placed(&frame_from_body);
                    primitive::shape(entity, &placed, part.colour(), self.length);
                }
            });
        }
    }

    /// The farther from the base, the slimmer.
    fn radius(&self, robot: &Robot, body: usize) -> f64 {
        let share = body as f64 / robot.bodies().len().max(1) as f64;
        self.length * (THICK + (THIN - THICK) * share)
    }

    fn limb(&mut self, body: usize, from: Vec3, to: Vec3, radius: f64) {
        // Joints whose axes meet have nothing between them.
        if (to - from).norm() > 0.004 * self.length {
            let limb = Capsule::new(from, to, radius).into();
            self.parts.push((body, limb, Part::Limb));
        }
    }
}

/// Where the limbs of a body begin: at its joint; those of what does not move, at the base.
fn start(robot: &Robot, body: usize) -> Vec3 {
    if let Some(index) = body.checked_sub(1) {
        return robot.bodies()[index].joint_from_body.inverse().origin;
    }
    let base = robot.links().iter().find(|link| link.body.index() == 0);
    base.map_or(Pose::IDENTITY, |link| link.placement).origin
}

/// From the base along the joints to the tool [m]; 1 if that is nothing.
fn length(robot: &Robot) -> f64 {
    let tool = &robot.links()[robot.tool()];
    let (mut body, mut end, mut length) = (tool.body.index(), tool.placement.origin, 0.0);
    loop {
        length += (end - start(robot, body)).norm();
        let Some(index) = body.checked_sub(1) else {
            break;
        };
        end = robot.bodies()[index].placement.origin;
        body = robot.bodies()[index].parent;
    }
    if length.is_finite() && length > 1e-3 {
        length
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_are_as_long_as_their_links() {
        // Table I of the paper. The axes of elbow and first wrist joint are parallel, so that the limb
        // between them has no bend.
        let expected = 0.089 + 0.425 + 0.392_f64.hypot(0.109) + 0.095 + 0.082;
        let arm = Arm::of(&Robot::builtin("ur5-paper").unwrap());
        assert!((arm.length - expected).abs() < 1e-12, "{}", arm.length);
        assert_eq!(arm.parts.iter().filter(|it| it.2 == Part::Joint).count(), 6);
    }

    #[test]
    fn limbs_join_each_joint_with_the_next() {
        for name in Robot::builtin_names() {
            let robot = Robot::builtin(name).unwrap();
            let arm = Arm::of(&robot);
            for (index, body) in robot.bodies().iter().enumerate() {
                let end = body.placement.origin;
                let gap = (end - start(&robot, body.parent)).norm();
                let is_met = arm.parts.iter().any(|(on, shape, _)| match shape {
                    Shape::Capsule(limb) => {
                        *on == body.parent && (limb.ends()[1] - end).norm() < 1e-12
                    }
                    _ => false,
                });
                assert!(is_met || gap <= 0.004 * arm.length, "{name}, joint {index}");
            }
        }
    }
}
