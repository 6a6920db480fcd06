//! Power, stops, the speed slider and outputs: what the pendant and the dashboard switch.

use super::controller::{Controller, Safety};
use super::fields::{ANALOG, ANALOG_MASK, DIGITAL, SLIDER, SLIDER_MASK};
use crate::status::{ROBOT_MODE_RUNNING, runtime_state};
use crate::wire::Value;

/// How long a protective stop cannot be released [s].
pub(super) const UNLOCK_AFTER_S: f64 = 5.0;

/// Power of the arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Power {
    Off,
    /// Powered, with the brakes on.
    Idle,
    Running,
}

impl Controller {
    pub(super) fn robot_mode(&self) -> i32 {
        match self.power {
            Power::Off => 3,
            Power::Idle => 5,
            Power::Running => ROBOT_MODE_RUNNING,
        }
    }

    pub(super) fn safety_mode(&self) -> i32 {
        match self.safety {
            Safety::Normal => 1,
            Safety::ProtectiveStop => 3,
            Safety::EmergencyStop => 7,
        }
    }

    /// Whether an emergency stop and whether a protective stop is in force.
    pub(super) fn stops(&self) -> (bool, bool) {
        (
            self.safety == Safety::EmergencyStop,
            self.safety == Safety::ProtectiveStop,
        )
    }

    pub(super) fn runtime_state(&self) -> u32 {
        match (&self.running, self.paused) {
            (None, _) => runtime_state::STOPPED,
            (Some(_), false) => runtime_state::PLAYING,
            (Some(_), true) => runtime_state::PAUSED,
        }
    }

    /// Why the arm cannot be moved by a program, if it cannot.
    pub(super) fn why_not_ready(&self) -> Option<&'static str> {
        if self.safety != Safety::Normal {
            return Some("a program cannot start while the arm is stopped for safety");
        }
        (self.power != Power::Running)
            .then_some("a program cannot start without power and with the brakes on")
    }

    /// Powers on; the brakes stay. `false` while a stop is in force.
    pub(super) fn power_on(&mut self) -> bool {
        let may = self.safety != Safety::EmergencyStop;
        if may && self.power == Power::Off {
            self.power = Power::Idle;
            self.note("power on");
        }
        may
    }

    pub(super) fn power_off(&mut self) {
        self.power = Power::Off;
        self.end_program("power off");
    }

    /// Powers on if need be, and releases the brakes.
    pub(super) fn release_brakes(&mut self) -> bool {
        let may = self.power_on();
        if may {
            self.power = Power::Running;
            self.note("brakes released");
        }
        may
    }

    /// Releases a protective stop, which is possible some seconds after it only.
    pub(super) fn unlock_protective_stop(&mut self) -> Result<(), f64> {
        let since = (self.cycles() - self.stopped_at) as f64 / self.rate_hz;
        if self.safety == Safety::ProtectiveStop && since < UNLOCK_AFTER_S {
            return Err(UNLOCK_AFTER_S - since);
        }
        if self.safety == Safety::ProtectiveStop {
            self.safety = Safety::Normal;
            self.note("protective stop released");
        }
        Ok(())
    }

    /// Position of the speed slider, and the factor on the arm's speed: they are one here.
    pub(super) fn speed_scaling(&self) -> f64 {
        self.slider
    }

    pub(super) fn digital_outputs(&self) -> u64 {
        u64::from(self.digital)
    }

    pub(super) fn analog_output(&self, index: usize) -> f64 {
        self.analog[index]
    }

    /// Takes over what inputs other than registers ask for.
    pub(super) fn apply_switches(&mut self) {
        let byte = |value| match value {
            Value::Uint8(value) => u32::from(value),
            _ => 0,
        };
        if let (Value::Uint32(1..), Value::Double(fraction)) = (
            self.registers.named(SLIDER_MASK),
            self.registers.named(SLIDER),
        ) {
            self.slider = fraction.clamp(0.0, 1.0);
        }
        for (mask, value, shift) in DIGITAL {
            let mask = byte(self.registers.named(mask)) << shift;
            let value = byte(self.registers.named(value)) << shift;
            self.digital = (self.digital & !mask) | (value & mask);
        }
        for (index, place) in ANALOG.into_iter().enumerate() {
            let asked = byte(self.registers.named(ANALOG_MASK)) & (1 << index) != 0;
            if let Value::Double(value) = self.registers.named(place)
                && asked
            {
                self.analog[index] = value.clamp(0.0, 1.0);
            }
        }
    }
}
