//! From a stop back to where a run may start, against a dashboard that only records.

use conik_ur::driver::UrConfig;
use conik_ur::driver::recover::{power_on, recover};
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// What the dashboard says of the arm.
#[derive(Clone, Copy)]
struct Arm {
    remote: &'static str,
    safety: &'static str,
    mode: &'static str,
    running: bool,
    /// How it takes `unlock protective stop`.
    unlocks: bool,
}

const WELL: Arm = Arm {
    remote: "true",
    safety: "NORMAL",
    mode: "RUNNING",
    running: false,
    unlocks: true,
};

/// A dashboard for one client; gives back what it was told, questions left out.
fn dashboard(mut arm: Arm) -> (UrConfig, JoinHandle<Vec<String>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let config = UrConfig {
        dashboard_port: listener.local_addr().unwrap().port(),
        unlock_after: Duration::ZERO,
        recover_timeout: Duration::from_secs(1),
        link_timeout: Duration::from_secs(20),
        ..UrConfig::new("127.0.0.1")
    };
    let thread = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        writeln!(stream, "Connected: Universal Robots Dashboard Server").unwrap();
        let mut orders = Vec::new();
        for line in BufReader::new(stream.try_clone().unwrap()).lines() {
            let Ok(line) = line else { break };
            let answer = match line.as_str() {
                "is in remote control" => arm.remote.to_owned(),
                "safetymode" => format!("Safetymode: {}", arm.safety),
                "robotmode" => format!("Robotmode: {}", arm.mode),
                "running" => format!("Program running: {}", arm.running),
                order => {
                    orders.push(order.to_owned());
                    take(&mut arm, order).to_owned()
                }
            };
            if writeln!(stream, "{answer}").is_err() {
                break;
            }
        }
        orders
    });
    (config, thread)
}

fn take(arm: &mut Arm, order: &str) -> &'static str {
    match order {
        "close safety popup" => "closing safety popup",
        "unlock protective stop" if !arm.unlocks => {
            "Cannot unlock protective stop until 5s after occurrence."
        }
        "unlock protective stop" => {
            arm.safety = "NORMAL";
            "Protective stop releasing"
        }
        "power on" => {
            arm.mode = "IDLE";
            "Powering on"
        }
        "brake release" => {
            arm.mode = "RUNNING";
            "Brake releasing"
        }
        "stop" => {
            arm.running = false;
            "Stopped"
        }
        _ => "could not understand",
    }
}

/// What became of a recovery, and what the dashboard was told.
fn recovered(arm: Arm, power: bool) -> (Result<(), &'static str>, Vec<String>) {
    let (config, thread) = dashboard(arm);
    let result = recover(&config, power, &mut |_| {});
    (result.map_err(|fault| fault.name), thread.join().unwrap())
}

#[test]
fn a_protective_stop_is_unlocked_and_a_program_left_over_is_stopped() {
    let stopped = Arm {
        safety: "PROTECTIVE_STOP",
        running: true,
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
    let off = Arm {
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
        let arm = Arm { safety, ..WELL };
        assert_eq!(recovered(arm, true), (Err(name), vec![]), "{safety}");
    }
    let local = Arm {
        remote: "false",
        ..WELL
    };
    let refused = (Err("not-in-remote-control"), vec![]);
    assert_eq!(recovered(local, true), refused);
    // A CB3 does not know the question.
    let cb3 = Arm {
        remote: "could not understand: 'is in remote control'",
        ..WELL
    };
    assert_eq!(recovered(cb3, false), (Ok(()), vec![]));
}

#[test]
fn a_refusal_is_handed_on_in_the_controllers_words() {
    let (config, thread) = dashboard(Arm {
        safety: "PROTECTIVE_STOP",
        unlocks: false,
        ..WELL
    });
    let fault = recover(&config, false, &mut |_| {}).unwrap_err();
    assert_eq!(fault.name, "dashboard-refused");
    assert!(fault.detail.contains("until 5s after"), "{fault}");
    thread.join().unwrap();
}

#[test]
fn a_run_that_powers_the_arm_lifts_no_stop() {
    for (safety, name) in [
        ("PROTECTIVE_STOP", "protective-stop"),
        ("ROBOT_EMERGENCY_STOP", "emergency-stop"),
    ] {
        let (config, thread) = dashboard(Arm { safety, ..WELL });
        let fault = power_on(&config, &mut |_| {}).unwrap_err();
        assert_eq!(fault.name, name);
        assert!(thread.join().unwrap().is_empty());
    }
    let (config, thread) = dashboard(Arm {
        mode: "IDLE",
        ..WELL
    });
    power_on(&config, &mut |_| {}).unwrap();
    assert_eq!(thread.join().unwrap(), ["power on", "brake release"]);
}
