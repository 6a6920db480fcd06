//! The primary, secondary and real-time interfaces: the state as these ports send it.
//!
//! All numbers big-endian. A message is an `int32` size, a `uint8` type and its contents; a state
//! message holds sub-packages of the same form.

use super::config::Series;
use super::controller::Controller;
use super::kinematics;
use super::log::Message;
use super::power::Power;
use crate::model::{ArmFacts, TWISTS};
use crate::registers::JOINTS;
use crate::wire::ControllerVersion;

const STATE: u8 = 16;
const MESSAGE: u8 = 20;
const TEXT_MESSAGE: u8 = 0;
const VERSION_MESSAGE: u8 = 3;
const RUNTIME_EXCEPTION: u8 = 10;

/// Who a message is from: the controller.
const CONTROLLER: u8 = 254;

/// Bytes of the real-time package, by which readers tell the versions apart.
fn real_time_size(series: Series) -> usize {
    match series {
        Series::Cb3 => 1108,
        Series::E => 1220,
    }
}

/// `joint_mode` of a joint in motion or ready for it, and of one without power.
const JOINT_RUNNING: u8 = 253;
const JOINT_POWER_OFF: u8 = 239;

/// Bytes that grow field by field.
#[derive(Default)]
struct Bytes(Vec<u8>);

impl Bytes {
    fn byte(&mut self, value: u8) -> &mut Self {
        self.0.push(value);
        self
    }
    fn flags(&mut self, values: &[bool]) -> &mut Self {
        self.0.extend(values.iter().map(|value| u8::from(*value)));
        self
    }
    fn int(&mut self, value: u32) -> &mut Self {
        self.0.extend(value.to_be_bytes());
        self
    }
    fn float(&mut self, value: f32) -> &mut Self {
        self.0.extend(value.to_be_bytes());
        self
    }
    fn doubles(&mut self, values: &[f64]) -> &mut Self {
        self.0
            .extend(values.iter().flat_map(|value| value.to_be_bytes()));
        self
    }
    /// With size and type in front.
    #[allow(clippy::cast_possible_truncation)] // Messages have some hundred bytes.
    fn packed(&self, kind: u8) -> Vec<u8> {
        let size = (self.0.len() + 5) as u32;
        [&size.to_be_bytes(), &[kind][..], &self.0].concat()
    }
}

/// What the primary and secondary ports say first: which software this is.
pub(super) fn version_message(version: ControllerVersion) -> Vec<u8> {
    let (project, date) = (b"URControl", b"01-01-2024, 00:00:00");
    let mut bytes = Bytes::default();
    bytes.doubles(&[]).0.extend(u64::MAX.to_be_bytes());
    bytes.byte(CONTROLLER).byte(VERSION_MESSAGE).byte(9);
    bytes.0.extend(project);
    #[allow(clippy::cast_possible_truncation)] // Both are below ten.
    bytes.byte(version.major as u8).byte(version.minor as u8);
    bytes.int(version.bugfix).int(version.build);
    bytes.0.extend(date);
    bytes.packed(MESSAGE)
}

impl Controller {
    /// The state message of the primary and secondary ports.
    pub(super) fn state_message(&self) -> Vec<u8> {
        let mut state = Bytes::default();
        for (kind, contents) in [
            (0, self.mode_data()),
            (1, self.joint_data()),
            (2, tool_data()),
            (3, masterboard_data(self)),
            (4, self.cartesian_data()),
            (5, kinematics_data(self.facts)),
            (6, self.configuration_data()),
        ] {
            state.0.extend(contents.packed(kind));
        }
        state.packed(STATE)
    }

    /// A message for people, as the primary and secondary ports send it: a run-time exception with
    /// line and column where it is about a line of a program, a text otherwise.
    pub(super) fn robot_message(&self, message: &Message) -> Vec<u8> {
        let mut bytes = Bytes::default();
        bytes.0.extend(self.microseconds().to_be_bytes());
        bytes.byte(CONTROLLER);
        match message.script_line {
            Some(line) => bytes.byte(RUNTIME_EXCEPTION).int(line).int(1),
            None => bytes.byte(TEXT_MESSAGE),
        };
        bytes.0.extend(message.text.bytes());
        bytes.packed(MESSAGE)
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Time is positive.
    fn microseconds(&self) -> u64 {
        (self.timestamp() * 1e6) as u64
    }

    fn mode_data(&self) -> Bytes {
        let mut bytes = Bytes::default();
        bytes.0.extend(self.microseconds().to_be_bytes());
        let (emergency, protective) = self.stops();
        bytes.flags(&[
            true,
            true,
            self.power != Power::Off,
            emergency,
            protective,
            self.program_runs(),
            self.paused,
        ]);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Modes are below ten.
        bytes.byte(self.robot_mode() as u8).byte(0);
        let slider = self.speed_scaling();
        bytes.doubles(&[slider, slider, 1.0]);
        // One byte more since 5.10; readers tell the versions apart by the size.
        if self.series == Series::E {
            bytes.byte(0);
        }
        bytes
    }

    fn joint_mode(&self) -> u8 {
        match self.power {
            Power::Off => JOINT_POWER_OFF,
            Power::Idle | Power::Running => JOINT_RUNNING,
        }
    }

    fn joint_data(&self) -> Bytes {
        let mut bytes = Bytes::default();
        for joint in 0..JOINTS {
            bytes.doubles(&[
                self.arm.actual_q()[joint],
                self.arm.q()[joint],
                self.arm.actual_qd()[joint],
            ]);
            // Current, voltage and two temperatures are not simulated.
            bytes.float(0.0).float(48.0).float(25.0).float(25.0);
            bytes.byte(self.joint_mode());
        }
        bytes
    }

    fn cartesian_data(&self) -> Bytes {
        let mut bytes = Bytes::default();
        bytes.doubles(&kinematics::pose(self.facts, &self.arm.actual_q()));
        bytes.doubles(&[0.0; 6]);
        bytes
    }

    fn configuration_data(&self) -> Bytes {
        let model = self.arm.model();
        let full_turn = std::f64::consts::TAU;
        let mut bytes = Bytes::default();
        for _ in 0..JOINTS {
            bytes.doubles(&[-full_turn, full_turn]);
        }
        for speed in self.facts.most_speed() {
            bytes.doubles(&[speed, model.acceleration_limit]);
        }
        bytes.doubles(&[1.05, 1.4, 0.25, 1.2, 0.25]);
        parameters(&mut bytes, self.facts);
        bytes.doubles(&[0.0; JOINTS]);
        // Masterboard version, controller box, robot type, subtype.
        bytes.int(0).int(0).int(self.facts.type_number()).int(0);
        bytes
    }

    /// The package of the real-time port.
    pub(super) fn real_time_package(&self) -> Vec<u8> {
        let (q, qd, qdd) = (self.arm.q(), self.target_qd(), self.arm.qdd());
        let (actual_q, actual_qd) = (self.arm.actual_q(), self.arm.actual_qd());
        let (pose, speed) = (
            kinematics::pose(self.facts, &actual_q),
            kinematics::twist(self.facts, &actual_q, &actual_qd),
        );
        let zeros = [0.0; 6];
        let mut values = Bytes::default();
        values.doubles(&[self.timestamp()]);
        for six in [q, qd, qdd, zeros, zeros, actual_q, actual_qd, zeros, zeros] {
            values.doubles(&six);
        }
        values.doubles(&pose).doubles(&speed).doubles(&zeros);
        values
            .doubles(&kinematics::pose(self.facts, &q))
            .doubles(&kinematics::twist(self.facts, &q, &qd));
        values
            .doubles(&[0.0])
            .doubles(&[25.0; 6])
            .doubles(&[0.0, 0.0]);
        values.doubles(&[f64::from(self.robot_mode())]);
        values.doubles(&[f64::from(self.joint_mode()); 6]);
        values
            .doubles(&[f64::from(self.safety_mode())])
            .doubles(&[0.0; 6]);
        values.doubles(&[0.0, 0.0, 9.81]).doubles(&[0.0; 6]);
        values
            .doubles(&[self.speed_scaling(), 0.0, 48.0, 48.0, 0.0])
            .doubles(&[48.0; 6]);
        #[allow(clippy::cast_precision_loss)] // A few bits.
        values.doubles(&[self.digital_outputs() as f64]);
        values.doubles(&[f64::from(self.runtime_state())]);
        let mut package = Bytes::default();
        let size = real_time_size(self.series);
        #[allow(clippy::cast_possible_truncation)] // 1220.
        package.int(size as u32).0.extend(values.0);
        // Elbow, forces and payload are not simulated.
        package.0.resize(size, 0);
        package.0
    }
}

fn tool_data() -> Bytes {
    let mut bytes = Bytes::default();
    bytes
        .byte(0)
        .byte(0)
        .doubles(&[0.0, 0.0])
        .float(0.0)
        .byte(0);
    bytes.float(0.0).float(25.0).byte(JOINT_RUNNING);
    bytes
}

fn masterboard_data(controller: &Controller) -> Bytes {
    let mut bytes = Bytes::default();
    #[allow(clippy::cast_possible_truncation)] // 18 bits.
    bytes.int(0).int(controller.digital_outputs() as u32);
    bytes
        .byte(0)
        .byte(0)
        .doubles(&[0.0, 0.0])
        .byte(0)
        .byte(0)
        .doubles(&[0.0, 0.0]);
    bytes.float(25.0).float(48.0).float(0.0).float(0.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Modes are below ten.
    bytes.byte(controller.safety_mode() as u8).byte(0).byte(0);
    bytes.int(0).byte(1).byte(0).byte(0);
    bytes
}

/// a, d and α of each joint.
fn parameters(bytes: &mut Bytes, arm: &ArmFacts) {
    bytes
        .doubles(&arm.lengths)
        .doubles(&arm.offsets)
        .doubles(&TWISTS);
}

fn kinematics_data(arm: &ArmFacts) -> Bytes {
    let mut bytes = Bytes::default();
    for joint in 1..=6 {
        bytes.int(joint);
    }
    bytes.doubles(&[0.0; JOINTS]);
    parameters(&mut bytes, arm);
    bytes.int(1);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::EmulatorConfig;
    use conik::JointVec;

    fn controller(series: Series) -> Controller {
        let config = EmulatorConfig::new(series, JointVec::zeros(JOINTS));
        Controller::new(&config).unwrap()
    }

    /// The mode's package has one byte more since 5.10.
    #[test]
    fn sub_packages_have_the_sizes_that_strict_readers_expect() {
        for (series, mode) in [(Series::Cb3, 46), (Series::E, 47)] {
            let message = controller(series).state_message();
            let mut rest = &message[5..];
            let mut sizes = Vec::new();
            while let Some((size, _)) = rest.split_first_chunk::<4>() {
                let size = u32::from_be_bytes(*size) as usize;
                sizes.push((rest[4], size));
                rest = &rest[size..];
            }
            let published = [
                (0, mode),
                (1, 251),
                (2, 37),
                (3, 75),
                (4, 101),
                (5, 225),
                (6, 445),
            ];
            assert_eq!(sizes, published, "{series:?}");
        }
    }

    /// The last sub-package: parameters of the arm, four zero-filled or fixed words apart.
    #[test]
    fn the_configuration_tells_the_arm_that_it_is() {
        for (arm, number) in [("UR5", 1), ("UR10e", 2), ("UR20", 7)] {
            let arm = ArmFacts::ALL.iter().find(|known| known.name() == arm);
            let arm = arm.unwrap();
            let config = EmulatorConfig::of(arm, JointVec::zeros(JOINTS));
            let message = Controller::new(&config).unwrap().state_message();
            let configuration = &message[message.len() - 445..];
            let double = |at: usize| {
                let bytes = configuration[at..].first_chunk::<8>().unwrap();
                f64::from_be_bytes(*bytes)
            };
            // Size and kind, 12 pairs, 5 defaults; then a and d.
            let lengths = 5 + 8 * (24 + 5);
            assert_eq!(double(lengths + 8), arm.lengths[1]);
            assert_eq!(double(lengths + 8 * JOINTS), arm.offsets[0]);
            let said = configuration[445 - 8..].first_chunk::<4>().unwrap();
            assert_eq!(u32::from_be_bytes(*said), number, "{}", arm.name());
        }
    }

    #[test]
    fn the_real_time_package_has_the_size_of_its_version_and_says_so() {
        for (series, size) in [(Series::Cb3, 1108_u32), (Series::E, 1220)] {
            let package = controller(series).real_time_package();
            assert_eq!(package.len(), size as usize, "{series:?}");
            assert_eq!(package[..4], size.to_be_bytes());
        }
    }
}
