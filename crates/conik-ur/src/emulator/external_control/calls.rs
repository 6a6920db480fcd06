//! The sockets that the program opens towards its client, and the frames that come in on them.
//!
//! A thread dials, since that can take long; what comes in is read by the control cycle, without
//! waiting and never more than it has room for, so that nothing can pile up here.

use crate::emulator::lock;
use std::io::{ErrorKind, Read, Write};
use std::net::{IpAddr, SocketAddr, TcpStream};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Attempts for each socket, how long one may take, and the wait before the next.
const ATTEMPTS: u32 = 5;
const ATTEMPT_TIMEOUT: Duration = Duration::from_secs(1);
const BETWEEN_ATTEMPTS: Duration = Duration::from_millis(200);

/// What a socket is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    Trajectory,
    Commands,
    Setpoints,
}

/// A socket to open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Call {
    pub(super) purpose: Purpose,
    pub(super) host: IpAddr,
    pub(super) port: u16,
}

/// All sockets that one program opens.
#[derive(Debug)]
pub(in crate::emulator) struct Calls {
    list: Vec<Call>,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug)]
enum State {
    Wanted,
    Dialling,
    Open(Vec<Line>),
    Failed(String),
    /// Taken by the program, or not wanted any more.
    Over,
}

impl Calls {
    pub(super) fn new(list: Vec<Call>) -> Self {
        Self {
            list,
            state: Mutex::new(State::Wanted),
            changed: Condvar::new(),
        }
    }

    /// Whether nobody dials yet; whoever asks has to.
    pub(in crate::emulator) fn claim(&self) -> bool {
        let state = &mut *lock(&self.state);
        let wanted = matches!(state, State::Wanted);
        if wanted {
            *state = State::Dialling;
        }
        wanted
    }

    /// Opens all sockets, one after the other.
    pub(in crate::emulator) fn dial(&self) {
        let opened: Result<Vec<Line>, String> =
            self.list.iter().map(|call| self.open(*call)).collect();
        let state = &mut *lock(&self.state);
        if matches!(state, State::Dialling) {
            *state = match opened {
                Ok(lines) => State::Open(lines),
                Err(error) => State::Failed(error),
            };
        }
    }

    fn open(&self, call: Call) -> Result<Line, String> {
        let address = SocketAddr::new(call.host, call.port);
        let mut last = "given up".to_owned();
        for _ in 0..ATTEMPTS {
            if !matches!(*lock(&self.state), State::Dialling) {
                break;
            }
            let stream = TcpStream::connect_timeout(&address, ATTEMPT_TIMEOUT).and_then(|stream| {
                stream.set_nodelay(true)?;
                stream.set_nonblocking(true)?;
                Ok(stream)
            });
            match stream {
                Ok(stream) => return Ok(Line::new(call.purpose, stream)),
                Err(error) => last = error.to_string(),
            }
            self.pause();
        }
        Err(format!("{address} does not answer: {last}"))
    }

    /// Waits for the next attempt, or until there is none to make.
    fn pause(&self) {
        let state = lock(&self.state);
        let dialling = |state: &mut State| matches!(state, State::Dialling);
        let waited = self
            .changed
            .wait_timeout_while(state, BETWEEN_ATTEMPTS, dialling);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    /// The open sockets, once; `None` while they are not open yet, an error if they never will be.
    pub(super) fn take(&self) -> Result<Option<Vec<Line>>, String> {
        let state = &mut *lock(&self.state);
        match state {
            State::Wanted | State::Dialling | State::Over => Ok(None),
            State::Failed(error) => Err(std::mem::take(error)),
            State::Open(lines) => {
                let lines = std::mem::take(lines);
                *state = State::Over;
                Ok(Some(lines))
            }
        }
    }

    /// Ends the dialling, and closes what is open and was not taken.
    pub(super) fn cancel(&self) {
        *lock(&self.state) = State::Over;
        self.changed.notify_all();
    }
}

/// An open socket.
#[derive(Debug)]
pub(super) struct Line {
    pub(super) purpose: Purpose,
    stream: TcpStream,
    /// The bytes of a frame that is not whole yet.
    begun: Vec<u8>,
}

impl Line {
    fn new(purpose: Purpose, stream: TcpStream) -> Self {
        Self {
            purpose,
            stream,
            begun: Vec::new(),
        }
    }

    /// The next frame of so many numbers, if it is there; an error once the other side has left.
    pub(super) fn frame(&mut self, numbers: usize) -> Result<Option<Vec<i32>>, String> {
        let size = numbers * 4;
        while self.begun.len() < size {
            let mut buffer = [0; 256];
            let room = (size - self.begun.len()).min(buffer.len());
            match self.stream.read(&mut buffer[..room]) {
                Ok(0) => return Err("its client closed it".to_owned()),
                Ok(read) => self.begun.extend_from_slice(&buffer[..read]),
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(None),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error.to_string()),
            }
        }
        let (bytes, _) = self.begun.as_chunks::<4>();
        let frame = bytes.iter().map(|bytes| i32::from_be_bytes(*bytes));
        let frame = frame.collect();
        self.begun.clear();
        Ok(Some(frame))
    }

    /// Says a number, as far as that can be done at once.
    pub(super) fn say(&mut self, number: i32) {
        // A client that does not listen is the client's affair.
        let _ = self.stream.write(&number.to_be_bytes());
    }
}
