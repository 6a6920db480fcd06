//! What moves of what is asked for, from the start of the run on: a point along a straight line, a
//! direction or an orientation about an axis that stays, a desired value.

use serde::{Deserialize, Serialize};

use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robot::in_one_unit;
use super::table::{Entry, Table};
use super::write::{number, vector};

/// How something moves; at rest by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Velocity of a point, in the world or in the axes of `relative_to` [m/s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_m_per_s: Option<[f64; 3]>,
    /// Angular velocity of a direction or an orientation, in the same axes [rad/s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_velocity_rad_per_s: Option<[f64; 3]>,
    /// Rate of a desired value [task's unit/s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub desired_per_s: Option<f64>,
    /// When all of it comes to rest [s]; `None`: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moves_until_s: Option<f64>,
}

impl Motion {
    /// Whether nothing moves.
    pub fn is_rest(&self) -> bool {
        self.velocity_m_per_s.is_none()
            && self.angular_velocity_rad_per_s.is_none()
            && self.desired_per_s.is_none()
    }

    /// For how long it has been moving at `t_s` [s].
    pub fn moved_for_s(&self, t_s: f64) -> f64 {
        self.moves_until_s.map_or(t_s, |until| t_s.min(until))
    }

    /// Where a point is at `t_s` [s] that is at `start` [m] at t = 0.
    pub fn point_at(&self, start: [f64; 3], t_s: f64) -> [f64; 3] {
        let (moved, velocity) = (self.moved_for_s(t_s), self.velocity_m_per_s);
        let velocity = velocity.unwrap_or_default();
        [0, 1, 2].map(|axis| start[axis] + velocity[axis] * moved)
    }

    /// How far it has turned at `t_s` [s]: a rotation vector [rad].
    pub fn turned_at(&self, t_s: f64) -> [f64; 3] {
        let moved = self.moved_for_s(t_s);
        let turning = self.angular_velocity_rad_per_s.unwrap_or_default();
        turning.map(|speed| speed * moved)
    }

    /// What a desired value is at `t_s` [s] that is `start` at t = 0.
    pub fn value_at(&self, start: f64, t_s: f64) -> f64 {
        start + self.desired_per_s.unwrap_or_default() * self.moved_for_s(t_s)
    }

    /// The mean motion in the period [s] from `t_s` [s] on: with it, whoever knows where something is now
    /// knows where it will be at the period's end, also in the period in which it comes to rest.
    #[must_use]
    pub fn during(&self, t_s: f64, period_s: f64) -> Self {
        let moving = self
            .moves_until_s
            .map_or(1.0, |until| ((until - t_s) / period_s).clamp(0.0, 1.0));
        let slowed = |velocity: [f64; 3]| velocity.map(|speed| speed * moving);
        Self {
            velocity_m_per_s: self.velocity_m_per_s.map(slowed),
            angular_velocity_rad_per_s: self.angular_velocity_rad_per_s.map(slowed),
            desired_per_s: self.desired_per_s.map(|rate| rate * moving),
            moves_until_s: self.moves_until_s,
        }
    }
}

/// Reads how something moves of which `speeds` are the keys that say so; there may be none.
pub(super) fn read(table: &Table, speeds: &[&'static Key], found: &mut Mistakes) -> Option<Motion> {
    if speeds.is_empty() {
        return Some(Motion::default());
    }
    let has = |key: &Key| speeds.iter().any(|speed| speed.name == key.name);
    let vector = |key: &'static Key, found: &mut Mistakes| {
        if has(key) {
            table.vector(key, found)
        } else {
            Entry::Absent(key)
        }
    };
    let (deg, rad) = (
        &keys::ANGULAR_VELOCITY_DEG_PER_S,
        &keys::ANGULAR_VELOCITY_RAD_PER_S,
    );
    let velocity = vector(&keys::VELOCITY_M_PER_S, found);
    let (in_deg, in_rad) = (vector(deg, found), vector(rad, found));
    let turning = in_one_unit(table, deg, in_deg, rad, in_rad, found);
    let turning = turning.map(|(turning, in_rad)| turning.map(in_rad));
    let rate = if has(&keys::DESIRED_PER_S) {
        table.number(&keys::DESIRED_PER_S, found)
    } else {
        Entry::Absent(&keys::DESIRED_PER_S)
    };
    let until = table.number(&keys::MOVES_UNTIL_S, found);
    if until.is_present() && !speeds.iter().any(|speed| table.has(speed)) {
        let help = speeds.iter().map(|speed| speed.write_example());
        let help = help.collect::<Vec<_>>().join(", or ");
        found.add(
            table.span_of(&keys::MOVES_UNTIL_S),
            table.path_of(&keys::MOVES_UNTIL_S),
            "`moves_until_s` says when something comes to rest, and nothing moves",
            format!("remove it, or {help}"),
        );
        return None;
    }
    let velocity_m_per_s = velocity.map(Some).or(None);
    let angular_velocity_rad_per_s = turning.map(Some).or(None);
    let desired_per_s = rate.map(Some).or(None);
    let moves_until_s = until.map(Some).or(None);
    Some(Motion {
        velocity_m_per_s: velocity_m_per_s?,
        angular_velocity_rad_per_s: angular_velocity_rad_per_s?,
        desired_per_s: desired_per_s?,
        moves_until_s: moves_until_s?,
    })
}

/// The keys and values of a motion, as they stand in the file.
pub(super) fn written(motion: &Motion) -> impl Iterator<Item = (&'static str, String)> + use<> {
    let turning = motion.angular_velocity_rad_per_s;
    [
        (
            &keys::VELOCITY_M_PER_S,
            motion.velocity_m_per_s.map(|it| vector(&it)),
        ),
        (
            &keys::ANGULAR_VELOCITY_RAD_PER_S,
            turning.map(|it| vector(&it)),
        ),
        (&keys::DESIRED_PER_S, motion.desired_per_s.map(number)),
        (&keys::MOVES_UNTIL_S, motion.moves_until_s.map(number)),
    ]
    .into_iter()
    .filter_map(|(key, value)| Some((key.name, value?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_comes_to_rest_where_its_velocities_lead() {
        let motion = Motion {
            velocity_m_per_s: Some([0.2, 0.0, -0.1]),
            angular_velocity_rad_per_s: Some([0.0, 0.3, 0.0]),
            desired_per_s: Some(-2.0),
            moves_until_s: Some(0.13),
        };
        let period = 0.05;
        let (mut point, mut turned, mut value) = ([1.0, 2.0, 3.0], 0.0, 7.0);
        for tick in 0..6 {
            let t_s = f64::from(tick) * period;
            let here = motion.point_at([1.0, 2.0, 3.0], t_s);
            let now = motion.during(t_s, period);
            for axis in 0..3 {
                assert!((here[axis] - point[axis]).abs() < 1e-15, "tick {tick}");
                point[axis] += now.velocity_m_per_s.expect("it moves")[axis] * period;
            }
            assert!((motion.turned_at(t_s)[1] - turned).abs() < 1e-15);
            assert!((motion.value_at(7.0, t_s) - value).abs() < 1e-14);
            turned += now.angular_velocity_rad_per_s.expect("it turns")[1] * period;
            value += now.desired_per_s.expect("it moves") * period;
        }
        assert!((point[0] - 1.026).abs() < 1e-15);
        assert!((turned - 0.039).abs() < 1e-15 && (value - 6.74).abs() < 1e-14);
        let rest = motion.during(0.15, period);
        assert_eq!(rest.velocity_m_per_s, Some([0.0; 3]));
        assert_eq!(rest.desired_per_s, Some(0.0));
    }
}
