//! Settings with a fixed list of values, by their names in the file.

use super::config::{Axis, Border, ModeRule, Recursion};

/// A setting with a fixed list of values.
pub trait Choice: Copy + PartialEq + Sized + 'static {
    /// Every value that this version has, each with one line for people.
    const ALL: &'static [(Self, &'static str)];

    /// Names that a later version will have; asked for today, they deserve an honest answer.
    const NOT_YET: &'static [&'static str] = &[];

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
    ];
    const NOT_YET: &'static [&'static str] = &["cone"];

    fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Border => "border",
        }
    }
}

impl Choice for Border {
    const ALL: &'static [(Self, &'static str)] = &[(
        Self::Freeze,
        "active high-priority sets are frozen, as in the paper; between samples a set may be left by a little",
    )];
    const NOT_YET: &'static [&'static str] = &["land"];

    fn name(self) -> &'static str {
        match self {
            Self::Freeze => "freeze",
        }
    }
}

impl Choice for Recursion {
    const ALL: &'static [(Self, &'static str)] = &[(
        Self::Chiaverini,
        "the singularity-robust form of the paper: each task is solved alone, then projected",
    )];
    const NOT_YET: &'static [&'static str] = &["siciliano-slotine"];

    fn name(self) -> &'static str {
        match self {
            Self::Chiaverini => "chiaverini",
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
