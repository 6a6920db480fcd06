//! What a controller says of itself in every cycle, and the meaning of its numbers and bits.

use crate::registers::{JOINTS, Phase, RegisterBase};
use crate::wire::{FieldType, Value};

/// Bits of `robot_status_bits`.
pub mod robot_bit {
    /// The arm has power.
    pub const POWER_ON: u32 = 1;
    /// A program is running.
    pub const PROGRAM_RUNNING: u32 = 1 << 1;
}

/// Bits of `safety_status_bits`.
#[allow(missing_docs)] // Named as the maker does.
pub mod safety_bit {
    pub const NORMAL: u32 = 1;
    pub const REDUCED: u32 = 1 << 1;
    pub const PROTECTIVE_STOP: u32 = 1 << 2;
    pub const RECOVERY: u32 = 1 << 3;
    pub const SAFEGUARD_STOP: u32 = 1 << 4;
    pub const SYSTEM_EMERGENCY_STOP: u32 = 1 << 5;
    pub const ROBOT_EMERGENCY_STOP: u32 = 1 << 6;
    pub const EMERGENCY_STOP: u32 = 1 << 7;
    pub const VIOLATION: u32 = 1 << 8;
    pub const FAULT: u32 = 1 << 9;
    pub const STOPPED_DUE_TO_SAFETY: u32 = 1 << 10;
}

/// `robot_mode` of an arm whose brakes are released and that may move.
pub const ROBOT_MODE_RUNNING: i32 = 7;

/// `runtime_state`: what the controller does with its program.
#[allow(missing_docs)] // Named as the maker does.
pub mod runtime_state {
    pub const STOPPING: u32 = 0;
    pub const STOPPED: u32 = 1;
    pub const PLAYING: u32 = 2;
    pub const PAUSING: u32 = 3;
    pub const PAUSED: u32 = 4;
    pub const RESUMING: u32 = 5;
}

/// The controller's state in one cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// Time since the controller was switched on [s].
    pub timestamp: f64,
    /// Joint positions that the controller commands [rad].
    pub target_q: [f64; JOINTS],
    /// Measured joint positions [rad].
    pub actual_q: [f64; JOINTS],
    /// Measured joint velocities [rad/s].
    pub actual_qd: [f64; JOINTS],
    /// One of [`runtime_state`].
    pub runtime_state: u32,
    /// [`ROBOT_MODE_RUNNING`] or another mode.
    pub robot_mode: i32,
    /// See [`safety_bit`].
    pub safety_bits: u32,
    /// See [`robot_bit`].
    pub robot_bits: u32,
    /// How much slower than planned the controller moves at present, 1 if not at all.
    pub speed_scaling: f64,
    /// Position of the speed slider, 0 to 1.
    pub speed_slider: f64,
    /// Phase of the servo program; meaningless unless `session` is ours.
    pub phase: Option<Phase>,
    /// Session of the servo program that last ran.
    pub session: i32,
}

impl Status {
    /// The output fields that make up a status, in order.
    pub fn fields(registers: RegisterBase) -> Vec<(String, FieldType)> {
        let fixed = [
            ("timestamp", FieldType::Double),
            ("target_q", FieldType::Vector6d),
            ("actual_q", FieldType::Vector6d),
            ("actual_qd", FieldType::Vector6d),
            ("runtime_state", FieldType::Uint32),
            ("robot_mode", FieldType::Int32),
            ("safety_status_bits", FieldType::Uint32),
            ("robot_status_bits", FieldType::Uint32),
            ("speed_scaling", FieldType::Double),
            ("target_speed_fraction", FieldType::Double),
        ];
        fixed
            .map(|(name, field_type)| (name.to_owned(), field_type))
            .into_iter()
            .chain(registers.outputs())
            .collect()
    }

    /// The status in the values of these fields; `None` if they are not of these types.
    pub fn from_values(values: &[Value]) -> Option<Self> {
        let &[
            Value::Double(timestamp),
            Value::Vector6d(target_q),
            Value::Vector6d(actual_q),
            Value::Vector6d(actual_qd),
            Value::Uint32(runtime_state),
            Value::Int32(robot_mode),
            Value::Uint32(safety_bits),
            Value::Uint32(robot_bits),
            Value::Double(speed_scaling),
            Value::Double(speed_slider),
            Value::Int32(phase),
            Value::Int32(session),
        ] = values
        else {
            return None;
        };
        Some(Self {
            timestamp,
            target_q,
            actual_q,
            actual_qd,
            runtime_state,
            robot_mode,
            safety_bits,
            robot_bits,
            speed_scaling,
            speed_slider,
            phase: Phase::from_number(phase),
            session,
        })
    }

    /// Whether a program is running, not paused nor on its way to either.
    pub fn program_is_running(&self) -> bool {
        self.runtime_state == runtime_state::PLAYING
            && self.robot_bits & robot_bit::PROGRAM_RUNNING != 0
    }

    /// Whether no program moves the arm: none is there, or it is paused.
    pub fn program_is_still(&self) -> bool {
        matches!(
            self.runtime_state,
            runtime_state::STOPPED | runtime_state::PAUSED
        )
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        [self.timestamp, self.speed_scaling, self.speed_slider]
            .iter()
            .chain(&self.target_q)
            .chain(&self.actual_q)
            .chain(&self.actual_qd)
            .all(|value| value.is_finite())
    }
}
