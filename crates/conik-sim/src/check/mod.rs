//! What is doubtful about a scenario that is otherwise sound.

mod obstacles;
mod singular;

use std::f64::consts::PI;

use conik::{Frame, Goal, Kinematics, Stack, TaskId, dependent_tasks};

use crate::experiment::Experiment;
use crate::joint_limits::LIMIT;
use crate::scenario::{
    Border, Choice, Control, GoalConfig, ModeRule, Recursion, Scenario, TaskKind,
};
use obstacles::{
    exclusive_obstacles_that_meet, goals_in_obstacles, idle_self_collision, obstacles_too_fast,
    targets, unused_obstacles,
};
use singular::undamped_at_a_singularity;

/// What a look at a scenario found, before anything moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Position of the tool at the start [m].
    pub tool_m: [f64; 3],
    /// The value of each task at the start, or its error, with unit.
    pub values: Vec<String>,
    /// Sentences about what may not go as expected.
    pub doubts: Vec<String>,
}

/// Looks at a scenario at its start.
pub fn find(scenario: &Scenario, experiment: &Experiment) -> Findings {
    let mut kinematics = Kinematics::new(&experiment.robot);
    kinematics.update(&experiment.q0);
    let stack = experiment.controller.stack();
    let values: Vec<Vec<f64>> = stack
        .iter()
        .map(|(_, level)| {
            let mut value = vec![0.0; level.task().dimension()];
            level.task().value(&kinematics, &mut value);
            value
        })
        .collect();
    let mut doubts = Vec::new();
    rules_that_stand_in_the_way(&scenario.control, &mut doubts);
    starts_outside(stack, &values, &mut doubts);
    depends(stack, &dependent_tasks(stack, &kinematics), &mut doubts);
    undamped_at_a_singularity(scenario, stack, &kinematics, &mut doubts);
    goals_in_obstacles(scenario, &mut doubts);
    obstacles_too_fast(scenario, experiment, &kinematics, &mut doubts);
    unused_obstacles(scenario, &mut doubts);
    idle_self_collision(scenario, experiment, &mut doubts);
    if scenario.control.mode_rule == ModeRule::Cone {
        exclusive_without_effect(&scenario.control, &mut doubts);
    } else {
        exclusive_obstacles_that_meet(scenario, &mut doubts);
    }
    out_of_reach(scenario, experiment, &mut doubts);
    elbow_jumps(scenario, &mut doubts);
    no_equality(stack, &mut doubts);
    Findings {
        tool_m: kinematics.world_from(Frame::Tool).origin.to_array(),
        values: stack
            .iter()
            .zip(&values)
            .map(|((_, level), value)| {
                let numbers: Vec<String> = value.iter().map(|v| format!("{v:.4}")).collect();
                let unit = match level.task().unit() {
                    "-" => String::new(),
                    unit => format!(" {unit}"),
                };
                match numbers.as_slice() {
                    [one] => format!("{one}{unit}"),
                    several => format!("({}){unit}", several.join(", ")),
                }
            })
            .collect(),
        doubts,
    }
}

fn rules_that_stand_in_the_way(control: &Control, doubts: &mut Vec<String>) {
    if control.mode_rule == ModeRule::Paper {
        doubts.push(
            "rule `paper` may freeze a set that is nowhere near its border, and then wait for ever: \
             rule `cone` never does"
                .to_owned(),
        );
    }
    if control.border == Border::Freeze {
        doubts.push(
            "border `freeze` decides at samples and undoes nothing: high-priority sets may be left \
             by what the arm moves in one period; border `land` keeps every sample inside"
                .to_owned(),
        );
    }
    if control.mode_rule == ModeRule::Cone && control.recursion == Recursion::Chiaverini {
        doubts.push(format!(
            "rule `cone` with recursion `{}` may come to rest where the sets leave a way on: \
             recursion `{}` finds it",
            Recursion::Chiaverini.name(),
            Recursion::SicilianoSlotine.name()
        ));
    }
}

fn exclusive_without_effect(control: &Control, doubts: &mut Vec<String>) {
    if !control.exclusive.is_empty() {
        doubts.push(
            "`exclusive` has no effect with rule `cone`, which needs no such help: a mode in which \
             two of its members are active can occur, and has no number in the log"
                .to_owned(),
        );
    }
}

fn starts_outside(stack: &Stack, values: &[Vec<f64>], doubts: &mut Vec<String>) {
    for ((id, level), value) in stack.iter().zip(values) {
        let Some(set) = level.interval() else {
            continue;
        };
        let (name, outside) = (level.name(), set.violation(value[0]));
        if !(outside > 0.0) {
            continue;
        }
        let place = match name.strip_prefix(LIMIT) {
            Some(joint) => format!("outside the position limits of {joint}"),
            None => "outside its set".to_owned(),
        };
        let recovery = match level.goal() {
            Goal::Set { recovery, .. } => *recovery,
            Goal::Equality { .. } => None,
        };
        let becomes = if !stack.is_high_priority(id) {
            "it is driven in as well as the tasks above it allow".to_owned()
        } else if let Some(speed) = recovery {
            let unit = match level.task().unit() {
                "-" => "1",
                unit => unit,
            };
            format!("it is driven in at {speed} {unit}/s, as far as the other sets allow")
        } else {
            let never = "it is never driven in, only kept from getting worse until the other tasks \
                         bring it in";
            if name.starts_with(LIMIT) {
                never.to_owned()
            } else {
                format!("{never}; `recovery_per_s` would drive it in")
            }
        };
        doubts.push(format!("`{name}` starts {outside:.4} {place}: {becomes}"));
    }
}

fn depends(stack: &Stack, dependent: &[TaskId], doubts: &mut Vec<String>) {
    let mut equalities = stack.iter().filter(|(_, level)| level.interval().is_none());
    let first = equalities.next().map(|(id, _)| id);
    for &task in dependent {
        let name = stack[task].name();
        doubts.push(if Some(task) == first {
            format!(
                "at the start, no joint motion moves `{name}` in one of its directions: it may not \
                 converge from there"
            )
        } else {
            format!(
                "at the start, `{name}` depends on the equality tasks above it: they leave it no joint \
                 motion of its own, and it cannot converge there"
            )
        });
    }
}

fn out_of_reach(scenario: &Scenario, experiment: &Experiment, doubts: &mut Vec<String>) {
    // No point further from the base than all links laid end to end can be reached.
    let reach = Kinematics::new(&experiment.robot).span() / 2.0;
    for (target, place) in targets(scenario) {
        if place.norm() > reach {
            doubts.push(format!(
                "{target} is {:.3} m from the base, the arm reaches {reach:.3} m at most",
                place.norm()
            ));
        }
    }
}

/// At ±π the angle of an elbow goes on at ∓π: a set that has it inside is left there all at once.
fn elbow_jumps(scenario: &Scenario, doubts: &mut Vec<String>) {
    let is_within = |bound: Option<f64>| bound.is_some_and(|bound| bound.abs() < PI);
    for task in &scenario.tasks {
        let (TaskKind::Elbow { .. }, GoalConfig::Set { min, max, .. }) = (&task.kind, &task.goal)
        else {
            continue;
        };
        if !is_within(*min) || !is_within(*max) {
            doubts.push(format!(
                "`{}` has half a turn inside, where the angle jumps: give `min` and `max`, both less than \
                 half a turn, and another `direction` if need be",
                task.name
            ));
        }
    }
}

fn no_equality(stack: &Stack, doubts: &mut Vec<String>) {
    if stack.iter().all(|(_, level)| level.interval().is_some()) {
        doubts.push("there is no equality task: nothing asks the arm to move".to_owned());
    }
}
