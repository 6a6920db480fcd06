//! The emulated controller itself: clock, safety, program and arm. No threads, no sockets.

use super::arm::Arm;
use super::config::{EmulatorConfig, EmulatorError, Injection, Series};
use super::fields::InputField;
use super::log::{Log, Message};
use super::power::Power;
use super::registers::Registers;
use super::running::Running;
use super::script_program::Mounted;
use super::watchdog::Watchdogs;
use crate::model::ArmFacts;
use crate::registers::JOINTS;
use crate::wire::Value;

/// The clock's reading at first [s]: clients take one below 40 s for a controller that still boots.
const BOOTED_AT_S: f64 = 50.0;

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
    /// What is known of the arm.
    pub(super) facts: &'static ArmFacts,
    pub(super) remote_control: bool,
    pub(super) rate_hz: f64,
    /// Control cycles since the start, which the clock counts.
    cycles: u64,
    /// Control cycles at which the clock began to count; a restart moves it.
    clock_zero: u64,
    /// What jumps have added to the clock [s].
    pub(super) clock_jump_s: f64,
    pub(super) registers: Registers,
    pub(super) arm: Arm,
    pub(super) mounted: Mounted,
    pub(super) safety: Safety,
    /// The cycle of the last protective stop.
    pub(super) stopped_at: u64,
    pub(super) power: Power,
    pub(super) slider: f64,
    pub(super) digital: u32,
    pub(super) analog: [f64; 2],
    pub(super) running: Option<Running>,
    pub(super) paused: bool,
    pub(super) watchdogs: Watchdogs,
    /// The program that the dashboard was told to load.
    pub(super) loaded: String,
    pub(super) log: Log,
}

impl Controller {
    pub(super) fn new(config: &EmulatorConfig) -> Result<Self, EmulatorError> {
        Ok(Self {
            series: config.series,
            facts: config.arm,
            remote_control: config.remote_control,
            rate_hz: config.rate_hz,
            cycles: 0,
            clock_zero: 0,
            clock_jump_s: 0.0,
            registers: Registers::new(),
            arm: Arm::new(config)?,
            mounted: Mounted::default(),
            safety: Safety::Normal,
            stopped_at: 0,
            power: Power::Running,
            slider: 1.0,
            digital: 0,
            analog: [0.0; 2],
            running: None,
            paused: false,
            watchdogs: Watchdogs::default(),
            loaded: String::new(),
            log: Log::default(),
        })
    }

    /// One control cycle.
    pub(super) fn cycle(&mut self) {
        self.cycles += 1;
        self.arm.measure(self.slider);
        self.apply_switches();
        let motion = self.run_program();
        if let Err(why) = self.arm.follow(motion, 1.0 / self.rate_hz, self.slider) {
            self.protective_stop(&why.to_string());
        }
        self.end_finished_program();
        self.watch();
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

    pub(super) fn write_input(&mut self, field: InputField, value: Value) {
        self.registers.write_input(field, value, self.cycles);
    }

    /// A multiple of the cycle, so that clients may count cycles by it.
    pub(super) fn timestamp(&self) -> f64 {
        BOOTED_AT_S + self.clock_jump_s + (self.cycles - self.clock_zero) as f64 / self.rate_hz
    }

    /// Speed of the joints [rad/s]; the speed slider slows it down.
    pub(super) fn target_qd(&self) -> [f64; JOINTS] {
        self.arm.qd(self.slider)
    }

    pub(super) fn cycles(&self) -> u64 {
        self.cycles
    }

    pub(super) fn program_runs(&self) -> bool {
        self.running.is_some()
    }

    /// Adds a line to the log.
    pub(super) fn note(&mut self, line: &str) {
        self.log.note(self.timestamp(), line);
    }

    /// Adds a line to the log and tells the clients.
    pub(super) fn tell(&mut self, message: Message) {
        self.log.tell(self.timestamp(), message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::config::Series;
    use crate::emulator::fields::OutputField;
    use crate::program::ServoProgram;
    use crate::program::tests::PROGRAM;
    use crate::registers::Command;
    use conik::JointVec;

    fn controller() -> Controller {
        let config = EmulatorConfig::new(Series::Cb3, JointVec::zeros(JOINTS));
        Controller::new(&config).unwrap()
    }

    fn give(controller: &mut Controller, counter: i32, q: f64) {
        controller.write_input(InputField::Int(24), Value::Int32(counter));
        controller.write_input(InputField::Int(25), Value::Int32(Command::Servo as i32));
        controller.write_input(InputField::Double(24), Value::Double(q));
        // Lookahead, gain and time of `servoj`.
        for (register, value) in (36..).zip([0.1, 300.0, 0.008]) {
            controller.write_input(InputField::Double(register), Value::Double(value));
        }
    }

    /// With the program at where it waits for the first reference.
    fn begin(controller: &mut Controller, program: &ServoProgram) {
        let program = Running::read(&program.text().unwrap()).unwrap();
        controller.start(program).unwrap();
        controller.cycle();
    }

    fn has_line(controller: &Controller, part: &str) -> bool {
        controller.log.lines().any(|line| line.contains(part))
    }

    #[test]
    fn the_watchdog_stops_a_program_whose_counter_nobody_writes() {
        let mut controller = controller();
        let patient = ServoProgram {
            extrapolated_cycles: 1000,
            watchdog_hz: 10.0,
            ..PROGRAM
        };
        begin(&mut controller, &patient);
        give(&mut controller, 1, 0.0);
        // 10 Hz at 125 Hz: twelve and a half cycles.
        for _ in 0..12 {
            controller.cycle();
        }
        assert!(controller.program_runs());
        controller.cycle();
        assert!(!controller.program_runs());
        assert!(has_line(&controller, "watchdog"));
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
        begin(&mut controller, &PROGRAM);
        give(&mut controller, 1, 0.0);
        controller.cycle();
        give(&mut controller, 2, 0.11);
        controller.cycle();
        assert!(has_line(&controller, "joint 1 by 0.11 rad"));
        let program = Running::read(&PROGRAM.text().unwrap()).unwrap();
        let refused = controller.start(program).unwrap_err();
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
        begin(&mut controller, &PROGRAM);
        give(&mut controller, 1, f64::MAX);
        controller.cycle();
        assert!(has_line(&controller, "protective stop"));
        let still = Value::Vector6d([0.0; 6]);
        assert_eq!(controller.output(OutputField::TargetQ), still);
    }

    #[test]
    fn measured_joints_are_one_cycle_behind_the_commanded_ones() {
        let mut controller = controller();
        begin(&mut controller, &PROGRAM);
        let mut commanded = controller.output(OutputField::TargetQ);
        for counter in 1..20 {
            give(&mut controller, counter, 0.01 * f64::from(counter));
            controller.cycle();
            assert_eq!(controller.output(OutputField::ActualQ), commanded);
            commanded = controller.output(OutputField::TargetQ);
        }
    }
}
