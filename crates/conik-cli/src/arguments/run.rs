//! Running scenarios: `conik run` and `conik view`.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ValueHint};

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
