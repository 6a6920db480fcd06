//! What all threads of the emulator share: the controller, its clients, and the wish to end.

use super::config::Pace;
use super::controller::Controller;
use super::outbox::Outbox;
use super::rtde::{Claims, RtdeClient};
use super::{lock, script_port};
use crate::wire::{ControllerVersion, Frame, Reply, TextLevel, TextMessage};
use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Connections at a time; a real controller takes fewer.
const MOST_CONNECTIONS: usize = 64;

/// Shared by all threads.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) world: Mutex<World>,
    /// Tells the clock of an answer, of a client that came or went, and of the end.
    pub(super) changed: Condvar,
    pub(super) version: ControllerVersion,
    pub(super) rate_hz: f64,
    pub(super) pace: Pace,
}

/// What changes.
#[derive(Debug)]
pub(super) struct World {
    pub(super) controller: Controller,
    clients: BTreeMap<u64, Client>,
    claims: Claims,
    /// Every open connection, so that all can be woken at the end.
    connections: BTreeMap<u64, TcpStream>,
    next_id: u64,
    /// Whether a program ran in the last cycle.
    program_ran: bool,
    pub(super) is_closing: bool,
}

/// An RTDE client.
#[derive(Debug)]
struct Client {
    rtde: RtdeClient,
    outbox: Arc<Outbox>,
    /// In lockstep: it was sent a package and has not answered yet.
    owes_an_answer: bool,
    /// In lockstep: its program has ended, so it is not waited for any more.
    is_done: bool,
}

impl World {
    pub(super) fn new(controller: Controller) -> Self {
        Self {
            controller,
            clients: BTreeMap::new(),
            claims: Claims::new(),
            connections: BTreeMap::new(),
            next_id: 1,
            program_ran: false,
            is_closing: false,
        }
    }

    /// Takes in a connection and numbers it; `None` if it cannot be taken.
    pub(super) fn admit(&mut self, stream: &TcpStream) -> Option<u64> {
        if self.is_closing {
            return None;
        }
        if self.connections.len() >= MOST_CONNECTIONS {
            self.controller.note("connection refused: too many");
            return None;
        }
        let stream = stream.try_clone().ok()?;
        let id = self.next_id;
        self.next_id += 1;
        self.connections.insert(id, stream);
        Some(id)
    }

    /// Makes an admitted connection an RTDE client.
    pub(super) fn add_client(&mut self, id: u64) -> Arc<Outbox> {
        let outbox = Arc::new(Outbox::default());
        let client = Client {
            rtde: RtdeClient::new(id),
            outbox: Arc::clone(&outbox),
            owes_an_answer: false,
            is_done: false,
        };
        self.clients.insert(id, client);
        self.controller.note(&format!("client {id} connected"));
        outbox
    }

    /// Forgets a connection and frees the inputs that it wrote.
    pub(super) fn remove(&mut self, id: u64) {
        self.connections.remove(&id);
        if let Some(client) = self.clients.remove(&id) {
            client.outbox.close();
            self.claims.retain(|_, owner| *owner != id);
            self.controller.note(&format!("client {id} left"));
        }
    }

    #[cfg(test)]
    pub(super) fn connection_count(&self) -> usize {
        self.connections.len()
    }

    /// Wakes every thread that waits for a client.
    pub(super) fn close(&mut self) {
        self.is_closing = true;
        for client in self.clients.values() {
            client.outbox.close();
        }
        for stream in self.connections.values() {
            // One that is shut already is what we want.
            let _ = stream.shutdown(Shutdown::Both);
        }
    }

    /// One control cycle, and the packages that are due after it.
    pub(super) fn cycle(&mut self, pace: Pace) {
        self.controller.cycle();
        let runs = self.controller.program_runs();
        let ended = self.program_ran && !runs;
        self.program_ran = runs;
        let partner = self.partner().filter(|_| pace == Pace::Lockstep);
        for (id, client) in &mut self.clients {
            if client.rtde.is_due(self.controller.cycles())
                && let Some(package) = client.rtde.package(&self.controller)
            {
                client.outbox.offer(package);
                client.owes_an_answer = partner == Some(*id) && !ended;
            }
            client.is_done |= partner == Some(*id) && ended;
        }
    }

    /// The client that lockstep waits for.
    pub(super) fn partner(&self) -> Option<u64> {
        let mut candidates = self.clients.iter();
        candidates
            .find(|(_, client)| client.rtde.is_in_the_loop() && !client.is_done)
            .map(|(id, _)| *id)
    }

    /// Whether some client has yet to answer its last package.
    pub(super) fn awaits_an_answer(&self) -> bool {
        self.clients.values().any(|client| client.owes_an_answer)
    }

    /// Waits no longer for answers that have not come.
    pub(super) fn forgive(&mut self) {
        for client in self.clients.values_mut() {
            client.owes_an_answer = false;
        }
        self.controller.note("lockstep: a client did not answer");
    }
}

impl Shared {
    /// Acts on a package of a client.
    pub(super) fn handle(&self, id: u64, frame: &Frame) {
        let world = &mut *lock(&self.world);
        let Some(client) = world.clients.get_mut(&id) else {
            return;
        };
        let outcome = client.rtde.handle(
            frame,
            self.version,
            self.rate_hz,
            &mut world.controller,
            &mut world.claims,
        );
        if let Some(reply) = outcome.reply {
            send(&client.outbox, &reply);
        }
        if outcome.wrote_inputs {
            client.owes_an_answer = false;
        }
        self.changed.notify_all();
    }

    /// Acts on a program of a client of the script port.
    pub(super) fn run_script(&self, text: &str) {
        let world = &mut *lock(&self.world);
        if let Err(fault) = world.controller.upload(text) {
            let name = script_port::name_of(text);
            let line = format!("program '{name}' refused: {fault}");
            world.controller.note(&line);
            let reply = Reply::Text(TextMessage::new(TextLevel::Error, "emulator", &line));
            for client in world.clients.values() {
                send(&client.outbox, &reply);
            }
        }
    }

    /// Waits, at most for `time`, until something happens.
    pub(super) fn wait<'a>(
        &self,
        world: MutexGuard<'a, World>,
        time: Duration,
    ) -> MutexGuard<'a, World> {
        self.changed
            .wait_timeout(world, time)
            .unwrap_or_else(PoisonError::into_inner)
            .0
    }
}

fn send(outbox: &Outbox, reply: &Reply) {
    // Replies are built here from short texts and lists, so that they always fit a package.
    if let Ok(bytes) = reply.to_frame().and_then(|frame| frame.to_bytes()) {
        outbox.answer(bytes);
    }
}
