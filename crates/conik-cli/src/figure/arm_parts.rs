//! The arm as solids: links as tapering tubes from joint to joint, joints as drums about their axes, slides on
//! rails, the tool frame as three coloured axes.

use conik::{
    Capsule, Cuboid, Cylinder, Frame, JointKind, Kinematics, PlacedJoint, Pose, Robot, Shape, Vec3,
};

use super::camera::Vector;
use super::palette::AXES;

/// Links.
const LINK: &str = "#74879b";
/// Joints and the base.
const JOINT: &str = "#16304d";

/// The robot, and what of it is drawn.
#[derive(Debug)]
pub struct Arm<'a> {
    robot: &'a Robot,
    /// Frames at which its branches end.
    tools: Vec<Frame>,
    /// How far it reaches, about [m].
    pub size: f64,
    /// Whether the axes of its tools are among its solids.
    pub shows_axes: bool,
}

/// The arm at one time.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Its solids and their colours.
    pub solids: Vec<(Shape, &'static str)>,
    /// Lines along its links.
    pub lines: Vec<Vec<Vector>>,
}

impl<'a> Arm<'a> {
    /// The arm whose branches end at these links, besides the tool.
    pub fn new(robot: &'a Robot, further_tools: &[String]) -> Self {
        let mut tools = vec![Frame::Tool];
        // The first tool of a scenario is the robot's, or carries it.
        tools.extend(
            further_tools
                .iter()
                .skip(1)
                .filter_map(|link| robot.frame(link)),
        );
        let mut arm = Self {
            robot,
            tools,
            size: 0.0,
            shows_axes: true,
        };
        let longest = |line: &Vec<Vector>| {
            let pairs = line.windows(2);
            pairs
                .map(|pair| (Vec3::from(pair[1]) - Vec3::from(pair[0])).norm())
                .sum::<f64>()
        };
        let at_rest = arm.at(&vec![0.0; robot.dof()]);
        let size = at_rest.lines.iter().map(longest).fold(0.0, f64::max);
        arm.size = if size.is_finite() && size > 1e-3 {
            size
        } else {
            1.0
        };
        arm
    }

    /// The arm at `q`.
    pub fn at(&self, q: &[f64]) -> Drawn {
        let mut kinematics = Kinematics::new(self.robot);
        kinematics.update(q);
        let joints = self.robot.placed_joints(q);
        let base = self.base(&kinematics);
        // Links begin on the plate: a round end in it would reach below.
        let top = base.origin + base.z_axis * self.plate();
        let seated = |point: Vec3| {
            let is_in_plate = (point - base.origin).norm() < self.plate();
            if is_in_plate { top } else { point }
        };
        let mut drawn = Drawn::default();
        let mut steps = vec![0_usize; joints.len()];
        for (nth, joint) in joints.iter().enumerate() {
            let (from, step) = match joint.carried_by {
                Some(carrier) => (joints[carrier].moved.origin, steps[carrier] + 1),
                None => (top, 0),
            };
            steps[nth] = step;
            let radius = self.radius(step, joints.len());
            let (from, to) = (seated(from), seated(joint.frame.origin));
            self.link(from, to, radius, &mut drawn);
            self.joint(joint, &base, radius, &mut drawn);
        }
        for &tool in &self.tools {
            let pose = kinematics.world_from(tool);
            let carrier = self.robot.carrier(tool);
            let from = carrier.map_or(top, |carrier| seated(joints[carrier].moved.origin));
            let step = carrier.map_or(0, |carrier| steps[carrier] + 1);
            self.link(
                from,
                pose.origin,
                self.radius(step, joints.len()),
                &mut drawn,
            );
            if self.shows_axes {
                self.axes(pose, &mut drawn);
            }
            drawn
                .lines
                .push(line_to(&joints, carrier, base.origin, pose.origin));
        }
        let plate = Cylinder::new(base.origin, top, 2.2 * self.radius(0, 1));
        drawn.solids.push((plate.into(), JOINT));
        drawn
    }

    /// The frame that the arm stands on: that of its first link, if it does not move.
    pub fn base(&self, kinematics: &Kinematics) -> Pose {
        let first = Frame::Link(0);
        if self.robot.has(first) && self.robot.carrier(first).is_none() {
            *kinematics.world_from(first)
        } else {
            Pose::IDENTITY
        }
    }

    /// The frames at which its branches end, the tool first.
    pub fn tools(&self, kinematics: &Kinematics) -> Vec<Pose> {
        let tools = self.tools.iter();
        tools.map(|&tool| *kinematics.world_from(tool)).collect()
    }

    /// Thickness of what it stands on [m].
    fn plate(&self) -> f64 {
        1.2 * self.radius(0, 1)
    }

    /// Radius of a link: the farther from the base, the slimmer. Where there are several branches, all are.
    fn radius(&self, step: usize, joints: usize) -> f64 {
        let part = step as f64 / joints.max(1) as f64;
        let branches = if self.tools.len() > 1 { 0.6 } else { 1.0 };
        branches * self.size * (0.034 - 0.016 * part.min(1.0))
    }

    fn link(&self, from: Vec3, to: Vec3, radius: f64, drawn: &mut Drawn) {
        // Joints whose axes meet have nothing between them.
        if self.size > 0.0 && (to - from).norm() > 1e-3 * self.size {
            drawn
                .solids
                .push((Capsule::new(from, to, radius).into(), LINK));
        }
    }

    fn joint(&self, joint: &PlacedJoint, base: &Pose, radius: f64, drawn: &mut Drawn) {
        if self.size == 0.0 {
            return;
        }
        let (at, axis) = (joint.moved.origin, joint.moved.z_axis);
        match joint.kind {
            JointKind::Revolute => {
                let half = axis * (1.35 * radius);
                // One in the base stands on it, not in the floor.
                let is_in_base =
                    (at - base.origin).norm() < self.plate() && axis.dot(base.z_axis).abs() > 0.9;
                let at = if is_in_base {
                    base.origin + base.z_axis * (self.plate() + 1.35 * radius)
                } else {
                    at
                };
                let drum = Cylinder::new(at - half, at + half, 1.3 * radius);
                drawn.solids.push((drum.into(), JOINT));
            }
            JointKind::Prismatic => {
                let limits = self.robot.joints()[joint.driven_by].limits.position;
                let (from, to) = match limits {
                    Some((low, high)) if high - low < 10.0 * self.size => (
                        joint.frame.origin + axis * low,
                        joint.frame.origin + axis * high,
                    ),
                    _ => (joint.frame.origin, at),
                };
                drawn
                    .solids
                    .push((Capsule::new(from, to, 0.4 * radius).into(), LINK));
                let side = 2.4 * radius;
                let slide = Cuboid::new(joint.moved, [side, side, 1.2 * side]);
                drawn.solids.push((slide.into(), JOINT));
            }
        }
    }

    fn axes(&self, tool: &Pose, drawn: &mut Drawn) {
        let (length, radius) = (0.1 * self.size, 0.16 * self.radius(0, 1));
        for (axis, colour) in [tool.x_axis, tool.y_axis, tool.z_axis]
            .into_iter()
            .zip(AXES)
        {
            let tip = tool.origin + axis * length;
            let axis = Capsule::new(tool.origin, tip, radius);
            drawn.solids.push((axis.into(), colour));
        }
    }
}

/// The line from the base through the joints to a tool.
fn line_to(joints: &[PlacedJoint], last: Option<usize>, base: Vec3, tool: Vec3) -> Vec<Vector> {
    let mut line = vec![tool.to_array()];
    let mut next = last;
    while let Some(joint) = next.and_then(|nth| joints.get(nth)) {
        line.push(joint.moved.origin.to_array());
        next = joint.carried_by;
    }
    line.push(base.to_array());
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lead_from_tools_to_the_base() {
        for name in ["ur5-paper", "panda", "iiwa14", "gen3", "ur20"] {
            let robot = Robot::builtin(name).unwrap();
            let q: Vec<f64> = (0..robot.dof()).map(|joint| 0.3 * joint as f64).collect();
            let mut kinematics = Kinematics::new(&robot);
            kinematics.update(&q);
            let arm = Arm::new(&robot, &[]);
            let lines = arm.at(&q).lines;
            let [line] = &lines[..] else {
                panic!("{name}: {} branches", lines.len())
            };
            let tool = kinematics.world_from(Frame::Tool).origin;
            let ends = (line.first().copied(), line.last().copied());
            assert_eq!(ends, (Some(tool.to_array()), Some([0.0; 3])), "{name}");
            assert_eq!(line.len(), robot.dof() + 2, "{name}");
            assert!((0.5..3.0).contains(&arm.size), "{name}: {}", arm.size);
        }
    }

    #[test]
    fn no_part_of_an_upright_arm_is_below_its_base() {
        let robot = Robot::builtin("panda").unwrap();
        let q = [0.0, 0.2, 0.0, -1.8, 0.0, 2.0, 0.7];
        let (x, z) = (Pose::IDENTITY.x_axis, Pose::IDENTITY.z_axis);
        for (shape, _) in Arm::new(&robot, &[]).at(&q).solids {
            for point in super::super::solid::rim(&shape, x, z) {
                assert!(point[2] > -1e-9, "{shape:?}");
            }
        }
    }
}
