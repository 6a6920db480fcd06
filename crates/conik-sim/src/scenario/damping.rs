//! How a task is damped near singularities: by a rule that has a name, or by one number.

use serde::{Deserialize, Serialize};

use super::choice::Choice;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::table::{Entry, Table, unknown_name};
use super::write::{number, text};

/// `damping` of a task that is a level: of an equality task, or of a set of low priority.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Damping {
    /// By a rule.
    Rule(DampingRule),
    /// Every direction, everywhere, by this λ [task's unit per rad].
    Fixed(f64),
}

/// Which directions of a task are damped, and how strongly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DampingRule {
    /// What suits the rule and the recursion of `[control]`.
    Automatic,
    /// None.
    None,
    /// Every direction, by the smallest singular value.
    Smallest,
    /// Each direction by its own singular value.
    PerDirection,
}

impl Default for Damping {
    /// What holds where the file says nothing.
    fn default() -> Self {
        Self::Rule(DampingRule::Automatic)
    }
}

impl Damping {
    /// Whether it is what holds where the file says nothing.
    #[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

impl Choice for DampingRule {
    const ALL: &'static [(Self, &'static str)] = &[
        (
            Self::Automatic,
            "\"per-direction\" with recursion \"siciliano-slotine\"; with \"chiaverini\" \
             \"smallest\" under rule \"cone\", and \"none\" under the others",
        ),
        (
            Self::None,
            "not at all: near a singularity velocities grow up to the joints' speed limits",
        ),
        (
            Self::Smallest,
            "every direction alike, the more the smaller the smallest singular value is",
        ),
        (
            Self::PerDirection,
            "each direction by its own singular value: one that is lost does not slow the others",
        ),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Automatic => "automatic",
            Self::None => "none",
            Self::Smallest => "smallest",
            Self::PerDirection => "per-direction",
        }
    }
}

/// Reads `damping`; what it is where the key is absent is for the caller to say.
pub(super) fn read(table: &Table, found: &mut Mistakes) -> Entry<Damping> {
    let key = &keys::DAMPING;
    table.entry(key, |value| {
        let toml = value.toml.get_ref();
        if toml.is_integer() || toml.is_float() {
            return value.number(&key.range(), found).map(Damping::Fixed);
        }
        let Some(name) = toml.as_str() else {
            value.wrong_kind(key.holds.expected(), found);
            return None;
        };
        let rule = DampingRule::from_name(name);
        if rule.is_none() {
            let names = DampingRule::ALL.iter().map(|(rule, _)| rule.name());
            let (what, help) = unknown_name(name, names);
            let numbers = key.range().describe(key.unit);
            let help = format!("{help}; or a number, {numbers}");
            found.add(value.span(), &*value.path, what, help);
        }
        rule.map(Damping::Rule)
    })
}

/// The key and the value, as they stand in the file; `None` where the file need not say it.
pub(super) fn written(damping: Damping) -> Option<(&'static Key, String)> {
    if damping.is_default() {
        return None;
    }
    let value = match damping {
        Damping::Rule(rule) => text(rule.name()),
        Damping::Fixed(lambda) => number(lambda),
    };
    Some((&keys::DAMPING, value))
}
