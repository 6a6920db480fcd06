//! What moves in a run besides the arm: the points of `distance` and `look_at` tasks, and
//! obstacles.

use conik::{Distance, LookAt, Setpoints, ShapeDistance, TaskId};

use crate::scenario::{Motion, TaskKind};

/// A point that moves, and the task that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mover {
    /// The task.
    pub task: TaskId,
    /// Where the point is at t = 0 [m].
    pub start_m: [f64; 3],
    /// How it moves.
    pub motion: Motion,
}

impl Mover {
    /// What moves of a task, if anything does.
    pub fn of(task: TaskId, kind: &TaskKind) -> Option<Self> {
        match *kind {
            TaskKind::Distance {
                point_m,
                motion: Some(motion),
            }
            | TaskKind::LookAt {
                point_m,
                motion: Some(motion),
            } => Some(Self {
                task,
                start_m: point_m,
                motion,
            }),
            TaskKind::Shapes(ref pair) => Some(Self {
                task,
                start_m: pair.other.point(),
                motion: pair.motion?,
            }),
            _ => None,
        }
    }

    /// Where the point is at `t_s` [s].
    pub fn point_at(&self, t_s: f64) -> [f64; 3] {
        self.motion.point_at(self.start_m, t_s)
    }

    /// Tells the task where its point is at `t_s` [s] and where it will be a period later.
    pub(crate) fn tell(&self, setpoints: &mut Setpoints<'_>, t_s: f64, period_s: f64) {
        let (point, velocity) = (self.point_at(t_s), self.motion.velocity_at(t_s, period_s));
        if let Some(distance) = setpoints.task_mut::<Distance>(self.task) {
            distance.set_point_moving(point, velocity);
        } else if let Some(look) = setpoints.task_mut::<LookAt>(self.task) {
            look.set_point_moving(point, velocity);
        } else if let Some(distance) = setpoints.task_mut::<ShapeDistance>(self.task) {
            distance.set_shift_moving(self.motion.point_at([0.0; 3], t_s), velocity);
        }
    }
}
