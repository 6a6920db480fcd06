//! What moves in a run besides the arm: points, targets, directions, desired values, bounds, obstacles.

mod glide_from;

use conik::{
    BoundRates, Distance, FieldOfView, FramePose, Interval, LookAt, Orientation, OrientationAngle,
    PointingAngle, Pose, Setpoints, ShapeDistance, StackError, Task, TaskId, Vec3,
};

use crate::live::{Away, GlideSpeed};
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
    /// Its allowed values, if it is a set.
    pub(super) interval: Option<Interval>,
    /// How it moves.
    pub motion: Motion,
    /// How far it is from there, after a change of the scenario.
    pub(super) away: Away,
    /// How fast it makes that up; `None`: as before the change, or at the usual speed.
    pub(crate) glide_speed: Option<GlideSpeed>,
    /// Whether the task knows where it is, and that it rests there.
    pub(super) is_settled: bool,
    /// Whether the last tick was told that bounds move.
    bounds_move: bool,
}

impl Mover {
    /// What moves of a task, if anything does.
    pub fn of(task: TaskId, config: &TaskConfig) -> Option<Self> {
        (!config.motion.is_rest()).then(|| Self::of_any(task, config))
    }

    /// The same of a task of which nothing need move.
    pub(crate) fn of_any(task: TaskId, config: &TaskConfig) -> Self {
        let (mut desired, mut interval) = (None, None);
        match &config.goal {
            GoalConfig::Desired { desired: value, .. } => desired = Some(value.clone()),
            GoalConfig::Set { min, max, .. } => {
                interval = Some(Interval {
                    min: min.unwrap_or(f64::NEG_INFINITY),
                    max: max.unwrap_or(f64::INFINITY),
                });
            }
            GoalConfig::Waypoints { .. } => {}
        }
        Self {
            task,
            kind: config.kind.clone(),
            desired,
            interval,
            motion: config.motion,
            away: Away::default(),
            glide_speed: None,
            is_settled: config.motion.is_rest(),
            bounds_move: false,
        }
    }

    /// Where its point or target is at `t_s` [s], if that moves [m].
    pub fn point_at(&self, t_s: f64) -> Option<[f64; 3]> {
        self.motion.velocity_m_per_s?;
        let start = self.start()?;
        Some(self.motion.point_at(start, t_s))
    }

    /// Where its point or target is at t = 0, if it has one [m].
    pub(super) fn start(&self) -> Option<[f64; 3]> {
        match self.kind {
            TaskKind::Distance { point_m } | TaskKind::LookAt { point_m } => Some(point_m),
            TaskKind::Pose { target_m, .. } => Some(target_m),
            TaskKind::Shapes(ref pair) => Some(pair.other.point()),
            TaskKind::Position => self.desired.as_deref()?.try_into().ok(),
            _ => None,
        }
    }

    /// Its desired value at `t_s` [s], if that moves [task's unit].
    pub fn desired_at(&self, t_s: f64) -> Option<f64> {
        self.motion.desired_per_s?;
        let start = self.desired.as_deref()?.first()?;
        Some(self.motion.value_at(*start, t_s))
    }

    /// How far it still is from where the scenario has it.
    pub fn away(&self) -> &Away {
        &self.away
    }

    /// Tells the task where everything is at `t_s` [s] and where it will be a period later. Called before
    /// every tick.
    pub(crate) fn tell(
        &mut self,
        setpoints: &mut Setpoints<'_>,
        t_s: f64,
        period_s: f64,
    ) -> Result<(), StackError> {
        if self.is_settled {
            return Ok(());
        }
        let now = During {
            motion: self.motion.during(t_s, period_s),
            away: self.away,
            then: self
                .away
                .after(period_s, &self.glide_speed.unwrap_or_default()),
            period_s,
        };
        self.tell_parameters(setpoints, t_s, &now);
        self.tell_bounds(setpoints, &now)?;
        // What came to rest is told so once.
        self.is_settled = self.motion.is_rest() && self.away.is_none();
        self.away = now.then;
        match (&self.kind, self.desired.as_deref()) {
            (TaskKind::Position, Some(&[x, y, z])) if self.motion.velocity_m_per_s.is_some() => {
                let target = self.motion.point_at([x, y, z], t_s);
                let velocity = now.motion.velocity_m_per_s.unwrap_or_default();
                setpoints.set_desired_moving(self.task, &target, &velocity)
            }
            (_, Some(&[start])) if self.motion.desired_per_s.is_some() => {
                let desired = self.motion.value_at(start, t_s);
                let rate = now.motion.desired_per_s.unwrap_or_default();
                setpoints.set_desired_moving(self.task, &[desired], &[rate])
            }
            _ => Ok(()),
        }
    }

    fn tell_bounds(
        &mut self,
        setpoints: &mut Setpoints<'_>,
        now: &During,
    ) -> Result<(), StackError> {
        let moves = now.away.min != 0.0 || now.away.max != 0.0;
        let moved = std::mem::replace(&mut self.bounds_move, moves);
        let Some(interval) = self.interval.filter(|_| moves || moved) else {
            return Ok(());
        };
        let interval = Interval {
            min: interval.min + now.away.min,
            max: interval.max + now.away.max,
        };
        let rates = BoundRates {
            min: (now.then.min - now.away.min) / now.period_s,
            max: (now.then.max - now.away.max) / now.period_s,
        };
        setpoints.set_interval_moving(self.task, interval, rates)
    }

    /// The part that is no desired value but the task's own parameter.
    fn tell_parameters(&self, setpoints: &mut Setpoints<'_>, t_s: f64, now: &During) {
        let (id, motion) = (self.task, self.motion);
        let point = |start| Vec3::from(motion.point_at(start, t_s)) + now.away.point_m;
        let velocity = now.velocity();
        let turned = Vec3::from(motion.turned_at(t_s));
        let direction = |start: [f64; 3]| {
            let there = Vec3::from(start).turned_by(turned);
            there.turned_by(now.away.turn_rad)
        };
        let pose = |start| Pose::turned(now.away.turn_rad) * turned_pose(turned, start);
        let turning = now.turning();
        match self.kind {
            TaskKind::Distance { point_m } => change(setpoints, id, |it: &mut Distance| {
                it.set_point_moving(point(point_m), velocity);
            }),
            TaskKind::LookAt { point_m } => change(setpoints, id, |it: &mut LookAt| {
                it.set_point_moving(point(point_m), velocity);
            }),
            TaskKind::Shapes(_) => change(setpoints, id, |it: &mut ShapeDistance| {
                it.set_shift_moving(point([0.0; 3]), velocity);
            }),
            TaskKind::FieldOfView { direction: start } => {
                change(setpoints, id, |it: &mut FieldOfView| {
                    it.set_direction_turning(direction(start), turning);
                });
            }
            TaskKind::PointingAngle {
                direction: start, ..
            } => change(setpoints, id, |it: &mut PointingAngle| {
                it.set_direction_turning(direction(start), turning);
            }),
            TaskKind::Orientation {
                desired_quaternion_wxyz: start,
            } => change(setpoints, id, |it: &mut Orientation| {
                it.set_desired_turning(pose(start), turning);
            }),
            TaskKind::OrientationAngle {
                desired_quaternion_wxyz: start,
            } => change(setpoints, id, |it: &mut OrientationAngle| {
                let orientation = it.orientation_mut();
                orientation.set_desired_turning(pose(start), turning);
            }),
            TaskKind::Pose {
                target_m,
                desired_quaternion_wxyz: start,
            } => change(setpoints, id, |it: &mut FramePose| {
                let desired = Pose {
                    origin: point(target_m),
                    ..pose(start)
                };
                it.set_desired_moving(desired, velocity, turning);
            }),
            _ => {}
        }
    }
}

/// What moves in one period, and how.
struct During {
    motion: Motion,
    /// At its beginning and at its end.
    away: Away,
    then: Away,
    period_s: f64,
}

impl During {
    /// Velocity of a point [m/s].
    fn velocity(&self) -> Vec3 {
        let own = Vec3::from(self.motion.velocity_m_per_s.unwrap_or_default());
        own + (self.then.point_m - self.away.point_m) * (1.0 / self.period_s)
    }

    /// Angular velocity of a direction or an orientation [rad/s].
    fn turning(&self) -> Vec3 {
        let own = self.motion.angular_velocity_rad_per_s.unwrap_or_default();
        // What is away shrinks along itself, so that its rate is an angular velocity.
        let gliding = (self.then.turn_rad - self.away.turn_rad) * (1.0 / self.period_s);
        Vec3::from(own).turned_by(self.away.turn_rad) + gliding
    }
}

/// Changes a task that is of this type.
fn change<T: Task>(setpoints: &mut Setpoints<'_>, id: TaskId, change: impl FnOnce(&mut T)) {
    if let Some(task) = setpoints.task_mut(id) {
        change(task);
    }
}

/// An orientation, turned on by a rotation vector [rad].
pub(super) fn turned_pose(turned: Vec3, start_wxyz: [f64; 4]) -> Pose {
    Pose::turned(turned) * Pose::from_quaternion_wxyz(start_wxyz)
}
