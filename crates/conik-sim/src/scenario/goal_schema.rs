//! The part of the JSON Schema that says what can be asked of a task.

use serde_json::{Value, json};

use super::key::Key;
use super::keys;
use super::task_types::{GoalShape, TaskType};
use super::waypoints::{ACCEPTANCE, Counts, ONE_PLACE, WAYPOINTS};

/// What can be asked of a type of task: one of these.
pub(super) fn alternatives(task_type: &TaskType) -> Value {
    match task_type.goal {
        GoalShape::Place(counts) => places(task_type, counts),
        GoalShape::Own => json!([{}]),
        GoalShape::Posture => json!([
            { "required": ["desired_deg", "gain_per_s"] },
            { "required": ["desired_rad", "gain_per_s"] },
        ]),
        GoalShape::Region => json!([
            { "required": ["center_m", "radius_m"], "not": { "anyOf": [
                { "required": ["min_m"] },
                { "required": ["max_m"] },
            ] } },
            { "required": ["min_m", "max_m"], "not": { "anyOf": [
                { "required": ["center_m"] },
                { "required": ["radius_m"] },
            ] } },
        ]),
        GoalShape::Scalar(..) => scalar(task_type),
    }
}

/// One value, or a set; each number in one unit.
fn scalar(task_type: &TaskType) -> Value {
    let known = |keys: &[&'static Key]| -> Vec<&'static Key> {
        let of_type = |key: &&Key| task_type.goal_keys().iter().any(|it| it.name == key.name);
        keys.iter().copied().filter(of_type).collect()
    };
    let (desired, limits) = (known(keys::DESIRED_VALUE), known(keys::LIMITS));
    let of_sets = [limits.as_slice(), &[&keys::RECOVERY_PER_S]].concat();
    let of_values = [desired.as_slice(), &[&keys::DESIRED_PER_S]].concat();
    let mut set = json!({
        "not": { "anyOf": each_alone(&of_values) },
        "anyOf": each_alone(&limits),
    });
    if task_type.degrees.is_some() {
        set["allOf"] = json!([
            { "not": { "required": ["min", "min_deg"] } },
            { "not": { "required": ["max", "max_deg"] } },
        ]);
    }
    json!([
        {
            "required": ["gain_per_s"],
            "oneOf": each_alone(&desired),
            "not": { "anyOf": each_alone(&of_sets) },
        },
        set,
    ])
}

/// Waypoints, or one place, which may move.
fn places(task_type: &TaskType, counts: Counts) -> Value {
    let visits = [ACCEPTANCE, WAYPOINTS].concat();
    let stays = [ONE_PLACE, task_type.moves].concat();
    let mut alternatives = Vec::new();
    for (point, turns, others) in [
        (
            ["waypoints_m", "acceptance_m"].as_slice(),
            [&WAYPOINTS[1..], &ACCEPTANCE[1..]],
            stays,
        ),
        (["target_m"].as_slice(), [&ONE_PLACE[1..], &[]], visits),
    ] {
        let mut required = vec![keys::GAIN_PER_S.name];
        let mut rules = vec![json!({ "not": { "anyOf": each_alone(&others) } })];
        if counts.point {
            required.extend(point);
        }
        if counts.orientation {
            let ways = turns.into_iter().filter(|ways| !ways.is_empty());
            rules.extend(ways.map(|ways| json!({ "oneOf": each_alone(ways) })));
        }
        alternatives.push(json!({ "required": required, "allOf": rules }));
    }
    json!(alternatives)
}

/// For each key a rule that it is there.
pub(super) fn each_alone(keys: &[&'static Key]) -> Vec<Value> {
    let rules = keys.iter().map(|key| json!({ "required": [key.name] }));
    rules.collect()
}

/// Brings the values that a type can have into its limits and its desired value.
pub(super) fn restrict(properties: &mut Value, task_type: &TaskType) {
    let GoalShape::Scalar(least, most) = task_type.goal else {
        return;
    };
    let in_value = [&keys::DESIRED, &keys::MIN, &keys::MAX];
    restrict_in_unit(properties, in_value, least, most);
    if let Some(degrees) = task_type.degrees {
        let in_degrees = [&keys::ANGLE_DESIRED_DEG, &keys::MIN_DEG, &keys::MAX_DEG];
        let of_value = degrees.of_value;
        restrict_in_unit(properties, in_degrees, of_value(least), of_value(most));
    }
}

fn restrict_in_unit(properties: &mut Value, [desired, min, max]: [&Key; 3], least: f64, most: f64) {
    for key in [desired, max] {
        if least.is_finite() {
            properties[key.name]["minimum"] = json!(least);
        }
    }
    for key in [desired, min] {
        if most.is_finite() {
            properties[key.name]["maximum"] = json!(most);
        }
    }
}
