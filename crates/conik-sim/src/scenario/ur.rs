//! `[ur]`: how a Universal Robots arm is driven. Everything in it may be left out.

use serde::{Deserialize, Serialize};

use super::choice::Choice;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robots::RobotFacts;
use super::table::{Entry, Table};

/// How a Universal Robots arm is driven; `None`: the driver's own setting holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct UrSettings {
    /// Host name or address of the controller.
    pub host: Option<String>,
    /// The series that the controller must be of.
    pub series: Option<UrSeries>,
    /// The arm that it must be.
    pub model: Option<UrModel>,
    /// Lookahead time of `servoj` [s].
    pub servo_lookahead_s: Option<f64>,
    /// Gain of `servoj`.
    pub servo_gain: Option<f64>,
    /// For how long missing references are bridged before the arm is stopped [s].
    pub bridge_s: Option<f64>,
    /// Mass on the flange [kg].
    pub payload_kg: Option<f64>,
    /// Tool centre point in the flange's frame [m].
    pub tcp_offset_m: Option<[f64; 3]>,
    /// Rotation vector of the tool in the flange's frame [rad].
    pub tcp_rotation_rad: Option<[f64; 3]>,
    /// Greatest magnitude of each joint's reference [rad].
    pub most_position_rad: Option<Vec<f64>>,
    /// Greatest speed of each joint's reference [rad/s].
    pub most_speed_rad_per_s: Option<Vec<f64>>,
    /// Greatest acceleration of each joint's reference [rad/s²].
    pub most_acceleration_rad_per_s2: Option<Vec<f64>>,
}

/// `ur.series`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UrSeries {
    /// CB3
    Cb3,
    /// e-Series
    ESeries,
}

impl Choice for UrSeries {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::Cb3, "UR3, UR5, UR10: 125 Hz"),
        (Self::ESeries, "UR3e to UR30: 500 Hz"),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Cb3 => "cb3",
            Self::ESeries => "e-series",
        }
    }
}

/// `ur.model`: the number in the arm's name; the series is another matter (a UR5e is a `ur5`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // Named as the maker does.
pub enum UrModel {
    Ur3,
    Ur5,
    Ur7,
    Ur8,
    Ur10,
    Ur12,
    Ur15,
    Ur16,
    Ur18,
    Ur20,
    Ur30,
}

impl Choice for UrModel {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::Ur3, "UR3, UR3e"),
        (Self::Ur5, "UR5, UR5e"),
        (Self::Ur7, "UR7e"),
        (Self::Ur8, "UR8 Long"),
        (Self::Ur10, "UR10, UR10e"),
        (Self::Ur12, "UR12e"),
        (Self::Ur15, "UR15"),
        (Self::Ur16, "UR16e"),
        (Self::Ur18, "UR18"),
        (Self::Ur20, "UR20"),
        (Self::Ur30, "UR30"),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Ur3 => "ur3",
            Self::Ur5 => "ur5",
            Self::Ur7 => "ur7",
            Self::Ur8 => "ur8",
            Self::Ur10 => "ur10",
            Self::Ur12 => "ur12",
            Self::Ur15 => "ur15",
            Self::Ur16 => "ur16",
            Self::Ur18 => "ur18",
            Self::Ur20 => "ur20",
            Self::Ur30 => "ur30",
        }
    }
}

impl UrModel {
    /// The arm in a longer name that begins with it: `UR10e`, `ur5-paper`, `UR8 Long`.
    pub fn in_name(name: &str) -> Option<Self> {
        let name = name.trim().to_ascii_lowercase();
        let number = name.strip_prefix("ur")?;
        let digits = number.find(|letter: char| !letter.is_ascii_digit());
        let number = &number[..digits.unwrap_or(number.len())];
        Self::from_name(&format!("ur{number}"))
    }
}

/// Reads the table; `None` where something in it is wrong.
pub(super) fn read(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<UrSettings> {
    table.refuse_unknown_keys(&keys::UR_KEYS.iter().copied(), |_| None, found);
    if table.has(&keys::TCP_ROTATION_RAD) && !table.has(&keys::TCP_OFFSET_M) {
        table.missing(&keys::TCP_OFFSET_M, found);
        return None;
    }
    let host = optional(table.text(&keys::HOST, found).map(str::to_owned));
    let series = optional(table.choice(&keys::SERIES, found));
    let model = optional(table.choice(&keys::UR_MODEL, found));
    let servo_lookahead_s = optional(table.number(&keys::SERVO_LOOKAHEAD_S, found));
    let servo_gain = optional(table.number(&keys::SERVO_GAIN, found));
    let bridge_s = optional(table.number(&keys::BRIDGE_S, found));
    let payload_kg = optional(table.number(&keys::PAYLOAD_KG, found));
    let tcp_offset_m = optional(table.vector(&keys::TCP_OFFSET_M, found));
    let tcp_rotation_rad = optional(table.vector(&keys::TCP_ROTATION_RAD, found));
    let mut most = |key| optional(table.number_or_joint_numbers(key, robot, found));
    let position = most(&keys::MOST_POSITION_RAD);
    let speed = most(&keys::MOST_SPEED_RAD_PER_S);
    let acceleration = most(&keys::MOST_ACCELERATION_RAD_PER_S2);
    Some(UrSettings {
        host: host?,
        series: series?,
        model: model?,
        servo_lookahead_s: servo_lookahead_s?,
        servo_gain: servo_gain?,
        bridge_s: bridge_s?,
        payload_kg: payload_kg?,
        tcp_offset_m: tcp_offset_m?,
        tcp_rotation_rad: tcp_rotation_rad?,
        most_position_rad: position?,
        most_speed_rad_per_s: speed?,
        most_acceleration_rad_per_s2: acceleration?,
    })
}

/// `Some(None)` where nothing is given, `None` where it is wrong.
type Given<T> = Option<Option<T>>;

fn optional<T>(entry: Entry<T>) -> Given<T> {
    entry.map(Some).or(None)
}

impl UrSettings {
    /// What is given, as it stands in a file.
    pub(super) fn written(&self) -> Vec<(&'static Key, String)> {
        use super::write::{number, text, vector};
        let one = |value: &Option<f64>| value.map(number);
        let three = |value: &Option<[f64; 3]>| value.map(|value| vector(&value));
        let list = |value: &Option<Vec<f64>>| value.as_deref().map(vector);
        let all: [(&'static Key, Option<String>); 12] = [
            (&keys::HOST, self.host.as_deref().map(text)),
            (&keys::SERIES, self.series.map(|series| text(series.name()))),
            (&keys::UR_MODEL, self.model.map(|model| text(model.name()))),
            (&keys::SERVO_LOOKAHEAD_S, one(&self.servo_lookahead_s)),
            (&keys::SERVO_GAIN, one(&self.servo_gain)),
            (&keys::BRIDGE_S, one(&self.bridge_s)),
            (&keys::PAYLOAD_KG, one(&self.payload_kg)),
            (&keys::TCP_OFFSET_M, three(&self.tcp_offset_m)),
            (&keys::TCP_ROTATION_RAD, three(&self.tcp_rotation_rad)),
            (&keys::MOST_POSITION_RAD, list(&self.most_position_rad)),
            (
                &keys::MOST_SPEED_RAD_PER_S,
                list(&self.most_speed_rad_per_s),
            ),
            (
                &keys::MOST_ACCELERATION_RAD_PER_S2,
                list(&self.most_acceleration_rad_per_s2),
            ),
        ];
        all.into_iter()
            .filter_map(|(key, value)| Some((key, value?)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::UrModel;
    use crate::scenario::{Scenario, template};

    #[test]
    fn an_arm_is_known_by_the_number_in_its_name() {
        for (name, model) in [
            ("UR5", Some(UrModel::Ur5)),
            ("UR5e", Some(UrModel::Ur5)),
            ("ur5-paper", Some(UrModel::Ur5)),
            (" UR10 ", Some(UrModel::Ur10)),
            ("UR8 Long", Some(UrModel::Ur8)),
            ("UR50", None),
            ("UR", None),
            ("URé", None),
            ("panda", None),
        ] {
            assert_eq!(UrModel::in_name(name), model, "{name}");
        }
    }

    fn with(ur: &str) -> String {
        let text = template();
        let at = text.find("\n[[task]]").unwrap();
        let (before, after) = text.split_at(at);
        format!("{before}\n[ur]\n{ur}\n{after}")
    }

    #[test]
    fn every_setting_survives_the_way_into_a_file_and_back() {
        let text = with(
            "host = \"arm\"\nseries = \"e-series\"\nmodel = \"ur10\"\n\
             servo_lookahead_s = 0.05\nservo_gain = 500\nbridge_s = 0.02\n\
             payload_kg = 1.5\ntcp_offset_m = [0, 0, 0.12]\ntcp_rotation_rad = [0, 1, 0]\n\
             most_position_rad = 3\nmost_speed_rad_per_s = [1, 2, 3, 1, 2, 3]\n\
             most_acceleration_rad_per_s2 = 20",
        );
        let scenario = Scenario::from_toml(&text).unwrap();
        let ur = scenario.ur.clone().unwrap();
        assert_eq!(ur.host.as_deref(), Some("arm"));
        assert_eq!(ur.most_position_rad, Some(vec![3.0; 6]));
        assert_eq!(ur.written().len(), 12, "all of them");
        assert_eq!(Scenario::from_toml(&scenario.to_toml()).unwrap(), scenario);
        let json = serde_json::to_string(&scenario).unwrap();
        assert_eq!(serde_json::from_str::<Scenario>(&json).unwrap(), scenario);
    }

    #[test]
    fn what_cannot_be_is_refused_by_its_key() {
        for (line, key) in [
            ("servo_lookahead_s = 0.3", "ur.servo_lookahead_s"),
            ("servo_gain = 99", "ur.servo_gain"),
            ("series = \"e\"", "ur.series"),
            ("model = \"ur5e\"", "ur.model"),
            ("bridge_s = 0.6", "ur.bridge_s"),
            ("most_speed_rad_per_s = [1, 2]", "ur.most_speed_rad_per_s"),
            ("most_speed_rad_per_s = 0", "ur.most_speed_rad_per_s"),
            ("tcp_rotation_rad = [0, 0, 0]", "ur.tcp_offset_m"),
            ("speed = 1", "ur.speed"),
        ] {
            let errors = Scenario::from_toml(&with(line)).unwrap_err();
            let keys: Vec<_> = errors.mistakes().iter().map(|m| m.key.clone()).collect();
            assert_eq!(keys, [key], "{line}");
        }
    }
}
