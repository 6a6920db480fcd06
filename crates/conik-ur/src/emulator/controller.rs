//! The emulated controller itself: clock, safety, program and arm. No threads, no sockets.

use super::config::{EmulatorConfig, EmulatorError, Injection, Series};
use super::external_control::ExternalControl;
use super::fields::InputField;
use super::power::Power;
use super::registers::Registers;
use super::running::{ArmState, Running};
use super::servo_program::{Motion, RunningProgram};
use super::ur_rtde_program::UrRtdeProgram;
use crate::program::ServoProgram;
use crate::registers::JOINTS;
use crate::wire::Value;
use conik::JointVec;
use conik_sim::servo::{Servo, ServoModel};
use std::collections::VecDeque;

/// The clock's reading at first [s]: clients take one below 40 s for a controller that still boots.
const BOOTED_AT_S: f64 = 50.0;

/// Lines that the log holds.
const LOG_LINES: usize = 500;

/// What keeps the arm from moving.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Safety {
    Normal,
    ProtectiveStop,
    EmergencyStop,
}

/// The controller and its arm.
#[derive(Debug)]
pub(super) struct Controller {
    pub(super) series: Series,
    pub(super) remote_control: bool,
    pub(super) rate_hz: f64,
    largest_step: f64,
    stop_deceleration: f64,
    /// Control cycles since the start, which the clock counts.
    cycles: u64,
    /// Control cycles at which the clock began to count; a restart moves it.
    clock_zero: u64,
    pub(super) registers: Registers,
    pub(super) servo: Servo,
    /// Position and velocity one cycle ago: what the arm measures.
    pub(super) actual: (JointVec, JointVec),
    /// Target of the last `servoj`.
    servo_target: Option<[f64; JOINTS]>,
    pub(super) safety: Safety,
    /// The cycle of the last protective stop.
    pub(super) stopped_at: u64,
    pub(super) power: Power,
    pub(super) slider: f64,
    pub(super) digital: u32,
    pub(super) analog: [f64; 2],
    pub(super) running: Option<Running>,
    pub(super) paused: bool,
    /// The program that the dashboard was told to load.
    pub(super) loaded: String,
    /// What jumps have added to the clock [s].
    pub(super) clock_jump_s: f64,
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
            series: config.series,
            remote_control: config.remote_control,
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
            stopped_at: 0,
            power: Power::Running,
            slider: 1.0,
            digital: 0,
            analog: [0.0; 2],
            running: None,
            paused: false,
            loaded: String::new(),
            clock_jump_s: 0.0,
            log: VecDeque::new(),
        })
    }

    /// One control cycle.
    pub(super) fn cycle(&mut self) {
        self.cycles += 1;
        self.actual = (*self.servo.q(), self.target_qd().into());
        self.apply_switches();
        let cycle_s = 1.0 / self.rate_hz;
        let arm = ArmState {
            q: six(&self.actual.0),
            target_qd: self.target_qd(),
            cycle_s,
        };
        let mut said = Vec::new();
        let motion = match &mut self.running {
            Some(running) if !self.paused => {
                let motion = running.cycle(&mut self.registers, &arm);
                said = running.said();
                motion
            }
            _ => Motion::Rest,
        };
        for line in said {
            self.note(&line);
        }
        let motion = match motion {
            Motion::ServoWith {
                target,
                lookahead_s,
                gain,
            } => {
                let model = ServoModel {
                    lookahead_s,
                    gain_per_s2: gain,
                    ..*self.servo.model()
                };
                // Within servoj's ranges, so that no servo refuses them.
                let _ = self.servo.set_model(model);
                Motion::Servo(target)
            }
            other => other,
        };
        match motion {
            Motion::Servo(target) if self.may_follow(&target) => {
                self.servo_target = Some(target);
                // The slider slows time down; at 0 it would stand still for ever.
                let slowed = cycle_s * self.slider.max(0.001);
                self.servo.follow(&target.into(), slowed);
            }
            Motion::Brake(deceleration) => self.servo.brake(deceleration, cycle_s),
            Motion::Servo(_) | Motion::ServoWith { .. } | Motion::Rest => {
                self.servo.brake(self.stop_deceleration, cycle_s);
            }
        }
        if !self.paused
            && let Some(line) = self.running.as_ref().and_then(Running::ending)
            && self.servo.is_still()
        {
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
        let Some((counter, allowed)) = running.watchdog(self.rate_hz) else {
            return;
        };
        let silent = self
            .cycles
            .saturating_sub(self.registers.written_at(counter));
        if silent as f64 > allowed {
            self.end_program("program stopped by its watchdog");
        }
    }

    /// Takes a program that came in on the script port; the error says why it does not run.
    pub(super) fn upload(&mut self, text: &str) -> Result<(), String> {
        if !self.remote_control && self.series == Series::E {
            return Err("the controller is not in remote control".to_owned());
        }
        if let Some(reason) = self.why_not_ready() {
            return Err(reason.to_owned());
        }
        if let Some(program) = UrRtdeProgram::recognise(text) {
            self.start(Running::UrRtde(program), "ur_rtde program started");
            return Ok(());
        }
        if let Some(program) = ExternalControl::recognise(text) {
            let program = Running::External(Box::new(program?));
            self.start(program, "external control started");
            return Ok(());
        }
        let program = ServoProgram::parse(text).map_err(|error| error.to_string())?;
        let model = ServoModel {
            lookahead_s: program.lookahead_s,
            gain_per_s2: program.gain,
            ..*self.servo.model()
        };
        self.servo
            .set_model(model)
            .map_err(|error| error.to_string())?;
        let running = RunningProgram::begin(program, 1.0 / self.rate_hz, &mut self.registers);
        let line = format!("servo program started, session {}", program.session);
        self.start(Running::Servo(Box::new(running)), &line);
        Ok(())
    }

    /// Lets a program run, in the place of another if there is one.
    pub(super) fn start(&mut self, program: Running, line: &str) {
        if self.running.is_some() {
            self.end_program("program stopped by a new one");
        }
        self.running = Some(program);
        self.paused = false;
        self.note(line);
    }

    pub(super) fn inject(&mut self, injection: Injection) {
        match injection {
            Injection::ProtectiveStop => self.protective_stop("injected"),
            Injection::EmergencyStop => {
                self.safety = Safety::EmergencyStop;
                self.power = Power::Off;
                self.end_program("emergency stop");
            }
            Injection::StopProgram => self.end_program("program stopped at the pendant"),
            Injection::PauseProgram => {
                self.paused = self.running.is_some();
                self.note("program paused at the pendant");
            }
            Injection::RestartClock => {
                (self.clock_zero, self.clock_jump_s) = (self.cycles, 0.0);
                self.note("clock restarted");
            }
            Injection::Release => {
                self.safety = Safety::Normal;
                self.power = Power::Running;
                self.note("stops released");
            }
        }
    }

    fn protective_stop(&mut self, why: &str) {
        // Stops are told apart by the gravest.
        if self.safety != Safety::EmergencyStop {
            self.safety = Safety::ProtectiveStop;
        }
        self.stopped_at = self.cycles;
        self.end_program(&format!("protective stop: {why}"));
    }

    pub(super) fn end_program(&mut self, why: &str) {
        self.running = None;
        self.paused = false;
        self.servo_target = None;
        self.note(why);
    }

    pub(super) fn write_input(&mut self, field: InputField, value: Value) {
        self.registers.write_input(field, value, self.cycles);
    }

    /// A multiple of the cycle, so that clients may count cycles by it.
    pub(super) fn timestamp(&self) -> f64 {
        BOOTED_AT_S + self.clock_jump_s + (self.cycles - self.clock_zero) as f64 / self.rate_hz
    }

    /// Speed of the joints [rad/s]; the speed slider slows it down.
    pub(super) fn target_qd(&self) -> [f64; JOINTS] {
        six(self.servo.qd()).map(|speed| speed * self.slider)
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

pub(super) fn six(values: &JointVec) -> [f64; JOINTS] {
    std::array::from_fn(|joint| values[joint])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::config::Series;
    use crate::emulator::fields::OutputField;
    use crate::program::tests::PROGRAM;
    use crate::registers::Command;

    fn controller() -> Controller {
        let config = EmulatorConfig::new(Series::Cb3, JointVec::zeros(JOINTS));
        Controller::new(&config).unwrap()
    }

    fn give(controller: &mut Controller, counter: i32, q: f64) {
        controller.write_input(InputField::Int(24), Value::Int32(counter));
        controller.write_input(InputField::Int(25), Value::Int32(Command::Servo as i32));
        controller.write_input(InputField::Double(24), Value::Double(q));
    }

    fn last_line(controller: &Controller) -> &str {
        controller.log().last().unwrap()
    }

    #[test]
    fn the_watchdog_stops_a_program_whose_counter_nobody_writes() {
        let mut controller = controller();
        let patient = ServoProgram {
            extrapolated_cycles: 1000,
            watchdog_hz: 10.0,
            ..PROGRAM
        };
        controller.upload(&patient.text().unwrap()).unwrap();
        give(&mut controller, 1, 0.0);
        // 10 Hz at 125 Hz: twelve and a half cycles.
        for _ in 0..12 {
            controller.cycle();
        }
        assert!(controller.program_runs());
        controller.cycle();
        assert!(!controller.program_runs());
        assert!(last_line(&controller).contains("watchdog"));
    }

    #[test]
    fn the_clock_reads_multiples_of_the_cycle_from_above_40_s() {
        let mut controller = controller();
        for cycle in 1..=1000 {
            controller.cycle();
            let timestamp = Value::Double(50.0 + f64::from(cycle) / 125.0);
            assert_eq!(controller.output(OutputField::Timestamp), timestamp);
        }
    }

    #[test]
    fn a_step_that_is_too_large_stops_the_arm_and_it_stays_stopped() {
        let mut controller = controller();
        controller.upload(&PROGRAM.text().unwrap()).unwrap();
        give(&mut controller, 1, 0.0);
        controller.cycle();
        give(&mut controller, 2, 0.11);
        controller.cycle();
        assert!(last_line(&controller).contains("joint 1 by 0.11 rad"));
        let refused = controller.upload(&PROGRAM.text().unwrap()).unwrap_err();
        assert!(refused.contains("stopped for safety"));
        for counter in 3..50 {
            give(&mut controller, counter, 0.11);
            controller.cycle();
        }
        let still = Value::Vector6d([0.0; 6]);
        assert_eq!(controller.output(OutputField::TargetQ), still);
    }

    #[test]
    fn a_finite_but_absurd_reference_makes_a_protective_stop() {
        let mut controller = controller();
        controller.upload(&PROGRAM.text().unwrap()).unwrap();
        give(&mut controller, 1, f64::MAX);
        controller.cycle();
        assert!(last_line(&controller).contains("protective stop"));
        let still = Value::Vector6d([0.0; 6]);
        assert_eq!(controller.output(OutputField::TargetQ), still);
    }

    #[test]
    fn measured_joints_are_one_cycle_behind_the_commanded_ones() {
        let mut controller = controller();
        controller.upload(&PROGRAM.text().unwrap()).unwrap();
        let mut commanded = controller.output(OutputField::TargetQ);
        for counter in 1..20 {
            give(&mut controller, counter, 0.01 * f64::from(counter));
            controller.cycle();
            assert_eq!(controller.output(OutputField::ActualQ), commanded);
            commanded = controller.output(OutputField::TargetQ);
        }
    }

    /// For gains and lookaheads from one end of their ranges to the other, in both series.
    #[test]
    fn a_ramp_is_followed_with_the_lookahead_as_its_delay_within_one_cycle() {
        let speed = 0.5;
        for (series, cycles) in [(Series::Cb3, 375), (Series::E, 1500)] {
            for (lookahead_s, gain) in [(0.1, 300.0), (0.03, 2000.0), (0.2, 100.0), (0.2, 2000.0)] {
                let config = EmulatorConfig::new(series, JointVec::zeros(JOINTS));
                let mut controller = Controller::new(&config).unwrap();
                let cycle_s = 1.0 / series.rate_hz();
                let program = ServoProgram {
                    cycle_s,
                    lookahead_s,
                    gain,
                    ..PROGRAM
                };
                controller.upload(&program.text().unwrap()).unwrap();
                let mut q_ref = 0.0;
                for counter in 1..=cycles {
                    q_ref = f64::from(counter) * speed * cycle_s;
                    give(&mut controller, counter, q_ref);
                    controller.cycle();
                }
                let delay = (q_ref - controller.servo.q()[0]) / speed;
                assert!(
                    (delay - lookahead_s).abs() <= cycle_s + 1e-9,
                    "{series:?}, lookahead {lookahead_s} s, gain {gain}: {delay} s"
                );
            }
        }
    }
}
