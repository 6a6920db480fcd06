//! The fields that the emulated controller has, by name. Any other is `NOT_FOUND`.

use crate::registers::REGISTER_COUNT;
use crate::wire::FieldType;

/// A field that clients may read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutputField {
    Timestamp,
    TargetQ,
    TargetQd,
    TargetQdd,
    ActualQ,
    ActualQd,
    RobotMode,
    SafetyMode,
    RuntimeState,
    RobotStatusBits,
    SafetyStatusBits,
    SpeedScaling,
    TargetSpeedFraction,
    OutputInt(usize),
    OutputDouble(usize),
    /// Inputs can be read back.
    Input(InputField),
}

/// A field that clients may write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum InputField {
    Int(usize),
    Double(usize),
}

impl OutputField {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "timestamp" => Self::Timestamp,
            "target_q" => Self::TargetQ,
            "target_qd" => Self::TargetQd,
            "target_qdd" => Self::TargetQdd,
            "actual_q" => Self::ActualQ,
            "actual_qd" => Self::ActualQd,
            "robot_mode" => Self::RobotMode,
            // In the states emulated here, both count alike.
            "safety_mode" | "safety_status" => Self::SafetyMode,
            "runtime_state" => Self::RuntimeState,
            "robot_status_bits" => Self::RobotStatusBits,
            "safety_status_bits" => Self::SafetyStatusBits,
            "speed_scaling" => Self::SpeedScaling,
            "target_speed_fraction" => Self::TargetSpeedFraction,
            _ => {
                return register(name, "output_int_register_")
                    .map(Self::OutputInt)
                    .or_else(|| register(name, "output_double_register_").map(Self::OutputDouble))
                    .or_else(|| InputField::from_name(name).map(Self::Input));
            }
        })
    }

    pub(super) fn field_type(self) -> FieldType {
        match self {
            Self::Timestamp
            | Self::SpeedScaling
            | Self::TargetSpeedFraction
            | Self::OutputDouble(_) => FieldType::Double,
            Self::TargetQ | Self::TargetQd | Self::TargetQdd | Self::ActualQ | Self::ActualQd => {
                FieldType::Vector6d
            }
            Self::RobotMode | Self::SafetyMode | Self::OutputInt(_) => FieldType::Int32,
            Self::RuntimeState | Self::RobotStatusBits | Self::SafetyStatusBits => {
                FieldType::Uint32
            }
            Self::Input(field) => field.field_type(),
        }
    }
}

impl InputField {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        register(name, "input_int_register_")
            .map(Self::Int)
            .or_else(|| register(name, "input_double_register_").map(Self::Double))
    }

    pub(super) fn field_type(self) -> FieldType {
        match self {
            Self::Int(_) => FieldType::Int32,
            Self::Double(_) => FieldType::Double,
        }
    }
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
            ("input_bit_register_64", false),
            ("target_q", false),
        ] {
            assert_eq!(InputField::from_name(name).is_some(), exists, "{name}");
        }
        assert!(OutputField::from_name("input_int_register_24").is_some());
        assert!(OutputField::from_name("output_double_register_47").is_some());
        assert!(OutputField::from_name("joint_temperatures").is_none());
    }
}
