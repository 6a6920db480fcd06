//! Sockets and threads: who listens, who reads, who writes.
//!
//! One thread accepts on each port and ends last, after the threads of its connections. An RTDE
//! connection has one thread that reads and one that writes, a script connection one that reads.

use super::config::EmulatorError;
use super::dashboard;
use super::lock;
use super::outbox::Outbox;
use super::script_port::ScriptReader;
use super::state_message;
use super::world::{Hears, Shared};
use crate::wire::FrameReader;
use std::io::{ErrorKind, Read, Write};
use std::net::{IpAddr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// How often a port looks for a new connection; it also bounds how long the end takes.
const ACCEPT_EVERY: Duration = Duration::from_millis(2);

/// A client that has read nothing for so long is gone.
const WRITE_TIMEOUT: Duration = Duration::from_secs(10);

/// The longest line that the dashboard takes.
const LONGEST_LINE: usize = 4096;

/// Opens a port; 0 is any free one.
pub(super) fn listen(address: IpAddr, port: u16) -> Result<(TcpListener, u16), EmulatorError> {
    let failed = |cause| EmulatorError::Listen {
        address,
        port,
        cause,
    };
    let listener = TcpListener::bind(SocketAddr::new(address, port)).map_err(failed)?;
    // Without it, a thread that accepts could only be ended by one more connection.
    listener.set_nonblocking(true).map_err(failed)?;
    let number = listener.local_addr().map_err(failed)?.port();
    Ok((listener, number))
}

/// What a port speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Service {
    Rtde,
    /// The state as the primary and secondary ports send it; programs come in.
    State,
    StateReadOnly,
    RealTime,
    RealTimeReadOnly,
    Dashboard,
}

/// Starts to serve an open port.
pub(super) fn serve(
    shared: &Arc<Shared>,
    listener: TcpListener,
    service: Service,
) -> Result<JoinHandle<()>, EmulatorError> {
    let shared = Arc::clone(shared);
    thread::Builder::new()
        .name(format!("emulator {service:?}"))
        .spawn(move || accept(&shared, &listener, service))
        .map_err(EmulatorError::Thread)
}

fn accept(shared: &Arc<Shared>, listener: &TcpListener, service: Service) {
    let mut connections: Vec<JoinHandle<()>> = Vec::new();
    while !lock(&shared.world).is_closing {
        match listener.accept() {
            Ok((stream, _)) => connections.extend(spawn_connection(shared, stream, service)),
            // Nobody there, or a connection that broke before it was accepted.
            Err(_) => thread::sleep(ACCEPT_EVERY),
        }
        connections.retain(|thread| !thread.is_finished());
    }
    for thread in connections {
        // A thread that panicked has nothing left to end.
        let _ = thread.join();
    }
}

/// Starts the thread of a connection; one that cannot be served is closed.
fn spawn_connection(
    shared: &Arc<Shared>,
    stream: TcpStream,
    service: Service,
) -> Option<JoinHandle<()>> {
    // Some systems hand the listener's mode on to the connection.
    stream.set_nonblocking(false).ok()?;
    stream.set_nodelay(true).ok()?;
    stream.set_write_timeout(Some(WRITE_TIMEOUT)).ok()?;
    let id = lock(&shared.world).admit(&stream)?;
    let for_thread = Arc::clone(shared);
    let thread = thread::Builder::new()
        .name(format!("emulator connection {id}"))
        .spawn(move || {
            serve_connection(&for_thread, id, stream, service);
            lock(&for_thread.world).remove(id);
            for_thread.changed.notify_all();
        });
    if thread.is_err() {
        lock(&shared.world).remove(id);
    }
    thread.ok()
}

fn serve_connection(shared: &Shared, id: u64, stream: TcpStream, service: Service) {
    let outbox = {
        let mut world = lock(&shared.world);
        match service {
            Service::Rtde => world.add_client(id),
            Service::State | Service::StateReadOnly => {
                let outbox = world.add_listener(id, Hears::State);
                outbox.answer(state_message::version_message(shared.version));
                outbox
            }
            Service::RealTime | Service::RealTimeReadOnly => {
                world.add_listener(id, Hears::RealTime)
            }
            Service::Dashboard => {
                let outbox = world.add_listener(id, Hears::Nothing);
                outbox.answer(dashboard::GREETING.as_bytes().to_vec());
                outbox
            }
        }
    };
    let Ok(writing_end) = stream.try_clone() else {
        return;
    };
    thread::scope(|scope| {
        let writer = thread::Builder::new()
            .name(format!("emulator writer {id}"))
            .spawn_scoped(scope, || write_all_of(&outbox, writing_end, service));
        if writer.is_ok() {
            match service {
                Service::Rtde => read_packages(shared, id, stream),
                Service::State | Service::RealTime => read_scripts(shared, id, stream),
                Service::StateReadOnly | Service::RealTimeReadOnly => {
                    for_each_portion(stream, |_| true);
                }
                Service::Dashboard => read_lines(shared, id, &outbox, stream),
            }
        }
        outbox.close();
    });
}

fn write_all_of(outbox: &Outbox, mut stream: TcpStream, service: Service) {
    while let Some(bytes) = outbox.take() {
        if !write(outbox, &mut stream, &bytes, service) {
            break;
        }
    }
    // Wakes the thread that reads.
    let _ = stream.shutdown(Shutdown::Both);
}

/// Writes all bytes; `false` if the client is gone. Who only sends programs to the state ports
/// never reads them, and is waited for.
fn write(outbox: &Outbox, stream: &mut TcpStream, mut bytes: &[u8], service: Service) -> bool {
    while !bytes.is_empty() {
        let portion = bytes.len().min(outbox.portion());
        match stream.write(&bytes[..portion]) {
            Ok(0) => return false,
            Ok(size) => bytes = &bytes[size..],
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error)
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut)
                    && !matches!(service, Service::Rtde | Service::Dashboard)
                    && !outbox.is_closed() => {}
            Err(_) => return false,
        }
    }
    true
}

fn read_packages(shared: &Shared, id: u64, stream: TcpStream) {
    let mut reader = FrameReader::new();
    for_each_portion(stream, |bytes| {
        reader.push(bytes);
        loop {
            match reader.next_frame() {
                Ok(Some(frame)) => shared.handle(id, &frame),
                Ok(None) => return true,
                Err(error) => {
                    let line = format!("client {id}: connection closed: {error}");
                    lock(&shared.world).controller.note(&line);
                    return false;
                }
            }
        }
    });
}

fn read_scripts(shared: &Shared, id: u64, stream: TcpStream) {
    let mut reader = ScriptReader::default();
    for_each_portion(stream, |bytes| {
        if reader.push(bytes).is_err() {
            let line = format!("script client {id}: connection closed: program too long");
            lock(&shared.world).controller.note(&line);
            return false;
        }
        while let Some(program) = reader.next_program() {
            shared.run_script(&program);
        }
        true
    });
}

fn read_lines(shared: &Shared, id: u64, outbox: &Outbox, stream: TcpStream) {
    let mut waiting: Vec<u8> = Vec::new();
    for_each_portion(stream, |bytes| {
        waiting.extend_from_slice(bytes);
        while let Some(end) = waiting.iter().position(|byte| *byte == b'\n') {
            let line = String::from_utf8_lossy(&waiting[..end]).into_owned();
            waiting.drain(..=end);
            let said = dashboard::answer(&mut lock(&shared.world), &line);
            outbox.answer(format!("{said}\n").into_bytes());
            if said == dashboard::FAREWELL {
                outbox.finish();
            }
            shared.changed.notify_all();
        }
        if waiting.len() > LONGEST_LINE {
            let line = format!("dashboard client {id}: connection closed: line too long");
            lock(&shared.world).controller.note(&line);
        }
        waiting.len() <= LONGEST_LINE
    });
}

/// Hands over bytes as they come in until the client leaves or `go_on` says no.
fn for_each_portion(mut stream: TcpStream, mut go_on: impl FnMut(&[u8]) -> bool) {
    let mut buffer = [0; 4096];
    loop {
        match stream.read(&mut buffer) {
            Ok(0) => break,
            Ok(size) => {
                if !go_on(&buffer[..size]) {
                    break;
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => break,
        }
    }
    let _ = stream.shutdown(Shutdown::Both);
}
