//! What comes in on a connection, without sockets: bytes become packages, programs or lines, and
//! take their effect.

use super::outbox::Outbox;
use super::script_port::ScriptReader;
use super::world::{Hears, Shared};
use super::{dashboard, lock, state_message};
use crate::wire::FrameReader;
use std::sync::Arc;

/// The longest line that the dashboard takes.
const LONGEST_LINE: usize = 4096;

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

/// One end of a connection: takes bytes in any portions.
#[derive(Debug)]
pub(super) struct Inbound {
    id: u64,
    outbox: Arc<Outbox>,
    reader: Reader,
}

#[derive(Debug)]
enum Reader {
    Packages(FrameReader),
    Programs(ScriptReader),
    Lines(Vec<u8>),
    /// What comes in means nothing.
    Nothing,
}

/// Whether a connection stays open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Then {
    GoOn,
    /// What waits for the client is still written.
    Close,
}

impl Inbound {
    /// Makes an admitted connection a client of this service, and greets it.
    pub(super) fn join(shared: &Shared, id: u64, service: Service) -> Self {
        let mut world = lock(&shared.world);
        let (outbox, reader) = match service {
            Service::Rtde => (
                world.add_client(id),
                Reader::Packages(FrameReader::default()),
            ),
            Service::State | Service::StateReadOnly => {
                let outbox = world.add_listener(id, Hears::State);
                outbox.answer(state_message::version_message(shared.version));
                (outbox, Reader::of_programs(service == Service::State))
            }
            Service::RealTime | Service::RealTimeReadOnly => (
                world.add_listener(id, Hears::RealTime),
                Reader::of_programs(service == Service::RealTime),
            ),
            Service::Dashboard => {
                let outbox = world.add_listener(id, Hears::Nothing);
                outbox.answer(dashboard::GREETING.as_bytes().to_vec());
                (outbox, Reader::Lines(Vec::new()))
            }
        };
        Self { id, outbox, reader }
    }

    /// What is to be written to the client.
    pub(super) fn outbox(&self) -> &Arc<Outbox> {
        &self.outbox
    }

    /// Acts on bytes as they came in.
    pub(super) fn take(&mut self, shared: &Shared, bytes: &[u8]) -> Then {
        let id = self.id;
        let closed_for = |why: &str| {
            let line = format!("client {id}: connection closed: {why}");
            lock(&shared.world).controller.note(&line);
            Then::Close
        };
        match &mut self.reader {
            Reader::Packages(reader) => {
                reader.push(bytes);
                loop {
                    match reader.next_frame() {
                        Ok(Some(frame)) => shared.handle(id, &frame),
                        Ok(None) => return Then::GoOn,
                        Err(error) => {
                            let error = error.to_string();
                            shared.complain(id, &error);
                            return closed_for(&error);
                        }
                    }
                }
            }
            Reader::Programs(reader) => {
                if reader.push(bytes).is_err() {
                    return closed_for("program too long");
                }
                while let Some(program) = reader.next_program() {
                    shared.run_script(&program);
                }
                Then::GoOn
            }
            Reader::Lines(waiting) => {
                waiting.extend_from_slice(bytes);
                while let Some(end) = waiting.iter().position(|byte| *byte == b'\n') {
                    let line = String::from_utf8_lossy(&waiting[..end]).into_owned();
                    waiting.drain(..=end);
                    let said = dashboard::answer(&mut lock(&shared.world), &line);
                    self.outbox.answer(format!("{said}\n").into_bytes());
                    shared.changed.notify_all();
                    if said == dashboard::FAREWELL {
                        return Then::Close;
                    }
                }
                if waiting.len() > LONGEST_LINE {
                    return closed_for("line too long");
                }
                Then::GoOn
            }
            Reader::Nothing => Then::GoOn,
        }
    }
}

impl Reader {
    fn of_programs(taken: bool) -> Self {
        if taken {
            Self::Programs(ScriptReader::default())
        } else {
            Self::Nothing
        }
    }
}
