//! The driver: a UR arm, real or emulated, as the run loop sees it.
//!
//! | file | what it holds |
//! |---|---|
//! | `config` | where the controller is and how it is to be driven |
//! | `connect` | TCP connections with time-outs |
//! | `dashboard`, `identity` | which arm it is, and whether it takes programs from afar |
//! | `rearm` | the latch that the controller holds after a run that did not end in order |
//! | `recover` | from a stop back to where a run may start |
//! | `link` | one connection, from the handshake to the stop |
//! | `pace`, `rate` | what is late, what is no clock, and whether it keeps the rate |
//! | `plan` | what is settled before: rate, registers, program |
//! | `preflight` | a look at controller and link before anything moves |
//! | `guard` | the last check of a reference before it goes out |
//! | `fault` | the names of all faults |

pub mod config;
mod connect;
mod dashboard;
pub mod fault;
mod guard;
pub mod identity;
mod link;
mod pace;
mod plan;
pub mod preflight;
mod rate;
mod rearm;
pub mod recover;

pub use config::UrConfig;

use crate::servoj::{BadServoj, Servoj};
use crate::status::Status;
use conik::JointVec;
use conik_sim::arm::{Arm, ArmError, Feedback, Reference};
use conik_sim::cycle_times::CycleTimes;
use link::Link;
use std::fmt;

/// A UR arm that follows references.
///
/// A fault is latched: from then on nothing but a stop goes to the arm, and every call reports the
/// same fault. It takes `stop`, [`rearm`](Self::rearm) and `start`, in this order, to move again, and
/// then only from the pose where the arm stands. Dropping a started arm stops it.
///
/// The controller holds a latch of its own, which outlives this program: after a run that did not end
/// in order, `start` of another `UrArm` refuses with [`NOT_REARMED`](fault::NOT_REARMED) until
/// [`recover`](recover::recover) has cleared it.
#[derive(Debug)]
pub struct UrArm {
    config: UrConfig,
    link: Option<Link>,
    fault: Option<ArmError>,
    warned: Listener,
    /// Those of the link, once it is closed.
    times: Option<CycleTimes>,
    /// The session that ran last.
    session: Option<i32>,
    /// The session after which it was armed anew.
    acknowledged: Option<i32>,
}

/// Takes in what is said.
type Hears = dyn FnMut(&str) + Send;

/// Who hears what is no fault but should be known.
#[derive(Default)]
struct Listener(Option<Box<Hears>>);

impl Listener {
    fn say(&mut self, words: &str) {
        if let Some(listener) = &mut self.0 {
            listener(words);
        }
    }
}

impl fmt::Debug for Listener {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Listener({})", self.0.is_some())
    }
}

impl UrArm {
    /// An arm that is not connected yet.
    pub fn new(config: UrConfig) -> Self {
        Self {
            config,
            link: None,
            fault: None,
            warned: Listener::default(),
            times: None,
            session: None,
            acknowledged: None,
        }
    }

    /// Has `listener` hear what a start could not check or had to wait for. It is called within
    /// `start` only, before anything moves.
    #[must_use]
    pub fn warning(mut self, listener: impl FnMut(&str) + Send + 'static) -> Self {
        self.warned = Listener(Some(Box::new(listener)));
        self
    }

    /// What the controller last said of itself, while connected.
    pub fn status(&self) -> Option<&Status> {
        self.link.as_ref().map(Link::status)
    }

    /// The fault that is latched.
    pub fn fault(&self) -> Option<&ArmError> {
        self.fault.as_ref()
    }

    /// Clears a latched fault, so that a stopped arm may be started again. Nothing is sent.
    pub fn rearm(&mut self) -> Result<(), ArmError> {
        if self.link.is_some() {
            let detail = "the arm is not stopped: stop it before it is armed again";
            return Err(self
                .fault
                .clone()
                .unwrap_or_else(|| ArmError::new(fault::ALREADY_STARTED, detail)));
        }
        self.fault = None;
        self.acknowledged = self.session;
        Ok(())
    }

    /// Changes how `servoj` follows, from the next reference on. What it does not take is refused,
    /// and what held before holds on.
    pub fn set_servoj(&mut self, servoj: Servoj) -> Result<(), BadServoj> {
        servoj.check()?;
        self.config.servoj = servoj;
        if let Some(link) = &mut self.link {
            link.set_servoj(servoj);
        }
        Ok(())
    }

    /// Runs `action` on the link unless a fault is latched, and latches the fault that it meets.
    fn unless_faulty<T>(
        &mut self,
        action: impl FnOnce(&mut Link) -> Result<T, ArmError>,
    ) -> Result<T, ArmError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        let Some(link) = &mut self.link else {
            let detail = "the arm is not started, or was stopped: call start first";
            return Err(ArmError::new(fault::NOT_STARTED, detail));
        };
        action(link).inspect_err(|fault| self.fault = Some(fault.clone()))
    }
}

impl Arm for UrArm {
    fn start(&mut self, rate_hz: f64) -> Result<JointVec, ArmError> {
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        if self.link.is_some() {
            let detail = "the arm is already started: stop it before it is started again";
            return Err(ArmError::new(fault::ALREADY_STARTED, detail));
        }
        let acknowledged = self.acknowledged;
        let link = Link::open(&self.config, rate_hz, acknowledged, &mut |words| {
            self.warned.say(words);
        })?;
        self.session = Some(link.session());
        let q = link.status().target_q;
        self.link = Some(link);
        Ok(q.into())
    }

    fn next_cycle(&mut self) -> Result<Feedback, ArmError> {
        self.unless_faulty(Link::next_cycle)
    }

    fn send(&mut self, reference: &Reference) -> Result<(), ArmError> {
        self.unless_faulty(|link| link.send(reference))
    }

    fn stop(&mut self) -> Result<(), ArmError> {
        match self.link.take() {
            Some(mut link) => {
                self.times = Some(link.take_times());
                link.stop(self.fault.as_ref())
            }
            None => Ok(()),
        }
    }

    fn describe(&self) -> String {
        let UrConfig {
            name,
            host,
            rtde_port,
            ..
        } = &self.config;
        let name = match (name, &self.link) {
            (Some(name), _) => name.clone(),
            (None, Some(link)) => link.series_name(),
            (None, None) => "UR arm".to_owned(),
        };
        let dry = if self.config.dry_run {
            " (dry run: nothing is sent)"
        } else {
            ""
        };
        format!("{name} at {host}:{rtde_port}{dry}")
    }

    fn is_real_time(&self) -> bool {
        self.config.real_time
    }

    fn cycle_times(&self) -> Option<&CycleTimes> {
        let times = match &self.link {
            Some(link) => Some(link.times()),
            None => self.times.as_ref(),
        };
        times.filter(|_| self.config.real_time)
    }
}

impl Drop for UrArm {
    fn drop(&mut self) {
        // Nobody is left to hear of a stop that was not confirmed; the servo program ends by itself.
        let _ = self.stop();
    }
}
