//! The paper's examples under the default rules: no sample outside a set, few changes of mode.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::process::{done, empty_folder, paper};
use super::run_folder::{Rows, summary};

const DEFAULTS: &str = "--mode-rule cone --border land --recursion siciliano-slotine";

/// Runs one of the paper's examples under the default rules; what it left in its folder.
fn run(folder: &Path, example: &str, robot: &str) -> (Rows, Value) {
    let out = example.to_owned() + robot.trim_start_matches('-');
    let line = format!(
        "run {} {DEFAULTS} {robot} --quiet --out {out}",
        paper(example).display()
    );
    assert_eq!(done(folder, &line), "");
    (Rows::of(&folder.join(&out)), summary(&folder.join(&out)))
}

/// How far a value is outside the set of its task.
type Outside = fn(f64) -> f64;

/// The sets of high priority of an example.
fn sets(example: &str) -> Vec<(&'static str, Outside)> {
    let mut sets: Vec<(&str, Outside)> = vec![
        ("obstacle_a", |value| 0.18 - value),
        ("obstacle_b", |value| 0.15 - value),
    ];
    if example == "example2" {
        sets.push(("view", |value| value - 0.2622));
    }
    sets
}

/// No sample outside a set after the first one inside it, to the last bit; none worse before.
fn assert_kept(log: &Rows, summary: &Value, example: &str) {
    for (name, outside) in sets(example) {
        let values = log.numbers(name);
        let first = values.iter().position(|value| outside(*value) <= 0.0);
        let first = first.unwrap_or_else(|| panic!("{name} is never inside"));
        for (k, value) in values.iter().enumerate().skip(first) {
            let outside = outside(*value);
            assert!(outside <= 0.0, "{name} is {outside} outside in row {k}");
        }
        for pair in values[..first].windows(2) {
            assert!(
                outside(pair[1]) <= outside(pair[0]) + 2e-7,
                "{name} got worse"
            );
        }
    }
    for property in ["inside_stays", "entered_stays"] {
        assert_eq!(summary["properties"][property]["worst"], 0.0, "{property}");
    }
    assert_eq!(summary["properties"]["outside_never_worse"]["holds"], true);
}

#[test]
fn examples_of_the_paper_keep_every_sample_inside_with_few_changes_of_mode() {
    let folder = empty_folder("default rules");
    for (example, changes) in [("example1", 4), ("example2", 5), ("example3", 5)] {
        let (log, summary) = run(&folder, example, "--robot=ideal");
        assert_eq!(log.rows.len(), 7501);
        assert_kept(&log, &summary, example);
        let modes = summary["modes"].as_array().unwrap();
        assert_eq!(modes.len() - 1, changes, "{example}: {modes:?}");
        let reached = summary["waypoints_reached_s"].as_array().unwrap();
        assert!(reached.iter().all(Value::is_f64), "{example}: {reached:?}");
        assert_eq!(summary["no_mode_ticks"], 0);
        assert_eq!(summary["landing"]["stood_still_ticks"], 0);
        assert!(summary["step_work_max"]["landing_trials"].as_u64() <= Some(3));
        assert!(summary["step_work_max"]["pivots"].as_u64() <= Some(8));
    }
}

#[test]
fn emulated_arm_is_led_along_the_same_references() {
    let folder = empty_folder("default rules emulated");
    for example in ["example1", "example2", "example3"] {
        let (ideal, _) = run(&folder, example, "--robot=ideal");
        let (emulated, summary) = run(&folder, example, "--fast");
        assert_eq!(emulated.rows.len(), 7501);
        assert_kept(&emulated, &summary, example);
        for (k, (alone, led)) in ideal.rows.iter().zip(&emulated.rows).enumerate() {
            let (why, alone) = alone.split_last().unwrap();
            assert_eq!(*alone, led[..alone.len()], "{example}, row {k}");
            assert_eq!(Some(why), led.last(), "{example}, row {k}");
        }
        assert_eq!(summary["deadline_misses"], 0);
        let tracking = summary["tracking"]["max_rad"].as_array().unwrap();
        assert!(
            tracking.iter().all(|max| max.as_f64() < Some(0.1)),
            "{tracking:?}"
        );
    }
}

#[test]
fn scenario_that_names_no_rules_is_run_under_the_default_rules() {
    let folder = empty_folder("rules left out");
    let text = fs::read_to_string(paper("example2")).unwrap();
    let silent: Vec<&str> = text
        .lines()
        .filter(|line| {
            !["mode_rule", "border", "recursion"]
                .iter()
                .any(|key| line.starts_with(key))
        })
        .collect();
    assert_eq!(silent.len() + 3, text.lines().count());
    fs::write(folder.join("silent.toml"), silent.join("\n")).unwrap();
    done(
        &folder,
        "run silent.toml --robot ideal --quiet --out silent",
    );
    let (named, _) = run(&folder, "example2", "--robot=ideal");
    assert_eq!(Rows::of(&folder.join("silent")).rows, named.rows);
}
