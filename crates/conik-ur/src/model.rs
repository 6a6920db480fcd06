//! What the maker publishes of its arms: Denavit-Hartenberg parameters and joint speeds, by model and
//! series of the controller. The figures are those of the built-in robots.

use crate::registers::JOINTS;
use conik::UrArm;
use conik_sim::scenario::{Choice, UrModel, UrSeries};

/// Twists α of all arms, joint by joint [rad].
pub const TWISTS: [f64; JOINTS] = UrArm::TWISTS_RAD;

/// One arm of one series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmFacts {
    /// Its model.
    pub model: UrModel,
    /// Its series.
    pub series: UrSeries,
    /// Link lengths a, joint by joint [m].
    pub lengths: [f64; JOINTS],
    /// Link offsets d, joint by joint [m].
    pub offsets: [f64; JOINTS],
    /// Greatest speeds, joint by joint [deg/s].
    pub most_speed_deg: [f64; JOINTS],
}

impl ArmFacts {
    /// Every arm of which the figures are known.
    pub const ALL: &'static [Self] = &[
        Self::new(UrModel::Ur3, UrSeries::Cb3, &UrArm::UR3),
        Self::new(UrModel::Ur5, UrSeries::Cb3, &UrArm::UR5),
        Self::new(UrModel::Ur10, UrSeries::Cb3, &UrArm::UR10),
        Self::new(UrModel::Ur3, UrSeries::ESeries, &UrArm::UR3E),
        Self::new(UrModel::Ur5, UrSeries::ESeries, &UrArm::UR5E),
        Self::new(UrModel::Ur10, UrSeries::ESeries, &UrArm::UR10E),
        Self::new(UrModel::Ur16, UrSeries::ESeries, &UrArm::UR16E),
        Self::new(UrModel::Ur20, UrSeries::ESeries, &UrArm::UR20),
        Self::new(UrModel::Ur30, UrSeries::ESeries, &UrArm::UR30),
    ];

    const fn new(model: UrModel, series: UrSeries, arm: &UrArm) -> Self {
        Self {
            model,
            series,
            lengths: arm.all_lengths_m(),
            offsets: arm.all_offsets_m(),
            most_speed_deg: arm.speeds_deg_per_s,
        }
    }

    /// The arm of this model and series; `None` if there is none, or its figures are not known here.
    pub fn of(model: UrModel, series: UrSeries) -> Option<&'static Self> {
        Self::ALL
            .iter()
            .find(|arm| arm.model == model && arm.series == series)
    }

    /// Greatest speeds, joint by joint [rad/s].
    pub fn most_speed(&self) -> [f64; JOINTS] {
        self.most_speed_deg.map(f64::to_radians)
    }

    /// The model without its series, as the dashboard names it: `UR5`.
    pub(crate) fn model_name(&self) -> String {
        self.model.name().to_ascii_uppercase()
    }

    /// What people call it: `UR5`, `UR5e`, `UR20`.
    pub fn name(&self) -> String {
        let has_e = self.series == UrSeries::ESeries
            && !matches!(self.model, UrModel::Ur20 | UrModel::Ur30);
        let e = if has_e { "e" } else { "" };
        format!("{}{e}", self.model_name())
    }

    /// The number that stands for the model in the controller's state messages.
    pub(crate) fn type_number(&self) -> u32 {
        match self.model {
            UrModel::Ur10 => 2,
            UrModel::Ur3 => 3,
            UrModel::Ur16 => 4,
            UrModel::Ur20 => 7,
            UrModel::Ur30 => 8,
            _ => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_arm_is_there_once_and_knows_its_name() {
        let names: Vec<String> = ArmFacts::ALL.iter().map(ArmFacts::name).collect();
        assert_eq!(
            names,
            [
                "UR3", "UR5", "UR10", "UR3e", "UR5e", "UR10e", "UR16e", "UR20", "UR30"
            ]
        );
        for arm in ArmFacts::ALL {
            assert_eq!(ArmFacts::of(arm.model, arm.series), Some(arm));
            assert_eq!(UrModel::in_name(&arm.name()), Some(arm.model));
        }
        assert_eq!(ArmFacts::of(UrModel::Ur20, UrSeries::Cb3), None);
    }

    #[test]
    fn reach_is_what_the_maker_says() {
        // Shoulder to the middle of wrist 3, stretched, within the wrist's width [m].
        for (model, series, reach) in [
            (UrModel::Ur3, UrSeries::ESeries, 0.5),
            (UrModel::Ur5, UrSeries::Cb3, 0.85),
            (UrModel::Ur5, UrSeries::ESeries, 0.85),
            (UrModel::Ur10, UrSeries::ESeries, 1.3),
            (UrModel::Ur16, UrSeries::ESeries, 0.9),
            (UrModel::Ur20, UrSeries::ESeries, 1.75),
            (UrModel::Ur30, UrSeries::ESeries, 1.3),
        ] {
            let arm = ArmFacts::of(model, series).unwrap();
            let stretched = -arm.lengths[1] - arm.lengths[2];
            assert!(
                (stretched..stretched + arm.offsets[4] + 0.05).contains(&reach),
                "{}",
                arm.name()
            );
        }
    }
}
