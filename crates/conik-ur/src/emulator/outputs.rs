//! What the emulated controller says of itself, field by field.

use super::controller::{Controller, Safety};
use super::fields::OutputField;
use super::kinematics;
use super::power::Power;
use crate::status::{robot_bit, safety_bit};
use crate::wire::Value;

impl Controller {
    /// The present value of a field.
    pub(super) fn output(&self, field: OutputField) -> Value {
        match field {
            OutputField::Timestamp => Value::Double(self.timestamp()),
            OutputField::TargetQ => Value::Vector6d(self.arm.q()),
            OutputField::TargetQd => Value::Vector6d(self.target_qd()),
            OutputField::TargetQdd => Value::Vector6d(self.arm.qdd()),
            OutputField::ActualQ => Value::Vector6d(self.arm.actual_q()),
            OutputField::ActualQd => Value::Vector6d(self.arm.actual_qd()),
            OutputField::TargetTcpPose => {
                Value::Vector6d(kinematics::pose(self.facts, &self.arm.q()))
            }
            OutputField::TargetTcpSpeed => Value::Vector6d(kinematics::twist(
                self.facts,
                &self.arm.q(),
                &self.target_qd(),
            )),
            OutputField::ActualTcpPose => {
                Value::Vector6d(kinematics::pose(self.facts, &self.arm.actual_q()))
            }
            OutputField::ActualTcpSpeed => Value::Vector6d(kinematics::twist(
                self.facts,
                &self.arm.actual_q(),
                &self.arm.actual_qd(),
            )),
            OutputField::DigitalOutputs => Value::Uint64(self.digital_outputs()),
            OutputField::AnalogOutput(index) => Value::Double(self.analog_output(index)),
            OutputField::RobotMode => Value::Int32(self.robot_mode()),
            OutputField::SafetyMode => Value::Int32(self.safety_mode()),
            OutputField::RuntimeState => Value::Uint32(self.runtime_state()),
            OutputField::RobotStatusBits => Value::Uint32(self.robot_bits()),
            OutputField::SafetyStatusBits => Value::Uint32(match self.safety {
                Safety::Normal => safety_bit::NORMAL,
                Safety::ProtectiveStop => {
                    safety_bit::PROTECTIVE_STOP | safety_bit::STOPPED_DUE_TO_SAFETY
                }
                Safety::EmergencyStop => {
                    safety_bit::ROBOT_EMERGENCY_STOP
                        | safety_bit::EMERGENCY_STOP
                        | safety_bit::STOPPED_DUE_TO_SAFETY
                }
            }),
            OutputField::SpeedScaling | OutputField::TargetSpeedFraction => {
                Value::Double(self.speed_scaling())
            }
            OutputField::OutputInt(register) => Value::Int32(self.registers.output_int(register)),
            OutputField::OutputDouble(register) => {
                Value::Double(self.registers.output_double(register))
            }
            OutputField::OutputBit(register) => Value::Bool(self.registers.output_bit(register)),
            OutputField::OutputBits(word) => Value::Uint32(self.registers.output_bits(word)),
            OutputField::Payload => Value::Double(self.mounted.payload_kg),
            OutputField::TcpOffset => Value::Vector6d(self.mounted.tcp),
            OutputField::Input(field) => self.registers.input(field),
            OutputField::Constant(constant) => constant.value(),
        }
    }

    fn robot_bits(&self) -> u32 {
        let power = match self.power {
            Power::Off => 0,
            Power::Idle | Power::Running => robot_bit::POWER_ON,
        };
        match self.running {
            Some(_) => power | robot_bit::PROGRAM_RUNNING,
            None => power,
        }
    }
}
