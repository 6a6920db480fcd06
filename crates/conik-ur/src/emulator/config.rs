//! What kind of controller is emulated, and how its clock goes.

use conik::JointVec;
use conik_sim::servo::BadServoModel;
use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr};

use crate::model::ArmFacts;
use crate::wire::ControllerVersion;
use conik_sim::scenario::{UrModel, UrSeries};

/// The series of a controller: its rate and its software's version.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Series {
    /// CB3: 125 Hz.
    Cb3,
    /// e-Series: 500 Hz.
    E,
}

impl Series {
    /// The series of an arm.
    pub fn of(arm: &ArmFacts) -> Self {
        match arm.series {
            UrSeries::Cb3 => Self::Cb3,
            UrSeries::ESeries => Self::E,
        }
    }

    /// The rate of a real controller of this series [Hz].
    pub fn rate_hz(self) -> f64 {
        match self {
            Self::Cb3 => 125.0,
            Self::E => 500.0,
        }
    }

    /// The version that the emulated controller gives.
    pub(super) fn version(self) -> ControllerVersion {
        let (major, minor) = match self {
            Self::Cb3 => (3, 15),
            Self::E => (5, 13),
        };
        ControllerVersion {
            major,
            minor,
            bugfix: 0,
            build: 0,
        }
    }
}

/// Which ports the emulator listens on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ports {
    /// Any that are free.
    Free,
    /// Those of a real controller, all moved by `offset`.
    Real {
        /// Added to each port.
        offset: u16,
    },
}

/// How the emulator's clock goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// As a real controller's: no client is waited for.
    WallTime,
    /// One cycle at a time, each after the client has answered the package of the cycle before: as
    /// fast as the client computes, and the same motion in every run.
    ///
    /// The client waited for is the one that has claimed inputs and receives outputs; before it is
    /// there and after its program has ended, the clock goes on its own. A client that stays
    /// silent for seconds is passed over for a cycle, so that nothing hangs.
    Lockstep,
}

/// An emulated controller and its arm.
#[derive(Clone, Debug, PartialEq)]
pub struct EmulatorConfig {
    /// What to call the arm in front of people.
    pub name: String,
    /// The arm, of the same series.
    pub arm: &'static ArmFacts,
    /// The series that it claims to be.
    pub series: Series,
    /// Control rate [Hz], 1 to 1000; a real controller has [`Series::rate_hz`].
    pub rate_hz: f64,
    /// Where its six joints stand at first [rad].
    pub q0: JointVec,
    /// Address to listen on.
    pub listen: IpAddr,
    /// Whether programs are taken from the network, as in an e-Series' remote control.
    pub remote_control: bool,
    /// Ports to listen on.
    pub ports: Ports,
    /// How its clock goes.
    pub pace: Pace,
    /// Whether the clock, and the threads that speak RTDE, ask the system to go before others.
    pub real_time: bool,
    /// Largest acceleration of every joint [rad/s²]; the real figure is not published.
    pub acceleration_limit: f64,
    /// A larger step of `servoj`'s target from one call to the next makes a protective stop [rad].
    /// Our choice: the real threshold is not published.
    pub largest_step: f64,
    /// Following may need more than the speed limit for so long; then a protective stop is made [s].
    /// Our choice, as is [`Self::largest_step`].
    pub overspeed_s: f64,
    /// Deceleration of a stop that no program commands [rad/s²]; the real figure is not published.
    pub stop_deceleration: f64,
}

impl EmulatorConfig {
    /// A UR5 or UR5e at `q0` [rad] on free ports of this computer, at its series' rate, in wall time.
    pub fn new(series: Series, q0: JointVec) -> Self {
        let ur5 = |arm: &&'static ArmFacts| arm.model == UrModel::Ur5 && Series::of(arm) == series;
        let arm = ArmFacts::ALL.iter().find(ur5);
        Self::of(arm.unwrap_or(&ArmFacts::ALL[0]), q0)
    }

    /// The arm of a built-in robot, at `q0` [rad] and this rate [Hz], in wall time: `ur10e` is a UR10e.
    ///
    /// Where the name has no series (`ur5-paper`), or one that is not so fast, the rate says which; a robot
    /// that is of another maker has a UR5.
    pub fn for_robot(robot: &str, rate_hz: f64, q0: JointVec) -> Self {
        let can = |arm: &&ArmFacts| rate_hz <= Series::of(arm).rate_hz();
        let mut arms = ArmFacts::ALL.iter();
        let named = arms.find(|arm| arm.name().eq_ignore_ascii_case(robot));
        let (series, of_series) = if rate_hz <= Series::Cb3.rate_hz() {
            (Series::Cb3, UrSeries::Cb3)
        } else {
            (Series::E, UrSeries::ESeries)
        };
        let nearest = || ArmFacts::of(UrModel::in_name(robot)?, of_series);
        let config = match named.filter(can).or_else(nearest) {
            Some(arm) => Self::of(arm, q0),
            None => Self::new(series, q0),
        };
        Self { rate_hz, ..config }
    }

    /// This arm at `q0` [rad], likewise.
    pub fn of(arm: &'static ArmFacts, q0: JointVec) -> Self {
        let series = Series::of(arm);
        Self {
            name: format!("emulated {}", arm.name()),
            arm,
            series,
            rate_hz: series.rate_hz(),
            q0,
            listen: IpAddr::V4(Ipv4Addr::LOCALHOST),
            remote_control: true,
            ports: Ports::Free,
            pace: Pace::WallTime,
            real_time: false,
            acceleration_limit: 40.0,
            largest_step: 0.1,
            overspeed_s: 0.25,
            stop_deceleration: 10.0,
        }
    }
}

/// Something that happens to the controller from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Injection {
    /// A protective stop, as after a collision.
    ProtectiveStop,
    /// Someone presses the emergency stop.
    EmergencyStop,
    /// Someone presses stop on the pendant.
    StopProgram,
    /// Someone presses pause on the pendant.
    PauseProgram,
    /// The clock begins anew, as after a restart of the controller.
    RestartClock,
    /// Stops are released, the arm is powered and ready again.
    Release,
}

/// A fault that can be brought about while the emulator runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// Something happens to the controller.
    Event(Injection),
    /// The clock leaps ahead [s].
    ClockJump(f64),
    /// Each package of outputs is left out with this probability.
    Drop(f64),
    /// Packages of outputs wait so long [s], rounded to cycles.
    Delay(f64),
    /// Packages of outputs wait up to so much longer [s].
    Jitter(f64),
    /// No outputs are sent for so long [s], as when the controller is busy.
    Freeze(f64),
    /// All RTDE connections are cut.
    Reset,
    /// All RTDE connections fall silent in both directions but stay open.
    HalfOpen,
    /// A fieldbus claims the input of this name.
    RegisterInUse(String),
    /// So many packages of outputs lack their last byte.
    BadPackages(u32),
    /// Whether everything is written one byte at a time.
    OneByte(bool),
    /// Another one, so much later by the controller's cycles [s].
    After(f64, Box<Fault>),
}

/// Why an emulator cannot start.
#[derive(Debug, thiserror::Error)]
pub enum EmulatorError {
    /// A UR arm has six joints.
    #[error("q0 has {0} joints; a UR arm has 6")]
    JointCount(usize),
    /// An arm of the other series.
    #[error("{arm} is no arm of the controller's series")]
    OtherSeries {
        /// Its name.
        arm: String,
    },
    /// A setting outside of what is possible.
    #[error("the emulator's {name} is {value}; it must be {need}")]
    BadSetting {
        /// Which setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is possible.
        need: &'static str,
    },
    /// The servo cannot have these limits.
    #[error(transparent)]
    Servo(#[from] BadServoModel),
    /// No port could be opened.
    #[error("port {port} of {address} cannot be opened: {cause}{}", remedy(.cause))]
    Listen {
        /// The address.
        address: IpAddr,
        /// The port; 0 is any free one.
        port: u16,
        /// What the system said.
        cause: io::Error,
    },
    /// No thread could be started.
    #[error("a thread could not be started: {0}")]
    Thread(io::Error),
}

/// What may help when a port cannot be opened.
fn remedy(cause: &io::Error) -> &'static str {
    match cause.kind() {
        ErrorKind::AddrInUse => "; another program holds it: end it, or take another port offset",
        ErrorKind::AddrNotAvailable => "; listen on an address of this computer",
        ErrorKind::PermissionDenied => "; ports below 1024 are for the system",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robot_has_the_arm_of_its_name_in_a_series_that_is_fast_enough() {
        for (robot, rate_hz, arm) in [
            ("ur5-paper", 125.0, "UR5"),
            ("ur5-paper", 500.0, "UR5e"),
            ("ur10e", 125.0, "UR10e"),
            ("ur10", 125.0, "UR10"),
            ("ur10", 250.0, "UR10e"),
            ("ur30", 125.0, "UR30"),
            ("mine", 125.0, "UR5"),
            ("mine", 126.0, "UR5e"),
        ] {
            let config = EmulatorConfig::for_robot(robot, rate_hz, JointVec::zeros(6));
            assert_eq!(config.arm.name(), arm, "{robot} at {rate_hz} Hz");
            assert_eq!(config.rate_hz, rate_hz);
            assert_eq!(config.series, Series::of(config.arm));
        }
    }
}
