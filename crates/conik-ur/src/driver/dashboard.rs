//! The controller's dashboard (port 29999): lines of text that switch the arm on and free it.

use super::config::UrConfig;
use super::connect::connect;
use super::fault;
use conik_sim::arm::ArmError;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;

/// A longer line is not the dashboard's.
const LONGEST_LINE: u64 = 4096;

/// A connection to the dashboard.
#[derive(Debug)]
pub(super) struct Dashboard {
    lines: BufReader<TcpStream>,
}

impl Dashboard {
    /// Connects, and waits for the dashboard's greeting.
    pub(super) fn connect(config: &UrConfig) -> Result<Self, ArmError> {
        let stream = connect(config, config.dashboard_port)?;
        let mut dashboard = Self {
            lines: BufReader::new(stream),
        };
        let greeting = dashboard.line("its greeting")?;
        if greeting.contains("Dashboard") {
            return Ok(dashboard);
        }
        let detail = format!(
            "port {} does not greet as a dashboard does: {greeting:?}",
            config.dashboard_port
        );
        Err(ArmError::new(fault::PROTOCOL, detail))
    }

    /// Says one line and returns what is answered.
    pub(super) fn ask(&mut self, question: &str) -> Result<String, ArmError> {
        self.lines
            .get_mut()
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

    fn line(&mut self, awaited: &str) -> Result<String, ArmError> {
        let mut line = String::new();
        let mut most = self.lines.by_ref().take(LONGEST_LINE);
        match most.read_line(&mut line) {
            Ok(_) if line.ends_with('\n') => Ok(line.trim().to_owned()),
            Ok(_) => {
                let detail = format!("the dashboard went away while '{awaited}' was awaited");
                Err(ArmError::new(fault::LINK_LOST, detail))
            }
            Err(error) => Err(lost(awaited, &error)),
        }
    }
}

fn lost(doing: &str, error: &std::io::Error) -> ArmError {
    let detail = format!("the dashboard was lost at '{doing}': {error}");
    ArmError::new(fault::LINK_LOST, detail)
}
