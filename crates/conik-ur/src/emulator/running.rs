//! The program that runs: ours, or one of another client that is recognised.

use super::registers::Registers;
use super::servo_program::{Motion, RunningProgram};
use super::ur_rtde_program::UrRtdeProgram;

/// A program while it runs.
#[derive(Clone, Debug)]
pub(super) enum Running {
    Servo(Box<RunningProgram>),
    UrRtde(UrRtdeProgram),
}

impl Running {
    /// What the dashboard calls it.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Servo(_) => "conik_servo",
            Self::UrRtde(_) => "rtde_control",
        }
    }

    pub(super) fn cycle(&mut self, registers: &mut Registers) -> Motion {
        match self {
            Self::Servo(program) => program.cycle(registers),
            Self::UrRtde(program) => program.cycle(registers),
        }
    }

    /// Why it ends, once nothing is left but to come to rest.
    pub(super) fn ending(&self) -> Option<String> {
        match self {
            Self::Servo(program) if program.is_ending() => {
                Some(format!("servo program ended: {:?}", program.phase()))
            }
            Self::Servo(_) => None,
            Self::UrRtde(program) => program.ending().map(str::to_owned),
        }
    }

    /// The register that a watchdog watches, and the cycles without a write after which it bites.
    pub(super) fn watchdog(&self, rate_hz: f64) -> Option<(u8, f64)> {
        match self {
            Self::Servo(program) => program
                .watchdog_cycles(rate_hz)
                .map(|cycles| (program.program().registers.first(), cycles)),
            Self::UrRtde(_) => None,
        }
    }
}
