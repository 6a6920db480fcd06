//! Hosts that are none, and servers that are no controller: each is told in one sentence, and none
//! keeps the command waiting for ever.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::thread;
use std::time::Duration;

use super::process::{Running, empty_folder, paper, say};

/// The controller's ports that commands connect to.
const PORTS: [u16; 3] = [30_004, 30_002, 29_999];

/// What a stranger does with a connection.
type Manners = fn(TcpStream) -> std::io::Result<()>;

fn silent(mut stream: TcpStream) -> std::io::Result<()> {
    std::io::copy(&mut stream, &mut std::io::sink()).map(|_| ())
}

/// At once, at the end of its scope.
fn closes(mut stream: TcpStream) -> std::io::Result<()> {
    stream.flush()
}

fn http(mut stream: TcpStream) -> std::io::Result<()> {
    let _ = stream.read(&mut [0; 1024])?;
    stream.write_all(b"HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n")
}

fn ssh(mut stream: TcpStream) -> std::io::Result<()> {
    stream.write_all(b"SSH-2.0-OpenSSH_9.6\r\n")?;
    silent(stream)
}

fn repeats(mut stream: TcpStream, bytes: &[u8]) -> std::io::Result<()> {
    loop {
        stream.write_all(bytes)?;
        thread::sleep(Duration::from_millis(50));
    }
}

fn zeros(stream: TcpStream) -> std::io::Result<()> {
    repeats(stream, &[0; 1000])
}

fn noise(stream: TcpStream) -> std::io::Result<()> {
    let bytes: Vec<u8> = (1..=1000_u32)
        .map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()[1] | 1)
        .collect();
    repeats(stream, &bytes)
}

/// One byte after another of a package, or line, that never ends.
fn drips(stream: TcpStream) -> std::io::Result<()> {
    repeats(stream, &[255])
}

/// Good text messages, and never an answer.
fn chats(stream: TcpStream) -> std::io::Result<()> {
    repeats(stream, b"\0\x0aM\x02hi\x02me\x03")
}

/// A dashboard that says one thing, whatever it is asked.
fn greets(stream: TcpStream) -> std::io::Result<()> {
    repeats(stream, b"Connected: Universal Robots Dashboard Server\n")
}

/// Serves all ports of a controller at some offset; returns it.
fn stranger(manners: Manners) -> u16 {
    for offset in (20_001..32_000).step_by(29) {
        let listeners: Vec<TcpListener> = PORTS
            .iter()
            .filter_map(|port| TcpListener::bind(("127.0.0.1", port + offset)).ok())
            .collect();
        if listeners.len() < PORTS.len() {
            continue;
        }
        for listener in listeners {
            thread::spawn(move || {
                for stream in listener.incoming().flatten() {
                    // It ends as it likes.
                    thread::spawn(move || manners(stream));
                }
            });
        }
        return offset;
    }
    panic!("no free ports");
}

#[test]
fn a_server_that_is_no_controller_is_told_in_one_sentence_and_keeps_nobody_waiting() {
    let folder = empty_folder("strangers");
    let servers: [(&str, Manners); 9] = [
        ("silent", silent),
        ("closes", closes),
        ("http", http),
        ("ssh", ssh),
        ("zeros", zeros),
        ("noise", noise),
        ("drips", drips),
        ("chats", chats),
        ("greets", greets),
    ];
    let example = paper("example2");
    let example = example.display();
    for (name, manners) in servers {
        let offset = stranger(manners);
        let commands = [
            "preflight 127.0.0.1 --seconds 0.2".to_owned(),
            "recover 127.0.0.1".to_owned(),
            format!("run {example} --robot 127.0.0.1 --quiet --out out"),
            format!("run {example} --robot 127.0.0.1 --quiet --dry-run --out out"),
            format!("run {example} --robot 127.0.0.1 --quiet --power-on --out out"),
        ];
        // All at once: each may take its time-out.
        let running = commands.map(|command| {
            let out = command.replace("--out out", &format!("--out {name}{}", command.len()));
            let line = format!("{out} --port-offset {offset}");
            (Running::start(&folder, &line), line)
        });
        for (running, line) in running {
            let said = running.wait();
            assert_eq!(said.status, Some(1), "{name}, {line}: {said:#?}");
            let fault = said.stderr.strip_prefix("error: ").unwrap_or_default();
            let named = ["link-lost: ", "protocol: "]
                .iter()
                .any(|name| fault.starts_with(name));
            assert!(named, "{name}, {line}: {said:#?}");
            assert_eq!(said.stderr.lines().count(), 1, "{name}, {line}: {said:#?}");
            let asks = fault.contains("is it a UR controller") || fault.contains("answers '");
            assert!(asks, "{name}, {line}: no hint in {said:#?}");
        }
    }
}

#[test]
fn a_host_that_cannot_be_one_is_bad_input() {
    let folder = empty_folder("no host");
    let example = paper("example2");
    for host in ["127.0.0.1:30004", "http://127.0.0.1", "[::1]", "a/b"] {
        for command in [
            format!("preflight {host}"),
            format!("recover {host}"),
            format!("run {} --robot {host} --out out", example.display()),
        ] {
            let said = say(&folder, &command);
            assert_eq!(said.status, Some(2), "{command}: {said:#?}");
            let begins = format!("error: '{host}' is no host: give the controller's name");
            assert!(said.stderr.starts_with(&begins), "{command}: {said:#?}");
        }
    }
}

#[test]
fn what_cannot_be_emulated_or_looked_at_is_bad_input() {
    let folder = empty_folder("bad emulator");
    // Taken, and not by this emulator.
    let taken = stranger(silent);
    for (line, says) in [
        (
            "emulate --fault explode",
            "--fault 'explode': unknown fault 'explode'; there are: protective stop",
        ),
        ("emulate --fault drop=2", "unknown fault 'drop=2'"),
        ("emulate --port-offset 40000", "no port exceeds 65535"),
        (
            "emulate --listen 192.0.2.1",
            "listen on an address of this computer",
        ),
        (
            &format!("emulate --port-offset {taken}"),
            "another program holds it",
        ),
        (
            "preflight 127.0.0.1 --rate-hz 0",
            "--rate-hz 0: from 1 to 1000 Hz",
        ),
        (
            "preflight 127.0.0.1 --rate-hz nan",
            "--rate-hz NaN: from 1 to 1000 Hz",
        ),
        (
            "preflight 127.0.0.1 --seconds 0",
            "--seconds 0: from 0.1 to 86400",
        ),
    ] {
        let said = say(&folder, line);
        assert_eq!(said.status, Some(2), "{line}: {said:#?}");
        assert!(said.stderr.contains(says), "{line}: {said:#?}");
    }
}
