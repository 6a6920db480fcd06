//! One connection to a controller: handshake, servo program, references, stop.

use super::config::UrConfig;
use super::connect::connect;
use super::fault;
use super::guard::Guard;
use super::identity::Identity;
use super::pace::{self, Pace, Stamp};
use super::plan;
use super::rate::RateCheck;
use crate::program::ServoProgram;
use crate::registers::{Command, DOUBLES, INTS, JOINTS, Phase};
use crate::servoj::Servoj;
use crate::session::{Session, SessionError};
use crate::status::{Status, runtime_state};
use crate::wire::Value;
use conik_sim::arm::{ArmError, Feedback, Reference};
use conik_sim::cycle_times::CycleTimes;
use std::fmt::Display;
use std::io::Write;
use std::mem;
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

/// Between two tries to claim registers that are in use.
const CLAIM_EVERY: Duration = Duration::from_millis(100);

/// A connection on which the servo program runs.
#[derive(Debug)]
pub(super) struct Link {
    session: Session<TcpStream>,
    program: ServoProgram,
    guard: Guard,
    status: Status,
    /// When `status` came.
    status_came: Instant,
    pace: Pace,
    /// Nothing is ever written.
    dry_run: bool,
    stop_timeout: Duration,
    /// What was sent last; a stop repeats it.
    sent: Sent,
    /// How `servoj` is to follow from the next reference on.
    servoj: Servoj,
    turn: Turn,
    times: CycleTimes,
    /// Whether a fault is why the program is told to stop.
    stops_by_fault: bool,
}

/// The values of the input registers.
#[derive(Clone, Copy, Debug)]
struct Sent {
    counter: i32,
    q: [f64; JOINTS],
    qd: [f64; JOINTS],
    servoj: Servoj,
}

/// Who is expected to do what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    /// No cycle has been waited for yet.
    FirstCycle,
    /// A cycle has begun; its reference may be sent.
    Reference,
    /// The reference of this cycle is sent.
    Cycle,
}

impl Link {
    /// Connects, checks that the arm may move, and brings the servo program to where it waits for
    /// the first reference. Nothing moves.
    ///
    /// `acknowledged` is a session after which the arm was armed anew already. `say` hears what could not be checked or had to be waited for.
    pub(super) fn open(
        config: &UrConfig,
        rate_hz: f64,
        acknowledged: Option<i32>,
        say: &mut dyn FnMut(&str),
    ) -> Result<Self, ArmError> {
        let stream = connect(config, config.rtde_port)?;
        let mut session = Session::greet_within(stream, config.link_timeout)
            .map_err(|error| fault::of_session(&error))?;
        let version = session.version();
        plan::check_series(config, version)?;
        plan::check_registers(config, version)?;
        let every = plan::cycles_per_reference(config, version, rate_hz)?;
        let bad_setting =
            |error: &dyn Display| ArmError::new(fault::BAD_SETTING, error.to_string());
        config.servoj.check().map_err(|error| bad_setting(&error))?;
        let mut program = plan::program(config, rate_hz)?;
        program.check().map_err(|error| bad_setting(&error))?;
        // Before packages come: none waits meanwhile.
        let identity = Identity::ask_and_check(config, say)?;
        let arm = identity.arm(config, plan::series_of(version));
        let speed_limit = plan::speed_limit(config, arm, say);

        let status = subscribe(
            &mut session,
            config,
            plan::output_frequency(plan::controller_rate(config, version), every),
            say,
        )
        .map_err(|error| fault::of_session(&error))?;
        if let Some(hindrance) = plan::hindrance_of_run(&status, acknowledged) {
            return Err(hindrance);
        }
        program.session = plan::session_number(status.session);
        let text = program.text().map_err(|error| bad_setting(&error))?;
        let pace = Pace {
            cycle_s: program.cycle_s,
            bridged_cycles: program.extrapolated_cycles,
            leap_allowed: config.link_timeout,
            real_time: config.real_time,
        };
        let mut link = Self {
            session,
            program,
            guard: Guard::new(config, speed_limit, 1.0 / rate_hz),
            status,
            status_came: Instant::now(),
            pace,
            dry_run: config.dry_run,
            stop_timeout: config.stop_timeout,
            sent: Sent {
                counter: 0,
                q: status.target_q,
                qd: [0.0; JOINTS],
                servoj: config.servoj,
            },
            servoj: config.servoj,
            turn: Turn::FirstCycle,
            times: CycleTimes::default(),
            stops_by_fault: false,
        };
        if config.dry_run {
            return Ok(link);
        }
        link.run_program(config, &text)
            .inspect_err(|_| link.give_up())?;
        Ok(link)
    }

    /// Sends the servo program and waits until it runs. Every package is answered, as later in the
    /// run: a controller in lockstep waits for that.
    fn run_program(&mut self, config: &UrConfig, text: &str) -> Result<(), ArmError> {
        self.write(Command::Idle)?;
        // Kept open until the program runs: closing while the controller's state messages lie
        // unread would reset the connection, and the program could be lost with it.
        let mut script = connect(config, config.script_port)?;
        script.write_all(text.as_bytes()).map_err(|error| {
            let detail = format!("the servo program could not be sent: {error}");
            ArmError::new(fault::LINK_LOST, detail)
        })?;
        let deadline = Instant::now() + config.program_timeout;
        let mut rate = RateCheck::default();
        loop {
            let before = self.status.timestamp;
            let passed_over = self.read()?;
            rate.add(self.status.timestamp - before, 1 + passed_over);
            self.write(Command::Idle)?;
            if let Some(fault) = fault::of_arm(&self.status) {
                return Err(fault);
            }
            let ours = self.status.session == self.program.session;
            if ours && self.status.phase == Some(Phase::Waiting) && self.status.program_is_running()
            {
                return rate.check(self.pace.cycle_s);
            }
            if Instant::now() > deadline {
                return Err(self.program_not_started(config));
            }
        }
    }

    fn program_not_started(&self, config: &UrConfig) -> ArmError {
        let said = self
            .session
            .last_text()
            .map_or_else(String::new, |message| {
                format!("; the controller said: {}", message.text)
            });
        let detail = format!(
            "the servo program does not run {:.1} s after it was sent to port {}: an e-Series \
             must be in remote control, and no error may stand on the pendant{said}",
            config.program_timeout.as_secs_f64(),
            config.script_port
        );
        ArmError::new(fault::PROGRAM_NOT_STARTED, detail)
    }

    /// What the controller last said of itself.
    pub(super) fn status(&self) -> &Status {
        &self.status
    }

    /// The number that the servo program hands back.
    pub(super) fn session(&self) -> i32 {
        self.program.session
    }

    /// From the next reference on; the parameters are checked already.
    pub(super) fn set_servoj(&mut self, servoj: Servoj) {
        self.servoj = servoj;
    }

    /// How the cycles came and were answered so far.
    pub(super) fn times(&self) -> &CycleTimes {
        &self.times
    }

    pub(super) fn take_times(&mut self) -> CycleTimes {
        mem::take(&mut self.times)
    }

    /// The series and its software, for people.
    pub(super) fn series_name(&self) -> String {
        let version = self.session.version();
        format!("UR {} (software {version})", plan::series(version))
    }

    /// Waits for the controller's next cycle.
    pub(super) fn next_cycle(&mut self) -> Result<Feedback, ArmError> {
        let before = self.stamp();
        let passed_over = self.read().map_err(|fault| self.left_alone(fault))?;
        self.count(before);
        let fault = if self.dry_run {
            plan::hindrance(&self.status)
        } else {
            fault::of_run(&self.status, self.program.session)
        };
        if let Some(fault) = fault {
            return Err(fault);
        }
        let missed_cycles = if self.turn == Turn::FirstCycle {
            pace::goes_on(before, self.stamp()).map(|()| 0)?
        } else {
            self.pace.missed(before, self.stamp(), passed_over)?
        };
        self.times.missed(missed_cycles);
        self.turn = Turn::Reference;
        Ok(Feedback {
            q: Some(self.status.actual_q.into()),
            missed_cycles,
        })
    }

    /// A fault after which the controller cannot be told to stop the arm, or may not hear it.
    fn left_alone(&self, fault: ArmError) -> ArmError {
        if self.dry_run || self.sent.counter == 0 {
            return fault;
        }
        let detail = format!("{}; {}", fault.detail, self.stops_by_itself());
        ArmError::new(fault.name, detail)
    }

    fn stops_by_itself(&self) -> String {
        format!(
            "without references the servo program stops the arm by itself within {:.3} s: watch the \
             arm",
            self.program.cycle_s * f64::from(self.program.extrapolated_cycles + 1)
        )
    }

    /// Counts the package that has come; one that comes again is counted even if it ends the run.
    fn count(&mut self, before: Stamp) {
        if self.turn == Turn::FirstCycle {
            return;
        }
        let now = self.stamp();
        if now.timestamp <= before.timestamp {
            self.times.repeated();
        }
        let period = now.came.saturating_duration_since(before.came);
        self.times.came_after(period);
    }

    fn stamp(&self) -> Stamp {
        Stamp {
            timestamp: self.status.timestamp,
            came: self.status_came,
        }
    }

    /// Sends the reference of the present cycle, if it may be sent.
    pub(super) fn send(&mut self, reference: &Reference) -> Result<(), ArmError> {
        if self.turn != Turn::Reference {
            let detail = "one reference per cycle: wait for the next cycle before sending another";
            return Err(ArmError::new(fault::OUT_OF_TURN, detail));
        }
        // The first may take any time: nothing moves yet.
        if self.sent.counter != 0 {
            self.pace.answer_after(self.status_came.elapsed())?;
        }
        let checked = self.guard.check(reference, &self.status.target_q)?;
        self.sent = Sent {
            counter: self.sent.counter.wrapping_add(1),
            q: checked.q,
            qd: checked.qd,
            servoj: self.servoj,
        };
        self.turn = Turn::Cycle;
        if !self.dry_run {
            self.write(Command::Servo)
                .map_err(|fault| self.left_alone(fault))?;
        }
        self.times.answered_after(self.status_came.elapsed());
        Ok(())
    }

    /// Lets the servo program stop the arm and end, and waits until it has. `fault` is what ended the
    /// run, if something did.
    ///
    /// Where the program is over already, nothing is sent. One that is paused is told all the same:
    /// it then ends as soon as someone resumes it, instead of driving to where it once was sent.
    pub(super) fn stop(mut self, fault: Option<&ArmError>) -> Result<(), ArmError> {
        if self.dry_run {
            return Ok(());
        }
        self.stops_by_fault = fault.is_some_and(fault::latches_the_arm);
        let deadline = Instant::now() + self.stop_timeout;
        let end = loop {
            let ours = self.status.session == self.program.session;
            if !ours || self.status.runtime_state == runtime_state::STOPPED {
                return self.ended(fault);
            }
            if let Err(fault) = self.write(Command::Stop).and_then(|()| self.read()) {
                break fault.detail;
            }
            if self.status.program_is_still() {
                return self.ended(fault);
            }
            if Instant::now() > deadline {
                break "its program still runs".to_owned();
            }
        };
        let detail = format!(
            "the controller did not confirm the stop ({end}); {}, the emergency stop at hand",
            self.stops_by_itself()
        );
        Err(ArmError::new(fault::STOP_UNCONFIRMED, detail))
    }

    /// Whether the program ended by itself, or something else ended it while it stopped the arm.
    /// Where a fault had ended the run, that is the one to report.
    fn ended(&self, fault: Option<&ArmError>) -> Result<(), ArmError> {
        let in_order = [Phase::Waiting, Phase::Stopped, Phase::GaveUp];
        let ours = self.status.session == self.program.session;
        if fault.is_some() || ours && self.status.phase.is_some_and(|it| in_order.contains(&it)) {
            return Ok(());
        }
        let fault = fault::of_run(&self.status, self.program.session);
        Err(fault.unwrap_or_else(|| {
            let detail = "the servo program was ended while it stopped the arm";
            ArmError::new(fault::PROGRAM_STOPPED, detail)
        }))
    }

    /// Ends a servo program that may have been started, if it can still be reached.
    fn give_up(&mut self) {
        // The fault that led here is the one to report.
        let _ = self.write(Command::Stop);
    }

    /// Reads the newest status; returns how many older ones were passed over.
    fn read(&mut self) -> Result<u64, ArmError> {
        let latest = self
            .session
            .latest()
            .map_err(|error| fault::of_session(&error))?;
        self.status_came = Instant::now();
        self.status = Status::from_values(&latest.values).ok_or_else(|| {
            fault::of_session(&SessionError::OutOfOrder("the agreed output fields"))
        })?;
        Ok(latest.passed_over)
    }

    fn write(&mut self, command: Command) -> Result<(), ArmError> {
        let Sent {
            counter,
            q,
            qd,
            servoj,
        } = self.sent;
        let ints = [counter, command as i32, i32::from(self.stops_by_fault)];
        let doubles = [servoj.lookahead_s, servoj.gain, self.program.cycle_s];
        let doubles = q.into_iter().chain(qd).chain(doubles);
        let numbers = ints.map(Value::Int32).into_iter();
        let mut values = [Value::Int32(0); (INTS + DOUBLES) as usize];
        for (value, number) in values
            .iter_mut()
            .zip(numbers.chain(doubles.map(Value::Double)))
        {
            *value = number;
        }
        self.session
            .send(&values)
            .map_err(|error| fault::of_session(&error))
    }
}

fn subscribe(
    session: &mut Session<TcpStream>,
    config: &UrConfig,
    frequency_hz: f64,
    say: &mut dyn FnMut(&str),
) -> Result<Status, SessionError> {
    session.subscribe(frequency_hz, &Status::fields(config.registers))?;
    if !config.dry_run {
        claim(session, config, say)?;
    }
    session.start()?;
    let latest = session.latest()?;
    Status::from_values(&latest.values).ok_or(SessionError::OutOfOrder("the agreed output fields"))
}

/// Claims the registers of the references. One in use may belong to a connection that has died.
fn claim(
    session: &mut Session<TcpStream>,
    config: &UrConfig,
    say: &mut dyn FnMut(&str),
) -> Result<(), SessionError> {
    let deadline = Instant::now() + config.in_use_patience;
    let mut is_told = false;
    loop {
        match session.claim(&config.registers.inputs()) {
            Err(SessionError::InUse { names }) if Instant::now() < deadline => {
                if !is_told {
                    let seconds = config.in_use_patience.as_secs_f64();
                    let names = names.join(", ");
                    say(&format!(
                        "{names}: in use, perhaps by a connection that has just died; trying \
                         again for {seconds} s"
                    ));
                    is_told = true;
                }
                thread::sleep(CLAIM_EVERY);
            }
            result => return result,
        }
    }
}
