//! What is doubtful about a scenario that is otherwise sound.

use conik::{Frame, Stack, TaskId, Vec3, dependent_tasks};

use crate::experiment::Experiment;
use crate::scenario::{
    Border, Choice, Control, GoalConfig, ModeRule, Recursion, Scenario, TaskConfig, TaskKind,
};

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
    let mut kinematics = conik::Kinematics::new(&experiment.robot);
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
    goals_in_obstacles(scenario, &mut doubts);
    if scenario.control.mode_rule == ModeRule::Cone {
        exclusive_without_effect(&scenario.control, &mut doubts);
    } else {
        exclusive_obstacles_that_meet(scenario, &mut doubts);
    }
    out_of_reach(scenario, experiment, &mut doubts);
    no_equality(stack, &mut doubts);
    Findings {
        tool_m: kinematics.base_from(Frame::Tool).origin.to_array(),
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
        if outside > 0.0 && stack.is_high_priority(id) {
            doubts.push(format!(
                "`{name}` starts {outside:.4} outside its set: it is never driven in, only kept from \
                 getting worse until the other tasks bring it in"
            ));
        } else if outside > 0.0 {
            doubts.push(format!(
                "`{name}` starts {outside:.4} outside its set: it is driven in as well as the tasks \
                 above it allow"
            ));
        }
    }
}

fn depends(stack: &Stack, dependent: &[TaskId], doubts: &mut Vec<String>) {
    for &task in dependent {
        doubts.push(format!(
            "at the start, `{}` depends on the equality tasks above it: they leave it no joint motion \
             of its own, and it cannot converge there",
            stack[task].name()
        ));
    }
}

/// The point of an obstacle and the distance to be kept from it.
fn obstacle(task: &TaskConfig) -> Option<(Vec3, f64)> {
    match (&task.kind, &task.goal) {
        (TaskKind::Distance { point_m, .. }, GoalConfig::Set { min: Some(min), .. }) => {
            Some(((*point_m).into(), *min))
        }
        _ => None,
    }
}

/// Where a position task wants the tool, with the name of each place.
fn targets(scenario: &Scenario) -> Vec<(String, Vec3)> {
    let mut targets = Vec::new();
    for task in &scenario.tasks {
        match (&task.kind, &task.goal) {
            (TaskKind::Position, GoalConfig::Waypoints { waypoints_m, .. }) => {
                for (i, &point) in waypoints_m.iter().enumerate() {
                    targets.push((
                        format!("waypoint {} of `{}`", i + 1, task.name),
                        point.into(),
                    ));
                }
            }
            (TaskKind::Position, GoalConfig::Desired { desired, .. }) => {
                if let &[x, y, z] = desired.as_slice() {
                    targets.push((format!("the target of `{}`", task.name), Vec3::new(x, y, z)));
                }
            }
            _ => {}
        }
    }
    targets
}

fn goals_in_obstacles(scenario: &Scenario, doubts: &mut Vec<String>) {
    for (target, place) in targets(scenario) {
        for task in &scenario.tasks {
            let Some((centre, radius)) = obstacle(task) else {
                continue;
            };
            let distance = (place - centre).norm();
            if distance < radius {
                doubts.push(format!(
                    "{target} is {distance:.4} m from the point of `{}`, which keeps the tool \
                     {radius} m away: it cannot be reached",
                    task.name
                ));
            }
        }
    }
}

fn exclusive_obstacles_that_meet(scenario: &Scenario, doubts: &mut Vec<String>) {
    let named = |name: &String| scenario.tasks.iter().find(|task| task.name == *name);
    for group in &scenario.control.exclusive {
        let members: Vec<_> = group
            .iter()
            .filter_map(named)
            .filter_map(|task| Some((&task.name, obstacle(task)?)))
            .collect();
        for (i, (a, (a_point, a_radius))) in members.iter().enumerate() {
            for (b, (b_point, b_radius)) in &members[i + 1..] {
                if (*a_point - *b_point).norm() < a_radius + b_radius {
                    doubts.push(format!(
                        "`{a}` and `{b}` are exclusive, but their spheres meet: where both would be \
                         left at once no mode keeps both, and the arm stands still"
                    ));
                }
            }
        }
    }
}

fn out_of_reach(scenario: &Scenario, experiment: &Experiment, doubts: &mut Vec<String>) {
    // No point further from the base than all links laid end to end can be reached.
    let mut reach = 0.0;
    for joint in experiment.robot.joints() {
        reach += joint.dh.a_m.hypot(joint.dh.d_m);
    }
    for (target, place) in targets(scenario) {
        if place.norm() > reach {
            doubts.push(format!(
                "{target} is {:.3} m from the base, the arm reaches {reach:.3} m at most",
                place.norm()
            ));
        }
    }
}

fn no_equality(stack: &Stack, doubts: &mut Vec<String>) {
    if stack.iter().all(|(_, level)| level.interval().is_some()) {
        doubts.push("there is no equality task: nothing asks the arm to move".to_owned());
    }
}
