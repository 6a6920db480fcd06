//! `conik campaign`.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::run::Overrides;

const CAMPAIGN_HELP: &str = "\
Writes runs.parquet (a row a run), report.html, and the worst runs of each class of failures as
scenarios, in worst/. The same plan gives the same bytes whatever the number of jobs and machines.
Begun again, it goes on where it was stopped.

Exit status: 0 done, and every failure is explained; 1 some are not, or a run ended in a fault;
2 bad usage or bad input, or a file cannot be written; 130 stopped with Ctrl-C.";

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
