//! Each fault of the emulated controller, asked for at the dashboard, as a client of RTDE that
//! speaks bytes sees it. Those of the network stand in `emulator_ports.rs`, too.

use conik::JointVec;
use conik_ur::emulator::{Emulator, EmulatorConfig, Pace, Series};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// More cycles than anything takes here.
const CYCLES: u32 = 5000;

/// A client in lockstep: it answers every package, and the clock waits for it.
struct Client {
    stream: TcpStream,
    dashboard: BufReader<TcpStream>,
    value: i32,
}

/// What a package says.
#[derive(Clone, Copy, Debug)]
struct State {
    timestamp: f64,
    robot_mode: i32,
    safety_mode: i32,
    /// `runtime_state`.
    program: u32,
    /// What the client wrote, read back.
    echo: i32,
}

fn connect(port: u16) -> TcpStream {
    let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    // A guard against hanging only.
    stream
        .set_read_timeout(Some(Duration::from_secs(30)))
        .unwrap();
    stream.set_nodelay(true).unwrap();
    stream
}

impl Client {
    fn new(emulator: &Emulator) -> Self {
        let mut client = Self {
            stream: connect(emulator.rtde_port()),
            dashboard: BufReader::new(connect(emulator.dashboard_port())),
            value: 0,
        };
        client.line();
        let outputs = b"timestamp,robot_mode,safety_mode,runtime_state,input_int_register_30";
        client.send(b'V', &[0, 2]);
        client.send(b'O', &[&500_f64.to_be_bytes()[..], outputs].concat());
        client.send(b'I', b"input_int_register_30");
        client.send(b'S', &[]);
        while client.package().0 != b'S' {}
        client
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        self.dashboard.read_line(&mut line).unwrap();
        line.trim_end().to_owned()
    }

    fn strike(&mut self, fault: &str) {
        writeln!(self.dashboard.get_mut(), "emulator {fault}").unwrap();
        assert_eq!(self.line(), format!("Emulator: {fault}"));
    }

    fn send(&mut self, kind: u8, payload: &[u8]) {
        let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
        let package = [&size, &[kind][..], payload].concat();
        self.stream.write_all(&package).unwrap();
    }

    fn package(&mut self) -> (u8, Vec<u8>) {
        let mut header = [0; 3];
        self.stream.read_exact(&mut header).unwrap();
        let size = usize::from(u16::from_be_bytes([header[0], header[1]]));
        let mut payload = vec![0; size - 3];
        self.stream.read_exact(&mut payload).unwrap();
        (header[2], payload)
    }

    /// The next package; it is answered with the present value.
    fn state(&mut self) -> State {
        let (kind, bytes) = self.package();
        assert_eq!((kind, bytes.len()), (b'U', 25));
        let word = |at: usize| i32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        let state = State {
            timestamp: f64::from_be_bytes(bytes[1..9].try_into().unwrap()),
            robot_mode: word(9),
            safety_mode: word(13),
            program: word(17).unsigned_abs(),
            echo: word(21),
        };
        let answer = [&[1][..], &self.value.to_be_bytes()].concat();
        self.send(b'U', &answer);
        state
    }

    /// Goes on until a package is like this; returns how many others came before.
    #[track_caller]
    fn until(&mut self, what: &str, mut is_like_this: impl FnMut(&State) -> bool) -> u32 {
        let mut last = self.state();
        for count in 0..CYCLES {
            if is_like_this(&last) {
                return count;
            }
            last = self.state();
        }
        panic!("never {what}: {last:?}");
    }

    /// Packages that go by until a new value is read back.
    fn cycles_to_and_fro(&mut self) -> u32 {
        self.value += 1;
        let value = self.value;
        self.until("read back", |state| state.echo == value)
    }
}

fn emulator() -> Emulator {
    Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, JointVec::from([0.1, -1.5, 1.2, -0.4, 0.7, 0.0]))
    })
    .unwrap()
}

#[test]
fn stops_show_in_the_modes_until_they_are_released() {
    let emulator = emulator();
    let mut client = Client::new(&emulator);
    for (fault, safety, robot) in [
        ("protective stop", 3, 7),
        ("release", 1, 7),
        ("emergency stop", 7, 3),
        ("release", 1, 7),
    ] {
        client.strike(fault);
        client.until(fault, |state| {
            (state.safety_mode, state.robot_mode) == (safety, robot)
        });
        // It stays so.
        for _ in 0..50 {
            let state = client.state();
            assert_eq!(
                (state.safety_mode, state.robot_mode),
                (safety, robot),
                "{fault}"
            );
        }
    }
}

#[test]
fn pause_and_stop_show_in_the_runtime_state() {
    let emulator = emulator();
    let mut client = Client::new(&emulator);
    for (fault, runtime_state) in [("pause", 4), ("program stop", 1), ("protective stop", 1)] {
        client.strike("release");
        let program = "def rtde_control():\n global reg_offset_float = 24\n global reg_offset_int = 24\nend\n";
        let mut script = connect(emulator.script_port());
        script.write_all(program.as_bytes()).unwrap();
        client.until("playing", |state| state.program == 2);
        client.strike(fault);
        client.until(fault, |state| state.program == runtime_state);
    }
}

#[test]
fn the_clock_begins_anew_or_leaps() {
    let emulator = emulator();
    let mut client = Client::new(&emulator);
    let before = client.state().timestamp;
    client.strike("clock jump 100");
    client.until("a leap", |state| state.timestamp > before + 100.0);
    client.strike("restart clock");
    client.until("a restart", |state| state.timestamp < before + 100.0);
}

#[test]
fn a_delay_holds_every_package_up_for_its_cycles() {
    let emulator = emulator();
    let mut client = Client::new(&emulator);
    let at_once = client.cycles_to_and_fro();
    assert!(at_once <= 2, "{at_once} cycles without a delay");
    client.strike("delay 0.1");
    // Those that were under way come first.
    for _ in 0..200 {
        client.state();
    }
    let delayed = client.cycles_to_and_fro();
    assert!((50..=52).contains(&delayed), "{delayed} cycles");
}

#[test]
fn a_fault_that_is_put_off_comes_in_its_cycle() {
    let emulator = emulator();
    let mut client = Client::new(&emulator);
    client.strike("after 0.5 protective stop");
    let begun = client.state().timestamp;
    let stopped = |state: &State| state.safety_mode == 3;
    let cycles = client.until("stopped", stopped);
    // One or two packages were on their way meanwhile.
    assert!(
        (247..=251).contains(&cycles),
        "{cycles} cycles from {begun} s on"
    );
}
