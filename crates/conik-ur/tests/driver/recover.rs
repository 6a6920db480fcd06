//! From a stop back to where a run may start, against a dashboard that only records.

use crate::stub::dashboard::{Dashboard, NOT_KNOWN, Panel, WELL};
use conik_ur::driver::UrConfig;
use conik_ur::driver::recover::{power_on, recover};
use std::time::Duration;

fn dashboard(panel: Panel) -> (UrConfig, Dashboard) {
    let dashboard = Dashboard::start(panel);
    let config = UrConfig {
        dashboard_port: dashboard.port,
        unlock_after: Duration::ZERO,
        recover_timeout: Duration::from_secs(1),
        link_timeout: Duration::from_secs(20),
        ..UrConfig::new("127.0.0.1")
    };
    (config, dashboard)
}

/// What became of a recovery, and what the dashboard was told.
fn recovered(panel: Panel, power: bool) -> (Result<(), &'static str>, Vec<String>) {
    let (config, dashboard) = dashboard(panel);
    let result = recover(&config, power, &mut |_| {});
    (result.map_err(|fault| fault.name), dashboard.orders())
}

#[test]
fn a_protective_stop_is_unlocked_and_a_program_left_over_is_stopped() {
    let stopped = Panel {
        safety: "PROTECTIVE_STOP",
        program: "PLAYING",
        ..WELL
    };
    let (result, orders) = recovered(stopped, false);
    assert_eq!(result, Ok(()));
    assert_eq!(
        orders,
        ["close safety popup", "unlock protective stop", "stop"]
    );
    assert_eq!(recovered(WELL, true), (Ok(()), vec![]), "nothing to do");
}

#[test]
fn the_arm_is_switched_on_only_if_that_is_asked_for() {
    let off = Panel {
        mode: "POWER_OFF",
        ..WELL
    };
    assert_eq!(recovered(off, false), (Err("robot-not-running"), vec![]));
    let (result, orders) = recovered(off, true);
    assert_eq!(result, Ok(()));
    assert_eq!(orders, ["power on", "brake release"]);
}

#[test]
fn what_is_for_the_person_beside_the_arm_is_named_and_left_alone() {
    for (safety, name) in [
        ("ROBOT_EMERGENCY_STOP", "emergency-stop"),
        ("SYSTEM_EMERGENCY_STOP", "emergency-stop"),
        ("SAFEGUARD_STOP", "safeguard-stop"),
        ("VIOLATION", "safety-fault"),
        ("FAULT", "safety-fault"),
        ("RECOVERY", "safety-fault"),
    ] {
        let arm = Panel { safety, ..WELL };
        assert_eq!(recovered(arm, true), (Err(name), vec![]), "{safety}");
    }
    let local = Panel {
        remote: "false",
        ..WELL
    };
    let refused = (Err("not-in-remote-control"), vec![]);
    assert_eq!(recovered(local, true), refused);
    // A CB3 does not know the question.
    let cb3 = Panel {
        remote: NOT_KNOWN,
        ..WELL
    };
    assert_eq!(recovered(cb3, false), (Ok(()), vec![]));
}

#[test]
fn a_refusal_is_handed_on_in_the_controllers_words() {
    let (config, dashboard) = dashboard(Panel {
        safety: "PROTECTIVE_STOP",
        unlocks: false,
        ..WELL
    });
    let fault = recover(&config, false, &mut |_| {}).unwrap_err();
    assert_eq!(fault.name, "dashboard-refused");
    assert!(fault.detail.contains("until 5s after"), "{fault}");
    dashboard.orders();
}

#[test]
fn a_run_that_powers_the_arm_lifts_no_stop() {
    for (safety, name) in [
        ("PROTECTIVE_STOP", "protective-stop"),
        ("ROBOT_EMERGENCY_STOP", "emergency-stop"),
    ] {
        let (config, dashboard) = dashboard(Panel { safety, ..WELL });
        let fault = power_on(&config, &mut |_| {}).unwrap_err();
        assert_eq!(fault.name, name);
        assert!(dashboard.orders().is_empty());
    }
    let (config, dashboard) = dashboard(Panel {
        mode: "IDLE",
        ..WELL
    });
    power_on(&config, &mut |_| {}).unwrap();
    assert_eq!(dashboard.orders(), ["power on", "brake release"]);
}
