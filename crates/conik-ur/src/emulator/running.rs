//! The program that runs: one that is interpreted, or one of another client that is recognised.

use super::arm::Motion;
use super::external_control::{Calls, ExternalControl};
use super::script_program::{Around, ScriptProgram};
use super::ur_rtde_program::UrRtdeProgram;
use crate::registers::JOINTS;
use crate::urscript::{Program, ScriptError};
use std::sync::Arc;

/// A program while it runs.
#[derive(Debug)]
pub(super) enum Running {
    Script(Box<ScriptProgram>),
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

/// Why a program does not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Refusal {
    pub(super) reason: String,
    /// The line that is at fault.
    pub(super) script_line: Option<u32>,
}

impl<T: Into<String>> From<T> for Refusal {
    fn from(reason: T) -> Self {
        Self {
            reason: reason.into(),
            script_line: None,
        }
    }
}

impl Running {
    /// The program in a text, ready to begin.
    pub(super) fn read(text: &str) -> Result<Self, Refusal> {
        if let Some(program) = UrRtdeProgram::recognise(text) {
            return Ok(Self::UrRtde(program));
        }
        if let Some(program) = ExternalControl::recognise(text) {
            return Ok(Self::External(Box::new(program?)));
        }
        let program = Program::parse(text).map_err(|error| Refusal {
            reason: error.to_string(),
            script_line: Some(error.line),
        })?;
        Ok(Self::Script(Box::new(ScriptProgram::new(program))))
    }

    /// What the dashboard calls it.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Script(script) => script.program().name(),
            Self::UrRtde(_) => "rtde_control",
            Self::External(_) => "externalControl",
            Self::Pendant(name) => name,
        }
    }

    /// Whether it runs beside another program and takes no time.
    pub(super) fn is_secondary(&self) -> bool {
        match self {
            Self::Script(script) => script.program().is_secondary(),
            Self::UrRtde(_) | Self::External(_) | Self::Pendant(_) => false,
        }
    }

    /// One control cycle.
    pub(super) fn cycle(&mut self, around: &mut Around) -> Result<Motion, ScriptError> {
        match self {
            Self::Script(script) => script.cycle(around),
            Self::UrRtde(program) => Ok(program.cycle(around.registers)),
            Self::External(program) => {
                let motion = program.cycle(&around.arm_state());
                for line in program.said() {
                    around.log.note(around.time_s, &line);
                }
                Ok(motion)
            }
            Self::Pendant(_) => Ok(Motion::Rest),
        }
    }

    /// Why it ends, once nothing is left but to come to rest.
    pub(super) fn ending(&self) -> Option<String> {
        match self {
            Self::Script(script) => script
                .is_over()
                .then(|| format!("program '{}' ended", self.name())),
            Self::UrRtde(program) => program.ending().map(str::to_owned),
            Self::External(program) => program.ending().map(str::to_owned),
            Self::Pendant(_) => None,
        }
    }

    /// Sockets that have to be opened for it.
    pub(super) fn calls(&self) -> Option<&Arc<Calls>> {
        match self {
            Self::External(program) => Some(program.calls()),
            Self::Script(_) | Self::UrRtde(_) | Self::Pendant(_) => None,
        }
    }
}
