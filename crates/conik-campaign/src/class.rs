//! Why a run did not keep what the method promises under its assumptions.

use conik::{Controller, Goal, JacobianMut, JointVec, Kinematics, Robot, TaskId};
use serde::{Deserialize, Serialize};

/// Kinds of failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// Everything was kept.
    None,
    /// The time was over before the goal was reached: the error was still falling.
    OnItsWay,
    /// The arm rests where the tasks above leave the one that fails no motion that would reduce its error.
    DependentTasks,
    /// The arm rests where no motion of it reduces the error: stretched out, or at another singularity.
    Singularity,
    /// The arm rests where the sets allow no motion that reduces the error, though somewhere else it is less.
    LocalMinimum,
    /// A set that never was entered is outside, and others do not let it in.
    ConflictOfSets,
    /// The rule holds a set that is strictly inside, and the error does not fall.
    FrozenInside,
    /// A joint turns at its speed limit all the time, as one does near a singularity, and all others are slowed
    /// down with it, so that the error does not fall.
    SpeedLimit,
    /// A set was left between samples: border `freeze` does not look ahead, and brings none back.
    Freeze,
    /// A set that moves could not be kept, and that was announced.
    Announced,
    /// The reference kept every set, the arm that lags behind it did not.
    ServoLag,
    /// The run ended in a fault.
    Fault,
    /// None of these.
    Unexplained,
}

impl Class {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::None,
        Self::OnItsWay,
        Self::DependentTasks,
        Self::Singularity,
        Self::LocalMinimum,
        Self::ConflictOfSets,
        Self::FrozenInside,
        Self::SpeedLimit,
        Self::Freeze,
        Self::Announced,
        Self::ServoLag,
        Self::Fault,
        Self::Unexplained,
    ];

    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::OnItsWay => "on-its-way",
            Self::DependentTasks => "dependent-tasks",
            Self::Singularity => "singularity",
            Self::LocalMinimum => "local-minimum",
            Self::ConflictOfSets => "conflict-of-sets",
            Self::FrozenInside => "frozen-inside",
            Self::SpeedLimit => "speed-limit",
            Self::Freeze => "freeze",
            Self::Announced => "announced",
            Self::ServoLag => "servo-lag",
            Self::Fault => "fault",
            Self::Unexplained => "unexplained",
        }
    }

    /// What it is, for people.
    pub const fn in_words(self) -> &'static str {
        match self {
            Self::None => "everything was kept",
            Self::OnItsWay => "the time was over while the error was still falling",
            Self::DependentTasks => "the tasks above leave the one that fails no motion that helps",
            Self::Singularity => {
                "no motion of the arm reduces the error: stretched out, or singular"
            }
            Self::LocalMinimum => "the sets allow no motion that reduces the error",
            Self::ConflictOfSets => "a set that was never entered stays outside",
            Self::FrozenInside => "the rule holds a set that is strictly inside",
            Self::SpeedLimit => "a joint at its speed limit slows down all others",
            Self::Freeze => "a set was left between samples, and border freeze brings none back",
            Self::Announced => "a set that moves could not be kept, as was announced",
            Self::ServoLag => "the reference kept every set, the arm behind it did not",
            Self::Fault => "the run ended in a fault",
            Self::Unexplained => "none of these",
        }
    }
}

/// A bound counts as reached within this [task's unit].
const AT_THE_BOUND: f64 = 1e-3;
/// Less than this share of the steepest descent counts as none.
const NOTHING_LEFT: f64 = 1e-2;

/// Why an equality task that fails rests at `q`: by the first-order conditions of "the least error, subject to
/// the tasks above and the sets". `None`: it need not rest.
pub(crate) fn of_rest(
    robot: &Robot,
    controller: &Controller,
    failing: TaskId,
    q: &JointVec,
) -> Option<Class> {
    let stack = controller.stack();
    let step = controller.last_step();
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let rows = |task: TaskId| jacobian(controller, task, &kinematics);
    let error = step.error(failing);
    let mut gradient = vec![0.0; q.len()];
    let mut steepest = 0.0_f64;
    for (row, error) in rows(failing).chunks_exact(q.len()).zip(error) {
        steepest += row.iter().map(|entry| entry * entry).sum::<f64>() * error * error;
        for (sum, entry) in gradient.iter_mut().zip(row) {
            *sum += entry * error;
        }
    }
    let least = NOTHING_LEFT * steepest.sqrt();
    if norm(&gradient) <= least {
        return Some(Class::Singularity);
    }
    let mut above = Vec::new();
    let (mut equalities, mut sets) = (Vec::new(), Vec::new());
    for (id, level) in stack.iter() {
        match level.goal() {
            Goal::Equality { .. } if id < failing => {
                let both = rows(id);
                equalities.extend(both.chunks_exact(q.len()).flat_map(|row| {
                    let turned: Vec<f64> = row.iter().map(|entry| -entry).collect();
                    [row.to_vec(), turned]
                }));
            }
            Goal::Set { interval, .. } if stack.is_high_priority(id) => {
                let value = step.value(id)[0];
                let row = rows(id);
                if value - interval.min <= AT_THE_BOUND {
                    sets.push(row.clone());
                }
                if interval.max - value <= AT_THE_BOUND {
                    sets.push(row.iter().map(|entry| -entry).collect());
                }
            }
            Goal::Equality { .. } | Goal::Set { .. } => {}
        }
    }
    above.extend(equalities);
    if !above.is_empty() && residual(&gradient, &above) <= least {
        return Some(Class::DependentTasks);
    }
    above.extend(sets);
    (residual(&gradient, &above) <= least).then_some(Class::LocalMinimum)
}

fn jacobian(controller: &Controller, task: TaskId, kinematics: &Kinematics) -> Vec<f64> {
    let task = controller.stack()[task].task();
    let dof = kinematics.dof();
    let mut entries = vec![0.0; task.dimension() * dof];
    task.jacobian(kinematics, &mut JacobianMut::new(&mut entries, dof));
    entries
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// min |g + Σ μ a| over μ ≥ 0, by coordinates in turn until none moves any more.
fn residual(gradient: &[f64], inward: &[Vec<f64>]) -> f64 {
    const ROUNDS: usize = 10_000;
    let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut rest = gradient.to_vec();
    let mut multipliers = vec![0.0_f64; inward.len()];
    for _ in 0..ROUNDS {
        let mut largest = 0.0_f64;
        for (multiplier, row) in multipliers.iter_mut().zip(inward) {
            let squared = product(row, row);
            if squared < 1e-18 {
                continue;
            }
            let best = (*multiplier - product(row, &rest) / squared).max(0.0);
            let change = best - *multiplier;
            *multiplier = best;
            for (rest, entry) in rest.iter_mut().zip(row) {
                *rest += change * entry;
            }
            largest = largest.max(change.abs() * squared.sqrt());
        }
        if largest < 1e-10 {
            break;
        }
    }
    norm(&rest)
}
