//! Every port of the emulated controller: what it answers, faults, crowds and noise.

use conik::JointVec;
use conik_ur::emulator::{Emulator, EmulatorConfig, Fault, Pace, Series, faults};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

const Q0: [f64; 6] = [0.1, -1.5, 1.2, -0.4, 0.7, 0.0];

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
