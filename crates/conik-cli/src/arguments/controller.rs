//! Controllers of arms, real and emulated: `conik emulate`, `conik preflight` and `conik recover`.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, ValueEnum, ValueHint};

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
