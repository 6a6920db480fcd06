//! The keys of `[ur]`: how a Universal Robots arm is driven.

use super::key::{Holds, Key, Range};
use super::ur::{UrModel, UrSeries};

/// `[ur]`.
pub(super) const UR_KEYS: &[&Key] = &[
    &HOST,
    &SERIES,
    &UR_MODEL,
    &SERVO_LOOKAHEAD_S,
    &SERVO_GAIN,
    &BRIDGE_S,
    &PAYLOAD_KG,
    &TCP_OFFSET_M,
    &TCP_ROTATION_RAD,
    &MOST_POSITION_RAD,
    &MOST_SPEED_RAD_PER_S,
    &MOST_ACCELERATION_RAD_PER_S2,
];

pub(super) const HOST: Key = Key::new(
    "host",
    "",
    "Host name or address of the controller that `--robot ur` means",
    Holds::Text,
    r#""192.168.0.10""#,
);
pub(super) const SERIES: Key = Key::new(
    "series",
    "",
    "The series that the controller must be of; without it, any will do",
    Holds::choice::<UrSeries>(),
    r#""e-series""#,
);
pub(super) const UR_MODEL: Key = Key::new(
    "model",
    "",
    "The arm that it must be; without it, any of the name of the scenario's robot will do",
    Holds::choice::<UrModel>(),
    r#""ur5""#,
);
pub(super) const SERVO_LOOKAHEAD_S: Key = Key::new(
    "servo_lookahead_s",
    "s",
    "Lookahead time of `servoj`: the arm follows with about this delay",
    Holds::Number(Range::between(0.03, 0.2)),
    "0.1",
);
pub(super) const SERVO_GAIN: Key = Key::new(
    "servo_gain",
    "",
    "Gain of `servoj`: a high one follows stiffly, and rings with a short lookahead",
    Holds::Number(Range::between(100.0, 2000.0)),
    "300",
);
pub(super) const BRIDGE_S: Key = Key::new(
    "bridge_s",
    "s",
    "For how long missing references are bridged with the last velocity before the arm is stopped",
    Holds::Number(Range::between(0.01, 0.5)),
    "0.04",
);
pub(super) const PAYLOAD_KG: Key = Key::new(
    "payload_kg",
    "kg",
    "Mass of what hangs on the flange; without it, the controller's own setting holds",
    Holds::Number(Range::between(0.0, 40.0)),
    "1.5",
);
pub(super) const TCP_OFFSET_M: Key = Key::new(
    "tcp_offset_m",
    "m",
    "Tool centre point in the flange's frame, as the controller is to know it; without it, the \
     controller's own setting holds",
    Holds::Vector(Range::within(2.0)),
    "[0, 0, 0.12]",
);
pub(super) const TCP_ROTATION_RAD: Key = Key::new(
    "tcp_rotation_rad",
    "rad",
    "Rotation vector of the tool in the flange's frame, beside `tcp_offset_m`",
    Holds::Vector(Range::within(10.0)),
    "[0, 0, 0]",
);
pub(super) const MOST_POSITION_RAD: Key = Key::new(
    "most_position_rad",
    "rad",
    "No reference beyond this, either way, is sent: one number for all joints or one for each",
    Holds::NumberOrJointNumbers(Range::positive(7.0)),
    "6.283",
);
pub(super) const MOST_SPEED_RAD_PER_S: Key = Key::new(
    "most_speed_rad_per_s",
    "rad/s",
    "No reference that asks for a higher speed is sent: one number for all joints or one for each",
    Holds::NumberOrJointNumbers(Range::positive(7.0)),
    "3.1415",
);
pub(super) const MOST_ACCELERATION_RAD_PER_S2: Key = Key::new(
    "most_acceleration_rad_per_s2",
    "rad/s²",
    "No reference that asks for a higher acceleration is sent; without it, the speed may change by \
     three quarters of `most_speed_rad_per_s` at once",
    Holds::NumberOrJointNumbers(Range::positive(10_000.0)),
    "40",
);
