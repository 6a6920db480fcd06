//! The waypoints of a run: which task visits them, and which one is in use.

use conik::{
    Frame, FramePose, Kinematics, Orientation, Pose, PoseWaypoints, Robot, Setpoints, StackError,
    TaskId,
};

use crate::experiment::ExperimentError;
use crate::measured::frames;
use crate::scenario::{GoalConfig, TaskConfig, TaskKind};

/// A task that visits places one after the other.
#[derive(Clone, Debug)]
pub struct Visits {
    /// The task.
    pub task: TaskId,
    /// What visits them, and as which other frame sees it.
    frame: Frame,
    seen_from: Frame,
    what: What,
    waypoints: PoseWaypoints,
}

/// What of a place counts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum What {
    Point,
    Orientation,
    Pose,
}

impl Visits {
    /// The waypoints of a task, if it has any.
    pub fn of(
        task: TaskId,
        config: &TaskConfig,
        robot: &Robot,
    ) -> Result<Option<Self>, ExperimentError> {
        let GoalConfig::Waypoints {
            waypoints_m: points,
            waypoints_quaternion_wxyz: turns,
            acceptance_m,
            acceptance_rad,
            ..
        } = &config.goal
        else {
            return Ok(None);
        };
        let what = match config.kind {
            TaskKind::Pose { .. } => What::Pose,
            TaskKind::Orientation { .. } => What::Orientation,
            _ => What::Point,
        };
        let pose = |nth: usize| Pose {
            origin: points.get(nth).copied().unwrap_or_default().into(),
            ..turns
                .get(nth)
                .map_or(Pose::IDENTITY, |turn| Pose::from_quaternion_wxyz(*turn))
        };
        let poses = (0..points.len().max(turns.len())).map(pose).collect();
        let (acceptance, angle) = (
            acceptance_m.unwrap_or(f64::INFINITY),
            acceptance_rad.unwrap_or(f64::INFINITY),
        );
        let waypoints = PoseWaypoints::new(poses, acceptance, angle)
            .ok_or_else(|| ExperimentError::NoWaypoints(config.name.clone()))?;
        let (frame, seen_from) = frames(robot, &config.frames)?;
        Ok(Some(Self {
            task,
            frame,
            seen_from,
            what,
            waypoints,
        }))
    }

    /// How many waypoints there are.
    pub fn count(&self) -> usize {
        self.waypoints.poses().len()
    }

    /// Index of the one in use, from 0.
    pub fn index(&self) -> usize {
        self.waypoints.index()
    }

    /// What is to come to the waypoints, where the robot is.
    pub fn pose(&self, kinematics: &Kinematics) -> Pose {
        let pose = *kinematics.world_from(self.frame);
        match self.seen_from {
            Frame::World => pose,
            other => kinematics.world_from(other).inverse() * pose,
        }
    }

    /// How far it is to a waypoint [m], and how much to turn [rad], where that counts.
    pub fn to_go(&self, nth: usize, kinematics: &Kinematics) -> (Option<f64>, Option<f64>) {
        let Some(target) = self.waypoints.poses().get(nth) else {
            return (None, None);
        };
        let (distance, angle) = PoseWaypoints::to_go(target, &self.pose(kinematics));
        (
            (self.what != What::Orientation).then_some(distance),
            (self.what != What::Point).then_some(angle),
        )
    }

    /// Goes on where `before` was, with waypoints that may be other ones, and tells the task.
    pub(crate) fn take_over(
        &mut self,
        before: &Self,
        setpoints: &mut Setpoints<'_>,
    ) -> Result<(), StackError> {
        self.waypoints.take_over(&before.waypoints);
        self.tell(setpoints)
    }

    /// Called once at the start of each tick with the present [`pose`](Self::pose): takes the next waypoint
    /// if it is time to, and tells the task. Returns the index of one that is reached for the first time.
    ///
    /// # Errors
    ///
    /// If a waypoint is no number, which none of a scenario that was read is.
    pub fn advance(
        &mut self,
        pose: &Pose,
        setpoints: &mut Setpoints<'_>,
    ) -> Result<Option<usize>, StackError> {
        let reached = self.waypoints.advance(pose);
        if reached.is_some() {
            self.tell(setpoints)?;
        }
        Ok(reached)
    }

    /// Tells the task the waypoint in use.
    fn tell(&self, setpoints: &mut Setpoints<'_>) -> Result<(), StackError> {
        let target = self.waypoints.target();
        match self.what {
            What::Point => setpoints.set_desired(self.task, &target.origin.to_array())?,
            What::Orientation => {
                if let Some(orientation) = setpoints.task_mut::<Orientation>(self.task) {
                    orientation.set_desired(target);
                }
            }
            What::Pose => {
                if let Some(pose) = setpoints.task_mut::<FramePose>(self.task) {
                    pose.set_desired(target);
                }
            }
        }
        Ok(())
    }
}
