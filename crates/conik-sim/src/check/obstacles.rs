//! What is doubtful about obstacles: goals in them, obstacles in each other, obstacles too fast.

use conik::{Frame, Kinematics, Vec3};

use crate::experiment::Experiment;
use crate::scenario::{GoalConfig, Scenario, TaskConfig, TaskKind};

/// The point of an obstacle and the distance to be kept from it; where one that moves comes to rest.
fn obstacle(task: &TaskConfig) -> Option<(Vec3, f64)> {
    // What is in the axes of a link, or concerns another link than the tool, is nothing to the targets.
    if !task.frames.is_tool_in_world() {
        return None;
    }
    match (&task.kind, &task.goal) {
        (&TaskKind::Distance { point_m }, GoalConfig::Set { min: Some(min), .. }) => {
            Some((rest(task, point_m)?, *min))
        }
        _ => None,
    }
}

/// Where a point of a task is in the end; `None` if it never comes to rest.
fn rest(task: &TaskConfig, start_m: [f64; 3]) -> Option<Vec3> {
    if task.motion.is_rest() {
        return Some(start_m.into());
    }
    let until_s = task.motion.moves_until_s?;
    Some(task.motion.point_at(start_m, until_s).into())
}

/// An obstacle that is faster than the tool can be at the start, in the direction in which it moves,
/// cannot be run away from.
pub(super) fn obstacles_too_fast(
    scenario: &Scenario,
    experiment: &Experiment,
    kinematics: &Kinematics,
    doubts: &mut Vec<String>,
) {
    for task in &scenario.tasks {
        let (TaskKind::Distance { .. }, Some(_)) = (&task.kind, keeps_away(task)) else {
            continue;
        };
        if !task.frames.is_tool_in_world() {
            continue;
        }
        let velocity: Vec3 = task.motion.velocity_m_per_s.unwrap_or_default().into();
        let speed = velocity.norm();
        let fastest = fastest_along(velocity * (1.0 / speed), experiment, kinematics);
        if speed > fastest {
            doubts.push(format!(
                "the point of `{}` moves at {speed:.3} m/s; at the start the tool can move away from \
                 it at {fastest:.3} m/s at most: where it comes straight at the tool the set may be \
                 left, which is announced in the tick before",
                task.name
            ));
        }
    }
}

/// The least distance that a task keeps, if it keeps one.
fn keeps_away(task: &TaskConfig) -> Option<f64> {
    match task.goal {
        GoalConfig::Set { min, .. } => min,
        _ => None,
    }
}

/// Greatest speed of the tool in a direction of length 1 [m/s], with every joint at its speed limit.
fn fastest_along(direction: Vec3, experiment: &Experiment, kinematics: &Kinematics) -> f64 {
    let mut row = vec![0.0; experiment.robot.dof()];
    let (motion, tool) = (
        kinematics.motion(Frame::Tool),
        kinematics.world_from(Frame::Tool).origin,
    );
    kinematics.point_row(motion, tool, direction, &mut row);
    let joints = experiment.robot.joints().iter();
    let limits = joints.map(|joint| joint.limits.speed.unwrap_or(f64::INFINITY));
    let moved = row.iter().zip(limits).filter(|(entry, _)| **entry != 0.0);
    moved.map(|(entry, limit)| entry.abs() * limit).sum()
}

/// Where a task wants the tool, with the name of each place.
pub(super) fn targets(scenario: &Scenario) -> Vec<(String, Vec3)> {
    let mut targets = Vec::new();
    let of_tool = scenario.tasks.iter();
    for task in of_tool.filter(|task| task.frames.is_tool_in_world()) {
        match (&task.kind, &task.goal) {
            (_, GoalConfig::Waypoints { waypoints_m, .. }) => {
                for (i, &point) in waypoints_m.iter().enumerate() {
                    targets.push((
                        format!("waypoint {} of `{}`", i + 1, task.name),
                        point.into(),
                    ));
                }
            }
            (TaskKind::Pose { target_m, .. }, _) => {
                let target = rest(task, *target_m);
                targets.extend(target.map(|it| (format!("the target of `{}`", task.name), it)));
            }
            (TaskKind::Position, GoalConfig::Desired { desired, .. }) => {
                if let &[x, y, z] = desired.as_slice()
                    && let Some(target) = rest(task, [x, y, z])
                {
                    targets.push((format!("the target of `{}`", task.name), target));
                }
            }
            _ => {}
        }
    }
    targets
}

pub(super) fn goals_in_obstacles(scenario: &Scenario, doubts: &mut Vec<String>) {
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

pub(super) fn exclusive_obstacles_that_meet(scenario: &Scenario, doubts: &mut Vec<String>) {
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

/// Where all shapes are neighbours or excluded, nothing is kept apart.
pub(super) fn idle_self_collision(
    scenario: &Scenario,
    experiment: &Experiment,
    doubts: &mut Vec<String>,
) {
    let sets = scenario.collision.tasks(&experiment.robot);
    let is_own =
        |set: &TaskConfig| matches!(&set.kind, TaskKind::Shapes(pair) if pair.other_link.is_some());
    if scenario.collision.self_collision.is_some() && !sets.iter().any(is_own) {
        doubts.push(
            "`self_collision` keeps nothing apart: no two of the shapes are on links with more than \
             one joint between them"
                .to_owned(),
        );
    }
}

/// An obstacle without a distance that no task measures does nothing.
pub(super) fn unused_obstacles(scenario: &Scenario, doubts: &mut Vec<String>) {
    let named = |name: &String| {
        scenario.tasks.iter().any(
            |task| matches!(&task.kind, TaskKind::ShapeDistance { shapes } if shapes.contains(name)),
        )
    };
    let obstacles = scenario.collision.obstacles.iter();
    for obstacle in obstacles.filter(|it| it.distance_m.is_none() && !named(&it.name)) {
        doubts.push(format!(
            "nothing keeps away from the obstacle `{}`: it has no `distance_m`, and no task of type \
             `shape_distance` names it",
            obstacle.name
        ));
    }
}
