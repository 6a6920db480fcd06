//! A run that goes on, as pages and other programs see and steer it: the protocol of `docs/page.md`, "Live".
//!
//! Records come in from whoever drives the arm ([`Live::take`]) and go out to every client in bundles; what
//! clients ask goes to the [`Helm`](conik_sim::live::Helm) of the run. No client is ever waited for.

mod allowed;
mod client;
mod history;
mod message;
mod session;
mod steer;
mod step_times;

pub(super) use client::attend;
pub use session::{Arm, Live};
