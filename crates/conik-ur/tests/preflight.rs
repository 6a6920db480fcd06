//! A look at the controller that moves nothing, against a controller that only records.

#[allow(dead_code)] // The driver's tests use the rest.
mod stub;

use conik_ur::driver::UrConfig;
use conik_ur::driver::preflight::preflight;
use std::sync::atomic::AtomicBool;
use stub::{Behaviour, Stub};

fn config(stub: &Stub) -> UrConfig {
    UrConfig {
        rtde_port: stub.rtde_port,
        script_port: stub.script_port,
        // Nobody listens there.
        dashboard_port: 1,
        ..UrConfig::new("127.0.0.1")
    }
}

#[test]
fn a_preflight_measures_and_writes_nothing() {
    let behaviour = Behaviour {
        streams: true,
        version: (3, 15),
        ..Behaviour::default()
    };
    let q = behaviour.q;
    let stub = Stub::start(behaviour);
    let found = preflight(&config(&stub), None, 0.1, &AtomicBool::new(false)).unwrap();
    assert_eq!((found.series, found.rate_hz), ("CB3", 125.0));
    assert_eq!(found.bridged_cycles, 5);
    assert_eq!(found.q, q);
    assert_eq!(found.hindrance, None);
    assert_eq!(found.identity.unwrap_err().name, "connect-failed");
    assert!(found.timing.packages > 2);
    assert_eq!(found.timing.repeated, 0);
    // Whatever was not read one by one was passed over, and nothing else is missing.
    assert_eq!(found.timing.missed, found.timing.passed_over);
    assert!(stub.written().is_empty());
}

#[test]
fn a_preflight_ends_when_told_and_names_what_would_hinder_a_run() {
    let stub = Stub::start(Behaviour {
        streams: true,
        from_start: Some(|o| o.safety_bits = 1 << 2),
        ..Behaviour::default()
    });
    let config = config(&stub);
    let found = preflight(&config, Some(250.0), 1e9, &AtomicBool::new(true)).unwrap();
    assert_eq!(found.hindrance.unwrap().name, "protective-stop");
    assert_eq!(found.rate_hz, 250.0);
    assert!(stub.written().is_empty());
}

#[test]
fn a_rate_that_is_not_possible_is_refused_before_anything_is_asked_for() {
    let stub = Stub::start(Behaviour::default());
    let config = config(&stub);
    let fault = preflight(&config, Some(400.0), 1.0, &AtomicBool::new(false)).unwrap_err();
    assert_eq!(fault.name, "rate-not-possible");
    assert!(stub.written().is_empty());
}
