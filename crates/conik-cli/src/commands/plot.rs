//! `conik plot`: the figures of a run, drawn again from its log.

use std::process::ExitCode;

use conik_cli::{figure, report};

use crate::arguments::PlotArguments;
use crate::failure::{Failure, with_causes};

/// Draws every figure and the report.
pub fn plot(arguments: &PlotArguments) -> Result<ExitCode, Failure> {
    let mut written =
        figure::write_all(&arguments.dir).map_err(|error| Failure::input(with_causes(&error)))?;
    let report = report::write(&arguments.dir);
    written.push(report.map_err(|error| Failure::input(with_causes(&error)))?);
    if arguments.quiet {
        return Ok(ExitCode::SUCCESS);
    }
    let lines: String = written
        .iter()
        .map(|path| format!("{}\n", path.display()))
        .collect();
    super::print(&lines)
}
