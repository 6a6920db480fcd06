//! An emulated UR controller with its arm, inside this process, reached over real TCP.
//!
//! | file | what it holds |
//! |---|---|
//! | `config` | which controller is emulated, and what can happen to it |
//! | `controller` | clock and safety, without threads or sockets |
//! | `outputs` | what the controller says of itself |
//! | `arm` | the joints: how they follow, brake, or refuse to jump |
//! | `registers`, `fields` | general-purpose registers; fields by name |
//! | `rtde`, `script_port` | the two protocols, without sockets |
//! | `state_message`, `dashboard` | the primary, real-time and dashboard ports, without sockets |
//! | `running`, `programs` | the program that runs; how one begins and ends |
//! | `script_program`, `watchdog` | interpreted programs, control cycle by control cycle |
//! | `servo_program` | tests of the servo program, run by the interpreter |
//! | `ur_rtde_program`, `external_control` | programs of other clients that are recognised |
//! | `arm`, `following` | the joints behind their servo; what they cannot follow |
//! | `log` | what the controller has to say |
//! | `power`, `faults` | what the pendant switches; what can be brought about |
//! | `kinematics`, `not_simulated` | where the tool is; fields that read the same for ever |
//! | `inbound`, `outbox` | what comes in on a connection, and what goes out |
//! | `world` | what the threads share |
//! | `server`, `clock` | the threads |
//!
//! It interprets a subset of `URScript` ([`crate::urscript`]), in which the servo program of this
//! crate is written, recognises the control program of `ur-rtde` by its registers and that of the
//! maker's C++ client library by its sockets, and refuses any other. Its servo, limits and stops are
//! assumed; see [`conik_sim::servo`].

mod arm;
mod clock;
mod config;
mod controller;
mod dashboard;
mod external_control;
pub mod faults;
mod fields;
mod following;
mod inbound;
mod kinematics;
mod log;
#[cfg(test)]
mod noise;
mod not_simulated;
mod outbox;
mod outputs;
mod power;
mod programs;
mod registers;
mod rtde;
mod running;
mod script_port;
mod script_program;
mod server;
#[cfg(test)]
mod servo_program;
mod state_message;
mod ur_rtde_program;
mod watchdog;
mod world;

pub use config::{EmulatorConfig, EmulatorError, Fault, Injection, Pace, Ports, Series};

use crate::driver::UrConfig;
use crate::driver::config::{RTDE_PORT, SCRIPT_PORT};
use crate::registers::JOINTS;
use crate::wire::Value;
use conik::JointVec;
use controller::Controller;
use fields::OutputField;
use inbound::Service;
use std::net::IpAddr;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;
use world::{Shared, World};

/// Every port of a controller. The secondary port comes before the primary one, whose protocol it
/// shares.
const SERVICES: [(Service, u16); 8] = [
    (Service::Rtde, RTDE_PORT),
    (Service::State, SCRIPT_PORT),
    (Service::State, 30_001),
    (Service::RealTime, 30_003),
    (Service::Dashboard, 29_999),
    (Service::StateReadOnly, 30_011),
    (Service::StateReadOnly, 30_012),
    (Service::RealTimeReadOnly, 30_013),
];

/// A running emulator. It ends, with all its threads and connections, when it is dropped.
#[derive(Debug)]
pub struct Emulator {
    config: EmulatorConfig,
    shared: Arc<Shared>,
    ports: Vec<(Service, u16)>,
    threads: Vec<JoinHandle<()>>,
}

impl Emulator {
    /// Opens the ports and starts the clock.
    pub fn start(config: EmulatorConfig) -> Result<Self, EmulatorError> {
        check(&config)?;
        let offset = match config.ports {
            Ports::Free => None,
            Ports::Real { offset } => Some(offset),
        };
        let port = |number: u16| match offset {
            None => Ok(0),
            Some(offset) => number.checked_add(offset).ok_or(EmulatorError::BadSetting {
                name: "port offset",
                value: f64::from(offset),
                need: "small enough that no port exceeds 65535",
            }),
        };
        let mut listeners = Vec::new();
        let mut ports = Vec::new();
        for (service, number) in SERVICES {
            let (listener, number) = server::listen(config.listen, port(number)?)?;
            listeners.push((service, listener));
            ports.push((service, number));
        }
        let shared = Arc::new(Shared {
            world: Mutex::new(World::new(Controller::new(&config)?)),
            changed: Condvar::new(),
            version: config.series.version(),
            rate_hz: config.rate_hz,
            pace: config.pace,
            real_time: config.real_time,
        });
        // From here on a failure drops the emulator, which ends the threads started so far.
        let mut emulator = Self {
            ports,
            config,
            shared,
            threads: Vec::new(),
        };
        for (service, listener) in listeners {
            let thread = server::serve(&emulator.shared, listener, service)?;
            emulator.threads.push(thread);
        }
        let shared = Arc::clone(&emulator.shared);
        let thread = thread::Builder::new()
            .name("emulator clock".to_owned())
            .spawn(move || clock::run(&shared))
            .map_err(EmulatorError::Thread)?;
        emulator.threads.push(thread);
        Ok(emulator)
    }

    /// How it was set up.
    pub fn config(&self) -> &EmulatorConfig {
        &self.config
    }

    /// The port that speaks RTDE.
    pub fn rtde_port(&self) -> u16 {
        self.port(Service::Rtde)
    }

    /// The secondary port: takes programs and sends the state.
    pub fn script_port(&self) -> u16 {
        self.port(Service::State)
    }

    /// The port that sends the state in every cycle, and takes programs.
    pub fn real_time_port(&self) -> u16 {
        self.port(Service::RealTime)
    }

    /// The port of the dashboard.
    pub fn dashboard_port(&self) -> u16 {
        self.port(Service::Dashboard)
    }

    /// The port that is open in the place of a controller's port `number`, 30004 for instance.
    pub fn port_in_place_of(&self, number: u16) -> Option<u16> {
        let mut places = SERVICES.iter().zip(&self.ports);
        let place = places.find(|((_, known), _)| *known == number);
        place.map(|(_, (_, port))| *port)
    }

    /// The first port of this service; every service has one.
    fn port(&self, service: Service) -> u16 {
        let mut ports = self.ports.iter();
        let found = ports.find(|(known, _)| *known == service);
        found.map_or(0, |(_, port)| *port)
    }

    /// Settings of a driver for this emulator: its ports, rate, pace and name.
    pub fn driver_config(&self) -> UrConfig {
        let host = match self.config.listen {
            any if any.is_unspecified() => match any {
                IpAddr::V4(_) => "127.0.0.1".to_owned(),
                IpAddr::V6(_) => "::1".to_owned(),
            },
            one => one.to_string(),
        };
        UrConfig {
            rtde_port: self.rtde_port(),
            script_port: self.script_port(),
            dashboard_port: self.dashboard_port(),
            name: Some(self.config.name.clone()),
            controller_rate_hz: Some(self.config.rate_hz),
            real_time: self.config.pace == Pace::WallTime,
            // A busy computer is no broken cable.
            link_timeout: match self.config.pace {
                Pace::WallTime => Duration::from_secs(2),
                Pace::Lockstep => Duration::from_secs(20),
            },
            program_timeout: Duration::from_secs(20),
            stop_timeout: Duration::from_secs(20),
            ..UrConfig::new(host)
        }
    }

    /// Lets something happen to the controller.
    pub fn inject(&self, injection: Injection) {
        lock(&self.shared.world).controller.inject(injection);
    }

    /// Brings a fault about.
    pub fn strike(&self, fault: Fault) {
        lock(&self.shared.world).strike(fault);
        self.shared.changed.notify_all();
    }

    /// Where the controller commands the joints at present [rad].
    pub fn target_q(&self) -> JointVec {
        match lock(&self.shared.world)
            .controller
            .output(OutputField::TargetQ)
        {
            Value::Vector6d(q) => q.into(),
            _ => self.config.q0,
        }
    }

    /// Control cycles since the start.
    pub fn cycles(&self) -> u64 {
        lock(&self.shared.world).controller.cycles()
    }

    /// Connections that are open at present, on all ports.
    pub fn connection_count(&self) -> usize {
        lock(&self.shared.world).connection_count()
    }

    /// What has happened, a line each with the controller's time; old lines fall out.
    pub fn log_lines(&self) -> Vec<String> {
        let world = lock(&self.shared.world);
        world.controller.log.lines().cloned().collect()
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        lock(&self.shared.world).close();
        self.shared.changed.notify_all();
        let diallers = lock(&self.shared.world).take_diallers();
        for thread in self.threads.drain(..).chain(diallers) {
            // A thread that panicked has nothing left to end.
            let _ = thread.join();
        }
    }
}

fn check(config: &EmulatorConfig) -> Result<(), EmulatorError> {
    if config.q0.len() != JOINTS {
        return Err(EmulatorError::JointCount(config.q0.len()));
    }
    if Series::of(config.arm) != config.series {
        let arm = config.arm.name();
        return Err(EmulatorError::OtherSeries { arm });
    }
    let positive = f64::MIN_POSITIVE..=f64::MAX;
    let settings = [
        ("rate [Hz]", config.rate_hz, 1.0..=1000.0, "1 to 1000"),
        (
            "largest step [rad]",
            config.largest_step,
            positive.clone(),
            "above zero",
        ),
        (
            "overspeed time [s]",
            config.overspeed_s,
            0.0..=1e6,
            "0 to a million",
        ),
        (
            "stop deceleration [rad/s²]",
            config.stop_deceleration,
            positive,
            "above zero",
        ),
    ];
    for (name, value, allowed, need) in settings {
        if !allowed.contains(&value) {
            return Err(EmulatorError::BadSetting { name, value, need });
        }
    }
    match config.q0.iter().find(|angle| !angle.is_finite()) {
        None => Ok(()),
        Some(value) => Err(EmulatorError::BadSetting {
            name: "q0 [rad]",
            value: *value,
            need: "finite",
        }),
    }
}

/// Locks even if a thread panicked while it held the lock: the emulator goes on for the others.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::TcpStream;

    /// Every thread holds a share of the world for as long as it lives.
    #[test]
    fn dropping_the_emulator_ends_all_its_threads() {
        for pace in [Pace::WallTime, Pace::Lockstep] {
            let config = EmulatorConfig {
                pace,
                ..EmulatorConfig::new(Series::E, JointVec::zeros(JOINTS))
            };
            let emulator = Emulator::start(config).unwrap();
            let world = Arc::downgrade(&emulator.shared);
            let clients = [emulator.rtde_port(), emulator.script_port()]
                .map(|port| TcpStream::connect(("127.0.0.1", port)).unwrap());
            while emulator.connection_count() < clients.len() {
                thread::yield_now();
            }
            drop(emulator);
            assert_eq!(world.strong_count(), 0, "{pace:?}");
        }
    }

    #[test]
    fn real_ports_are_those_of_a_controller_moved_by_the_offset() {
        let config = EmulatorConfig {
            ports: Ports::Real { offset: 40_000 },
            ..EmulatorConfig::new(Series::E, JointVec::zeros(JOINTS))
        };
        let error = Emulator::start(config).unwrap_err();
        assert!(error.to_string().contains("port offset"), "{error}");
    }
}
