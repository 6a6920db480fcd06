//! The robot's frames as a tree: each link under the one that carries it.

use conik::{Body, Pose, Robot};

/// What everything stands in.
pub const WORLD: &str = "world";

/// A frame in another.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// The other.
    pub parent: String,
    /// The frame.
    pub child: String,
    /// Where the frame is in the other.
    pub pose: Pose,
}

/// The tree of a robot's frames.
///
/// Of each body its first link stands for the body, under that of the body that carries it; a joint moves
/// it there. The other links are fixed to it.
#[derive(Clone, Debug)]
pub struct FrameTree {
    robot: Robot,
    links: Vec<String>,
    bodies: Vec<BodyFrame>,
}

/// The frame that stands for a body.
#[derive(Clone, Debug)]
struct BodyFrame {
    name: String,
    /// Where it is in the body.
    placement: Pose,
}

impl FrameTree {
    /// The tree of that robot.
    pub fn of(robot: &Robot) -> Self {
        let links: Vec<String> = robot.links().iter().map(|link| link.name.clone()).collect();
        let name = |link: usize| match links[link].as_str() {
            // The name is that of what everything stands in.
            WORLD if !is_world(robot, link) => "link/world".to_owned(),
            name => name.to_owned(),
        };
        let links: Vec<String> = (0..links.len()).map(name).collect();
        let first_on = |body: usize| {
            let link = robot.links().iter().position(|it| it.body.index() == body);
            match link {
                Some(link) => BodyFrame {
                    name: links[link].clone(),
                    placement: robot.links()[link].placement,
                },
                None => BodyFrame {
                    name: format!("body/{body}"),
                    placement: Pose::IDENTITY,
                },
            }
        };
        let world = BodyFrame {
            name: WORLD.to_owned(),
            placement: Pose::IDENTITY,
        };
        let moved = (1..=robot.bodies().len()).map(first_on);
        Self {
            bodies: [world].into_iter().chain(moved).collect(),
            robot: robot.clone(),
            links,
        }
    }

    /// Name of the frame of a link.
    pub fn of_link(&self, link: &str) -> Option<&str> {
        let place = self.robot.links().iter().position(|it| it.name == link);
        place.map(|place| self.links[place].as_str())
    }

    /// Name of the frame that stands for a body, and where it is in the body.
    pub fn of_body(&self, body: usize) -> (&str, &Pose) {
        let frame = &self.bodies[body];
        (&frame.name, &frame.placement)
    }

    /// Frames that do not move in their parents.
    pub fn fixed(&self) -> Vec<Edge> {
        let links = self.robot.links().iter().zip(&self.links);
        let edges = links.map(|(link, name)| {
            let on = &self.bodies[link.body.index()];
            Edge {
                parent: on.name.clone(),
                child: name.clone(),
                pose: on.placement.inverse() * link.placement,
            }
        });
        edges.filter(|edge| edge.parent != edge.child).collect()
    }

    /// Frames that joints move in their parents, at `q` [rad or m], handed one by one to `take`: parent,
    /// frame, and where the frame is in the parent.
    pub fn moved(&self, q: &[f64], mut take: impl FnMut(&str, &str, &Pose)) {
        let joints = self.robot.placed_joints(q);
        let body = |index: usize| match index {
            0 => Pose::IDENTITY,
            index => joints[index - 1].body,
        };
        for (nth, moved) in self.robot.bodies().iter().enumerate() {
            let (on, frame) = (&self.bodies[moved.parent], &self.bodies[nth + 1]);
            let world_from_parent = body(moved.parent) * on.placement;
            let pose = world_from_parent.inverse() * (body(nth + 1) * frame.placement);
            take(&on.name, &frame.name, &pose);
        }
    }
}

/// Whether a link of that name is what everything stands in.
fn is_world(robot: &Robot, link: usize) -> bool {
    let link = &robot.links()[link];
    link.body == Body::FIXED && link.placement == Pose::IDENTITY
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use conik::{Frame, Kinematics};

    use super::*;

    fn world_from_frames(tree: &FrameTree, q: &[f64]) -> BTreeMap<String, Pose> {
        let mut edges = tree.fixed();
        tree.moved(q, |parent, child, pose| {
            edges.push(Edge {
                parent: parent.to_owned(),
                child: child.to_owned(),
                pose: *pose,
            });
        });
        let mut known = BTreeMap::from([(WORLD.to_owned(), Pose::IDENTITY)]);
        while known.len() <= edges.len() {
            let before = known.len();
            for edge in &edges {
                if let Some(&parent) = known.get(&edge.parent) {
                    known.insert(edge.child.clone(), parent * edge.pose);
                }
            }
            assert!(known.len() > before, "not one tree: {edges:?}");
        }
        known
    }

    #[test]
    fn chains_of_transforms_lead_to_every_link() {
        let mut robots: Vec<Robot> = Robot::builtin_names()
            .into_iter()
            .map(|name| Robot::builtin(name).unwrap())
            .collect();
        let base = Pose {
            origin: [1.0, -2.0, 0.7].into(),
            ..Pose::turned([0.1, 0.2, 2.9].into())
        };
        robots.push(Robot::builtin("panda").unwrap().standing_at(base));
        for robot in robots {
            let q: Vec<f64> = (0..robot.dof()).map(|at| 0.4 * at as f64 - 0.9).collect();
            let mut kinematics = Kinematics::new(&robot);
            kinematics.update(&q);
            let tree = FrameTree::of(&robot);
            let frames = world_from_frames(&tree, &q);
            for (at, name) in robot.link_names().enumerate() {
                let found = frames[tree.of_link(name).unwrap()].to_matrix();
                let expected = kinematics.world_from(Frame::Link(at)).to_matrix();
                for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
                    assert!((found - expected).abs() < 1e-12, "{}, {name}", robot.name());
                }
            }
        }
    }

    #[test]
    fn link_called_world_that_is_elsewhere_has_another_name() {
        let robot = Robot::builtin("ur5e").unwrap();
        let here = robot
            .clone()
            .with_frame(WORLD, Frame::World, Pose::IDENTITY);
        let tree = FrameTree::of(&here.unwrap());
        assert_eq!(tree.of_link(WORLD), Some(WORLD));
        assert!(tree.fixed().iter().all(|edge| edge.child != WORLD));
        let there = robot.with_frame(WORLD, Frame::Tool, Pose::IDENTITY);
        let tree = FrameTree::of(&there.unwrap());
        assert_eq!(tree.of_link(WORLD), Some("link/world"));
    }
}
