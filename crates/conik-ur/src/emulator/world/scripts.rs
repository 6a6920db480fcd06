//! Programs and short commands as they come in on the ports that take them.

use super::{Shared, World};
use crate::emulator::controller::Controller;
use crate::emulator::log::Message;
use crate::emulator::running::Running;
use crate::emulator::{lock, script_port};
use std::sync::Arc;
use std::thread;

/// Programs that open sockets at a time; only the last of them runs.
const MOST_DIALLERS: usize = 8;

impl Shared {
    /// Acts on a program of a client of the script port.
    pub(in crate::emulator) fn run_script(&self, text: &str) {
        let hindrance = {
            let world = &mut *lock(&self.world);
            if run_command(&mut world.controller, text.trim()) || world.is_closing {
                return;
            }
            world.controller.why_no_program()
        };
        // Read while the clock goes on, then begun.
        let program = match hindrance {
            Some(reason) => Err(reason.into()),
            None => Running::read(text),
        };
        let world = &mut *lock(&self.world);
        if world.is_closing {
            return;
        }
        let started = program.and_then(|program| Ok(world.controller.start(program)?));
        world.dial();
        if let Err(refusal) = started {
            let name = script_port::name_of(text);
            world.controller.tell(Message {
                text: format!("program '{name}' refused: {}", refusal.reason),
                script_line: refusal.script_line,
            });
        }
        world.tell_clients();
    }
}

impl World {
    /// Opens the sockets that the program wants, if it wants any.
    fn dial(&mut self) {
        let calls = self.controller.running.as_ref().and_then(Running::calls);
        let Some(calls) = calls.filter(|calls| calls.claim()).map(Arc::clone) else {
            return;
        };
        self.diallers.retain(|thread| !thread.is_finished());
        let thread = (self.diallers.len() < MOST_DIALLERS).then(|| {
            thread::Builder::new()
                .name("emulator dialler".to_owned())
                .spawn(move || calls.dial())
        });
        match thread {
            Some(Ok(thread)) => self.diallers.push(thread),
            _ => self
                .controller
                .end_program("too many programs open sockets"),
        }
    }
}

/// The short commands that the primary port takes beside programs.
fn run_command(controller: &mut Controller, line: &str) -> bool {
    match line {
        "power on" => {
            controller.power_on();
        }
        "power off" => controller.power_off(),
        "set robotmode run" => {
            controller.release_brakes();
        }
        "set unlock protective stop" => {
            if let Err(left) = controller.unlock_protective_stop() {
                controller.note(&format!("unlock refused for {left:.1} s more"));
            }
        }
        "stop program" => {
            if controller.program_runs() {
                controller.end_program("program stopped from the network");
            }
        }
        _ => return false,
    }
    true
}
