//! Typed access to one table of the file. What is there but wrong is noted once, with its place.

use std::ops::Range as Span;

use toml::de::DeTable;

use super::choice::Choice;
use super::key::Key;
use super::mistake::{Mistakes, quoted};
use super::place;
use super::suggest::nearest;
use super::value::Value;

/// One table of the file.
#[derive(Clone, Debug)]
pub(super) struct Table<'a> {
    /// Its path; empty for the file itself.
    pub(super) path: String,
    /// Where it begins: a missing key is reported there.
    pub(super) header: Span<usize>,
    pub(super) entries: &'a DeTable<'a>,
}

/// What was found under a key.
#[derive(Clone, Debug)]
pub(super) enum Entry<T> {
    /// The table does not have the key.
    Absent(&'static Key),
    /// The key is there, but its value is wrong; that has been noted.
    Wrong,
    /// A right value.
    Given(T),
}

impl<T> Entry<T> {
    /// The value of a key that must be there; notes where it is not.
    pub(super) fn required(self, table: &Table, found: &mut Mistakes) -> Option<T> {
        if let Self::Absent(key) = &self {
            table.missing(key, found);
        }
        self.given()
    }

    /// The value, or another where the key is absent; `None` where it is wrong.
    pub(super) fn or(self, default: T) -> Option<T> {
        match self {
            Self::Absent(_) => Some(default),
            Self::Wrong => None,
            Self::Given(value) => Some(value),
        }
    }

    /// The right value, if there is one.
    pub(super) fn given(self) -> Option<T> {
        match self {
            Self::Given(value) => Some(value),
            _ => None,
        }
    }

    /// The entry with its right value changed.
    pub(super) fn map<U>(self, change: impl FnOnce(T) -> U) -> Entry<U> {
        match self {
            Self::Absent(key) => Entry::Absent(key),
            Self::Wrong => Entry::Wrong,
            Self::Given(value) => Entry::Given(change(value)),
        }
    }

    /// Whether the key is there, rightly or wrongly.
    pub(super) fn is_present(&self) -> bool {
        !matches!(self, Self::Absent(_))
    }
}

impl<'a> Table<'a> {
    /// Path of one of its keys.
    pub(super) fn path_of(&self, key: &Key) -> String {
        place::join(&self.path, key.name)
    }

    /// The value of a key, whatever it is.
    pub(super) fn value(&self, key: &'static Key) -> Option<Value<'a>> {
        let toml = self.entries.get(key.name)?;
        Some(Value {
            toml,
            path: self.path_of(key),
            key,
        })
    }

    pub(super) fn has(&self, key: &Key) -> bool {
        self.entries.contains_key(key.name)
    }

    /// Where the value of a key stands; the table's header if the key is absent.
    pub(super) fn span_of(&self, key: &Key) -> Span<usize> {
        self.entries
            .get(key.name)
            .map_or_else(|| self.header.clone(), toml::Spanned::span)
    }

    /// Notes that a key must be there and is not.
    pub(super) fn missing(&self, key: &Key, found: &mut Mistakes) {
        let path = self.path_of(key);
        found.add(self.header.clone(), path, "missing", key.write_example());
    }

    /// Notes every key that the table may not have. `special` has the message for keys that
    /// deserve one of their own: what is wrong and what would be right.
    pub(super) fn refuse_unknown_keys(
        &self,
        known: &(impl Iterator<Item = &'static Key> + Clone),
        special: impl Fn(&str) -> Option<(String, String)>,
        found: &mut Mistakes,
    ) {
        for key in self.entries.keys() {
            let name = key.get_ref().as_ref();
            if known.clone().any(|key| key.name == name) {
                continue;
            }
            if found.is_full() {
                found.add(key.span(), "", "", "");
                continue;
            }
            let (what, help) = special(name).unwrap_or_else(|| {
                let names = known.clone().map(|key| key.name);
                let help = match nearest(name, names.clone()) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => format!("known keys here: {}", listed(names)),
                };
                (format!("unknown key {}", quoted(name)), help)
            });
            found.add(key.span(), place::join(&self.path, name), what, help);
        }
    }

    /// What is made of the value of a key; `read` notes what is wrong with it.
    pub(super) fn entry<T>(
        &self,
        key: &'static Key,
        read: impl FnOnce(&Value<'a>) -> Option<T>,
    ) -> Entry<T> {
        match self.value(key) {
            None => Entry::Absent(key),
            Some(value) => read(&value).map_or(Entry::Wrong, Entry::Given),
        }
    }

    /// A table of its own.
    pub(super) fn table(&self, key: &'static Key, found: &mut Mistakes) -> Entry<Table<'a>> {
        self.entry(key, |value| value.table(found))
    }

    /// A list of tables; those members that are none are noted and left out.
    pub(super) fn tables(&self, key: &'static Key, found: &mut Mistakes) -> Entry<Vec<Table<'a>>> {
        self.entry(key, |value| {
            let members = value.members(key.holds.expected(), found)?;
            Some(
                members
                    .iter()
                    .filter_map(|member| member.table(found))
                    .collect(),
            )
        })
    }

    /// A line of text.
    pub(super) fn text(&self, key: &'static Key, found: &mut Mistakes) -> Entry<&'a str> {
        self.entry(key, |value| value.text(found))
    }

    /// A line of text, or a list of one or more.
    pub(super) fn names(&self, key: &'static Key, found: &mut Mistakes) -> Entry<Vec<String>> {
        self.entry(key, |value| {
            if let Some(name) = value.toml.get_ref().as_str() {
                return Some(vec![name.to_owned()]);
            }
            let members = value.members(key.holds.expected(), found)?;
            if members.is_empty() {
                let help = format!("leave it out, or {}", key.write_example());
                found.add(value.span(), &*value.path, "the list is empty", help);
                return None;
            }
            let names: Vec<_> = members.iter().map(|member| member.text(found)).collect();
            names
                .into_iter()
                .map(|name| name.map(str::to_owned))
                .collect()
        })
    }

    /// A number in the range that the key allows.
    pub(super) fn number(&self, key: &'static Key, found: &mut Mistakes) -> Entry<f64> {
        self.entry(key, |value| value.number(&key.range(), found))
    }

    /// Three numbers, each in the range that the key allows.
    pub(super) fn vector(&self, key: &'static Key, found: &mut Mistakes) -> Entry<[f64; 3]> {
        self.entry(key, |value| value.vector(&key.range(), found))
    }

    /// One or more points, each number in the range that the key allows.
    pub(super) fn points(&self, key: &'static Key, found: &mut Mistakes) -> Entry<Vec<[f64; 3]>> {
        self.entry(key, |value| value.points(&key.range(), found))
    }

    /// One of a fixed list of names.
    pub(super) fn choice<T: Choice>(&self, key: &'static Key, found: &mut Mistakes) -> Entry<T> {
        self.entry(key, |value| {
            let name = value.text(found)?;
            let choice = T::from_name(name);
            if choice.is_none() {
                let names = T::ALL.iter().map(|(value, _)| value.name());
                let (what, help) = unknown_name(name, names);
                found.add(value.span(), &*value.path, what, help);
            }
            choice
        })
    }
}

/// What is wrong with a name that is none of those known, and what would be right.
pub(super) fn unknown_name<'a>(
    name: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> (String, String) {
    let help = match nearest(name, known.clone()) {
        Some(meant) => format!("did you mean {meant:?}? Known: {}", one_of(known)),
        None => format!("known: {}", one_of(known)),
    };
    (format!("unknown name {}", quoted(name)), help)
}

/// `"a", "b"`
fn one_of<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.map(|name| format!("{name:?}")).collect();
    names.join(", ")
}

/// `` `a`, `b` ``
fn listed(names: impl Iterator<Item = &'static str>) -> String {
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    names.join(", ")
}
