//! One RTDE client: what is on its way to it, and whether the clock waits for it.

use crate::emulator::controller::Controller;
use crate::emulator::faults::Network;
use crate::emulator::outbox::Outbox;
use crate::emulator::rtde::RtdeClient;
use crate::wire::Reply;
use std::collections::VecDeque;
use std::sync::Arc;

#[derive(Debug)]
pub(super) struct Client {
    pub(super) rtde: RtdeClient,
    pub(super) outbox: Arc<Outbox>,
    /// Packages under way, each with the cycle in which it goes out.
    under_way: VecDeque<(u64, Vec<u8>)>,
    /// The connection is half open: it neither hears nor is heard.
    pub(super) is_silent: bool,
    /// In lockstep: it was sent a package and has not answered yet.
    pub(super) owes_an_answer: bool,
    /// In lockstep: its program has ended, so it is not waited for any more.
    pub(super) is_done: bool,
}

impl Client {
    pub(super) fn new(id: u64, outbox: Arc<Outbox>) -> Self {
        Self {
            rtde: RtdeClient::new(id),
            outbox,
            under_way: VecDeque::new(),
            is_silent: false,
            owes_an_answer: false,
            is_done: false,
        }
    }

    /// Puts the outputs of this cycle on their way, and sends what has arrived at its end; whether
    /// anything was sent.
    pub(super) fn send_due(&mut self, controller: &Controller, network: &mut Network) -> bool {
        if self.is_silent {
            return false;
        }
        let cycle = controller.cycles();
        if self.rtde.is_due(cycle)
            && let Some(departure) = network.departure(cycle)
            && let Some(mut package) = self.rtde.package(controller)
        {
            network.spoil(&mut package);
            // One stream keeps its order, however long each package waits.
            let last = self.under_way.back().map_or(0, |(last, _)| *last);
            self.under_way.push_back((departure.max(last), package));
        }
        let mut is_sent = false;
        let arrived = |(departure, _): &(u64, Vec<u8>)| *departure <= cycle;
        while self.under_way.front().is_some_and(arrived)
            && let Some((_, package)) = self.under_way.pop_front()
        {
            self.outbox.offer(package);
            is_sent = true;
        }
        is_sent
    }

    /// Answers in this client's version of the protocol.
    pub(super) fn answer(&self, reply: &Reply) {
        if let Some(bytes) = self.rtde.to_bytes(reply) {
            self.outbox.answer(bytes);
        }
    }
}
