//! Every port of the emulated controller: what it answers, faults, crowds and noise.

use conik::JointVec;
use conik_ur::emulator::{Emulator, EmulatorConfig, Fault, Pace, Series, faults};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

const Q0: [f64; 6] = [0.1, -1.5, 1.2, -0.4, 0.7, 0.0];

/// Bytes of random and mutated packages sent to each port; more by `CONIK_NOISE_PACKAGES`.
const NOISE_PACKAGES: u32 = 300;

/// The least that is taken for the program of the maker's C++ client library; nobody listens there.
const EXTERNAL_CONTROL: &str = "def any():\n MULT_jointstate = 1000000\n MODE_STOPPED = -2\n \
    MODE_IDLE = 0\n MODE_SERVOJ = 1\n servoj(q, lookahead_time=0.03, gain=2000)\n \
    socket_open(\"127.0.0.1\", 9, \"reverse_socket\")\nend";

fn emulator() -> Emulator {
    Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, JointVec::from(Q0))
    })
    .unwrap()
}

fn connect(port: u16) -> TcpStream {
    let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    // A guard against hanging only.
    let patience = Some(Duration::from_secs(30));
    stream.set_read_timeout(patience).unwrap();
    stream.set_write_timeout(patience).unwrap();
    stream
}

struct Dashboard(BufReader<TcpStream>);

impl Dashboard {
    fn of(emulator: &Emulator) -> Self {
        let mut dashboard = Self(BufReader::new(connect(emulator.dashboard_port())));
        let greeting = "Connected: Universal Robots Dashboard Server";
        assert_eq!(dashboard.line(), greeting);
        dashboard
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        self.0.read_line(&mut line).unwrap();
        line.trim_end().to_owned()
    }

    fn ask(&mut self, question: &str) -> String {
        writeln!(self.0.get_mut(), "{question}").unwrap();
        self.line()
    }
}

/// A client of the RTDE port that speaks bytes.
struct Rtde(TcpStream);

impl Rtde {
    fn of(emulator: &Emulator) -> Self {
        Self(connect(emulator.rtde_port()))
    }

    fn request(&mut self, kind: u8, payload: &[u8]) {
        let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
        self.0
            .write_all(&[&size, &[kind][..], payload].concat())
            .unwrap();
    }

    fn package(&mut self) -> (u8, Vec<u8>) {
        let mut header = [0; 3];
        self.0.read_exact(&mut header).unwrap();
        let size = usize::from(u16::from_be_bytes([header[0], header[1]]));
        let mut payload = vec![0; size - 3];
        self.0.read_exact(&mut payload).unwrap();
        (header[2], payload)
    }

    fn ask(&mut self, kind: u8, payload: &[u8]) -> Vec<u8> {
        self.request(kind, payload);
        loop {
            let (answered, contents) = self.package();
            if answered == kind {
                return contents;
            }
        }
    }

    /// Receives the timestamp from now on.
    fn started(emulator: &Emulator) -> Self {
        let mut rtde = Self::of(emulator);
        assert_eq!(rtde.ask(b'V', &[0, 2]), [1]);
        let outputs = [&500.0_f64.to_be_bytes()[..], b"timestamp"].concat();
        assert_eq!(rtde.ask(b'O', &outputs), b"\x01DOUBLE");
        assert_eq!(rtde.ask(b'S', &[]), [1]);
        rtde
    }

    /// The number of cycles that the next package's clock reads.
    #[allow(clippy::cast_possible_truncation)] // Some thousand cycles.
    fn cycle(&mut self) -> i64 {
        let (kind, payload) = self.package();
        assert_eq!((kind, payload.len()), (b'U', 9));
        let timestamp = f64::from_be_bytes(payload[1..].try_into().unwrap());
        (timestamp * 500.0).round() as i64
    }
}

/// Every answer stands in a table beside the dashboard itself; here it is the connection.
#[test]
fn the_dashboard_answers_line_by_line_until_it_is_told_to_quit() {
    let emulator = emulator();
    let mut dashboard = Dashboard::of(&emulator);
    for (question, answer) in [
        ("robotmode", "Robotmode: RUNNING"),
        ("dance", "could not understand: 'dance'"),
        ("quit", "Disconnected"),
    ] {
        assert_eq!(dashboard.ask(question), answer, "{question}");
    }
    assert_eq!(dashboard.line(), "", "the connection ends after 'quit'");
}

#[test]
fn a_protective_stop_cannot_be_released_for_five_seconds() {
    let emulator = emulator();
    let mut dashboard = Dashboard::of(&emulator);
    let mut rtde = Rtde::started(&emulator);
    dashboard.ask("emulator protective stop");
    let stopped = rtde.cycle();
    let refused = dashboard.ask("unlock protective stop");
    assert!(refused.starts_with("Cannot unlock"), "{refused}");
    assert_eq!(dashboard.ask("safetymode"), "Safetymode: PROTECTIVE_STOP");
    // By the controller's own clock.
    while rtde.cycle() < stopped + 2501 {}
    let released = dashboard.ask("unlock protective stop");
    assert_eq!(released, "Protective stop releasing");
    assert_eq!(dashboard.ask("safetymode"), "Safetymode: NORMAL");
}

#[test]
fn version_1_has_neither_a_frequency_nor_a_recipe_number() {
    let emulator = emulator();
    let mut rtde = Rtde::of(&emulator);
    assert_eq!(rtde.ask(b'O', b"timestamp,robot_mode"), b"DOUBLE,INT32");
    assert_eq!(
        rtde.ask(b'M', &[]),
        b"\x01the text package is too short: 0 bytes where 1 are needed"
    );
    assert_eq!(rtde.ask(b'S', &[]), [1]);
    let (kind, payload) = rtde.package();
    assert_eq!((kind, &payload[8..]), (b'U', &[0, 0, 0, 7][..]));
}

#[test]
fn in_local_control_no_program_is_taken() {
    let emulator = Emulator::start(EmulatorConfig {
        remote_control: false,
        ..EmulatorConfig::new(Series::E, JointVec::from(Q0))
    })
    .unwrap();
    let mut dashboard = Dashboard::of(&emulator);
    assert_eq!(dashboard.ask("is in remote control"), "false");
    let mut script = connect(emulator.script_port());
    script.write_all(b"def rtde_control():\nend\n").unwrap();
    wait_for(&emulator, "not in remote control");
}

#[test]
fn faults_of_the_network_reach_the_client() {
    let emulator = emulator();
    let mut dashboard = Dashboard::of(&emulator);
    let mut strike = |fault: &str| {
        assert_eq!(
            dashboard.ask(&format!("emulator {fault}")),
            format!("Emulator: {fault}")
        );
    };
    let mut rtde = Rtde::started(&emulator);

    let mut before = rtde.cycle();
    strike("clock jump 100");
    let leap = (0..2000).any(|_| {
        let now = rtde.cycle();
        let leapt = now - before > 40_000;
        before = now;
        leapt
    });
    assert!(leap, "the clock never leapt");

    strike("freeze 2");
    let gap = (0..5000).any(|_| {
        let now = rtde.cycle();
        let gap = now - before > 500;
        before = now;
        gap
    });
    assert!(gap, "the outputs never paused");

    strike("one-byte on");
    for _ in 0..20 {
        rtde.cycle();
    }
    strike("one-byte off");

    strike("bad packages 1");
    let short = (0..2000).any(|_| rtde.package().1.len() == 8);
    assert!(short, "no package was spoilt");

    strike("register in use input_int_register_30");
    rtde.request(b'I', b"input_int_register_30");
    let answer = std::iter::repeat_with(|| rtde.package()).find(|(kind, _)| *kind == b'I');
    assert_eq!(answer.unwrap().1, b"\x00IN_USE");

    strike("half-open");
    // What was on its way still comes; then neither outputs nor answers.
    rtde.0
        .set_read_timeout(Some(Duration::from_millis(300)))
        .unwrap();
    let mut bytes = [0; 4096];
    let ended =
        std::iter::repeat_with(|| rtde.0.read(&mut bytes)).find(|read| !matches!(read, Ok(1..)));
    assert!(ended.unwrap().is_err(), "the connection must stay open");

    let mut other = Rtde::started(&emulator);
    strike("reset");
    let mut rest = Vec::new();
    // The end of the stream or a reset: either way the connection is over.
    let _ = other.0.read_to_end(&mut rest);
}

#[test]
fn chance_drops_packages_and_jitter_never_turns_them_round() {
    let emulator = emulator();
    emulator.strike(faults::parse("drop 0.95").unwrap());
    let mut rtde = Rtde::started(&emulator);
    let first = rtde.cycle();
    let last = (0..100).map(|_| rtde.cycle()).last().unwrap();
    assert!(last - first > 1000, "{} cycles", last - first);
    emulator.strike(Fault::Drop(0.0));
    emulator.strike(Fault::Jitter(0.02));
    let cycles: Vec<i64> = (0..200).map(|_| rtde.cycle()).collect();
    assert!(cycles.is_sorted(), "{cycles:?}");
}

#[test]
fn two_hundred_connections_are_served_and_deaf_ones_hold_nobody_up() {
    let emulator = emulator();
    let ports = [
        emulator.rtde_port(),
        emulator.script_port(),
        emulator.real_time_port(),
        emulator.dashboard_port(),
    ];
    // They read nothing.
    let deaf: Vec<TcpStream> = (0..200).map(|k| connect(ports[k % ports.len()])).collect();
    let mut dashboard = Dashboard::of(&emulator);
    assert_eq!(dashboard.ask("robotmode"), "Robotmode: RUNNING");
    let mut rtde = Rtde::started(&emulator);
    let first = rtde.cycle();
    while rtde.cycle() < first + 500 {}
    drop(deaf);
}

/// Marsaglia's xorshift: the same noise in every run.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    #[allow(clippy::cast_possible_truncation)] // Below the limit.
    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    fn byte(&mut self) -> u8 {
        self.next().to_be_bytes()[0]
    }

    /// One of the good messages with some bytes changed, cut or doubled; now and then only noise.
    fn mutated(&mut self, good: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = good[self.below(good.len())].clone();
        for _ in 0..self.below(5) {
            let at = self.below(bytes.len().max(1));
            match self.below(4) {
                0 => bytes.truncate(at),
                1 => bytes.insert(at.min(bytes.len()), self.byte()),
                2 => bytes.extend_from_within(..at.min(bytes.len())),
                _ => {
                    if let Some(byte) = bytes.get_mut(at) {
                        *byte = self.byte();
                    }
                }
            }
        }
        bytes
    }
}

fn framed(kind: u8, payload: &[u8]) -> Vec<u8> {
    let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
    [&size, &[kind][..], payload].concat()
}

/// A long run: `CONIK_NOISE_PACKAGES=10000000 cargo test -p conik-ur --release --test
/// emulator_ports noise`.
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
    let packages = std::env::var("CONIK_NOISE_PACKAGES")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(NOISE_PACKAGES);
    let emulator = emulator();
    let outputs = [&500.0_f64.to_be_bytes()[..], b"timestamp,actual_q"].concat();
    let rtde = [
        framed(b'V', &[0, 2]),
        framed(b'V', &[0, 1]),
        framed(b'v', &[]),
        framed(b'O', &outputs),
        framed(b'I', b"input_double_register_24,input_int_register_24,"),
        framed(b'U', &[&[1][..], &[0; 12]].concat()),
        framed(b'S', &[]),
        framed(b'P', &[]),
        framed(b'M', b"\x02hi\x02me\x01"),
    ];
    let lines = |lines: &[&str]| -> Vec<Vec<u8>> {
        lines
            .iter()
            .map(|line| format!("{line}\n").into_bytes())
            .collect()
    };
    let scripts = lines(&[
        "def rtde_control():\n reg_offset_int = 24\nend",
        EXTERNAL_CONTROL,
        "power on",
        "stopj(2)",
    ]);
    let dashboard = lines(&[
        "power on",
        "load a",
        "emulator release",
        "unlock protective stop",
    ]);
    let ports = [
        (emulator.rtde_port(), &rtde[..]),
        (emulator.script_port(), &scripts),
        (emulator.real_time_port(), &scripts),
        (emulator.dashboard_port(), &dashboard),
    ];
    let mut noise = Noise(0x1234_5678_9ABC_DEF1);
    for (port, good) in ports {
        let mut stream = connect(port);
        for _ in 0..packages {
            // The port may have cut us off for what came before; a fresh connection then goes on.
            if stream.write_all(&noise.mutated(good)).is_err() || noise.below(20) == 0 {
                stream = connect(port);
            }
        }
    }
    let mut dashboard = Dashboard::of(&emulator);
    dashboard.ask("brake release");
    assert_eq!(dashboard.ask("robotmode"), "Robotmode: RUNNING");
    let mut rtde = Rtde::started(&emulator);
    let first = rtde.cycle();
    while rtde.cycle() < first + 10 {}
    drop(emulator);
    assert_eq!(panics.load(Ordering::Relaxed), 0, "a thread panicked");
}

#[test]
fn a_program_whose_client_does_not_listen_ends_by_name_and_holds_nothing_up() {
    let emulator = emulator();
    let mut script = connect(emulator.real_time_port());
    script.write_all(EXTERNAL_CONTROL.as_bytes()).unwrap();
    script.write_all(b"\n").unwrap();
    wait_for(&emulator, "program 'externalControl' started");
    let mut dashboard = Dashboard::of(&emulator);
    assert_eq!(dashboard.ask("programState"), "PLAYING externalControl");
    wait_for(
        &emulator,
        "external control ended: 127.0.0.1:9 does not answer",
    );
    assert_eq!(dashboard.ask("running"), "Program running: false");
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
