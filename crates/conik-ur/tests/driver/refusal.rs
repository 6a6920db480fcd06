//! References that are not sent.

use super::driving::{RATE, arm, at, config, references, run};
use crate::stub::{Behaviour, Stub};
use conik_sim::arm::Arm;
use conik_ur::driver::{UrArm, UrConfig};
use std::time::Duration;

#[test]
fn the_first_reference_away_from_the_arm_is_refused_and_nothing_is_sent() {
    let stub = Stub::start(Behaviour::default());
    let mut q = Behaviour::default().q;
    q[1] += 0.05;
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    arm.next_cycle().unwrap();
    let fault = arm.send(&at(q)).unwrap_err();
    assert_eq!(fault.name, "first-reference-away");
    assert!(fault.detail.contains("joint 2 (shoulder)"), "{fault}");
    assert_eq!(arm.send(&at(Behaviour::default().q)), Err(fault.clone()));
    assert_eq!(arm.next_cycle(), Err(fault));
    arm.stop().unwrap();
    assert!(references(&stub.written()).is_empty());
}

#[test]
fn a_reference_too_fast_is_refused_by_joint_value_and_limit() {
    let stub = Stub::start(Behaviour::default());
    let mut q = Behaviour::default().q;
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    run(&mut arm, &[at(q)]).unwrap();
    q[4] -= 0.032;
    let fault = run(&mut arm, &[at(q)]).unwrap_err();
    assert_eq!(fault.name, "reference-refused");
    for part in ["joint 5 (wrist 2)", "4.000000 rad/s", "3.141593 rad/s"] {
        assert!(fault.detail.contains(part), "{fault}");
    }
    drop(arm);
    let written = stub.written();
    assert_eq!(references(&written).len(), 1);
    assert!(written.iter().all(|package| package.q != q));
}

#[test]
fn a_reference_later_than_the_bridged_time_is_not_sent() {
    let stub = Stub::start(Behaviour::default());
    let q = Behaviour::default().q;
    let mut arm = UrArm::new(UrConfig {
        extrapolate_s: 0.2,
        ..config(&stub)
    });
    arm.start(RATE).unwrap();
    arm.next_cycle().unwrap();
    // The first may take any time: nothing moves yet.
    std::thread::sleep(Duration::from_millis(250));
    arm.send(&at(q)).unwrap();
    arm.next_cycle().unwrap();
    std::thread::sleep(Duration::from_millis(250));
    let fault = arm.send(&at(q)).unwrap_err();
    assert_eq!(fault.name, "references-late");
    assert!(fault.detail.contains("25 cycles (0.200 s)"), "{fault}");
    assert_eq!(arm.next_cycle(), Err(fault));
    drop(arm);
    assert_eq!(references(&stub.written()).len(), 1);
}

#[test]
fn a_reference_that_accelerates_too_much_is_refused_by_joint_value_and_limit() {
    let stub = Stub::start(Behaviour::default());
    let mut q = Behaviour::default().q;
    let mut arm = UrArm::new(UrConfig {
        acceleration_limit: Some([10.0; 6]),
        ..config(&stub)
    });
    arm.start(RATE).unwrap();
    run(&mut arm, &[at(q)]).unwrap();
    q[2] += 9.0 / RATE / RATE;
    run(&mut arm, &[at(q)]).unwrap();
    q[2] -= 3.0 / RATE / RATE;
    let fault = run(&mut arm, &[at(q)]).unwrap_err();
    assert_eq!(fault.name, "reference-refused");
    for part in ["joint 3 (elbow)", "12.000000 rad/s²", "10.000000 rad/s²"] {
        assert!(fault.detail.contains(part), "{fault}");
    }
    drop(arm);
    let written = stub.written();
    assert_eq!(references(&written).len(), 2);
    assert!(written.iter().all(|package| package.q != q));
}
