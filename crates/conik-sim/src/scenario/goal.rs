//! Reading what is asked of a task: points to visit, a desired value, or a set.

use super::config::GoalConfig;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::posture;
use super::read::Surroundings;
use super::table::Table;
use super::task_types::{GoalShape, TaskType};
use super::value::shown;
use super::waypoints::{Counts, ONE_PLACE, Places, WAYPOINTS, first_of};

pub(super) fn read(
    table: &Table,
    task_type: &TaskType,
    surroundings: Surroundings,
    found: &mut Mistakes,
) -> Option<GoalConfig> {
    let gain = read_gain(table, surroundings.rate_hz, found);
    match task_type.goal {
        GoalShape::Place(counts) => read_place(table, counts, gain, found),
        // Of no error any gain makes nothing.
        GoalShape::Own => Some(GoalConfig::Desired {
            desired: vec![0.0],
            gain_per_s: 1.0,
        }),
        GoalShape::Posture => {
            let desired = posture::desired(table, surroundings.robot, found);
            let gain_per_s = needs_gain(table, gain, found);
            Some(GoalConfig::Desired {
                desired: desired?,
                gain_per_s: gain_per_s?,
            })
        }
        GoalShape::Scalar(least, most) => read_scalar(table, gain, (least, most), found),
    }
}

/// Notes what is wrong with the values of a goal whose shape is unknown: no goal comes of it.
pub(super) fn look_over(table: &Table, found: &mut Mistakes) -> Option<GoalConfig> {
    for key in [
        &keys::DESIRED,
        &keys::MIN,
        &keys::MAX,
        &keys::RECOVERY_PER_S,
        &keys::GAIN_PER_S,
        &keys::ACCEPTANCE_M,
    ] {
        let _ = table.number(key, found);
    }
    let _ = table.vector(&keys::TARGET_M, found);
    let _ = table.points(&keys::WAYPOINTS_M, found);
    None
}

/// A gain, if there is one: `Some(None)` if there is none, `None` if it is wrong.
type Gain = Option<Option<f64>>;

/// The gain. With T the control period and Λ the gain, a step multiplies the error by 1 − ΛT:
/// from ΛT = 2 on it grows.
fn read_gain(table: &Table, rate_hz: Option<f64>, found: &mut Mistakes) -> Gain {
    let key = &keys::GAIN_PER_S;
    let gain = table.number(key, found);
    if !gain.is_present() {
        return Some(None);
    }
    let gain = gain.given()?;
    if let Some(rate_hz) = rate_hz.filter(|rate_hz| gain / rate_hz >= 2.0) {
        found.add(
            table.span_of(key),
            table.path_of(key),
            format!("a gain of {gain} 1/s is unstable at {rate_hz} Hz: every step overshoots by more than the error"),
            format!("take less than {} 1/s, twice the control rate; 1 is usual", 2.0 * rate_hz),
        );
        return None;
    }
    Some(Some(gain))
}

fn needs_gain(table: &Table, gain: Gain, found: &mut Mistakes) -> Option<f64> {
    if gain == Some(None) {
        let (span, path) = (table.header.clone(), table.path_of(&keys::GAIN_PER_S));
        let help = keys::GAIN_PER_S.write_example();
        found.add(span, path, "missing: an equality task needs a gain", help);
    }
    gain.flatten()
}

fn read_place(
    table: &Table,
    counts: Counts,
    gain: Gain,
    found: &mut Mistakes,
) -> Option<GoalConfig> {
    let is_point = !counts.orientation;
    if is_point
        && first_of(table, WAYPOINTS)
            .or(first_of(table, ONE_PLACE))
            .is_none()
    {
        // Where another type's goal stands, that has been noted as what is wrong.
        let other_goals = [&keys::DESIRED, &keys::MIN, &keys::MAX];
        if first_of(table, &other_goals).is_none() {
            no_goal(
                table,
                "give `waypoints_m` and `acceptance_m`, or `target_m`; and `gain_per_s`",
                found,
            );
        }
        return None;
    }
    let places = Places::read(table, counts, found);
    let gain_per_s = needs_gain(table, gain, found);
    Some(places?.goal(counts, gain_per_s?))
}

fn read_scalar(
    table: &Table,
    gain: Gain,
    values: (f64, f64),
    found: &mut Mistakes,
) -> Option<GoalConfig> {
    let desired = table.number(&keys::DESIRED, found);
    let min = table.number(&keys::MIN, found);
    let max = table.number(&keys::MAX, found);
    let recovery = table.number(&keys::RECOVERY_PER_S, found);
    let is_set = min.is_present() || max.is_present();
    if recovery.is_present() && desired.is_present() && !is_set {
        found.add(
            table.span_of(&keys::RECOVERY_PER_S),
            table.path_of(&keys::RECOVERY_PER_S),
            "`recovery_per_s` says how fast a set is entered, and this is an equality task",
            "remove it; an equality task has `gain_per_s`",
        );
    }
    match (desired.is_present(), is_set) {
        (true, true) => {
            contradiction(
                table,
                &keys::DESIRED,
                "both a `desired` value and `min` or `max` are given",
                found,
            );
            None
        }
        (true, false) => {
            let gain_per_s = needs_gain(table, gain, found);
            let desired = desired.given()?;
            if desired < values.0 || desired > values.1 {
                unreachable_value(table, &keys::DESIRED, desired, values, found);
                return None;
            }
            Some(GoalConfig::Desired {
                desired: vec![desired],
                gain_per_s: gain_per_s?,
            })
        }
        (false, true) => {
            let min = min.map(Some).or(None);
            let max = max.map(Some).or(None);
            let recovery = recovery.map(Some).or(None);
            check_limits(table, min.flatten(), max.flatten(), values, found);
            Some(GoalConfig::Set {
                min: min?,
                max: max?,
                recovery_per_s: recovery?,
                gain_per_s: gain?,
            })
        }
        (false, false) => {
            let has_other_goal = [&keys::TARGET_M, &keys::WAYPOINTS_M]
                .into_iter()
                .any(|key| table.has(key));
            if !has_other_goal {
                no_goal(
                    table,
                    "give `min` and/or `max` for a set, or `desired` and `gain_per_s` for an equality task",
                    found,
                );
            }
            None
        }
    }
}

/// Notes limits between which there is nothing.
fn check_limits(
    table: &Table,
    min: Option<f64>,
    max: Option<f64>,
    values: (f64, f64),
    found: &mut Mistakes,
) {
    if let (Some(min), Some(max)) = (min, max)
        && min > max
    {
        found.add(
            table.span_of(&keys::MIN),
            table.path_of(&keys::MIN),
            format!(
                "min {} is greater than max {}: no value is in this set",
                shown(min),
                shown(max)
            ),
            format!(
                "exchange them: `min = {}`, `max = {}`",
                shown(max),
                shown(min)
            ),
        );
        return;
    }
    if let Some(min) = min.filter(|min| *min > values.1) {
        unreachable_value(table, &keys::MIN, min, values, found);
    }
    if let Some(max) = max.filter(|max| *max < values.0) {
        unreachable_value(table, &keys::MAX, max, values, found);
    }
}

/// Notes a value that the task can never have.
fn unreachable_value(
    table: &Table,
    key: &Key,
    value: f64,
    values: (f64, f64),
    found: &mut Mistakes,
) {
    let what = format!("{} is out of reach of a task of this type", shown(value));
    found.add(
        table.span_of(key),
        table.path_of(key),
        what,
        possible(values),
    );
}

/// Which values a task can have, for people.
pub(super) fn possible(values: (f64, f64)) -> String {
    match values {
        (least, most) if most.is_finite() => format!("its values are from {least} to {most}"),
        (least, _) => format!("its values are never below {least}"),
    }
}

fn contradiction(table: &Table, key: &Key, what: &str, found: &mut Mistakes) {
    found.add(
        table.span_of(key),
        table.path_of(key),
        what,
        "remove one of them",
    );
}

fn no_goal(table: &Table, help: &str, found: &mut Mistakes) {
    found.add(
        table.header.clone(),
        &*table.path,
        "nothing is asked of this task",
        help,
    );
}
