//! Starting, stopping, and calls in the wrong order.

use super::driving::{RATE, arm, at, references, run};
use crate::stub::{Behaviour, Change, Stub};
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

#[test]
fn a_run_that_ends_in_order_says_so_and_one_that_a_fault_ends_says_that() {
    for (change, by_fault) in [
        (None, 0),
        (Some((2, (|o| o.timestamp += 100.0) as Change)), 1),
    ] {
        let stub = Stub::start(Behaviour {
            after: change,
            ..Behaviour::default()
        });
        let q = Behaviour::default().q;
        let mut arm = arm(&stub);
        arm.start(RATE).unwrap();
        let ran = run(&mut arm, &[at(q); 5]);
        assert_eq!(ran.is_err(), by_fault == 1);
        arm.stop().unwrap();
        let written = stub.written();
        let stop = written.last().unwrap();
        assert_eq!((stop.command, stop.by_fault), (2, by_fault));
    }
}

#[test]
fn a_reference_that_was_refused_does_not_latch_the_arm() {
    let stub = Stub::start(Behaviour::default());
    let mut q = Behaviour::default().q;
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    run(&mut arm, &[at(q)]).unwrap();
    q[0] += 1.0;
    run(&mut arm, &[at(q)]).unwrap_err();
    arm.stop().unwrap();
    let written = stub.written();
    let stop = written.last().unwrap();
    assert_eq!((stop.command, stop.by_fault), (2, 0));
}

#[test]
fn what_ends_the_program_while_it_stops_the_arm_is_a_fault() {
    let cases: [(&str, Change); 4] = [
        ("protective-stop", |o| {
            o.safety_bits = 1 << 2;
            o.runtime_state = 1;
        }),
        ("program-stopped", |o| {
            o.runtime_state = 1;
            o.robot_bits = 1;
        }),
        ("paused", |o| o.runtime_state = 4),
        ("program-stopped", |o| o.session += 1),
    ];
    for (name, at_stop) in cases {
        let stub = Stub::start(Behaviour {
            at_stop: Some(at_stop),
            ..Behaviour::default()
        });
        let q = Behaviour::default().q;
        let mut arm = arm(&stub);
        arm.start(RATE).unwrap();
        run(&mut arm, &[at(q); 3]).unwrap();
        let fault = arm.stop().unwrap_err();
        assert_eq!(fault.name, name, "{fault}");
        let written = stub.written();
        assert_eq!(references(&written).len(), 3);
    }
}
