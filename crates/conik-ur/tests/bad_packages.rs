//! What the emulated controller answers to packages that are wrong, or only look so. The answers
//! that the maker does not document are our choice: see docs/emulator.md.

use conik::JointVec;
use conik_ur::emulator::{Emulator, EmulatorConfig, Pace, Series};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// What comes back.
enum Answer {
    /// A text message of level 1 that holds this, and a line in the log with the same words.
    Fault(&'static str),
    /// A package of the same kind with these contents.
    Reply(&'static [u8]),
    /// Nothing, and it is taken.
    Nothing,
    /// As [`Self::Fault`], and the connection ends.
    Over(&'static str),
}

use Answer::{Fault, Nothing, Over, Reply};

/// A package, after those that come before it in good order.
struct Case {
    what: &'static str,
    before: Vec<Vec<u8>>,
    package: Vec<u8>,
    answer: Answer,
}

fn framed(kind: u8, payload: &[u8]) -> Vec<u8> {
    let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
    [&size, &[kind][..], payload].concat()
}

fn outputs(frequency_hz: f64, names: &str) -> Vec<u8> {
    framed(
        b'O',
        &[&frequency_hz.to_be_bytes(), names.as_bytes()].concat(),
    )
}

fn inputs(names: &str) -> Vec<u8> {
    framed(b'I', names.as_bytes())
}

/// Data for a recipe of an integer and a double.
fn data(recipe: u8, value: f64) -> Vec<u8> {
    framed(
        b'U',
        &[&[recipe][..], &[0, 0, 0, 7], &value.to_be_bytes()].concat(),
    )
}

#[allow(clippy::too_many_lines)] // A table.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |what, before: Vec<Vec<u8>>, package, answer| {
        cases.push(Case {
            what,
            before,
            package,
            answer,
        });
    };
    let two = || vec![inputs("input_int_register_24,input_double_register_24")];

    for (what, version, answer) in [
        ("version 0", 0_u16, 0_u8),
        ("version 3", 3, 0),
        ("version 65535", 65_535, 0),
        ("version 2 once more", 2, 1),
    ] {
        let answer: &'static [u8] = if answer == 1 { &[1] } else { &[0] };
        add(
            what,
            vec![],
            framed(b'V', &version.to_be_bytes()),
            Reply(answer),
        );
    }
    add(
        "a version of one byte",
        vec![],
        framed(b'V', &[2]),
        Fault("protocol version package is too short"),
    );
    add(
        "a version of three bytes",
        vec![],
        framed(b'V', &[0, 2, 0]),
        Fault("1 bytes too many"),
    );
    add(
        "a question with contents",
        vec![],
        framed(b'v', &[1]),
        Fault("1 bytes too many"),
    );

    for (what, frequency_hz, fault) in [
        (
            "no frequency",
            0.0,
            "output frequency 0 Hz; 1 to 500 Hz are possible",
        ),
        ("a negative frequency", -125.0, "output frequency -125 Hz"),
        ("a frequency below 1 Hz", 0.5, "output frequency 0.5 Hz"),
        (
            "a frequency above the rate",
            501.0,
            "output frequency 501 Hz",
        ),
        (
            "a frequency that is not a number",
            f64::NAN,
            "output frequency NaN Hz",
        ),
        (
            "an endless frequency",
            f64::INFINITY,
            "output frequency inf Hz",
        ),
    ] {
        add(
            what,
            vec![],
            outputs(frequency_hz, "timestamp"),
            Fault(fault),
        );
    }
    add(
        "outputs without a frequency",
        vec![],
        framed(b'O', b"time"),
        Fault("outputs package is too short"),
    );
    add(
        "no outputs",
        vec![],
        outputs(125.0, ""),
        Fault("the list of fields is empty"),
    );
    add(
        "nothing but commas",
        vec![],
        outputs(125.0, ",,,"),
        Fault("the list of fields is empty"),
    );
    add(
        "outputs that are no text",
        vec![],
        framed(b'O', &[&125_f64.to_be_bytes()[..], &[0xFF, 0xFE]].concat()),
        Fault("not UTF-8"),
    );
    let long = "timestamp,".repeat(204) + "target_q";
    assert_eq!(long.len(), 2048);
    add(
        "a list of 2049 bytes",
        vec![],
        outputs(125.0, &format!("{long}d")),
        Fault("the list of fields has 2049 bytes; 2048 are possible"),
    );
    add(
        "an unknown output",
        vec![],
        outputs(125.0, "target_w"),
        Reply(b"\0NOT_FOUND"),
    );
    add(
        "a good and an unknown output",
        vec![],
        outputs(125.0, "timestamp,target_w"),
        Reply(b"\0DOUBLE,NOT_FOUND"),
    );
    add(
        "a name with a space inside",
        vec![],
        outputs(125.0, "time stamp"),
        Reply(b"\0NOT_FOUND"),
    );
    add(
        "names with spaces around",
        vec![],
        outputs(125.0, " timestamp , robot_mode "),
        Reply(b"\x01DOUBLE,INT32"),
    );
    add(
        "outputs with a trailing comma",
        vec![],
        outputs(125.0, "timestamp,"),
        Reply(b"\x01DOUBLE"),
    );
    add(
        "an output twice",
        vec![],
        outputs(125.0, "timestamp,timestamp"),
        Reply(b"\x01DOUBLE,DOUBLE"),
    );
    add(
        "outputs for the second time",
        vec![outputs(125.0, "timestamp")],
        outputs(250.0, "robot_mode"),
        Reply(b"\x01INT32"),
    );

    add(
        "inputs with a trailing comma",
        vec![],
        inputs("input_int_register_24,"),
        Reply(b"\x01INT32"),
    );
    add(
        "an input twice",
        vec![],
        inputs("input_int_register_24,input_int_register_24"),
        Reply(b"\x01INT32,INT32"),
    );
    add(
        "an unknown input",
        vec![],
        inputs("input_int_register_48"),
        Reply(b"\0NOT_FOUND"),
    );
    add(
        "an output as an input",
        vec![],
        inputs("target_q"),
        Reply(b"\0NOT_FOUND"),
    );
    add(
        "an input that another client writes",
        vec![],
        inputs("input_int_register_30"),
        Reply(b"\0IN_USE"),
    );
    add(
        "no inputs",
        vec![],
        inputs(""),
        Fault("the list of fields is empty"),
    );
    add(
        "inputs that are no text",
        vec![],
        framed(b'I', &[0xC0]),
        Fault("not UTF-8"),
    );
    add(
        "a list of inputs of 5000 bytes",
        vec![],
        inputs(&"i".repeat(5000)),
        Fault("5000 bytes; 2048 are possible"),
    );
    add(
        "the 256th recipe",
        vec![inputs("input_int_register_24"); 255],
        inputs("input_int_register_24"),
        Fault("no more than 255 input recipes"),
    );

    add(
        "data of recipe 0",
        two(),
        data(0, 1.0),
        Fault("there is no input recipe 0"),
    );
    add(
        "data of an unknown recipe",
        two(),
        data(2, 1.0),
        Fault("there is no input recipe 2"),
    );
    add(
        "data before any recipe",
        vec![],
        data(1, 1.0),
        Fault("there is no input recipe 1"),
    );
    add(
        "data without a recipe",
        two(),
        framed(b'U', &[]),
        Fault("data package is too short"),
    );
    add(
        "data that end early",
        two(),
        framed(b'U', &[1, 0, 0, 0, 7]),
        Fault("data package is too short: 4 bytes where 12"),
    );
    add(
        "data that go on",
        two(),
        framed(b'U', &[[1].as_slice(), &[0; 13]].concat()),
        Fault("1 bytes too many"),
    );
    add(
        "data that are not a number",
        two(),
        data(1, f64::NAN),
        Fault("input 1 of recipe 1 is not a finite number"),
    );
    add(
        "endless data",
        two(),
        data(1, f64::NEG_INFINITY),
        Fault("not a finite number"),
    );
    add("data before the start", two(), data(1, 1.0), Nothing);

    add(
        "a start without outputs",
        vec![],
        framed(b'S', &[]),
        Reply(&[1]),
    );
    add(
        "a start with contents",
        vec![],
        framed(b'S', &[0]),
        Fault("1 bytes too many"),
    );
    add(
        "a pause before the start",
        vec![],
        framed(b'P', &[]),
        Reply(&[1]),
    );
    add(
        "a pause with contents",
        vec![],
        framed(b'P', &[0, 0]),
        Fault("2 bytes too many"),
    );

    add(
        "no text at all",
        vec![],
        framed(b'M', &[]),
        Fault("text package is too short"),
    );
    add(
        "a text longer than its package",
        vec![],
        framed(b'M', b"\xFFhi\x02me\x01"),
        Fault("text package is too short"),
    );
    add(
        "a source longer than its package",
        vec![],
        framed(b'M', b"\x02hi\xFFme\x01"),
        Fault("text package is too short"),
    );
    add(
        "a text without a level",
        vec![],
        framed(b'M', b"\x02hi\x02me"),
        Fault("text package is too short"),
    );
    add(
        "a text that goes on",
        vec![],
        framed(b'M', b"\x02hi\x02me\x01\x01"),
        Fault("1 bytes too many"),
    );
    add(
        "a text of odd bytes",
        vec![],
        framed(b'M', b"\x02\xFF\xFE\x00\x07"),
        Nothing,
    );

    add(
        "a type that does not exist",
        vec![],
        framed(b'?', &[]),
        Fault("unknown package type 63"),
    );
    add(
        "type 0",
        vec![],
        framed(0, &[1, 2, 3]),
        Fault("unknown package type 0"),
    );
    add(
        "the largest package",
        vec![],
        framed(255, &vec![7; 65_532]),
        Fault("unknown package type 255"),
    );
    add(
        "a size of 0",
        vec![],
        vec![0, 0, b'v'],
        Over("framing is lost"),
    );
    add("a size of 2", vec![], vec![0, 2], Over("framing is lost"));
    cases
}

struct Client(TcpStream);

impl Client {
    /// A client of version 2.
    fn new(emulator: &Emulator) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", emulator.rtde_port())).unwrap();
        // A guard against hanging only.
        stream
            .set_read_timeout(Some(Duration::from_secs(30)))
            .unwrap();
        let mut client = Self(stream);
        assert_eq!(client.ask(&framed(b'V', &[0, 2])), (b'V', vec![1]));
        client
    }

    fn ask(&mut self, package: &[u8]) -> (u8, Vec<u8>) {
        self.0.write_all(package).unwrap();
        self.package().expect("an answer")
    }

    /// The next package; `None` at the end of the stream.
    fn package(&mut self) -> Option<(u8, Vec<u8>)> {
        let mut header = [0; 3];
        self.0.read_exact(&mut header).ok()?;
        let size = usize::from(u16::from_be_bytes([header[0], header[1]]));
        let mut payload = vec![0; size - 3];
        self.0.read_exact(&mut payload).unwrap();
        Some((header[2], payload))
    }
}

/// The words of a text message of level 1.
fn words((kind, payload): (u8, Vec<u8>)) -> String {
    assert_eq!(kind, b'M', "{}", String::from_utf8_lossy(&payload));
    let length = usize::from(payload[0]);
    assert_eq!(payload[length + 1..], *b"\x04RTDE\x01");
    String::from_utf8(payload[1..=length].to_vec()).unwrap()
}

#[test]
fn every_bad_package_is_answered_noted_and_dropped() {
    let emulator = Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, JointVec::from([0.0; 6]))
    })
    .unwrap();
    let mut other = Client::new(&emulator);
    other.ask(&inputs("input_int_register_30"));
    // Its outputs are read at the end.
    other.ask(&outputs(500.0, "input_double_register_24"));
    let version = (b'v', [[0, 0, 0, 5], [0, 0, 0, 13], [0; 4], [0; 4]].concat());
    for Case {
        what,
        before,
        package,
        answer,
    } in cases()
    {
        let mut client = Client::new(&emulator);
        for package in &before {
            client.ask(package);
        }
        client.0.write_all(&package).unwrap();
        if let Reply(contents) = answer {
            assert_eq!(
                client.package(),
                Some((package[2], contents.to_vec())),
                "{what}"
            );
        }
        if let Fault(part) | Over(part) = answer {
            let said = words(
                client
                    .package()
                    .unwrap_or_else(|| panic!("{what}: no answer")),
            );
            assert!(said.contains(part), "{what}: {said}");
            let noted = emulator.log_lines().iter().any(|line| line.contains(&said));
            assert!(noted, "{what}: no line in the log says '{said}'");
        }
        if matches!(answer, Over(_)) {
            assert_eq!(client.package(), None, "{what}: the connection goes on");
        } else {
            let still_there = client.ask(&framed(b'v', &[]));
            assert_eq!(still_there, version, "{what}: nothing more is answered");
        }
    }
    // Of all the data only those before the start were good.
    assert_eq!(other.ask(&framed(b'S', &[])), (b'S', vec![1]));
    let value = other.package().unwrap().1;
    assert_eq!(value[1..], 1_f64.to_be_bytes(), "a bad package was taken");
}

#[test]
fn the_second_list_of_outputs_takes_the_place_of_the_first() {
    let emulator = Emulator::start(EmulatorConfig {
        pace: Pace::Lockstep,
        ..EmulatorConfig::new(Series::E, JointVec::from([0.0; 6]))
    })
    .unwrap();
    let mut client = Client::new(&emulator);
    client.ask(&outputs(500.0, "timestamp"));
    client.ask(&outputs(500.0, "robot_mode"));
    client.ask(&framed(b'S', &[]));
    assert_eq!(client.package(), Some((b'U', vec![1, 0, 0, 0, 7])));
    // A list with an unknown name is none: nothing comes any more.
    client.0.write_all(&outputs(500.0, "target_w")).unwrap();
    while client.package().expect("an answer").0 != b'O' {}
    client.0.write_all(&framed(b'v', &[])).unwrap();
    assert_eq!(client.package().map(|(kind, _)| kind), Some(b'v'));
}
