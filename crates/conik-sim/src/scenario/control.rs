//! Reading `[control]`.

use super::config::Control;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::place::Placed;
use super::table::Table;

/// What was found in `[control]`.
#[derive(Debug)]
pub(super) struct ReadControl {
    /// The rate alone: tasks are checked against it even if the rest is wrong.
    pub(super) rate_hz: Option<f64>,
    /// Everything, if everything is right.
    pub(super) whole: Option<Control>,
    /// `exclusive`, with its places.
    pub(super) groups: Vec<Group>,
}

/// Names of tasks that are never active together.
pub(super) type Group = Placed<Vec<Placed<String>>>;

impl Default for ReadControl {
    /// The table is not there.
    fn default() -> Self {
        let control = Control::default();
        Self {
            rate_hz: Some(control.rate_hz),
            whole: Some(control),
            groups: vec![],
        }
    }
}

impl ReadControl {
    /// Something else stands where the table should be.
    pub(super) fn unreadable() -> Self {
        Self {
            rate_hz: None,
            whole: None,
            groups: vec![],
        }
    }
}

pub(super) fn read(table: &Table, found: &mut Mistakes) -> ReadControl {
    table.refuse_unknown_keys(&keys::CONTROL_KEYS.iter().copied(), |_| None, found);
    let default = Control::default();
    let rate_hz = table.number(&keys::RATE_HZ, found).or(default.rate_hz);
    let duration_s = table
        .number(&keys::DURATION_S, found)
        .or(default.duration_s);
    let mode_rule = table.choice(&keys::MODE_RULE, found).or(default.mode_rule);
    let border = table.choice(&keys::BORDER, found).or(default.border);
    let recursion = table.choice(&keys::RECURSION, found).or(default.recursion);
    let groups = read_groups(table, &keys::EXCLUSIVE, found);
    check_ticks(table, rate_hz, duration_s, found);

    let whole = || {
        let names = |group: &Group| group.value.iter().map(|name| name.value.clone()).collect();
        Some(Control {
            rate_hz: rate_hz?,
            duration_s: duration_s?,
            mode_rule: mode_rule?,
            border: border?,
            recursion: recursion?,
            exclusive: groups.as_ref()?.iter().map(names).collect(),
        })
    };
    ReadControl {
        rate_hz,
        whole: whole(),
        groups: groups.unwrap_or_default(),
    }
}

/// Notes a run of more ticks than a log can hold, or of not one whole period.
fn check_ticks(table: &Table, rate_hz: Option<f64>, duration_s: Option<f64>, found: &mut Mistakes) {
    let (Some(rate_hz), Some(duration_s)) = (rate_hz, duration_s) else {
        return;
    };
    if rate_hz * duration_s > keys::MOST_TICKS {
        found.add(
            table.span_of(&keys::DURATION_S),
            table.path_of(&keys::DURATION_S),
            format!(
                "{duration_s} s at {rate_hz} Hz are more than {} ticks",
                keys::MOST_TICKS
            ),
            format!(
                "at this rate, run for at most {} s",
                (keys::MOST_TICKS / rate_hz).floor()
            ),
        );
    }
    // As the last tick is found: what is a period but for rounding is one.
    if rate_hz * duration_s + 1e-9 < 1.0 && duration_s > 0.0 {
        found.add(
            table.span_of(&keys::DURATION_S),
            table.path_of(&keys::DURATION_S),
            format!("{duration_s} s are shorter than one control period at {rate_hz} Hz"),
            format!("at this rate, run for at least {} s", 1.0 / rate_hz),
        );
    }
}

/// Groups of names; `None` where a value is of the wrong kind.
pub(super) fn read_groups(
    table: &Table,
    key: &'static Key,
    found: &mut Mistakes,
) -> Option<Vec<Group>> {
    let Some(list) = table.value(key) else {
        return Some(vec![]);
    };
    let groups = list.lists("a list of task names", found)?;
    let groups: Vec<Option<Group>> = groups
        .iter()
        .map(|group| {
            let members = group.members("a list of task names", found)?;
            let names: Vec<_> = members
                .iter()
                .map(|name| Some(name.placed(name.text(found)?.to_owned())))
                .collect();
            Some(group.placed(names.into_iter().collect::<Option<_>>()?))
        })
        .collect();
    groups.into_iter().collect()
}
