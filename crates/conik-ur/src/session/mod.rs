//! The client's side of an RTDE connection: who says what when, over any stream of bytes.
//!
//! The order is fixed: protocol version, controller version ([`Session::greet`]), outputs, inputs,
//! start, then data in both directions. Errors name the field and what to do about it.

use crate::wire::frame::FrameReader;
use crate::wire::value::{decode, encode};
use crate::wire::{
    ControllerVersion, FieldType, PROTOCOL_VERSION, Reply, Request, TextMessage, Value,
};
use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

mod error;
mod recipe;

pub use error::SessionError;
use recipe::{Recipe, names_of};

/// Bytes taken from the stream at once: many packages, so that a late reader catches up.
const READ_SIZE: usize = 1 << 16;

/// Packages that may come before an answer; more mean that none will come.
const PATIENCE: usize = 10_000;

/// The newest values of the outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Latest {
    /// One value per output, in the order subscribed.
    pub values: Vec<Value>,
    /// Older packages that were waiting and were passed over.
    pub passed_over: u64,
}

/// One RTDE connection.
#[derive(Debug)]
pub struct Session<S> {
    stream: S,
    reader: FrameReader,
    buffer: Vec<u8>,
    version: ControllerVersion,
    outputs: Recipe,
    inputs: Recipe,
    last_text: Option<TextMessage>,
    /// How long an answer, or outputs, may take, whatever else comes in meanwhile.
    patience: Duration,
    deadline: Option<Instant>,
}

impl<S: Read + Write> Session<S> {
    /// Agrees on the protocol and asks for the controller's version.
    pub fn greet(stream: S) -> Result<Self, SessionError> {
        Self::greet_within(stream, Duration::MAX)
    }

    /// As [`greet`](Self::greet); from here on, whoever sends on and on but never what is awaited
    /// counts as lost after `patience`. A stream that falls silent must end its reads by itself.
    pub fn greet_within(stream: S, patience: Duration) -> Result<Self, SessionError> {
        let mut session = Self {
            stream,
            reader: FrameReader::new(),
            buffer: vec![0; READ_SIZE],
            version: ControllerVersion {
                major: 0,
                minor: 0,
                bugfix: 0,
                build: 0,
            },
            outputs: Recipe::default(),
            inputs: Recipe::default(),
            last_text: None,
            patience,
            deadline: None,
        };
        let question = Request::ProtocolVersion(PROTOCOL_VERSION);
        let answer = session
            .ask("protocol version", &question)
            .map_err(SessionError::at_first_word)?;
        match answer {
            Reply::ProtocolVersion(true) => {}
            Reply::ProtocolVersion(false) => return Err(SessionError::ProtocolRefused),
            _ => return Err(SessionError::OutOfOrder("protocol version")),
        }
        match session.ask("controller version", &Request::ControllerVersion)? {
            Reply::ControllerVersion(version) => session.version = version,
            _ => return Err(SessionError::OutOfOrder("controller version")),
        }
        Ok(session)
    }

    /// The version of the controller's software.
    pub fn version(&self) -> ControllerVersion {
        self.version
    }

    /// What the controller last said in words.
    pub fn last_text(&self) -> Option<&TextMessage> {
        self.last_text.as_ref()
    }

    /// Asks for these outputs `frequency_hz` times a second.
    pub fn subscribe(
        &mut self,
        frequency_hz: f64,
        fields: &[(String, FieldType)],
    ) -> Result<(), SessionError> {
        let names = names_of(fields);
        let request = Request::Outputs {
            frequency_hz,
            names,
        };
        match self.ask("outputs", &request)? {
            Reply::Outputs {
                recipe,
                fields: replies,
            } => {
                self.outputs = Recipe::agree(recipe, fields, &replies, self.version)?;
                Ok(())
            }
            _ => Err(SessionError::OutOfOrder("outputs")),
        }
    }

    /// Claims these inputs for this connection.
    pub fn claim(&mut self, fields: &[(String, FieldType)]) -> Result<(), SessionError> {
        match self.ask("inputs", &Request::Inputs(names_of(fields)))? {
            Reply::Inputs {
                recipe,
                fields: replies,
            } => {
                self.inputs = Recipe::agree(recipe, fields, &replies, self.version)?;
                Ok(())
            }
            _ => Err(SessionError::OutOfOrder("inputs")),
        }
    }

    /// Lets the outputs come.
    pub fn start(&mut self) -> Result<(), SessionError> {
        match self.ask("start", &Request::Start)? {
            Reply::Start(true) => Ok(()),
            Reply::Start(false) => Err(SessionError::StartRefused),
            _ => Err(SessionError::OutOfOrder("start")),
        }
    }

    /// Waits for outputs and returns the newest that are there.
    pub fn latest(&mut self) -> Result<Latest, SessionError> {
        self.deadline = Instant::now().checked_add(self.patience);
        let mut newest: Option<Vec<u8>> = None;
        let mut passed_over = 0;
        let mut more_may_wait = false;
        loop {
            while let Some(frame) = self.reader.next_frame()? {
                match Reply::from_frame(&frame)? {
                    Reply::Data { recipe, values } if recipe == self.outputs.number => {
                        passed_over += u64::from(newest.is_some());
                        newest = Some(values);
                    }
                    Reply::Text(message) => self.last_text = Some(message),
                    _ => return Err(SessionError::OutOfOrder("data")),
                }
            }
            match newest {
                Some(bytes) if !more_may_wait => {
                    let values = decode(&self.outputs.types, &bytes)?;
                    return Ok(Latest {
                        values,
                        passed_over,
                    });
                }
                _ => more_may_wait = self.receive()? == self.buffer.len(),
            }
        }
    }

    /// Sends values for the claimed inputs, in the order claimed.
    pub fn send(&mut self, values: &[Value]) -> Result<(), SessionError> {
        let values = encode(&self.inputs.types, values)?;
        self.request(&Request::Data {
            recipe: self.inputs.number,
            values,
        })
    }

    fn request(&mut self, request: &Request) -> Result<(), SessionError> {
        let bytes = request.to_frame()?.to_bytes()?;
        self.stream
            .write_all(&bytes)
            .map_err(|error| self.lost("writing to", &error))
    }

    /// Sends a request and waits for its answer; messages and data in between are not answers.
    fn ask(&mut self, awaited: &'static str, request: &Request) -> Result<Reply, SessionError> {
        self.request(request)?;
        self.deadline = Instant::now().checked_add(self.patience);
        for _ in 0..PATIENCE {
            match self.next_reply()? {
                Reply::Text(message) => self.last_text = Some(message),
                Reply::Data { .. } => {}
                reply => return Ok(reply),
            }
        }
        Err(SessionError::OutOfOrder(awaited))
    }

    fn next_reply(&mut self) -> Result<Reply, SessionError> {
        loop {
            if let Some(frame) = self.reader.next_frame()? {
                return Ok(Reply::from_frame(&frame)?);
            }
            self.receive()?;
        }
    }

    /// Waits for bytes and returns how many came.
    fn receive(&mut self) -> Result<usize, SessionError> {
        if self
            .deadline
            .is_some_and(|deadline| Instant::now() > deadline)
        {
            return Err(self.lost("reading from", &io::ErrorKind::TimedOut.into()));
        }
        loop {
            match self.stream.read(&mut self.buffer) {
                Ok(0) => {
                    let end =
                        io::Error::new(io::ErrorKind::UnexpectedEof, "it closed the connection");
                    return Err(self.lost("reading from", &end));
                }
                Ok(size) => {
                    self.reader.push(&self.buffer[..size]);
                    return Ok(size);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(self.lost("reading from", &error)),
            }
        }
    }

    /// Why the stream ended, with what the controller last said: often it said why.
    fn lost(&self, doing: &str, error: &io::Error) -> SessionError {
        let mut cause = match error.kind() {
            io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => {
                format!("{doing} the controller took too long")
            }
            _ => format!("{doing} the controller failed: {error}"),
        };
        if let Some(TextMessage { text, .. }) = &self.last_text {
            cause.push_str("; it last said: ");
            cause.push_str(text);
        }
        SessionError::Lost(cause)
    }
}
