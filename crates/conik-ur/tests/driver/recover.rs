//! From a stop back to where a run may start, against a dashboard that only records.

use super::driving::{HANG, RATE, config};
use crate::stub::dashboard::{Dashboard, NOT_KNOWN, Panel, WELL};
use crate::stub::{Behaviour, Change, Stub};
use conik_sim::arm::Arm;
use conik_ur::driver::recover::{power_on, recover};
use conik_ur::driver::{UrArm, UrConfig};
use std::time::Duration;

/// A dashboard, and an arm that needs no re-arming.
fn dashboard(panel: Panel) -> (UrConfig, Dashboard) {
    let dashboard = Dashboard::start(panel);
    let stub = Stub::start(Behaviour {
        streams: true,
        ..Behaviour::default()
    });
    let config = UrConfig {
        rtde_port: stub.rtde_port,
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

/// What the last program on a controller left behind: its phase, and ours or another's number.
fn left(phase: i32, ours: bool) -> Change {
    match (phase, ours) {
        (2, true) => |o| (o.phase, o.session) = (2, OURS),
        (4, true) => |o| (o.phase, o.session) = (4, OURS),
        (6, true) => |o| (o.phase, o.session) = (6, OURS),
        (3, true) => |o| (o.phase, o.session) = (3, OURS),
        (2, false) => |o| (o.phase, o.session) = (2, 2),
        other => panic!("{other:?} is no case"),
    }
}

/// A session number with the mark of Conik's servo program.
const OURS: i32 = 0x434E_1234;

#[test]
fn a_run_that_did_not_end_in_order_keeps_the_next_from_starting() {
    for (phase, ours, latched) in [
        (2, true, true),
        (4, true, true),
        (6, true, true),
        (3, true, false),
        (2, false, false),
    ] {
        for dry_run in [false, true] {
            let stub = Stub::start(Behaviour {
                from_start: Some(left(phase, ours)),
                ..Behaviour::default()
            });
            let mut arm = UrArm::new(UrConfig {
                dry_run,
                ..config(&stub)
            });
            let fault = arm.start(RATE).err();
            drop(arm);
            let case = format!("phase {phase}, ours: {ours}");
            assert_eq!(fault.is_some(), latched, "{case}: {fault:?}");
            let written = stub.written();
            if let Some(fault) = fault {
                assert_eq!(fault.name, "not-rearmed", "{case}");
                assert!(fault.detail.contains("conik recover"), "{fault}");
                assert!(written.is_empty(), "{case}");
            }
        }
    }
}

#[test]
fn recover_clears_what_the_last_program_left_and_moves_nothing() {
    for with_dashboard in [true, false] {
        let stub = Stub::start(Behaviour {
            streams: true,
            from_start: Some(left(2, true)),
            ..Behaviour::default()
        });
        let dashboard = with_dashboard.then(|| Dashboard::start(WELL));
        let config = UrConfig {
            dashboard_port: dashboard.as_ref().map_or(1, |dashboard| dashboard.port),
            recover_timeout: HANG,
            ..config(&stub)
        };
        let mut said = Vec::new();
        recover(&config, false, &mut |step| said.push(step.to_owned())).unwrap();
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].contains("arming anew"), "{said:?}");
        assert!(stub.written().is_empty(), "no reference, no register");
        if let Some(dashboard) = dashboard {
            assert!(dashboard.orders().is_empty());
        }
    }
}

#[test]
fn an_arm_that_may_not_move_is_not_armed_anew() {
    let stub = Stub::start(Behaviour {
        streams: true,
        from_start: Some(|o| (o.phase, o.session, o.safety_bits) = (2, OURS, 1 << 2)),
        ..Behaviour::default()
    });
    // Without a dashboard nothing lifts the stop.
    let fault = recover(&config(&stub), false, &mut |step| panic!("{step}")).unwrap_err();
    assert_eq!(fault.name, "protective-stop");
    assert!(stub.written().is_empty());
}
