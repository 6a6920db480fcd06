//! Whether what moves of a task goes with what is asked of it.

use super::config::GoalConfig;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::motion::Motion;
use super::read::Surroundings;
use super::scalar_goal::possible;
use super::table::Table;
use super::task_types::{GoalShape, TaskType};
use super::value::shown;
use super::waypoints::{WAYPOINTS, first_of};

/// Notes a speed of what the task does not have, and one that takes it out of reach.
pub(super) fn check(
    table: &Table,
    task_type: &TaskType,
    (motion, goal): (&Motion, &GoalConfig),
    surroundings: Surroundings,
    found: &mut Mistakes,
) {
    match task_type.goal {
        GoalShape::Place(_) => {
            let speed = first_of(table, task_type.moves);
            if let (Some(speed), Some(waypoints)) = (speed, first_of(table, WAYPOINTS)) {
                refuse(
                    table,
                    speed,
                    "it says how what is asked for moves, and waypoints stay where they are",
                    &format!(
                        "remove it, or give one place in place of `{}`",
                        waypoints.name
                    ),
                    found,
                );
            }
        }
        GoalShape::Scalar(..) if motion.desired_per_s.is_none() => {}
        GoalShape::Scalar(least, most) => match goal {
            GoalConfig::Desired { desired, .. } => {
                let until = motion.moves_until_s.or(surroundings.duration_s);
                let (Some(until_s), Some(desired)) = (until, desired.first()) else {
                    return;
                };
                let last = motion.value_at(*desired, until_s);
                if !(least..=most).contains(&last) {
                    let what = format!(
                        "after {} s the desired value is {}, out of reach of a task of this type",
                        shown(until_s),
                        shown(last)
                    );
                    let help = format!(
                        "{}: let it come to rest earlier with `moves_until_s`, or take another speed",
                        possible((least, most))
                    );
                    refuse(table, &keys::DESIRED_PER_S, &what, &help, found);
                }
            }
            _ => refuse(
                table,
                &keys::DESIRED_PER_S,
                "it says how a desired value moves, and this is a set",
                "remove it, or give `desired` in place of `min` and `max`",
                found,
            ),
        },
        _ => {}
    }
}

fn refuse(table: &Table, key: &Key, what: &str, help: &str, found: &mut Mistakes) {
    found.add(table.span_of(key), table.path_of(key), what, help);
}
