//! Runs of which the scenario changes while they go on.

use std::sync::atomic::AtomicBool;

use conik_sim::arm::{ArmError, IdealArm};
use conik_sim::experiment::Experiment;
use conik_sim::live::{Change, Helm, Stretch};
use conik_sim::record::Record;
use conik_sim::run::{self, Ended};
use conik_sim::scenario::Scenario;
use conik_sim::summary::Outcome;
use serde_json::json;

const EXAMPLE_2: &str = include_str!("../../../scenarios/paper/example2.toml");
const SHELF: &str = include_str!("../../../scenarios/gallery/shelf.toml");

/// Example 2 under the default settings, for so long.
fn example2(duration_s: f64) -> Scenario {
    let mut scenario = Scenario::from_toml(EXAMPLE_2).unwrap();
    scenario.control = conik_sim::scenario::Control {
        duration_s,
        ..Default::default()
    };
    scenario
}

fn change(value: serde_json::Value) -> Change {
    serde_json::from_value(value).unwrap()
}

/// A run in which at each of these ticks the scenario is changed so.
fn run_with(first: &Scenario, changes: &[(u64, Vec<Change>)]) -> (Ended, Vec<Record>) {
    let helm = Helm::of_outside();
    let mut present = first.clone();
    let mut records = Vec::new();
    let mut arm = IdealArm::at(Experiment::new(first).unwrap().q0);
    let mut revision = 0;
    let mut sink = |record: Record| {
        for (tick, changes) in changes {
            // What is handed over after a tick is in force from the next one on.
            if record.tick + 1 == *tick {
                let (changed, speeds) = present.changed(changes, record.t_s).unwrap();
                let next = Stretch::next(first, &changed, &speeds).unwrap();
                present = changed;
                revision += 1;
                helm.hand_over(Box::new(next), revision);
            }
        }
        records.push(record);
        Ok::<(), ArmError>(())
    };
    helm.set_speed(1e6);
    let ended = run::run_steered(
        Stretch::first(Experiment::changeable(first).unwrap()),
        &mut arm,
        &mut sink,
        &AtomicBool::new(false),
        Some(&helm),
    );
    assert_eq!(ended.outcome, Outcome::Completed);
    (ended, records)
}

fn kept(ended: &Ended) {
    let stack = ended.experiment.controller.stack();
    let properties = ended.monitor.properties(stack);
    for property in [
        properties.inside_stays,
        properties.outside_never_worse,
        properties.entered_stays,
    ] {
        assert!(property.worst <= 1e-9, "{property:?}");
    }
    assert_eq!(ended.unannounced.ticks, 0, "{:?}", ended.unannounced);
}

#[test]
fn change_that_changes_nothing_leaves_the_run_as_it_is() {
    let scenario = example2(8.0);
    let (_, plain) = run_with(&scenario, &[]);
    let same = change(json!({"task": "view", "key": "max", "value": 0.2622}));
    let (ended, records) = run_with(&scenario, &[(300, vec![same.clone()]), (500, vec![same])]);
    kept(&ended);
    assert_eq!(records[301].revision, 1);
    for (record, plain) in records.iter().zip(&plain) {
        assert_eq!(record.active, plain.active, "at {}", record.t_s);
        for (q, plain) in record.q.iter().zip(plain.q.iter()) {
            assert!((q - plain).abs() < 1e-9, "at {}", record.t_s);
        }
    }
}

#[test]
fn bound_that_is_moved_onto_the_arm_glides_and_pushes_it_away() {
    let scenario = example2(20.0);
    // The tool passes the first obstacle at 0.18 m: that becomes 0.25 m meanwhile.
    let wider = change(json!({"task": "obstacle_a", "key": "min", "value": 0.25, "speed": 0.02}));
    let (ended, records) = run_with(&scenario, &[(500, vec![wider])]);
    kept(&ended);
    let value = |record: &Record| record.task_values[0];
    assert!(value(&records[500]) < 0.2, "{}", value(&records[500]));
    assert!(records.iter().any(|record| !record.gliding.is_empty()));
    assert!(records.last().unwrap().gliding.is_empty());
    for record in records.iter().skip(1000) {
        assert!(value(record) >= 0.25 - 1e-12, "at {}", record.t_s);
    }
}

#[test]
fn obstacle_that_is_pushed_through_the_tool_is_evaded() {
    let mut scenario = example2(12.0);
    scenario.control.duration_s = 12.0;
    let (_, plain) = run_with(&scenario, &[]);
    let tool = plain[400].tool.to_array();
    let beyond = [tool[0], tool[1], tool[2] + 0.05];
    let moved =
        change(json!({"task": "obstacle_b", "key": "point_m", "value": beyond, "speed": 0.1}));
    let (ended, records) = run_with(&scenario, &[(300, vec![moved])]);
    kept(&ended);
    let last = records.last().unwrap();
    let away = last.tool - conik::Vec3::from(beyond);
    assert!(away.norm() >= 0.15 - 1e-12, "{}", away.norm());
    // What is told of on the way is where it was.
    let gliding = records.iter().flat_map(|record| &record.gliding);
    let furthest = gliding.map(|it| it.away.point_m.norm());
    assert!(furthest.fold(0.0, f64::max) > 0.1);
}

#[test]
fn direction_of_view_turns_and_takes_the_arm_along() {
    let mut scenario = example2(15.0);
    let recovering = change(json!({"task": "view", "key": "recovery_per_s", "value": 0.3}));
    scenario = scenario.changed(&[recovering], 0.0).unwrap().0;
    let down = change(json!({"task": "view", "key": "direction", "value": [0.8, 0.0, -0.6]}));
    let (ended, records) = run_with(&scenario, &[(900, vec![down])]);
    assert!(records[899].task_values[2] <= 0.2622);
    let stack = ended.experiment.controller.stack();
    let view = stack.find("view").unwrap();
    assert!(ended.experiment.controller.last_step().value(view)[0] <= 0.2622);
    assert_eq!(ended.unannounced.ticks, 0);
    let turned = records.iter().flat_map(|record| &record.gliding);
    let most = turned.map(|it| it.away.turn_rad.norm());
    let angle = 0.6f64.asin();
    assert!((most.fold(0.0, f64::max) - angle).abs() < 1e-9);
}

#[test]
fn other_order_and_rule_keep_the_numbers_of_the_tasks() {
    let scenario = example2(50.0);
    let changes = vec![
        change(json!({"order": ["view", "obstacle_b", "obstacle_a", "position"]})),
        change(json!({"control": "recursion", "value": "chiaverini"})),
        change(json!({"control": "mode_rule", "value": "border"})),
        change(json!({"task": "position", "key": "gain_per_s", "value": 0.5})),
    ];
    let (ended, records) = run_with(&scenario, &[(250, changes)]);
    kept(&ended);
    let names: Vec<_> = ended.experiment.controller.stack().iter().collect();
    assert_eq!(names[0].1.name(), "view");
    let before = &records[249].task_values;
    let after = &records[250].task_values;
    for (column, (before, after)) in before.iter().zip(after).enumerate() {
        assert!((before - after).abs() < 0.01, "column {column} goes on");
    }
    for record in &records {
        for task in record.active.iter() {
            let value = record.task_values[task.index()];
            let bound = [0.18, 0.15, 0.2622][task.index()];
            // The view begins outside, and is held wherever it is.
            let is_at = (value - bound).abs() < 1e-3 || (task.index() == 2 && value > bound);
            assert!(is_at, "{task:?} at {}: {value}", record.t_s);
        }
    }
    let waypoints = records.iter().filter_map(|record| record.reached).count();
    assert_eq!(waypoints, 2);
}

#[test]
fn waypoint_in_use_is_moved_and_the_next_is_still_the_next() {
    let scenario = example2(30.0);
    let moved = change(json!({
        "task": "position", "key": "waypoints_m",
        "value": [[0.45, -0.10, -0.20], [0.320, 0.370, -0.250]],
    }));
    let (_, records) = run_with(&scenario, &[(200, vec![moved])]);
    let reached: Vec<_> = records
        .iter()
        .filter(|record| record.reached.is_some())
        .collect();
    let at = reached[0].tool - conik::Vec3::new(0.45, -0.10, -0.20);
    assert_eq!(reached[0].reached, Some(0));
    assert!(at.norm() < 0.02, "{}", at.norm());
    assert_eq!(records[200].waypoint, 0);
}

#[test]
fn obstacle_of_many_pairs_glides_for_all_of_them() {
    let mut scenario = Scenario::from_toml(SHELF).unwrap();
    scenario.control.duration_s = 4.0;
    let post = scenario
        .collision
        .obstacles
        .iter()
        .find(|it| it.name == "post")
        .unwrap();
    let json = serde_json::to_value(post).unwrap();
    let keys: Vec<&str> = ["from_m", "to_m", "center_m"]
        .into_iter()
        .filter(|key| json.get(key).is_some())
        .collect();
    let changes = keys.iter().map(|key| {
        let mut place = json[*key].as_array().unwrap().clone();
        place[0] = json!(place[0].as_f64().unwrap() + 0.02);
        change(json!({"obstacle": "post", "key": key, "value": place, "speed": 0.05}))
    });
    let (ended, records) = run_with(&scenario, &[(100, changes.collect())]);
    kept(&ended);
    let most = records.iter().map(|record| record.gliding.len()).max();
    let stack = ended.experiment.controller.stack();
    let pairs = stack.iter().filter(|(_, it)| it.name().ends_with("/post"));
    assert_eq!(most, Some(pairs.count()));
}

#[test]
fn changes_that_make_no_sense_say_why() {
    let scenario = example2(5.0);
    let refused = |value| {
        let error = scenario.changed(&[change(value)], 1.0).unwrap_err();
        error.to_string()
    };
    for (value, says) in [
        (
            json!({"task": "vew", "key": "max", "value": 1}),
            "there are: obstacle_a",
        ),
        (
            json!({"task": "view", "key": "maxx", "value": 1}),
            "has no key `maxx`",
        ),
        (
            json!({"task": "view", "key": "max", "value": "wide"}),
            "cannot be \"wide\"",
        ),
        (
            json!({"task": "view", "key": "type", "value": "pose"}),
            "cannot be changed",
        ),
        (json!({"task": "view", "key": "max", "value": null}), "max"),
        (
            json!({"task": "position", "key": "gain_per_s", "value": -1}),
            "out of range",
        ),
        (
            json!({"task": "limit/q1", "key": "max", "value": 1}),
            "limits",
        ),
        (json!({"order": ["view"]}), "each task once"),
        (json!({"control": "rate_hz", "value": 500}), "mode_rule"),
        (
            json!({"control": "border", "value": "fly"}),
            "cannot be \"fly\"",
        ),
        (
            json!({"task": "view", "key": "max", "value": 0.3, "speed": 0}),
            "above 0",
        ),
    ] {
        let said = refused(value.clone());
        assert!(said.contains(says), "{value}: {said}");
    }
}

#[test]
fn what_moves_is_put_where_it_is_wanted_now() {
    let text = include_str!("../../../scenarios/gallery/crossing.toml");
    let scenario = Scenario::from_toml(text).unwrap();
    let task = scenario
        .tasks
        .iter()
        .find(|task| task.motion.velocity_m_per_s.is_some())
        .unwrap();
    let place = [0.1, 0.2, 0.3];
    let put = change(json!({"task": task.name, "key": "point_m", "value": place}));
    let (changed, _) = scenario.changed(&[put], 1.5).unwrap();
    let json = serde_json::to_value(&changed).unwrap();
    let moved = json["task"]
        .as_array()
        .unwrap()
        .iter()
        .find(|it| it["name"] == *task.name)
        .unwrap();
    let start: Vec<f64> = serde_json::from_value(moved["point_m"].clone()).unwrap();
    let there = task.motion.point_at(start.try_into().unwrap(), 1.5);
    for axis in 0..3 {
        assert!((there[axis] - place[axis]).abs() < 1e-12);
    }
}
