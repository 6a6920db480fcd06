//! What the controller's own functions do.

use super::Pause;
use super::arguments::Arguments;
use super::error::Fault;
use super::signature::{Builtin, Signature};
use super::surroundings::{Joints, Register, Surroundings, WatchdogAction};
use super::value::{MOST_TEXT, Value};
use std::ops::RangeInclusive;

/// What `servoj` takes, and what holds where it is not given.
const LOOKAHEAD: (f64, RangeInclusive<f64>) = (0.1, 0.03..=0.2);
const GAIN: (f64, RangeInclusive<f64>) = (300.0, 100.0..=2000.0);

/// Times that a program may ask for [s].
const TIMES: RangeInclusive<f64> = 0.0..=1e6;

/// What a call leads to.
pub(super) enum Outcome {
    Value(Value),
    /// Nothing, and control cycles pass.
    Pause(Pause),
}

impl Signature {
    /// Calls it with as many arguments as it has parameters.
    pub(super) fn call(
        &self,
        arguments: &[Value],
        around: &mut dyn Surroundings,
    ) -> Result<Outcome, Fault> {
        let arguments = Arguments {
            signature: self,
            values: arguments,
        };
        self.answer(&arguments, around)
    }

    fn answer(
        &self,
        arguments: &Arguments,
        around: &mut dyn Surroundings,
    ) -> Result<Outcome, Fault> {
        let value = match self.builtin {
            Builtin::ReadInput(kind) => {
                let address = arguments.address(kind)?;
                register_value(kind, around.input(kind, address))
            }
            Builtin::ReadOutput(kind) => {
                let address = arguments.address(kind)?;
                register_value(kind, around.output(kind, address))
            }
            Builtin::WriteOutput(kind) => {
                let address = arguments.address(kind)?;
                let value = match kind {
                    Register::Float => arguments.number(1)?,
                    Register::Integer => f64::from(arguments.integer(1)?),
                    Register::Boolean => f64::from(u8::from(arguments.boolean(1)?)),
                };
                around.write_output(kind, address, value);
                Value::Nothing
            }
            Builtin::Sleep => {
                let time_s = arguments.within(0, TIMES)?;
                if time_s > 0.0 {
                    return Ok(Outcome::Pause(Pause::Sleep { time_s }));
                }
                Value::Nothing
            }
            Builtin::Sync => return Ok(Outcome::Pause(Pause::Sync)),
            Builtin::Servoj => return servoj(arguments, around).map(Outcome::Pause),
            Builtin::Stopj => {
                let deceleration = arguments.within(0, 1e-3..=1e3)?;
                return Ok(Outcome::Pause(Pause::Stopj { deceleration }));
            }
            Builtin::SetPayload => {
                let mass = arguments.within(0, 0.0..=100.0)?;
                if !matches!(arguments.values[1], Value::Nothing | Value::List(_)) {
                    return Err(arguments.is_not(1, "a list"));
                }
                around.set_payload(mass);
                Value::Nothing
            }
            Builtin::SetTcp => {
                let Value::Pose(pose) = arguments.values[0] else {
                    return Err(arguments.is_not(0, "a pose"));
                };
                around.set_tcp(pose);
                Value::Nothing
            }
            Builtin::SetWatchdog => set_watchdog(arguments, around)?,
            Builtin::Joints(which) => Value::six(around.joints(which)),
            Builtin::IsSteady => {
                let speeds = around.joints(Joints::TargetSpeeds);
                Value::Boolean(speeds.iter().all(|speed| *speed == 0.0))
            }
            Builtin::CycleTime => Value::Float(around.cycle_s()),
            Builtin::TextMessage => {
                let second = match &arguments.values[1] {
                    Value::Nothing => String::new(),
                    value => value.to_string(),
                };
                around.say(&format!("{}{second}", arguments.values[0]));
                Value::Nothing
            }
            Builtin::Popup => {
                if arguments.values[4] == Value::Boolean(true) {
                    return Err(Fault::NotEmulated("popups that wait for an answer"));
                }
                around.say(&format!("popup: {}", arguments.values[0]));
                Value::Nothing
            }
            _ => return self.calculate(arguments).map(Outcome::Value),
        };
        Ok(Outcome::Value(value))
    }

    /// Functions of their arguments alone.
    fn calculate(&self, arguments: &Arguments) -> Result<Value, Fault> {
        let first = &arguments.values[0];
        match self.builtin {
            Builtin::Math(function) => {
                let count = arguments.values.len();
                let numbers: Result<Vec<f64>, Fault> =
                    (0..count).map(|index| arguments.number(index)).collect();
                Value::float(function(&numbers?), self.name)
            }
            Builtin::Round(round) => {
                let rounded = round(arguments.number(0)?);
                let fits = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&rounded);
                #[allow(clippy::cast_possible_truncation)] // Checked in the line before.
                fits.then_some(Value::Integer(rounded as i32))
                    .ok_or_else(|| Fault::Result(self.name.to_owned()))
            }
            Builtin::Abs => match *first {
                Value::Integer(value) => value
                    .checked_abs()
                    .map(Value::Integer)
                    .ok_or_else(|| Fault::Result(self.name.to_owned())),
                _ => Value::float(arguments.number(0)?.abs(), self.name),
            },
            Builtin::Norm => {
                let squares = |numbers: &mut dyn Iterator<Item = f64>| {
                    numbers.map(|number| number * number).sum::<f64>().sqrt()
                };
                let norm = match first {
                    Value::List(elements) => {
                        let numbers: Option<Vec<f64>> =
                            elements.iter().map(Value::number).collect();
                        let numbers =
                            numbers.ok_or_else(|| arguments.is_not(0, "a list of numbers"))?;
                        squares(&mut numbers.into_iter())
                    }
                    Value::Pose(numbers) => squares(&mut numbers.iter().copied()),
                    _ => arguments.number(0)?.abs(),
                };
                Value::float(norm, self.name)
            }
            Builtin::Length => {
                let length = match first {
                    Value::List(elements) => elements.len(),
                    Value::Text(text) => text.chars().count(),
                    _ => return Err(arguments.is_not(0, "a list or a text")),
                };
                // Both are bounded far below.
                Ok(Value::Integer(i32::try_from(length).unwrap_or(i32::MAX)))
            }
            Builtin::ToText => text(first.to_string()),
            _ => text(format!("{first}{}", arguments.values[1])),
        }
    }
}

fn text(text: String) -> Result<Value, Fault> {
    if text.len() > MOST_TEXT {
        let what = "a text's size in bytes";
        return Err(Fault::TooMuch {
            what,
            most: MOST_TEXT,
        });
    }
    Ok(Value::Text(text.into()))
}

/// A register's contents, which the surroundings give as a number.
fn register_value(kind: Register, value: f64) -> Value {
    match kind {
        Register::Float => Value::Float(value),
        #[allow(clippy::cast_possible_truncation)] // It came from one.
        Register::Integer => Value::Integer(value as i32),
        Register::Boolean => Value::Boolean(value != 0.0),
    }
}

/// `a` and `v` are not used by the controller either.
fn servoj(arguments: &Arguments, around: &mut dyn Surroundings) -> Result<Pause, Fault> {
    let target = arguments.values[0].six_numbers();
    let target = target.ok_or_else(|| arguments.is_not(0, "a list of six numbers"))?;
    arguments.optional(1, 0.0, f64::MIN..=f64::MAX)?;
    arguments.optional(2, 0.0, f64::MIN..=f64::MAX)?;
    Ok(Pause::Servoj {
        target,
        time_s: arguments.optional(3, around.cycle_s(), TIMES)?,
        lookahead_s: arguments.optional(4, LOOKAHEAD.0, LOOKAHEAD.1)?,
        gain: arguments.optional(5, GAIN.0, GAIN.1)?,
    })
}

fn set_watchdog(arguments: &Arguments, around: &mut dyn Surroundings) -> Result<Value, Fault> {
    let name = arguments.text(0)?;
    let least_hz = arguments.within(1, 1e-3..=1e3)?;
    let action = match &arguments.values[2] {
        Value::Nothing => WatchdogAction::Pause,
        _ => match arguments.text(2)? {
            "ignore" => WatchdogAction::Ignore,
            "pause" => WatchdogAction::Pause,
            "stop" => WatchdogAction::Stop,
            other => {
                return Err(Fault::Unknown {
                    place: "rtde_set_watchdog's action",
                    value: other.to_owned(),
                });
            }
        },
    };
    if !around.set_watchdog(name, least_hz, action) {
        return Err(Fault::Unknown {
            place: "rtde_set_watchdog's input",
            value: name.to_owned(),
        });
    }
    Ok(Value::Nothing)
}
