//! What the driver puts on the wire and how it takes what comes back, against a controller that
//! only records.

mod stub;

use conik::JointVec;
use conik_sim::arm::{Arm, ArmError, Reference};
use conik_sim::scenario::{UrSeries, UrSettings};
use conik_ur::driver::{UrArm, UrConfig};
use std::time::Duration;
use stub::{Behaviour, Change, LinkEnd, Stub, Written};

const RATE: f64 = 125.0;

/// A guard against hanging only; no verdict depends on it.
const HANG: Duration = Duration::from_secs(20);

/// What the driver lets pass without a reference [s]: more than this computer ever stalls.
const BRIDGED: f64 = 4.5;

fn arm(stub: &Stub) -> UrArm {
    UrArm::new(config(stub))
}

fn config(stub: &Stub) -> UrConfig {
    UrConfig {
        rtde_port: stub.rtde_port,
        script_port: stub.script_port,
        link_timeout: HANG,
        program_timeout: HANG,
        stop_timeout: HANG,
        extrapolate_s: BRIDGED,
        ..UrConfig::new("127.0.0.1")
    }
}

fn at(q: [f64; 6]) -> Reference {
    Reference {
        q: q.into(),
        qd: JointVec::zeros(6),
        qdd: JointVec::zeros(6),
    }
}

/// References on a curve with irrational values, so that every bit of them counts.
fn curve(q0: [f64; 6], count: u32) -> Vec<Reference> {
    let value =
        |tick: f64, joint: usize| q0[joint] + 0.05 * (0.05 * tick * (joint + 1) as f64).sin();
    (0..count)
        .map(|tick| {
            let tick = f64::from(tick);
            Reference {
                q: std::array::from_fn::<_, 6, _>(|joint| value(tick, joint)).into(),
                qd: std::array::from_fn::<_, 6, _>(|joint| {
                    RATE * (value(tick + 0.5, joint) - value(tick - 0.5, joint))
                })
                .into(),
                qdd: JointVec::zeros(6),
            }
        })
        .collect()
}

fn run(arm: &mut UrArm, references: &[Reference]) -> Result<u64, ArmError> {
    let mut missed = 0;
    for reference in references {
        missed += arm.next_cycle()?.missed_cycles;
        arm.send(reference)?;
    }
    Ok(missed)
}

/// The references among what was written.
fn references(written: &[Written]) -> Vec<&Written> {
    written
        .iter()
        .filter(|package| package.command == 1)
        .collect()
}

#[test]
fn references_arrive_in_order_and_bit_by_bit() {
    for byte_by_byte in [false, true] {
        let behaviour = Behaviour {
            byte_by_byte,
            ..Behaviour::default()
        };
        let q0 = behaviour.q;
        let count = if byte_by_byte { 50 } else { 2000 };
        let curve = curve(q0, count);
        let stub = Stub::start(behaviour);
        let mut arm = arm(&stub);
        assert_eq!(arm.start(RATE).unwrap(), q0.into());
        assert_eq!(run(&mut arm, &curve).unwrap(), 0, "missed cycles");
        arm.stop().unwrap();
        arm.stop().unwrap();
        let written = stub.written();
        let arrived = references(&written);
        assert_eq!(arrived.len(), curve.len());
        for (number, (arrived, sent)) in (1..).zip(arrived.iter().zip(&curve)) {
            assert_eq!(arrived.counter, number);
            assert_eq!(arrived.q.map(f64::to_bits)[..], bits(&sent.q));
            assert_eq!(arrived.qd.map(f64::to_bits)[..], bits(&sent.qd));
        }
        assert_eq!(written.last().unwrap().command, 2, "the last word is stop");
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

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
fn no_number_that_is_not_finite_goes_out() {
    for bad in [f64::NAN, f64::INFINITY] {
        let stub = Stub::start(Behaviour::default());
        let mut q = Behaviour::default().q;
        q[0] = bad;
        let mut arm = arm(&stub);
        arm.start(RATE).unwrap();
        let fault = run(&mut arm, &[at(q)]).unwrap_err();
        assert_eq!(fault.name, "reference-refused");
        drop(arm);
        assert!(stub.written().iter().all(|package| {
            package
                .q
                .iter()
                .chain(&package.qd)
                .all(|value| value.is_finite())
        }));
    }
}

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
    let cases: [(&str, usize, Change); 3] = [
        ("link-lost", 0, |o| o.link = LinkEnd::Closed),
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
        assert_eq!(arm.stop().unwrap_err().name, "stop-unconfirmed");
        stays_latched(&mut arm, name);
        ends_with(&stub.written(), name, stops);
    }
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

#[test]
fn a_reference_that_took_too_long_is_not_sent() {
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

#[test]
fn an_arm_that_may_not_move_is_not_started() {
    // `after` waits for a reference, so the stub's own version and fields do here.
    let old = Stub::start(Behaviour {
        version: (3, 8),
        ..Behaviour::default()
    });
    let fault = arm(&old).start(RATE).unwrap_err();
    assert_eq!(fault.name, "controller-too-old");
    assert!(fault.detail.contains("3.9"), "{fault}");
    assert!(old.written().is_empty());

    let wrong_rate = Stub::start(Behaviour::default());
    let fault = arm(&wrong_rate).start(400.0).unwrap_err();
    assert_eq!(fault.name, "rate-not-possible");
    assert!(fault.detail.contains("500, 250"), "{fault}");
    assert!(wrong_rate.written().is_empty());
}

#[test]
fn a_register_in_use_is_named_with_the_cure() {
    let types = format!("IN_USE,INT32{}", ",DOUBLE".repeat(12));
    let stub = Stub::start(Behaviour {
        input_types: Some(types),
        ..Behaviour::default()
    });
    let fault = arm(&stub).start(RATE).unwrap_err();
    assert_eq!(fault.name, "register-in-use");
    for part in ["input_int_register_24", "fieldbus"] {
        assert!(fault.detail.contains(part), "{fault}");
    }
    assert!(!fault.detail.contains("input_int_register_25"), "{fault}");
}

#[test]
fn a_late_reader_takes_the_newest_package_and_counts_the_others() {
    let behaviour = Behaviour {
        packages_at_once: 3,
        ..Behaviour::default()
    };
    let q = behaviour.q;
    let stub = Stub::start(behaviour);
    let mut arm = arm(&stub);
    arm.start(RATE).unwrap();
    let before = arm.status().unwrap().timestamp;
    let mut missed = 0;
    let mut cycles = 0;
    let mut first = before;
    for turn in 0..20 {
        missed += arm.next_cycle().unwrap().missed_cycles;
        if turn == 0 {
            first = arm.status().unwrap().timestamp;
        } else {
            cycles += 1;
        }
        arm.send(&at(q)).unwrap();
    }
    // How many of the three are read at once is up to the network; none may go uncounted.
    let elapsed = arm.status().unwrap().timestamp - first;
    assert_eq!((elapsed * RATE).round(), (missed + cycles) as f64);
    drop(arm);
    stub.written();
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
fn a_controller_that_is_not_there_is_a_fault_with_its_address() {
    let port = std::net::TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let mut arm = UrArm::new(UrConfig {
        rtde_port: port,
        ..UrConfig::new("127.0.0.1")
    });
    let fault = arm.start(RATE).unwrap_err();
    assert_eq!(fault.name, "connect-failed");
    assert!(fault.detail.contains(&port.to_string()), "{fault}");
    arm.stop().unwrap();
}

#[test]
fn a_dry_run_does_everything_but_write() {
    let behaviour = Behaviour {
        streams: true,
        ..Behaviour::default()
    };
    let q0 = behaviour.q;
    let stub = Stub::start(behaviour);
    let mut arm = UrArm::new(UrConfig {
        dry_run: true,
        ..config(&stub)
    });
    assert!(arm.describe().contains("nothing is sent"));
    assert_eq!(arm.start(RATE).unwrap(), q0.into());
    let curve = curve(q0, 20);
    run(&mut arm, &curve).unwrap();
    let mut away = curve[19];
    away.q[2] += 0.1;
    let fault = run(&mut arm, &[away]).unwrap_err();
    assert_eq!(fault.name, "reference-refused");
    assert!(fault.detail.contains("joint 3 (elbow)"), "{fault}");
    arm.stop().unwrap();
    assert!(stub.written().is_empty());
}

#[test]
fn a_dry_run_names_what_keeps_the_arm_from_moving() {
    let cases: [(&str, Change); 3] = [
        ("robot-not-running", |o| o.robot_mode = 3),
        ("other-program-running", |o| o.runtime_state = 2),
        ("speed-slider", |o| o.speed_slider = 0.0),
    ];
    for (name, from_start) in cases {
        for dry_run in [true, false] {
            let stub = Stub::start(Behaviour {
                from_start: Some(from_start),
                ..Behaviour::default()
            });
            let mut arm = UrArm::new(UrConfig {
                dry_run,
                ..config(&stub)
            });
            assert_eq!(arm.start(RATE).unwrap_err().name, name);
            assert!(stub.written().is_empty());
        }
    }
}

#[test]
fn an_arm_of_another_series_is_refused() {
    for (version, series, passes) in [
        ((5, 13), UrSeries::Cb3, false),
        ((5, 13), UrSeries::ESeries, true),
        ((3, 15), UrSeries::ESeries, false),
        ((3, 15), UrSeries::Cb3, true),
    ] {
        let stub = Stub::start(Behaviour {
            version,
            ..Behaviour::default()
        });
        let mut config = config(&stub);
        config.apply(&UrSettings {
            series: Some(series),
            ..UrSettings::default()
        });
        let started = UrArm::new(config).start(RATE);
        match started {
            Ok(_) => assert!(passes),
            Err(fault) => assert_eq!((fault.name, passes), ("wrong-arm", false)),
        }
    }
}

#[test]
fn the_settings_of_a_scenario_are_taken_over() {
    let mut config = UrConfig::new("arm");
    let before = config.clone();
    config.apply(&UrSettings::default());
    assert_eq!(config, before);
    config.apply(&UrSettings {
        host: Some("another".to_owned()),
        servo_lookahead_s: Some(0.05),
        servo_gain: Some(500.0),
        payload_kg: Some(1.5),
        tcp_offset_m: Some([0.0, 0.0, 0.12]),
        most_position_rad: Some(vec![3.0; 6]),
        most_speed_rad_per_s: Some(vec![1.0, 2.0, 3.0, 1.0, 2.0, 3.0]),
        most_acceleration_rad_per_s2: Some(vec![20.0; 6]),
        ..UrSettings::default()
    });
    assert_eq!(config.host, "arm", "which arm is the caller's to say");
    assert_eq!((config.lookahead_s, config.gain), (0.05, 500.0));
    assert_eq!(config.payload_kg, Some(1.5));
    assert_eq!(config.tcp.unwrap().0, [0.0, 0.0, 0.12, 0.0, 0.0, 0.0]);
    assert_eq!(config.position_limit, [3.0; 6]);
    assert_eq!(config.speed_limit, [1.0, 2.0, 3.0, 1.0, 2.0, 3.0]);
    assert_eq!(config.acceleration_limit, Some([20.0; 6]));
}
