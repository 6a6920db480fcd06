//! The program with a client of ours at the other end of its sockets.

use super::*;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};

const CYCLE_S: f64 = 0.008;
const SERVOJ: i32 = 1;
const LOOKAHEAD_S: f64 = 0.03;

/// Where the tests' arm stands [rad].
const Q: f64 = 0.5;

fn still() -> ArmState {
    ArmState {
        q: [Q; JOINTS],
        target_qd: [0.0; JOINTS],
        cycle_s: CYCLE_S,
    }
}

fn listen() -> [TcpListener; 3] {
    std::array::from_fn(|_| TcpListener::bind("127.0.0.1:0").unwrap())
}

/// A program whose sockets are open, and the client's ends: trajectory, commands, setpoints.
fn connected() -> (ExternalControl, [TcpStream; 3]) {
    let listeners = listen();
    let ports = [0, 1, 2].map(|k: usize| listeners[k].local_addr().unwrap().port());
    let text = text::tests::program(ports);
    let program = ExternalControl::recognise(&text).unwrap().unwrap();
    assert!(program.calls().claim());
    assert!(!program.calls().claim(), "one thread dials");
    program.calls().dial();
    let ends = listeners.map(|listener| {
        let (stream, _) = listener.accept().unwrap();
        stream.set_nodelay(true).unwrap();
        stream
    });
    (program, ends)
}

fn frame(timeout_ms: i32, q: f64, mode: i32) -> Vec<u8> {
    #[allow(clippy::cast_possible_truncation)] // A few radians.
    let q = (q * 1e6).round() as i32;
    let numbers = [timeout_ms, q, q, q, q, q, q, mode];
    numbers
        .iter()
        .flat_map(|number| number.to_be_bytes())
        .collect()
}

/// Cycles until what was sent has had its effect.
fn until<T>(
    program: &mut ExternalControl,
    arm: &ArmState,
    mut seen: impl FnMut(&mut ExternalControl, Motion) -> Option<T>,
) -> T {
    for _ in 0..20_000 {
        let motion = program.cycle(arm);
        if let Some(seen) = seen(program, motion) {
            return seen;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("it never came: {program:?}");
}

fn target(motion: Motion) -> Option<f64> {
    match motion {
        Motion::Servo {
            target,
            lookahead_s,
            gain,
        } => {
            assert_eq!((lookahead_s, gain), (LOOKAHEAD_S, 2000.0));
            Some(target[3])
        }
        _ => None,
    }
}

fn ending(program: &mut ExternalControl, arm: &ArmState) -> String {
    until(program, arm, |program, _| {
        program.ending().map(str::to_owned)
    })
}

#[test]
fn setpoints_are_servoed_and_missing_ones_extrapolated_with_the_present_speed() {
    let (mut program, [_, _, mut client]) = connected();
    assert_eq!(program.cycle(&still()), Motion::Rest, "before any setpoint");
    // In two pieces, as the network may cut it.
    let bytes = frame(0, 0.51, SERVOJ);
    client.write_all(&bytes[..13]).unwrap();
    client.write_all(&bytes[13..]).unwrap();
    let first = until(&mut program, &still(), |_, motion| target(motion));
    assert_eq!(first, 0.51);
    let moving = ArmState {
        target_qd: [0.25; JOINTS],
        ..still()
    };
    let next: Vec<f64> = (0..3)
        .map(|_| target(program.cycle(&moving)).unwrap())
        .collect();
    for (have, cycles) in next.iter().zip([1.0, 2.0, 3.0]) {
        assert!((have - (0.51 + cycles * 0.25 * CYCLE_S)).abs() < 1e-12);
    }
    client.write_all(&frame(0, 0.52, SERVOJ)).unwrap();
    until(&mut program, &moving, |_, motion| {
        (target(motion)? == 0.52).then_some(())
    });
}

#[test]
fn silence_ends_it_and_the_arm_brakes_and_a_time_out_of_zero_never_does() {
    let (mut program, [_, _, mut client]) = connected();
    client.write_all(&frame(0, Q, SERVOJ)).unwrap();
    until(&mut program, &still(), |_, motion| target(motion));
    for _ in 0..10_000 {
        program.cycle(&still());
    }
    assert_eq!(program.ending(), None);
    client.write_all(&frame(40, Q, SERVOJ)).unwrap();
    assert_eq!(
        ending(&mut program, &still()),
        "external control ended: no setpoint for 0.04 s"
    );
    client.write_all(&frame(40, Q + 0.01, SERVOJ)).unwrap();
    for _ in 0..100 {
        let motion = program.cycle(&still());
        assert_eq!(motion, Motion::Brake(4.0), "no motion after the end");
    }
}

#[test]
fn idling_brakes_and_the_clients_stop_ends_it() {
    let (mut program, [_, _, mut client]) = connected();
    client.write_all(&frame(0, Q, 0)).unwrap();
    for _ in 0..10 {
        assert_eq!(program.cycle(&still()), Motion::Rest);
    }
    client.write_all(&frame(0, Q, SERVOJ)).unwrap();
    until(&mut program, &still(), |_, motion| target(motion));
    client.write_all(&frame(0, Q, 0)).unwrap();
    until(&mut program, &still(), |_, motion| {
        (motion == Motion::Brake(4.0)).then_some(())
    });
    assert_eq!(program.ending(), None);
    client.write_all(&frame(0, Q, -2)).unwrap();
    assert_eq!(
        ending(&mut program, &still()),
        "external control ended: by its client"
    );
}

#[test]
fn a_client_that_leaves_ends_it() {
    let (mut program, [_, _, client]) = connected();
    drop(client);
    assert!(ending(&mut program, &still()).contains("is gone"));
}

/// 20 rad/s are 0.16 rad in a cycle of 8 ms.
#[test]
fn a_setpoint_that_is_too_far_is_ignored_and_named_once() {
    let (mut program, [_, _, mut client]) = connected();
    client.write_all(&frame(0, Q, SERVOJ)).unwrap();
    until(&mut program, &still(), |_, motion| target(motion));
    program.said();
    for _ in 0..3 {
        client.write_all(&frame(0, Q + 0.17, SERVOJ)).unwrap();
    }
    client.write_all(&frame(0, Q + 0.15, SERVOJ)).unwrap();
    let mut targets = Vec::new();
    until(&mut program, &still(), |_, motion| {
        targets.push(target(motion)?);
        (targets.last() == Some(&(Q + 0.15))).then_some(())
    });
    assert!(!targets.contains(&(Q + 0.17)), "{targets:?}");
    let said = program.said();
    assert!(said[0].contains("more than 20 rad/s away"), "{said:?}");
    assert!(said[1].contains("taken again"), "{said:?}");
    assert_eq!(said.len(), 2);
}

#[test]
fn a_mode_that_is_not_emulated_fails_by_name_and_says_so_to_the_client() {
    let (mut program, [mut trajectory, _, mut client]) = connected();
    client.write_all(&frame(0, Q, 3)).unwrap();
    assert_eq!(
        ending(&mut program, &still()),
        "external control ended: mode 3 (MODE_FORWARD) is not emulated"
    );
    let mut answer = [0; 4];
    trajectory.read_exact(&mut answer).unwrap();
    assert_eq!(i32::from_be_bytes(answer), 2);
}

#[test]
fn commands_are_taken_or_refused_by_name() {
    let (mut program, [_, mut commands, _client]) = connected();
    let command = |number: i32| [&number.to_be_bytes()[..], &[0; 27 * 4]].concat();
    commands.write_all(&command(1)).unwrap();
    commands.write_all(&command(1)).unwrap();
    commands.write_all(&command(3)).unwrap();
    let why = ending(&mut program, &still());
    assert_eq!(
        why,
        "external control ended: START_FORCE_MODE is not emulated"
    );
    let said = program.said();
    let taken = said.iter().filter(|line| line.contains("SET_PAYLOAD"));
    assert_eq!(taken.count(), 1, "{said:?}");
}

#[test]
fn a_client_that_does_not_listen_is_named_with_its_address() {
    let listeners = listen();
    let ports = [0, 1, 2].map(|k: usize| listeners[k].local_addr().unwrap().port());
    drop(listeners);
    let text = text::tests::program(ports);
    let mut program = ExternalControl::recognise(&text).unwrap().unwrap();
    assert!(program.calls().claim());
    program.calls().dial();
    let why = ending(&mut program, &still());
    let address = format!("127.0.0.1:{} does not answer", ports[0]);
    assert!(why.contains(&address), "{why}");
}

#[test]
fn a_program_that_is_dropped_dials_no_more() {
    let listeners = listen();
    let ports = [0, 1, 2].map(|k: usize| listeners[k].local_addr().unwrap().port());
    let text = text::tests::program(ports);
    let program = ExternalControl::recognise(&text).unwrap().unwrap();
    let calls = Arc::clone(program.calls());
    assert!(calls.claim());
    drop(program);
    calls.dial();
    assert!(calls.take().unwrap().is_none());
    for listener in listeners {
        listener.set_nonblocking(true).unwrap();
        assert!(listener.accept().is_err(), "nobody called");
    }
}

/// Marsaglia's xorshift: the same noise in every run.
fn noise(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

#[test]
fn whatever_comes_in_the_targets_are_finite_and_the_end_is_the_end() {
    let mut state = 0x9E37_79B9_7F4A_7C15;
    for _ in 0..20 {
        let (mut program, [mut trajectory, mut commands, mut client]) = connected();
        for _ in 0..200 {
            let mut bytes: Vec<u8> = (0..4)
                .flat_map(|_| noise(&mut state).to_be_bytes())
                .collect();
            // Mostly servoj, or it would end at once; now and then cut.
            if !noise(&mut state).is_multiple_of(16) {
                bytes[28..].copy_from_slice(&SERVOJ.to_be_bytes());
            }
            if noise(&mut state).is_multiple_of(64) {
                bytes.truncate(11);
            }
            let line = match noise(&mut state) % 64 {
                0 => &mut commands,
                1 => &mut trajectory,
                _ => &mut client,
            };
            // It may have hung up, which is its right.
            let _ = line.write_all(&bytes);
            let had_ended = program.ending().is_some();
            let motion = program.cycle(&still());
            if let Some(target) = target(motion) {
                assert!(target.is_finite() && !had_ended);
            }
        }
    }
}
