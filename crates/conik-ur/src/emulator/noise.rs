//! Noise on every port, without sockets: fast enough for ten million packages on each.
//!
//! `CONIK_NOISE_PACKAGES=10000000 cargo test -p conik-ur --release --lib noise`

use super::config::{EmulatorConfig, Fault, Injection, Pace, Series};
use super::controller::Controller;
use super::inbound::{Inbound, Service, Then};
use super::world::{Shared, World};
use super::{SERVICES, lock};
use crate::program::tests::PROGRAM;
use crate::wire::FrameReader;
use conik::JointVec;
use std::collections::BTreeSet;
use std::sync::{Condvar, Mutex};

#[path = "../../tests/generator/mod.rs"]
mod generator;

use generator::{Noise, framed, good_for, packages_or};

/// Packages between two control cycles, about.
const PER_CYCLE: usize = 16;

/// Packages until a client leaves, about.
const PER_CLIENT: usize = 50;

/// What the process may grow by [bytes]; the emulator's own limits are far below.
const MOST_GROWTH: usize = 64 << 20;

fn shared() -> Shared {
    let config = EmulatorConfig::new(Series::E, JointVec::from([0.1, -1.5, 1.2, -0.4, 0.7, 0.0]));
    Shared {
        world: Mutex::new(World::new(Controller::new(&config).unwrap())),
        changed: Condvar::new(),
        version: config.series.version(),
        rate_hz: config.rate_hz,
        pace: Pace::Lockstep,
        real_time: false,
    }
}

/// A client without a socket.
struct Client {
    id: u64,
    inbound: Inbound,
    /// What it was sent; only RTDE is looked at.
    packages: Option<FrameReader>,
}

impl Client {
    fn new(shared: &Shared, service: Service) -> Self {
        let id = lock(&shared.world).new_id();
        Self {
            id,
            inbound: Inbound::join(shared, id, service),
            packages: (service == Service::Rtde).then(FrameReader::new),
        }
    }

    /// Takes what waits to be written; the kinds of packages that it held.
    fn receive(&mut self) -> Vec<u8> {
        let mut kinds = Vec::new();
        let bytes = self.inbound.outbox().take_all();
        if let Some(packages) = &mut self.packages {
            packages.push(&bytes.concat());
            while let Some(frame) = packages.next_frame().expect("framing holds") {
                kinds.push(frame.kind);
            }
        }
        kinds
    }
}

/// What noise led to.
#[derive(Debug, Default)]
struct Reached {
    /// Kinds of packages that were sent back.
    kinds: BTreeSet<u8>,
    /// Cycles in which a program ran.
    running: u64,
}

/// Sends noise to one port, in segments that are cut and merged at random.
fn rage(shared: &Shared, service: Service, port: u16, packages: u64) -> Reached {
    let mut reached = Reached::default();
    let mut noise = Noise::new(u64::from(port));
    let mut good = good_for(port);
    if matches!(service, Service::State | Service::RealTime) {
        good.add(PROGRAM.text().unwrap().into_bytes());
    }
    let mut client = Client::new(shared, service);
    let mut segment = Vec::new();
    for _ in 0..packages {
        segment.extend(noise.message(&good));
        let mut stays = Then::GoOn;
        while stays == Then::GoOn && !segment.is_empty() && noise.below(3) != 0 {
            let size = noise.below(segment.len()) + 1;
            stays = client.inbound.take(shared, &segment[..size]);
            segment.drain(..size);
        }
        if noise.below(PER_CYCLE) == 0 {
            let mut world = lock(&shared.world);
            world.cycle(shared.pace);
            reached.running += u64::from(world.controller.program_runs());
        }
        // Most read what they get.
        if noise.below(4) != 0 {
            reached.kinds.extend(client.receive());
        }
        if stays == Then::Close || noise.below(PER_CLIENT) == 0 {
            let mut world = lock(&shared.world);
            world.remove(client.id);
            // A stop would keep all programs out for five seconds by the controller's clock.
            world.strike(Fault::Event(Injection::Release));
            drop(world);
            client = Client::new(shared, service);
            segment.clear();
        }
    }
    lock(&shared.world).remove(client.id);
    reached
}

/// Takes back every fault that noise at the dashboard may have brought about.
fn calm(shared: &Shared) {
    let mut world = lock(&shared.world);
    for fault in [
        Fault::Drop(0.0),
        Fault::Delay(0.0),
        Fault::Jitter(0.0),
        Fault::Freeze(0.0),
        Fault::BadPackages(0),
        Fault::Event(Injection::Release),
    ] {
        world.strike(fault);
    }
}

/// A good client is served as on the first day.
fn assert_serves(shared: &Shared) {
    let mut rtde = Client::new(shared, Service::Rtde);
    let outputs = [&500.0_f64.to_be_bytes()[..], b"timestamp,target_q"].concat();
    for (kind, payload) in [(b'V', &[0, 2][..]), (b'O', &outputs), (b'S', &[])] {
        let then = rtde.inbound.take(shared, &framed(kind, payload));
        assert_eq!((then, rtde.receive()), (Then::GoOn, vec![kind]));
    }
    for _ in 0..10 {
        lock(&shared.world).cycle(shared.pace);
        assert_eq!(rtde.receive(), b"U");
    }
    lock(&shared.world).remove(rtde.id);
    let mut dashboard = Client::new(shared, Service::Dashboard);
    dashboard.inbound.take(shared, b"robotmode\n");
    let said = dashboard.inbound.outbox().take_all().concat();
    let said = String::from_utf8(said).unwrap();
    assert!(said.ends_with("Robotmode: RUNNING\n"), "{said}");
    lock(&shared.world).remove(dashboard.id);
}

/// Memory of this process [bytes], where the system tells.
fn memory() -> Option<usize> {
    let pages = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: usize = pages.split(' ').nth(1)?.parse().ok()?;
    Some(4096 * pages)
}

#[test]
fn no_noise_on_any_port_brings_the_controller_down() {
    let packages = packages_or(20_000);
    let shared = shared();
    for (service, port) in SERVICES {
        // What stays for good is there after the first packages.
        rage(&shared, service, port, packages.min(10_000));
        let (before, began) = (memory(), std::time::Instant::now());
        let reached = rage(&shared, service, port, packages);
        let growth = memory()
            .zip(before)
            .map(|(now, then)| now.saturating_sub(then));
        println!(
            "{port}: {packages} packages in {:?}, {growth:?} bytes more",
            began.elapsed()
        );
        assert!(
            growth.is_none_or(|growth| growth < MOST_GROWTH),
            "{port} grew by {growth:?}"
        );
        match service {
            Service::Rtde => assert!(reached.kinds.iter().eq(b"IMOPSUVv"), "{reached:?}"),
            Service::State | Service::RealTime => assert!(reached.running > 0),
            _ => {}
        }
        calm(&shared);
        assert_serves(&shared);
    }
    assert!(lock(&shared.world).controller.log.lines().count() <= 500);
}
