//! The parameters of `servoj`, which go out with each reference and may change while the arm moves.

use std::ops::RangeInclusive;

/// Lookahead times that `servoj` takes [s].
pub const LOOKAHEAD_S: RangeInclusive<f64> = 0.03..=0.2;

/// Gains that `servoj` takes.
pub const GAIN: RangeInclusive<f64> = 100.0..=2000.0;

/// How `servoj` follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servoj {
    /// Lookahead time [s]: about the delay with which the arm follows. A short one rings with a high
    /// gain.
    pub lookahead_s: f64,
    /// Gain: a high one follows stiffly.
    pub gain: f64,
}

/// A parameter that `servoj` does not take.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("servoj's {name} is {value}; it must lie within {from} and {to}")]
pub struct BadServoj {
    /// Which parameter.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Smallest allowed.
    pub from: f64,
    /// Largest allowed.
    pub to: f64,
}

impl Servoj {
    /// Whether `servoj` takes both.
    pub fn check(&self) -> Result<(), BadServoj> {
        for (name, value, range) in [
            ("lookahead [s]", self.lookahead_s, LOOKAHEAD_S),
            ("gain", self.gain, GAIN),
        ] {
            // Written so that a NaN is out of range too.
            if !range.contains(&value) {
                return Err(BadServoj {
                    name,
                    value,
                    from: *range.start(),
                    to: *range.end(),
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_servoj_does_not_take_is_refused_by_name() {
        for (lookahead_s, gain, refused) in [
            (0.03, 100.0, None),
            (0.2, 2000.0, None),
            (0.029, 300.0, Some("lookahead [s] is 0.029")),
            (0.21, 300.0, Some("lookahead [s] is 0.21")),
            (f64::NAN, 300.0, Some("lookahead [s] is NaN")),
            (0.1, 99.0, Some("gain is 99")),
            (0.1, 2001.0, Some("gain is 2001")),
            (0.1, f64::INFINITY, Some("gain is inf")),
        ] {
            let checked = Servoj { lookahead_s, gain }.check();
            match refused {
                None => assert_eq!(checked, Ok(())),
                Some(part) => {
                    let error = checked.unwrap_err().to_string();
                    assert!(error.contains(part), "{error}");
                }
            }
        }
    }
}
