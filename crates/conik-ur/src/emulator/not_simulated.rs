//! What clients ask for and this emulator does not simulate: fields that read the same for ever.
//!
//! Widespread clients refuse to work if a single one of them is missing. No value here may be
//! taken for a measurement: currents, torques and temperatures are not modelled.

use crate::wire::Value;

/// Gravity as an arm at rest on a floor feels it [m/s²].
const AT_REST: Value = Value::Vector3d([0.0, 0.0, 9.81]);

/// Joint mode "running".
const JOINT_RUNNING: i32 = 253;

const SIX: Value = Value::Vector6d([0.0; 6]);
const ZERO: Value = Value::Double(0.0);

/// Every such field with its value.
const FIELDS: [(&str, Value); 40] = [
    ("target_current", SIX),
    ("target_moment", SIX),
    ("actual_current", SIX),
    ("actual_current_window", SIX),
    ("actual_current_as_torque", SIX),
    ("joint_control_output", SIX),
    ("actual_TCP_force", SIX),
    ("ft_raw_wrench", SIX),
    ("joint_temperatures", Value::Vector6d([25.0; 6])),
    ("actual_execution_time", ZERO),
    ("joint_mode", Value::Vector6Int32([JOINT_RUNNING; 6])),
    ("actual_tool_accelerometer", AT_REST),
    ("actual_momentum", ZERO),
    ("actual_main_voltage", Value::Double(48.0)),
    ("actual_robot_voltage", Value::Double(48.0)),
    ("actual_robot_current", ZERO),
    ("actual_joint_voltage", Value::Vector6d([48.0; 6])),
    ("actual_digital_input_bits", Value::Uint64(0)),
    ("analog_io_types", Value::Uint32(0)),
    ("standard_analog_input0", ZERO),
    ("standard_analog_input1", ZERO),
    ("io_current", ZERO),
    ("euromap67_input_bits", Value::Uint32(0)),
    ("euromap67_output_bits", Value::Uint32(0)),
    ("euromap67_24V_voltage", ZERO),
    ("euromap67_24V_current", ZERO),
    ("tool_mode", Value::Uint32(255)),
    ("tool_output_mode", Value::Uint8(0)),
    ("tool_output_voltage", Value::Int32(0)),
    ("tool_output_current", ZERO),
    ("tool_temperature", Value::Double(25.0)),
    ("tool_analog_input_types", Value::Uint32(0)),
    ("tool_analog_input0", ZERO),
    ("tool_analog_input1", ZERO),
    ("tcp_force_scalar", ZERO),
    ("elbow_velocity", Value::Vector3d([0.0; 3])),
    ("elbow_position", Value::Vector3d([0.0; 3])),
    ("payload_cog", Value::Vector3d([0.0; 3])),
    ("payload_inertia", SIX),
    ("script_control_line", Value::Uint32(0)),
];

/// One of these fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Constant(usize);

impl Constant {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        FIELDS
            .iter()
            .position(|(known, _)| *known == name)
            .map(Self)
    }

    pub(super) fn value(self) -> Value {
        FIELDS[self.0].1
    }
}
