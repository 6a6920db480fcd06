//! A controller that only records: it reads and writes bytes by hand, so that it shares no mistake
//! with the wire format under test, and it has no arm.

pub mod dashboard;

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::mpsc::{Receiver, channel};
use std::thread::{self, JoinHandle};

/// What a driver wrote into the input registers with one package.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    pub counter: i32,
    pub command: i32,
    /// Whether a fault is given as the reason of a stop.
    pub by_fault: i32,
    pub q: [f64; 6],
    pub qd: [f64; 6],
    /// Lookahead, gain, and time of `servoj`.
    pub servoj: [f64; 3],
}

/// How the stub behaves.
#[derive(Clone)]
pub struct Behaviour {
    pub q: [f64; 6],
    /// Major and minor version.
    pub version: (u32, u32),
    /// Sends every byte in a segment of its own.
    pub byte_by_byte: bool,
    /// Answers so many requests for inputs with this list instead of the types.
    pub input_types: Option<(usize, String)>,
    /// Packages sent at once where one is due.
    pub packages_at_once: usize,
    /// Sends packages on its own, one a millisecond, until the driver goes away.
    pub streams: bool,
    /// Packages that go by before the program that came in runs.
    pub program_starts_after: u32,
    /// How the outputs are from the beginning.
    pub from_start: Option<Change>,
    /// Happens instead of the program's stop on command.
    pub at_stop: Option<Change>,
    /// Changes the outputs from the given reference on.
    pub after: Option<(i32, Change)>,
}

impl Default for Behaviour {
    fn default() -> Self {
        Self {
            q: [0.1, -1.5, 1.2, -0.4, 0.7, 0.0],
            version: (5, 13),
            byte_by_byte: false,
            input_types: None,
            packages_at_once: 1,
            streams: false,
            program_starts_after: 0,
            from_start: None,
            at_stop: None,
            after: None,
        }
    }
}

/// Something that happens to the stub.
pub type Change = fn(&mut Outputs);

/// What the stub says of itself.
#[derive(Clone, Debug)]
pub struct Outputs {
    pub timestamp: f64,
    pub runtime_state: u32,
    pub robot_mode: i32,
    pub safety_bits: u32,
    pub robot_bits: u32,
    pub speed_slider: f64,
    pub phase: i32,
    pub session: i32,
    pub actual_q: Option<[f64; 6]>,
    /// A program that came in, and the packages until it runs.
    program: Option<(i32, u32)>,
    /// What the link comes to.
    pub link: LinkEnd,
}

/// What the link comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkEnd {
    None,
    /// The controller closes the connection.
    Closed,
    /// It reads on, but says nothing any more.
    Silent,
    /// It sends what is no package.
    Garbage,
    /// A package of outputs lacks its last byte, and nothing follows.
    Short,
    /// It resets the connection once more was written to it.
    Reset,
}

pub struct Stub {
    pub rtde_port: u16,
    pub script_port: u16,
    thread: JoinHandle<Vec<Written>>,
}

impl Stub {
    pub fn start(behaviour: Behaviour) -> Self {
        let rtde = TcpListener::bind("127.0.0.1:0").unwrap();
        let script = TcpListener::bind("127.0.0.1:0").unwrap();
        let rtde_port = rtde.local_addr().unwrap().port();
        let script_port = script.local_addr().unwrap().port();
        let (send, sessions) = channel();
        // Ends with the test process if no program ever comes.
        thread::spawn(move || {
            for stream in script.incoming() {
                let session = read_session(stream.unwrap());
                if send.send(session).is_err() {
                    break;
                }
            }
        });
        let thread = thread::spawn(move || serve(&behaviour, &rtde, &sessions));
        Self {
            rtde_port,
            script_port,
            thread,
        }
    }

    /// All that was written until the driver closed the connection.
    pub fn written(self) -> Vec<Written> {
        self.thread.join().unwrap()
    }
}

/// The session number in the program that comes in; none in the one that clears the latch.
fn read_session(mut stream: TcpStream) -> Option<i32> {
    let mut text = String::new();
    let mut buffer = [0; 512];
    while !text.ends_with("\nend\n") {
        let size = stream.read(&mut buffer).unwrap();
        assert!(size > 0, "the program has no end");
        text.push_str(std::str::from_utf8(&buffer[..size]).unwrap());
    }
    let clears = "def conik_rearm():\n  write_output_integer_register(24, 0)\nend\n";
    if text == clears {
        return None;
    }
    let line = text
        .lines()
        .find(|line| line.contains("session ="))
        .unwrap();
    Some(line.split('=').nth(1).unwrap().trim().parse().unwrap())
}

fn serve(
    behaviour: &Behaviour,
    listener: &TcpListener,
    sessions: &Receiver<Option<i32>>,
) -> Vec<Written> {
    let (mut stream, _) = listener.accept().unwrap();
    stream.set_nodelay(true).unwrap();
    let mut written = Vec::new();
    let mut refused = 0;
    let mut outputs = Outputs {
        timestamp: 60.0,
        runtime_state: 1,
        robot_mode: 7,
        safety_bits: 1,
        robot_bits: 1,
        speed_slider: 1.0,
        phase: 0,
        session: 0,
        actual_q: None,
        program: None,
        link: LinkEnd::None,
    };
    if let Some(change) = behaviour.from_start {
        change(&mut outputs);
    }
    while let Some((kind, payload)) = read_package(&mut stream) {
        let mut replies = Vec::new();
        match kind {
            b'V' => replies.push((b'V', vec![u8::from(payload == [0, 2])])),
            b'v' => {
                let numbers = [behaviour.version.0, behaviour.version.1, 0, 0];
                let bytes = numbers.iter().flat_map(|number| number.to_be_bytes());
                replies.push((b'v', bytes.collect()));
            }
            b'O' => replies.push((
                b'O',
                [
                    &[1],
                    "DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D,UINT32,INT32,UINT32,UINT32,DOUBLE,DOUBLE,INT32,INT32"
                        .as_bytes(),
                ]
                .concat(),
            )),
            b'I' => {
                let types = format!("INT32,INT32,INT32{}", ",DOUBLE".repeat(15));
                let other = behaviour.input_types.clone();
                let other = other.filter(|(times, _)| refused < *times);
                refused += 1;
                let types = other.map_or(types, |(_, types)| types);
                replies.push((b'I', [&[1], types.as_bytes()].concat()));
            }
            b'S' => {
                replies.push((b'S', vec![1]));
                push_outputs(&mut replies, behaviour, &mut outputs);
            }
            b'U' => {
                let inputs = read_inputs(&payload);
                react(&mut outputs, behaviour, &inputs, sessions);
                written.push(inputs);
                match outputs.link {
                    LinkEnd::None => push_outputs(&mut replies, behaviour, &mut outputs),
                    LinkEnd::Closed => return written,
                    LinkEnd::Silent => {}
                    LinkEnd::Garbage => replies.push((b'?', vec![0; 5])),
                    LinkEnd::Short => {
                        push_outputs(&mut replies, behaviour, &mut outputs);
                        for (_, payload) in &mut replies {
                            payload.pop();
                        }
                        outputs.link = LinkEnd::Silent;
                    }
                    LinkEnd::Reset => {
                        push_outputs(&mut replies, behaviour, &mut outputs);
                        for (kind, payload) in replies {
                            send(&mut stream, behaviour, kind, &payload).unwrap();
                        }
                        // Closing with bytes unread resets.
                        let _ = stream.peek(&mut [0]);
                        return written;
                    }
                }
            }
            other => panic!("the driver sent a package of type {other}"),
        }
        for (kind, payload) in replies {
            if send(&mut stream, behaviour, kind, &payload).is_err() {
                return written;
            }
        }
        if kind == b'S' && behaviour.streams {
            stream_outputs(&mut stream, behaviour, &mut outputs, sessions);
        }
    }
    written
}

fn stream_outputs(
    stream: &mut TcpStream,
    behaviour: &Behaviour,
    outputs: &mut Outputs,
    programs: &Receiver<Option<i32>>,
) {
    loop {
        if let Ok(None) = programs.try_recv() {
            outputs.phase = 0;
        }
        thread::sleep(std::time::Duration::from_millis(1));
        let mut packages = Vec::new();
        push_outputs(&mut packages, behaviour, outputs);
        for (kind, payload) in packages {
            if send(stream, behaviour, kind, &payload).is_err() {
                return;
            }
        }
    }
}

/// The servo program's share in the outputs.
fn react(
    outputs: &mut Outputs,
    behaviour: &Behaviour,
    inputs: &Written,
    sessions: &Receiver<Option<i32>>,
) {
    if let Ok(Some(session)) = sessions.try_recv() {
        outputs.program = Some((session, behaviour.program_starts_after));
    }
    if let Some((_, left)) = &mut outputs.program
        && *left > 0
    {
        *left -= 1;
    } else if let Some((session, _)) = outputs.program.take() {
        outputs.session = session;
        outputs.phase = 1;
        outputs.runtime_state = 2;
        outputs.robot_bits = 3;
    }
    match inputs.command {
        1 => outputs.phase = 2,
        2 if behaviour.at_stop.is_some() => behaviour.at_stop.iter().for_each(|it| it(outputs)),
        2 => {
            outputs.phase = if inputs.by_fault == 1 { 6 } else { 3 };
            outputs.runtime_state = 1;
            outputs.robot_bits = 1;
        }
        _ => {}
    }
    if let Some((reference, change)) = behaviour.after
        && inputs.command == 1
        && inputs.counter == reference
    {
        change(outputs);
    }
}

fn push_outputs(replies: &mut Vec<(u8, Vec<u8>)>, behaviour: &Behaviour, outputs: &mut Outputs) {
    for _ in 0..behaviour.packages_at_once {
        outputs.timestamp += 0.008;
        let mut bytes = vec![1];
        bytes.extend(outputs.timestamp.to_be_bytes());
        let actual = outputs.actual_q.unwrap_or(behaviour.q);
        for q in [behaviour.q, actual] {
            bytes.extend(q.iter().flat_map(|angle| angle.to_be_bytes()));
        }
        bytes.extend([0; 48]);
        bytes.extend(outputs.runtime_state.to_be_bytes());
        bytes.extend(outputs.robot_mode.to_be_bytes());
        bytes.extend(outputs.safety_bits.to_be_bytes());
        bytes.extend(outputs.robot_bits.to_be_bytes());
        bytes.extend(1.0_f64.to_be_bytes());
        bytes.extend(outputs.speed_slider.to_be_bytes());
        bytes.extend(outputs.phase.to_be_bytes());
        bytes.extend(outputs.session.to_be_bytes());
        replies.push((b'U', bytes));
    }
}

fn read_inputs(payload: &[u8]) -> Written {
    assert_eq!(payload.len(), 1 + 12 + 120, "size of an input package");
    assert_eq!(payload[0], 1, "recipe");
    let int = |at: usize| i32::from_be_bytes(payload[at..at + 4].try_into().unwrap());
    let double = |at: usize| f64::from_be_bytes(payload[at..at + 8].try_into().unwrap());
    let six = |from: usize| std::array::from_fn(|joint| double(from + 8 * joint));
    Written {
        counter: int(1),
        command: int(5),
        by_fault: int(9),
        q: six(13),
        qd: six(61),
        servoj: [double(109), double(117), double(125)],
    }
}

fn read_package(stream: &mut TcpStream) -> Option<(u8, Vec<u8>)> {
    let mut header = [0; 3];
    stream.read_exact(&mut header).ok()?;
    let size = usize::from(u16::from_be_bytes([header[0], header[1]]));
    let mut payload = vec![0; size - 3];
    stream.read_exact(&mut payload).ok()?;
    Some((header[2], payload))
}

fn send(
    stream: &mut TcpStream,
    behaviour: &Behaviour,
    kind: u8,
    payload: &[u8],
) -> std::io::Result<()> {
    let size = u16::try_from(payload.len() + 3).unwrap();
    let bytes = [&size.to_be_bytes(), &[kind][..], payload].concat();
    let portion = if behaviour.byte_by_byte {
        1
    } else {
        bytes.len()
    };
    for bytes in bytes.chunks(portion) {
        stream.write_all(bytes)?;
    }
    Ok(())
}
