//! From where something was before a change of the scenario to where that has it.

use conik::{Pose, Vec3};

use super::{Mover, turned_pose};
use crate::live::Away;
use crate::scenario::TaskKind;

impl Mover {
    /// Takes over where `old`, the same task before a change of the scenario, is at `t_s` [s], to glide from
    /// there to where the scenario has it now. `false` if no gliding leads from one to the other, so that
    /// the task jumps.
    pub(crate) fn glide_from(&mut self, old: &Self, t_s: f64) -> bool {
        self.glide_speed = self.glide_speed.or(old.glide_speed);
        // Only what is kept needs time to get away from.
        let (Some(interval), Some(before)) = (self.interval, old.interval) else {
            return self.interval.is_none() && old.interval.is_none();
        };
        let (Some(point_m), Some(turn_rad)) = (self.point_from(old, t_s), self.turn_from(old, t_s))
        else {
            return false;
        };
        let bound = |before: f64, away: f64, now: f64| match (before.is_finite(), now.is_finite()) {
            (true, true) => Some(before + away - now),
            (false, false) => Some(0.0),
            _ => None,
        };
        let (Some(min), Some(max)) = (
            bound(before.min, old.away.min, interval.min),
            bound(before.max, old.away.max, interval.max),
        ) else {
            return false;
        };
        self.away = Away {
            point_m,
            turn_rad,
            min,
            max,
        };
        self.is_settled &= self.away.is_none();
        true
    }

    /// From its own point at `t_s` [s] to where that of `old` is; `None` if more than that differs.
    fn point_from(&self, old: &Self, t_s: f64) -> Option<Vec3> {
        let is_alike = match (&self.kind, &old.kind) {
            (TaskKind::Distance { .. }, TaskKind::Distance { .. })
            | (TaskKind::LookAt { .. }, TaskKind::LookAt { .. }) => true,
            (TaskKind::Shapes(now), TaskKind::Shapes(before)) => {
                now.link == before.link
                    && now.shape == before.shape
                    && now.other_link == before.other_link
                    && before.other.moved_to(now.other.point()).is_near(&now.other)
            }
            _ => return Some(Vec3::default()),
        };
        let (start, from) = (self.start()?, old.start()?);
        let now = Vec3::from(self.motion.point_at(start, t_s));
        let before = Vec3::from(old.motion.point_at(from, t_s)) + old.away.point_m;
        is_alike.then(|| before - now)
    }

    /// The rotation vector from its own direction or orientation at `t_s` [s] to that of `old`; `None` if
    /// more than that differs.
    fn turn_from(&self, old: &Self, t_s: f64) -> Option<Vec3> {
        match (&self.kind, &old.kind) {
            (
                TaskKind::FieldOfView { direction },
                TaskKind::FieldOfView {
                    direction: before, ..
                },
            ) => Some(between(
                self.direction_at(direction, t_s),
                old.direction_at(before, t_s),
            )),
            (
                TaskKind::PointingAngle { axis, direction },
                TaskKind::PointingAngle {
                    axis: old_axis,
                    direction: before,
                },
            ) => (axis == old_axis).then(|| {
                between(
                    self.direction_at(direction, t_s),
                    old.direction_at(before, t_s),
                )
            }),
            (
                TaskKind::OrientationAngle {
                    desired_quaternion_wxyz: desired,
                },
                TaskKind::OrientationAngle {
                    desired_quaternion_wxyz: before,
                },
            ) => {
                let now = self.orientation_at(desired, t_s);
                let before = old.orientation_at(before, t_s);
                Some((before * now.inverse()).rotation_vector())
            }
            (TaskKind::Distance { .. }, TaskKind::Distance { .. })
            | (TaskKind::LookAt { .. }, TaskKind::LookAt { .. })
            | (TaskKind::Shapes(_), TaskKind::Shapes(_)) => Some(Vec3::default()),
            (now, before) => (now == before).then(Vec3::default),
        }
    }

    fn direction_at(&self, direction: &[f64; 3], t_s: f64) -> Vec3 {
        let turned = Vec3::from(self.motion.turned_at(t_s));
        let there = Vec3::from(*direction).turned_by(turned);
        there.turned_by(self.away.turn_rad)
    }

    fn orientation_at(&self, start_wxyz: &[f64; 4], t_s: f64) -> Pose {
        let turned = Vec3::from(self.motion.turned_at(t_s));
        Pose::turned(self.away.turn_rad) * turned_pose(turned, *start_wxyz)
    }
}

/// The shortest rotation vector that turns one direction into another [rad].
fn between(from: Vec3, to: Vec3) -> Vec3 {
    let axis = from.cross(to);
    let (sine, cosine) = (axis.norm(), from.dot(to));
    if sine > 1e-12 {
        return axis * (sine.atan2(cosine) / sine);
    }
    if cosine > 0.0 {
        return Vec3::default();
    }
    // Straight back: about any axis across.
    let across = if from.x.abs() < 0.5 {
        Vec3::new(1.0, 0.0, 0.0)
    } else {
        Vec3::new(0.0, 1.0, 0.0)
    };
    from.cross(across).normalized() * std::f64::consts::PI
}
