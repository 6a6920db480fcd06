//! The program of the maker's C++ client library, as far as it is emulated.
//!
//! Recognised by the sockets that it opens, not interpreted: it calls its client back on up to
//! three ports, and the client streams setpoints on one of them. `servoj` is emulated with the
//! program's own rules: what is too far is ignored, a cycle without a setpoint goes on at the
//! present speed, and silence for longer than the time-out that came with the last setpoint ends
//! the program, the arm braking. Any other mode, and any command that would move the arm, ends the
//! program with a line that names it, so that no client takes a motion for done that was not.

mod calls;
mod text;

use super::arm::Motion;
use super::running::ArmState;
use crate::registers::JOINTS;
pub(super) use calls::Calls;
use calls::{Line, Purpose};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};
use text::Parameters;

/// Frames taken from a socket in one cycle; what comes faster waits in the network.
const FRAMES_PER_CYCLE: usize = 16;

/// How often the log says that setpoints are ignored [s].
const SAY_EVERY_S: f64 = 5.0;

/// Commands that need something that is emulated: they end the program.
const NEEDED: [&str; 3] = ["START_FORCE_MODE", "START_TOOL_CONTACT", "END_TOOL_CONTACT"];

/// The program while it runs.
#[derive(Debug)]
pub(super) struct ExternalControl {
    parameters: Parameters,
    calls: Arc<Calls>,
    lines: Vec<Line>,
    /// The mode of the last frame; none before the first.
    mode: Option<i32>,
    /// Silence for longer than this ends it [s]; none is taken for ever.
    timeout_s: Option<f64>,
    silent_cycles: u64,
    heard_at: Instant,
    /// Where `servoj` is sent [rad].
    setpoint: [f64; JOINTS],
    /// Whether a setpoint came since the last cycle.
    is_fresh: bool,
    /// Setpoints ignored in a row.
    ignored: u64,
    motion: Motion,
    ending: Option<String>,
    said: Vec<String>,
    /// Commands that the log has named already.
    named: BTreeSet<i32>,
}

impl ExternalControl {
    /// The program in a text, if it is this one; an error if it cannot be emulated.
    pub(super) fn recognise(text: &str) -> Option<Result<Self, String>> {
        let parameters = match text::read(text)? {
            Ok(parameters) => parameters,
            Err(error) => return Some(Err(format!("external control: {error}"))),
        };
        Some(Ok(Self {
            calls: Arc::new(Calls::new(parameters.calls.clone())),
            parameters,
            lines: Vec::new(),
            mode: None,
            timeout_s: None,
            silent_cycles: 0,
            heard_at: Instant::now(),
            setpoint: [0.0; JOINTS],
            is_fresh: false,
            ignored: 0,
            motion: Motion::Rest,
            ending: None,
            said: Vec::new(),
            named: BTreeSet::new(),
        }))
    }

    /// The sockets that someone has to open for it.
    pub(super) fn calls(&self) -> &Arc<Calls> {
        &self.calls
    }

    /// Why it ends, once it does.
    pub(super) fn ending(&self) -> Option<&str> {
        self.ending.as_deref()
    }

    /// Lines for the log since it was asked last.
    pub(super) fn said(&mut self) -> Vec<String> {
        std::mem::take(&mut self.said)
    }

    /// One control cycle of the program.
    pub(super) fn cycle(&mut self, arm: &ArmState) -> Motion {
        if self.ending.is_some() {
            return self.motion;
        }
        if self.lines.is_empty() {
            match self.calls.take() {
                Ok(None) => return Motion::Rest,
                Ok(Some(lines)) => self.begin(lines),
                Err(error) => {
                    self.end(&error);
                    return self.motion;
                }
            }
        }
        self.silent_cycles += 1;
        self.take_commands();
        self.take_setpoints(arm);
        self.watch(arm);
        if self.ending.is_none() && self.mode == Some(self.parameters.servoj) {
            self.servo(arm);
        }
        self.motion
    }

    fn begin(&mut self, lines: Vec<Line>) {
        let calls = self.parameters.calls.iter();
        let ports: Vec<String> = calls
            .map(|call| format!("{}:{}", call.host, call.port))
            .collect();
        let line = format!("external control connected to {}", ports.join(", "));
        self.said.push(line);
        self.lines = lines;
        self.heard();
    }

    fn heard(&mut self) {
        (self.silent_cycles, self.heard_at) = (0, Instant::now());
    }

    fn end(&mut self, why: &str) {
        if self.ending.is_none() {
            self.motion = Motion::Brake(self.parameters.stop_deceleration);
            self.ending = Some(format!("external control ended: {why}"));
        }
    }

    /// The next frame of so many numbers on the socket of this purpose.
    fn frame(&mut self, purpose: Purpose, numbers: usize) -> Option<Vec<i32>> {
        let line = self.lines.iter_mut().find(|line| line.purpose == purpose)?;
        match line.frame(numbers) {
            Ok(frame) => frame,
            Err(error) => {
                if purpose == Purpose::Setpoints {
                    self.end(&format!("the socket of its setpoints is gone: {error}"));
                } else {
                    self.lines.retain(|line| line.purpose != purpose);
                }
                None
            }
        }
    }

    /// Commands that set what is not simulated are taken and named; others end the program.
    fn take_commands(&mut self) {
        for _ in 0..FRAMES_PER_CYCLE {
            let length = self.parameters.command_frame;
            let Some(frame) = self.frame(Purpose::Commands, length) else {
                return;
            };
            let number = frame[0];
            let name = self.parameters.commands.get(&number).cloned();
            match name {
                Some(name) if !NEEDED.contains(&name.as_str()) => {
                    if self.named.insert(number) {
                        self.said.push(format!(
                            "external control: {name} is taken but not simulated"
                        ));
                    }
                }
                name => {
                    let name = name.unwrap_or_else(|| format!("command {number}"));
                    self.end(&format!("{name} is not emulated"));
                    return;
                }
            }
        }
    }

    fn take_setpoints(&mut self, arm: &ArmState) {
        for _ in 0..FRAMES_PER_CYCLE {
            if self.ending.is_some() {
                return;
            }
            let Some(frame) = self.frame(Purpose::Setpoints, self.parameters.frame) else {
                return;
            };
            self.heard();
            // The frame is at least eight numbers long.
            let timeout_s = f64::from(frame[0]) * self.parameters.timeout_unit_s;
            self.timeout_s = (timeout_s > 0.0).then_some(timeout_s);
            self.switch_to(frame[frame.len() - 1], arm);
            if self.mode == Some(self.parameters.servoj) {
                let joint = |joint: usize| f64::from(frame[1 + joint]) / self.parameters.per_radian;
                self.set_target(std::array::from_fn(joint), arm);
            }
        }
    }

    fn switch_to(&mut self, mode: i32, arm: &ArmState) {
        if self.mode == Some(mode) {
            return;
        }
        let is_first = self.mode.is_none();
        self.mode = Some(mode);
        let Parameters {
            stopped,
            idle,
            servoj,
            stop_deceleration,
            ..
        } = self.parameters;
        if mode == stopped {
            self.end("by its client");
        } else if mode == servoj {
            self.setpoint = arm.q;
        } else if mode == idle {
            if !is_first {
                self.motion = Motion::Brake(stop_deceleration);
            }
        } else {
            self.refuse(mode);
        }
    }

    /// Ends the program in a mode that is not emulated, and says on the trajectory socket that
    /// whatever was wanted there has failed.
    fn refuse(&mut self, mode: i32) {
        let names = &self.parameters.modes;
        let name = names
            .get(&mode)
            .map_or_else(|| "an unknown mode".to_owned(), String::clone);
        let failure = self.parameters.trajectory_failure;
        let mut lines = self.lines.iter_mut();
        if let Some(line) = lines.find(|line| line.purpose == Purpose::Trajectory) {
            line.say(failure);
        }
        self.end(&format!("mode {mode} ({name}) is not emulated"));
    }

    /// Takes a setpoint unless it needs a speed that no joint has, from the last one and from
    /// where the arm is.
    fn set_target(&mut self, target: [f64; JOINTS], arm: &ArmState) {
        self.is_fresh = true;
        let largest = self.parameters.ignored_speed * arm.cycle_s;
        let is_near = |from: &[f64; JOINTS]| {
            let mut joints = target.iter().zip(from);
            joints.all(|(to, from)| (to - from).abs() <= largest)
        };
        if is_near(&self.setpoint) || is_near(&arm.q) {
            if self.ignored > 0 {
                self.said
                    .push("external control: setpoints are taken again".to_owned());
            }
            (self.setpoint, self.ignored) = (target, 0);
            return;
        }
        let elapsed = self.ignored as f64 * arm.cycle_s;
        if elapsed % SAY_EVERY_S < arm.cycle_s {
            self.said.push(format!(
                "external control: setpoint ignored: it is more than {} rad/s away",
                self.parameters.ignored_speed
            ));
        }
        self.ignored += 1;
    }

    /// Silence counts by the controller's clock, and by the computer's too: a controller that
    /// makes up for cycles that it missed has not waited.
    fn watch(&mut self, arm: &ArmState) {
        let Some(timeout_s) = self.timeout_s else {
            return;
        };
        let silent_s = self.silent_cycles as f64 * arm.cycle_s;
        if silent_s > timeout_s && self.heard_at.elapsed() > Duration::from_secs_f64(timeout_s) {
            self.end(&format!("no setpoint for {timeout_s} s"));
        }
    }

    /// `servoj` to the setpoint, or on at the present speed where none came.
    fn servo(&mut self, arm: &ArmState) {
        if !self.is_fresh {
            for (joint, speed) in self.setpoint.iter_mut().zip(&arm.target_qd) {
                *joint += speed * arm.cycle_s;
            }
        }
        self.is_fresh = false;
        self.motion = Motion::Servo {
            target: self.setpoint,
            lookahead_s: self.parameters.lookahead_s,
            gain: self.parameters.gain,
        };
    }
}

impl Drop for ExternalControl {
    fn drop(&mut self) {
        self.calls.cancel();
    }
}

#[cfg(test)]
mod tests;
