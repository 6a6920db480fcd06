//! The arm: six joints behind a servo, and how they follow, brake, or refuse to jump.

use super::config::EmulatorConfig;
use super::following::{Following, NotFollowed};
use crate::registers::JOINTS;
use conik::JointVec;
use conik_sim::servo::{BadServoModel, Servo, ServoModel};

/// The slider slows time down; at 0 it would stand still for ever.
const LEAST_SLIDER: f64 = 0.001;

/// What a program has the joints do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Motion {
    /// Nothing: stand, or come to rest.
    Rest,
    /// `servoj`: target [rad], lookahead [s], 0.03 to 0.2, and gain, 100 to 2000.
    Servo {
        target: [f64; JOINTS],
        lookahead_s: f64,
        gain: f64,
    },
    /// `stopj` with this deceleration [rad/s²].
    Brake(f64),
}

#[derive(Debug)]
pub(super) struct Arm {
    servo: Servo,
    /// Position and velocity one cycle ago: what the arm measures.
    actual: ([f64; JOINTS], [f64; JOINTS]),
    following: Following,
    stop_deceleration: f64,
}

impl Arm {
    pub(super) fn new(config: &EmulatorConfig) -> Result<Self, BadServoModel> {
        let model = ServoModel {
            // Each `servoj` brings its own; these two count for nothing before.
            lookahead_s: 0.1,
            gain_per_s2: 300.0,
            acceleration_limit: config.acceleration_limit,
        };
        Ok(Self {
            servo: Servo::at_rest(model, config.arm.most_speed().into(), config.q0)?,
            actual: (six(&config.q0), [0.0; JOINTS]),
            following: Following::new(config.largest_step, config.overspeed_s, config.rate_hz),
            stop_deceleration: config.stop_deceleration,
        })
    }

    /// Takes the commanded state for the measured one, before the next motion changes it.
    pub(super) fn measure(&mut self, slider: f64) {
        self.actual = (self.q(), self.qd(slider));
    }

    /// One control cycle of a motion. Before a target that cannot be followed the arm brakes.
    pub(super) fn follow(
        &mut self,
        motion: Motion,
        cycle_s: f64,
        slider: f64,
    ) -> Result<(), NotFollowed> {
        let (deceleration, followed) = match motion {
            Motion::Servo {
                target,
                lookahead_s,
                gain,
            } => {
                // Within servoj's ranges, so that no servo refuses them.
                let _ = self.servo.set_model(ServoModel {
                    lookahead_s,
                    gain_per_s2: gain,
                    ..*self.servo.model()
                });
                let followed = self.following.check(&target, &self.servo);
                if followed.is_ok() {
                    let slowed = cycle_s * slider.max(LEAST_SLIDER);
                    self.servo.follow(&target.into(), slowed);
                    return followed;
                }
                (self.stop_deceleration, followed)
            }
            Motion::Brake(deceleration) => (deceleration, Ok(())),
            Motion::Rest => (self.stop_deceleration, Ok(())),
        };
        self.servo.brake(deceleration, cycle_s);
        if self.servo.is_still() {
            self.following.forget();
        }
        followed
    }

    /// Forgets the last target: the next one is held against where the arm stands.
    pub(super) fn forget_target(&mut self) {
        self.following.forget();
    }

    pub(super) fn is_still(&self) -> bool {
        self.servo.is_still()
    }

    pub(super) fn model(&self) -> &ServoModel {
        self.servo.model()
    }

    /// Commanded positions [rad].
    pub(super) fn q(&self) -> [f64; JOINTS] {
        six(self.servo.q())
    }

    /// Commanded speeds [rad/s]; the speed slider slows them down.
    pub(super) fn qd(&self, slider: f64) -> [f64; JOINTS] {
        six(self.servo.qd()).map(|speed| speed * slider)
    }

    /// Commanded accelerations [rad/s²].
    pub(super) fn qdd(&self) -> [f64; JOINTS] {
        six(self.servo.qdd())
    }

    /// Measured positions [rad].
    pub(super) fn actual_q(&self) -> [f64; JOINTS] {
        self.actual.0
    }

    /// Measured speeds [rad/s].
    pub(super) fn actual_qd(&self) -> [f64; JOINTS] {
        self.actual.1
    }
}

pub(super) fn six(values: &JointVec) -> [f64; JOINTS] {
    std::array::from_fn(|joint| values[joint])
}
