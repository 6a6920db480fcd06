//! The servo program as the emulated controller runs it: `servo.script`, line by line, as a state
//! machine. The script decides; where the two differ, this file is wrong.

use super::registers::Registers;
use crate::program::ServoProgram;
use crate::registers::{Command, JOINTS, Phase};

/// What the program has the joints do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Motion {
    /// Nothing: stand, or come to rest.
    Rest,
    /// `servoj` with this target [rad].
    Servo([f64; JOINTS]),
    /// `servoj` with its parameters given anew: target [rad], lookahead [s] and gain.
    ServoWith {
        target: [f64; JOINTS],
        lookahead_s: f64,
        gain: f64,
    },
    /// `stopj` with this deceleration [rad/s²].
    Brake(f64),
}

/// The servo program while it runs.
#[derive(Clone, Debug)]
pub(super) struct RunningProgram {
    program: ServoProgram,
    phase: Phase,
    /// Control cycles that one turn of the program's loop takes.
    cycles_per_turn: u64,
    cycles_to_turn: u64,
    turns_waited: u64,
    counter: i32,
    q: [f64; JOINTS],
    qd: [f64; JOINTS],
    missed: u32,
    motion: Motion,
}

impl RunningProgram {
    /// The program's first lines, up to where it waits.
    pub(super) fn begin(program: ServoProgram, cycle_s: f64, registers: &mut Registers) -> Self {
        let base = program.registers.first();
        registers.write_output_int(base, Phase::Waiting as i32);
        registers.write_output_int(base + 1, program.session);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // At least 1.
        let cycles_per_turn = (program.cycle_s / cycle_s).round().max(1.0) as u64;
        Self {
            program,
            phase: Phase::Waiting,
            cycles_per_turn,
            cycles_to_turn: 0,
            turns_waited: 0,
            counter: registers.input_int(base),
            q: [0.0; JOINTS],
            qd: [0.0; JOINTS],
            missed: 0,
            motion: Motion::Rest,
        }
    }

    pub(super) fn program(&self) -> &ServoProgram {
        &self.program
    }

    pub(super) fn phase(&self) -> Phase {
        self.phase
    }

    /// Whether the last line is reached: nothing is left but to come to rest.
    pub(super) fn is_ending(&self) -> bool {
        !matches!(self.phase, Phase::Waiting | Phase::Servoing)
    }

    /// Control cycles without a write to the counter after which the watchdog bites; none in the
    /// phases in which it is off.
    pub(super) fn watchdog_cycles(&self, rate_hz: f64) -> Option<f64> {
        (self.phase == Phase::Servoing).then(|| rate_hz / self.program.watchdog_hz)
    }

    /// One control cycle of the program.
    pub(super) fn cycle(&mut self, registers: &mut Registers) -> Motion {
        if self.cycles_to_turn == 0 {
            self.cycles_to_turn = self.cycles_per_turn;
            self.turn(registers);
        }
        self.cycles_to_turn -= 1;
        self.motion
    }

    /// One turn of the program's loop.
    fn turn(&mut self, registers: &mut Registers) {
        if self.is_ending() {
            return;
        }
        let before = self.phase;
        if self.phase == Phase::Waiting {
            self.wait(registers);
        }
        if self.phase == Phase::Servoing {
            self.servo(registers);
        }
        if self.is_ending() && before == Phase::Servoing {
            self.motion = Motion::Brake(self.program.stop_deceleration);
        }
        registers.write_output_int(self.program.registers.first(), self.phase as i32);
    }

    fn wait(&mut self, registers: &Registers) {
        let base = self.program.registers.first();
        let command = registers.input_int(base + 1);
        let is_new = registers.input_int(base) != self.counter;
        let waited = self.turns_waited as f64 * self.program.cycle_s;
        if command == Command::Stop as i32 {
            self.phase = Phase::Stopped;
        } else if command == Command::Servo as i32 && is_new {
            self.phase = Phase::Servoing;
        } else if waited > self.program.patience_s {
            self.phase = Phase::GaveUp;
        } else {
            self.turns_waited += 1;
        }
    }

    fn servo(&mut self, registers: &Registers) {
        let base = self.program.registers.first();
        let newest = registers.input_int(base);
        if registers.input_int(base + 1) != Command::Servo as i32 {
            self.phase = Phase::Stopped;
            return;
        }
        if newest == self.counter {
            self.missed += 1;
            if self.missed > self.program.extrapolated_cycles {
                self.phase = Phase::Starved;
                return;
            }
        } else {
            self.counter = newest;
            self.missed = 0;
            self.q = registers.six_doubles(base);
            self.qd = registers.six_doubles(base + 6);
        }
        let ahead = f64::from(self.missed) * self.program.cycle_s;
        self.motion = Motion::Servo(std::array::from_fn(|joint| {
            self.q[joint] + self.qd[joint] * ahead
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::fields::InputField;
    use crate::program::tests::PROGRAM;
    use crate::wire::Value;

    fn begun(registers: &mut Registers, cycle_s: f64) -> RunningProgram {
        let program = ServoProgram {
            extrapolated_cycles: 3,
            patience_s: 0.1,
            ..PROGRAM
        };
        RunningProgram::begin(program, cycle_s, registers)
    }

    fn give(registers: &mut Registers, counter: i32, command: Command, q: f64, qd: f64) {
        registers.write_input(InputField::Int(24), Value::Int32(counter), 0);
        registers.write_input(InputField::Int(25), Value::Int32(command as i32), 0);
        for joint in 24..30 {
            registers.write_input(InputField::Double(joint), Value::Double(q), 0);
            registers.write_input(InputField::Double(joint + 6), Value::Double(qd), 0);
        }
    }

    fn target(motion: Motion) -> f64 {
        match motion {
            Motion::Servo(q) => q[3],
            other => panic!("{other:?} instead of servoj"),
        }
    }

    #[test]
    fn nothing_moves_before_the_first_reference() {
        let mut registers = Registers::new();
        let mut running = begun(&mut registers, 0.008);
        assert_eq!(registers.output_int(25), PROGRAM.session);
        for _ in 0..5 {
            assert_eq!(running.cycle(&mut registers), Motion::Rest);
        }
        give(&mut registers, 0, Command::Servo, 1.0, 0.0);
        assert_eq!(running.cycle(&mut registers), Motion::Rest, "old counter");
        give(&mut registers, 1, Command::Idle, 1.0, 0.0);
        assert_eq!(running.cycle(&mut registers), Motion::Rest, "idle");
        give(&mut registers, 1, Command::Servo, 1.0, 0.0);
        assert_eq!(target(running.cycle(&mut registers)), 1.0);
        assert_eq!(registers.output_int(24), Phase::Servoing as i32);
    }

    #[test]
    fn missing_references_are_bridged_three_times_and_then_the_arm_stops() {
        let mut registers = Registers::new();
        let mut running = begun(&mut registers, 0.008);
        give(&mut registers, 1, Command::Servo, 1.0, 0.5);
        let targets: Vec<f64> = (0..4)
            .map(|_| target(running.cycle(&mut registers)))
            .collect();
        assert_eq!(targets, [1.0, 1.004, 1.008, 1.012]);
        assert_eq!(running.cycle(&mut registers), Motion::Brake(4.0));
        assert_eq!(registers.output_int(24), Phase::Starved as i32);
        give(&mut registers, 2, Command::Servo, 1.0, 0.5);
        assert_eq!(
            running.cycle(&mut registers),
            Motion::Brake(4.0),
            "no motion after a stop"
        );
    }

    #[test]
    fn the_command_to_stop_brakes() {
        let mut registers = Registers::new();
        let mut running = begun(&mut registers, 0.008);
        give(&mut registers, 1, Command::Servo, 1.0, 0.5);
        running.cycle(&mut registers);
        give(&mut registers, 2, Command::Stop, 2.0, 0.5);
        assert_eq!(running.cycle(&mut registers), Motion::Brake(4.0));
        assert!(running.is_ending());
    }

    #[test]
    fn a_slow_reference_holds_for_all_its_control_cycles() {
        let mut registers = Registers::new();
        let mut running = begun(&mut registers, 0.002);
        give(&mut registers, 1, Command::Servo, 1.0, 0.5);
        let targets: Vec<f64> = (0..8)
            .map(|_| target(running.cycle(&mut registers)))
            .collect();
        assert_eq!(targets, [1.0, 1.0, 1.0, 1.0, 1.004, 1.004, 1.004, 1.004]);
    }

    #[test]
    fn a_program_that_nobody_uses_ends_without_motion() {
        let mut registers = Registers::new();
        let mut running = begun(&mut registers, 0.008);
        for _ in 0..20 {
            assert_eq!(running.cycle(&mut registers), Motion::Rest);
        }
        assert_eq!(registers.output_int(24), Phase::GaveUp as i32);
    }
}
