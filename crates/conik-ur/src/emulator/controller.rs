//! The emulated controller itself: clock, safety, program and arm. No threads, no sockets.

use super::config::{EmulatorConfig, EmulatorError, Injection};
use super::fields::{InputField, OutputField};
use super::registers::Registers;
use super::servo_program::{Motion, RunningProgram};
use crate::program::ServoProgram;
use crate::registers::JOINTS;
use crate::status::{ROBOT_MODE_RUNNING, robot_bit, runtime_state, safety_bit};
use crate::wire::Value;
use conik::JointVec;
use conik_sim::servo::{Servo, ServoModel};
use std::collections::VecDeque;

/// The clock's reading at first [s]: clients take one below 40 s for a controller that still boots.
const BOOTED_AT_S: f64 = 50.0;

/// `robot_mode` of an arm without power.
const ROBOT_MODE_POWER_OFF: i32 = 3;

/// Lines that the log holds.
const LOG_LINES: usize = 500;

/// What keeps the arm from moving.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Safety {
    Normal,
    ProtectiveStop,
    EmergencyStop,
}

/// The controller and its arm.
#[derive(Debug)]
pub(super) struct Controller {
    rate_hz: f64,
    largest_step: f64,
    stop_deceleration: f64,
    /// Control cycles since the start, which the clock counts.
    cycles: u64,
    /// Control cycles at which the clock began to count; a restart moves it.
    clock_zero: u64,
    pub(super) registers: Registers,
    servo: Servo,
    /// Position and velocity one cycle ago: what the arm measures.
    actual: (JointVec, JointVec),
    /// Target of the last `servoj`.
    servo_target: Option<[f64; JOINTS]>,
    safety: Safety,
    running: Option<RunningProgram>,
    paused: bool,
    log: VecDeque<String>,
}

impl Controller {
    pub(super) fn new(config: &EmulatorConfig) -> Result<Self, EmulatorError> {
        let servo = Servo::at_rest(
            ServoModel {
                // Each program brings its own; these two count for nothing before.
                lookahead_s: 0.1,
                gain_per_s2: 300.0,
                speed_limit: config.speed_limit,
                acceleration_limit: config.acceleration_limit,
            },
            config.q0,
        )?;
        Ok(Self {
            rate_hz: config.rate_hz,
            largest_step: config.largest_step,
            stop_deceleration: config.stop_deceleration,
            cycles: 0,
            clock_zero: 0,
            registers: Registers::new(),
            servo,
            actual: (config.q0, JointVec::zeros(JOINTS)),
            servo_target: None,
            safety: Safety::Normal,
            running: None,
            paused: false,
            log: VecDeque::new(),
        })
    }

    /// One control cycle.
    pub(super) fn cycle(&mut self) {
        self.cycles += 1;
        self.actual = (*self.servo.q(), *self.servo.qd());
        let motion = match &mut self.running {
            Some(running) if !self.paused => running.cycle(&mut self.registers),
            _ => Motion::Rest,
        };
        let cycle_s = 1.0 / self.rate_hz;
        match motion {
            Motion::Servo(target) if self.may_follow(&target) => {
                self.servo_target = Some(target);
                self.servo.follow(&target.into(), cycle_s);
            }
            Motion::Brake(deceleration) => self.servo.brake(deceleration, cycle_s),
            Motion::Servo(_) | Motion::Rest => self.servo.brake(self.stop_deceleration, cycle_s),
        }
        if !self.paused
            && let Some(running) = &self.running
            && running.is_ending()
            && self.servo.is_still()
        {
            let line = format!("servo program ended: {:?}", running.phase());
            self.end_program(&line);
        }
        self.watch();
    }

    /// Whether the step to this target is small enough; a protective stop follows if it is not.
    fn may_follow(&mut self, target: &[f64; JOINTS]) -> bool {
        let from = self.servo_target.unwrap_or(six(self.servo.q()));
        for joint in 0..JOINTS {
            let step = (target[joint] - from[joint]).abs();
            // A target that overflowed is not finite, and no step to it is small.
            let is_small = step <= self.largest_step;
            if !is_small {
                self.protective_stop(&format!(
                    "sudden change in target position: joint {} by {step} rad",
                    joint + 1
                ));
                return false;
            }
        }
        true
    }

    /// The watchdog on the counter.
    fn watch(&mut self) {
        let Some(running) = &self.running else { return };
        let Some(allowed) = running.watchdog_cycles(self.rate_hz) else {
            return;
        };
        let counter = running.program().registers.first();
        let silent = self
            .cycles
            .saturating_sub(self.registers.written_at(counter));
        if silent as f64 > allowed {
            self.end_program("program stopped by its watchdog");
        }
    }

    /// Takes a program that came in on the script port; the error says why it does not run.
    pub(super) fn upload(&mut self, text: &str) -> Result<(), String> {
        let program = ServoProgram::parse(text).map_err(|error| error.to_string())?;
        if self.safety != Safety::Normal {
            return Err("a program cannot start while the arm is stopped for safety".to_owned());
        }
        let model = ServoModel {
            lookahead_s: program.lookahead_s,
            gain_per_s2: program.gain,
            ..*self.servo.model()
        };
        self.servo
            .set_model(model)
            .map_err(|error| error.to_string())?;
        if self.running.is_some() {
            self.end_program("program stopped by a new one");
        }
        let running = RunningProgram::begin(program, 1.0 / self.rate_hz, &mut self.registers);
        self.running = Some(running);
        self.paused = false;
        self.note(&format!(
            "servo program started, session {}",
            program.session
        ));
        Ok(())
    }

    pub(super) fn inject(&mut self, injection: Injection) {
        match injection {
            Injection::ProtectiveStop => self.protective_stop("injected"),
            Injection::EmergencyStop => {
                self.safety = Safety::EmergencyStop;
                self.end_program("emergency stop");
            }
            Injection::StopProgram => self.end_program("program stopped at the pendant"),
            Injection::PauseProgram => {
                self.paused = self.running.is_some();
                self.note("program paused at the pendant");
            }
            Injection::RestartClock => {
                self.clock_zero = self.cycles;
                self.note("clock restarted");
            }
            Injection::Release => {
                self.safety = Safety::Normal;
                self.note("stops released");
            }
        }
    }

    fn protective_stop(&mut self, why: &str) {
        self.safety = Safety::ProtectiveStop;
        self.end_program(&format!("protective stop: {why}"));
    }

    fn end_program(&mut self, why: &str) {
        self.running = None;
        self.paused = false;
        self.servo_target = None;
        self.note(why);
    }

    pub(super) fn write_input(&mut self, field: InputField, value: Value) {
        self.registers.write_input(field, value, self.cycles);
    }

    pub(super) fn output(&self, field: OutputField) -> Value {
        match field {
            OutputField::Timestamp => Value::Double(self.timestamp()),
            OutputField::TargetQ => Value::Vector6d(six(self.servo.q())),
            OutputField::TargetQd => Value::Vector6d(six(self.servo.qd())),
            OutputField::TargetQdd => Value::Vector6d(six(self.servo.qdd())),
            OutputField::ActualQ => Value::Vector6d(six(&self.actual.0)),
            OutputField::ActualQd => Value::Vector6d(six(&self.actual.1)),
            OutputField::RobotMode => Value::Int32(match self.safety {
                Safety::EmergencyStop => ROBOT_MODE_POWER_OFF,
                Safety::Normal | Safety::ProtectiveStop => ROBOT_MODE_RUNNING,
            }),
            OutputField::SafetyMode => Value::Int32(match self.safety {
                Safety::Normal => 1,
                Safety::ProtectiveStop => 3,
                Safety::EmergencyStop => 7,
            }),
            OutputField::RuntimeState => Value::Uint32(match (&self.running, self.paused) {
                (None, _) => runtime_state::STOPPED,
                (Some(_), false) => runtime_state::PLAYING,
                (Some(_), true) => runtime_state::PAUSED,
            }),
            OutputField::RobotStatusBits => Value::Uint32(self.robot_bits()),
            OutputField::SafetyStatusBits => Value::Uint32(match self.safety {
                Safety::Normal => safety_bit::NORMAL,
                Safety::ProtectiveStop => {
                    safety_bit::PROTECTIVE_STOP | safety_bit::STOPPED_DUE_TO_SAFETY
                }
                Safety::EmergencyStop => {
                    safety_bit::ROBOT_EMERGENCY_STOP
                        | safety_bit::EMERGENCY_STOP
                        | safety_bit::STOPPED_DUE_TO_SAFETY
                }
            }),
            OutputField::SpeedScaling | OutputField::TargetSpeedFraction => Value::Double(1.0),
            OutputField::OutputInt(register) => Value::Int32(self.registers.output_int(register)),
            // No program that runs here writes one.
            OutputField::OutputDouble(_) => Value::Double(0.0),
            OutputField::Input(field) => self.registers.input(field),
        }
    }

    fn robot_bits(&self) -> u32 {
        let power = match self.safety {
            Safety::EmergencyStop => 0,
            Safety::Normal | Safety::ProtectiveStop => robot_bit::POWER_ON,
        };
        match self.running {
            Some(_) => power | robot_bit::PROGRAM_RUNNING,
            None => power,
        }
    }

    /// A multiple of the cycle, so that clients may count cycles by it.
    fn timestamp(&self) -> f64 {
        BOOTED_AT_S + (self.cycles - self.clock_zero) as f64 / self.rate_hz
    }

    pub(super) fn cycles(&self) -> u64 {
        self.cycles
    }

    pub(super) fn program_runs(&self) -> bool {
        self.running.is_some()
    }

    /// Adds a line to the log.
    pub(super) fn note(&mut self, line: &str) {
        if self.log.len() == LOG_LINES {
            self.log.pop_front();
        }
        self.log
            .push_back(format!("{:.3} s: {line}", self.timestamp()));
    }

    pub(super) fn log(&self) -> impl Iterator<Item = &String> {
        self.log.iter()
    }
}

fn six(values: &JointVec) -> [f64; JOINTS] {
    std::array::from_fn(|joint| values[joint])
}
