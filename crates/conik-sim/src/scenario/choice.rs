//! Settings with a fixed list of values, by their names in the file.

use super::config::{Axis, Border, ModeRule, Part, Recursion};

/// A setting with a fixed list of values.
pub trait Choice: Copy + PartialEq + Sized + 'static {
    /// Every value that this version has, each with one line for people.
    const ALL: &'static [(Self, &'static str)];

    /// The value's name in the file.
    fn name(self) -> &'static str;

    /// The value of that name.
    fn from_name(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .map(|(value, _)| *value)
            .find(|value| value.name() == name)
    }
}

impl Choice for ModeRule {
    const ALL: &'static [(Self, &'static str)] = &[
        (
            Self::Paper,
            "all subsets of the set-based tasks, fewest members first, then list order",
        ),
        (
            Self::Border,
            "the same, but only tasks at or outside their border may be active",
        ),
        (
            Self::Cone,
            "at each level the velocity nearest to what the task asks that keeps every \
             high-priority set",
        ),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Border => "border",
            Self::Cone => "cone",
        }
    }
}

impl Choice for Border {
    const ALL: &'static [(Self, &'static str)] = &[
        (
            Self::Freeze,
            "active high-priority sets are frozen where they are, as in the paper; samples may lie \
             a little outside",
        ),
        (
            Self::Land,
            "the next sample is computed first and corrected: no sample lies outside a \
             high-priority set that was ever entered",
        ),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Freeze => "freeze",
            Self::Land => "land",
        }
    }
}

impl Choice for Recursion {
    const ALL: &'static [(Self, &'static str)] = &[
        (
            Self::Chiaverini,
            "the singularity-robust form of the paper: each task is solved alone, then projected",
        ),
        (
            Self::SicilianoSlotine,
            "each task is fitted to what the tasks above leave of it, damped near singularities",
        ),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Chiaverini => "chiaverini",
            Self::SicilianoSlotine => "siciliano-slotine",
        }
    }
}

impl Choice for Axis {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::X, "x axis of the base"),
        (Self::Y, "y axis of the base"),
        (Self::Z, "z axis of the base"),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

impl Choice for Part {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::Position, "the three rows of the position"),
        (Self::Orientation, "the three rows of the angular velocity"),
        (Self::Pose, "all six, a metre counting as much as a radian"),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Orientation => "orientation",
            Self::Pose => "pose",
        }
    }
}
