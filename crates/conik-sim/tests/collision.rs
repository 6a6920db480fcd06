//! Shapes on links and in the world become sets, one for every two that can meet.

use conik::Kinematics;
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Geometry, GoalConfig, Mistake, Scenario, TaskKind, schema};

const GOOD: &str = r#"title = "shapes"
[robot]
model = "ur5-paper"
q0_deg = [-48, -158, -108, -90, -85, 0]
position_limits_deg = [[-90, 90], [], [], [], [], []]
[[shape]]
name = "foot"
link = "link_0"
type = "sphere"
center_m = [0, 0, 0]
radius_m = 0.1
[[shape]]
name = "upper_arm"
link = "link_2"
type = "capsule"
from_m = [0, 0, 0.13]
to_m = [0.425, 0, 0.13]
radius_m = 0.06
[[shape]]
name = "forearm"
link = "link_3"
type = "capsule"
from_m = [0, 0, 0.02]
to_m = [0.392, 0, 0.02]
radius_m = 0.05
[[shape]]
link = "link_6"
type = "box"
center_m = [0, 0, 0.02]
size_m = [0.1, 0.1, 0.05]
rotation_rad = [0, 0, 0.3]
[[obstacle]]
name = "floor"
type = "half_space"
point_m = [0, 0, -0.6]
normal = [0, 0, 2]
distance_m = 0.02
[[obstacle]]
name = "ball"
type = "sphere"
center_m = [0.5, 0.5, 0]
radius_m = 0.1
distance_m = 0.05
velocity_m_per_s = [0, -0.5, 0]
moves_until_s = 1
[self_collision]
distance_m = 0.01
exclude = [["foot", "upper_arm"]]
[[task]]
name = "position"
type = "position"
target_m = [0.4, 0, 0]
gain_per_s = 1
"#;

fn mistakes(text: &str) -> Vec<Mistake> {
    match Scenario::from_toml(text) {
        Ok(_) => vec![],
        Err(errors) => errors.mistakes().to_vec(),
    }
}

#[test]
fn every_two_shapes_that_can_meet_are_a_set_between_limits_and_tasks() {
    let scenario = Scenario::from_toml(GOOD).expect("it is right");
    let tasks = scenario.all_tasks();
    let names: Vec<&str> = tasks.iter().map(|task| task.name.as_str()).collect();
    let expected = [
        "limit/shoulder_pan_joint",
        // The foot stands still, and meets no obstacle.
        "upper_arm/floor",
        "forearm/floor",
        "link_6/floor",
        "upper_arm/ball",
        "forearm/ball",
        "link_6/ball",
        // Upper arm and forearm are neighbours; foot and upper arm are excluded.
        "foot/forearm",
        "foot/link_6",
        "upper_arm/link_6",
        "forearm/link_6",
        "position",
    ];
    assert_eq!(names, expected);
    let experiment = Experiment::new(&scenario).expect("it is right");
    let stack = experiment.controller.stack();
    let in_stack: Vec<&str> = stack.iter().map(|(_, level)| level.name()).collect();
    assert_eq!(in_stack, expected);
    for ((id, level), task) in stack.iter().zip(&tasks) {
        let TaskKind::Shapes(pair) = &task.kind else {
            continue;
        };
        assert!(stack.is_high_priority(id), "{}", task.name);
        let least = if pair.other_link.is_some() {
            0.01
        } else if task.name.ends_with("floor") {
            0.02
        } else {
            0.05
        };
        assert_eq!(level.interval().expect("a set").min, least, "{}", task.name);
        assert!(matches!(task.goal, GoalConfig::Set { min: Some(min), .. } if min == least));
    }
}

#[test]
fn scenario_with_shapes_reads_back_as_it_was_and_conforms_to_the_schema() {
    let scenario = Scenario::from_toml(GOOD).expect("it is right");
    assert_eq!(scenario.check(), Ok(()));
    let written = scenario.to_toml();
    assert_eq!(
        Scenario::from_toml(&written).expect("it is right"),
        scenario
    );
    assert!(matches!(
        scenario.collision.obstacles[0].geometry,
        Geometry::HalfSpace {
            normal: [0.0, 0.0, 1.0],
            ..
        }
    ));
    let json = serde_json::to_string(&scenario).expect("it is plain data");
    let back: Scenario = serde_json::from_str(&json).expect("it was written so");
    assert_eq!(back, scenario);
    let schema = jsonschema::draft7::new(&schema()).expect("the schema is a schema");
    for text in [GOOD, &written] {
        let value: serde_json::Value = toml::from_str(text).expect("valid TOML");
        assert!(schema.is_valid(&value));
    }
    for (good, bad, ..) in CASES.iter().filter(|case| case.4) {
        let value: serde_json::Value =
            toml::from_str(&GOOD.replacen(good, bad, 1)).expect("valid TOML");
        assert!(!schema.is_valid(&value), "{bad}");
    }
}

#[test]
fn obstacle_moves_as_the_scenario_says() {
    let scenario = Scenario::from_toml(GOOD).expect("it is right");
    let mut experiment = Experiment::new(&scenario).expect("it is right");
    let mut kinematics = Kinematics::new(&experiment.robot);
    kinematics.update(&experiment.q0);
    let id = experiment
        .controller
        .stack()
        .find("forearm/ball")
        .expect("it is there");
    let mut distance_at = |t_s: f64| {
        experiment.move_world(t_s).expect("finite");
        let mut value = [0.0];
        let task = experiment.controller.stack()[id].task();
        task.value(&kinematics, &mut value);
        value[0]
    };
    let moved_in_file = |y: &str| {
        let text = GOOD
            .replace("[0.5, 0.5, 0]", y)
            .replace("velocity_m_per_s = [0, -0.5, 0]\nmoves_until_s = 1\n", "");
        let scenario = Scenario::from_toml(&text).expect("it is right");
        let experiment = Experiment::new(&scenario).expect("it is right");
        let stack = experiment.controller.stack();
        let mut value = [0.0];
        let id = stack.find("forearm/ball").expect("it is there");
        stack[id].task().value(&kinematics, &mut value);
        value[0]
    };
    for (t_s, place) in [
        (0.0, "[0.5, 0.5, 0]"),
        (0.5, "[0.5, 0.25, 0]"),
        (3.0, "[0.5, 0, 0]"),
    ] {
        let (found, expected) = (distance_at(t_s), moved_in_file(place));
        assert!(
            (found - expected).abs() < 1e-15,
            "at {t_s} s: {found}, not {expected}"
        );
    }
}

/// What stands in `GOOD`, what stands there instead, the line and the key reported, whether the schema
/// can tell, and words of the message.
type Case = (
    &'static str,
    &'static str,
    usize,
    &'static str,
    bool,
    &'static str,
);

const CASES: &[Case] = &[
    (
        "link = \"link_3\"",
        "link = \"link_9\"",
        21,
        "shape[3].link",
        false,
        "link_3",
    ),
    (
        "type = \"sphere\"",
        "type = \"ball\"",
        9,
        "shape[1].type",
        true,
        "capsule",
    ),
    (
        "radius_m = 0.06",
        "radius_m = -1",
        18,
        "shape[2].radius_m",
        true,
        "from 0",
    ),
    (
        "radius_m = 0.06",
        "radius_m = 0.06\nsize_m = [1, 1, 1]",
        19,
        "shape[2].size_m",
        true,
        "unknown key",
    ),
    (
        "size_m = [0.1, 0.1, 0.05]\n",
        "",
        26,
        "shape[4].size_m",
        true,
        "missing",
    ),
    (
        "name = \"forearm\"",
        "name = \"foot\"",
        20,
        "shape[3].name",
        false,
        "already",
    ),
    (
        "name = \"ball\"",
        "name = \"floor\"",
        39,
        "obstacle[2].name",
        false,
        "already",
    ),
    (
        "normal = [0, 0, 2]",
        "normal = [0, 0, 0]",
        36,
        "obstacle[1].normal",
        false,
        "zero",
    ),
    (
        "distance_m = 0.05",
        "distance_m = -0.05",
        43,
        "obstacle[2].distance_m",
        true,
        "out of range",
    ),
    (
        "[self_collision]\ndistance_m = 0.01",
        "[self_collision]",
        46,
        "self_collision.distance_m",
        true,
        "missing",
    ),
    (
        "velocity_m_per_s = [0, -0.5, 0]\n",
        "",
        44,
        "obstacle[2].moves_until_s",
        true,
        "remove it",
    ),
    (
        "\"upper_arm\"]]",
        "\"uper_arm\"]]",
        48,
        "self_collision.exclude[1][2]",
        false,
        "upper_arm",
    ),
    (
        "name = \"position\"",
        "name = \"forearm/floor\"",
        50,
        "task[1] \"forearm/floor\".name",
        false,
        "keeps those shapes apart",
    ),
];

#[test]
fn each_mistake_is_named_placed_and_explained() {
    assert_eq!(mistakes(GOOD), []);
    for &(good, bad, line, key, _, says) in CASES {
        assert!(GOOD.contains(good), "{good}");
        let found = mistakes(&GOOD.replacen(good, bad, 1));
        let shown: Vec<String> = found.iter().map(ToString::to_string).collect();
        let [mistake] = &found[..] else {
            panic!("{bad}: {shown:?}");
        };
        assert_eq!(
            (mistake.line, mistake.key.as_str()),
            (line, key),
            "{shown:?}"
        );
        assert!(shown[0].contains(says), "{shown:?} does not say {says:?}");
    }
}

#[test]
fn shapes_without_a_distance_and_obstacles_that_nothing_meets_are_refused() {
    let forearm =
        "type = \"capsule\"\nfrom_m = [0, 0, 0.02]\nto_m = [0.392, 0, 0.02]\nradius_m = 0.05\n";
    let plane = "type = \"half_space\"\npoint_m = [0, 0, 0]\nnormal = [0, 0, 1]\n";
    let shown =
        |text: &str| -> Vec<String> { mistakes(text).iter().map(ToString::to_string).collect() };
    let found = shown(&GOOD.replacen(forearm, plane, 1));
    assert!(
        found.len() == 1 && found[0].contains("half-spaces have no end"),
        "{found:?}"
    );
    let (start, end) = (
        GOOD.find("[[shape]]").unwrap(),
        GOOD.find("[[obstacle]]").unwrap(),
    );
    let without = format!("{}{}", &GOOD[..start], &GOOD[end..])
        .replace("exclude = [[\"foot\", \"upper_arm\"]]\n", "");
    let found = shown(&without);
    assert!(
        found.len() == 1 && found[0].contains("[[shape]]"),
        "{found:?}"
    );
}

#[test]
fn thousands_of_shapes_are_one_mistake() {
    let ball = |i: usize| {
        format!(
            "[[obstacle]]\nname = \"b{i}\"\ntype = \"sphere\"\ncenter_m = [0, 0, 1]\nradius_m = 1\n\
             distance_m = 0\n"
        )
    };
    let many: String = (0..10_000).map(ball).collect();
    let found = mistakes(&GOOD.replacen("[[task]]", &format!("{many}[[task]]"), 1));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].what, "10002 are too many");
    assert_eq!(found[0].key, "obstacle");
    assert!(found[0].help.contains("at most 1000"), "{:?}", found[0]);
}
