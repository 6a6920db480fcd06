//! Noise on every port over real sockets: whole and cut segments, connections that end in the
//! middle or are closed on one side only, and clients that read nothing.
//!
//! `CONIK_NOISE_PACKAGES=10000000 cargo test -p conik-ur --release --test noise`

mod generator;

use conik::JointVec;
use conik_ur::emulator::{Emulator, EmulatorConfig, Pace, Series, faults};
use generator::{Noise, framed, good_for, packages_or};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

const PORTS: [u16; 8] = [
    29_999, 30_001, 30_002, 30_003, 30_004, 30_011, 30_012, 30_013,
];

/// A segment grows until it holds this much.
const SEGMENT: usize = 2000;

/// Segments until a client leaves, about.
const PER_CLIENT: usize = 20;

/// A guard against hanging only: the emulator gives a client up after 10 s.
const PATIENCE: Duration = Duration::from_secs(60);

/// What a client does beside sending.
struct Manners {
    /// Reads what it gets.
    reads: bool,
    /// Closes its own direction at the end, and waits until the other side closes too.
    waits_for_the_end: bool,
}

struct Client {
    stream: TcpStream,
    manners: Manners,
}

impl Client {
    fn new(port: u16, noise: &mut Noise) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_write_timeout(Some(PATIENCE)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        Self {
            stream,
            manners: Manners {
                reads: noise.below(4) != 0,
                waits_for_the_end: noise.below(3) == 0,
            },
        }
    }

    /// Whether the port still takes what is sent.
    fn send(&mut self, segment: &[u8]) -> bool {
        if self.stream.write_all(segment).is_err() {
            return false;
        }
        if self.manners.reads {
            let mut buffer = [0; 8192];
            self.stream.set_nonblocking(true).unwrap();
            while matches!(self.stream.read(&mut buffer), Ok(1..)) {}
            self.stream.set_nonblocking(false).unwrap();
        }
        true
    }

    fn leave(mut self) {
        if self.manners.waits_for_the_end && self.stream.shutdown(Shutdown::Write).is_ok() {
            // Cut off for what came before, or served to the end: it is over either way.
            let mut buffer = [0; 8192];
            let end = loop {
                match self.stream.read(&mut buffer) {
                    Ok(1..) => {}
                    end => break end.map_err(|error| error.kind()),
                }
            };
            assert!(
                !matches!(end, Err(std::io::ErrorKind::WouldBlock)),
                "the connection never ends"
            );
        }
    }
}

/// Sends `packages` to a port; returns how many connections that took.
fn rage(port: u16, number: u16, packages: u64) -> u64 {
    let mut noise = Noise::new(u64::from(number));
    let good = good_for(number);
    let mut client = Client::new(port, &mut noise);
    let (mut segment, mut connections) = (Vec::new(), 1);
    for package in 1..=packages {
        segment.extend(noise.message(&good));
        if segment.len() < noise.below(SEGMENT) && package < packages {
            continue;
        }
        let size = if noise.below(3) == 0 {
            noise.below(segment.len() + 1)
        } else {
            segment.len()
        };
        let taken = client.send(&segment[..size]);
        segment.drain(..size);
        if !taken || noise.below(PER_CLIENT) == 0 {
            // In the middle of whatever it was saying.
            std::mem::replace(&mut client, Client::new(port, &mut noise)).leave();
            connections += 1;
            segment.clear();
        }
    }
    client.leave();
    connections
}

/// What the dashboard answers to each line.
fn ask(emulator: &Emulator, lines: &[&str]) -> Vec<String> {
    let stream = TcpStream::connect(("127.0.0.1", emulator.dashboard_port())).unwrap();
    let mut reader = BufReader::new(stream);
    let mut answers = Vec::new();
    for line in [""].iter().chain(lines) {
        if !line.is_empty() {
            writeln!(reader.get_mut(), "{line}").unwrap();
        }
        let mut answer = String::new();
        reader.read_line(&mut answer).unwrap();
        answers.push(answer.trim_end().to_owned());
    }
    answers
}

/// Waits until all that was sent to a port has been read to its end.
fn await_calm(emulator: &Emulator, port: u16) {
    // Connections are served in turn. Every port has something to say to this one.
    let mut last = TcpStream::connect(("127.0.0.1", port)).unwrap();
    last.set_read_timeout(Some(PATIENCE)).unwrap();
    last.write_all(&framed(b'v', &[])).unwrap();
    last.read_exact(&mut [0]).unwrap();
    drop(last);
    let began = Instant::now();
    while emulator.connection_count() > 0 {
        assert!(
            began.elapsed() < PATIENCE,
            "{} connections never end",
            emulator.connection_count()
        );
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A good client is greeted, and gets its packages.
fn assert_serves(emulator: &Emulator) {
    for fault in [
        "drop 0",
        "delay 0",
        "jitter 0",
        "freeze 0",
        "bad packages 0",
        "one-byte off",
        "release",
    ] {
        emulator.strike(faults::parse(fault).unwrap());
    }
    let answers = ask(emulator, &["robotmode", "safetymode"]);
    assert_eq!(answers[1..], ["Robotmode: RUNNING", "Safetymode: NORMAL"]);
    let mut stream = TcpStream::connect(("127.0.0.1", emulator.rtde_port())).unwrap();
    let outputs = [&500.0_f64.to_be_bytes()[..], b"timestamp"].concat();
    for (kind, payload) in [(b'V', &[0, 2][..]), (b'O', &outputs), (b'S', &[])] {
        stream.write_all(&framed(kind, payload)).unwrap();
    }
    let expected = [
        framed(b'V', &[1]),
        framed(b'O', b"\x01DOUBLE"),
        framed(b'S', &[1]),
    ]
    .concat();
    let mut answers = vec![0; expected.len()];
    stream.read_exact(&mut answers).unwrap();
    assert_eq!(answers, expected);
    let mut package = [0; 12];
    for _ in 0..10 {
        stream.read_exact(&mut package).unwrap();
        assert_eq!(package[..4], [0, 12, b'U', 1]);
    }
}

#[test]
fn no_noise_on_any_port_brings_the_emulator_down() {
    // The emulator goes on if one of its threads panics, so look for it.
    let panics = Arc::new(AtomicUsize::new(0));
    let seen = Arc::clone(&panics);
    let print = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        seen.fetch_add(1, Ordering::Relaxed);
        print(panic);
    }));
    let packages = packages_or(5000);
    let emulator = Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, JointVec::from([0.1, -1.5, 1.2, -0.4, 0.7, 0.0]))
    })
    .unwrap();
    for number in PORTS {
        let port = emulator.port_in_place_of(number).unwrap();
        let began = Instant::now();
        let connections = rage(port, number, packages);
        println!(
            "{number}: {packages} packages over {connections} connections in {:?}",
            began.elapsed()
        );
        await_calm(&emulator, port);
        assert_serves(&emulator);
        assert_eq!(panics.load(Ordering::Relaxed), 0, "a thread panicked");
    }
    // Every thread ends, too.
    drop(emulator);
    assert_eq!(panics.load(Ordering::Relaxed), 0, "a thread panicked");
}
