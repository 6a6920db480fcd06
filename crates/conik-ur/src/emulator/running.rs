//! The program that runs: ours, or one of another client that is recognised.

use super::external_control::{Calls, ExternalControl};
use super::registers::Registers;
use super::servo_program::{Motion, RunningProgram};
use super::ur_rtde_program::UrRtdeProgram;
use crate::registers::JOINTS;
use std::sync::Arc;

/// A program while it runs.
#[derive(Debug)]
pub(super) enum Running {
    Servo(Box<RunningProgram>),
    UrRtde(UrRtdeProgram),
    External(Box<ExternalControl>),
    /// A program of the pendant, by its name: it waits and moves nothing.
    Pendant(String),
}

/// The arm as a program sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmState {
    /// Measured joints [rad].
    pub(super) q: [f64; JOINTS],
    /// Commanded speeds [rad/s].
    pub(super) target_qd: [f64; JOINTS],
    /// The control cycle [s].
    pub(super) cycle_s: f64,
}

impl Running {
    /// What the dashboard calls it.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Servo(_) => "conik_servo",
            Self::UrRtde(_) => "rtde_control",
            Self::External(_) => "externalControl",
            Self::Pendant(name) => name,
        }
    }

    pub(super) fn cycle(&mut self, registers: &mut Registers, arm: &ArmState) -> Motion {
        match self {
            Self::Servo(program) => program.cycle(registers),
            Self::UrRtde(program) => program.cycle(registers),
            Self::External(program) => program.cycle(arm),
            Self::Pendant(_) => Motion::Rest,
        }
    }

    /// Why it ends, once nothing is left but to come to rest.
    pub(super) fn ending(&self) -> Option<String> {
        match self {
            Self::Servo(program) if program.is_ending() => {
                Some(format!("servo program ended: {:?}", program.phase()))
            }
            Self::Servo(_) | Self::Pendant(_) => None,
            Self::UrRtde(program) => program.ending().map(str::to_owned),
            Self::External(program) => program.ending().map(str::to_owned),
        }
    }

    /// The register that a watchdog watches, and the cycles without a write after which it bites.
    pub(super) fn watchdog(&self, rate_hz: f64) -> Option<(u8, f64)> {
        match self {
            Self::Servo(program) => program
                .watchdog_cycles(rate_hz)
                .map(|cycles| (program.program().registers.first(), cycles)),
            Self::UrRtde(_) | Self::External(_) | Self::Pendant(_) => None,
        }
    }

    /// Lines for the log.
    pub(super) fn said(&mut self) -> Vec<String> {
        match self {
            Self::External(program) => program.said(),
            Self::Servo(_) | Self::UrRtde(_) | Self::Pendant(_) => Vec::new(),
        }
    }

    /// Sockets that have to be opened for it.
    pub(super) fn calls(&self) -> Option<&Arc<Calls>> {
        match self {
            Self::External(program) => Some(program.calls()),
            Self::Servo(_) | Self::UrRtde(_) | Self::Pendant(_) => None,
        }
    }
}
