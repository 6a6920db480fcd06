//! Campaigns: one scenario many times, from random starts, with other obstacles, targets, rates and lags, to say
//! of each of the five properties how often it was kept.
//!
//! ```text
//! Plan (scenario, seed, what varies) --run k--> Case --flown--> Row      shards of rows, in any order, anywhere
//!                                                               \\--> runs.parquet, report.html, worst cases
//! ```
//!
//! Run k of a plan is the same to the bit wherever and whenever it is computed: nothing in a [`Row`] depends on a
//! clock, a machine or the number of workers.

pub mod case;
pub mod class;
pub mod flown;
pub mod folder;
pub mod plan;
mod random;
pub mod report;
pub mod row;
pub mod table;
pub mod tally;
pub mod work;
pub mod worst;
