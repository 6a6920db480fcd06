//! `conik plot`: the figures of a run, drawn again from its log.

use std::process::ExitCode;

use conik_cli::{figure, report};

use crate::arguments::PlotArguments;
use crate::failure::Failure;

/// Draws every figure and the report.
pub fn plot(arguments: &PlotArguments) -> Result<ExitCode, Failure> {
    let mut written = figure::write_all(&arguments.dir).map_err(Failure::input)?;
    written.push(report::write(&arguments.dir).map_err(Failure::input)?);
    if arguments.quiet {
        return Ok(ExitCode::SUCCESS);
    }
    let lines: String = written
        .iter()
        .map(|path| format!("{}\n", path.display()))
        .collect();
    super::print(&lines)
}
