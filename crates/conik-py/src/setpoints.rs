//! What changes between two ticks.

use std::any::Any;

use conik::{
    BoundRates, Distance, FieldOfView, FramePose, Goal, Interval, JointSpeed, LookAt, Orientation,
    OrientationAngle, Plane, PointingAngle, Pose, Position, Setpoints, Task, TaskId, Vec3,
};
use pyo3::prelude::*;

use crate::failure::described;

/// Changes of one task: the keyword arguments of `Controller.change`.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Change {
    target: Option<[f64; 3]>,
    point: Option<[f64; 3]>,
    velocity: Option<[f64; 3]>,
    direction: Option<[f64; 3]>,
    /// A quaternion, its real part first.
    orientation: Option<[f64; 4]>,
    angular_velocity: Option<[f64; 3]>,
    offset: Option<f64>,
    offset_rate: Option<f64>,
    speed: Option<f64>,
    desired: Option<Vec<f64>>,
    desired_rate: Option<Vec<f64>>,
    min: Option<f64>,
    max: Option<f64>,
    min_rate: Option<f64>,
    max_rate: Option<f64>,
}

/// What a task is given besides bounds or a desired value.
const fn parameters(kind: Kind) -> &'static [&'static str] {
    match kind {
        Kind::Position => &["target", "velocity"],
        Kind::Distance | Kind::LookAt => &["point", "velocity"],
        Kind::Pose => &["target", "velocity", "orientation", "angular_velocity"],
        Kind::Orientation | Kind::OrientationAngle => &["orientation", "angular_velocity"],
        Kind::FieldOfView | Kind::PointingAngle => &["direction", "angular_velocity"],
        Kind::Plane => &["offset", "offset_rate"],
        Kind::JointSpeed => &["speed"],
        Kind::Other => &[],
    }
}

/// Types of tasks that are given different things.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Position,
    Distance,
    LookAt,
    Pose,
    Orientation,
    OrientationAngle,
    FieldOfView,
    PointingAngle,
    Plane,
    JointSpeed,
    Other,
}

impl Kind {
    fn of(task: &dyn Task) -> Self {
        let task: &dyn Any = task;
        let is = [
            (task.is::<Position>(), Self::Position),
            (task.is::<Distance>(), Self::Distance),
            (task.is::<LookAt>(), Self::LookAt),
            (task.is::<FramePose>(), Self::Pose),
            (task.is::<Orientation>(), Self::Orientation),
            (task.is::<OrientationAngle>(), Self::OrientationAngle),
            (task.is::<FieldOfView>(), Self::FieldOfView),
            (task.is::<PointingAngle>(), Self::PointingAngle),
            (task.is::<Plane>(), Self::Plane),
            (task.is::<JointSpeed>(), Self::JointSpeed),
        ];
        let found = is.into_iter().find_map(|(is, kind)| is.then_some(kind));
        found.unwrap_or(Self::Other)
    }

    /// Whether the desired value is among its own parameters.
    fn has_own_goal(self) -> bool {
        matches!(
            self,
            Self::Position | Self::Pose | Self::Orientation | Self::JointSpeed
        )
    }
}

impl Change {
    /// Makes it. What the task does not have is refused, and then nothing is changed.
    pub fn make(&self, controller: &mut conik::Controller, task: TaskId) -> PyResult<()> {
        let level = &controller.stack()[task];
        let kind = Kind::of(level.task());
        let goal = level.goal();
        let allowed = match goal {
            Goal::Set { .. } => &["min", "max", "min_rate", "max_rate"][..],
            Goal::Equality { .. } if kind.has_own_goal() => &[],
            Goal::Equality { .. } => &["desired", "desired_rate"],
        };
        let allowed = [parameters(kind), allowed].concat();
        if let Some(other) = self.given().find(|given| !allowed.contains(given)) {
            return Err(described(format!(
                "task `{}` has no {other} to be changed; it has: {}",
                level.name(),
                allowed.join(", ")
            )));
        }
        let bounds = self.bounds(goal);
        let mut setpoints = controller.setpoints();
        if let Some((interval, rates)) = bounds {
            let changed = setpoints.set_interval_moving(task, interval, rates);
            changed.map_err(described)?;
        }
        if let Some(desired) = &self.desired {
            let rest = vec![0.0; desired.len()];
            let rate = self.desired_rate.as_ref().unwrap_or(&rest);
            let changed = setpoints.set_desired_moving(task, desired, rate);
            changed.map_err(described)?;
        }
        self.tell(kind, &mut setpoints, task)
    }

    fn given(&self) -> impl Iterator<Item = &'static str> {
        [
            ("target", self.target.is_some()),
            ("point", self.point.is_some()),
            ("velocity", self.velocity.is_some()),
            ("direction", self.direction.is_some()),
            ("orientation", self.orientation.is_some()),
            ("angular_velocity", self.angular_velocity.is_some()),
            ("offset", self.offset.is_some()),
            ("offset_rate", self.offset_rate.is_some()),
            ("speed", self.speed.is_some()),
            ("desired", self.desired.is_some()),
            ("desired_rate", self.desired_rate.is_some()),
            ("min", self.min.is_some()),
            ("max", self.max.is_some()),
            ("min_rate", self.min_rate.is_some()),
            ("max_rate", self.max_rate.is_some()),
        ]
        .into_iter()
        .filter_map(|(name, is_given)| is_given.then_some(name))
    }

    /// Bounds that are not given are as they were, and rest.
    fn bounds(&self, goal: &Goal) -> Option<(Interval, BoundRates)> {
        let Goal::Set { interval, .. } = goal else {
            return None;
        };
        let given = [self.min, self.max, self.min_rate, self.max_rate];
        given.iter().any(Option::is_some).then(|| {
            let interval = Interval {
                min: self.min.unwrap_or(interval.min),
                max: self.max.unwrap_or(interval.max),
            };
            let rates = BoundRates {
                min: self.min_rate.unwrap_or_default(),
                max: self.max_rate.unwrap_or_default(),
            };
            (interval, rates)
        })
    }

    /// Tells the task its own parameters; velocities that are not given are zero.
    fn tell(&self, kind: Kind, setpoints: &mut Setpoints<'_>, task: TaskId) -> PyResult<()> {
        let velocity = Vec3::from(self.velocity.unwrap_or_default());
        let turning = Vec3::from(self.angular_velocity.unwrap_or_default());
        match kind {
            Kind::Position => {
                if let Some(target) = self.target {
                    let changed = setpoints.set_desired_moving(task, &target, &velocity.to_array());
                    changed.map_err(described)?;
                }
            }
            Kind::Distance => with(setpoints, task, self.point, |it: &mut Distance, point| {
                it.set_point_moving(point, velocity);
            }),
            Kind::LookAt => with(setpoints, task, self.point, |it: &mut LookAt, point| {
                it.set_point_moving(point, velocity);
            }),
            Kind::Pose => with(setpoints, task, Some(()), |it: &mut FramePose, ()| {
                let mut desired = it.desired();
                if let Some(orientation) = self.orientation {
                    desired = Pose {
                        origin: desired.origin,
                        ..Pose::from_quaternion_wxyz(orientation)
                    };
                }
                if let Some(target) = self.target {
                    desired.origin = target.into();
                }
                it.set_desired_moving(desired, velocity, turning);
            }),
            Kind::Orientation => with(
                setpoints,
                task,
                self.orientation,
                |it: &mut Orientation, wxyz| {
                    it.set_desired_turning(Pose::from_quaternion_wxyz(wxyz), turning);
                },
            ),
            Kind::OrientationAngle => with(
                setpoints,
                task,
                self.orientation,
                |it: &mut OrientationAngle, wxyz| {
                    let orientation = it.orientation_mut();
                    orientation.set_desired_turning(Pose::from_quaternion_wxyz(wxyz), turning);
                },
            ),
            Kind::FieldOfView => with(
                setpoints,
                task,
                self.direction,
                |it: &mut FieldOfView, direction| {
                    it.set_direction_turning(direction, turning);
                },
            ),
            Kind::PointingAngle => with(
                setpoints,
                task,
                self.direction,
                |it: &mut PointingAngle, direction| it.set_direction_turning(direction, turning),
            ),
            Kind::Plane => with(setpoints, task, self.offset, |it: &mut Plane, offset| {
                it.set_offset_moving(offset, self.offset_rate.unwrap_or_default());
            }),
            Kind::JointSpeed => with(setpoints, task, self.speed, |it: &mut JointSpeed, speed| {
                it.set_speed(speed);
            }),
            Kind::Other => {}
        }
        Ok(())
    }
}

/// Changes a task of this type, if there is something to change.
fn with<T: Task, V>(
    setpoints: &mut Setpoints<'_>,
    task: TaskId,
    value: Option<V>,
    change: impl FnOnce(&mut T, V),
) {
    if let (Some(value), Some(task)) = (value, setpoints.task_mut(task)) {
        change(task, value);
    }
}
