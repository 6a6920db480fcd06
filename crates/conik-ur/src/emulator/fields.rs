//! The fields that the emulated controller has, by name. Any other is `NOT_FOUND`.

use super::not_simulated::Constant;
use crate::registers::REGISTER_COUNT;
use crate::wire::{FieldType, Value};

/// A field that clients may read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutputField {
    Timestamp,
    TargetQ,
    TargetQd,
    TargetQdd,
    ActualQ,
    ActualQd,
    TargetTcpPose,
    TargetTcpSpeed,
    ActualTcpPose,
    ActualTcpSpeed,
    DigitalOutputs,
    AnalogOutput(usize),
    RobotMode,
    SafetyMode,
    RuntimeState,
    RobotStatusBits,
    SafetyStatusBits,
    SpeedScaling,
    TargetSpeedFraction,
    OutputInt(usize),
    OutputDouble(usize),
    OutputBit(usize),
    /// Bits 0 to 31, and 32 to 63.
    OutputBits(usize),
    Payload,
    TcpOffset,
    /// Inputs can be read back.
    Input(InputField),
    /// One that is not simulated.
    Constant(Constant),
}

/// A field that clients may write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum InputField {
    Int(usize),
    Double(usize),
    Bit(usize),
    /// Index in [`NAMED_INPUTS`].
    Named(usize),
}

/// Where the speed slider's mask and position, and the outputs' masks and values, stand in
/// [`NAMED_INPUTS`].
pub(super) const SLIDER_MASK: usize = 0;
pub(super) const SLIDER: usize = 1;
pub(super) const DIGITAL: [(usize, usize, u32); 3] = [(2, 3, 0), (4, 5, 8), (6, 7, 16)];
pub(super) const ANALOG_MASK: usize = 8;
pub(super) const ANALOG: [usize; 2] = [10, 11];

/// Where the input bits below 64 stand in [`NAMED_INPUTS`], 32 in each.
pub(super) const LOWER_BITS: [usize; 2] = [13, 14];

/// Inputs that are no registers.
pub(super) const NAMED_INPUTS: [(&str, Value); 15] = [
    ("speed_slider_mask", Value::Uint32(0)),
    ("speed_slider_fraction", Value::Double(0.0)),
    ("standard_digital_output_mask", Value::Uint8(0)),
    ("standard_digital_output", Value::Uint8(0)),
    ("configurable_digital_output_mask", Value::Uint8(0)),
    ("configurable_digital_output", Value::Uint8(0)),
    ("tool_digital_output_mask", Value::Uint8(0)),
    ("tool_digital_output", Value::Uint8(0)),
    ("standard_analog_output_mask", Value::Uint8(0)),
    ("standard_analog_output_type", Value::Uint8(0)),
    ("standard_analog_output_0", Value::Double(0.0)),
    ("standard_analog_output_1", Value::Double(0.0)),
    ("external_force_torque", Value::Vector6d([0.0; 6])),
    ("input_bit_registers0_to_31", Value::Uint32(0)),
    ("input_bit_registers32_to_63", Value::Uint32(0)),
];

/// Bit registers for clients: 64 to 127.
const BIT_REGISTERS: std::ops::Range<u8> = 64..128;

impl OutputField {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "timestamp" => Self::Timestamp,
            "target_q" => Self::TargetQ,
            "target_qd" => Self::TargetQd,
            "target_qdd" => Self::TargetQdd,
            "actual_q" => Self::ActualQ,
            "actual_qd" => Self::ActualQd,
            "target_TCP_pose" => Self::TargetTcpPose,
            "target_TCP_speed" => Self::TargetTcpSpeed,
            "actual_TCP_pose" => Self::ActualTcpPose,
            "actual_TCP_speed" => Self::ActualTcpSpeed,
            "actual_digital_output_bits" => Self::DigitalOutputs,
            "standard_analog_output0" => Self::AnalogOutput(0),
            "standard_analog_output1" => Self::AnalogOutput(1),
            "robot_mode" => Self::RobotMode,
            // In the states emulated here, both count alike.
            "safety_mode" | "safety_status" => Self::SafetyMode,
            "runtime_state" => Self::RuntimeState,
            "robot_status_bits" => Self::RobotStatusBits,
            "safety_status_bits" => Self::SafetyStatusBits,
            "speed_scaling" => Self::SpeedScaling,
            "target_speed_fraction" => Self::TargetSpeedFraction,
            "output_bit_registers0_to_31" => Self::OutputBits(0),
            "output_bit_registers32_to_63" => Self::OutputBits(1),
            "payload" => Self::Payload,
            "tcp_offset" => Self::TcpOffset,
            _ => {
                return register(name, "output_int_register_")
                    .map(Self::OutputInt)
                    .or_else(|| bit(name, "output_bit_register_").map(Self::OutputBit))
                    .or_else(|| register(name, "output_double_register_").map(Self::OutputDouble))
                    .or_else(|| InputField::from_name(name).map(Self::Input))
                    .or_else(|| Constant::from_name(name).map(Self::Constant));
            }
        })
    }

    pub(super) fn field_type(self) -> FieldType {
        match self {
            Self::Timestamp
            | Self::SpeedScaling
            | Self::TargetSpeedFraction
            | Self::AnalogOutput(_)
            | Self::Payload
            | Self::OutputDouble(_) => FieldType::Double,
            Self::TargetQ
            | Self::TargetQd
            | Self::TargetQdd
            | Self::ActualQ
            | Self::ActualQd
            | Self::TargetTcpPose
            | Self::TargetTcpSpeed
            | Self::ActualTcpPose
            | Self::ActualTcpSpeed
            | Self::TcpOffset => FieldType::Vector6d,
            Self::OutputBit(_) => FieldType::Bool,
            Self::DigitalOutputs => FieldType::Uint64,
            Self::RobotMode | Self::SafetyMode | Self::OutputInt(_) => FieldType::Int32,
            Self::RuntimeState
            | Self::RobotStatusBits
            | Self::SafetyStatusBits
            | Self::OutputBits(_) => FieldType::Uint32,
            Self::Input(field) => field.field_type(),
            Self::Constant(constant) => constant.value().field_type(),
        }
    }
}

impl InputField {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        register(name, "input_int_register_")
            .map(Self::Int)
            .or_else(|| register(name, "input_double_register_").map(Self::Double))
            .or_else(|| bit(name, "input_bit_register_").map(Self::Bit))
            .or_else(|| {
                let place = NAMED_INPUTS.iter().position(|(known, _)| *known == name);
                place.map(Self::Named)
            })
    }

    pub(super) fn field_type(self) -> FieldType {
        match self {
            Self::Int(_) => FieldType::Int32,
            Self::Double(_) => FieldType::Double,
            Self::Bit(_) => FieldType::Bool,
            Self::Named(place) => NAMED_INPUTS[place].1.field_type(),
        }
    }
}

/// The number of the bit register `name`, if it is one of this kind.
fn bit(name: &str, kind: &str) -> Option<usize> {
    let number: u8 = name.strip_prefix(kind)?.parse().ok()?;
    let is_for_clients = BIT_REGISTERS.contains(&number);
    is_for_clients.then_some(usize::from(number))
}

/// The number of the register `name`, if it is one of this kind.
fn register(name: &str, kind: &str) -> Option<usize> {
    let number: u8 = name.strip_prefix(kind)?.parse().ok()?;
    (number < REGISTER_COUNT).then_some(usize::from(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_end_at_47() {
        for (name, exists) in [
            ("input_int_register_0", true),
            ("input_int_register_47", true),
            ("input_int_register_48", false),
            ("input_int_register_-1", false),
            ("input_int_register_", false),
            ("input_double_register_36", true),
            ("input_bit_register_63", false),
            ("input_bit_register_64", true),
            ("output_bit_register_64", false),
            ("input_bit_register_127", true),
            ("input_bit_register_128", false),
            ("speed_slider_mask", true),
            ("target_q", false),
        ] {
            assert_eq!(InputField::from_name(name).is_some(), exists, "{name}");
        }
        assert!(OutputField::from_name("input_int_register_24").is_some());
        assert!(OutputField::from_name("output_double_register_47").is_some());
        assert!(OutputField::from_name("output_bit_register_127").is_some());
        assert_eq!(NAMED_INPUTS[LOWER_BITS[1]].0, "input_bit_registers32_to_63");
        assert!(OutputField::from_name("joint_temperature").is_none());
    }
}
