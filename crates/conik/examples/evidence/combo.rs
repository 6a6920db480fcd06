//! Combinations of mode rule, border and recursion, by the names that scenario files use.

use std::fmt;
use std::str::FromStr;

use conik::{Border, ModeRule, Recursion, Settings};

/// One combination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Combo {
    rule: ModeRule,
    border: Border,
    recursion: Recursion,
}

const RULES: [(&str, ModeRule); 3] = [
    ("paper", ModeRule::Paper),
    ("border", ModeRule::Border),
    ("cone", ModeRule::Cone),
];
const BORDERS: [(&str, Border); 2] = [("freeze", Border::Freeze), ("land", Border::Land)];
const RECURSIONS: [(&str, Recursion); 2] = [
    ("chiaverini", Recursion::Chiaverini),
    ("siciliano-slotine", Recursion::SicilianoSlotine),
];

impl Combo {
    /// All twelve.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for (_, rule) in RULES {
            for (_, border) in BORDERS {
                for (_, recursion) in RECURSIONS {
                    all.push(Self {
                        rule,
                        border,
                        recursion,
                    });
                }
            }
        }
        all
    }

    /// The settings at a control rate [Hz].
    pub fn settings(self, rate_hz: f64) -> Settings {
        Settings {
            mode_rule: self.rule,
            border: self.border,
            recursion: self.recursion,
            ..Settings::at_rate(rate_hz)
        }
    }
}

fn find<T: Copy + PartialEq>(table: &[(&str, T)], word: &str) -> Option<T> {
    table
        .iter()
        .find(|(name, _)| *name == word)
        .map(|(_, value)| *value)
}

impl FromStr for Combo {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = || {
            let mut words = text.split('/');
            let combo = Self {
                rule: find(&RULES, words.next()?)?,
                border: find(&BORDERS, words.next()?)?,
                recursion: find(&RECURSIONS, words.next()?)?,
            };
            words.next().is_none().then_some(combo)
        };
        parse().ok_or(format!(
            "{text} is no combination like cone/land/siciliano-slotine"
        ))
    }
}

impl fmt::Display for Combo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |found: Option<&'static str>| found.unwrap_or("?");
        let rule = RULES.iter().find(|(_, rule)| *rule == self.rule);
        let border = BORDERS.iter().find(|(_, border)| *border == self.border);
        let recursion = RECURSIONS.iter().find(|(_, r)| *r == self.recursion);
        let words = [
            name(rule.map(|(name, _)| *name)),
            name(border.map(|(name, _)| *name)),
            name(recursion.map(|(name, _)| *name)),
        ];
        f.pad(&words.join("/"))
    }
}
