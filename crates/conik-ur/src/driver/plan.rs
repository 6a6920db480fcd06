//! What is settled before references flow: rate, registers and the parameters of the program.

use super::config::UrConfig;
use super::{fault, rearm};
use crate::model::ArmFacts;
use crate::program::ServoProgram;
use crate::registers::{self, JOINTS};
use crate::status::{Status, runtime_state};
use crate::wire::ControllerVersion;
use conik_sim::arm::ArmError;
use conik_sim::scenario::{Choice, UrSeries};
use std::f64::consts::PI;
use std::time::{SystemTime, UNIX_EPOCH};

/// The last version number of the CB3 series.
const CB3_MAJOR: u32 = 3;

/// The most cycles without a reference that may be bridged.
const MOST_EXTRAPOLATED: f64 = 1000.0;

/// The name of the series that a software version belongs to.
pub(super) fn series(version: ControllerVersion) -> &'static str {
    if version.major <= CB3_MAJOR {
        "CB3"
    } else {
        "e-Series"
    }
}

/// The series that a software version belongs to.
pub(super) fn series_of(version: ControllerVersion) -> UrSeries {
    if version.major <= CB3_MAJOR {
        UrSeries::Cb3
    } else {
        UrSeries::ESeries
    }
}

/// The speed limits of the joints [rad/s].
pub(super) fn speed_limit(
    config: &UrConfig,
    arm: Option<&ArmFacts>,
    say: &mut dyn FnMut(&str),
) -> [f64; JOINTS] {
    config.speed_limit.unwrap_or_else(|| {
        arm.map_or_else(
            || {
                say(
                    "no speed limits of this arm are known: 180°/s is taken for every joint; \
                     `most_speed_rad_per_s` in the scenario's [ur] says otherwise",
                );
                [PI; JOINTS]
            },
            ArmFacts::most_speed,
        )
    })
}

/// Whether the controller is of the series that is asked for.
pub(super) fn check_series(config: &UrConfig, version: ControllerVersion) -> Result<(), ArmError> {
    let found = series_of(version);
    match config.series {
        Some(wanted) if wanted != found => {
            let detail = format!(
                "the controller at {} is {} (software {version}), the scenario's [ur] asks for \
                 {:?}: is it the right arm?",
                config.host,
                series(version),
                wanted.name()
            );
            Err(ArmError::new(fault::WRONG_ARM, detail))
        }
        _ => Ok(()),
    }
}

/// Whether this controller has the registers of the transport.
pub(super) fn check_registers(
    config: &UrConfig,
    version: ControllerVersion,
) -> Result<(), ArmError> {
    let enough = if version.major <= CB3_MAJOR {
        (version.major, version.minor) >= (CB3_MAJOR, 9)
    } else {
        (version.major, version.minor) >= (5, 3)
    };
    if enough || !config.registers.is_upper() {
        return Ok(());
    }
    let detail = format!(
        "controller {version} has no registers 24 to 47: update it to 3.9 (CB3) or 5.3 \
         (e-Series), or use register base 0 if no fieldbus is in use"
    );
    Err(ArmError::new(fault::CONTROLLER_TOO_OLD, detail))
}

/// The controller's own rate [Hz].
pub(super) fn controller_rate(config: &UrConfig, version: ControllerVersion) -> f64 {
    let by_series = if version.major <= CB3_MAJOR {
        125.0
    } else {
        500.0
    };
    config.controller_rate_hz.unwrap_or(by_series)
}

/// How many of the controller's cycles go by per reference, a whole number.
pub(super) fn cycles_per_reference(
    config: &UrConfig,
    version: ControllerVersion,
    rate_hz: f64,
) -> Result<f64, ArmError> {
    let controller = controller_rate(config, version);
    let every = (controller / rate_hz).round();
    let exact = (controller / rate_hz - every).abs() <= 1e-9 * every;
    if rate_hz >= 1.0 && every >= 1.0 && every.is_finite() && exact {
        return Ok(every);
    }
    let possible: Vec<_> = (1..=5)
        .map(|every| format!("{:.6}", controller / f64::from(every)))
        .map(|rate| rate.trim_end_matches('0').trim_end_matches('.').to_owned())
        .collect();
    let detail = format!(
        "{rate_hz} Hz is not possible: this controller runs at {controller} Hz and takes \
         references at a whole fraction of it, {}, ... Hz, down to 1 Hz",
        possible.join(", ")
    );
    Err(ArmError::new(fault::RATE_NOT_POSSIBLE, detail))
}

/// What to ask for so that a package comes in every `every`-th cycle [Hz].
pub(super) fn output_frequency(controller_rate: f64, every: f64) -> f64 {
    // A controller sends in every floor(rate / frequency)-th cycle: a hair less than the frequency
    // keeps rounding from making that one cycle too few.
    (controller_rate / every * (1.0 - 1e-9)).max(1.0)
}

/// Why a run cannot start now: the arm may not move, a program has it, or the last one left it
/// latched.
pub(super) fn hindrance_of_run(status: &Status, acknowledged: Option<i32>) -> Option<ArmError> {
    hindrance(status).or_else(|| rearm::latched(status, acknowledged))
}

/// Why nothing can be done with the arm now: it may not move, or a program has it.
pub(super) fn hindrance(status: &Status) -> Option<ArmError> {
    fault::of_arm(status).or_else(|| {
        let detail = if status.runtime_state == runtime_state::PAUSED {
            "a program is paused on the controller, and this one would end it: stop it at the \
             pendant first"
        } else {
            "a program runs on the controller: stop it at the pendant first"
        };
        (status.runtime_state != runtime_state::STOPPED)
            .then(|| ArmError::new(fault::OTHER_PROGRAM, detail))
    })
}

/// The servo program for references at `rate_hz`.
pub(super) fn program(config: &UrConfig, rate_hz: f64) -> Result<ServoProgram, ArmError> {
    let cycle_s = 1.0 / rate_hz;
    let most = MOST_EXTRAPOLATED * cycle_s;
    if !(0.0..=most).contains(&config.extrapolate_s) {
        let detail = format!(
            "references can be bridged for 0 to {most} s at {rate_hz} Hz, not for {} s",
            config.extrapolate_s
        );
        return Err(ArmError::new(fault::BAD_SETTING, detail));
    }
    let cycles = (config.extrapolate_s * rate_hz).floor().max(1.0);
    Ok(ServoProgram {
        // The controller's last one decides it.
        session: 0,
        cycle_s,
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 1 to 1000, above.
        extrapolated_cycles: cycles as u32,
        stop_deceleration: config.stop_deceleration,
        // The program itself stops after one cycle more than it bridges; the watchdog is the last
        // resort behind it and must not come first.
        watchdog_hz: 1.0 / (2.0 * (cycles + 1.0) * cycle_s),
        patience_s: config.first_reference_within_s,
        registers: config.registers,
        payload_kg: config.payload_kg,
        tcp: config.tcp,
    })
}

/// A number that the controller's last session did not have.
pub(super) fn session_number(last: i32) -> i32 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    registers::session_number(last, since.map_or(0, |since| since.subsec_micros()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn version(major: u32, minor: u32) -> ControllerVersion {
        ControllerVersion {
            major,
            minor,
            bugfix: 0,
            build: 0,
        }
    }

    #[test]
    fn only_whole_fractions_of_the_controllers_rate_are_possible() {
        let config = UrConfig::new("arm");
        for (major, rate_hz, every) in [
            (3, 125.0, Some(1.0)),
            (3, 62.5, Some(2.0)),
            (3, 125.0 / 3.0, Some(3.0)),
            (3, 500.0, None),
            (3, 100.0, None),
            (5, 500.0, Some(1.0)),
            (5, 125.0, Some(4.0)),
            (5, 1.0, Some(500.0)),
            (5, 400.0, None),
            (5, 0.5, None),
            (5, 0.0, None),
            (5, -125.0, None),
            (5, f64::NAN, None),
            (5, f64::INFINITY, None),
        ] {
            let cycles = cycles_per_reference(&config, version(major, 10), rate_hz);
            assert_eq!(cycles.ok(), every, "{rate_hz} Hz on major version {major}");
        }
        let fault = cycles_per_reference(&config, version(3, 15), 500.0).unwrap_err();
        assert!(fault.detail.contains("125, 62.5, 41.666667"), "{fault}");
    }

    #[test]
    fn upper_registers_need_new_enough_software() {
        let config = UrConfig::new("arm");
        for (major, minor, enough) in [
            (3, 8, false),
            (3, 9, true),
            (5, 2, false),
            (5, 3, true),
            (10, 0, true),
        ] {
            let checked = check_registers(&config, version(major, minor));
            assert_eq!(checked.is_ok(), enough, "{major}.{minor}");
        }
    }

    #[test]
    fn the_program_bridges_40_ms_and_the_watchdog_comes_second() {
        for (rate_hz, cycles) in [(125.0, 5), (500.0, 20), (10.0, 1)] {
            let program = program(&UrConfig::new("arm"), rate_hz).unwrap();
            assert_eq!(program.extrapolated_cycles, cycles);
            let stops_itself_after = f64::from(cycles + 1) / rate_hz;
            assert!(1.0 / program.watchdog_hz > stops_itself_after);
            program.check().unwrap();
        }
    }
}
