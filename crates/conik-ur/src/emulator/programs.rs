//! How programs begin, go on from cycle to cycle, and end.

use super::arm::Motion;
use super::config::Series;
use super::controller::Controller;
use super::log::Message;
use super::running::Running;
use super::script_program::Around;
use crate::urscript::WatchdogAction;

impl Controller {
    /// Why no program may begin now, if none may.
    pub(super) fn why_no_program(&self) -> Option<&'static str> {
        if !self.remote_control && self.series == Series::E {
            return Some("the controller is not in remote control");
        }
        self.why_not_ready()
    }

    /// Lets a program begin with the next control cycle; it takes the place of the one that runs.
    /// A secondary program runs at once, beside it. The error says why it may not begin.
    pub(super) fn start(&mut self, mut program: Running) -> Result<(), &'static str> {
        if let Some(reason) = self.why_no_program() {
            return Err(reason);
        }
        if program.is_secondary() {
            let failed = program.cycle(&mut self.around()).err();
            let end = failed.map_or("ended".to_owned(), |error| error.to_string());
            self.note(&format!("secondary program '{}': {end}", program.name()));
            return Ok(());
        }
        let line = format!("program '{}' started", program.name());
        self.begin(program, &line);
        Ok(())
    }

    /// Lets a program run, in the place of another if there is one.
    pub(super) fn begin(&mut self, program: Running, line: &str) {
        if self.running.is_some() {
            self.end_program("program stopped by a new one");
        }
        self.running = Some(program);
        self.paused = false;
        self.note(line);
    }

    /// What the program has the joints do in this cycle. One that fails is over.
    pub(super) fn run_program(&mut self) -> Motion {
        let Some(mut running) = self.running.take_if(|_| !self.paused) else {
            return Motion::Rest;
        };
        let outcome = running.cycle(&mut self.around());
        let name = running.name().to_owned();
        self.running = Some(running);
        outcome.unwrap_or_else(|error| {
            self.end_program(&format!("program '{name}' stopped by a fault"));
            let message = Message {
                text: format!("program '{name}': {error}"),
                script_line: Some(error.line),
            };
            self.tell(message);
            Motion::Rest
        })
    }

    /// Ends a program that has nothing left to do, once the arm stands still.
    pub(super) fn end_finished_program(&mut self) {
        if !self.paused
            && let Some(line) = self.running.as_ref().and_then(Running::ending)
            && self.arm.is_still()
        {
            self.end_program(&line);
        }
    }

    /// Does what the watchdogs of the running program ask for.
    pub(super) fn watch(&mut self) {
        if self.running.is_none() || self.paused {
            return;
        }
        let Some(bite) = self.watchdogs.bite(&self.registers, self.cycles()) else {
            return;
        };
        let name = bite.name;
        match bite.action {
            WatchdogAction::Ignore => {}
            WatchdogAction::Pause => {
                self.paused = true;
                self.note(&format!("program paused by its watchdog on {name}"));
            }
            WatchdogAction::Stop => {
                self.end_program(&format!("program stopped by its watchdog on {name}"));
            }
        }
    }

    /// Ends the program, if one runs; the watchdogs go with it, and the arm comes to rest.
    pub(super) fn end_program(&mut self, why: &str) {
        self.running = None;
        self.paused = false;
        self.arm.forget_target();
        self.watchdogs.clear();
        self.note(why);
    }

    fn around(&mut self) -> Around<'_> {
        Around {
            time_s: self.timestamp(),
            cycle_s: 1.0 / self.rate_hz,
            slider: self.slider,
            registers: &mut self.registers,
            arm: &self.arm,
            watchdogs: &mut self.watchdogs,
            mounted: &mut self.mounted,
            log: &mut self.log,
        }
    }
}
