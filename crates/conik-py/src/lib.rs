//! The Python package `conik`: what of it is compiled. What people read is in `python/conik`.
//!
//! Arrays are numpy's, of 64-bit floats. Errors are exceptions with the texts that the command has. The
//! interpreter is let go while a run goes on.

// The functions that Python calls are documented there, in `_conik.pyi`.
#![allow(missing_docs)]
// What PyO3 hands over comes by value.
#![allow(clippy::needless_pass_by_value)]

mod campaign;
mod controller;
mod failure;
mod kinematics;
mod numbers;
mod own_task;
mod robot;
mod run;
mod scenario;
mod setpoints;
mod step;

use pyo3::prelude::*;

#[pymodule]
mod _conik {
    #[pymodule_export]
    use super::campaign::{
        campaign_finish, campaign_keep, campaign_missing, campaign_plan, campaign_runs,
        campaign_shard, campaign_work,
    };
    #[pymodule_export]
    use super::controller::Controller;
    #[pymodule_export]
    use super::failure::{ConikError, ScenarioError, StepError};
    #[pymodule_export]
    use super::kinematics::Kinematics;
    #[pymodule_export]
    use super::robot::Robot;
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::scenario::check;
    #[pymodule_export]
    use super::step::Step;
}
