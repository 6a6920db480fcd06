//! How far something is from where the scenario has it, after a change: it does not jump, it glides.

use conik::Vec3;

/// What is still on its way. Zeros: it is there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Away {
    /// From its point in the scenario to where it is [m].
    pub point_m: Vec3,
    /// Rotation vector from its direction or orientation in the scenario to the present one [rad].
    pub turn_rad: Vec3,
    /// From its least allowed value in the scenario to the one in force [task's unit].
    pub min: f64,
    /// From its greatest allowed value in the scenario to the one in force [task's unit].
    pub max: f64,
}

/// How fast things go where a change has put them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlideSpeed {
    /// Points and shapes [m/s].
    pub m_per_s: f64,
    /// Directions and orientations [rad/s].
    pub rad_per_s: f64,
    /// Bounds [task's unit/s].
    pub unit_per_s: f64,
}

impl Default for GlideSpeed {
    /// Slow enough that an arm can get out of the way.
    fn default() -> Self {
        Self {
            m_per_s: 0.5,
            rad_per_s: 1.0,
            unit_per_s: 0.5,
        }
    }
}

impl GlideSpeed {
    /// The same number for everything.
    pub const fn of(speed: f64) -> Self {
        Self {
            m_per_s: speed,
            rad_per_s: speed,
            unit_per_s: speed,
        }
    }
}

impl Away {
    /// Whether it is there.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// What is left of it after `period_s` [s].
    #[must_use]
    pub fn after(&self, period_s: f64, speed: &GlideSpeed) -> Self {
        Self {
            point_m: nearer(self.point_m, speed.m_per_s * period_s),
            turn_rad: nearer(self.turn_rad, speed.rad_per_s * period_s),
            min: scalar_nearer(self.min, speed.unit_per_s * period_s),
            max: scalar_nearer(self.max, speed.unit_per_s * period_s),
        }
    }
}

/// Shorter by `way`, or zero.
fn nearer(away: Vec3, way: f64) -> Vec3 {
    let length = away.norm();
    if length <= way {
        Vec3::default()
    } else {
        away * (1.0 - way / length)
    }
}

fn scalar_nearer(away: f64, way: f64) -> f64 {
    away.signum() * (away.abs() - way).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_glides_arrives_in_the_time_that_its_speed_needs() {
        let mut away = Away {
            point_m: Vec3::new(0.03, 0.0, -0.04),
            turn_rad: Vec3::new(0.0, 0.2, 0.0),
            min: -0.01,
            max: 0.0,
        };
        let speed = GlideSpeed {
            m_per_s: 0.5,
            rad_per_s: 1.0,
            unit_per_s: 0.1,
        };
        for tick in 0..5 {
            let left = 0.05 - 0.5 * 0.02 * f64::from(tick);
            assert!((away.point_m.norm() - left).abs() < 1e-15, "tick {tick}");
            assert!(away.point_m.x >= 0.0 && away.point_m.z <= 0.0);
            away = away.after(0.02, &speed);
        }
        assert!(away.point_m.norm() < 1e-15);
        assert!((away.turn_rad.y - 0.1).abs() < 1e-15);
        assert_eq!((away.min, away.max), (0.0, 0.0));
        for _ in 0..6 {
            away = away.after(0.02, &speed);
        }
        assert!(away.is_none());
    }
}
