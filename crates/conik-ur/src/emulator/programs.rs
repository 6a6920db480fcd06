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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::config::EmulatorConfig;
    use crate::emulator::fields::{InputField, OutputField};
    use crate::registers::JOINTS;
    use crate::wire::Value;
    use conik::JointVec;

    fn controller() -> Controller {
        let config = EmulatorConfig::new(Series::E, JointVec::zeros(JOINTS));
        Controller::new(&config).unwrap()
    }

    fn start(controller: &mut Controller, text: &str) {
        controller.start(Running::read(text).unwrap()).unwrap();
    }

    fn cycles(controller: &mut Controller, count: u32) {
        for _ in 0..count {
            controller.cycle();
        }
    }

    fn has_line(controller: &Controller, part: &str) -> bool {
        controller.log.lines().any(|line| line.contains(part))
    }

    #[test]
    fn a_watchdog_pauses_or_stops_the_program_and_goes_with_it() {
        for (action, state) in [("pause", "paused"), ("stop", "stopped")] {
            let mut controller = controller();
            let text = format!(
                "def watched():\n  rtde_set_watchdog(\"input_double_register_30\", 10, \"{action}\")\n  \
                 sleep(1000)\nend\n"
            );
            start(&mut controller, &text);
            // 10 Hz at 500 Hz: fifty cycles.
            for _ in 0..10 {
                let value = Value::Double(0.0);
                controller.write_input(InputField::Double(30), value);
                cycles(&mut controller, 50);
                assert!(controller.program_runs() && !controller.paused, "{action}");
            }
            controller.cycle();
            let line = format!("program {state} by its watchdog on input_double_register_30");
            assert!(has_line(&controller, &line), "{action}");
            assert_eq!(controller.paused, action == "pause");
            assert_eq!(controller.program_runs(), action == "pause");
            start(&mut controller, "sleep(1000)");
            cycles(&mut controller, 500);
            assert!(controller.program_runs() && !controller.paused, "{action}");
        }
    }

    #[test]
    fn a_fault_ends_the_program_brakes_the_arm_and_is_told_with_its_line() {
        let mut controller = controller();
        let text = "def bad():\n  servoj([0.05,0,0,0,0,0], t=0.1)\n  x = [1][1]\nend\n";
        start(&mut controller, text);
        cycles(&mut controller, 50);
        assert!(!controller.arm.is_still() && controller.log.take_messages().is_empty());
        controller.cycle();
        assert!(!controller.program_runs());
        let expected = Message {
            text: "program 'bad': line 3: there is no element 1 among 1".to_owned(),
            script_line: Some(3),
        };
        assert_eq!(controller.log.take_messages(), [expected]);
        cycles(&mut controller, 100);
        assert!(controller.arm.is_still());
    }

    #[test]
    fn time_passes_in_whole_control_cycles() {
        for (call, needed) in [
            ("sleep(0.01)", 5),
            ("sleep(0.0101)", 6),
            ("sync()", 1),
            ("servoj([0,0,0,0,0,0], t=0.02)", 10),
            ("servoj([0,0,0,0,0,0], t=0)", 1),
            ("stopj(2)", 1),
        ] {
            let mut controller = controller();
            let text = format!("def a():\n  {call}\n  write_output_integer_register(0, 7)\nend\n");
            start(&mut controller, &text);
            let written = |controller: &Controller| controller.registers.output_int(0) == 7;
            let passed = (0..100).find(|_| {
                controller.cycle();
                written(&controller)
            });
            assert_eq!(passed, Some(needed), "{call}");
        }
    }

    #[test]
    fn a_secondary_program_runs_beside_the_other_and_a_third_in_its_place() {
        let mut controller = controller();
        start(
            &mut controller,
            "def first():\n  while True:\n    sync()\n  end\nend\n",
        );
        start(
            &mut controller,
            "sec aside():\n  write_output_boolean_register(64, True)\nend\n",
        );
        assert!(controller.registers.output_bit(64));
        let first = controller
            .running
            .as_ref()
            .map(|running| running.name().to_owned());
        assert_eq!(first.as_deref(), Some("first"));
        start(&mut controller, "set_payload(2.5)");
        controller.cycle();
        assert!(has_line(&controller, "program stopped by a new one"));
        assert_eq!(controller.output(OutputField::Payload), Value::Double(2.5));
        assert!(!controller.program_runs());
    }
}
