//! How the emulated arm follows, seen from outside: through the driver, the network and the servo
//! program.

use conik::JointVec;
use conik_sim::arm::{Arm, ArmError, Reference};
use conik_ur::driver::{UrArm, UrConfig};
use conik_ur::emulator::{Emulator, EmulatorConfig, Injection, Pace, Series};
use conik_ur::model::ArmFacts;
use conik_ur::servoj::Servoj;
use std::time::Duration;

const Q0: [f64; 6] = [0.1, -1.5, 1.2, -0.4, 0.7, 0.0];

fn emulator(series: Series) -> Emulator {
    Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(series, Q0.into())
    })
    .unwrap()
}

/// Joint 1 at this distance [rad] from the start and with this speed [rad/s].
fn reference(distance: f64, speed: f64) -> Reference {
    let (mut q, mut qd) = (JointVec::from(Q0), JointVec::zeros(6));
    q[0] += distance;
    qd[0] = speed;
    Reference {
        q,
        qd,
        qdd: JointVec::zeros(6),
    }
}

/// Speeds up with 4 rad/s² to `speed` [rad/s] and goes on with it; gives the delay [s] after each
/// cycle in which it was reached.
fn ramp(
    arm: &mut UrArm,
    emulator: &Emulator,
    speed: f64,
    seconds: f64,
) -> Result<Vec<f64>, ArmError> {
    let rate_hz = emulator.config().rate_hz;
    let (mut distance, mut now, mut delays) = (0.0, 0.0, Vec::new());
    let mut time = 0.0;
    while time < seconds {
        time += 1.0 / rate_hz;
        arm.next_cycle()?;
        // In lockstep the arm waits for what comes next: it has followed the last reference.
        let behind = Q0[0] + distance - emulator.target_q()[0];
        if now == speed {
            delays.push(behind / speed);
        }
        now = f64::min(now + 4.0 / rate_hz, speed);
        distance += now / rate_hz;
        arm.send(&reference(distance, now))?;
    }
    Ok(delays)
}

#[test]
fn the_delay_to_a_ramp_is_the_lookahead_within_one_cycle() {
    // The ends of both ranges, and what users set.
    for (lookahead_s, gain) in [
        (0.1, 300.0),
        (0.03, 2000.0),
        (0.03, 100.0),
        (0.2, 100.0),
        (0.2, 2000.0),
        (0.03, 1200.0),
    ] {
        for series in [Series::Cb3, Series::E] {
            let emulator = emulator(series);
            let rate_hz = series.rate_hz();
            let mut arm = UrArm::new(UrConfig {
                servoj: Servoj { lookahead_s, gain },
                ..emulator.driver_config()
            });
            arm.start(rate_hz).unwrap();
            let delays = ramp(&mut arm, &emulator, 0.5, 4.0).unwrap();
            let delay = delays[delays.len() - 1];
            assert!(
                (delay - lookahead_s).abs() <= 1.0 / rate_hz + 1e-9,
                "{series:?}, lookahead {lookahead_s} s, gain {gain}: {delay} s"
            );
            arm.stop().unwrap();
        }
    }
}

/// The emulated arm has 3.14 rad/s; the driver is told to let more pass.
#[test]
fn a_ramp_that_the_arm_cannot_follow_makes_a_protective_stop_and_one_that_it_can_does_not() {
    for series in [Series::Cb3, Series::E] {
        let emulator = emulator(series);
        let mut arm = UrArm::new(UrConfig {
            speed_limit: Some([10.0; 6]),
            position_limit: [100.0; 6],
            ..emulator.driver_config()
        });
        arm.start(series.rate_hz()).unwrap();
        let followed = ramp(&mut arm, &emulator, 2.8, 3.0);
        assert!(followed.is_ok(), "{}", emulator.log_lines().join("\n"));
        arm.stop().unwrap();
        drop(emulator);

        let emulator = self::emulator(series);
        let mut arm = UrArm::new(UrConfig {
            speed_limit: Some([10.0; 6]),
            position_limit: [100.0; 6],
            ..emulator.driver_config()
        });
        arm.start(series.rate_hz()).unwrap();
        let fault = ramp(&mut arm, &emulator, 3.5, 10.0).unwrap_err();
        assert_eq!(fault.name, "protective-stop", "{fault:?}");
        let lines = emulator.log_lines().join("\n");
        let why = "the arm cannot follow: joint 1 has needed more than 3.14 rad/s";
        assert!(lines.contains(why), "{lines}");
    }
}

/// With 10 rad/s² from 1 rad/s: 0.05 rad, and not a standstill at once.
#[test]
fn a_protective_stop_brakes_the_arm() {
    for series in [Series::Cb3, Series::E] {
        let emulator = emulator(series);
        let mut arm = UrArm::new(emulator.driver_config());
        arm.start(series.rate_hz()).unwrap();
        ramp(&mut arm, &emulator, 1.0, 3.0).unwrap();
        let from = emulator.target_q()[0];
        emulator.inject(Injection::ProtectiveStop);
        // The clock of lockstep waits for the driver, which has yet to find the stop.
        while arm.next_cycle().is_ok() {}
        // Then it goes on by itself: 100 cycles are more than the stop takes.
        wait_for_cycles(&emulator, 100);
        let way = emulator.target_q()[0] - from;
        // The last reference may have been followed for one cycle more.
        let tolerance = 2.0 / series.rate_hz();
        assert!((way - 0.05).abs() <= tolerance, "{series:?}: {way} rad");
        wait_for_cycles(&emulator, 20);
        assert_eq!(emulator.target_q()[0] - from, way, "it stands");
    }
}

fn wait_for_cycles(emulator: &Emulator, cycles: u64) {
    let from = emulator.cycles();
    while emulator.cycles() < from + cycles {
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// The limits that the maker publishes for the arm that the dashboard names, not those of another.
#[test]
fn an_arm_is_driven_within_the_speed_limits_of_its_own_model() {
    for (name, passes) in [("UR5e", true), ("UR10e", false)] {
        let arm = ArmFacts::ALL.iter().find(|arm| arm.name() == name).unwrap();
        let emulator = Emulator::start(EmulatorConfig {
            pace: Pace::Lockstep,
            ..EmulatorConfig::of(arm, Q0.into())
        })
        .unwrap();
        let mut driven = UrArm::new(emulator.driver_config());
        driven.start(500.0).unwrap();
        let ramped = ramp(&mut driven, &emulator, 2.5, 0.8);
        assert_eq!(ramped.is_ok(), passes, "{name}: {ramped:?}");
        if let Err(fault) = ramped {
            assert_eq!(fault.name, "reference-refused");
            assert!(fault.detail.contains("2.094395 rad/s"), "{fault}");
        }
        driven.stop().unwrap();
    }
}
