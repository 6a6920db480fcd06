//! How faults are brought about.

use super::World;
use crate::emulator::config::Fault;
use crate::emulator::fields::InputField;
use std::net::Shutdown;

/// Who writes an input that a fieldbus has claimed; clients are numbered from 1.
const FIELDBUS: u64 = 0;

/// Faults that may be put off at a time.
const MOST_TO_COME: usize = 1000;

impl World {
    /// Brings a fault about.
    pub(in crate::emulator) fn strike(&mut self, fault: Fault) {
        let cycles = |seconds: f64| {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates.
            let cycles = (seconds.max(0.0) * self.controller.rate_hz).round() as u64;
            cycles
        };
        let line = format!("fault: {fault:?}");
        match fault {
            Fault::Event(injection) => self.controller.inject(injection),
            Fault::ClockJump(seconds) => self.controller.clock_jump_s += seconds,
            Fault::Drop(probability) => self.network.drop = probability,
            Fault::Delay(seconds) => self.network.delay = cycles(seconds),
            Fault::Jitter(seconds) => self.network.jitter = cycles(seconds),
            Fault::Freeze(seconds) => {
                self.network.frozen_until =
                    self.controller.cycles().saturating_add(cycles(seconds));
            }
            Fault::Reset => {
                for id in self.clients.keys() {
                    if let Some(stream) = self.connections.get(id) {
                        // One that is shut already is what we want.
                        let _ = stream.shutdown(Shutdown::Both);
                    }
                }
            }
            Fault::HalfOpen => {
                for client in self.clients.values_mut() {
                    client.is_silent = true;
                    client.owes_an_answer = false;
                }
            }
            Fault::RegisterInUse(name) => match InputField::from_name(&name) {
                Some(field) => {
                    self.claims.insert(field, FIELDBUS);
                }
                None => self.controller.note(&format!("there is no input '{name}'")),
            },
            Fault::After(_, _) if self.to_come.len() >= MOST_TO_COME => {
                self.controller.note("too many faults are to come");
            }
            Fault::After(seconds, fault) => {
                let cycle = self.controller.cycles().saturating_add(cycles(seconds));
                self.to_come.push((cycle, *fault));
            }
            Fault::BadPackages(count) => self.network.bad_packages = count,
            Fault::OneByte(on) => {
                self.one_byte = on;
                let clients = self.clients.values().map(|client| &client.outbox);
                let listeners = self.listeners.values().map(|listener| &listener.outbox);
                clients
                    .chain(listeners)
                    .for_each(|outbox| outbox.set_one_byte(on));
            }
        }
        self.controller.note(&line);
    }

    /// Brings about the faults that were put off to this cycle, in the order in which they were
    /// asked for.
    pub(super) fn strike_what_is_due(&mut self) {
        let now = self.controller.cycles();
        let due = self.to_come.extract_if(.., |(cycle, _)| *cycle <= now);
        for (_, fault) in due.collect::<Vec<_>>() {
            self.strike(fault);
        }
    }
}
