//! Where the controller is and how it is to be driven.

use super::recover::UNLOCK_AFTER;
use crate::program::Pose;
use crate::registers::{JOINTS, RegisterBase};
use crate::servoj::Servoj;
use conik_sim::scenario::{UrModel, UrSeries, UrSettings};
use std::f64::consts::TAU;
use std::net::IpAddr;
use std::time::Duration;

/// The controller's port for RTDE.
pub const RTDE_PORT: u16 = 30004;

/// The controller's port that runs any program sent to it (the secondary interface).
pub const SCRIPT_PORT: u16 = 30002;

/// How much of its speed limit a joint's speed may change from one reference to the next where no
/// acceleration limit is set.
pub const SPEED_CHANGE_ALLOWED: f64 = 0.75;

/// An offset with which a port would be none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("--port-offset: no port may exceed 65535")]
pub struct BadPortOffset;

/// A host that cannot be one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "'{0}' is no host: give the controller's name or address alone, such as 192.168.0.10, without \
     a port and without `http://`"
)]
pub struct BadHost(String);

/// The controller's port for the dashboard.
pub const DASHBOARD_PORT: u16 = 29999;

/// Where the controller is and how it is to be driven.
#[derive(Clone, Debug, PartialEq)]
pub struct UrConfig {
    /// Name or address of the controller.
    pub host: String,
    /// Port for RTDE.
    pub rtde_port: u16,
    /// Port for the servo program.
    pub script_port: u16,
    /// Port for the dashboard.
    pub dashboard_port: u16,
    /// What to call the arm in front of people; `None`: what the controller says it is.
    pub name: Option<String>,
    /// The controller's own rate [Hz], where its version does not tell (an emulator).
    pub controller_rate_hz: Option<f64>,
    /// Whether the controller's clock runs on its own. Only an emulator in lockstep waits for us.
    pub real_time: bool,
    /// `servoj`'s parameters at the start.
    pub servoj: Servoj,
    /// How long the controller bridges missing references with `qd_ref` before it stops [s].
    pub extrapolate_s: f64,
    /// Deceleration when the program stops the arm [rad/s²].
    pub stop_deceleration: f64,
    /// How long the program on the controller waits for the first reference [s].
    pub first_reference_within_s: f64,
    /// Where the transport's registers begin.
    pub registers: RegisterBase,
    /// Mass on the flange [kg]; `None`: the installation's.
    pub payload_kg: Option<f64>,
    /// The tool in the flange's frame; `None`: the installation's.
    pub tcp: Option<Pose>,
    /// The series that the controller must be of; `None`: any.
    pub series: Option<UrSeries>,
    /// The model that the dashboard must name; `None`: any.
    pub model: Option<UrModel>,
    /// The arm whose kinematics the references come from, which must be that model too; `None`: not
    /// known.
    pub robot: Option<UrModel>,
    /// Check everything, send nothing: no register is claimed, no program sent, no reference
    /// written.
    pub dry_run: bool,
    /// Speed that no reference may ask a joint to exceed [rad/s]; `None`: what the maker says of the
    /// arm, or π where nobody says which one it is.
    pub speed_limit: Option<[f64; JOINTS]>,
    /// Acceleration that no two steps from reference to reference may ask of a joint [rad/s²].
    /// `None`: from one reference to the next its speed may change by [`SPEED_CHANGE_ALLOWED`] of
    /// its speed limit, which lets the jumps of a first-order control law pass.
    pub acceleration_limit: Option<[f64; JOINTS]>,
    /// Magnitude that no reference may ask a joint to exceed [rad].
    pub position_limit: [f64; JOINTS],
    /// How far the first reference may be from the arm, besides one cycle at the speed limit [rad].
    pub first_reference_tolerance: f64,
    /// Time to connect.
    pub connect_timeout: Duration,
    /// Silence after which the link counts as lost.
    pub link_timeout: Duration,
    /// For how long to try again where an input register is in use: a connection that has died may
    /// linger.
    pub in_use_patience: Duration,
    /// Time from sending the servo program until it runs.
    pub program_timeout: Duration,
    /// Time from asking for a stop until the program has ended.
    pub stop_timeout: Duration,
    /// Time to leave a protective stop alone before it is unlocked.
    pub unlock_after: Duration,
    /// Time for each step of a recovery: the arm's own start takes some seconds.
    pub recover_timeout: Duration,
}

impl UrConfig {
    /// A real controller with the maker's ports and gentle settings.
    pub fn new(host: impl Into<String>) -> Self {
        Self {
            host: host.into(),
            rtde_port: RTDE_PORT,
            script_port: SCRIPT_PORT,
            dashboard_port: DASHBOARD_PORT,
            name: None,
            controller_rate_hz: None,
            real_time: true,
            servoj: Servoj {
                lookahead_s: 0.1,
                gain: 300.0,
            },
            extrapolate_s: 0.04,
            stop_deceleration: 4.0,
            first_reference_within_s: 60.0,
            registers: RegisterBase::default(),
            payload_kg: None,
            tcp: None,
            series: None,
            model: None,
            robot: None,
            dry_run: false,
            speed_limit: None,
            acceleration_limit: None,
            position_limit: [TAU; JOINTS],
            first_reference_tolerance: 1e-3,
            connect_timeout: Duration::from_secs(3),
            link_timeout: Duration::from_millis(500),
            in_use_patience: Duration::from_secs(2),
            program_timeout: Duration::from_secs(5),
            stop_timeout: Duration::from_secs(3),
            unlock_after: UNLOCK_AFTER,
            recover_timeout: Duration::from_secs(30),
        }
    }

    /// Takes over what a scenario says of the arm, all but the host.
    ///
    /// Limits that are not for six joints are left out: no such robot can be driven anyway.
    pub fn apply(&mut self, settings: &UrSettings) {
        let six = |limits: &Option<Vec<f64>>| limits.as_deref()?.try_into().ok();
        self.series = settings.series;
        self.model = settings.model;
        let servoj = &mut self.servoj;
        servoj.lookahead_s = settings.servo_lookahead_s.unwrap_or(servoj.lookahead_s);
        servoj.gain = settings.servo_gain.unwrap_or(servoj.gain);
        self.extrapolate_s = settings.bridge_s.unwrap_or(self.extrapolate_s);
        self.payload_kg = settings.payload_kg.or(self.payload_kg);
        if let Some([x, y, z]) = settings.tcp_offset_m {
            let [rx, ry, rz] = settings.tcp_rotation_rad.unwrap_or_default();
            self.tcp = Some(Pose([x, y, z, rx, ry, rz]));
        }
        self.position_limit = six(&settings.most_position_rad).unwrap_or(self.position_limit);
        self.speed_limit = six(&settings.most_speed_rad_per_s).or(self.speed_limit);
        self.acceleration_limit =
            six(&settings.most_acceleration_rad_per_s2).or(self.acceleration_limit);
    }

    /// Whether the host can be one at all, before anybody looks for it.
    pub fn check_host(&self) -> Result<(), BadHost> {
        // An address of IPv6 may name the network card behind it.
        let address = self.host.split('%').next().unwrap_or_default();
        let is_name = |host: &str| {
            let known = |letter: char| letter.is_alphanumeric() || "-._".contains(letter);
            !host.is_empty() && host.chars().all(known)
        };
        if address.parse::<IpAddr>().is_ok() || is_name(&self.host) {
            return Ok(());
        }
        Err(BadHost(self.host.clone()))
    }

    /// Adds `offset` to every port, as an emulator beside others has it.
    pub fn offset_ports(&mut self, offset: u16) -> Result<(), BadPortOffset> {
        for port in [
            &mut self.rtde_port,
            &mut self.script_port,
            &mut self.dashboard_port,
        ] {
            *port = port.checked_add(offset).ok_or(BadPortOffset)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_host_is_a_name_or_an_address_and_nothing_more() {
        for (host, is_one) in [
            ("192.168.0.10", true),
            ("ur5e-left.cell_3.local", true),
            ("::1", true),
            ("fe80::1%eth0", true),
            ("", false),
            ("a b", false),
            ("192.168.0.10:30004", false),
            ("http://192.168.0.10", false),
            ("[::1]", false),
        ] {
            assert_eq!(UrConfig::new(host).check_host().is_ok(), is_one, "{host}");
        }
    }
}
