//! Brings a stopped arm back to where a run may start. Nothing moves but the brakes, and those only
//! if that is asked for.

use super::config::UrConfig;
use super::dashboard::Dashboard;
use super::{fault, identity, rearm};
use conik_sim::arm::ArmError;
use std::thread;
use std::time::{Duration, Instant};

/// A controller refuses to unlock a protective stop for this long after it.
pub const UNLOCK_AFTER: Duration = Duration::from_secs(5);

/// Between two looks at the controller's mode.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Frees the arm from a protective stop, with `power_on` powers it and releases its brakes, and arms
/// it anew after a run that did not end in order. `say` hears each step before it is taken.
///
/// An emergency stop, a safeguard stop and a safety fault are for the person beside the arm: they
/// are named, not lifted. A controller without a dashboard can only be armed anew.
pub fn recover(
    config: &UrConfig,
    power_on: bool,
    say: &mut dyn FnMut(&str),
) -> Result<(), ArmError> {
    match Dashboard::connect(config) {
        Ok(dashboard) => free(config, dashboard, power_on, say)?,
        Err(fault) if power_on => return Err(fault),
        // Whether there is anything to free, RTDE tells.
        Err(fault) => {
            return match rearm::rearm(config, say) {
                // No controller at all: what the dashboard lacks says it as well.
                Err(other)
                    if [fault::CONNECT_FAILED, fault::LINK_LOST, fault::PROTOCOL]
                        .contains(&other.name) =>
                {
                    Err(fault)
                }
                result => result,
            };
        }
    }
    rearm::rearm(config, say)
}

/// What only the dashboard can do.
fn free(
    config: &UrConfig,
    mut dashboard: Dashboard,
    power_on: bool,
    say: &mut dyn FnMut(&str),
) -> Result<(), ArmError> {
    check_remote_control(&mut dashboard)?;
    let safety = state(&mut dashboard, "safetymode")?;
    match safety.as_str() {
        "NORMAL" | "REDUCED" => {}
        "PROTECTIVE_STOP" => {
            say("waiting 5 s, as the controller asks for after a protective stop");
            thread::sleep(config.unlock_after);
            say("unlocking the protective stop");
            dashboard.order("close safety popup", "closing safety popup")?;
            dashboard.order("unlock protective stop", "Protective stop releasing")?;
            await_state(config, &mut dashboard, "safetymode", &["NORMAL", "REDUCED"])?;
        }
        other => return Err(not_ours_to_lift(other)),
    }
    if state(&mut dashboard, "robotmode")? != "RUNNING" {
        if !power_on {
            let detail = "the arm has no power, or its brakes are on: --power-on switches it on \
                          and releases them, if nobody is in its way";
            return Err(ArmError::new(fault::ROBOT_NOT_RUNNING, detail));
        }
        release_brakes(config, &mut dashboard, say)?;
    }
    // What runs was stopped by the fault, and must not go on by itself: the next run sends its own.
    // A paused program too, or someone may resume it.
    if !dashboard.ask("programState")?.starts_with("STOPPED") {
        say("stopping the program that is left on the controller");
        dashboard.order("stop", "Stopped")?;
    }
    Ok(())
}

/// Powers the arm and releases its brakes, if need be. Any kind of stop is named, not lifted.
pub fn power_on(config: &UrConfig, say: &mut dyn FnMut(&str)) -> Result<(), ArmError> {
    let mut dashboard = Dashboard::connect(config)?;
    check_remote_control(&mut dashboard)?;
    let safety = state(&mut dashboard, "safetymode")?;
    if !["NORMAL", "REDUCED"].contains(&safety.as_str()) {
        return Err(not_ours_to_lift(&safety));
    }
    if state(&mut dashboard, "robotmode")? != "RUNNING" {
        release_brakes(config, &mut dashboard, say)?;
    }
    Ok(())
}

fn release_brakes(
    config: &UrConfig,
    dashboard: &mut Dashboard,
    say: &mut dyn FnMut(&str),
) -> Result<(), ArmError> {
    say("switching the arm on");
    dashboard.order("power on", "Powering on")?;
    await_state(config, dashboard, "robotmode", &["IDLE", "RUNNING"])?;
    say("releasing the brakes");
    dashboard.order("brake release", "Brake releasing")?;
    await_state(config, dashboard, "robotmode", &["RUNNING"])
}

fn check_remote_control(dashboard: &mut Dashboard) -> Result<(), ArmError> {
    match identity::remote_control(dashboard)? {
        Some(false) => Err(identity::local_control()),
        Some(true) | None => Ok(()),
    }
}

/// `NORMAL` of `Safetymode: NORMAL`.
fn state(dashboard: &mut Dashboard, question: &str) -> Result<String, ArmError> {
    let answer = dashboard.ask(question)?;
    match answer.split_once(": ") {
        Some((what, state)) if what.eq_ignore_ascii_case(question) => Ok(state.trim().to_owned()),
        _ => Err(ArmError::new(
            fault::PROTOCOL,
            format!("the dashboard answers '{question}' with: {answer}"),
        )),
    }
}

fn await_state(
    config: &UrConfig,
    dashboard: &mut Dashboard,
    question: &str,
    awaited: &[&str],
) -> Result<(), ArmError> {
    let deadline = Instant::now() + config.recover_timeout;
    loop {
        let state = state(dashboard, question)?;
        if awaited.contains(&state.as_str()) {
            return Ok(());
        }
        if Instant::now() > deadline {
            let detail = format!(
                "{question} is still {state} after {:.0} s; {} was awaited: see the pendant",
                config.recover_timeout.as_secs_f64(),
                awaited.join(" or ")
            );
            return Err(ArmError::new(fault::NOT_RECOVERED, detail));
        }
        thread::sleep(LOOK_EVERY);
    }
}

fn not_ours_to_lift(safety: &str) -> ArmError {
    let (name, detail) = match safety {
        "ROBOT_EMERGENCY_STOP" | "SYSTEM_EMERGENCY_STOP" => (
            fault::EMERGENCY_STOP,
            "an emergency stop is pressed: release it at the arm, then recover with --power-on",
        ),
        "PROTECTIVE_STOP" => (
            fault::PROTECTIVE_STOP,
            "find the cause of the protective stop first, then `conik recover`",
        ),
        "SAFEGUARD_STOP" => (
            fault::SAFEGUARD_STOP,
            "a safeguard stop is active: close the guard and reset it",
        ),
        _ => (
            fault::SAFETY_FAULT,
            "the safety system must be restarted at the pendant, by someone who knows why it \
             stopped the arm",
        ),
    };
    ArmError::new(name, format!("{detail} (safetymode {safety})"))
}
