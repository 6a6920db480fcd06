//! An interpreted program, control cycle by control cycle, and what it finds around it.

use super::arm::{Arm, Motion};
use super::fields::InputField;
use super::log::Log;
use super::registers::Registers;
use super::running::ArmState;
use super::watchdog::Watchdogs;
use crate::urscript::{
    Joints, Machine, Pause, Program, Register, ScriptError, Surroundings, WatchdogAction,
};
use crate::wire::Value;

/// A time that exceeds whole cycles by no more than this part of one counts as whole.
const ROUNDING: f64 = 1e-6;

/// A program while it runs.
#[derive(Clone, Debug)]
pub(super) struct ScriptProgram {
    program: Program,
    machine: Machine,
    motion: Motion,
    left: Left,
}

/// What is left of the call that takes time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Left {
    /// So many control cycles.
    Cycles(u64),
    /// Until the arm stands still.
    Braking,
    /// The program is over.
    Nothing,
}

impl ScriptProgram {
    pub(super) fn new(program: Program) -> Self {
        Self {
            machine: Machine::new(&program),
            program,
            motion: Motion::Rest,
            left: Left::Cycles(0),
        }
    }

    pub(super) fn program(&self) -> &Program {
        &self.program
    }

    /// Whether the last line is behind it.
    pub(super) fn is_over(&self) -> bool {
        self.left == Left::Nothing
    }

    /// One control cycle.
    pub(super) fn cycle(&mut self, around: &mut Around) -> Result<Motion, ScriptError> {
        let goes_on = match self.left {
            Left::Cycles(left) => left == 0,
            Left::Braking => around.arm.is_still(),
            Left::Nothing => false,
        };
        if goes_on {
            let pause = self.machine.run(around)?;
            let cycles = |time_s: f64| {
                let cycles = (time_s / around.cycle_s - ROUNDING).ceil().max(1.0);
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // At least 1.
                Left::Cycles(cycles as u64)
            };
            (self.motion, self.left) = match pause {
                Pause::Servoj {
                    target,
                    time_s,
                    lookahead_s,
                    gain,
                } => {
                    let motion = Motion::Servo {
                        target,
                        lookahead_s,
                        gain,
                    };
                    (motion, cycles(time_s))
                }
                Pause::Stopj { deceleration } => (Motion::Brake(deceleration), Left::Braking),
                Pause::Sleep { time_s } => (Motion::Rest, cycles(time_s)),
                Pause::Sync => (Motion::Rest, Left::Cycles(1)),
                Pause::Ended => (Motion::Rest, Left::Nothing),
            };
        }
        if let Left::Cycles(left) = &mut self.left {
            *left = left.saturating_sub(1);
        }
        Ok(self.motion)
    }
}

/// What was put on the flange.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Mounted {
    /// [kg].
    pub(super) payload_kg: f64,
    /// The tool in the flange's frame: a point [m] and a rotation vector [rad].
    pub(super) tcp: [f64; 6],
}

/// The parts of the controller that a program reaches.
#[derive(Debug)]
pub(super) struct Around<'a> {
    pub(super) registers: &'a mut Registers,
    pub(super) arm: &'a Arm,
    pub(super) watchdogs: &'a mut Watchdogs,
    pub(super) mounted: &'a mut Mounted,
    pub(super) log: &'a mut Log,
    pub(super) time_s: f64,
    pub(super) cycle_s: f64,
    /// Factor on the arm's speed.
    pub(super) slider: f64,
}

impl Around<'_> {
    pub(super) fn arm_state(&self) -> ArmState {
        ArmState {
            q: self.arm.actual_q(),
            target_qd: self.arm.qd(self.slider),
            cycle_s: self.cycle_s,
        }
    }
}

impl Surroundings for Around<'_> {
    fn input(&self, kind: Register, address: usize) -> f64 {
        match kind {
            Register::Float => match self.registers.input(InputField::Double(address)) {
                Value::Double(value) => value,
                _ => 0.0,
            },
            Register::Integer => f64::from(self.registers.input_int(address)),
            Register::Boolean => f64::from(u8::from(self.registers.input_bit(address))),
        }
    }

    fn output(&self, kind: Register, address: usize) -> f64 {
        match kind {
            Register::Float => self.registers.output_double(address),
            Register::Integer => f64::from(self.registers.output_int(address)),
            Register::Boolean => f64::from(u8::from(self.registers.output_bit(address))),
        }
    }

    fn write_output(&mut self, kind: Register, address: usize, value: f64) {
        match kind {
            Register::Float => self.registers.write_output_double(address, value),
            #[allow(clippy::cast_possible_truncation)] // It came from one.
            Register::Integer => self.registers.write_output_int(address, value as i32),
            Register::Boolean => self.registers.write_output_bit(address, value != 0.0),
        }
    }

    fn joints(&self, which: Joints) -> [f64; 6] {
        match which {
            Joints::ActualPositions => self.arm.actual_q(),
            Joints::TargetPositions => self.arm.q(),
            Joints::ActualSpeeds => self.arm.actual_qd(),
            Joints::TargetSpeeds => self.arm.qd(self.slider),
        }
    }

    fn cycle_s(&self) -> f64 {
        self.cycle_s
    }

    fn set_payload(&mut self, mass_kg: f64) {
        self.mounted.payload_kg = mass_kg;
        self.log
            .note(self.time_s, &format!("payload is {mass_kg} kg"));
    }

    fn set_tcp(&mut self, pose: [f64; 6]) {
        self.mounted.tcp = pose;
        self.log
            .note(self.time_s, &format!("tool centre point is {pose:?}"));
    }

    fn set_watchdog(&mut self, input: &str, least_hz: f64, action: WatchdogAction) -> bool {
        let allowed = 1.0 / (least_hz * self.cycle_s);
        self.watchdogs.set(input, allowed, action)
    }

    fn say(&mut self, line: &str) {
        let line: String = line.chars().take(200).collect();
        self.log.note(self.time_s, &format!("program says: {line}"));
    }
}
