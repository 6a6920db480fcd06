//! The arm that a run drives: an ideal one, an emulated one, or one at a host.

use conik_cli::tui::Warnings;
use conik_sim::arm::{Arm, IdealArm};
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Scenario, UrModel};
use conik_ur::driver::recover::power_on;
use conik_ur::driver::{UrArm, UrConfig};
use conik_ur::emulator::{Emulator, EmulatorConfig, EmulatorError, Pace};

use crate::arguments::RunArguments;
use crate::commands::{recover, ur_robot, warn};
use crate::failure::Failure;

/// An arm, and what must live as long as it.
pub struct Driven {
    pub(crate) arm: Box<dyn Arm + Send>,
    /// Whether it may be one that moves, outside of this program.
    pub(crate) is_outside: bool,
    /// Ends when the arm has let go of it.
    _emulator: Option<Emulator>,
}

/// The arm of these arguments, which stands where the experiment begins if it exists in this program only.
/// With `--tui`, what it warns of is noted in `warnings`.
pub(super) fn arm(
    arguments: &RunArguments,
    scenario: &Scenario,
    experiment: &Experiment,
    warnings: &Warnings,
) -> Result<Driven, Failure> {
    let rate_hz = scenario.control.rate_hz;
    if arguments.robot != "ideal" {
        ur_robot::refuse_others(&arguments.robot, scenario, &experiment.robot)?;
    }
    let (arm, emulator): (Box<dyn Arm + Send>, _) = match arguments.robot.as_str() {
        arm @ ("ideal" | "emulator") if arguments.from_here => {
            return Err(Failure::input(format!(
                "--from-here: the arm of --robot {arm} stands at the scenario's start; it is for \
                 --robot HOST"
            )));
        }
        "ideal" if arguments.dry_run => {
            return Err(Failure::input(
                "--dry-run: there is nothing to send to an ideal arm; it is for --robot HOST",
            ));
        }
        "ideal" => (Box::new(IdealArm::at(experiment.q0)), None),
        "emulator" => {
            let model = experiment.robot.name();
            let emulator = Emulator::start(EmulatorConfig {
                pace: if arguments.fast {
                    Pace::Lockstep
                } else {
                    Pace::WallTime
                },
                ..EmulatorConfig::for_robot(model, rate_hz, experiment.q0)
            })
            .map_err(|error| match error {
                EmulatorError::JointCount(joints) => Failure::input(format!(
                    "the emulator is a UR controller, whose arms have six joints, and {model} has \
                     {joints}: run it with --robot ideal"
                )),
                EmulatorError::BadSetting { .. } => Failure::input(format!(
                    "{error}; another `rate_hz` or --rate-hz, or --robot ideal, would do"
                )),
                error => Failure::input(error),
            })?;
            let mut config = emulator.driver_config();
            if let Some(settings) = &scenario.ur {
                config.apply(settings);
                // It is whatever the scenario needs.
                (config.series, config.model) = (None, None);
            }
            config.dry_run = arguments.dry_run;
            (Box::new(UrArm::new(config)), Some(emulator))
        }
        host => {
            let named = scenario.ur.as_ref().and_then(|ur| ur.host.as_deref());
            let host = if host == "ur" {
                named.ok_or_else(|| {
                    Failure::input(
                        "--robot ur: the scenario's [ur] names no `host`; add it, or give the \
                         host to --robot",
                    )
                })?
            } else {
                host
            };
            if arguments.fast {
                return Err(Failure::input(format!(
                    "--fast: the controller at {host} keeps its own time; --fast is for \
                     --robot emulator"
                )));
            }
            let mut config = UrConfig::new(host);
            if let Some(settings) = &scenario.ur {
                config.apply(settings);
            }
            config.robot = UrModel::in_name(experiment.robot.name());
            config.dry_run = arguments.dry_run;
            config.check_host().map_err(Failure::input)?;
            config
                .offset_ports(arguments.port_offset)
                .map_err(Failure::input)?;
            if arguments.power_on {
                power_on(&config, &mut recover::say).map_err(Failure::run)?;
            }
            let arm = UrArm::new(config);
            let arm = if arguments.tui {
                let warnings = warnings.clone();
                arm.warning(move |text| warnings.note(text))
            } else {
                arm.warning(warn)
            };
            (Box::new(arm), None)
        }
    };
    Ok(Driven {
        arm,
        is_outside: emulator.is_none() && arguments.robot != "ideal",
        _emulator: emulator,
    })
}
