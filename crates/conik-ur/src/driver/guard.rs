//! The last check of a reference before it goes to the arm: what fails is refused, never clamped.

use super::config::{SPEED_CHANGE_ALLOWED, UrConfig};
use super::fault::{FIRST_REFERENCE_AWAY, REFERENCE_REFUSED};
use crate::registers::JOINTS;
use conik_sim::arm::{ArmError, Reference};

/// Rounding that a speed exactly at its limit may bring with it.
const SLACK: f64 = 1e-9;

/// The maker's names of the joints.
const JOINT_NAMES: [&str; JOINTS] = ["base", "shoulder", "elbow", "wrist 1", "wrist 2", "wrist 3"];

/// A reference that may be sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Checked {
    /// Joint positions [rad].
    pub(super) q: [f64; JOINTS],
    /// Joint velocities [rad/s].
    pub(super) qd: [f64; JOINTS],
}

/// Checks references one after another.
#[derive(Clone, Debug)]
pub(super) struct Guard {
    period_s: f64,
    speed_limit: [f64; JOINTS],
    acceleration_limit: [f64; JOINTS],
    position_limit: [f64; JOINTS],
    first_tolerance: f64,
    previous: Option<Previous>,
    /// References that passed.
    passed: u64,
}

/// The reference sent last.
#[derive(Clone, Copy, Debug)]
struct Previous {
    q: [f64; JOINTS],
    /// From the one before to it [rad]; zero for the first, to which nothing moved.
    step: [f64; JOINTS],
}

impl Guard {
    /// Checks with these speed limits [rad/s] and the other limits of `config`.
    pub(super) fn new(config: &UrConfig, speed_limit: [f64; JOINTS], period_s: f64) -> Self {
        Self {
            period_s,
            speed_limit,
            acceleration_limit: config.acceleration_limit.unwrap_or_else(|| {
                let change = |speed: f64| SPEED_CHANGE_ALLOWED * speed / period_s;
                speed_limit.map(change)
            }),
            position_limit: config.position_limit,
            first_tolerance: config.first_reference_tolerance,
            previous: None,
            passed: 0,
        }
    }

    /// The reference as it may be sent to an arm that stands at `present` [rad]; a refusal says which
    /// one it is, counted from 0 as the rows of the log are.
    ///
    /// `present` counts for the first reference only: later ones follow on each other, since the
    /// arm lags behind them by design.
    pub(super) fn check(
        &mut self,
        reference: &Reference,
        present: &[f64; JOINTS],
    ) -> Result<Checked, ArmError> {
        let checked = self.check_all(reference, present).map_err(|fault| {
            let number = self.passed;
            let t_s = number as f64 * self.period_s;
            let detail = format!("reference {number} (t = {t_s:.3} s): {}", fault.detail);
            ArmError::new(fault.name, detail)
        })?;
        self.passed += 1;
        Ok(checked)
    }

    fn check_all(
        &mut self,
        reference: &Reference,
        present: &[f64; JOINTS],
    ) -> Result<Checked, ArmError> {
        let q = six("position", &reference.q)?;
        let qd = six("velocity", &reference.qd)?;
        six("acceleration", &reference.qdd)?;
        for joint in 0..JOINTS {
            let limit = self.position_limit[joint];
            if q[joint].abs() > limit {
                return Err(refused(format!(
                    "{} would go to {:.6} rad; its limit is {limit:.6} rad",
                    name(joint),
                    q[joint]
                )));
            }
            self.check_step(joint, q[joint], present[joint])?;
            let (speed, limit) = (qd[joint].abs(), self.speed_limit[joint]);
            if speed > limit * (1.0 + SLACK) {
                return Err(refused(format!(
                    "{}: the reference velocity is {:.6} rad/s; its limit is {limit:.6} rad/s",
                    name(joint),
                    qd[joint]
                )));
            }
        }
        let step = match &self.previous {
            Some(previous) => std::array::from_fn(|joint| q[joint] - previous.q[joint]),
            None => [0.0; JOINTS],
        };
        self.previous = Some(Previous { q, step });
        Ok(Checked { q, qd })
    }

    fn check_step(&self, joint: usize, q: f64, present: f64) -> Result<(), ArmError> {
        let limit = self.speed_limit[joint];
        let cycle_at_limit = limit * self.period_s;
        let Some(previous) = &self.previous else {
            let tolerance = self.first_tolerance + cycle_at_limit;
            let away = (q - present).abs();
            if away > tolerance {
                let detail = format!(
                    "{} is at {present:.6} rad and the first reference at {q:.6} rad, {away:.6} \
                     rad away; {tolerance:.6} rad are allowed: bring the arm to the start, or \
                     start from where it is",
                    name(joint)
                );
                return Err(ArmError::new(FIRST_REFERENCE_AWAY, detail));
            }
            return Ok(());
        };
        // What the difference of two angles may lose.
        let rounding = 4.0 * f64::EPSILON * q.abs().max(1.0);
        let step = q - previous.q[joint];
        if step.abs() > cycle_at_limit * (1.0 + SLACK) + rounding {
            return Err(refused(format!(
                "{} would move {:.6} rad in one cycle, {:.6} rad/s; its limit is {limit:.6} rad/s",
                name(joint),
                step.abs(),
                step.abs() / self.period_s
            )));
        }
        let limit = self.acceleration_limit[joint];
        let change = (step - previous.step[joint]).abs();
        let square = self.period_s * self.period_s;
        if change > limit * square * (1.0 + SLACK) + 2.0 * rounding {
            return Err(refused(format!(
                "{} would accelerate with {:.6} rad/s² (from {:.6} to {:.6} rad/s in one cycle); \
                 its limit is {limit:.6} rad/s²",
                name(joint),
                change / square,
                previous.step[joint] / self.period_s,
                step / self.period_s
            )));
        }
        Ok(())
    }
}

fn six(what: &str, values: &[f64]) -> Result<[f64; JOINTS], ArmError> {
    let six: [f64; JOINTS] = values.try_into().map_err(|_| {
        refused(format!(
            "the reference has {} joints in its {what}; a UR arm has {JOINTS}",
            values.len()
        ))
    })?;
    match six.iter().position(|value| !value.is_finite()) {
        None => Ok(six),
        Some(joint) => Err(refused(format!(
            "{}: the {what} is {}, not a finite number",
            name(joint),
            six[joint]
        ))),
    }
}

fn refused(detail: String) -> ArmError {
    ArmError::new(REFERENCE_REFUSED, detail)
}

/// Joints are counted from 1 in front of people.
fn name(joint: usize) -> String {
    format!("joint {} ({})", joint + 1, JOINT_NAMES[joint])
}

#[cfg(test)]
mod tests {
    use super::*;
    use conik::JointVec;
    use std::f64::consts::PI;

    const PERIOD: f64 = 0.008;

    fn guard() -> Guard {
        Guard::new(&UrConfig::new("arm"), [PI; JOINTS], PERIOD)
    }

    fn reference(q: [f64; 6]) -> Reference {
        Reference {
            q: q.into(),
            qd: JointVec::zeros(6),
            qdd: JointVec::zeros(6),
        }
    }

    #[test]
    fn speed_at_the_limit_passes_and_above_it_names_joint_value_and_limit() {
        let mut guard = guard();
        let mut q = [0.0, -1.5, 1.2, 6.0, -6.0, 0.0];
        guard.check(&reference(q), &q).unwrap();
        for speed in [0.5 * PI, PI, PI, PI] {
            q = q.map(|angle| angle + speed * PERIOD);
            guard.check(&reference(q), &[0.0; 6]).unwrap();
        }
        let before = q[2];
        q = q.map(|angle| angle + PI * PERIOD);
        q[2] = before + 0.04;
        let fault = guard.check(&reference(q), &[0.0; 6]).unwrap_err();
        assert_eq!(fault.name, REFERENCE_REFUSED);
        for part in [
            "reference 5 (t = 0.040 s): joint 3 (elbow)",
            "5.000000 rad/s",
            "3.141593 rad/s",
        ] {
            assert!(fault.detail.contains(part), "{fault}");
        }
    }

    #[test]
    fn acceleration_at_the_limit_passes_and_above_it_names_joint_value_and_limit() {
        let limit = 20.0;
        let config = UrConfig {
            acceleration_limit: Some([limit; 6]),
            ..UrConfig::new("arm")
        };
        let start = [0.0, -1.5, 1.2, 6.0, -6.0, 0.0];
        let mut guard = Guard::new(&config, [PI; JOINTS], PERIOD);
        let mut q = start;
        let mut speed = 0.0;
        guard.check(&reference(q), &q).unwrap();
        for direction in [1.0, 1.0, -1.0, -1.0, -1.0, 1.0] {
            speed += direction * limit * PERIOD;
            q = q.map(|angle| angle + speed * PERIOD);
            guard.check(&reference(q), &start).unwrap();
        }
        q[1] += (speed + 30.0 * PERIOD) * PERIOD;
        let fault = guard.check(&reference(q), &start).unwrap_err();
        assert_eq!(fault.name, REFERENCE_REFUSED);
        for part in ["joint 2 (shoulder)", "30.000000 rad/s²", "20.000000 rad/s²"] {
            assert!(fault.detail.contains(part), "{fault}");
        }
    }

    #[test]
    fn nothing_starts_with_a_jerk() {
        // From standstill: neither the second reference nor a reversal may change the speed at once.
        for (speeds, passes) in [
            (&[0.74 * PI][..], true),
            (&[0.76 * PI][..], false),
            (&[0.5 * PI, -0.3 * PI][..], false),
        ] {
            let mut guard = guard();
            let mut q = [0.0; 6];
            guard.check(&reference(q), &q).unwrap();
            let checked = speeds.iter().try_for_each(|speed| {
                q[3] += speed * PERIOD;
                guard.check(&reference(q), &[0.0; 6]).map(|_| ())
            });
            assert_eq!(checked.is_ok(), passes, "{speeds:?}");
        }
    }

    #[test]
    fn the_first_reference_must_be_where_the_arm_is() {
        let present = [0.1; 6];
        let allowed = 1e-3 + PI * PERIOD;
        let mut near = present;
        near[5] += allowed - 1e-9;
        guard().check(&reference(near), &present).unwrap();
        let mut away = present;
        away[5] += allowed + 1e-9;
        let fault = guard().check(&reference(away), &present).unwrap_err();
        assert_eq!(fault.name, FIRST_REFERENCE_AWAY);
        assert!(fault.detail.contains("joint 6 (wrist 3)"), "{fault}");
    }

    #[test]
    fn nothing_but_six_finite_numbers_within_the_limits_passes() {
        let present = [0.0; 6];
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for part in 0..3 {
                let mut reference = reference(present);
                let vectors = [&mut reference.q, &mut reference.qd, &mut reference.qdd];
                vectors.into_iter().nth(part).unwrap()[4] = bad;
                let fault = guard().check(&reference, &present).unwrap_err();
                assert_eq!(fault.name, REFERENCE_REFUSED);
                assert!(fault.detail.contains("joint 5 (wrist 2)"), "{fault}");
            }
        }
        let mut seven = reference(present);
        seven.q = JointVec::zeros(7);
        assert!(guard().check(&seven, &present).is_err());
        let mut fast = reference(present);
        fast.qd[0] = -3.2;
        assert!(guard().check(&fast, &present).is_err());
        let far = [6.3, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert!(guard().check(&reference(far), &far).is_err());
    }
}
