//! The names of all faults of a UR arm, and how the controller's state becomes one.

use crate::registers::Phase;
use crate::session::SessionError;
use crate::status::{ROBOT_MODE_RUNNING, Status, runtime_state, safety_bit};
use conik_sim::arm::ArmError;

/// No connection to the controller.
pub const CONNECT_FAILED: &str = "connect-failed";
/// The controller's software cannot do what is needed.
pub const CONTROLLER_TOO_OLD: &str = "controller-too-old";
/// Another client or a fieldbus holds an input register.
pub const REGISTER_IN_USE: &str = "register-in-use";
/// The other side does not speak RTDE, or not as agreed.
pub const PROTOCOL: &str = "protocol";
/// The controller cannot run at the rate asked for.
pub const RATE_NOT_POSSIBLE: &str = "rate-not-possible";
/// A setting that cannot be used.
pub const BAD_SETTING: &str = "bad-setting";
/// The dashboard says no.
pub const DASHBOARD_REFUSED: &str = "dashboard-refused";
/// An e-Series in local control.
pub const NOT_REMOTE: &str = "not-in-remote-control";
/// The last Conik program on the controller did not end in order.
pub const NOT_REARMED: &str = "not-rearmed";
/// A step of a recovery did not come to its end.
pub const NOT_RECOVERED: &str = "not-recovered";
/// Not the arm that is asked for.
pub const WRONG_ARM: &str = "wrong-arm";
/// Another program runs on the controller.
pub const OTHER_PROGRAM: &str = "other-program-running";
/// The servo program was sent but does not run.
pub const PROGRAM_NOT_STARTED: &str = "program-not-started";
/// `start` was called twice.
pub const ALREADY_STARTED: &str = "already-started";
/// A reference or cycle was asked for before `start`, or after `stop`.
pub const NOT_STARTED: &str = "not-started";
/// Two references in one cycle, or one before the first cycle.
pub const OUT_OF_TURN: &str = "out-of-turn";
/// The first reference is not where the arm is.
pub const FIRST_REFERENCE_AWAY: &str = "first-reference-away";
/// A reference that must not be sent.
pub const REFERENCE_REFUSED: &str = "reference-refused";
/// The connection broke or fell silent.
pub const LINK_LOST: &str = "link-lost";
/// The controller's clock went backwards or leapt ahead.
pub const CLOCK_JUMP: &str = "clock-jump";
/// The controller reported numbers that are not finite.
pub const BAD_FEEDBACK: &str = "bad-feedback";
/// Protective stop.
pub const PROTECTIVE_STOP: &str = "protective-stop";
/// Emergency stop.
pub const EMERGENCY_STOP: &str = "emergency-stop";
/// Safeguard stop.
pub const SAFEGUARD_STOP: &str = "safeguard-stop";
/// Safety violation, safety fault or recovery mode.
pub const SAFETY_FAULT: &str = "safety-fault";
/// The arm is not powered, or its brakes are on.
pub const ROBOT_NOT_RUNNING: &str = "robot-not-running";
/// The speed slider is not at 100 %.
pub const SPEED_SLIDER: &str = "speed-slider";
/// The program is paused.
pub const PAUSED: &str = "paused";
/// The servo program stopped the arm because references stayed away.
pub const REFERENCES_LATE: &str = "references-late";
/// The servo program has ended or was replaced.
pub const PROGRAM_STOPPED: &str = "program-stopped";
/// The stop was asked for but not confirmed.
pub const STOP_UNCONFIRMED: &str = "stop-unconfirmed";

/// Why the arm may not move, whatever the program does: safety first, then power, then the slider.
pub(super) fn of_arm(status: &Status) -> Option<ArmError> {
    use safety_bit as bit;
    if !status.is_finite() {
        return Some(ArmError::new(
            BAD_FEEDBACK,
            "the controller reports numbers that are not finite",
        ));
    }
    let emergency = bit::SYSTEM_EMERGENCY_STOP | bit::ROBOT_EMERGENCY_STOP | bit::EMERGENCY_STOP;
    let safety = [
        (
            emergency,
            EMERGENCY_STOP,
            "an emergency stop is pressed: release it, then restart the arm at the pendant",
        ),
        (
            bit::VIOLATION | bit::FAULT,
            SAFETY_FAULT,
            "the safety system reports a violation or a fault: see the pendant",
        ),
        (
            bit::PROTECTIVE_STOP,
            PROTECTIVE_STOP,
            "the controller made a protective stop: see the pendant for the cause, wait 5 s, unlock",
        ),
        (
            bit::SAFEGUARD_STOP,
            SAFEGUARD_STOP,
            "a safeguard stop is active: close the guard, then reset it",
        ),
        (
            bit::RECOVERY,
            SAFETY_FAULT,
            "the arm is in recovery mode: move it back within its safety limits by hand",
        ),
        (
            bit::STOPPED_DUE_TO_SAFETY,
            SAFETY_FAULT,
            "the arm was stopped by its safety system: see the pendant",
        ),
    ];
    for (bits, name, detail) in safety {
        if status.safety_bits & bits != 0 {
            return Some(ArmError::new(name, detail));
        }
    }
    if status.safety_bits & (bit::NORMAL | bit::REDUCED) == 0 {
        let detail = format!(
            "neither normal nor reduced mode (safety_status_bits {:#b}): see the pendant",
            status.safety_bits
        );
        return Some(ArmError::new(SAFETY_FAULT, detail));
    }
    if status.robot_mode != ROBOT_MODE_RUNNING {
        let detail = format!(
            "robot mode is {}, not {ROBOT_MODE_RUNNING} (running): power on and release the brakes",
            status.robot_mode
        );
        return Some(ArmError::new(ROBOT_NOT_RUNNING, detail));
    }
    if status.speed_slider < 1.0 {
        let detail = format!(
            "the speed slider is at {} %: the arm would fall behind its references; set it to \
             100 % and slow the scenario down instead",
            100.0 * status.speed_slider
        );
        return Some(ArmError::new(SPEED_SLIDER, detail));
    }
    None
}

/// Why references may no longer be sent: the arm, or the servo program of this session.
pub(super) fn of_run(status: &Status, session: i32) -> Option<ArmError> {
    if let Some(fault) = of_arm(status) {
        return Some(fault);
    }
    if status.session != session {
        let detail = "another program has taken the place of the servo program".to_owned();
        return Some(ArmError::new(PROGRAM_STOPPED, detail));
    }
    match status.phase {
        Some(Phase::Starved) => {
            return Some(ArmError::new(
                REFERENCES_LATE,
                "references stayed away for too long, so the servo program stopped the arm: look \
                 for what delayed this computer or the network",
            ));
        }
        Some(Phase::Stopped | Phase::StoppedByFault) => {
            return Some(ArmError::new(
                PROGRAM_STOPPED,
                "the servo program was told to stop by someone else",
            ));
        }
        Some(Phase::GaveUp) => {
            return Some(ArmError::new(
                PROGRAM_STOPPED,
                "the servo program ended because no first reference came",
            ));
        }
        _ => {}
    }
    if matches!(
        status.runtime_state,
        runtime_state::PAUSING | runtime_state::PAUSED | runtime_state::RESUMING
    ) {
        let detail = "the program was paused; start again from the arm's present pose";
        return Some(ArmError::new(PAUSED, detail));
    }
    if !status.program_is_running() {
        let detail = "the servo program was stopped at the controller";
        return Some(ArmError::new(PROGRAM_STOPPED, detail));
    }
    None
}

/// Whether the next run must be asked for with an explicit re-arm: not where it was this program
/// that refused a reference or was called in the wrong order, while arm and link were well.
pub(super) fn latches_the_arm(fault: &ArmError) -> bool {
    ![REFERENCE_REFUSED, FIRST_REFERENCE_AWAY, OUT_OF_TURN].contains(&fault.name)
}

/// The fault that a session's error is.
pub(super) fn of_session(error: &SessionError) -> ArmError {
    let name = match error {
        SessionError::Lost(_) => LINK_LOST,
        SessionError::Wire(_)
        | SessionError::OutOfOrder(_)
        | SessionError::WrongType { .. }
        | SessionError::StartRefused => PROTOCOL,
        SessionError::ProtocolRefused | SessionError::NotFound { .. } => CONTROLLER_TOO_OLD,
        SessionError::InUse { .. } => REGISTER_IN_USE,
    };
    ArmError::new(name, error.to_string())
}
