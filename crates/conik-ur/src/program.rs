//! The program that runs on the controller: it turns registers into `servoj` calls.
//!
//! The text is `servo.script`, genuine `URScript` with its parameters as named constants at the
//! top. [`ServoProgram::parse`] reads them back from a text that is this program to the letter, so
//! that whoever emulates it never takes another program for it.

use crate::registers::{BadRegisterBase, RegisterBase};
use std::fmt;
use std::str::FromStr;

/// The program's text; `{name}` stands for a parameter.
const TEMPLATE: &str = include_str!("servo.script");

/// The parameters of the servo program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoProgram {
    /// A number that the program hands back, so that an older run is not taken for this one.
    pub session: i32,
    /// How long one `servoj` holds control: the period of the references [s].
    pub cycle_s: f64,
    /// `servoj`'s lookahead time [s], 0.03 to 0.2.
    pub lookahead_s: f64,
    /// `servoj`'s gain, 100 to 2000.
    pub gain: f64,
    /// Cycles without a new reference that are bridged with `qd_ref` before the arm is stopped.
    pub extrapolated_cycles: u32,
    /// Deceleration of the stop [rad/s²].
    pub stop_deceleration: f64,
    /// Packages per second below which the controller itself stops the program [Hz].
    pub watchdog_hz: f64,
    /// How long to wait for the first reference [s].
    pub patience_s: f64,
    /// Where the registers begin.
    pub registers: RegisterBase,
    /// Mass on the flange [kg]; `None`: the installation's.
    pub payload_kg: Option<f64>,
    /// The tool in the flange's frame; `None`: the installation's.
    pub tcp: Option<Pose>,
}

/// A pose as the controller writes it: a point [m] and a rotation vector [rad].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose(pub [f64; 6]);

impl fmt::Display for Pose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers = self.0.map(|number| format!("{number:?}"));
        write!(f, "p[{}]", numbers.join(", "))
    }
}

impl FromStr for Pose {
    type Err = NoPose;

    fn from_str(text: &str) -> Result<Self, NoPose> {
        let numbers = text
            .strip_prefix("p[")
            .and_then(|text| text.strip_suffix(']'));
        let numbers: Option<Vec<f64>> = numbers
            .ok_or(NoPose)?
            .split(", ")
            .map(|number| number.parse().ok())
            .collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        numbers.map(Self).ok_or(NoPose)
    }
}

/// A text that is not a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not a pose such as p[0.0, 0.0, 0.1, 0.0, 0.0, 0.0]")]
pub struct NoPose;

/// A program that must not be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProgramError {
    /// A parameter outside of its range.
    #[error("{name} is {value}; it must lie within {from} and {to}")]
    OutOfRange {
        /// Which parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed.
        from: f64,
        /// Largest allowed.
        to: f64,
    },
    /// The registers do not fit.
    #[error(transparent)]
    Registers(#[from] BadRegisterBase),
    /// The text is not the servo program.
    #[error("not the Conik servo program: line {line} differs")]
    Other {
        /// 1-based number of the first line that is different.
        line: usize,
    },
}

impl ServoProgram {
    /// The program's name on the controller.
    pub const NAME: &str = "conik_servo";

    /// Whether every parameter is within its range.
    pub fn check(&self) -> Result<(), ProgramError> {
        let cycles = f64::from(self.extrapolated_cycles);
        let tcp = self.tcp.unwrap_or_default().0;
        let tcp = tcp.map(|value| ("the tool centre point [m or rad]", value, -10.0, 10.0));
        for (name, value, from, to) in [
            ("the cycle [s]", self.cycle_s, 0.001, 1.0),
            ("the lookahead [s]", self.lookahead_s, 0.03, 0.2),
            ("the gain", self.gain, 100.0, 2000.0),
            ("the number of extrapolated cycles", cycles, 0.0, 1000.0),
            (
                "the stop deceleration [rad/s²]",
                self.stop_deceleration,
                0.1,
                40.0,
            ),
            ("the watchdog's rate [Hz]", self.watchdog_hz, 0.1, 500.0),
            ("the patience [s]", self.patience_s, 0.1, 3600.0),
            (
                "the payload [kg]",
                self.payload_kg.unwrap_or(0.0),
                0.0,
                40.0,
            ),
        ]
        .into_iter()
        .chain(tcp)
        {
            // Written so that a NaN is out of range too.
            if !(from..=to).contains(&value) {
                return Err(ProgramError::OutOfRange {
                    name,
                    value,
                    from,
                    to,
                });
            }
        }
        Ok(())
    }

    /// The program's text, ready to be sent to the controller.
    pub fn text(&self) -> Result<String, ProgramError> {
        self.check()?;
        Ok(self
            .parameters()
            .into_iter()
            .fold(TEMPLATE.to_owned(), |text, (placeholder, value)| {
                text.replace(placeholder, &value)
            }))
    }

    /// The parameters of a text that is this program, whatever its line ends.
    pub fn parse(text: &str) -> Result<Self, ProgramError> {
        let program = Self {
            session: parameter(text, "{session}")?,
            cycle_s: parameter(text, "{cycle_s}")?,
            lookahead_s: parameter(text, "{lookahead_s}")?,
            gain: parameter(text, "{gain}")?,
            extrapolated_cycles: parameter(text, "{extrapolated_cycles}")?,
            stop_deceleration: parameter(text, "{stop_deceleration}")?,
            watchdog_hz: parameter(text, "{watchdog_hz}")?,
            patience_s: parameter(text, "{patience_s}")?,
            registers: RegisterBase::new(parameter(text, "{register_base}")?)?,
            payload_kg: Some(parameter(text, "{payload_kg}")?).filter(|mass: &f64| *mass >= 0.0),
            tcp: match parameter(text, "{tcp_is_given}")? {
                0_u8 => None,
                _ => Some(parameter(text, "{tcp}")?),
            },
        };
        let ours = program.text()?;
        match first_difference(&ours, text) {
            None => Ok(program),
            Some(line) => Err(ProgramError::Other { line }),
        }
    }

    /// What stands for each parameter in the text.
    fn parameters(&self) -> [(&'static str, String); 13] {
        [
            ("{session}", self.session.to_string()),
            ("{cycle_s}", format!("{:?}", self.cycle_s)),
            ("{lookahead_s}", format!("{:?}", self.lookahead_s)),
            ("{gain}", format!("{:?}", self.gain)),
            (
                "{extrapolated_cycles}",
                self.extrapolated_cycles.to_string(),
            ),
            (
                "{stop_deceleration}",
                format!("{:?}", self.stop_deceleration),
            ),
            ("{watchdog_hz}", format!("{:?}", self.watchdog_hz)),
            ("{patience_s}", format!("{:?}", self.patience_s)),
            ("{register_base}", self.registers.first().to_string()),
            ("{watched}", self.registers.counter()),
            (
                "{payload_kg}",
                format!("{:?}", self.payload_kg.unwrap_or(-1.0)),
            ),
            ("{tcp_is_given}", u8::from(self.tcp.is_some()).to_string()),
            ("{tcp}", self.tcp.unwrap_or_default().to_string()),
        ]
    }
}

/// The parameter that stands in `text` where the template has `placeholder`.
fn parameter<T: FromStr>(text: &str, placeholder: &str) -> Result<T, ProgramError> {
    let (at, line) = TEMPLATE
        .lines()
        .enumerate()
        .find(|(_, line)| line.contains(placeholder))
        .unwrap_or((0, placeholder));
    let (before, after) = line.split_once(placeholder).unwrap_or_default();
    text.lines()
        .nth(at)
        .and_then(|line| line.strip_prefix(before))
        .and_then(|line| line.strip_suffix(after))
        .and_then(|value| value.parse().ok())
        .ok_or(ProgramError::Other { line: at + 1 })
}

/// 1-based number of the first line in which two texts differ, blank lines at the end apart.
fn first_difference(a: &str, b: &str) -> Option<usize> {
    let (mut a, mut b) = (a.trim_end().lines(), b.trim_end().lines());
    (1..).find_map(|line| match (a.next(), b.next()) {
        (None, None) => Some(None),
        (a, b) if a == b => None,
        _ => Some(Some(line)),
    })?
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) const PROGRAM: ServoProgram = ServoProgram {
        session: 4711,
        cycle_s: 0.008,
        lookahead_s: 0.1,
        gain: 300.0,
        extrapolated_cycles: 5,
        stop_deceleration: 4.0,
        watchdog_hz: 10.5,
        patience_s: 60.0,
        registers: match RegisterBase::new(24) {
            Ok(base) => base,
            Err(_) => unreachable!(),
        },
        payload_kg: None,
        tcp: None,
    };

    #[test]
    fn parameters_survive_the_way_into_the_text_and_back() {
        let text = PROGRAM.text().unwrap();
        assert!(!text.contains('{'), "a placeholder is left:\n{text}");
        assert_eq!(ServoProgram::parse(&text), Ok(PROGRAM));
        let with_tool = ServoProgram {
            payload_kg: Some(1.5),
            tcp: Some(Pose([0.0, 0.0, 0.12, 0.0, 1.25, 0.0])),
            ..PROGRAM
        };
        let text_with_tool = with_tool.text().unwrap();
        assert!(text_with_tool.contains("tcp = p[0.0, 0.0, 0.12, 0.0, 1.25, 0.0]\n"));
        assert_eq!(ServoProgram::parse(&text_with_tool), Ok(with_tool));
        assert_eq!(
            ServoProgram::parse(&text.replace('\n', "\r\n")),
            Ok(PROGRAM)
        );
    }

    #[test]
    fn a_program_that_differs_anywhere_is_not_ours() {
        let text = PROGRAM.text().unwrap();
        let faster = text.replace("stopj(deceleration)", "stopj(40)");
        assert!(matches!(
            ServoProgram::parse(&faster),
            Err(ProgramError::Other { .. })
        ));
        let longer = format!("{text}movej([0,0,0,0,0,0])\n");
        assert!(ServoProgram::parse(&longer).is_err());
        assert!(ServoProgram::parse("").is_err());
        assert!(ServoProgram::parse("def other():\nend\n").is_err());
    }

    #[test]
    fn parameters_out_of_range_are_refused_by_name() {
        for lookahead_s in [0.01, 0.3, f64::NAN] {
            let error = ServoProgram {
                lookahead_s,
                ..PROGRAM
            }
            .text()
            .unwrap_err();
            assert!(error.to_string().contains("lookahead"), "{error}");
        }
    }

    #[test]
    fn every_block_of_the_program_is_closed() {
        let text = PROGRAM.text().unwrap();
        let words = |word: &str| {
            text.lines()
                .filter(|line| line.split_whitespace().next() == Some(word))
                .count()
        };
        let opened = words("def") + words("while") + words("if");
        assert_eq!(opened, words("end"));
    }
}
