//! The command line.

use std::path::PathBuf;

use clap::builder::{NonEmptyStringValueParser, PossibleValuesParser};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;

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

/// `conik run`
///
/// Exit status: 0 done; 1 the run ended in a fault, or a guarantee that the settings promise was
/// broken; 2 bad usage or bad input; 130 stopped with Ctrl-C.
#[derive(Debug, Args)]
#[command(
    after_help = "Exit status: 0 done; 1 the run ended in a fault, or a guarantee that the \
    settings promise was broken; 2 bad usage or bad input; 130 stopped with Ctrl-C."
)]
#[allow(clippy::struct_excessive_bools)] // Each is a switch of its own.
pub struct RunArguments {
    /// The scenario file
    #[arg(value_hint = ValueHint::FilePath)]
    pub scenario: PathBuf,
    /// The arm: `emulator` (a UR controller emulated in this process, over TCP on loopback),
    /// `ideal` (q = q_ref, no network, as fast as possible), `ur` (the `host` of the scenario's
    /// `[ur]`), or the host name of a real controller
    #[arg(
        long,
        value_name = "emulator|ideal|ur|HOST",
        default_value = "emulator",
        value_parser = NonEmptyStringValueParser::new()
    )]
    pub robot: String,
    /// Run the emulator in lockstep, as fast as references are computed, not in wall time
    #[arg(long)]
    pub fast: bool,
    /// Where to write the log, the summary and the report [default: `out/` and the name of the scenario file]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// After the run, say in plain words what was decided at this time of the run, and why; may be
    /// given more than once, and is printed under --quiet too
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub explain: Vec<f64>,
    /// No progress line and no summary; errors are printed all the same
    #[arg(long, short)]
    pub quiet: bool,
    /// Show the run in this terminal while it goes on: tasks, modes and joints. `q` stops it, `?` tells the
    /// other keys; when it has ended, `q` leaves
    #[arg(long, conflicts_with = "view")]
    pub tui: bool,
    /// With `--robot HOST`: begin where the arm stands, whatever start the scenario has: to go on
    /// after a stop
    #[arg(long)]
    pub from_here: bool,
    /// With `--robot HOST`: switch the arm on and release its brakes first, if need be
    #[arg(long, conflicts_with = "dry_run")]
    pub power_on: bool,
    /// With `--robot HOST`: connect, check everything, compute and check every reference in the
    /// controller's own time, but send none: nothing moves
    #[arg(long)]
    pub dry_run: bool,
    /// With `--robot HOST`: added to the controller's ports, as in `conik emulate --port-offset`
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub port_offset: u16,
    /// Who may watch.
    #[command(flatten)]
    pub watch: WatchArguments,
    /// What the file says otherwise.
    #[command(flatten)]
    pub overrides: Overrides,
}

/// Watching a run while it goes on.
#[derive(Debug, Args)]
#[command(next_help_heading = "Watch the run in a browser")]
pub struct WatchArguments {
    /// Serve a page that shows the run while it goes on, and from which simulated arms are paused, slowed
    /// down, stepped and given other tasks. It stays until Ctrl-C
    #[arg(long, conflicts_with = "fast")]
    pub view: bool,
    /// With `--view --robot HOST`: let whoever has the page change what the arm does
    #[arg(long, requires = "view")]
    pub allow_edit: bool,
    /// Port of the page [default: any free one]
    #[arg(
        long,
        value_name = "N",
        requires = "view",
        default_value_t = 0,
        hide_default_value = true
    )]
    pub view_port: u16,
    /// Address of this computer to serve the page on. Any but a loopback address can be reached from the
    /// network: whoever has the address printed, with its token, can watch, and do what the page can
    #[arg(
        long,
        value_name = "ADDRESS",
        requires = "view",
        default_value = "127.0.0.1"
    )]
    pub listen: std::net::IpAddr,
}

/// Settings that override the file.
#[derive(Debug, Args)]
#[command(next_help_heading = "Override the scenario")]
pub struct Overrides {
    /// Which rule chooses the active sets: `paper`, `border` or `cone`
    #[arg(long, value_name = "RULE")]
    pub mode_rule: Option<String>,
    /// What happens at the border of a set between samples: `freeze` or `land`
    #[arg(long, value_name = "BORDER")]
    pub border: Option<String>,
    /// How lower levels are fitted under higher ones: `chiaverini` or `siciliano-slotine`
    #[arg(long, value_name = "RECURSION")]
    pub recursion: Option<String>,
    /// Length of the run [s]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub duration_s: Option<f64>,
    /// Control rate [Hz]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub rate_hz: Option<f64>,
}

/// `conik check`
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The scenario file
    #[arg(value_hint = ValueHint::FilePath)]
    pub scenario: PathBuf,
}

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

const CAMPAIGN_HELP: &str = "\
Writes runs.parquet (a row a run), report.html, and the worst runs of each class of failures as scenarios, in
worst/. The same plan gives the same bytes whatever the number of jobs and machines. Begun again, it goes on where
it was stopped.

Exit status: 0 done, and every failure is explained; 1 some are not, or a run ended in a fault; 2 bad usage or bad
input, or a file cannot be written; 130 stopped with Ctrl-C.";

/// `conik campaign`
#[derive(Debug, Args)]
#[command(after_help = CAMPAIGN_HELP)]
pub struct CampaignArguments {
    /// The scenario file
    #[arg(value_hint = ValueHint::FilePath)]
    pub scenario: PathBuf,
    /// How many runs
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub runs: u64,
    /// Of the random numbers; another one gives other runs
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Runs at a time [default: as many as this computer has cores]
    #[arg(long, value_name = "J")]
    pub jobs: Option<std::num::NonZeroUsize>,
    /// Where to write the results [default: `out/` and the name of the scenario file and `-campaign`]
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Spread the runs over a Ray cluster: `auto`, or the address of its head. Needs Python with the packages
    /// `conik` and `ray`
    #[arg(long, value_name = "ADDRESS", conflicts_with = "jobs")]
    pub ray: Option<String>,
    /// No progress line and no summary; errors are printed all the same
    #[arg(long, short)]
    pub quiet: bool,
    /// What varies from run to run.
    #[command(flatten)]
    pub varied: VariedArguments,
    /// Options that override the scenario.
    #[command(flatten)]
    pub overrides: Overrides,
}

/// What varies from run to run in a campaign.
#[derive(Debug, Args)]
#[command(next_help_heading = "What varies")]
pub struct VariedArguments {
    /// Where runs start: `anywhere` (each joint between its limits, at most half a turn from zero), `same` (at the
    /// scenario's start), or a number: each joint up to so many degrees from it (metres, if it slides, times 57.3)
    #[arg(long, value_name = "WHERE", default_value = "anywhere")]
    pub starts: String,
    /// Shift points that are kept away from, and obstacles, by up to so much [m]
    #[arg(
        long,
        value_name = "METRES",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub obstacles_m: f64,
    /// Shift targets and waypoints by up to so much [m]
    #[arg(
        long,
        value_name = "METRES",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub targets_m: f64,
    /// Control rates of which each run has one [Hz], as `125,250,500` [default: the scenario's]
    #[arg(long, value_name = "HZ", value_delimiter = ',')]
    pub rates_hz: Vec<f64>,
    /// Simulate an arm that lags behind its reference by a time between these [s], as `0.03,0.2`
    #[arg(long, value_name = "LEAST,MOST", value_delimiter = ',', num_args = 1)]
    pub servo_lag_s: Vec<f64>,
}

/// `conik view`
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// A scenario file, to be run with an ideal arm for as long as anybody watches; or a folder that
    /// `conik run` wrote; or two of those, to be compared
    #[arg(
        required = true,
        num_args = 1..=2,
        value_name = "SCENARIO|DIR",
        value_hint = ValueHint::AnyPath
    )]
    pub paths: Vec<PathBuf>,
    /// Port of the page [default: any free one]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Address of this computer to serve the page on. Any but a loopback address can be reached from the
    /// network: whoever has the address printed, with its token, can watch, and do what the page can
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub listen: std::net::IpAddr,
    /// Print the address of the page and nothing else
    #[arg(long, short)]
    pub quiet: bool,
    /// What the scenario file says otherwise.
    #[command(flatten)]
    pub overrides: Overrides,
}

/// What the emulator assumes, for its help.
const EMULATOR_HELP: &str = "\
Assumed, not identified on a real arm:
  servoj        acceleration = gain x (q_ref - q - lookahead x speed), then clipped: to a ramp its
                delay is the lookahead; nobody has published what the gain does
  limits        the arm's published joint speeds; 40 rad/s^2 for every joint
  stops         10 rad/s^2 when nothing commands the arm
  protective    a step of servoj's target above 0.1 rad, or a target that needs more than the
  stop          speed limit, (q_ref - q) / lookahead, for longer than 0.25 s
  speed slider  slows time down
Currents, torques, temperatures, payload and inputs read the same for ever.

Faults, for --fault or as a line `emulator FAULT` at the dashboard (port 29999):
  protective stop, emergency stop, program stop, pause, release, restart clock,
  clock jump SECONDS, drop PROBABILITY, delay SECONDS, jitter SECONDS, freeze SECONDS, reset,
  half-open, register in use NAME, bad packages COUNT, one-byte on, one-byte off";

/// `conik emulate`
#[derive(Debug, Args)]
#[command(after_help = EMULATOR_HELP)]
pub struct EmulateArguments {
    /// Which series of controllers to be: `cb3` (125 Hz) or `e` (500 Hz)
    #[arg(long, value_enum, default_value_t = SeriesArgument::E)]
    pub series: SeriesArgument,
    /// Which arm to be: `ur3`, `ur5`, `ur10`; with `--series e` also `ur16`, `ur20`, `ur30`
    #[arg(long, value_name = "MODEL", default_value = "ur5")]
    pub model: String,
    /// Added to every port
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub port_offset: u16,
    /// Address to listen on. Only this computer can reach the default
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub listen: std::net::IpAddr,
    /// Stand where this scenario starts
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub scenario: Option<PathBuf>,
    /// Be in local control: an e-Series then takes no program from the network
    #[arg(long)]
    pub local: bool,
    /// Start with this fault (see below); may be given several times
    #[arg(long, value_name = "FAULT")]
    pub fault: Vec<String>,
}

/// `conik preflight`
#[derive(Debug, Args)]
#[command(
    after_help = "Nothing is written to the controller. Exit status: 0 fit or doubtful; \
    1 not fit, or the controller cannot be reached; 2 bad usage."
)]
pub struct PreflightArguments {
    /// Host name or address of the controller
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub host: String,
    /// How long to look
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    pub seconds: f64,
    /// At this rate [default: the controller's own]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub rate_hz: Option<f64>,
    /// Added to the controller's ports, as in `conik emulate --port-offset`
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub port_offset: u16,
}

/// `conik recover`
#[derive(Debug, Args)]
#[command(
    after_help = "A protective stop is unlocked after 5 s, and the arm is armed anew after a run that \
    did not end in order (killed, a fault, stopped at the pendant). Emergency stops, safeguard stops \
    and safety faults are named and left to the person beside the arm. The next `conik run` begins \
    where the arm stands: with --from-here, unless that is the scenario's start. Exit status: 0 a run may start; 1 it may not; 2 bad usage."
)]
pub struct RecoverArguments {
    /// Host name or address of the controller
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub host: String,
    /// Switch the arm on and release its brakes, if need be
    #[arg(long)]
    pub power_on: bool,
    /// Added to the controller's ports, as in `conik emulate --port-offset`
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub port_offset: u16,
}

/// Series of controllers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SeriesArgument {
    /// CB3, 125 Hz
    Cb3,
    /// e-Series, 500 Hz
    E,
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
