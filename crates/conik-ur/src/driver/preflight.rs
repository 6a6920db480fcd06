//! Looks at a controller and the way to it without moving anything: no register is claimed, no
//! program sent.

use super::config::UrConfig;
use super::connect::connect;
use super::identity::Identity;
use super::{fault, plan};
use crate::session::{Session, SessionError};
use crate::status::Status;
use crate::timing::{Arrival, Timing};
use crate::wire::ControllerVersion;
use conik_sim::arm::ArmError;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Preflight {
    /// The controller's software.
    pub version: ControllerVersion,
    /// `CB3` or `e-Series`.
    pub series: &'static str,
    /// What the dashboard says of the arm; or why it says nothing.
    pub identity: Result<Identity, ArmError>,
    /// Rate at which packages were asked for [Hz].
    pub rate_hz: f64,
    /// Cycles that the servo program bridges at this rate.
    pub bridged_cycles: u32,
    /// Where the joints stand [rad].
    pub q: [f64; crate::registers::JOINTS],
    /// Why a run would not start at present.
    pub hindrance: Option<ArmError>,
    /// When packages came.
    pub timing: Timing,
}

/// Reads packages for `seconds`, or until `stop` is set. Without a rate, the controller's own.
pub fn preflight(
    config: &UrConfig,
    rate_hz: Option<f64>,
    seconds: f64,
    stop: &AtomicBool,
) -> Result<Preflight, ArmError> {
    let of_session = |error: SessionError| fault::of_session(&error);
    let stream = connect(config, config.rtde_port)?;
    let mut session = Session::greet_within(stream, config.link_timeout).map_err(of_session)?;
    let version = session.version();
    plan::check_series(config, version)?;
    plan::check_registers(config, version)?;
    let controller_rate = plan::controller_rate(config, version);
    let rate_hz = rate_hz.unwrap_or(controller_rate);
    let every = plan::cycles_per_reference(config, version, rate_hz)?;
    let program = plan::program(config, rate_hz)?;
    program
        .check()
        .map_err(|error| ArmError::new(fault::BAD_SETTING, error.to_string()))?;
    let identity = Identity::ask(config);
    session
        .subscribe(
            plan::output_frequency(controller_rate, every),
            &Status::fields(config.registers),
        )
        .and_then(|()| session.start())
        .map_err(of_session)?;

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates.
    let mut arrivals = Vec::with_capacity(((seconds * rate_hz) as usize).min(1 << 20) + 1);
    let began = Instant::now();
    let mut status;
    loop {
        let latest = session.latest().map_err(of_session)?;
        let came = began.elapsed();
        status = Status::from_values(&latest.values)
            .ok_or_else(|| of_session(SessionError::OutOfOrder("the agreed output fields")))?;
        arrivals.push(Arrival {
            timestamp: status.timestamp,
            came,
            passed_over: latest.passed_over,
        });
        let enough = came.as_secs_f64() >= seconds || stop.load(Ordering::Relaxed);
        if enough && arrivals.len() > 2 {
            break;
        }
    }
    let timing = Timing::of(&arrivals, 1.0 / rate_hz)
        .ok_or_else(|| ArmError::new(fault::LINK_LOST, "too few packages came to say anything"))?;
    Ok(Preflight {
        version,
        series: plan::series(version),
        rate_hz,
        bridged_cycles: program.extrapolated_cycles,
        q: status.actual_q,
        hindrance: identity
            .as_ref()
            .ok()
            .and_then(|identity| identity.check(config).err())
            .or_else(|| plan::hindrance_of_run(&status, None)),
        identity,
        timing,
    })
}

/// What a [`Preflight`] amounts to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every package came in time.
    Fit,
    /// Some came too late, but a run would go on.
    Doubtful,
    /// A run at this rate would end with `references-late`.
    Unfit,
}

impl Preflight {
    /// Whether this computer and the link to the controller will do.
    pub fn verdict(&self) -> Verdict {
        let period_us = 1e6 / self.rate_hz;
        let timing = &self.timing;
        let bridged_us = period_us * f64::from(self.bridged_cycles);
        if timing.lateness_us.max >= bridged_us {
            Verdict::Unfit
        } else if timing.missed > 0
            || timing.repeated > 0
            || timing.lateness_us.p999 > 0.5 * period_us
        {
            Verdict::Doubtful
        } else {
            Verdict::Fit
        }
    }
}
