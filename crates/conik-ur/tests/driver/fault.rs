//! What ends a run, and that nothing moves the arm after it.

use super::driving::{BRIDGED, RATE, arm, at, config, references, run};
use crate::stub::{Behaviour, Change, LinkEnd, Stub, Written};
use conik_sim::arm::Arm;
use conik_ur::driver::{UrArm, UrConfig};
use std::time::Duration;

/// Each way in which a controller can end a run, the fault's name, and how many packages with the
/// command to stop may follow: none where the program is over, more than one never.
#[test]
fn whatever_ends_a_run_is_latched_by_name_and_nothing_moves_the_arm_any_more() {
    let cases: [(&str, usize, Change); 19] = [
        ("protective-stop", 1, |o| {
            o.safety_bits = 1 << 2 | 1 << 10;
        }),
        ("emergency-stop", 0, |o| {
            o.safety_bits = 1 << 7 | 1 << 2;
            o.runtime_state = 1;
        }),
        ("emergency-stop", 1, |o| o.safety_bits = 1 << 6),
        ("emergency-stop", 1, |o| o.safety_bits = 1 << 5),
        ("safeguard-stop", 1, |o| o.safety_bits = 1 | 1 << 4),
        ("safety-fault", 1, |o| o.safety_bits = 1 << 9),
        ("safety-fault", 1, |o| o.safety_bits = 1 << 3),
        ("safety-fault", 1, |o| o.safety_bits = 0),
        ("robot-not-running", 1, |o| o.robot_mode = 5),
        ("speed-slider", 1, |o| o.speed_slider = 0.5),
        ("program-stopped", 0, |o| {
            o.runtime_state = 1;
            o.robot_bits = 1;
        }),
        ("program-stopped", 0, |o| o.session += 1),
        ("references-late", 1, |o| o.phase = 4),
        ("references-late", 1, |o| o.timestamp += BRIDGED + 1.0),
        ("paused", 1, |o| o.runtime_state = 4),
        ("clock-jump", 1, |o| o.timestamp = 41.0),
        ("clock-jump", 1, |o| o.timestamp -= 0.008),
        ("clock-jump", 1, |o| o.timestamp += 100.0),
        ("bad-feedback", 1, |o| o.actual_q = Some([f64::NAN; 6])),
    ];
    for (name, stops, change) in cases {
        let behaviour = Behaviour {
            after: Some((3, change)),
            ..Behaviour::default()
        };
        let stub = Stub::start(behaviour);
        let mut arm = arm(&stub);
        latches(&mut arm, name);
        arm.stop().unwrap();
        stays_latched(&mut arm, name);
        ends_with(&stub.written(), name, stops);
    }
}

#[test]
fn a_link_that_ends_is_latched_by_name_and_nothing_moves_the_arm_any_more() {
    let cases: [(&str, usize, Change); 5] = [
        ("link-lost", 0, |o| o.link = LinkEnd::Closed),
        ("link-lost", 0, |o| o.link = LinkEnd::Reset),
        ("protocol", 1, |o| o.link = LinkEnd::Short),
        ("link-lost", 1, |o| o.link = LinkEnd::Silent),
        ("protocol", 1, |o| o.link = LinkEnd::Garbage),
    ];
    for (name, stops, change) in cases {
        let behaviour = Behaviour {
            after: Some((3, change)),
            ..Behaviour::default()
        };
        let stub = Stub::start(behaviour);
        let mut arm = UrArm::new(UrConfig {
            link_timeout: Duration::from_secs(1),
            ..config(&stub)
        });
        latches(&mut arm, name);
        let said = &arm.fault().unwrap().detail;
        assert!(said.contains("by itself within 4.504 s"), "{said}");
        assert_eq!(arm.stop().unwrap_err().name, "stop-unconfirmed");
        stays_latched(&mut arm, name);
        ends_with(&stub.written(), name, stops);
    }
}

#[test]
fn a_package_that_comes_again_ends_the_run_and_is_counted() {
    let stub = Stub::start(Behaviour {
        after: Some((3, |o| o.timestamp -= 0.008)),
        ..Behaviour::default()
    });
    let mut arm = arm(&stub);
    latches(&mut arm, "clock-jump");
    arm.stop().unwrap();
    let cycles = arm.cycle_times().unwrap().summary().unwrap();
    assert_eq!((cycles.repeated, cycles.period_us.count), (1, 3));
    stub.written();
}

#[test]
fn the_slider_is_never_written_and_must_stand_at_100_percent() {
    let stub = Stub::start(Behaviour {
        from_start: Some(|o| o.speed_slider = 0.0),
        ..Behaviour::default()
    });
    let fault = arm(&stub).start(RATE).unwrap_err();
    assert_eq!(fault.name, "speed-slider");
    assert!(fault.detail.contains("at 0 %"), "{fault}");
    assert!(stub.written().is_empty());
    // The stub takes no other input than the registers, so none is written in a run either.
    let stub = Stub::start(Behaviour {
        after: Some((3, |o| o.speed_slider = 0.99)),
        ..Behaviour::default()
    });
    let mut arm = arm(&stub);
    latches(&mut arm, "speed-slider");
    arm.stop().unwrap();
    ends_with(&stub.written(), "speed-slider", 1);
}

/// Runs until the fault after the third reference, and tries to go on.
fn latches(arm: &mut UrArm, name: &str) {
    let q = Behaviour::default().q;
    arm.start(RATE).unwrap();
    let fault = run(arm, &[at(q); 10]).unwrap_err();
    assert_eq!(fault.name, name, "{fault}");
    for _ in 0..3 {
        assert_eq!(arm.send(&at(q)), Err(fault.clone()));
        assert_eq!(arm.next_cycle(), Err(fault.clone()));
        assert_eq!(arm.start(RATE), Err(fault.clone()));
        assert_eq!(arm.rearm(), Err(fault.clone()), "not before it is stopped");
    }
}

/// A stopped arm does nothing until it is armed anew.
fn stays_latched(arm: &mut UrArm, name: &str) {
    let q = Behaviour::default().q;
    assert_eq!(arm.send(&at(q)).unwrap_err().name, name);
    assert_eq!(arm.start(RATE).unwrap_err().name, name);
    assert_eq!(arm.fault().unwrap().name, name);
    arm.rearm().unwrap();
    assert_eq!(arm.fault(), None);
    assert_eq!(arm.send(&at(q)).unwrap_err().name, "not-started");
}

fn ends_with(written: &[Written], name: &str, most_stops: usize) {
    assert_eq!(references(written).len(), 3, "{name}");
    let last = written.iter().rposition(|package| package.command == 1);
    let after = &written[last.unwrap() + 1..];
    assert!(after.iter().all(|package| package.command == 2), "{name}");
    assert!(after.len() <= most_stops, "{name}: {after:?}");
}
