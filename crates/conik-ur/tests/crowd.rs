//! Many clients at once, some that never read, and many that come and go: a good client gets every
//! package, and nothing is left behind.

use conik::JointVec;
use conik_ur::emulator::{Emulator, EmulatorConfig, Pace, Series};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

const PORTS: [u16; 8] = [
    30_004, 29_999, 30_001, 30_002, 30_003, 30_011, 30_012, 30_013,
];

/// A guard against hanging only.
const PATIENCE: Duration = Duration::from_secs(60);

/// One test at a time: they count threads and file handles of the process, and need many.
static TURN: Mutex<()> = Mutex::new(());

fn turn() -> MutexGuard<'static, ()> {
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

fn emulator() -> Emulator {
    Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, JointVec::from([0.1, -1.5, 1.2, -0.4, 0.7, 0.0]))
    })
    .unwrap()
}

fn framed(kind: u8, payload: &[u8]) -> Vec<u8> {
    let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
    [&size, &[kind][..], payload].concat()
}

fn outputs(names: &str) -> Vec<u8> {
    framed(b'O', &[&500_f64.to_be_bytes(), names.as_bytes()].concat())
}

/// A connection that has asked for something, so that every port answers.
fn connect(emulator: &Emulator, number: u16) -> TcpStream {
    let port = emulator.port_in_place_of(number).unwrap();
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    // One that is refused may be gone already.
    let _ = stream.write_all(&framed(b'v', &[]));
    stream
}

/// Whether a connection is served: it gets a byte, and not the end.
fn is_served(stream: &mut TcpStream) -> bool {
    matches!(stream.read(&mut [0]), Ok(1))
}

/// Waits until only so many connections are left.
fn await_count(emulator: &Emulator, count: usize) {
    let began = Instant::now();
    while emulator.connection_count() > count {
        assert!(began.elapsed() < PATIENCE, "connections that never end");
        thread::sleep(Duration::from_millis(1));
    }
}

/// A client in lockstep: it writes after every package, and the clock waits for it.
struct Partner {
    stream: TcpStream,
    cycle: Option<i64>,
}

impl Partner {
    fn new(emulator: &Emulator) -> Self {
        let mut stream = connect(emulator, 30_004);
        stream.set_nodelay(true).unwrap();
        let asked = [
            framed(b'V', &[0, 2]),
            outputs("timestamp"),
            framed(b'I', b"input_int_register_24"),
            framed(b'S', &[]),
        ];
        stream.write_all(&asked.concat()).unwrap();
        let mut partner = Self {
            stream,
            cycle: None,
        };
        while partner.package().0 != b'S' {}
        partner
    }

    fn package(&mut self) -> (u8, Vec<u8>) {
        let mut header = [0; 3];
        self.stream.read_exact(&mut header).unwrap();
        let size = usize::from(u16::from_be_bytes([header[0], header[1]]));
        let mut payload = vec![0; size - 3];
        self.stream.read_exact(&mut payload).unwrap();
        (header[2], payload)
    }

    /// Takes so many packages, none of which may be missing.
    #[allow(clippy::cast_possible_truncation)] // Some thousand cycles.
    fn take_every(&mut self, count: u32) {
        for _ in 0..count {
            let (kind, payload) = self.package();
            assert_eq!(kind, b'U');
            let timestamp = f64::from_be_bytes(payload[1..].try_into().unwrap());
            let cycle = (timestamp * 500.0).round() as i64;
            if let Some(before) = self.cycle.replace(cycle) {
                assert_eq!(cycle, before + 1, "a package is missing");
            }
            let answer = framed(b'U', &[1, 0, 0, 0, 1]);
            self.stream.write_all(&answer).unwrap();
        }
    }
}

#[test]
fn two_hundred_clients_of_every_port_and_deaf_ones_cost_a_good_client_no_package() {
    let _turn = turn();
    let emulator = emulator();
    let mut partner = Partner::new(&emulator);
    partner.take_every(100);
    for number in PORTS {
        let mut crowd: Vec<TcpStream> = (0..200).map(|_| connect(&emulator, number)).collect();
        // From here on, a quarter reads what it gets; RTDE gives nothing unasked.
        if number == 30_004 {
            let asked = [
                framed(b'V', &[0, 2]),
                outputs("timestamp,target_q"),
                framed(b'S', &[]),
            ];
            for stream in &mut crowd {
                stream.write_all(&asked.concat()).unwrap();
            }
        }
        partner.take_every(50);
        let readers = &mut crowd[..50];
        for stream in readers {
            assert!(is_served(stream), "a client of port {number} is not served");
        }
        partner.take_every(150);
        drop(crowd);
        await_count(&emulator, 1);
    }
    partner.take_every(100);
}

#[test]
fn above_the_limit_a_port_says_so_and_closes_and_the_others_are_as_before() {
    let _turn = turn();
    let emulator = emulator();
    for number in [30_004, 29_999, 30_002] {
        let mut crowd: Vec<TcpStream> = (0..300).map(|_| connect(&emulator, number)).collect();
        let served = crowd.iter_mut().map(is_served).filter(|served| *served);
        assert_eq!(served.count(), 256, "port {number}");
        let lines = emulator.log_lines();
        let said = lines
            .iter()
            .filter(|line| line.ends_with("port: connection refused: too many"));
        assert!(said.count() >= 44, "{lines:#?}");
        // Another port has room, and so has this one as soon as somebody leaves.
        assert!(is_served(&mut connect(&emulator, 30_001)));
        drop(crowd);
        await_count(&emulator, 0);
        assert!(is_served(&mut connect(&emulator, number)));
        await_count(&emulator, 0);
    }
}

/// Threads and file handles of this process, where the system tells.
fn resources() -> Option<[usize; 2]> {
    let count = |folder: &str| Some(std::fs::read_dir(folder).ok()?.count());
    Some([count("/proc/self/task")?, count("/proc/self/fd")?])
}

#[test]
fn whoever_comes_and_goes_leaves_no_thread_and_no_handle_behind() {
    let _turn = turn();
    let emulator = emulator();
    let mut before = None;
    // The first round is there for what stays for good.
    for round in 0..4 {
        for number in PORTS {
            for client in 0..50 {
                let mut stream = connect(&emulator, number);
                match client % 4 {
                    0 => assert!(is_served(&mut stream)),
                    1 => stream.shutdown(std::net::Shutdown::Write).unwrap(),
                    2 => stream.write_all(&[0, 2]).unwrap(),
                    _ => {}
                }
            }
        }
        // One more for each port: all before it have been let in.
        for number in PORTS {
            assert!(is_served(&mut connect(&emulator, number)));
        }
        await_count(&emulator, 0);
        let began = Instant::now();
        if round == 0 {
            thread::sleep(Duration::from_millis(100));
            before = resources();
        }
        // A thread is gone a moment after its connection.
        while resources() > before {
            assert!(
                began.elapsed() < PATIENCE,
                "{:?} instead of {before:?}",
                resources()
            );
            thread::sleep(Duration::from_millis(10));
        }
    }
}
