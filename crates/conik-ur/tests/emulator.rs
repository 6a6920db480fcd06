//! The driver against the emulated controller: motion, stops, and an emulator that stays up.

use conik::JointVec;
use conik_sim::arm::{Arm, ArmError, Reference};
use conik_ur::driver::{UrArm, UrConfig};
use conik_ur::emulator::{Emulator, EmulatorConfig, Injection, Pace, Series};
use proptest::prelude::*;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

const Q0: [f64; 6] = [0.1, -1.5, 1.2, -0.4, 0.7, 0.0];

fn emulator(rate_hz: f64) -> Emulator {
    Emulator::start(EmulatorConfig {
        rate_hz,
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, Q0.into())
    })
    .unwrap()
}

/// A ramp of joint 1 from the start, at `speed` [rad/s].
fn ramp(speed: f64, rate_hz: f64, tick: u32) -> Reference {
    let mut q = JointVec::from(Q0);
    let mut qd = JointVec::zeros(6);
    q[0] += speed / rate_hz * f64::from(tick);
    qd[0] = speed;
    Reference {
        q,
        qd,
        qdd: JointVec::zeros(6),
    }
}

fn run(arm: &mut UrArm, rate_hz: f64, ticks: u32) -> Result<Vec<f64>, ArmError> {
    (0..ticks)
        .map(|tick| {
            let feedback = arm.next_cycle()?;
            assert_eq!(feedback.missed_cycles, 0, "lockstep misses nothing");
            arm.send(&ramp(0.2, rate_hz, tick))?;
            Ok(feedback.q.unwrap()[0])
        })
        .collect()
}

#[test]
fn the_arm_follows_with_the_lookahead_as_its_lag() {
    for (rate_hz, ticks) in [(125.0, 250), (500.0, 1000), (100.0, 200)] {
        let emulator = emulator(rate_hz);
        let mut arm = UrArm::new(emulator.driver_config());
        assert!(!arm.is_real_time());
        assert_eq!(arm.start(rate_hz).unwrap(), Q0.into());
        let measured = run(&mut arm, rate_hz, ticks).unwrap();
        let last = measured[measured.len() - 1];
        let sent_before = Q0[0] + 0.2 / rate_hz * f64::from(ticks - 2);
        let lag = (sent_before - last) / 0.2;
        // One cycle more: the arm measures where it was commanded one cycle ago.
        assert!(
            (lag - 0.1).abs() <= 2.0 / rate_hz,
            "lag {lag} s at {rate_hz} Hz"
        );
        arm.stop().unwrap();
        assert_eq!(emulator.target_q()[1..], Q0[1..], "the others stood still");
    }
}

#[test]
fn a_run_in_lockstep_is_the_same_each_time() {
    let measured = || {
        let emulator = emulator(125.0);
        let mut arm = UrArm::new(emulator.driver_config());
        arm.start(125.0).unwrap();
        run(&mut arm, 125.0, 500).unwrap()
    };
    assert_eq!(measured(), measured());
}

#[test]
fn references_at_a_fraction_of_the_controllers_rate_work_too() {
    let emulator = emulator(500.0);
    let mut arm = UrArm::new(emulator.driver_config());
    arm.start(125.0).unwrap();
    run(&mut arm, 125.0, 200).unwrap();
    arm.stop().unwrap();
    let fault = arm.start(300.0).unwrap_err();
    assert_eq!(fault.name, "rate-not-possible");
}

#[test]
fn each_event_at_the_controller_is_latched_by_name() {
    for (injection, name) in [
        (Injection::ProtectiveStop, "protective-stop"),
        (Injection::EmergencyStop, "emergency-stop"),
        (Injection::StopProgram, "program-stopped"),
        (Injection::PauseProgram, "paused"),
        (Injection::RestartClock, "clock-jump"),
    ] {
        let emulator = emulator(125.0);
        let mut arm = UrArm::new(emulator.driver_config());
        arm.start(125.0).unwrap();
        run(&mut arm, 125.0, 50).unwrap();
        emulator.inject(injection);
        let fault = (0..3)
            .find_map(|_| {
                let cycle = arm.next_cycle();
                let sent = cycle.and_then(|_| arm.send(&ramp(0.2, 125.0, 50)));
                sent.err()
            })
            .unwrap();
        assert_eq!(fault.name, name);
        assert_eq!(arm.next_cycle(), Err(fault.clone()));
        arm.stop().unwrap();
        assert_eq!(arm.send(&ramp(0.2, 125.0, 51)), Err(fault));
    }
}

#[test]
fn an_arm_is_armed_anew_where_it_stands() {
    let emulator = emulator(125.0);
    let mut arm = UrArm::new(emulator.driver_config());
    arm.start(125.0).unwrap();
    run(&mut arm, 125.0, 50).unwrap();
    emulator.inject(Injection::ProtectiveStop);
    while arm.next_cycle().is_ok() {
        let _ = arm.send(&ramp(0.2, 125.0, 50));
    }
    arm.stop().unwrap();
    assert_eq!(arm.start(125.0).unwrap_err().name, "protective-stop");
    emulator.inject(Injection::Release);
    let fault = arm.start(125.0).unwrap_err();
    assert_eq!(fault.name, "protective-stop", "latched, though it is over");
    arm.rearm().unwrap();
    let q = arm.start(125.0).unwrap();
    assert!(q[0] > Q0[0]);
    assert_eq!(q, emulator.target_q());
    arm.next_cycle().unwrap();
    let fault = arm.send(&ramp(0.2, 125.0, 100)).unwrap_err();
    assert_eq!(fault.name, "first-reference-away");
}

#[test]
fn a_sudden_step_makes_a_protective_stop() {
    let emulator = Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        largest_step: 0.01,
        ..EmulatorConfig::new(Series::Cb3, Q0.into())
    })
    .unwrap();
    let mut arm = UrArm::new(emulator.driver_config());
    arm.start(125.0).unwrap();
    let fault = (0..10)
        .find_map(|tick| {
            let cycle = arm.next_cycle();
            cycle.and_then(|_| arm.send(&ramp(2.0, 125.0, tick))).err()
        })
        .unwrap();
    assert_eq!(fault.name, "protective-stop");
    let log = emulator.log_lines().join("\n");
    assert!(log.contains("joint 1 by 0.016"), "{log}");
}

#[test]
fn a_lost_link_is_a_fault_at_once_and_does_not_hang() {
    let emulator = emulator(125.0);
    let mut arm = UrArm::new(emulator.driver_config());
    arm.start(125.0).unwrap();
    run(&mut arm, 125.0, 10).unwrap();
    drop(emulator);
    let fault = (0..3)
        .find_map(|_| {
            let cycle = arm.next_cycle();
            cycle.and_then(|_| arm.send(&ramp(0.2, 125.0, 10))).err()
        })
        .unwrap();
    assert_eq!(fault.name, "link-lost");
    assert_eq!(arm.next_cycle(), Err(fault));
    let stop = arm.stop().unwrap_err();
    assert_eq!(stop.name, "stop-unconfirmed");
    arm.stop().unwrap();
}

#[test]
fn a_driver_that_vanishes_leaves_an_arm_that_stops_by_itself() {
    // At zero, because this client leaves the registers for the joints as they are.
    let emulator = Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::Cb3, JointVec::zeros(6))
    })
    .unwrap();
    {
        let mut client = RawClient::connect(&emulator);
        client.claim_and_start();
        let text = conik_ur::program::ServoProgram {
            session: 77,
            cycle_s: 0.008,
            extrapolated_cycles: 5,
            stop_deceleration: 4.0,
            watchdog_hz: 10.0,
            patience_s: 60.0,
            registers: conik_ur::registers::RegisterBase::default(),
            payload_kg: None,
            tcp: None,
        }
        .text()
        .unwrap();
        let mut script = TcpStream::connect(("127.0.0.1", emulator.script_port())).unwrap();
        script.write_all(text.as_bytes()).unwrap();
        client.idle_until(1);
        client.write_counter(1, 1);
        // No stop, no goodbye.
    }
    wait_for(&emulator, "program 'conik_servo' ended");
    let mut witness = RawClient::connect(&emulator);
    witness.ask_for_phase();
    witness.request(b'S', &[]);
    assert_eq!(witness.package(), (b'S', vec![1]));
    // Phase 4: references stayed away.
    assert_eq!(witness.package(), (b'U', vec![1, 0, 0, 0, 4]));
}

#[test]
fn a_second_client_is_told_which_register_is_in_use() {
    let emulator = emulator(125.0);
    let mut first = UrArm::new(emulator.driver_config());
    first.start(125.0).unwrap();
    run(&mut first, 125.0, 5).unwrap();
    let fault = UrArm::new(emulator.driver_config())
        .start(125.0)
        .unwrap_err();
    assert_eq!(fault.name, "register-in-use");
    assert!(fault.detail.contains("input_double_register_24"), "{fault}");
    run_on(&mut first, 5);
    first.stop().unwrap();
}

fn run_on(arm: &mut UrArm, tick: u32) {
    arm.next_cycle().unwrap();
    arm.send(&ramp(0.2, 125.0, tick)).unwrap();
}

#[test]
fn a_program_that_is_not_emulated_is_refused_in_words_on_every_port() {
    let emulator = emulator(125.0);
    let mut witness = RawClient::connect(&emulator);
    witness.ask_for_phase();
    witness.request(b'S', &[]);
    assert_eq!(witness.package(), (b'S', vec![1]));
    let mut script = TcpStream::connect(("127.0.0.1", emulator.script_port())).unwrap();
    let patience = Some(Duration::from_secs(20));
    script.set_read_timeout(patience).unwrap();
    script
        .write_all(b"def other():\n  movej([0,0,0,0,0,0])\nend\n")
        .unwrap();
    let refusal = "program 'other' refused: line 2: unknown function 'movej'";
    wait_for(&emulator, refusal);
    witness.expect_text(refusal);
    // Among the messages of the port: a run-time exception (10) at line 2.
    let message = std::iter::repeat_with(|| {
        let mut header = [0; 5];
        script.read_exact(&mut header).unwrap();
        let size = u32::from_be_bytes([header[0], header[1], header[2], header[3]]);
        let mut contents = vec![0; size as usize - header.len()];
        script.read_exact(&mut contents).unwrap();
        (header[4], contents)
    })
    .take(1000)
    .find(|(kind, contents)| *kind == 20 && contents[9] == 10);
    let contents = message.unwrap().1;
    assert_eq!(contents[10..14], [0, 0, 0, 2]);
    assert!(String::from_utf8_lossy(&contents[18..]).starts_with(refusal));
    assert_eq!(emulator.target_q(), Q0.into());
}

#[test]
fn a_nan_never_reaches_a_register() {
    let emulator = emulator(125.0);
    let mut client = RawClient::connect(&emulator);
    client.send(&[0, 5, b'V', 0, 2]);
    assert_eq!(client.package(), (b'V', vec![1]));
    client.request(b'I', b"input_double_register_24");
    assert_eq!(client.package(), (b'I', b"\x01DOUBLE".to_vec()));
    client.request(b'U', &[&[1][..], &f64::NAN.to_be_bytes()].concat());
    client.expect_text("not a finite number");
    let mut outputs = 125.0_f64.to_be_bytes().to_vec();
    outputs.extend(b"input_double_register_24");
    client.request(b'O', &outputs);
    assert_eq!(client.package(), (b'O', b"\x01DOUBLE".to_vec()));
    client.request(b'S', &[]);
    assert_eq!(client.package(), (b'S', vec![1]));
    assert_eq!(client.package(), (b'U', [&[1][..], &[0; 8]].concat()));
}

#[test]
fn one_byte_at_a_time_is_enough() {
    let emulator = emulator(125.0);
    let mut client = RawClient::connect(&emulator);
    for byte in [0, 5, b'V', 0, 2, 0, 3, b'v'] {
        client.send(&[byte]);
    }
    assert_eq!(client.package(), (b'V', vec![1]));
    let (kind, version) = client.package();
    assert_eq!((kind, &version[..4]), (b'v', &[0, 0, 0, 5][..]));
}

#[test]
fn in_wall_time_the_clock_waits_for_nobody() {
    let config = EmulatorConfig {
        rate_hz: 500.0,
        ..EmulatorConfig::new(Series::E, Q0.into())
    };
    let emulator = Emulator::start(config).unwrap();
    // A client that reads nothing, and one that does.
    let mut deaf = RawClient::connect(&emulator);
    deaf.claim_and_start();
    let mut arm = UrArm::new(UrConfig {
        link_timeout: Duration::from_secs(20),
        registers: conik_ur::registers::RegisterBase::new(0).unwrap(),
        ..emulator.driver_config()
    });
    assert!(arm.is_real_time());
    arm.start(500.0).unwrap();
    let before = arm.status().unwrap().timestamp;
    for _ in 0..100 {
        arm.next_cycle().unwrap();
    }
    assert!(arm.status().unwrap().timestamp > before);
}

#[test]
fn settings_that_no_controller_has_are_refused() {
    let config = EmulatorConfig::new(Series::E, Q0.into());
    for bad in [
        EmulatorConfig {
            rate_hz: f64::NAN,
            ..config.clone()
        },
        EmulatorConfig {
            rate_hz: 0.0,
            ..config.clone()
        },
        EmulatorConfig {
            acceleration_limit: 0.0,
            ..config.clone()
        },
        EmulatorConfig {
            largest_step: -1.0,
            ..config.clone()
        },
        EmulatorConfig {
            q0: JointVec::zeros(5),
            ..config.clone()
        },
        EmulatorConfig {
            q0: [f64::NAN; 6].into(),
            ..config
        },
    ] {
        assert!(Emulator::start(bad.clone()).is_err(), "{bad:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// One emulator for all bytes: whatever came before, the next driver still gets its arm.
    #[test]
    fn no_bytes_bring_the_emulator_down(
        rtde in any::<Vec<u8>>(),
        framed in prop::collection::vec(
            (prop::sample::select(b"VvMUOISPx".to_vec()), prop::collection::vec(any::<u8>(), 0..60)),
            0..20,
        ),
        script in any::<Vec<u8>>(),
    ) {
        let emulator = emulator(125.0);
        let mut noise = RawClient::connect(&emulator);
        for (kind, payload) in &framed {
            noise.request(*kind, payload);
        }
        noise.send(&rtde);
        let mut other = TcpStream::connect(("127.0.0.1", emulator.script_port())).unwrap();
        let _ = other.write_all(&script);
        let _ = other.write_all(b"\n");
        drop((noise, other));
        let mut arm = UrArm::new(emulator.driver_config());
        prop_assert_eq!(arm.start(125.0), Ok(Q0.into()));
        prop_assert!(run(&mut arm, 125.0, 5).is_ok());
        prop_assert_eq!(arm.stop(), Ok(()));
    }
}

/// Waits until the log has a line that holds `part`.
fn wait_for(emulator: &Emulator, part: &str) {
    for _ in 0..20_000 {
        if emulator.log_lines().iter().any(|line| line.contains(part)) {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("'{part}' never came:\n{}", emulator.log_lines().join("\n"));
}

/// A client that speaks bytes.
struct RawClient {
    stream: TcpStream,
}

impl RawClient {
    fn connect(emulator: &Emulator) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", emulator.rtde_port())).unwrap();
        stream.set_nodelay(true).unwrap();
        // A guard against hanging only.
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .unwrap();
        Self { stream }
    }

    /// Sends bytes; the emulator may have closed the connection for what came before.
    fn send(&mut self, bytes: &[u8]) {
        let _ = self.stream.write_all(bytes);
    }

    fn request(&mut self, kind: u8, payload: &[u8]) {
        let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
        self.send(&[&size, &[kind][..], payload].concat());
    }

    fn package(&mut self) -> (u8, Vec<u8>) {
        let mut header = [0; 3];
        self.stream.read_exact(&mut header).unwrap();
        let size = usize::from(u16::from_be_bytes([header[0], header[1]]));
        let mut payload = vec![0; size - 3];
        self.stream.read_exact(&mut payload).unwrap();
        (header[2], payload)
    }

    /// Passes over outputs up to a text message, which must hold `part` and be an error.
    fn expect_text(&mut self, part: &str) {
        loop {
            let (kind, payload) = self.package();
            if kind == b'U' {
                continue;
            }
            let text = String::from_utf8_lossy(&payload).into_owned();
            assert_eq!(kind, b'M', "{text}");
            assert!(text.contains(part), "'{part}' is not in '{text}'");
            assert_eq!(payload.last(), Some(&1), "level");
            return;
        }
    }

    /// Claims the counter and the command, asks for the servo program's phase, and starts.
    fn claim_and_start(&mut self) {
        self.ask_for_phase();
        self.request(
            b'I',
            b"input_int_register_24,input_int_register_25,input_double_register_36,\
              input_double_register_37,input_double_register_38,",
        );
        let types = b"\x01INT32,INT32,DOUBLE,DOUBLE,DOUBLE".to_vec();
        assert_eq!(self.package(), (b'I', types));
        self.request(b'S', &[]);
        assert_eq!(self.package(), (b'S', vec![1]));
    }

    fn ask_for_phase(&mut self) {
        self.send(&[0, 5, b'V', 0, 2]);
        assert_eq!(self.package(), (b'V', vec![1]));
        let mut outputs = 125.0_f64.to_be_bytes().to_vec();
        outputs.extend(b"output_int_register_24");
        self.request(b'O', &outputs);
        assert_eq!(self.package(), (b'O', b"\x01INT32".to_vec()));
    }

    /// Answers each package with an idle command until the servo program is in this phase.
    fn idle_until(&mut self, phase: u8) {
        for _ in 0..10_000 {
            if self.package() == (b'U', vec![1, 0, 0, 0, phase]) {
                return;
            }
            self.write_counter(0, 0);
        }
        panic!("phase {phase} never came");
    }

    fn write_counter(&mut self, counter: i32, command: i32) {
        let ints = [counter, command].map(i32::to_be_bytes).concat();
        // Lookahead, gain and time of `servoj`.
        let doubles = [0.1_f64, 300.0, 0.008].map(f64::to_be_bytes).concat();
        self.request(b'U', &[&[1][..], &ints, &doubles].concat());
    }
}
