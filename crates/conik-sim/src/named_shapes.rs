//! The two shapes that a task names: found among those on links and in the world.

use conik::Robot;

use crate::collision_pairs::{Links, ShapePair, on_links, with_obstacle};
use crate::scenario::{Collision, LinkShape, Motion, Obstacle, TaskConfig, TaskKind};

/// Why a task cannot measure the distance of the shapes that it names.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoPair {
    /// Nothing has that name.
    #[error("there is no shape or obstacle `{0}`")]
    Unknown(String),
    /// One shape twice.
    #[error("a shape has no distance to itself")]
    Same,
    /// Obstacles, or shapes on links that are fixed to each other or to the world.
    #[error("no joint of the robot moves one of them against the other")]
    NeverMoves,
    /// The obstacle, and what is desired of it.
    #[error("the obstacle moves, and so does the desired value: one of them must rest")]
    BothMove,
    /// There is none between shapes of these types.
    #[error("{0}")]
    NoDistance(&'static str),
}

/// A shape that has a name.
enum Named<'a> {
    OnLink(&'a LinkShape),
    InWorld(&'a Obstacle),
}

impl Collision {
    /// Two shapes by their names, either of which may be an obstacle's, and how that moves.
    pub(crate) fn named_pair(
        &self,
        names: &[String; 2],
        robot: &Robot,
    ) -> Result<(ShapePair, Motion), NoPair> {
        let [first, second] = names;
        let (shape, other) = match (self.named(first)?, self.named(second)?) {
            _ if first == second => return Err(NoPair::Same),
            (Named::OnLink(shape), other) | (other, Named::OnLink(shape)) => (shape, other),
            (Named::InWorld(_), Named::InWorld(_)) => return Err(NoPair::NeverMoves),
        };
        let (pair, motion) = match other {
            Named::OnLink(other) => (on_links(shape, other), Motion::default()),
            Named::InWorld(obstacle) => (with_obstacle(shape, obstacle), obstacle.motion),
        };
        let joints = Links::of(robot).joints_between(&pair.link, pair.other_link.as_deref());
        if joints == 0 {
            return Err(NoPair::NeverMoves);
        }
        let (shape, other) = (pair.shape.shape(), pair.other.shape());
        let has_distance = shape.check_pair(&other);
        has_distance.map_err(NoPair::NoDistance)?;
        Ok((pair, motion))
    }

    fn named(&self, name: &str) -> Result<Named<'_>, NoPair> {
        let shape = self.shapes.iter().find(|shape| shape.name == name);
        let obstacle = || self.obstacles.iter().find(|it| it.name == name);
        shape
            .map(Named::OnLink)
            .or_else(|| obstacle().map(Named::InWorld))
            .ok_or_else(|| NoPair::Unknown(name.to_owned()))
    }

    /// The task, with the shapes that it names, if it names any, in the place of their names.
    pub(crate) fn with_shapes(
        &self,
        task: &TaskConfig,
        robot: &Robot,
    ) -> Result<TaskConfig, NoPair> {
        let mut task = task.clone();
        if let TaskKind::ShapeDistance { shapes } = &task.kind {
            let (pair, motion) = self.named_pair(shapes, robot)?;
            task.kind = TaskKind::Shapes(Box::new(pair));
            if !motion.is_rest() {
                if !task.motion.is_rest() {
                    return Err(NoPair::BothMove);
                }
                task.motion = motion;
            }
        }
        Ok(task)
    }
}
