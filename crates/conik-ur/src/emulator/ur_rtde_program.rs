//! The control program that the `ur-rtde` client uploads, as far as it is emulated.
//!
//! Recognised by its name and its register offsets, not interpreted: the client writes a command
//! and its parameters into input registers, and the program answers in its first integer output.
//! `servoJ`, `servoStop` and the end of the program are emulated. Any other command ends the
//! program with a line that names it, so that no client takes a motion for done that was not.

use super::arm::Motion;
use super::fields::InputField;
use super::registers::Registers;
use crate::registers::JOINTS;
use crate::wire::Value;

/// Answers in the first integer output.
const READY: i32 = 1;
const DONE: i32 = 2;

/// Commands.
const NOTHING: i32 = 0;
const SERVO_J: i32 = 11;
const SERVO_STOP: i32 = 16;
const STOP_SCRIPT: i32 = 255;
/// Commands without any effect on what is emulated: zero the force sensor, set the payload, the
/// tool's centre, the target payload.
const WITHOUT_EFFECT: [i32; 4] = [8, 17, 29, 65];

/// Deceleration when the program ends [rad/s²].
const END_DECELERATION: f64 = 10.0;

/// The program while it runs.
#[derive(Clone, Debug)]
pub(super) struct UrRtdeProgram {
    first_int: u8,
    first_double: u8,
    /// The command that was answered with [`DONE`] and not yet taken back.
    answered: i32,
    motion: Motion,
    /// Why it ends, once it does.
    ending: Option<String>,
}

impl UrRtdeProgram {
    /// The program in a text, if it is this one.
    pub(super) fn recognise(text: &str) -> Option<Self> {
        text.lines()
            .any(|line| line.trim() == "def rtde_control():")
            .then_some(())?;
        let offset = |name| offset(text, name).filter(|offset| [0, 24].contains(offset));
        Some(Self {
            first_int: offset("reg_offset_int")?,
            first_double: offset("reg_offset_float")?,
            answered: NOTHING,
            motion: Motion::Rest,
            ending: None,
        })
    }

    /// Why it ends, once it does.
    pub(super) fn ending(&self) -> Option<&str> {
        self.ending.as_deref()
    }

    /// One control cycle of the program.
    pub(super) fn cycle(&mut self, registers: &mut Registers) -> Motion {
        if self.ending.is_some() {
            return self.motion;
        }
        let command = registers.input_int(usize::from(self.first_int));
        let answer = match command {
            NOTHING => READY,
            SERVO_J => {
                self.motion = self.servo(registers);
                READY
            }
            STOP_SCRIPT => {
                self.end("ur_rtde program ended by its client".to_owned());
                DONE
            }
            SERVO_STOP => {
                if self.answered != command {
                    self.motion = Motion::Brake(self.double(registers, 0).clamp(0.1, 40.0));
                }
                DONE
            }
            other if WITHOUT_EFFECT.contains(&other) => DONE,
            other => {
                self.end(format!(
                    "ur_rtde program ended: its command {other} is not emulated"
                ));
                READY
            }
        };
        self.answered = command;
        registers.write_output_int(usize::from(self.first_int), answer);
        self.motion
    }

    fn end(&mut self, why: String) {
        self.motion = Motion::Brake(END_DECELERATION);
        self.ending = Some(why);
    }

    /// `servoj` with the newest parameters, brought into the range that it accepts.
    fn servo(&self, registers: &Registers) -> Motion {
        Motion::Servo {
            target: std::array::from_fn(|joint| self.double(registers, joint)),
            lookahead_s: self.double(registers, JOINTS + 3).clamp(0.03, 0.2),
            gain: self.double(registers, JOINTS + 4).clamp(100.0, 2000.0),
        }
    }

    fn double(&self, registers: &Registers, index: usize) -> f64 {
        match registers.input(InputField::Double(usize::from(self.first_double) + index)) {
            Value::Double(value) => value,
            _ => 0.0,
        }
    }
}

/// The number assigned to `name`; the client leaves a comment and a line break before it, and the
/// next statement right behind it.
fn offset(text: &str, name: &str) -> Option<u8> {
    let (_, after) = text.split_once(&format!("{name} = "))?;
    after
        .lines()
        .take(2)
        .filter_map(|line| line.split('#').next())
        .find_map(|line| line.split_whitespace().next()?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "def rtde_control():\n global reg_offset_float = # float register offset\n24    \
                        global reg_offset_int = # int register offset\n24    global x = 0\nend\n";

    fn command(registers: &mut Registers, number: i32) {
        registers.write_input(InputField::Int(24), Value::Int32(number), 0);
    }

    #[test]
    fn offsets_stand_on_the_line_after_their_comment() {
        assert!(UrRtdeProgram::recognise(HEAD).is_some());
        assert!(UrRtdeProgram::recognise(&HEAD.replace("24", "7")).is_none());
        assert!(UrRtdeProgram::recognise("def other():\nend\n").is_none());
    }

    #[test]
    fn servo_commands_are_answered_at_once_and_others_until_taken_back() {
        let mut registers = Registers::new();
        let mut program = UrRtdeProgram::recognise(HEAD).unwrap();
        assert_eq!(program.cycle(&mut registers), Motion::Rest);
        assert_eq!(registers.output_int(24), READY);
        registers.write_input(InputField::Double(26), Value::Double(0.5), 0);
        command(&mut registers, SERVO_J);
        let Motion::Servo { target, .. } = program.cycle(&mut registers) else {
            panic!("no servoj");
        };
        assert_eq!(target, [0.0, 0.0, 0.5, 0.0, 0.0, 0.0]);
        assert_eq!(registers.output_int(24), READY);
        command(&mut registers, SERVO_STOP);
        assert!(matches!(program.cycle(&mut registers), Motion::Brake(_)));
        assert_eq!(registers.output_int(24), DONE);
        command(&mut registers, NOTHING);
        program.cycle(&mut registers);
        assert_eq!(registers.output_int(24), READY);
    }

    #[test]
    fn a_motion_that_is_not_emulated_is_never_reported_done() {
        let mut registers = Registers::new();
        let mut program = UrRtdeProgram::recognise(HEAD).unwrap();
        command(&mut registers, 1);
        program.cycle(&mut registers);
        assert_eq!(registers.output_int(24), READY);
        assert!(program.ending().unwrap().contains("command 1 is not"));
    }
}
