//! Points that move: along a straight line, from the start of the run on.

use serde::{Deserialize, Serialize};

use super::keys;
use super::mistake::Mistakes;
use super::table::{Entry, Table};
use super::write::{number, vector};

/// How a point moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Its velocity in the base frame [m/s].
    pub velocity_m_per_s: [f64; 3],
    /// When it comes to rest [s]; `None`: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moves_until_s: Option<f64>,
}

impl Motion {
    /// For how long the point has been moving at `t_s` [s].
    pub fn moved_for_s(&self, t_s: f64) -> f64 {
        self.moves_until_s.map_or(t_s, |until| t_s.min(until))
    }

    /// Where a point is at `t_s` [s] that is at `start` [m] at t = 0.
    pub fn point_at(&self, start: [f64; 3], t_s: f64) -> [f64; 3] {
        let moved = self.moved_for_s(t_s);
        [0, 1, 2].map(|axis| start[axis] + self.velocity_m_per_s[axis] * moved)
    }

    /// The mean velocity [m/s] from `t_s` to a period later [s]: with it, whoever knows where the point
    /// is now knows where it will be then, also in the period in which it comes to rest.
    pub fn velocity_at(&self, t_s: f64, period_s: f64) -> [f64; 3] {
        let moving = self
            .moves_until_s
            .map_or(1.0, |until| ((until - t_s) / period_s).clamp(0.0, 1.0));
        self.velocity_m_per_s.map(|speed| speed * moving)
    }
}

/// Reads how a point moves, if it does.
pub(super) fn read(table: &Table, found: &mut Mistakes) -> Entry<Motion> {
    let velocity = table.vector(&keys::VELOCITY_M_PER_S, found);
    let until = table.number(&keys::MOVES_UNTIL_S, found);
    if until.is_present() && !velocity.is_present() {
        found.add(
            table.span_of(&keys::MOVES_UNTIL_S),
            table.path_of(&keys::MOVES_UNTIL_S),
            "`moves_until_s` says when the point comes to rest, and it does not move",
            format!("remove it, or {}", keys::VELOCITY_M_PER_S.write_example()),
        );
        return Entry::Wrong;
    }
    match until.map(Some).or(None) {
        Some(moves_until_s) => velocity.map(|velocity_m_per_s| Motion {
            velocity_m_per_s,
            moves_until_s,
        }),
        None => Entry::Wrong,
    }
}

/// The keys and values of a motion, as they stand in the file.
pub(super) fn written(motion: &Motion) -> impl Iterator<Item = (&'static str, String)> + use<> {
    let velocity = vector(&motion.velocity_m_per_s);
    let until = motion
        .moves_until_s
        .map(|until| (keys::MOVES_UNTIL_S.name, number(until)));
    std::iter::once((keys::VELOCITY_M_PER_S.name, velocity)).chain(until)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_comes_to_rest_where_its_velocities_lead() {
        let motion = Motion {
            velocity_m_per_s: [0.2, 0.0, -0.1],
            moves_until_s: Some(0.13),
        };
        let period = 0.05;
        let mut point = [1.0, 2.0, 3.0];
        for tick in 0..6 {
            let t_s = f64::from(tick) * period;
            let here = motion.point_at([1.0, 2.0, 3.0], t_s);
            for axis in 0..3 {
                assert!((here[axis] - point[axis]).abs() < 1e-15, "tick {tick}");
                point[axis] = here[axis] + motion.velocity_at(t_s, period)[axis] * period;
            }
        }
        assert!((point[0] - 1.026).abs() < 1e-15);
        assert_eq!(motion.velocity_at(0.15, period), [0.0; 3]);
    }
}
