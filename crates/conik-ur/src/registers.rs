//! Which registers carry a reference from this program to the servo program on the controller.
//!
//! | register | what it carries |
//! |---|---|
//! | `input_double_register_B` .. `B+5` | `q_ref` [rad] |
//! | `input_double_register_B+6` .. `B+11` | `qd_ref` [rad/s], for extrapolation |
//! | `input_double_register_B+12`, `B+13`, `B+14` | `servoj`'s lookahead [s], gain, and the time that it holds control [s] |
//! | `input_int_register_B` | counter: changes with each reference |
//! | `input_int_register_B+1` | command: 0 idle, 1 servo, 2 stop |
//! | `input_int_register_B+2` | beside command 2: 1 if a fault is the reason, 0 otherwise |
//! | `output_int_register_B` | phase of the servo program, see [`Phase`] |
//! | `output_int_register_B+1` | session number, so that no other program's registers are taken for ours: see [`session_number`] |
//!
//! The base B is 24 by default: 0 to 23 belong to a fieldbus as soon as one is switched on.

use crate::wire::FieldType;

/// Joints of every UR arm.
pub const JOINTS: usize = 6;

/// First register of a kind that a fieldbus never claims.
pub const FIRST_UPPER_REGISTER: u8 = 24;

/// Registers of each kind.
pub const REGISTER_COUNT: u8 = 48;

/// Doubles that a reference takes: `q_ref`, `qd_ref`, and `servoj`'s three parameters.
pub(crate) const DOUBLES: u8 = 15;

/// Integers beside them: counter, command, reason.
pub(crate) const INTS: u8 = 3;

/// Upper half of every session number: `CN`.
const SESSION_MARK: i32 = 0x434E;

/// A session number other than `previous`: the mark of all of them, and 16 bits of `seed`.
pub fn session_number(previous: i32, seed: u32) -> i32 {
    let number = |seed: u32| (SESSION_MARK << 16) | (seed & 0xFFFF).cast_signed();
    match number(seed) {
        again if again == previous => number(seed.wrapping_add(1)),
        new => new,
    }
}

/// Whether this is a session number of a servo program. Other programs write the same register, but
/// hardly such numbers.
pub fn is_session(number: i32) -> bool {
    number >> 16 == SESSION_MARK
}

/// Where the registers of the transport begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegisterBase(u8);

/// A base from which the registers of the transport do not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "register base {0}: the fifteen registers from it must lie within 24..47, or within 0..23 if \
     no fieldbus is in use; 24 is usual"
)]
pub struct BadRegisterBase(pub u8);

impl RegisterBase {
    /// Registers from `base` on.
    pub const fn new(base: u8) -> Result<Self, BadRegisterBase> {
        let fits_lower = base <= FIRST_UPPER_REGISTER - DOUBLES;
        let fits_upper = base >= FIRST_UPPER_REGISTER && base <= REGISTER_COUNT - DOUBLES;
        if fits_lower || fits_upper {
            Ok(Self(base))
        } else {
            Err(BadRegisterBase(base))
        }
    }

    /// The first register.
    pub fn first(self) -> u8 {
        self.0
    }

    /// Whether these are the registers that only newer controllers have.
    pub fn is_upper(self) -> bool {
        self.0 >= FIRST_UPPER_REGISTER
    }

    /// The input that changes with each reference.
    pub fn counter(self) -> String {
        format!("input_int_register_{}", self.0)
    }

    /// All inputs, in the order in which a reference is sent.
    pub fn inputs(self) -> Vec<(String, FieldType)> {
        let ints = (self.0..self.0 + INTS)
            .map(|register| (format!("input_int_register_{register}"), FieldType::Int32));
        let doubles = (self.0..self.0 + DOUBLES).map(|register| {
            let name = format!("input_double_register_{register}");
            (name, FieldType::Double)
        });
        ints.chain(doubles).collect()
    }

    /// The outputs: phase, then session number.
    pub fn outputs(self) -> [(String, FieldType); 2] {
        [self.0, self.0 + 1]
            .map(|register| (format!("output_int_register_{register}"), FieldType::Int32))
    }
}

impl Default for RegisterBase {
    fn default() -> Self {
        Self(FIRST_UPPER_REGISTER)
    }
}

/// What the servo program is asked to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Nothing yet.
    Idle = 0,
    /// Follow the references.
    Servo = 1,
    /// Stop the arm and end.
    Stop = 2,
}

/// Where the servo program is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It waits for the first reference; nothing moves.
    Waiting = 1,
    /// It follows references.
    Servoing = 2,
    /// It has stopped the arm because it was told to.
    Stopped = 3,
    /// It stops the arm, or has, because references stayed away.
    Starved = 4,
    /// It ended without having moved, because no reference ever came.
    GaveUp = 5,
    /// It has stopped the arm because it was told to, and the reason was a fault.
    StoppedByFault = 6,
}

impl Phase {
    /// The phase of this number.
    pub fn from_number(number: i32) -> Option<Self> {
        [
            Self::Waiting,
            Self::Servoing,
            Self::Stopped,
            Self::Starved,
            Self::GaveUp,
            Self::StoppedByFault,
        ]
        .into_iter()
        .find(|phase| *phase as i32 == number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn session_numbers_differ_from_the_one_before_and_are_known() {
        for seed in [0, 1, 0xFFFF, 0x1_0000, u32::MAX] {
            let first = session_number(0, seed);
            let second = session_number(first, seed);
            assert_ne!(first, second);
            assert!(is_session(first) && is_session(second));
        }
        assert!(
            ![0, 1, 2, -1, 1_000_000, i32::MAX]
                .into_iter()
                .any(is_session)
        );
    }

    #[test]
    fn the_registers_never_straddle_those_of_a_fieldbus() {
        for (base, fits) in [
            (0, true),
            (9, true),
            (10, false),
            (23, false),
            (24, true),
            (33, true),
            (34, false),
            (255, false),
        ] {
            assert_eq!(RegisterBase::new(base).is_ok(), fits, "base {base}");
        }
    }
}
