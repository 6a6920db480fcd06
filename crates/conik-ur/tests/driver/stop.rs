//! Starting, stopping, and calls in the wrong order.

use super::driving::{RATE, arm, at, references, run};
use crate::stub::{Behaviour, Stub};
use conik_sim::arm::Arm;

#[test]
fn nothing_but_idle_is_sent_before_the_first_reference() {
    let stub = Stub::start(Behaviour::default());
    let q0 = Behaviour::default().q;
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    drop(arm);
    let written = stub.written();
    // The stop may be said twice, before its effect is seen.
    let stops = written.iter().position(|package| package.command == 2);
    let (idle, stops) = written.split_at(stops.expect("a dropped arm is stopped"));
    assert!(!idle.is_empty());
    for package in idle {
        assert_eq!((package.command, package.counter, package.q), (0, 0, q0));
    }
    assert!(stops.iter().all(|package| package.command == 2));
}

#[test]
fn one_reference_per_cycle() {
    let stub = Stub::start(Behaviour::default());
    let q = Behaviour::default().q;
    let mut arm = arm(&stub);
    assert_eq!(arm.next_cycle().unwrap_err().name, "not-started");
    arm.start(RATE).unwrap();
    assert_eq!(arm.start(RATE).unwrap_err().name, "already-started");
    run(&mut arm, &[at(q)]).unwrap();
    assert_eq!(arm.send(&at(q)).unwrap_err().name, "out-of-turn");
    drop(arm);
    assert_eq!(references(&stub.written()).len(), 1);
}
