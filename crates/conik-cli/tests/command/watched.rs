//! A process that shows a run, and the clients that watch it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::protocol::Role;
use tungstenite::{Message, WebSocket};

use super::process::{Running, empty_folder};

/// Whoever is silent for longer than this will not speak any more. No verdict hangs on less.
const SILENT: Duration = Duration::from_secs(60);

/// A run whose page is served.
pub struct Watched {
    pub process: Running,
    /// `ADDRESS:PORT`, and what follows the path.
    pub host: String,
    pub query: String,
}

impl Watched {
    pub fn start(folder: &Path, line: &str) -> Self {
        let mut process = Running::start(folder, line);
        let out = process.child().stdout.take().unwrap();
        let mut line = String::new();
        BufReader::new(out).read_line(&mut line).unwrap();
        let address = line.trim_end().strip_prefix("http://").unwrap_or_else(|| {
            let mut said = String::new();
            let mut pipe = process.child().stderr.take().unwrap();
            pipe.read_to_string(&mut said).unwrap();
            panic!("no address: {line}{said}")
        });
        let (host, query) = address.split_once('/').unwrap();
        Self {
            host: host.to_owned(),
            query: query.to_owned(),
            process,
        }
    }

    /// A scenario that runs as long as it is watched.
    pub fn scenario(name: &str, scenario: &Path) -> Self {
        let folder = empty_folder(&format!("live-{name}"));
        Self::start(&folder, &format!("view --quiet {}", scenario.display()))
    }

    /// What `/recording.json` has.
    pub fn recording(&self) -> Value {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        let head = format!(
            "GET /recording.json HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
            self.host
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        serde_json::from_str(answer.split_once("\r\n\r\n").unwrap().1).unwrap()
    }

    pub fn handshake(&self, headers: &[&str]) -> (TcpStream, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(SILENT)).unwrap();
        let head = format!(
            "GET /live{} HTTP/1.1\r\n{}\r\n\r\n",
            self.query,
            headers.join("\r\n")
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = Vec::new();
        let mut byte = [0];
        while !answer.ends_with(b"\r\n\r\n") && stream.read(&mut byte).unwrap() == 1 {
            answer.push(byte[0]);
        }
        (stream, String::from_utf8(answer).unwrap())
    }

    pub fn headers(&self) -> Vec<String> {
        [
            &format!("Host: {}", self.host),
            "Connection: keep-alive, Upgrade",
            "Upgrade: websocket",
            "Sec-WebSocket-Version: 13",
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        ]
        .map(str::to_owned)
        .to_vec()
    }

    pub fn client(&self) -> Client {
        let headers = self.headers();
        let headers: Vec<&str> = headers.iter().map(String::as_str).collect();
        let (stream, answer) = self.handshake(&headers);
        assert!(answer.starts_with("HTTP/1.1 101"), "{answer}");
        // The key and its answer are those of RFC 6455, section 1.3.
        assert!(answer.contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), "{answer}");
        Client {
            socket: WebSocket::from_raw_socket(stream, Role::Client, None),
            id: 0,
            scene: Value::Null,
        }
    }
}

/// A program that watches.
pub struct Client {
    pub socket: WebSocket<TcpStream>,
    id: u64,
    /// The last one.
    pub scene: Value,
}

impl Client {
    pub fn next(&mut self) -> Value {
        loop {
            match self.socket.read().unwrap() {
                Message::Text(text) => {
                    let message: Value = serde_json::from_str(&text).unwrap();
                    if message["kind"] == "scene" {
                        self.scene = message.clone();
                    }
                    return message;
                }
                Message::Close(why) => panic!("closed: {why:?}"),
                _ => {}
            }
        }
    }

    /// The next message that is what is looked for.
    pub fn wait(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        loop {
            let message = self.next();
            if is_it(&message) {
                return message;
            }
        }
    }

    pub fn of_kind(&mut self, kind: &str) -> Value {
        self.wait(|message| message["kind"] == kind)
    }

    pub fn send(&mut self, mut message: Value) -> u64 {
        self.id += 1;
        message["id"] = json!(self.id);
        self.socket
            .send(Message::text(message.to_string()))
            .unwrap();
        self.id
    }

    /// Asks, and waits for the answer.
    pub fn ask(&mut self, message: Value) -> Value {
        let id = self.send(message);
        self.wait(|answer| answer["id"] == json!(id as f64))
    }

    #[track_caller]
    pub fn done(&mut self, message: Value) -> u64 {
        let answer = self.ask(message);
        assert_eq!(answer["error"], Value::Null, "{answer}");
        answer["revision"].as_u64().unwrap()
    }

    #[track_caller]
    pub fn refused(&mut self, message: Value) -> String {
        let answer = self.ask(message);
        answer["error"]
            .as_str()
            .unwrap_or_else(|| panic!("{answer}"))
            .to_owned()
    }

    /// All rows of a column until the next state in which this holds.
    pub fn column_until(&mut self, column: &str, is_it: impl Fn(&Value) -> bool) -> Vec<f64> {
        let mut rows = Vec::new();
        loop {
            let message = self.next();
            if message["kind"] == "ticks" {
                if message["reset"] == true {
                    rows.clear();
                }
                let values = if column == "t_s" {
                    &message["t_s"]
                } else {
                    &message["columns"][column]
                };
                rows.extend(values.as_array().unwrap().iter().filter_map(Value::as_f64));
            } else if message["kind"] == "state" && is_it(&message) {
                return rows;
            }
        }
    }
}
