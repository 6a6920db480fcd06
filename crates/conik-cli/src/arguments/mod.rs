//! The command line.

mod campaign;
mod controller;
mod pictures;
mod run;

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueHint};
use clap_complete::Shell;

pub use campaign::{CampaignArguments, VariedArguments};
pub use controller::{EmulateArguments, PreflightArguments, RecoverArguments, SeriesArgument};
pub use pictures::{ExportArguments, ExportFormat, FormatArgument, PlotArguments};
pub use run::{Overrides, RunArguments, ViewArguments};

/// Set-based task-priority control of robot arms.
///
/// A scenario is a page of TOML: a robot, a start, and tasks in decreasing priority. `conik run`
/// drives an arm through it and shows what became of every task. Start with `conik init`.
#[derive(Debug, Parser)]
#[command(name = "conik", version, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scenario on an arm and write log.csv, summary.json and report.html
    Run(RunArguments),
    /// Validate a scenario; print its robot, hierarchy and modes, and what is doubtful
    Check(CheckArguments),
    /// Draw the figures of a run again from its log
    Plot(PlotArguments),
    /// Run a scenario many times, from random starts, and say how often each property was kept and why not
    Campaign(CampaignArguments),
    /// Write a run in the formats of other programs: MCAP for Foxglove, Parquet for tables
    Export(ExportArguments),
    /// Watch and change a scenario while it runs, or replay one or two runs, in a browser, until Ctrl-C
    View(ViewArguments),
    /// Emulate a Universal Robots controller on its real ports, until Ctrl-C
    Emulate(EmulateArguments),
    /// Measure this computer and the link to a controller, before anything moves
    Preflight(PreflightArguments),
    /// Bring a stopped arm back to where a run may start, without moving it
    Recover(RecoverArguments),
    /// Write a commented scenario to start from
    Init(InitArguments),
    /// List the built-in robots, or the joints, limits and frames of one
    Robots(RobotsArguments),
    /// Print the JSON Schema of the scenario file
    Schema,
    /// Print a completion script for a shell
    Completions {
        /// The shell.
        shell: Shell,
    },
}

/// `conik check`
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The scenario file
    #[arg(value_hint = ValueHint::FilePath)]
    pub scenario: PathBuf,
}

/// `conik init`
#[derive(Debug, Args)]
pub struct InitArguments {
    /// The file to write; `-` prints it
    #[arg(default_value = "scenario.toml", value_hint = ValueHint::FilePath)]
    pub path: PathBuf,
    /// Replace the file if it is there
    #[arg(long)]
    pub force: bool,
}

/// `conik robots`
#[derive(Debug, Args)]
pub struct RobotsArguments {
    /// The robot to describe [default: a line for each robot]
    #[arg(value_parser = PossibleValuesParser::new(conik::Robot::builtin_names()))]
    pub name: Option<String>,
}
