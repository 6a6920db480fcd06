//! Tasks that measure the distance of two shapes of the file.

use conik_sim::check;
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Mistake, Scenario, TaskKind, schema};

const GOOD: &str = r#"
[robot]
model = "ur5-paper"
q0_deg = [-48, -158, -108, -90, -85, 0]
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
[[obstacle]]
name = "post"
type = "capsule"
from_m = [0.6, 0.4, -0.5]
to_m = [0.6, 0.4, 0.5]
radius_m = 0.05
[[obstacle]]
name = "ball"
type = "sphere"
center_m = [0.5, 0.5, 0]
radius_m = 0.1
velocity_m_per_s = [0, -0.5, 0]
[[task]]
name = "away"
type = "shape_distance"
shapes = ["forearm", "post"]
min = 0.05
[[task]]
name = "at"
type = "shape_distance"
shapes = ["ball", "forearm"]
desired = 0.3
gain_per_s = 1
[[task]]
name = "low"
type = "shape_distance"
shapes = ["foot", "forearm"]
max = 0.4
gain_per_s = 1
"#;

fn mistakes(text: &str) -> Vec<Mistake> {
    match Scenario::from_toml(text) {
        Ok(_) => vec![],
        Err(errors) => errors.mistakes().to_vec(),
    }
}

#[test]
fn named_shapes_become_a_task_of_the_list() {
    let scenario = Scenario::from_toml(GOOD).expect("it is right");
    let experiment = Experiment::new(&scenario).expect("it is right");
    let stack = experiment.controller.stack();
    let names: Vec<&str> = stack.iter().map(|(_, level)| level.name()).collect();
    // Obstacles without a distance are no sets.
    assert_eq!(names, ["away", "at", "low"]);
    let high: Vec<bool> = stack
        .iter()
        .map(|(id, _)| stack.is_high_priority(id))
        .collect();
    assert_eq!(high, [true, false, false]);
    // Figures and reports are told the shapes, in place of their names.
    for task in scenario.all_tasks() {
        let TaskKind::Shapes(pair) = &task.kind else {
            panic!("{task:?}");
        };
        let (other_link, moves) = (pair.other_link.as_deref(), !task.motion.is_rest());
        let expected = match task.name.as_str() {
            "away" => ("link_3", None, false),
            "at" => ("link_3", None, true),
            _ => ("link_0", Some("link_3"), false),
        };
        assert_eq!((pair.link.as_str(), other_link, moves), expected);
    }
}

#[test]
fn value_is_that_of_the_set_which_keeps_the_same_shapes_apart() {
    let all_kept = GOOD.replace(
        "radius_m = 0.1\nvel",
        "radius_m = 0.1\ndistance_m = 0.01\nvel",
    );
    let scenario = Scenario::from_toml(&all_kept).expect("it is right");
    let mut experiment = Experiment::new(&scenario).expect("it is right");
    for t_s in [0.0, 0.3] {
        experiment.move_world(t_s).expect("sound");
        let q0 = experiment.q0;
        let stack = experiment.controller.stack();
        let [at, kept] = ["at", "forearm/ball"].map(|name| stack.find(name).expect("it is there"));
        let step = experiment.controller.step(&q0).expect("finite");
        assert_eq!(step.value(at), step.value(kept));
    }
}

#[test]
fn desired_distance_to_a_shape_that_moves_is_kept() {
    let scenario = GOOD.replace("-0.5, 0]", "-0.05, 0]");
    let scenario = Scenario::from_toml(&scenario).expect("it is right");
    let mut experiment = Experiment::new(&scenario).expect("it is right");
    let task = experiment.controller.stack().find("at").expect("there");
    let (mut q, mut error) = (experiment.q0, f64::NAN);
    for tick in 0..1250 {
        let t_s = f64::from(tick) / 125.0;
        experiment.move_world(t_s).expect("sound");
        let step = experiment.controller.step(&q).expect("finite");
        (q, error) = (step.q_ref, step.value(task)[0] - 0.3);
    }
    assert!(error.abs() < 1e-3, "{error}");
}

#[test]
fn scenario_reads_back_as_it_was_and_conforms_to_the_schema() {
    let scenario = Scenario::from_toml(GOOD).expect("it is right");
    let written = scenario.to_toml();
    assert_eq!(Scenario::from_toml(&written).expect("right"), scenario);
    let json = serde_json::to_string(&scenario).expect("it is plain data");
    let back: Scenario = serde_json::from_str(&json).expect("it was written so");
    assert_eq!(back, scenario);
    let schema = jsonschema::draft7::new(&schema()).expect("the schema is a schema");
    let valid = |text: &str| schema.is_valid(&toml::from_str(text).expect("valid TOML"));
    assert!(valid(GOOD) && valid(&written));
    for bad in [
        "[\"forearm\"]",
        "[\"a\", \"a\"]",
        "[\"a\", \"b\", \"c\"]",
        "\"a\"",
        "[1, 2]",
    ] {
        assert!(
            !valid(&GOOD.replacen("[\"forearm\", \"post\"]", bad, 1)),
            "{bad}"
        );
    }
}

#[test]
fn each_mistake_is_named_placed_and_explained() {
    assert_eq!(mistakes(GOOD), []);
    let task = "task[1] \"away\".shapes";
    for (names, key, says) in [
        (
            "[\"forarm\", \"post\"]",
            format!("{task}[1]"),
            "did you mean \"forearm\"?",
        ),
        (
            "[\"forearm\", \"pots\"]",
            format!("{task}[2]"),
            "did you mean \"post\"?",
        ),
        (
            "[\"forearm\", \"forearm\"]",
            task.to_owned(),
            "no distance to itself",
        ),
        (
            "[\"ball\", \"post\"]",
            task.to_owned(),
            "no joint of the robot moves",
        ),
        (
            "[\"foot\", \"post\"]",
            task.to_owned(),
            "no joint of the robot moves",
        ),
        (
            "[\"forearm\"]",
            task.to_owned(),
            "expected two names, found 1",
        ),
        (
            "[\"forearm\", 1]",
            format!("{task}[2]"),
            "expected text in quotes",
        ),
        (
            "\"forearm\"",
            task.to_owned(),
            "expected a list of two names",
        ),
    ] {
        let found = mistakes(&GOOD.replacen("[\"forearm\", \"post\"]", names, 1));
        let shown: Vec<String> = found.iter().map(ToString::to_string).collect();
        let [mistake] = &found[..] else {
            panic!("{names}: {shown:?}");
        };
        assert_eq!((mistake.line, &mistake.key), (40, &key), "{shown:?}");
        assert!(shown[0].contains(says), "{shown:?} does not say {says:?}");
    }
    let found = mistakes(&GOOD.replacen("shapes = [\"forearm\", \"post\"]\n", "", 1));
    assert_eq!((found.len(), found[0].key.as_str()), (1, task));
    let both = GOOD.replacen("desired = 0.3", "desired = 0.3\ndesired_per_s = 0.1", 1);
    let found = mistakes(&both);
    let shown: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert!(
        shown.len() == 1 && shown[0].contains("one of them must rest"),
        "{shown:?}"
    );
    assert_eq!(
        mistakes(&both.replacen("velocity_m_per_s = [0, -0.5, 0]\n", "", 1)),
        []
    );
    // Planes have no end; the file has nothing else against them until a task measures them.
    let planes = GOOD
        .replacen(
            "type = \"capsule\"\nfrom_m = [0, 0, 0.02]\nto_m = [0.392, 0, 0.02]\nradius_m = 0.05",
            "type = \"half_space\"\npoint_m = [0, 0, 0]\nnormal = [0, 0, 1]",
            1,
        )
        .replacen(
            "type = \"capsule\"\nfrom_m = [0.6, 0.4, -0.5]\nto_m = [0.6, 0.4, 0.5]\nradius_m = 0.05",
            "type = \"half_space\"\npoint_m = [0, 0, 0]\nnormal = [0, 0, 1]",
            1,
        );
    let shown: Vec<String> = mistakes(&planes).iter().map(ToString::to_string).collect();
    assert_eq!(shown.len(), 1, "{shown:?}");
    assert!(shown[0].contains("half-spaces have no end"), "{shown:?}");
}

#[test]
fn neighbouring_links_may_be_measured() {
    let text = GOOD.replacen("[\"forearm\", \"post\"]", "[\"upper_arm\", \"forearm\"]", 1);
    assert_eq!(mistakes(&text), []);
}

#[test]
fn obstacle_that_does_nothing_is_told() {
    let doubts = |text: &str| {
        let scenario = Scenario::from_toml(text).expect("it is right");
        let experiment = Experiment::new(&scenario).expect("it is right");
        let doubts = check::find(&scenario, &experiment).doubts;
        let idle = doubts
            .into_iter()
            .filter(|it| it.contains("nothing keeps away"));
        idle.collect::<Vec<_>>()
    };
    assert_eq!(doubts(GOOD), Vec::<String>::new());
    let unnamed = GOOD.replace("[\"forearm\", \"post\"]", "[\"forearm\", \"ball\"]");
    let found = doubts(&unnamed);
    assert!(found.len() == 1 && found[0].contains("`post`"), "{found:?}");
}
