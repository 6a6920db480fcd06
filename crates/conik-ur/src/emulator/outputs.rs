//! What the emulated controller says of itself, field by field.

use super::controller::{Controller, Safety, six};
use super::fields::OutputField;
use crate::status::{ROBOT_MODE_RUNNING, robot_bit, runtime_state, safety_bit};
use crate::wire::Value;

/// `robot_mode` of an arm without power.
const ROBOT_MODE_POWER_OFF: i32 = 3;

impl Controller {
    /// The present value of a field.
    pub(super) fn output(&self, field: OutputField) -> Value {
        match field {
            OutputField::Timestamp => Value::Double(self.timestamp()),
            OutputField::TargetQ => Value::Vector6d(six(self.servo.q())),
            OutputField::TargetQd => Value::Vector6d(six(self.servo.qd())),
            OutputField::TargetQdd => Value::Vector6d(six(self.servo.qdd())),
            OutputField::ActualQ => Value::Vector6d(six(&self.actual.0)),
            OutputField::ActualQd => Value::Vector6d(six(&self.actual.1)),
            OutputField::RobotMode => Value::Int32(match self.safety {
                Safety::EmergencyStop => ROBOT_MODE_POWER_OFF,
                Safety::Normal | Safety::ProtectiveStop => ROBOT_MODE_RUNNING,
            }),
            OutputField::SafetyMode => Value::Int32(match self.safety {
                Safety::Normal => 1,
                Safety::ProtectiveStop => 3,
                Safety::EmergencyStop => 7,
            }),
            OutputField::RuntimeState => Value::Uint32(match (&self.running, self.paused) {
                (None, _) => runtime_state::STOPPED,
                (Some(_), false) => runtime_state::PLAYING,
                (Some(_), true) => runtime_state::PAUSED,
            }),
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
            OutputField::SpeedScaling | OutputField::TargetSpeedFraction => Value::Double(1.0),
            OutputField::OutputInt(register) => Value::Int32(self.registers.output_int(register)),
            // No program that runs here writes one.
            OutputField::OutputDouble(_) => Value::Double(0.0),
            OutputField::Input(field) => self.registers.input(field),
        }
    }

    fn robot_bits(&self) -> u32 {
        let power = match self.safety {
            Safety::EmergencyStop => 0,
            Safety::Normal | Safety::ProtectiveStop => robot_bit::POWER_ON,
        };
        match self.running {
            Some(_) => power | robot_bit::PROGRAM_RUNNING,
            None => power,
        }
    }
}
