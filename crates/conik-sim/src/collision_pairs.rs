//! Which shapes are kept apart, and the sets that do it.

use conik::{Frame, Kinematics, MAX_TASKS, Robot, ShapeDistance};
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;
use crate::scenario::{
    Collision, Damping, Frames, Geometry, GoalConfig, LinkShape, Motion, Obstacle, SelfCollision,
    TaskConfig, TaskKind,
};

/// Two shapes that are kept apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShapePair {
    /// The link that the first is on.
    pub link: String,
    /// The first, in the frame of its link.
    pub shape: Geometry,
    /// The link that the other is on; `None`: it is in the world.
    pub other_link: Option<String>,
    /// The other, in the frame of its link or in the world.
    pub other: Geometry,
}

impl ShapePair {
    /// What measures their distance.
    pub(crate) fn task(&self, robot: &Robot) -> Result<ShapeDistance, ExperimentError> {
        let frame = |link: &String| {
            let frame = robot.frame(link);
            frame.ok_or_else(|| ExperimentError::UnknownLink(link.clone()))
        };
        let (shape, other) = (self.shape.shape(), self.other.shape());
        let distance = ShapeDistance::between(frame(&self.link)?, shape, other);
        Ok(match &self.other_link {
            Some(link) => distance.relative_to(frame(link)?),
            None => distance,
        })
    }
}

impl Collision {
    /// A high-priority set for every two shapes that can meet: those of obstacles first, in the order of
    /// the file, named `shape/obstacle`, then those of the robot with itself, named `shape/shape`. Of more
    /// than a controller can have, there is one more than it can have.
    pub(crate) fn tasks<'s>(&'s self, robot: &Robot) -> Vec<TaskConfig> {
        let links = Links::of(robot);
        let on_frame = |shape: &'s LinkShape| Some((shape, robot.frame(&shape.link)?));
        let shapes: Vec<(&LinkShape, Frame)> = self.shapes.iter().filter_map(on_frame).collect();
        let obstacles = self.obstacles.iter();
        let obstacles = obstacles.filter_map(|obstacle| Some((obstacle, obstacle.distance_m?)));
        let with_obstacles = obstacles.flat_map(|(obstacle, distance_m)| {
            let moved = shapes
                .iter()
                .filter(|(_, frame)| links.joints(*frame, Frame::World) > 0);
            moved.map(move |(shape, _)| TaskConfig {
                motion: obstacle.motion,
                ..kept_apart(
                    &shape.name,
                    &obstacle.name,
                    with_obstacle(shape, obstacle),
                    distance_m,
                )
            })
        });
        let with_itself = self
            .self_collision
            .iter()
            .flat_map(|own| own_pairs(own, &links, &shapes));
        with_obstacles
            .chain(with_itself)
            .take(MAX_TASKS + 1)
            .collect()
    }
}

/// The sets that keep shapes on links apart.
fn own_pairs<'a>(
    own: &'a SelfCollision,
    links: &'a Links,
    shapes: &'a [(&LinkShape, Frame)],
) -> impl Iterator<Item = TaskConfig> + 'a {
    let pairs = shapes.iter().enumerate().flat_map(|(i, first)| {
        let later = shapes[i + 1..].iter();
        later.map(move |second| (first, second))
    });
    pairs.filter_map(|((shape, frame), (other, other_frame))| {
        let excluded =
            |group: &Vec<String>| group.contains(&shape.name) && group.contains(&other.name);
        // Neighbours touch where they are joined, and what is fixed to each other never moves.
        let is_kept = links.joints(*frame, *other_frame) >= 2 && !own.exclude.iter().any(excluded);
        is_kept.then(|| {
            kept_apart(
                &shape.name,
                &other.name,
                on_links(shape, other),
                own.distance_m,
            )
        })
    })
}

/// A shape on a link and one in the world.
pub(crate) fn with_obstacle(shape: &LinkShape, obstacle: &Obstacle) -> ShapePair {
    ShapePair {
        link: shape.link.clone(),
        shape: shape.geometry.clone(),
        other_link: None,
        other: obstacle.geometry.clone(),
    }
}

/// Two shapes on links.
pub(crate) fn on_links(shape: &LinkShape, other: &LinkShape) -> ShapePair {
    ShapePair {
        link: shape.link.clone(),
        shape: shape.geometry.clone(),
        other_link: Some(other.link.clone()),
        other: other.geometry.clone(),
    }
}

fn kept_apart(name: &str, other: &str, pair: ShapePair, distance_m: f64) -> TaskConfig {
    TaskConfig {
        name: format!("{name}/{other}"),
        kind: TaskKind::Shapes(Box::new(pair)),
        frames: Frames::default(),
        motion: Motion::default(),
        goal: GoalConfig::Set {
            min: Some(distance_m),
            max: None,
            recovery_per_s: None,
            gain_per_s: None,
        },
        damping: Damping::default(),
    }
}

/// The links of a robot, and what is between them.
pub(crate) struct Links<'a> {
    robot: &'a Robot,
    kinematics: Kinematics,
}

impl<'a> Links<'a> {
    pub(crate) fn of(robot: &'a Robot) -> Self {
        Self {
            robot,
            kinematics: Kinematics::new(robot),
        }
    }

    /// How many joints are between a link and another, or the world; none if there is no such link.
    pub(crate) fn joints_between(&self, link: &str, other: Option<&str>) -> usize {
        let seen_from = match other {
            None => Some(Frame::World),
            Some(other) => self.robot.frame(other),
        };
        let (Some(frame), Some(seen_from)) = (self.robot.frame(link), seen_from) else {
            return 0;
        };
        self.joints(frame, seen_from)
    }

    fn joints(&self, frame: Frame, seen_from: Frame) -> usize {
        self.kinematics.motion_between(seen_from, frame).joints()
    }
}
