//! Reading what is asked of a task: points to visit, a desired value, or a set.

use super::config::GoalConfig;
use super::keys;
use super::mistake::Mistakes;
use super::posture;
use super::read::Surroundings;
use super::scalar_goal::{self, Values};
use super::table::Table;
use super::task_types::{GoalShape, TaskType};
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
        GoalShape::Region => {
            let recovery = table.number(&keys::RECOVERY_PER_S, found);
            Some(GoalConfig::Set {
                min: None,
                max: None,
                recovery_per_s: recovery.map(Some).or(None)?,
                gain_per_s: gain?,
            })
        }
        GoalShape::Scalar(least, most) => {
            let values = Values {
                least,
                most,
                degrees: task_type.degrees,
            };
            scalar_goal::read(table, values, gain, surroundings.robot, found)
        }
    }
}

/// Notes what is wrong with the values of a goal whose shape is unknown: no goal comes of it.
pub(super) fn look_over(table: &Table, found: &mut Mistakes) -> Option<GoalConfig> {
    for key in [
        &keys::DESIRED,
        &keys::MIN,
        &keys::MAX,
        &keys::MIN_DEG,
        &keys::MAX_DEG,
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
pub(super) type Gain = Option<Option<f64>>;

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

pub(super) fn needs_gain(table: &Table, gain: Gain, found: &mut Mistakes) -> Option<f64> {
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
        if first_of(table, &[keys::DESIRED_VALUE, keys::LIMITS].concat()).is_none() {
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

pub(super) fn no_goal(table: &Table, help: &str, found: &mut Mistakes) {
    found.add(
        table.header.clone(),
        &*table.path,
        "nothing is asked of this task",
        help,
    );
}
