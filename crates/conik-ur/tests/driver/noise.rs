//! A controller that goes mad in the middle: whatever it sends, the driver ends in a fault with a
//! name, and sends no reference after it.

use super::driving::{RATE, at, config, references};
use crate::generator::{Good, Noise, packages_or};
use crate::stub::{Behaviour, Stub};
use conik_sim::arm::{Arm, ArmError};
use conik_ur::driver::{UrArm, UrConfig};
use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::thread;

/// Where the names of all faults stand.
const DOCUMENTED: &str = include_str!("../../../../docs/ur.md");

/// Packages of a run: seven for the handshake and the program's start, then one for each reference.
const RUN: usize = 20;

/// Stands between driver and stub, and puts noise in the place of the package number `at`; then the
/// connection ends.
fn between(stub: u16, seed: u64, at: usize) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    thread::spawn(move || {
        let (driver, _) = listener.accept().unwrap();
        let controller = TcpStream::connect(("127.0.0.1", stub)).unwrap();
        for stream in [&driver, &controller] {
            stream.set_nodelay(true).unwrap();
        }
        let (mut from, mut to) = (driver.try_clone().unwrap(), controller.try_clone().unwrap());
        let up = thread::spawn(move || {
            // The end of either side ends it.
            let _ = std::io::copy(&mut from, &mut to);
            let _ = to.shutdown(Shutdown::Write);
        });
        let _ = down(&controller, &driver, seed, at);
        // What the driver still says reaches the stub.
        let _ = driver.shutdown(Shutdown::Write);
        let _ = up.join();
    });
    port
}

fn down(
    mut controller: &TcpStream,
    mut driver: &TcpStream,
    seed: u64,
    at: usize,
) -> std::io::Result<()> {
    for number in 0.. {
        let mut package = vec![0; 3];
        controller.read_exact(&mut package)?;
        let size = usize::from(u16::from_be_bytes([package[0], package[1]]));
        package.resize(size, 0);
        controller.read_exact(&mut package[3..])?;
        if number == at {
            let message = b"\0\x09M\x01x\x02me\x01";
            let good = Good::packages(vec![package, message.to_vec()]);
            return driver.write_all(&Noise::new(seed).message(&good));
        }
        driver.write_all(&package)?;
    }
    Ok(())
}

#[test]
fn whatever_a_mad_controller_sends_ends_in_a_named_fault_and_no_reference_follows() {
    for seed in 0..packages_or(300).min(100_000) {
        let behaviour = Behaviour::default();
        let q = behaviour.q;
        let stub = Stub::start(behaviour);
        #[allow(clippy::cast_possible_truncation)] // Below the length of a run.
        let place = (seed % RUN as u64) as usize;
        let mut arm = UrArm::new(UrConfig {
            rtde_port: between(stub.rtde_port, seed, place),
            ..config(&stub)
        });
        let mut sent = 0;
        let mut tick = |arm: &mut UrArm| {
            arm.next_cycle()?;
            arm.send(&at(q))?;
            sent += 1;
            Ok(())
        };
        let mut end = arm.start(RATE).map(|_| ());
        while end.is_ok() {
            end = tick(&mut arm);
        }
        let fault: ArmError = end.unwrap_err();
        let documented = format!("`{}`", fault.name);
        assert!(DOCUMENTED.contains(&documented), "seed {seed}: {fault}");
        for _ in 0..3 {
            assert!(
                arm.send(&at(q)).is_err() && arm.next_cycle().is_err(),
                "seed {seed}"
            );
        }
        // Nobody may be left to confirm it.
        let _ = arm.stop();
        drop(arm);
        let written = stub.written();
        let count = references(&written).len();
        assert!(
            count <= sent,
            "seed {seed}: {count} references, {sent} before {fault}"
        );
        let stopped = written.iter().position(|package| package.command == 2);
        let after = stopped.map_or(&[][..], |first| &written[first..]);
        assert!(
            references(after).is_empty(),
            "seed {seed}: a reference after the stop"
        );
    }
}
