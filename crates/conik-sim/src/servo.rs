//! The simulated joint servo: how an arm's joints follow the references that `servoj` is given.
//!
//! Per joint, with `q_ref` the reference, K the gain and L the lookahead,
//!
//! ```text
//! q̈ = K (q_ref − q − L q̇),   |q̈| ≤ acceleration limit,   |q̇| ≤ speed limit.
//! ```
//!
//! The model is **assumed, not identified**: it agrees with what the maker says of the two
//! parameters (the gain acts as a proportional term, the lookahead projects the present position
//! forward with the present speed) and with published delays of about L, but nobody has published
//! an identification of the gain. Its delay to a ramp is exactly L whatever K is; its damping is
//! ζ = L √K / 2, so a short lookahead with a high gain rings.

use conik::JointVec;

/// How a joint follows its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoModel {
    /// L: how far ahead the present speed is projected [s].
    pub lookahead_s: f64,
    /// K: acceleration per projected error [1/s²].
    pub gain_per_s2: f64,
    /// Largest acceleration of every joint [rad/s²].
    pub acceleration_limit: f64,
}

/// A set of model parameters that no servo can have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the servo's {name} is {value}; it must be finite and above zero")]
pub struct BadServoModel {
    /// Which parameter.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
}

/// The joints of a simulated arm.
#[derive(Clone, Copy, Debug)]
pub struct Servo {
    model: ServoModel,
    speed_limits: JointVec,
    q: JointVec,
    qd: JointVec,
    qdd: JointVec,
}

impl Servo {
    /// An arm that stands still at `q` [rad], with the largest speed of each of its joints [rad/s].
    pub fn at_rest(
        model: ServoModel,
        speed_limits: JointVec,
        q: JointVec,
    ) -> Result<Self, BadServoModel> {
        model.check()?;
        for limit in speed_limits.iter() {
            check("speed limit [rad/s]", *limit)?;
        }
        let zeros = JointVec::zeros(q.len());
        Ok(Self {
            model,
            speed_limits,
            q,
            qd: zeros,
            qdd: zeros,
        })
    }

    /// How the joints follow.
    pub fn model(&self) -> &ServoModel {
        &self.model
    }

    /// Joint positions [rad].
    pub fn q(&self) -> &JointVec {
        &self.q
    }

    /// Joint velocities [rad/s].
    pub fn qd(&self) -> &JointVec {
        &self.qd
    }

    /// Joint accelerations [rad/s²] over the last substep.
    pub fn qdd(&self) -> &JointVec {
        &self.qdd
    }

    /// Whether no joint moves.
    pub fn is_still(&self) -> bool {
        self.qd.iter().all(|speed| *speed == 0.0)
    }

    /// Changes how the joints follow; position and speed stay.
    pub fn set_model(&mut self, model: ServoModel) -> Result<(), BadServoModel> {
        model.check()?;
        self.model = model;
        Ok(())
    }

    /// The largest speed of each joint [rad/s].
    pub fn speed_limits(&self) -> &JointVec {
        &self.speed_limits
    }

    /// The joint (from 0) that needs the largest share of its speed limit to follow `q_ref` [rad], and
    /// the speed that it needs [rad/s]: |`q_ref` − q| / L, which to a steady ramp is the ramp's own
    /// speed.
    pub fn speed_needed(&self, q_ref: &JointVec) -> Option<(usize, f64)> {
        let joints = q_ref.iter().zip(self.q.iter()).enumerate();
        let share = |(joint, speed): (usize, f64)| speed / self.speed_limits[joint];
        joints
            .map(|(joint, (to, from))| (joint, (to - from).abs() / self.model.lookahead_s))
            .max_by(|a, b| share(*a).total_cmp(&share(*b)))
    }

    /// Lets the joints follow `q_ref` [rad], held constant, for `duration` [s].
    ///
    /// Joints beyond the length of `q_ref` hold their speed; the caller gives one entry per joint.
    pub fn follow(&mut self, q_ref: &JointVec, duration: f64) {
        let substeps = self.model.substeps(duration);
        let dt = duration / f64::from(substeps);
        let ServoModel {
            lookahead_s,
            gain_per_s2,
            acceleration_limit,
        } = self.model;
        for _ in 0..substeps {
            for (joint, reference) in q_ref.iter().enumerate().take(self.q.len()) {
                let wanted =
                    gain_per_s2 * (reference - self.q[joint] - lookahead_s * self.qd[joint]);
                let acceleration = wanted.clamp(-acceleration_limit, acceleration_limit);
                self.advance(joint, self.qd[joint] + dt * acceleration, dt);
            }
        }
    }

    /// Brings the joints to rest at `deceleration` [rad/s²] for `duration` [s]: `stopj`.
    pub fn brake(&mut self, deceleration: f64, duration: f64) {
        for joint in 0..self.q.len() {
            let speed = self.qd[joint];
            let slower = (speed.abs() - deceleration * duration).max(0.0);
            self.advance(joint, slower.copysign(speed), duration);
            if slower == 0.0 {
                self.qd[joint] = 0.0;
            }
        }
    }

    /// Velocity first, then position with the new velocity: the order that keeps an oscillator stable.
    fn advance(&mut self, joint: usize, speed: f64, dt: f64) {
        let limit = self.speed_limits[joint];
        let speed = speed.clamp(-limit, limit);
        self.qdd[joint] = (speed - self.qd[joint]) / dt;
        self.qd[joint] = speed;
        self.q[joint] += dt * speed;
    }
}

impl ServoModel {
    fn check(&self) -> Result<(), BadServoModel> {
        for (name, value) in [
            ("lookahead [s]", self.lookahead_s),
            ("gain [1/s²]", self.gain_per_s2),
            ("acceleration limit [rad/s²]", self.acceleration_limit),
        ] {
            check(name, value)?;
        }
        Ok(())
    }

    /// Enough substeps that the faster of the model's two rates, L K and √K, turns by at most a
    /// tenth in each: far inside the limit of the integration, 2, at 125 Hz with gain 2000 too.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates, then bounded.
    fn substeps(&self, duration: f64) -> u32 {
        let rate = (self.lookahead_s * self.gain_per_s2).max(self.gain_per_s2.sqrt());
        ((duration * rate / 0.1).ceil() as u32).clamp(1, 10_000)
    }
}

fn check(name: &'static str, value: f64) -> Result<(), BadServoModel> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(BadServoModel { name, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UR5: ServoModel = ServoModel {
        lookahead_s: 0.1,
        gain_per_s2: 300.0,
        acceleration_limit: 40.0,
    };
    const SPEED_LIMIT: f64 = std::f64::consts::PI;
    const CYCLE: f64 = 0.008;

    fn standing(model: ServoModel, joints: usize) -> Servo {
        let mut limits = JointVec::zeros(joints);
        limits.fill(SPEED_LIMIT);
        Servo::at_rest(model, limits, JointVec::zeros(joints)).unwrap()
    }

    /// The pairs that users set: soft, the maker's driver, the corners of the allowed range.
    const TUNINGS: [(f64, f64); 6] = [
        (0.1, 300.0),
        (0.03, 2000.0),
        (0.03, 100.0),
        (0.2, 100.0),
        (0.2, 2000.0),
        (0.03, 1200.0),
    ];

    fn tuned((lookahead_s, gain_per_s2): (f64, f64)) -> ServoModel {
        ServoModel {
            lookahead_s,
            gain_per_s2,
            ..UR5
        }
    }

    #[test]
    fn delay_to_a_ramp_is_the_lookahead() {
        let speed = 0.5;
        for tuning in TUNINGS {
            let mut servo = standing(tuned(tuning), 6);
            let mut reference = JointVec::zeros(6);
            for tick in 0..1000 {
                reference.fill(speed * CYCLE * f64::from(tick));
                servo.follow(&reference, CYCLE);
            }
            let ramp = speed * CYCLE * 1000.0;
            let delay = (ramp - servo.q()[2]) / speed;
            assert!(
                (delay - tuning.0).abs() <= CYCLE,
                "{tuning:?}: delay {delay}"
            );
        }
    }

    #[test]
    fn limits_hold_whatever_the_reference_does() {
        for tuning in TUNINGS {
            let mut servo = standing(tuned(tuning), 2);
            for tick in 0..500 {
                let side = if tick / 40 % 2 == 0 { 3.0 } else { -3.0 };
                servo.follow(&JointVec::from([side, -side]), CYCLE);
                let (_, speed) = servo.qd().largest().unwrap();
                let (_, acceleration) = servo.qdd().largest().unwrap();
                assert!(speed <= SPEED_LIMIT, "{tuning:?}: {speed} rad/s");
                assert!(
                    acceleration <= UR5.acceleration_limit * (1.0 + 1e-9),
                    "{tuning:?}: {acceleration} rad/s²"
                );
            }
        }
    }

    #[test]
    fn the_speed_needed_for_a_steady_ramp_is_the_ramps_own() {
        let (speed, cycle) = (0.5, 0.002);
        for tuning in TUNINGS {
            let mut servo = standing(tuned(tuning), 6);
            let mut reference = JointVec::zeros(6);
            for tick in 0..4000 {
                reference[4] = speed * cycle * f64::from(tick);
                servo.follow(&reference, cycle);
            }
            let (joint, needed) = servo.speed_needed(&reference).unwrap();
            assert_eq!(joint, 4);
            // The reference stands still for a cycle, and the arm comes nearer; the least damped
            // still rings a little.
            let nearer = speed * cycle / tuning.0 + 1e-4;
            assert!((needed - speed).abs() <= nearer, "{tuning:?}: {needed}");
        }
    }

    #[test]
    fn each_joint_has_a_limit_of_its_own() {
        let limits = JointVec::from([0.5, 2.0]);
        let mut servo = Servo::at_rest(UR5, limits, JointVec::zeros(2)).unwrap();
        for _ in 0..50 {
            servo.follow(&JointVec::from([5.0, 5.0]), CYCLE);
        }
        assert_eq!(**servo.qd(), [0.5, 2.0]);
        let far = JointVec::from([5.0, 5.0]);
        let (joint, _) = servo.speed_needed(&far).unwrap();
        assert_eq!(joint, 0, "the slower joint is the one that cannot");
    }

    #[test]
    fn settles_on_a_constant_reference_without_blowing_up() {
        for tuning in TUNINGS {
            let mut servo = standing(tuned(tuning), 1);
            for _ in 0..2500 {
                servo.follow(&JointVec::from([0.3]), CYCLE);
            }
            assert!((servo.q()[0] - 0.3).abs() < 1e-6, "{tuning:?}: {servo:?}");
        }
    }

    #[test]
    fn substeps_leave_the_motion_independent_of_the_cycle() {
        let mut coarse = standing(tuned((0.03, 2000.0)), 1);
        let mut fine = coarse;
        for _ in 0..25 {
            coarse.follow(&JointVec::from([0.01]), 0.008);
        }
        for _ in 0..1000 {
            fine.follow(&JointVec::from([0.01]), 0.0002);
        }
        assert!((coarse.q()[0] - fine.q()[0]).abs() < 2e-4);
    }

    #[test]
    fn braking_ends_at_rest_and_never_reverses() {
        let mut servo = standing(UR5, 1);
        for _ in 0..50 {
            servo.follow(&JointVec::from([1.0]), CYCLE);
        }
        assert!(servo.qd()[0] > 0.1);
        for _ in 0..200 {
            let before = servo.q()[0];
            servo.brake(4.0, CYCLE);
            assert!(servo.q()[0] >= before);
        }
        assert!(servo.is_still());
    }

    #[test]
    fn a_model_that_no_servo_can_have_is_refused() {
        let model = ServoModel {
            gain_per_s2: f64::NAN,
            ..UR5
        };
        let (zeros, ones) = (JointVec::zeros(1), JointVec::from([1.0]));
        let error = Servo::at_rest(model, ones, zeros).unwrap_err();
        assert_eq!(error.name, "gain [1/s²]");
        let error = Servo::at_rest(UR5, zeros, zeros).unwrap_err();
        assert_eq!(error.name, "speed limit [rad/s]");
    }
}
