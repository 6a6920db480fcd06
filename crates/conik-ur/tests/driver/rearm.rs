//! The latch that outlives the driver, held by an emulated controller.

use super::driving::at;
use conik_sim::arm::{Arm, ArmError};
use conik_ur::driver::recover::recover;
use conik_ur::driver::{UrArm, UrConfig};
use conik_ur::emulator::{Emulator, EmulatorConfig, Fault, Injection, Pace, Series};
use std::time::Duration;

const Q0: [f64; 6] = [0.0, -1.5, 1.2, -0.4, 0.7, 0.0];

fn emulator(series: Series) -> (Emulator, UrConfig) {
    let emulator = Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(series, Q0.into())
    })
    .unwrap();
    let config = UrConfig {
        // By the controller's clock, which runs on its own meanwhile.
        unlock_after: Duration::from_millis(5200),
        ..emulator.driver_config()
    };
    (emulator, config)
}

/// Follows `count` references where the arm stands.
fn follow(arm: &mut UrArm, count: usize) -> Result<(), ArmError> {
    for _ in 0..count {
        arm.next_cycle()?;
        arm.send(&at(Q0))?;
    }
    Ok(())
}

/// How another process would find the arm.
fn start(config: &UrConfig, rate_hz: f64) -> Option<&'static str> {
    let mut arm = UrArm::new(config.clone());
    let fault = arm.start(rate_hz).err();
    arm.stop().unwrap();
    fault.map(|fault| fault.name)
}

#[test]
fn after_each_fault_the_next_process_is_refused_until_the_arm_is_armed_anew() {
    let faults: [(&str, Fault); 4] = [
        ("protective-stop", Fault::Event(Injection::ProtectiveStop)),
        ("program-stopped", Fault::Event(Injection::StopProgram)),
        ("clock-jump", Fault::ClockJump(1000.0)),
        ("link-lost", Fault::Reset),
    ];
    for series in [Series::Cb3, Series::E] {
        let rate_hz = series.rate_hz();
        for (name, fault) in &faults {
            let (emulator, config) = emulator(series);
            let mut arm = UrArm::new(config.clone());
            arm.start(rate_hz).unwrap();
            follow(&mut arm, 10).unwrap();
            emulator.strike(fault.clone());
            let ended = follow(&mut arm, 1000).unwrap_err();
            assert_eq!(ended.name, *name, "{series:?}: {ended}");
            // Where the link is gone it cannot be confirmed.
            let _ = arm.stop();
            drop(arm);
            let stands = emulator.target_q();
            wait_until_over(&emulator);

            let next = start(&config, rate_hz).unwrap();
            let expected = if *name == "protective-stop" {
                *name
            } else {
                "not-rearmed"
            };
            assert_eq!(next, expected, "{series:?} after {name}");
            recover(&config, false, &mut |_| {}).unwrap();
            assert_eq!(start(&config, rate_hz), None, "{series:?} after {name}");
            let apart = (emulator.target_q()[0] - stands[0]).abs();
            assert!(apart < 1e-9, "nothing moves in a recovery: {apart}");
        }
    }
}

#[test]
fn a_run_that_ended_in_order_is_followed_by_another() {
    let (_emulator, config) = emulator(Series::Cb3);
    for _ in 0..3 {
        let mut arm = UrArm::new(config.clone());
        arm.start(125.0).unwrap();
        follow(&mut arm, 10).unwrap();
        // Dropped without a word, as when a person interrupts.
        drop(arm);
    }
    assert_eq!(start(&config, 125.0), None);
}

#[test]
fn an_arm_armed_anew_by_its_own_driver_needs_no_recover() {
    let (emulator, config) = emulator(Series::Cb3);
    let mut arm = UrArm::new(config.clone());
    arm.start(125.0).unwrap();
    follow(&mut arm, 10).unwrap();
    emulator.inject(Injection::StopProgram);
    follow(&mut arm, 10).unwrap_err();
    arm.stop().unwrap();
    arm.rearm().unwrap();
    arm.start(125.0).unwrap();
    follow(&mut arm, 10).unwrap();
    arm.stop().unwrap();
}

/// Until no program runs: what the driver left may still be bridging.
fn wait_until_over(emulator: &Emulator) {
    for _ in 0..20_000 {
        let log = emulator.log_lines().join("\n");
        let ends = ["'conik_servo' ended", "program stopped", "protective stop"];
        if ends.iter().any(|end| log.contains(end)) {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the program does not end");
}
