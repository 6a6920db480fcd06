//! `conik plot`: the figures of a run, drawn again from its log.

use std::process::ExitCode;

use conik_cli::figure::{Resolution, Wanted};
use conik_cli::{figure, report};

use crate::arguments::{FormatArgument, PlotArguments};
use crate::failure::{Failure, with_causes};

/// Draws every figure and the report.
pub fn plot(arguments: &PlotArguments) -> Result<ExitCode, Failure> {
    let wanted = wanted(arguments);
    let mut written = figure::write_all(&arguments.dir, &wanted)
        .map_err(|error| Failure::input(with_causes(&error)))?;
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

fn wanted(arguments: &PlotArguments) -> Wanted {
    let is_wanted = |format| arguments.format.is_empty() || arguments.format.contains(&format);
    let resolution = match arguments.width_px {
        Some(width) => Resolution::Width(width),
        None => Resolution::Scale(arguments.scale),
    };
    Wanted {
        svg: is_wanted(FormatArgument::Svg),
        png: is_wanted(FormatArgument::Png).then_some(resolution),
        at_s: arguments.at.clone(),
    }
}
