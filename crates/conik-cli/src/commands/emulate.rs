//! `conik emulate`: a Universal Robots controller for other programs to drive.

use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use conik::JointVec;
use conik_sim::scenario::{Scenario, UrModel, UrSeries};
use conik_ur::emulator::{Emulator, EmulatorConfig, Ports, faults};
use conik_ur::model::ArmFacts;

use crate::arguments::{EmulateArguments, SeriesArgument};
use crate::failure::Failure;

/// Between two looks at the emulator's log.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Where the arm stands if no scenario says otherwise [deg].
const HOME_DEG: [f64; 6] = [0.0, -90.0, -90.0, -90.0, 90.0, 0.0];

/// Emulates until Ctrl-C, printing what the controller has to say.
pub fn emulate(arguments: &EmulateArguments) -> Result<ExitCode, Failure> {
    let q0 = match &arguments.scenario {
        Some(path) => {
            JointVec::from_slice(&Scenario::load(path)?.robot.q0_rad).map_err(Failure::input)?
        }
        None => JointVec::from(HOME_DEG.map(f64::to_radians)),
    };
    let config = EmulatorConfig {
        listen: arguments.listen,
        remote_control: !arguments.local,
        real_time: true,
        ports: Ports::Real {
            offset: arguments.port_offset,
        },
        ..EmulatorConfig::of(arm(arguments)?, q0)
    };
    let faults: Vec<_> = arguments
        .fault
        .iter()
        .map(|line| {
            faults::parse(line)
                .map_err(|error| Failure::input(format!("--fault '{line}': {error}")))
        })
        .collect::<Result<_, _>>()?;
    let stop = super::run::stop_on_ctrl_c()?;
    let emulator = Emulator::start(config).map_err(Failure::input)?;
    for fault in faults {
        emulator.strike(fault);
    }
    super::print(&format!(
        "{} at {} Hz on {}: RTDE {}, programs {}, real-time {}, dashboard {}; Ctrl-C ends it\n\
         The servo is a model (lookahead and gain as a spring and damper), not an identified arm.\n",
        emulator.config().name,
        emulator.config().rate_hz,
        arguments.listen,
        emulator.rtde_port(),
        emulator.script_port(),
        emulator.real_time_port(),
        emulator.dashboard_port(),
    ))?;
    let mut last: Option<String> = None;
    while !stop.load(Ordering::Relaxed) {
        std::thread::sleep(LOOK_EVERY);
        let lines = emulator.log_lines();
        // Old lines fall out of the log, so what is new is what stands after the last one printed.
        let known = lines.iter().rposition(|line| Some(line) == last.as_ref());
        for line in lines.iter().skip(known.map_or(0, |index| index + 1)) {
            super::print(&format!("{line}\n"))?;
        }
        last = lines.last().cloned().or(last);
    }
    Ok(ExitCode::SUCCESS)
}

/// The arm that is asked for.
fn arm(arguments: &EmulateArguments) -> Result<&'static ArmFacts, Failure> {
    let (series, name) = match arguments.series {
        SeriesArgument::Cb3 => (UrSeries::Cb3, "cb3"),
        SeriesArgument::E => (UrSeries::ESeries, "e"),
    };
    UrModel::in_name(&arguments.model)
        .and_then(|model| ArmFacts::of(model, series))
        .ok_or_else(|| {
            let known: Vec<String> = ArmFacts::ALL
                .iter()
                .filter(|arm| arm.series == series)
                .map(|arm| arm.name().to_ascii_lowercase())
                .collect();
            Failure::input(format!(
                "--model {}: no such arm with --series {name}; there are {}",
                arguments.model,
                known.join(", ")
            ))
        })
}
