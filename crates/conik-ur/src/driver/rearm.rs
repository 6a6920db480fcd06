//! The latch that outlives this program: a servo program leaves its phase in a register of the
//! controller, and one that did not end in order keeps the next run from starting.

use super::config::UrConfig;
use super::connect::connect;
use super::{fault, plan};
use crate::registers::{Phase, is_session};
use crate::session::{Session, SessionError};
use crate::status::{Status, runtime_state};
use conik_sim::arm::ArmError;
use std::io::Write;
use std::net::TcpStream;
use std::time::Instant;

/// How often to look at the registers meanwhile [Hz].
const LOOK_HZ: f64 = 25.0;

/// The program that clears the phase; nothing moves.
const TEMPLATE: &str = "def conik_rearm():\n  write_output_integer_register({base}, 0)\nend\n";

/// Why the arm must be armed anew, if it must: the last Conik program on this controller did not end
/// in order. `acknowledged` is a session that has been armed anew already, in this process.
pub(super) fn latched(status: &Status, acknowledged: Option<i32>) -> Option<ArmError> {
    if !is_session(status.session) || acknowledged == Some(status.session) {
        return None;
    }
    let what = match status.phase? {
        Phase::Servoing => {
            "was ended while it moved the arm: by a stop at the pendant or of the controller, or by a \
             protective stop"
        }
        Phase::Starved => "stopped the arm because references stayed away",
        Phase::StoppedByFault => "was told to stop the arm because of a fault",
        Phase::Waiting | Phase::Stopped | Phase::GaveUp => return None,
    };
    let detail = format!(
        "the last Conik program on this controller {what}; see that the arm may move, then `conik \
         recover HOST`"
    );
    Some(ArmError::new(fault::NOT_REARMED, detail))
}

/// Clears the latch in the controller, if it is set, and waits until that is so. The arm must be
/// ready for a run in every other respect.
pub(super) fn rearm(config: &UrConfig, say: &mut dyn FnMut(&str)) -> Result<(), ArmError> {
    let stream = connect(config, config.rtde_port)?;
    let mut session = Session::greet_within(stream, config.link_timeout)
        .map_err(|error| fault::of_session(&error))?;
    plan::check_registers(config, session.version())?;
    session
        .subscribe(LOOK_HZ, &Status::fields(config.registers))
        .and_then(|()| session.start())
        .map_err(|error| fault::of_session(&error))?;
    let mut status = look(&mut session)?;
    let deadline = Instant::now() + config.recover_timeout;
    // A program that was stopped a moment ago may still be on its way out.
    while status.runtime_state == runtime_state::STOPPING && Instant::now() < deadline {
        status = look(&mut session)?;
    }
    if let Some(hindrance) = plan::hindrance(&status) {
        return Err(hindrance);
    }
    if latched(&status, None).is_none() {
        return Ok(());
    }
    say("arming anew: clearing what the last program left in the controller's registers");
    // Kept open until the program has run, as for the servo program.
    let mut script = connect(config, config.script_port)?;
    let text = TEMPLATE.replace("{base}", &config.registers.first().to_string());
    script.write_all(text.as_bytes()).map_err(|error| {
        let detail = format!("the program that clears the registers could not be sent: {error}");
        ArmError::new(fault::LINK_LOST, detail)
    })?;
    let deadline = Instant::now() + config.recover_timeout;
    while latched(&status, None).is_some() || status.runtime_state != runtime_state::STOPPED {
        if Instant::now() > deadline {
            let said = session.last_text().map_or_else(String::new, |message| {
                format!("; the controller said: {}", message.text)
            });
            let detail = format!(
                "the controller did not run the program that clears the latch, sent to port {}: an \
                 e-Series must be in remote control, and no error may stand on the pendant{said}",
                config.script_port
            );
            return Err(ArmError::new(fault::NOT_RECOVERED, detail));
        }
        status = look(&mut session)?;
    }
    Ok(())
}

fn look(session: &mut Session<TcpStream>) -> Result<Status, ArmError> {
    let latest = session
        .latest()
        .map_err(|error| fault::of_session(&error))?;
    Status::from_values(&latest.values)
        .ok_or_else(|| fault::of_session(&SessionError::OutOfOrder("the agreed output fields")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registers::session_number;

    fn left(session: i32, phase: i32) -> Status {
        Status {
            timestamp: 60.0,
            target_q: [0.0; 6],
            actual_q: [0.0; 6],
            actual_qd: [0.0; 6],
            runtime_state: runtime_state::STOPPED,
            robot_mode: 7,
            safety_bits: 1,
            robot_bits: 1,
            speed_scaling: 1.0,
            speed_slider: 1.0,
            phase: Phase::from_number(phase),
            session,
        }
    }

    #[test]
    fn only_a_conik_program_that_did_not_end_in_order_latches() {
        let ours = session_number(0, 4711);
        for (phase, latches) in [
            (0, false),
            (Phase::Waiting as i32, false),
            (Phase::Servoing as i32, true),
            (Phase::Stopped as i32, false),
            (Phase::Starved as i32, true),
            (Phase::GaveUp as i32, false),
            (Phase::StoppedByFault as i32, true),
            (99, false),
        ] {
            let fault = latched(&left(ours, phase), None);
            assert_eq!(fault.is_some(), latches, "phase {phase}");
            assert!(fault.is_none_or(|fault| fault.name == fault::NOT_REARMED));
            // Other programs use the same registers, for small numbers and great ones.
            for other in [0, 1, 2, 255, -1, ours + (1 << 16), i32::MIN] {
                assert_eq!(latched(&left(other, phase), None), None, "{other}");
            }
            assert_eq!(latched(&left(ours, phase), Some(ours)), None);
        }
        let another = session_number(ours, 4711);
        assert!(latched(&left(another, 2), Some(ours)).is_some());
    }
}
