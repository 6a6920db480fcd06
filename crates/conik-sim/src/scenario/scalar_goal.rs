//! Reading what is asked of one value: that it be something, or between limits; of an angle also in degrees.

use super::config::GoalConfig;
use super::goal::{Gain, needs_gain, no_goal};
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robots::RobotFacts;
use super::table::{Entry, Table};
use super::task_types::Degrees;
use super::value::shown;
use super::waypoints::first_of;

/// Which values a type of task can have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values {
    pub(super) least: f64,
    pub(super) most: f64,
    /// How they follow from an angle in degrees, if they do.
    pub(super) degrees: Option<Degrees>,
}

/// A value as the file states it.
#[derive(Clone, Debug)]
struct Stated {
    key: &'static Key,
    /// In the unit of the key.
    number: Entry<f64>,
    /// Makes the task's unit of it.
    to_value: fn(f64) -> f64,
    /// Which numbers can be met, in the unit of the key.
    in_reach: (f64, f64),
}

pub(super) fn read(
    table: &Table,
    values: Values,
    gain: Gain,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<GoalConfig> {
    if !are_degrees_of_what_turns(table, values, robot, found) {
        return None;
    }
    let desired = values.stated(table, &keys::DESIRED, &keys::ANGLE_DESIRED_DEG, found);
    let min = values.stated(table, &keys::MIN, &keys::MIN_DEG, found);
    let max = values.stated(table, &keys::MAX, &keys::MAX_DEG, found);
    let recovery = table.number(&keys::RECOVERY_PER_S, found);
    let is_equality = desired.number.is_present();
    let is_set = min.number.is_present() || max.number.is_present();
    if recovery.is_present() && is_equality && !is_set {
        found.add(
            table.span_of(&keys::RECOVERY_PER_S),
            table.path_of(&keys::RECOVERY_PER_S),
            "`recovery_per_s` says how fast a set is entered, and this is an equality task",
            "remove it; an equality task has `gain_per_s`",
        );
    }
    match (is_equality, is_set) {
        (true, true) => {
            found.add(
                table.span_of(desired.key),
                table.path_of(desired.key),
                "both a `desired` value and `min` or `max` are given",
                "remove one of them",
            );
            None
        }
        (true, false) => {
            let gain_per_s = needs_gain(table, gain, found);
            let value = desired.value()?;
            if desired.is_below() || desired.is_above() {
                desired.out_of_reach(table, found);
                return None;
            }
            Some(GoalConfig::Desired {
                desired: vec![value],
                gain_per_s: gain_per_s?,
            })
        }
        (false, true) => {
            let recovery = recovery.map(Some).or(None);
            check_limits(table, &min, &max, found);
            Some(GoalConfig::Set {
                min: min.number.map(min.to_value).map(Some).or(None)?,
                max: max.number.map(max.to_value).map(Some).or(None)?,
                recovery_per_s: recovery?,
                gain_per_s: gain?,
            })
        }
        (false, false) => {
            if first_of(table, &[&keys::TARGET_M, &keys::WAYPOINTS_M]).is_none() {
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

/// A joint that slides has its position in [m], which no degrees make.
fn are_degrees_of_what_turns(
    table: &Table,
    values: Values,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> bool {
    let in_degrees = [&keys::ANGLE_DESIRED_DEG, &keys::MIN_DEG, &keys::MAX_DEG];
    let given = values.degrees.and_then(|_| first_of(table, &in_degrees));
    // What is wrong with the joint is noted where it is read.
    let joint = table.joint(&keys::JOINT, robot, &mut Mistakes::new(""));
    let (Some(key), Some(joint), Some(robot)) = (given, joint.given(), robot) else {
        return true;
    };
    let turns = robot.slides.get(joint - 1) != Some(&true);
    if !turns {
        found.add(
            table.span_of(key),
            table.path_of(key),
            format!("joint {joint} slides: its position is in m, not in degrees"),
            format!("give `{}`", key.name.trim_end_matches("_deg")),
        );
    }
    turns
}

impl Values {
    /// What stands under `key`, or in degrees under `deg`.
    fn stated(
        &self,
        table: &Table,
        key: &'static Key,
        deg: &'static Key,
        found: &mut Mistakes,
    ) -> Stated {
        let mut stated = Stated {
            key,
            number: table.number(key, found),
            to_value: |value| value,
            in_reach: (self.least, self.most),
        };
        let Some(degrees) = self.degrees.filter(|_| table.has(deg)) else {
            return stated;
        };
        let angle = table.number(deg, found);
        if stated.number.is_present() {
            found.add(
                table.span_of(deg),
                table.path_of(deg),
                format!("both `{}` and `{}` are given", key.name, deg.name),
                "state it once: remove one of them",
            );
            stated.number = Entry::Wrong;
            return stated;
        }
        Stated {
            key: deg,
            number: angle,
            to_value: degrees.to_value,
            in_reach: (
                (degrees.of_value)(self.least),
                (degrees.of_value)(self.most),
            ),
        }
    }
}

impl Stated {
    /// The value in the task's unit.
    fn value(&self) -> Option<f64> {
        self.number.clone().given().map(self.to_value)
    }

    fn is_below(&self) -> bool {
        let number = self.number.clone().given();
        number.is_some_and(|number| number < self.in_reach.0)
    }

    fn is_above(&self) -> bool {
        let number = self.number.clone().given();
        number.is_some_and(|number| number > self.in_reach.1)
    }

    /// Notes a value that the task can never have.
    fn out_of_reach(&self, table: &Table, found: &mut Mistakes) {
        let number = self.number.clone().given().unwrap_or_default();
        let what = format!("{} is out of reach of a task of this type", shown(number));
        let (span, path) = (table.span_of(self.key), table.path_of(self.key));
        found.add(span, path, what, possible(self.in_reach));
    }
}

/// Notes limits between which there is nothing.
fn check_limits(table: &Table, min: &Stated, max: &Stated, found: &mut Mistakes) {
    if let (Some(least), Some(most)) = (min.value(), max.value())
        && least > most
    {
        let number = |stated: &Stated| shown(stated.number.clone().given().unwrap_or_default());
        let help = if min.key.unit == max.key.unit {
            format!(
                "exchange them: `{} = {}`, `{} = {}`",
                min.key.name,
                number(max),
                max.key.name,
                number(min)
            )
        } else {
            "give a lesser `min` or a greater `max`".to_owned()
        };
        found.add(
            table.span_of(min.key),
            table.path_of(min.key),
            format!(
                "{} {} is greater than {} {}: no value is in this set",
                min.key.name,
                number(min),
                max.key.name,
                number(max)
            ),
            help,
        );
        return;
    }
    if min.is_above() {
        min.out_of_reach(table, found);
    }
    if max.is_below() {
        max.out_of_reach(table, found);
    }
}

/// Which values a task can have, for people.
pub(super) fn possible(values: (f64, f64)) -> String {
    match values {
        (least, most) if most.is_finite() => format!("its values are from {least} to {most}"),
        (least, _) => format!("its values are never below {least}"),
    }
}
