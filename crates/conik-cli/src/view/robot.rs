//! The robot as the page has it: enough to know from q where every link is.

use conik::{JointKind, Pose, Robot};
use serde::Serialize;

/// A robot's tree. In the page, with `world_from_body[0]` the identity and the bodies numbered from 1,
///
/// ```text
/// world_from_body[i] = world_from_body[parent] · before · motion(multiplier · q[joint] + offset) · after
/// world_from_link    = world_from_body[body] · placement
/// ```
///
/// Poses are the first three rows of their homogeneous matrices, row by row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobotTree {
    name: String,
    joints: Vec<TreeJoint>,
    bodies: Vec<TreeBody>,
    links: Vec<TreeLink>,
    /// Index of the tool among the links.
    tool: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct TreeJoint {
    name: String,
    kind: Kind,
    /// [rad or m]; `None`: it has none.
    position_limits: Option<[f64; 2]>,
    /// [rad/s or m/s]
    speed_limit: Option<f64>,
    /// [rad/s² or m/s²]
    acceleration_limit: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct TreeBody {
    parent: usize,
    before: [f64; 12],
    after: [f64; 12],
    kind: Kind,
    /// Index of the joint that drives it.
    joint: usize,
    multiplier: f64,
    offset: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct TreeLink {
    name: String,
    body: usize,
    placement: [f64; 12],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Revolute,
    Prismatic,
}

impl RobotTree {
    /// The tree of a robot.
    pub fn of(robot: &Robot) -> Self {
        let joints = robot.joints().iter().map(|joint| TreeJoint {
            name: joint.name.clone(),
            kind: joint.kind.into(),
            position_limits: joint.limits.position.map(|(min, max)| [min, max]),
            speed_limit: joint.limits.speed,
            acceleration_limit: joint.limits.acceleration,
        });
        let bodies = robot.bodies().iter().map(|body| TreeBody {
            parent: body.parent,
            before: rows(&body.placement),
            after: rows(&body.joint_from_body),
            kind: body.kind.into(),
            joint: body.drive.joint,
            multiplier: body.drive.multiplier,
            offset: body.drive.offset,
        });
        let links = robot.links().iter().map(|link| TreeLink {
            name: link.name.clone(),
            body: link.body.index(),
            placement: rows(&link.placement),
        });
        Self {
            name: robot.name().to_owned(),
            joints: joints.collect(),
            bodies: bodies.collect(),
            links: links.collect(),
            tool: robot.tool(),
        }
    }
}

impl From<JointKind> for Kind {
    fn from(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self::Revolute,
            JointKind::Prismatic => Self::Prismatic,
        }
    }
}

fn rows(pose: &Pose) -> [f64; 12] {
    let matrix = pose.to_matrix();
    std::array::from_fn(|i| matrix[i / 4][i % 4])
}

#[cfg(test)]
mod tests {
    use conik::{Body, Frame, Joint, Kinematics, Mimic, RobotBuilder, Vec3};

    use super::*;

    type Matrix = [f64; 12];

    /// The page's formula, in the numbers of the page.
    fn product(a: &Matrix, b: &Matrix) -> Matrix {
        std::array::from_fn(|at| {
            let (row, column) = (at / 4, at % 4);
            let sum: f64 = (0..3).map(|k| a[4 * row + k] * b[4 * k + column]).sum();
            if column == 3 {
                sum + a[4 * row + 3]
            } else {
                sum
            }
        })
    }

    fn motion(kind: Kind, position: f64) -> Matrix {
        let (sin, cos) = position.sin_cos();
        match kind {
            Kind::Revolute => [cos, -sin, 0.0, 0.0, sin, cos, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
            Kind::Prismatic => [
                1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, position,
            ],
        }
    }

    fn world_from_links(tree: &RobotTree, q: &[f64]) -> Vec<Matrix> {
        let mut bodies = vec![rows(&Pose::IDENTITY)];
        for body in &tree.bodies {
            let position = body.multiplier * q[body.joint] + body.offset;
            let joint = product(&bodies[body.parent], &body.before);
            let moved = product(&joint, &motion(body.kind, position));
            bodies.push(product(&moved, &body.after));
        }
        let links = tree.links.iter();
        links
            .map(|link| product(&bodies[link.body], &link.placement))
            .collect()
    }

    fn turned(rotation: [f64; 3], origin: [f64; 3]) -> Pose {
        let turned = |axis: Vec3| axis.turned_by(rotation.into());
        Pose {
            x_axis: turned(Pose::IDENTITY.x_axis),
            y_axis: turned(Pose::IDENTITY.y_axis),
            z_axis: turned(Pose::IDENTITY.z_axis),
            origin: origin.into(),
        }
    }

    /// A rail, a mast that turns about a skew axis, and a gripper of which one finger follows the other.
    fn rail_with_gripper() -> Robot {
        let mut robot = RobotBuilder::new("rail");
        let skew = turned([0.3, -0.8, 0.2], [0.1, 0.2, -0.3]);
        let finger = turned([0.0, 1.1, 0.0], [0.0, 0.05, 0.4]);
        let rail = Joint::prismatic("rail");
        let carriage = robot.joint(Body::FIXED, skew, rail).unwrap();
        let mast = robot
            .joint_between(carriage, finger, Joint::revolute("mast"), skew)
            .unwrap();
        let left = robot.joint(mast, finger, Joint::prismatic("left")).unwrap();
        let follows = Mimic {
            joint: 2,
            multiplier: -1.5,
            offset: 0.02,
        };
        let kind = JointKind::Prismatic;
        let right = robot
            .follower_between(mast, skew, (kind, follows, "right"), finger)
            .unwrap();
        robot.link("floor", Body::FIXED, skew).unwrap();
        robot.link("left", left, finger).unwrap();
        robot.link("right", right, skew).unwrap();
        robot.build().unwrap()
    }

    fn robots() -> Vec<Robot> {
        let base = turned([0.1, 0.2, 2.9], [1.0, -2.0, 0.7]);
        let mut robots: Vec<Robot> = Robot::builtin_names()
            .into_iter()
            .map(|name| Robot::builtin(name).unwrap())
            .collect();
        let ur = Robot::builtin("ur5e").unwrap();
        let flange = turned([1.0, 0.0, 0.5], [0.0, 0.1, 0.2]);
        let tooled = ur.with_frame("torch", Frame::Tool, flange).unwrap();
        robots.push(tooled.with_tool("torch").unwrap().standing_at(base));
        robots.push(rail_with_gripper());
        robots.push(rail_with_gripper().standing_at(base));
        robots
    }

    #[test]
    fn page_knows_where_every_link_is() {
        let mut angle = 0.3;
        for robot in robots() {
            let tree = RobotTree::of(&robot);
            let mut kinematics = Kinematics::new(&robot);
            for _ in 0..20 {
                let q: Vec<f64> = (0..robot.dof())
                    .map(|_| {
                        // A sequence that repeats itself nowhere.
                        angle = (angle * 7.13 + 1.7) % 6.0;
                        angle - 3.0
                    })
                    .collect();
                kinematics.update(&q);
                let links = world_from_links(&tree, &q);
                for (at, link) in links.iter().enumerate() {
                    let pose = rows(kinematics.world_from(Frame::Link(at)));
                    for (ours, theirs) in link.iter().zip(&pose) {
                        let name = robot.name();
                        assert!((ours - theirs).abs() < 1e-12, "{name}, link {at}, q {q:?}");
                    }
                }
                assert_eq!(
                    rows(kinematics.world_from(Frame::Tool)),
                    rows(kinematics.world_from(Frame::Link(tree.tool)))
                );
            }
        }
    }
}
