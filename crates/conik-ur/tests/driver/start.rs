//! What is checked before anything moves.

use super::driving::{RATE, arm, config, curve, run};
use crate::stub::dashboard::{Dashboard, NOT_KNOWN, Panel, WELL};
use crate::stub::{self, Behaviour, Stub};
use conik_sim::arm::Arm;
use conik_sim::scenario::{UrModel, UrSeries, UrSettings};
use conik_ur::driver::{UrArm, UrConfig};
use std::sync::{Arc, Mutex};

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
    let types = format!("IN_USE,INT32,INT32{}", ",DOUBLE".repeat(15));
    let stub = Stub::start(Behaviour {
        input_types: Some((usize::MAX, types)),
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
    let cases: [(&str, stub::Change); 4] = [
        ("robot-not-running", |o| o.robot_mode = 3),
        ("other-program-running", |o| o.runtime_state = 2),
        ("other-program-running", |o| o.runtime_state = 4),
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
        bridge_s: Some(0.1),
        model: Some(UrModel::Ur10),
        payload_kg: Some(1.5),
        tcp_offset_m: Some([0.0, 0.0, 0.12]),
        most_position_rad: Some(vec![3.0; 6]),
        most_speed_rad_per_s: Some(vec![1.0, 2.0, 3.0, 1.0, 2.0, 3.0]),
        most_acceleration_rad_per_s2: Some(vec![20.0; 6]),
        ..UrSettings::default()
    });
    assert_eq!(config.host, "arm", "which arm is the caller's to say");
    assert_eq!(
        (config.servoj.lookahead_s, config.servoj.gain),
        (0.05, 500.0)
    );
    assert_eq!(config.extrapolate_s, 0.1);
    assert_eq!(config.model, Some(UrModel::Ur10));
    assert_eq!(config.payload_kg, Some(1.5));
    assert_eq!(config.tcp.unwrap().0, [0.0, 0.0, 0.12, 0.0, 0.0, 0.0]);
    assert_eq!(config.position_limit, [3.0; 6]);
    assert_eq!(config.speed_limit, Some([1.0, 2.0, 3.0, 1.0, 2.0, 3.0]));
    assert_eq!(config.acceleration_limit, Some([20.0; 6]));
}

/// A change of the settings.
type Change = fn(&mut UrConfig);

/// How an arm with this dashboard starts, and the warnings meanwhile.
fn started(panel: Panel, stub: &Stub, change: Change) -> (Option<&'static str>, String) {
    let dashboard = Dashboard::start(panel);
    let mut config = UrConfig {
        dashboard_port: dashboard.port,
        ..config(stub)
    };
    change(&mut config);
    let (name, warnings) = start_and_listen(config);
    assert!(dashboard.orders().is_empty(), "a start gives no orders");
    (name, warnings)
}

fn start_and_listen(config: UrConfig) -> (Option<&'static str>, String) {
    let heard = Arc::new(Mutex::new(String::new()));
    let hears = Arc::clone(&heard);
    let mut arm = UrArm::new(config).warning(move |words| *hears.lock().unwrap() += words);
    let fault = arm.start(RATE).err();
    drop(arm);
    let heard = heard.lock().unwrap().clone();
    (fault.map(|fault| fault.name), heard)
}

#[test]
fn the_arms_model_and_remote_control_are_checked_at_every_start() {
    let ur5 = |config: &mut UrConfig| config.robot = Some(UrModel::Ur5);
    let ur10 = |config: &mut UrConfig| config.model = Some(UrModel::Ur10);
    let model = |model| Panel { model, ..WELL };
    let remote = |remote| Panel { remote, ..WELL };
    let cases: [(Panel, Change, Option<&str>, &str); 9] = [
        (model("UR5"), ur5, None, ""),
        (model("UR5e"), ur5, None, ""),
        (model("UR10"), ur5, Some("wrong-arm"), ""),
        (model("UR5"), ur10, Some("wrong-arm"), ""),
        (model("UR10"), |_| {}, None, ""),
        (model(NOT_KNOWN), ur5, None, "make sure that it is a UR5"),
        (model(NOT_KNOWN), |_| {}, None, "no speed limits"),
        (remote("false"), |_| {}, Some("not-in-remote-control"), ""),
        // A CB3 does not know the question.
        (remote(NOT_KNOWN), |_| {}, None, ""),
    ];
    for (panel, change, name, warning) in cases {
        let stub = Stub::start(Behaviour::default());
        let (fault, warnings) = started(panel, &stub, change);
        let case = format!("{} in remote control: {}", panel.model, panel.remote);
        assert_eq!(fault, name, "{case}");
        assert_eq!(warnings.is_empty(), warning.is_empty(), "{warnings}");
        assert!(warnings.contains(warning), "{warnings}");
        assert_eq!(stub.written().is_empty(), name.is_some(), "{case}");
    }
}

#[test]
fn a_controller_without_a_dashboard_is_driven_with_a_warning() {
    let stub = Stub::start(Behaviour::default());
    let (fault, warnings) = start_and_listen(config(&stub));
    assert_eq!(fault, None);
    for part in ["dashboard", "model", "remote control", "127.0.0.1:1"] {
        assert!(warnings.contains(part), "{warnings}");
    }
    let stub = Stub::start(Behaviour::default());
    let other = Panel {
        greeting: "220 mail",
        ..WELL
    };
    let (fault, warnings) = started(other, &stub, |_| {});
    assert_eq!(fault, None);
    assert!(warnings.contains("220 mail"), "{warnings}");
}

#[test]
fn a_register_that_a_dead_connection_still_holds_is_waited_for() {
    let types = format!("IN_USE,INT32,INT32{}", ",DOUBLE".repeat(15));
    let stub = Stub::start(Behaviour {
        input_types: Some((3, types)),
        ..Behaviour::default()
    });
    let (fault, warnings) = start_and_listen(UrConfig {
        in_use_patience: super::driving::HANG,
        ..config(&stub)
    });
    assert_eq!(fault, None);
    assert!(
        warnings.contains("input_int_register_24: in use"),
        "{warnings}"
    );
    let again = warnings.matches("in use").count();
    assert_eq!(again, 1, "said once: {warnings}");
}

#[test]
fn a_controller_that_does_not_keep_the_rate_is_refused() {
    // Its program takes its time, so that there are packages to measure.
    let behaviour = Behaviour {
        program_starts_after: 20,
        ..Behaviour::default()
    };
    let stub = Stub::start(behaviour.clone());
    arm(&stub).start(RATE).unwrap();
    // Packages every 8 ms, asked for every 2 ms.
    let stub = Stub::start(behaviour);
    let mut arm = UrArm::new(UrConfig {
        extrapolate_s: 1.0,
        ..config(&stub)
    });
    let fault = arm.start(500.0).unwrap_err();
    assert_eq!(fault.name, "rate-not-possible");
    assert!(fault.detail.contains("every 8.000 ms"), "{fault}");
    let written = stub.written();
    assert!(written.iter().all(|package| package.command != 1));
}

#[test]
fn servoj_parameters_out_of_range_are_refused_before_anything_is_sent() {
    let stub = Stub::start(Behaviour::default());
    let mut config = config(&stub);
    config.servoj.lookahead_s = 0.3;
    let fault = UrArm::new(config).start(RATE).unwrap_err();
    assert_eq!(fault.name, "bad-setting");
    assert!(fault.detail.contains("lookahead [s] is 0.3"), "{fault}");
    assert!(stub.written().is_empty());
}
