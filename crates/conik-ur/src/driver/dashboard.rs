//! The controller's dashboard (port 29999): lines of text that switch the arm on and free it.

use super::config::UrConfig;
use super::connect::connect;
use super::fault;
use conik_sim::arm::ArmError;
use std::io::{Error, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// A longer line is not the dashboard's.
const LONGEST_LINE: usize = 4096;

/// Characters of a wrong greeting that are shown.
const SHOWN: usize = 60;

/// What to look at where no dashboard answers as one.
const HINT: &str = "; is it a UR controller, and this its dashboard port?";

/// A connection to the dashboard.
#[derive(Debug)]
pub(super) struct Dashboard {
    stream: TcpStream,
    /// What has come in and was not used yet.
    waiting: Vec<u8>,
    /// How long an answer may take.
    patience: Duration,
}

impl Dashboard {
    /// Connects, and waits for the dashboard's greeting.
    pub(super) fn connect(config: &UrConfig) -> Result<Self, ArmError> {
        let stream = connect(config, config.dashboard_port)?;
        let mut dashboard = Self {
            stream,
            waiting: Vec::new(),
            patience: config.link_timeout,
        };
        let greeting = dashboard.line("its greeting")?;
        if greeting.contains("Dashboard") {
            return Ok(dashboard);
        }
        let shown: String = greeting.chars().take(SHOWN).collect();
        let detail = format!(
            "port {} does not greet as a dashboard does: {shown:?}",
            config.dashboard_port
        );
        Err(ArmError::new(fault::PROTOCOL, detail + HINT))
    }

    /// Says one line and returns what is answered.
    pub(super) fn ask(&mut self, question: &str) -> Result<String, ArmError> {
        self.stream
            .write_all(format!("{question}\n").as_bytes())
            .map_err(|error| lost(question, &error))?;
        self.line(question)
    }

    /// Says one line that must be answered with words that begin like this.
    pub(super) fn order(&mut self, order: &str, done: &str) -> Result<(), ArmError> {
        let answer = self.ask(order)?;
        if answer.to_lowercase().starts_with(&done.to_lowercase()) {
            return Ok(());
        }
        let detail = format!("the dashboard answers '{order}' with: {answer}");
        Err(ArmError::new(fault::DASHBOARD_REFUSED, detail))
    }

    /// The next line, which must come within the patience however its bytes do.
    fn line(&mut self, awaited: &str) -> Result<String, ArmError> {
        let deadline = Instant::now() + self.patience;
        let mut buffer = [0; 512];
        loop {
            if let Some(end) = self.waiting.iter().position(|byte| *byte == b'\n') {
                let line = String::from_utf8_lossy(&self.waiting[..end]);
                let line = line.trim().to_owned();
                self.waiting.drain(..=end);
                return Ok(line);
            }
            if self.waiting.len() > LONGEST_LINE {
                let detail = format!("no line ends where '{awaited}' was awaited");
                return Err(ArmError::new(fault::PROTOCOL, detail + HINT));
            }
            if Instant::now() > deadline {
                return Err(lost(awaited, &ErrorKind::TimedOut.into()));
            }
            match self.stream.read(&mut buffer) {
                Ok(0) => {
                    let detail = format!("the dashboard went away while '{awaited}' was awaited");
                    return Err(ArmError::new(fault::LINK_LOST, detail + HINT));
                }
                Ok(size) => self.waiting.extend_from_slice(&buffer[..size]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(lost(awaited, &error)),
            }
        }
    }
}

fn lost(doing: &str, error: &Error) -> ArmError {
    let detail = match error.kind() {
        ErrorKind::WouldBlock | ErrorKind::TimedOut => {
            format!("the dashboard took too long where '{doing}' was awaited")
        }
        _ => format!("the dashboard was lost at '{doing}': {error}"),
    };
    ArmError::new(fault::LINK_LOST, detail + HINT)
}
