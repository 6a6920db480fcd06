//! What becomes of a run that was recorded: `conik plot` and `conik export`.

use std::path::PathBuf;

use clap::{Args, ValueEnum, ValueHint};

/// What `conik plot` writes, for its help.
const PLOT_HELP: &str = "\
Writes, besides report.html, each of these as .svg and .png:
  path      the tool's path among obstacles and waypoints
  mode      the mode over time
  sets      each set over time, with its limits
  errors    errors of the equality tasks
  joints    positions and velocities of the joints
  figure4   path, mode, sets and errors in one
  arm       the arm at a few times in one picture, with cones of view
  figure5   the arm at a few times, a picture for each, with the frames of base and tool
  cycles    times of the cycles of an arm with a clock of its own";

/// `conik plot`
#[derive(Debug, Args)]
#[command(after_help = PLOT_HELP)]
pub struct PlotArguments {
    /// A folder that `conik run` wrote
    #[arg(value_hint = ValueHint::DirPath)]
    pub dir: PathBuf,
    /// Show the arm at these times of the run, at most 12 [default: where it looks most different]
    #[arg(
        long,
        value_name = "SECONDS,...",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    pub at: Vec<f64>,
    /// Write figures in this format only; may be given more than once [default: both]
    #[arg(long, value_enum, value_delimiter = ',')]
    pub format: Vec<FormatArgument>,
    /// Pixels of a PNG for each of the SVG, 0.1 to 20
    #[arg(long, value_name = "FACTOR", default_value_t = 2.0, value_parser = scale)]
    pub scale: f64,
    /// Width of every PNG in pixels, in place of --scale
    #[arg(
        long,
        value_name = "PIXELS",
        conflicts_with = "scale",
        value_parser = clap::value_parser!(u32).range(16..=20_000)
    )]
    pub width_px: Option<u32>,
    /// Do not print the names of the files written
    #[arg(long, short)]
    pub quiet: bool,
}

/// Formats of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatArgument {
    /// Lines and letters, for print and to be edited
    Svg,
    /// Pixels, for slides and where SVG is not shown
    Png,
}

fn scale(text: &str) -> Result<f64, String> {
    let scale: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (0.1..=20.0).contains(&scale) {
        Ok(scale)
    } else {
        Err("give a factor from 0.1 to 20".to_owned())
    }
}

/// What `conik export` writes, for its help.
const EXPORT_HELP: &str = "\
Formats:
  mcap     messages for Foxglove and other programs that read MCAP: frames, joints, the scene, tasks
  parquet  the log as one table, for pandas, Polars, DuckDB and the like

Exit status: 0 done; 2 bad usage or bad input, or a file cannot be written; 130 stopped with Ctrl-C.";

/// `conik export`
#[derive(Debug, Args)]
#[command(after_help = EXPORT_HELP)]
pub struct ExportArguments {
    /// A folder that `conik run` wrote
    #[arg(value_hint = ValueHint::DirPath)]
    pub dir: PathBuf,
    /// Which format; may be given more than once [default: what the name after --out ends in, else both]
    #[arg(long, value_enum, value_name = "FORMAT", hide_possible_values = true)]
    pub format: Vec<ExportFormat>,
    /// The file to write; `-` writes to standard output [default: the name of the folder, in it]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
    /// No progress line, and no names of the files written
    #[arg(long, short)]
    pub quiet: bool,
}

/// `--format`
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum ExportFormat {
    /// Messages, for Foxglove and its like.
    Mcap,
    /// A table.
    Parquet,
}

impl ExportFormat {
    /// Every format.
    pub const ALL: [Self; 2] = [Self::Mcap, Self::Parquet];

    /// What its files' names end in.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Mcap => "mcap",
            Self::Parquet => "parquet",
        }
    }
}
