//! Sockets and threads: who listens, who reads, who writes.
//!
//! One thread accepts on each port and ends last, after the threads of its connections. An connection has
//! one thread that reads and one that writes.

use super::config::EmulatorError;
use super::inbound::{Inbound, Service, Then};
use super::lock;
use super::outbox::Outbox;
use super::world::Shared;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{IpAddr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// How often a port looks for a new connection; it also bounds how long the end takes.
const ACCEPT_EVERY: Duration = Duration::from_millis(2);

/// A client that has read nothing for so long is gone.
const WRITE_TIMEOUT: Duration = Duration::from_secs(10);

/// Connections to one port at a time; a real controller takes fewer.
const MOST_CONNECTIONS: usize = 256;

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
    let mut is_short = false;
    while !lock(&shared.world).is_closing {
        connections.retain(|thread| !thread.is_finished());
        match listener.accept() {
            Ok((stream, _)) if connections.len() < MOST_CONNECTIONS => {
                is_short = false;
                connections.extend(spawn_connection(shared, stream, service));
            }
            Ok(_) => note(shared, service, "connection refused: too many"),
            Err(error) => {
                // No more connections than the system has room for; said once until one fits.
                let was_short = std::mem::replace(&mut is_short, is_shortage(&error));
                if is_short && !was_short {
                    note(shared, service, &format!("connections wait: {error}"));
                }
                // Nobody there, or a connection that broke before it was accepted.
                thread::sleep(ACCEPT_EVERY);
            }
        }
    }
    for thread in connections {
        // A thread that panicked has nothing left to end.
        let _ = thread.join();
    }
}

fn note(shared: &Shared, service: Service, what: &str) {
    let line = format!("{service:?} port: {what}");
    lock(&shared.world).controller.note(&line);
}

/// Whether the system is out of something, and not only out of clients.
fn is_shortage(error: &io::Error) -> bool {
    use ErrorKind::{ConnectionAborted, ConnectionReset, Interrupted, TimedOut, WouldBlock};
    let harmless = [
        WouldBlock,
        Interrupted,
        ConnectionAborted,
        ConnectionReset,
        TimedOut,
    ];
    !harmless.contains(&error.kind())
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
    let stream = Arc::new(stream);
    let id = lock(&shared.world).admit(&stream)?;
    let for_thread = Arc::clone(shared);
    let thread = thread::Builder::new()
        .name(format!("emulator connection {id}"))
        .spawn(move || {
            let _leaves = Leaves(&for_thread, id);
            if service == Service::Rtde {
                for_thread.hurry();
            }
            serve_connection(&for_thread, id, &stream, service);
        });
    if let Err(error) = &thread {
        lock(&shared.world).remove(id);
        note(shared, service, &format!("connection refused: {error}"));
    }
    thread.ok()
}

/// Forgets a connection at the end of its thread, however that ends.
struct Leaves<'a>(&'a Shared, u64);

impl Drop for Leaves<'_> {
    fn drop(&mut self) {
        lock(&self.0.world).remove(self.1);
        self.0.changed.notify_all();
    }
}

/// Lets the thread that writes end, however the one that reads ends. Whoever has said all that they
/// had to say may still want the answers.
struct Finishes<'a>(&'a Outbox);

impl Drop for Finishes<'_> {
    fn drop(&mut self) {
        self.0.finish();
    }
}

fn serve_connection(shared: &Shared, id: u64, stream: &TcpStream, service: Service) {
    let mut inbound = Inbound::join(shared, id, service);
    let outbox = Arc::clone(inbound.outbox());
    thread::scope(|scope| {
        let _finishes = Finishes(&outbox);
        let writer = thread::Builder::new()
            .name(format!("emulator writer {id}"))
            .spawn_scoped(scope, || {
                if service == Service::Rtde {
                    shared.hurry();
                }
                write_all_of(&outbox, stream, service);
            });
        if writer.is_ok() {
            read_all(stream, |bytes| inbound.take(shared, bytes));
        }
    });
}

fn write_all_of(outbox: &Outbox, stream: &TcpStream, service: Service) {
    while let Some(bytes) = outbox.take() {
        if !write(outbox, stream, &bytes, service) {
            break;
        }
    }
    // Wakes the thread that reads.
    let _ = stream.shutdown(Shutdown::Both);
}

/// Writes all bytes; `false` if the client is gone. Who only sends programs to the state ports
/// never reads them, and is waited for.
fn write(outbox: &Outbox, mut stream: &TcpStream, mut bytes: &[u8], service: Service) -> bool {
    while !bytes.is_empty() {
        let portion = bytes.len().min(outbox.portion());
        match stream.write(&bytes[..portion]) {
            Ok(0) => return false,
            Ok(size) => bytes = &bytes[size..],
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error)
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut)
                    && !matches!(service, Service::Rtde | Service::Dashboard)
                    && !outbox.is_ending() => {}
            Err(_) => return false,
        }
    }
    true
}

/// Hands over bytes as they come in, until the client has no more to say or is not heard any more.
fn read_all(mut stream: &TcpStream, mut take: impl FnMut(&[u8]) -> Then) {
    let mut buffer = [0; 4096];
    loop {
        match stream.read(&mut buffer) {
            Ok(0) => return,
            Ok(size) => {
                if take(&buffer[..size]) == Then::Close {
                    return;
                }
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}
