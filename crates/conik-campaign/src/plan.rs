//! What a campaign is: a scenario, a seed, and what varies.

use conik_sim::scenario::Scenario;
use serde::{Deserialize, Serialize};

/// The format of [`Plan`] and of everything that is kept of it.
pub const FORMAT: u32 = 1;

/// A campaign. Two with the same plan have the same rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// [`FORMAT`].
    pub format: u32,
    /// Version of the program: another one may compute other rows.
    pub version: String,
    /// The scenario, with everything that was overridden.
    pub scenario: Scenario,
    /// How many runs there are.
    pub runs: u64,
    /// Of all random numbers.
    pub seed: u64,
    /// What they vary.
    pub varied: Varied,
}

/// What differs from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Varied {
    /// Where the arm starts.
    pub starts: Starts,
    /// Points that are kept away from or looked at, and obstacles, are shifted by up to this [m].
    pub obstacles_m: f64,
    /// Targets and waypoints are shifted by up to this [m].
    pub targets_m: f64,
    /// The control rate is one of these [Hz]; the scenario's, if there is none.
    pub rates_hz: Vec<f64>,
    /// The arm lags behind its reference by a time between these [s]; without it, it is at its reference.
    pub servo_lag_s: Option<[f64; 2]>,
}

/// Where runs start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Starts {
    /// At the scenario's start.
    Same,
    /// Anywhere: each joint anywhere between its limits, at most half a turn from zero.
    Anywhere,
    /// Each joint up to so far from the scenario's start [rad or m].
    Near(f64),
}

impl Default for Varied {
    fn default() -> Self {
        Self {
            starts: Starts::Anywhere,
            obstacles_m: 0.0,
            targets_m: 0.0,
            rates_hz: Vec::new(),
            servo_lag_s: None,
        }
    }
}

/// A plan that makes no sense.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A number that is none, or out of its range.
    #[error("{what} is {value}; it must be {range}")]
    BadNumber {
        /// Which.
        what: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// There is nothing to run.
    #[error("no runs are asked for; ask for one at least")]
    NoRuns,
    /// Every run would be the same.
    #[error(
        "nothing varies, so that all runs would be the same; let something vary, or ask for one run"
    )]
    NothingVaries,
}

impl Plan {
    /// A plan for this version of the program.
    ///
    /// # Errors
    ///
    /// What makes no sense in it.
    pub fn new(
        scenario: Scenario,
        runs: u64,
        seed: u64,
        varied: Varied,
    ) -> Result<Self, PlanError> {
        let plan = Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scenario,
            runs,
            seed,
            varied,
        };
        plan.check()?;
        Ok(plan)
    }

    fn check(&self) -> Result<(), PlanError> {
        let Varied {
            starts,
            obstacles_m,
            targets_m,
            rates_hz,
            servo_lag_s,
        } = &self.varied;
        let near = match starts {
            Starts::Near(near) => *near,
            Starts::Same | Starts::Anywhere => 0.0,
        };
        for (what, value, most, range) in [
            ("the spread of the starts [rad]", near, 10.0, "from 0 to 10"),
            (
                "the shift of obstacles [m]",
                *obstacles_m,
                10.0,
                "from 0 to 10",
            ),
            ("the shift of targets [m]", *targets_m, 10.0, "from 0 to 10"),
        ] {
            if !(0.0..=most).contains(&value) {
                return Err(PlanError::BadNumber { what, value, range });
            }
        }
        for &value in rates_hz {
            let (what, range) = ("a rate [Hz]", "from 1 to 10000");
            if !(1.0..=10_000.0).contains(&value) {
                return Err(PlanError::BadNumber { what, value, range });
            }
        }
        for value in servo_lag_s.iter().flatten().copied() {
            let (what, range) = ("a servo lag [s]", "from 0.001 to 1, the lesser first");
            let [least, most] = servo_lag_s.unwrap_or_default();
            if !((0.001..=1.0).contains(&value) && least <= most) {
                return Err(PlanError::BadNumber { what, value, range });
            }
        }
        if self.runs == 0 {
            return Err(PlanError::NoRuns);
        }
        let same = Varied {
            starts: Starts::Same,
            ..Varied::default()
        };
        if self.varied == same && self.runs > 1 {
            return Err(PlanError::NothingVaries);
        }
        Ok(())
    }
}
