//! What moves in a run besides the arm: points, targets, directions, desired values, obstacles.

use conik::{
    Distance, FieldOfView, FramePose, LookAt, Orientation, OrientationAngle, PointingAngle, Pose,
    Setpoints, ShapeDistance, StackError, Task, TaskId, Vec3,
};

use crate::scenario::{GoalConfig, Motion, TaskConfig, TaskKind};

/// A task of which something moves, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Mover {
    /// The task.
    pub task: TaskId,
    /// What it measures at t = 0.
    pub kind: TaskKind,
    /// Its desired value at t = 0, if it has one.
    desired: Option<Vec<f64>>,
    /// How it moves.
    pub motion: Motion,
}

impl Mover {
    /// What moves of a task, if anything does.
    pub fn of(task: TaskId, config: &TaskConfig) -> Option<Self> {
        let desired = match &config.goal {
            GoalConfig::Desired { desired, .. } => Some(desired.clone()),
            _ => None,
        };
        (!config.motion.is_rest()).then(|| Self {
            task,
            kind: config.kind.clone(),
            desired,
            motion: config.motion,
        })
    }

    /// Where its point or target is at `t_s` [s], if that moves [m].
    pub fn point_at(&self, t_s: f64) -> Option<[f64; 3]> {
        self.motion.velocity_m_per_s?;
        let start = match self.kind {
            TaskKind::Distance { point_m } | TaskKind::LookAt { point_m } => point_m,
            TaskKind::Pose { target_m, .. } => target_m,
            TaskKind::Shapes(ref pair) => pair.other.point(),
            _ => self.desired.as_deref()?.try_into().ok()?,
        };
        Some(self.motion.point_at(start, t_s))
    }

    /// Its desired value at `t_s` [s], if that moves [task's unit].
    pub fn desired_at(&self, t_s: f64) -> Option<f64> {
        self.motion.desired_per_s?;
        let start = self.desired.as_deref()?.first()?;
        Some(self.motion.value_at(*start, t_s))
    }

    /// Tells the task where everything is at `t_s` [s] and where it will be a period later.
    pub(crate) fn tell(
        &self,
        setpoints: &mut Setpoints<'_>,
        t_s: f64,
        period_s: f64,
    ) -> Result<(), StackError> {
        self.tell_parameters(setpoints, t_s, period_s);
        let now = self.motion.during(t_s, period_s);
        match (&self.kind, self.desired.as_deref(), now.desired_per_s) {
            (TaskKind::Position, Some(&[x, y, z]), _) => {
                let target = self.motion.point_at([x, y, z], t_s);
                let velocity = now.velocity_m_per_s.unwrap_or_default();
                setpoints.set_desired_moving(self.task, &target, &velocity)
            }
            (_, Some(&[start]), Some(rate)) => {
                let desired = self.motion.value_at(start, t_s);
                setpoints.set_desired_moving(self.task, &[desired], &[rate])
            }
            _ => Ok(()),
        }
    }

    /// The part that is no desired value but the task's own parameter.
    fn tell_parameters(&self, setpoints: &mut Setpoints<'_>, t_s: f64, period_s: f64) {
        let (id, motion, now) = (self.task, self.motion, self.motion.during(t_s, period_s));
        let velocity = now.velocity_m_per_s.unwrap_or_default();
        let turning = now.angular_velocity_rad_per_s.unwrap_or_default();
        let turned = Vec3::from(motion.turned_at(t_s));
        match self.kind {
            TaskKind::Distance { point_m } => change(setpoints, id, |it: &mut Distance| {
                it.set_point_moving(motion.point_at(point_m, t_s), velocity);
            }),
            TaskKind::LookAt { point_m } => change(setpoints, id, |it: &mut LookAt| {
                it.set_point_moving(motion.point_at(point_m, t_s), velocity);
            }),
            TaskKind::Shapes(_) => change(setpoints, id, |it: &mut ShapeDistance| {
                it.set_shift_moving(motion.point_at([0.0; 3], t_s), velocity);
            }),
            TaskKind::FieldOfView { direction } => change(setpoints, id, |it: &mut FieldOfView| {
                it.set_direction_turning(Vec3::from(direction).turned_by(turned), turning);
            }),
            TaskKind::PointingAngle { direction, .. } => {
                change(setpoints, id, |it: &mut PointingAngle| {
                    it.set_direction_turning(Vec3::from(direction).turned_by(turned), turning);
                });
            }
            TaskKind::Orientation {
                desired_quaternion_wxyz: start,
            } => change(setpoints, id, |it: &mut Orientation| {
                it.set_desired_turning(turned_pose(turned, start), turning);
            }),
            TaskKind::OrientationAngle {
                desired_quaternion_wxyz: start,
            } => change(setpoints, id, |it: &mut OrientationAngle| {
                let orientation = it.orientation_mut();
                orientation.set_desired_turning(turned_pose(turned, start), turning);
            }),
            TaskKind::Pose {
                target_m,
                desired_quaternion_wxyz: start,
            } => change(setpoints, id, |it: &mut FramePose| {
                let desired = Pose {
                    origin: motion.point_at(target_m, t_s).into(),
                    ..turned_pose(turned, start)
                };
                it.set_desired_moving(desired, velocity, turning);
            }),
            _ => {}
        }
    }
}

/// Changes a task that is of this type.
fn change<T: Task>(setpoints: &mut Setpoints<'_>, id: TaskId, change: impl FnOnce(&mut T)) {
    if let Some(task) = setpoints.task_mut(id) {
        change(task);
    }
}

/// An orientation, turned on by a rotation vector [rad].
fn turned_pose(turned: Vec3, start_wxyz: [f64; 4]) -> Pose {
    Pose::turned(turned) * Pose::from_quaternion_wxyz(start_wxyz)
}
