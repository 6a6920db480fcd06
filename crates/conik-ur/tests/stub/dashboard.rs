//! A dashboard that only records, and says of the arm what it is told to say.

use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::thread::{self, JoinHandle};

/// What the dashboard says of the arm.
#[derive(Clone, Copy)]
pub struct Panel {
    pub greeting: &'static str,
    pub model: &'static str,
    pub remote: &'static str,
    pub safety: &'static str,
    pub mode: &'static str,
    /// `STOPPED`, `PLAYING` or `PAUSED`.
    pub program: &'static str,
    /// How it takes `unlock protective stop`.
    pub unlocks: bool,
}

/// What a controller says that does not know a question.
pub const NOT_KNOWN: &str = "could not understand: 'it'";

pub const WELL: Panel = Panel {
    greeting: "Connected: Universal Robots Dashboard Server",
    model: "UR5",
    remote: "true",
    safety: "NORMAL",
    mode: "RUNNING",
    program: "STOPPED",
    unlocks: true,
};

pub struct Dashboard {
    pub port: u16,
    thread: JoinHandle<Vec<String>>,
}

impl Dashboard {
    /// A dashboard for one client.
    pub fn start(mut panel: Panel) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        let thread = thread::spawn(move || {
            let (mut stream, _) = listener.accept().unwrap();
            writeln!(stream, "{}", panel.greeting).unwrap();
            let mut orders = Vec::new();
            for line in BufReader::new(stream.try_clone().unwrap()).lines() {
                let Ok(line) = line else { break };
                let answer = match line.as_str() {
                    "get robot model" => panel.model.to_owned(),
                    "is in remote control" => panel.remote.to_owned(),
                    "safetymode" => format!("Safetymode: {}", panel.safety),
                    "robotmode" => format!("Robotmode: {}", panel.mode),
                    "programState" => format!("{} <unnamed>", panel.program),
                    order => {
                        orders.push(order.to_owned());
                        take(&mut panel, order).to_owned()
                    }
                };
                if writeln!(stream, "{answer}").is_err() {
                    break;
                }
            }
            orders
        });
        Self { port, thread }
    }

    /// What it was told until the client left, questions left out.
    pub fn orders(self) -> Vec<String> {
        self.thread.join().unwrap()
    }
}

fn take(panel: &mut Panel, order: &str) -> &'static str {
    match order {
        "close safety popup" => "closing safety popup",
        "unlock protective stop" if !panel.unlocks => {
            "Cannot unlock protective stop until 5s after occurrence."
        }
        "unlock protective stop" => {
            panel.safety = "NORMAL";
            "Protective stop releasing"
        }
        "power on" => {
            panel.mode = "IDLE";
            "Powering on"
        }
        "brake release" => {
            panel.mode = "RUNNING";
            "Brake releasing"
        }
        "stop" => {
            panel.program = "STOPPED";
            "Stopped"
        }
        _ => NOT_KNOWN,
    }
}
