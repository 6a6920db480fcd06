//! What the maker publishes of its arms: Denavit-Hartenberg parameters and joint speeds.

use crate::registers::JOINTS;
use conik_sim::scenario::{Choice, UrModel, UrSeries};
use std::f64::consts::FRAC_PI_2;

/// Twists α of all arms, joint by joint [rad].
pub const TWISTS: [f64; JOINTS] = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];

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

/// Speeds of the larger arms' e-Series and CB3 [deg/s].
const SLOW_SHOULDER: [f64; JOINTS] = [120.0, 120.0, 180.0, 180.0, 180.0, 180.0];
/// Speeds of the UR20 and the UR30 [deg/s].
const HEAVY: [f64; JOINTS] = [120.0, 120.0, 150.0, 210.0, 210.0, 210.0];
/// Speeds of the UR3 [deg/s].
const QUICK_WRIST: [f64; JOINTS] = [180.0, 180.0, 180.0, 360.0, 360.0, 360.0];

impl ArmFacts {
    /// Every arm of which the figures are known.
    pub const ALL: &'static [Self] = &[
        Self::new(
            UrModel::Ur3,
            UrSeries::Cb3,
            [-0.24365, -0.21325],
            [0.1519, 0.11235, 0.08535, 0.0819],
            QUICK_WRIST,
        ),
        Self::new(
            UrModel::Ur5,
            UrSeries::Cb3,
            [-0.425, -0.39225],
            [0.089_159, 0.10915, 0.09465, 0.0823],
            [180.0; JOINTS],
        ),
        Self::new(
            UrModel::Ur10,
            UrSeries::Cb3,
            [-0.612, -0.5723],
            [0.1273, 0.163_941, 0.1157, 0.0922],
            SLOW_SHOULDER,
        ),
        Self::new(
            UrModel::Ur3,
            UrSeries::ESeries,
            [-0.24355, -0.2132],
            [0.15185, 0.13105, 0.08535, 0.0921],
            QUICK_WRIST,
        ),
        Self::new(
            UrModel::Ur5,
            UrSeries::ESeries,
            [-0.425, -0.3922],
            [0.1625, 0.1333, 0.0997, 0.0996],
            [180.0; JOINTS],
        ),
        Self::new(
            UrModel::Ur10,
            UrSeries::ESeries,
            [-0.6127, -0.57155],
            [0.1807, 0.17415, 0.11985, 0.11655],
            SLOW_SHOULDER,
        ),
        Self::new(
            UrModel::Ur16,
            UrSeries::ESeries,
            [-0.4784, -0.36],
            [0.1807, 0.17415, 0.11985, 0.11655],
            SLOW_SHOULDER,
        ),
        Self::new(
            UrModel::Ur20,
            UrSeries::ESeries,
            [-0.862, -0.7287],
            [0.2363, 0.201, 0.1593, 0.1543],
            HEAVY,
        ),
        Self::new(
            UrModel::Ur30,
            UrSeries::ESeries,
            [-0.637, -0.5037],
            [0.2363, 0.201, 0.1593, 0.1543],
            HEAVY,
        ),
    ];

    const fn new(
        model: UrModel,
        series: UrSeries,
        [upper_arm, forearm]: [f64; 2],
        [shoulder, wrist_1, wrist_2, wrist_3]: [f64; 4],
        most_speed_deg: [f64; JOINTS],
    ) -> Self {
        Self {
            model,
            series,
            lengths: [0.0, upper_arm, forearm, 0.0, 0.0, 0.0],
            offsets: [shoulder, 0.0, 0.0, wrist_1, wrist_2, wrist_3],
            most_speed_deg,
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
