//! What all threads of the emulator share: the controller, its clients, and the wish to end.

mod client;
mod scripts;
mod strike;

use super::config::{Fault, Pace};
use super::controller::Controller;
use super::faults::Network;
use super::lock;
use super::outbox::Outbox;
use super::rtde::Claims;
use crate::realtime::first_in_line;
use crate::wire::{ControllerVersion, Frame, Reply, TextLevel, TextMessage};
use client::Client;
use std::collections::BTreeMap;
use std::net::{Shutdown, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// How often the primary and secondary ports send the state [Hz].
const STATE_HZ: f64 = 10.0;

/// Shared by all threads.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) world: Mutex<World>,
    /// Tells the clock of an answer, of a client that came or went, and of the end.
    pub(super) changed: Condvar,
    pub(super) version: ControllerVersion,
    pub(super) rate_hz: f64,
    pub(super) pace: Pace,
    pub(super) real_time: bool,
}

/// What changes.
#[derive(Debug)]
pub(super) struct World {
    pub(super) controller: Controller,
    clients: BTreeMap<u64, Client>,
    claims: Claims,
    listeners: BTreeMap<u64, Listener>,
    network: Network,
    /// Faults to come, each with its cycle.
    to_come: Vec<(u64, Fault)>,
    one_byte: bool,
    /// Every open connection, so that all can be woken at the end.
    connections: BTreeMap<u64, Arc<TcpStream>>,
    next_id: u64,
    /// Threads that open sockets for programs.
    diallers: Vec<JoinHandle<()>>,
    /// Whether a program ran in the last cycle.
    program_ran: bool,
    pub(super) is_closing: bool,
}

/// A client of another port.
#[derive(Debug)]
struct Listener {
    outbox: Arc<Outbox>,
    hears: Hears,
}

/// What a port sends without being asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hears {
    Nothing,
    State,
    RealTime,
}

impl World {
    pub(super) fn new(controller: Controller) -> Self {
        Self {
            controller,
            clients: BTreeMap::new(),
            claims: Claims::new(),
            listeners: BTreeMap::new(),
            network: Network::good(),
            to_come: Vec::new(),
            one_byte: false,
            connections: BTreeMap::new(),
            next_id: 1,
            diallers: Vec::new(),
            program_ran: false,
            is_closing: false,
        }
    }

    /// Takes in a connection and numbers it; `None` at the end.
    pub(super) fn admit(&mut self, stream: &Arc<TcpStream>) -> Option<u64> {
        if self.is_closing {
            return None;
        }
        let id = self.new_id();
        self.connections.insert(id, Arc::clone(stream));
        Some(id)
    }

    /// Clients are numbered from 1.
    pub(super) fn new_id(&mut self) -> u64 {
        let id = self.next_id;
        self.next_id += 1;
        id
    }

    /// Makes an admitted connection an RTDE client.
    pub(super) fn add_client(&mut self, id: u64) -> Arc<Outbox> {
        let outbox = self.new_outbox();
        let client = Client::new(id, Arc::clone(&outbox));
        self.clients.insert(id, client);
        self.controller.note(&format!("client {id} connected"));
        outbox
    }

    fn new_outbox(&self) -> Arc<Outbox> {
        let outbox = Outbox::default();
        outbox.set_one_byte(self.one_byte);
        Arc::new(outbox)
    }

    /// Makes an admitted connection one that hears this.
    pub(super) fn add_listener(&mut self, id: u64, hears: Hears) -> Arc<Outbox> {
        let outbox = self.new_outbox();
        let listener = Listener {
            outbox: Arc::clone(&outbox),
            hears,
        };
        self.listeners.insert(id, listener);
        outbox
    }

    /// Offers the state to those who hear it.
    fn tell_listeners(&self) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates, at least 1.
        let every = (self.controller.rate_hz / STATE_HZ).round().max(1.0) as u64;
        let state_is_due = self.controller.cycles().is_multiple_of(every);
        let (mut state, mut real_time) = (None, None);
        for listener in self.listeners.values() {
            let package = match listener.hears {
                Hears::State if state_is_due => {
                    state.get_or_insert_with(|| self.controller.state_message())
                }
                Hears::RealTime => {
                    real_time.get_or_insert_with(|| self.controller.real_time_package())
                }
                Hears::State | Hears::Nothing => continue,
            };
            listener.outbox.offer(package.clone());
        }
    }

    /// Hands on what the controller has to say to everyone.
    fn tell_clients(&mut self) {
        for message in self.controller.log.take_messages() {
            let text = TextMessage::new(TextLevel::Error, "emulator", &message.text);
            let reply = Reply::Text(text);
            // One that has not begun to listen has no version of the protocol yet.
            let listening = |client: &&Client| client.rtde.is_started() && !client.is_silent;
            for client in self.clients.values().filter(listening) {
                client.answer(&reply);
            }
            let package = self.controller.robot_message(&message);
            for listener in self.listeners.values() {
                if listener.hears == Hears::State {
                    listener.outbox.answer(package.clone());
                }
            }
        }
    }

    /// Forgets a connection and frees the inputs that it wrote.
    pub(super) fn remove(&mut self, id: u64) {
        self.connections.remove(&id);
        if let Some(listener) = self.listeners.remove(&id) {
            listener.outbox.close();
        }
        if let Some(client) = self.clients.remove(&id) {
            client.outbox.close();
            self.claims.retain(|_, owner| *owner != id);
            self.controller.note(&format!("client {id} left"));
        }
    }

    pub(super) fn connection_count(&self) -> usize {
        self.connections.len()
    }

    /// The threads that still open sockets, to wait for after [`Self::close`].
    pub(super) fn take_diallers(&mut self) -> Vec<JoinHandle<()>> {
        std::mem::take(&mut self.diallers)
    }

    /// Wakes every thread that waits for a client.
    pub(super) fn close(&mut self) {
        self.is_closing = true;
        // It may hold sockets, or a thread that opens some.
        self.controller.running = None;
        for client in self.clients.values() {
            client.outbox.close();
        }
        for listener in self.listeners.values() {
            listener.outbox.close();
        }
        for stream in self.connections.values() {
            // One that is shut already is what we want.
            let _ = stream.shutdown(Shutdown::Both);
        }
    }

    /// One control cycle, and the packages that are due after it.
    pub(super) fn cycle(&mut self, pace: Pace) {
        self.strike_what_is_due();
        self.controller.cycle();
        self.tell_clients();
        let runs = self.controller.program_runs();
        let ended = self.program_ran && !runs;
        self.program_ran = runs;
        self.tell_listeners();
        let partner = self.partner().filter(|_| pace == Pace::Lockstep);
        for (id, client) in &mut self.clients {
            if client.send_due(&self.controller, &mut self.network) {
                client.owes_an_answer = partner == Some(*id) && !ended;
            }
            client.is_done |= !client.is_silent && partner == Some(*id) && ended;
        }
    }

    /// The client that lockstep waits for.
    pub(super) fn partner(&self) -> Option<u64> {
        let mut candidates = self.clients.iter();
        candidates
            .find(|(_, client)| {
                client.rtde.is_in_the_loop() && !client.is_done && !client.is_silent
            })
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
    /// Lets the thread that calls go before others, if that is wanted and the system allows it.
    pub(super) fn hurry(&self) {
        if self.real_time {
            // Without it the clock is only less regular.
            let _ = first_in_line();
        }
    }

    /// Acts on a package of a client.
    pub(super) fn handle(&self, id: u64, frame: &Frame) {
        let world = &mut *lock(&self.world);
        let Some(client) = world.clients.get_mut(&id) else {
            return;
        };
        if client.is_silent {
            return;
        }
        let outcome = client.rtde.handle(
            frame,
            self.version,
            self.rate_hz,
            &mut world.controller,
            &mut world.claims,
        );
        if let Some(reply) = outcome.reply {
            client.answer(&reply);
        }
        if outcome.wrote_inputs {
            client.owes_an_answer = false;
        }
        self.changed.notify_all();
    }

    /// Tells a client what was wrong with what it sent.
    pub(super) fn complain(&self, id: u64, fault: &str) {
        if let Some(client) = lock(&self.world).clients.get(&id) {
            let message = TextMessage::new(TextLevel::Error, "RTDE", fault);
            client.answer(&Reply::Text(message));
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
