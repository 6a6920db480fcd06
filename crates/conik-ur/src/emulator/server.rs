//! Sockets and threads: who listens, who reads, who writes.
//!
//! One thread accepts on each port and ends last, after the threads of its connections. An RTDE
//! connection has one thread that reads and one that writes, a script connection one that reads.

use super::config::EmulatorError;
use super::lock;
use super::outbox::Outbox;
use super::script_port::ScriptReader;
use super::world::Shared;
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

/// What is done with the connections of a port.
type Serve = fn(&Shared, u64, TcpStream);

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

/// Starts to serve RTDE on an open port.
pub(super) fn serve_rtde(
    shared: &Arc<Shared>,
    listener: TcpListener,
) -> Result<JoinHandle<()>, EmulatorError> {
    spawn_acceptor("rtde", shared, listener, serve_rtde_client)
}

/// Starts to serve programs on an open port.
pub(super) fn serve_scripts(
    shared: &Arc<Shared>,
    listener: TcpListener,
) -> Result<JoinHandle<()>, EmulatorError> {
    spawn_acceptor("script", shared, listener, serve_script_client)
}

fn spawn_acceptor(
    name: &str,
    shared: &Arc<Shared>,
    listener: TcpListener,
    serve: Serve,
) -> Result<JoinHandle<()>, EmulatorError> {
    let shared = Arc::clone(shared);
    thread::Builder::new()
        .name(format!("emulator {name}"))
        .spawn(move || accept(&shared, &listener, serve))
        .map_err(EmulatorError::Thread)
}

fn accept(shared: &Arc<Shared>, listener: &TcpListener, serve: Serve) {
    let mut connections: Vec<JoinHandle<()>> = Vec::new();
    while !lock(&shared.world).is_closing {
        match listener.accept() {
            Ok((stream, _)) => connections.extend(spawn_connection(shared, stream, serve)),
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
    serve: Serve,
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
            serve(&for_thread, id, stream);
            lock(&for_thread.world).remove(id);
            for_thread.changed.notify_all();
        });
    if thread.is_err() {
        lock(&shared.world).remove(id);
    }
    thread.ok()
}

fn serve_rtde_client(shared: &Shared, id: u64, stream: TcpStream) {
    let outbox = lock(&shared.world).add_client(id);
    let Ok(writing_end) = stream.try_clone() else {
        return;
    };
    thread::scope(|scope| {
        let writer = thread::Builder::new()
            .name(format!("emulator writer {id}"))
            .spawn_scoped(scope, || write_all_of(&outbox, writing_end));
        if writer.is_ok() {
            read_packages(shared, id, stream);
        }
        outbox.close();
    });
}

fn write_all_of(outbox: &Outbox, mut stream: TcpStream) {
    while let Some(bytes) = outbox.take() {
        if stream.write_all(&bytes).is_err() {
            break;
        }
    }
    // Wakes the thread that reads.
    let _ = stream.shutdown(Shutdown::Both);
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

fn serve_script_client(shared: &Shared, id: u64, stream: TcpStream) {
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
