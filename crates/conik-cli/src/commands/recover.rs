//! `conik recover`: brings a stopped arm back to where a run may start.

use std::process::ExitCode;

use conik_ur::driver::UrConfig;
use conik_ur::driver::recover::recover as take_back;

use crate::arguments::RecoverArguments;
use crate::failure::Failure;

/// Recovers the arm and says so.
pub fn recover(arguments: &RecoverArguments) -> Result<ExitCode, Failure> {
    let mut config = UrConfig::new(&arguments.host);
    config.check_host().map_err(Failure::input)?;
    config
        .offset_ports(arguments.port_offset)
        .map_err(Failure::input)?;
    take_back(&config, arguments.power_on, &mut say).map_err(Failure::run)?;
    super::print(
        "a run may start, from where the arm stands: `conik run` with --from-here, unless that is the \
         scenario's start\n",
    )
}

/// Says a step before it is taken.
pub fn say(step: &str) {
    // Nobody reading is no reason to stop halfway.
    let _ = super::print(&format!("{step}\n"));
}
