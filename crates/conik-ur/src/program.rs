//! The program that runs on the controller: it turns registers into `servoj` calls.
//!
//! The text is `servo.script`, genuine `URScript` with its parameters as named constants at the
//! top.

use crate::registers::RegisterBase;
use std::fmt;

/// The program's text; `{name}` stands for a parameter.
const TEMPLATE: &str = include_str!("servo.script");

/// The parameters of the servo program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoProgram {
    /// A number that the program hands back, so that an older run is not taken for this one.
    pub session: i32,
    /// How long one `servoj` holds control: the period of the references [s].
    pub cycle_s: f64,
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

    /// What stands for each parameter in the text.
    fn parameters(&self) -> [(&'static str, String); 11] {
        [
            ("{session}", self.session.to_string()),
            ("{cycle_s}", format!("{:?}", self.cycle_s)),
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) const PROGRAM: ServoProgram = ServoProgram {
        session: 4711,
        cycle_s: 0.008,
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
    fn every_parameter_stands_in_the_text() {
        let text = PROGRAM.text().unwrap();
        assert!(!text.contains('{'), "a placeholder is left:\n{text}");
        for line in [
            "session = 4711",
            "tcp_is_given = 0",
            "payload = -1.0",
            "base = 24",
        ] {
            assert!(text.contains(&format!("  {line}\n")), "{line}");
        }
        let with_tool = ServoProgram {
            payload_kg: Some(1.5),
            tcp: Some(Pose([0.0, 0.0, 0.12, 0.0, 1.25, 0.0])),
            ..PROGRAM
        };
        let text = with_tool.text().unwrap();
        assert!(text.contains("  tcp = p[0.0, 0.0, 0.12, 0.0, 1.25, 0.0]\n"));
        assert!(text.contains("  payload = 1.5\n"));
    }

    #[test]
    fn parameters_out_of_range_are_refused_by_name() {
        for cycle_s in [0.0001, 2.0, f64::NAN] {
            let error = ServoProgram { cycle_s, ..PROGRAM }.text().unwrap_err();
            assert!(error.to_string().contains("the cycle"), "{error}");
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
