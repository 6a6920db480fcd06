//! The servo program (`servo.script`), run by the interpreter: what it does with its registers.

use super::arm::{Arm, Motion};
use super::config::{EmulatorConfig, Series};
use super::fields::InputField;
use super::log::Log;
use super::registers::Registers;
use super::script_program::{Around, Mounted, ScriptProgram};
use super::watchdog::{Bite, Watchdogs};
use crate::program::tests::PROGRAM;
use crate::program::{Pose, ServoProgram};
use crate::registers::{Command, JOINTS, Phase};
use crate::urscript::{Program, WatchdogAction};
use crate::wire::Value;
use conik::JointVec;

/// The program with all that it finds around it; the arm stands still.
struct Run {
    program: ScriptProgram,
    registers: Registers,
    arm: Arm,
    watchdogs: Watchdogs,
    mounted: Mounted,
    cycle_s: f64,
    cycles: u64,
    /// Lookahead, gain and time of `servoj`.
    servoj: [f64; 3],
}

impl Run {
    fn of(program: &ServoProgram, cycle_s: f64) -> Self {
        let config = EmulatorConfig::new(Series::Cb3, JointVec::zeros(JOINTS));
        let program_cycle_s = program.cycle_s;
        let program = Program::parse(&program.text().unwrap()).unwrap();
        assert_eq!(program.name(), ServoProgram::NAME);
        let mut run = Self {
            program: ScriptProgram::new(program),
            registers: Registers::new(),
            arm: Arm::new(&config).unwrap(),
            watchdogs: Watchdogs::default(),
            mounted: Mounted::default(),
            cycle_s,
            cycles: 0,
            servoj: [0.1, 300.0, program_cycle_s],
        };
        // Up to where it waits for the first reference.
        assert_eq!(run.cycle(), Motion::Rest);
        run
    }

    /// Bridges three cycles and waits for 0.1 s.
    fn impatient(cycle_s: f64) -> Self {
        let program = ServoProgram {
            extrapolated_cycles: 3,
            patience_s: 0.1,
            ..PROGRAM
        };
        Self::of(&program, cycle_s)
    }

    fn cycle(&mut self) -> Motion {
        self.cycles += 1;
        let mut around = Around {
            registers: &mut self.registers,
            arm: &self.arm,
            watchdogs: &mut self.watchdogs,
            mounted: &mut self.mounted,
            log: &mut Log::default(),
            time_s: 0.0,
            cycle_s: self.cycle_s,
            slider: 1.0,
        };
        self.program.cycle(&mut around).unwrap()
    }

    fn give(&mut self, counter: i32, command: Command, q: f64, qd: f64) {
        let mut write = |field, value| self.registers.write_input(field, value, self.cycles);
        write(InputField::Int(24), Value::Int32(counter));
        write(InputField::Int(25), Value::Int32(command as i32));
        for joint in 24..30 {
            write(InputField::Double(joint), Value::Double(q));
            write(InputField::Double(joint + 6), Value::Double(qd));
        }
        for (register, value) in (36..).zip(self.servoj) {
            write(InputField::Double(register), Value::Double(value));
        }
    }

    /// The next cycle's target of the fourth joint.
    fn target(&mut self) -> f64 {
        match self.cycle() {
            Motion::Servo { target, .. } => target[3],
            other => panic!("{other:?} instead of servoj"),
        }
    }

    fn phase(&self) -> Option<Phase> {
        Phase::from_number(self.registers.output_int(24))
    }

    fn bite(&self, silent_cycles: u64) -> Option<Bite> {
        self.watchdogs
            .bite(&self.registers, self.cycles + silent_cycles)
    }
}

#[test]
fn nothing_moves_before_the_first_reference() {
    let mut run = Run::impatient(0.008);
    assert_eq!(run.registers.output_int(25), PROGRAM.session);
    assert_eq!(run.phase(), Some(Phase::Waiting));
    for _ in 0..5 {
        assert_eq!(run.cycle(), Motion::Rest);
    }
    run.give(0, Command::Servo, 1.0, 0.0);
    assert_eq!(run.cycle(), Motion::Rest, "old counter");
    run.give(1, Command::Idle, 1.0, 0.0);
    assert_eq!(run.cycle(), Motion::Rest, "idle");
    run.give(1, Command::Servo, 1.0, 0.0);
    assert_eq!(run.target(), 1.0);
    assert_eq!(run.phase(), Some(Phase::Servoing));
}

#[test]
fn each_reference_is_followed_in_the_cycle_in_which_it_is_there() {
    let mut run = Run::impatient(0.008);
    for counter in 1..50 {
        let q = 0.01 * f64::from(counter);
        run.give(counter, Command::Servo, q, 0.5);
        assert_eq!(run.target(), q);
    }
}

#[test]
fn servoj_is_given_the_lookahead_and_the_gain_that_come_with_each_reference() {
    let mut run = Run::impatient(0.008);
    for (counter, lookahead_s, gain) in [(1, 0.05, 750.0), (2, 0.2, 100.0)] {
        run.servoj = [lookahead_s, gain, 0.008];
        run.give(counter, Command::Servo, 0.0, 0.0);
        let expected = Motion::Servo {
            target: [0.0; JOINTS],
            lookahead_s,
            gain,
        };
        assert_eq!(run.cycle(), expected);
        assert_eq!(
            run.cycle(),
            expected,
            "a missing one is bridged with the same"
        );
    }
}

#[test]
fn missing_references_are_bridged_three_times_and_then_the_arm_stops() {
    let mut run = Run::impatient(0.008);
    run.give(1, Command::Servo, 1.0, 0.5);
    let targets: Vec<f64> = (0..4).map(|_| run.target()).collect();
    assert_eq!(targets, [1.0, 1.004, 1.008, 1.012]);
    assert_eq!(run.cycle(), Motion::Brake(4.0));
    assert_eq!(run.phase(), Some(Phase::Starved));
    for counter in 2..10 {
        run.give(counter, Command::Servo, 1.0, 0.5);
        let motion = run.cycle();
        assert!(
            !matches!(motion, Motion::Servo { .. }),
            "motion after a stop"
        );
    }
    assert!(run.program.is_over());
}

#[test]
fn the_command_to_stop_brakes() {
    let mut run = Run::impatient(0.008);
    run.give(1, Command::Servo, 1.0, 0.5);
    run.target();
    run.give(2, Command::Stop, 2.0, 0.5);
    assert_eq!(run.cycle(), Motion::Brake(4.0));
    assert_eq!(run.phase(), Some(Phase::Servoing), "not before it stands");
    run.cycle();
    assert!(run.program.is_over());
    assert_eq!(run.phase(), Some(Phase::Stopped));
}

#[test]
fn a_stop_because_of_a_fault_leaves_that_behind() {
    let mut run = Run::impatient(0.008);
    run.give(1, Command::Servo, 1.0, 0.5);
    run.target();
    let fault = (InputField::Int(26), Value::Int32(1));
    run.registers.write_input(fault.0, fault.1, run.cycles);
    run.give(1, Command::Stop, 1.0, 0.5);
    assert_eq!(run.cycle(), Motion::Brake(4.0));
    run.cycle();
    assert!(run.program.is_over());
    assert_eq!(run.phase(), Some(Phase::StoppedByFault));
}

#[test]
fn the_command_to_stop_ends_a_program_that_still_waits_without_motion() {
    let mut run = Run::impatient(0.008);
    run.give(1, Command::Stop, 2.0, 0.5);
    assert_eq!(run.cycle(), Motion::Rest);
    assert!(run.program.is_over());
    assert_eq!(run.phase(), Some(Phase::Stopped));
}

#[test]
fn a_slow_reference_holds_for_all_its_control_cycles() {
    let mut run = Run::impatient(0.002);
    run.give(1, Command::Servo, 1.0, 0.5);
    // It still sleeps for a turn of its loop, four control cycles.
    while run.cycle() == Motion::Rest {}
    let targets: Vec<f64> = (0..7).map(|_| run.target()).collect();
    assert_eq!(targets, [1.0, 1.0, 1.0, 1.004, 1.004, 1.004, 1.004]);
}

#[test]
fn a_program_that_nobody_uses_ends_without_motion() {
    let mut run = Run::impatient(0.008);
    for _ in 0..20 {
        assert_eq!(run.cycle(), Motion::Rest);
    }
    assert_eq!(run.phase(), Some(Phase::GaveUp));
    assert!(run.program.is_over());
}

#[test]
fn the_watchdog_watches_the_counter_while_references_are_followed_and_no_longer() {
    let mut run = Run::impatient(0.008);
    assert_eq!(run.bite(1000), None, "armed before the first reference");
    run.give(1, Command::Servo, 1.0, 0.5);
    run.target();
    // 10.5 Hz at 125 Hz: not quite twelve cycles.
    assert_eq!(run.bite(10), None);
    let bite = Bite {
        action: WatchdogAction::Stop,
        name: "input_int_register_24".to_owned(),
    };
    assert_eq!(run.bite(11), Some(bite));
    run.give(2, Command::Stop, 1.0, 0.5);
    assert_eq!(run.cycle(), Motion::Brake(4.0));
    assert_eq!(run.bite(1000), None, "still armed while the arm is stopped");
}

#[test]
fn payload_and_tool_are_set_only_if_they_are_given() {
    let given = ServoProgram {
        payload_kg: Some(1.5),
        tcp: Some(Pose([0.0, 0.0, 0.12, 0.0, 1.25, 0.0])),
        ..PROGRAM
    };
    let with_tool = Mounted {
        payload_kg: 1.5,
        tcp: [0.0, 0.0, 0.12, 0.0, 1.25, 0.0],
    };
    assert_eq!(Run::of(&given, 0.008).mounted, with_tool);
    assert_eq!(Run::of(&PROGRAM, 0.008).mounted, Mounted::default());
}
