//! The JSON Schema of the scenario file agrees with the reader, and the committed copy with both.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use conik_sim::scenario::{Scenario, schema, template};
use serde_json::Value;

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn as_json(toml: &str) -> Value {
    toml::from_str(toml).expect("valid TOML")
}

fn is_valid(toml: &str) -> bool {
    let validator = jsonschema::draft7::new(&schema()).expect("the schema is a schema");
    validator.is_valid(&as_json(toml))
}

#[test]
fn the_committed_schema_is_that_of_this_version() {
    let committed = fs::read_to_string(scenarios().join("schema.json")).expect("it is there");
    let committed: Value = serde_json::from_str(&committed).expect("it is JSON");
    assert!(
        committed == schema(),
        "scenarios/schema.json is stale; write it again: conik schema > scenarios/schema.json"
    );
}

#[test]
fn the_schema_is_a_schema() {
    assert!(jsonschema::draft7::meta::is_valid(&schema()));
}

#[test]
fn examples_and_template_conform_to_the_schema() {
    for number in 1..=3 {
        let path = scenarios().join(format!("paper/example{number}.toml"));
        let text = fs::read_to_string(&path).expect("the example is there");
        assert!(is_valid(&text), "{}", path.display());
    }
    assert!(is_valid(template()));
}

const GOOD: &str = r#"
[robot]
model = "ur5-paper"
q0_rad = [0, 0.5, 1, 0, 0, 0]
position_limits_deg = [[-90, 90], [], [], [], [], []]
speed_limits_rad_per_s = 1
acceleration_limits_deg_per_s2 = [1, 2, 3, 4, 5, 6]
[control]
rate_hz = 125
exclusive = [["a", "b"]]
[[task]]
name = "a"
type = "distance"
point_m = [1, 2, 3]
velocity_m_per_s = [0, 0, 0.1]
moves_until_s = 3
min = 0.1
recovery_per_s = 0.1
[[task]]
name = "b"
type = "field_of_view"
direction = [1, 0, 0]
max = 0.2
[[task]]
name = "c"
type = "joint"
joint = "elbow_joint"
max = 1
[[task]]
name = "p"
type = "position"
target_m = [1, 2, 3]
gain_per_s = 1
[[task]]
name = "cell"
type = "workspace"
min_m = [0, 0, 0]
max_m = [1, 1, 1]
gain_per_s = 1
[[task]]
name = "grasp"
type = "pose"
target_m = [0, 0, 1]
desired_rpy_deg = [0, 0, 9]
gain_per_s = 1
[[task]]
name = "z"
type = "coordinate"
axis = "z"
desired = 1
gain_per_s = 2
damping = 0.1
[[task]]
name = "wrist"
type = "joint"
joint = 6
min = 1
gain_per_s = 3
damping = "smallest"
"#;

const PAIRS: &str = "position_limits_deg = [[-90, 90], [], [], [], [], []]";

/// What stands in the good file, and what makes it bad in its place.
const MISTAKES: &[(&str, &str)] = &[
    ("[robot]", "titel = 1\n[robot]"),
    ("[robot]", "title = 1\n[robot]"),
    ("model = \"ur5-paper\"", "model = \"ur6\""),
    ("model = \"ur5-paper\"", ""),
    ("q0_rad = [0, 0.5, 1, 0, 0, 0]", ""),
    ("q0_rad = [0, 0.5, 1, 0, 0, 0]", "q0_rad = [0]"),
    (
        "q0_rad = [0, 0.5, 1, 0, 0, 0]",
        "q0_rad = [0, 0.5, 1, 0, 0, 2000]",
    ),
    (
        "q0_rad = [0, 0.5, 1, 0, 0, 0]",
        "q0_rad = [0, 0.5, 1, 0, 0, 0]\nq0_deg = [0, 0, 0, 0, 0, 0]",
    ),
    (PAIRS, "position_limits_deg = [[0, 1]]"),
    (PAIRS, "position_limits_rad = [[0], [], [], [], [], []]"),
    (PAIRS, "position_limits_rad = [[], [], [], [], [], 1]"),
    ("speed_limits_rad_per_s = 1", "speed_limits_rad_per_s = 0"),
    ("speed_limits_rad_per_s = 1", "speed_limits_rad_per_s = [1]"),
    ("[control]", "acceleration_limits_rad_per_s2 = 1\n[control]"),
    (
        "velocity_m_per_s = [0, 0, 0.1]",
        "velocity_m_per_s = [1, 2]",
    ),
    ("velocity_m_per_s = [0, 0, 0.1]", ""),
    ("min = 0.1\n", "min = 0.1\ndesired_per_s = 1\n"),
    (
        "direction = [1, 0, 0]",
        "direction = [1, 0, 0]\nangular_velocity_deg_per_s = [0, 0, 1]\nangular_velocity_rad_per_s = [0, 0, 1]",
    ),
    (
        "direction = [1, 0, 0]",
        "direction = [1, 0, 0]\nmoves_until_s = 1",
    ),
    (
        "target_m = [1, 2, 3]",
        "waypoints_m = [[1, 2, 3]]\nacceptance_m = 1\nvelocity_m_per_s = [1, 2, 3]",
    ),
    ("recovery_per_s = 0.1", "recovery_per_s = 0"),
    ("gain_per_s = 2", "gain_per_s = 2\nrecovery_per_s = 1"),
    ("damping = 0.1", "damping = -0.1"),
    ("damping = 0.1", "damping = 1e7"),
    ("damping = 0.1", "damping = \"fixed\""),
    ("damping = 0.1", "damping = []"),
    ("damping = \"smallest\"", "damping = \"smalest\""),
    ("rate_hz = 125", "rate = 125"),
    ("rate_hz = 125", "rate_hz = 0"),
    ("rate_hz = 125", "rate_hz = \"fast\""),
    ("rate_hz = 125", "duration_s = 0"),
    ("rate_hz = 125", "mode_rule = \"kone\""),
    ("rate_hz = 125", "border = \"soft\""),
    ("rate_hz = 125", "recursion = \"siciliano\""),
    ("exclusive = [[\"a\", \"b\"]]", "exclusive = [[\"a\"]]"),
    (
        "exclusive = [[\"a\", \"b\"]]",
        "exclusive = [[\"a\", \"a\"]]",
    ),
    ("exclusive = [[\"a\", \"b\"]]", "exclusive = [\"a\", \"b\"]"),
    ("name = \"c\"", "name = \"c d\""),
    ("name = \"c\"", ""),
    ("type = \"joint\"", "type = \"joints\""),
    ("type = \"joint\"", ""),
    ("joint = \"elbow_joint\"", "joint = \"elbow\""),
    ("joint = \"elbow_joint\"", "joint = 0"),
    ("joint = \"elbow_joint\"", ""),
    ("point_m = [1, 2, 3]", "point_m = [1, 2]"),
    ("min = 0.1", ""),
    ("min = 0.1\n", "min = 0.1\ndesired = 1\ngain_per_s = 1\n"),
    ("min = 0.1", "min = 0.1\naxis = \"z\""),
    ("min = 0.1", "max = -0.1"),
    ("max = 0.2", "min = 2.5"),
    ("target_m = [1, 2, 3]", ""),
    ("target_m = [1, 2, 3]", "min = 1"),
    (
        "target_m = [1, 2, 3]",
        "target_m = [1, 2, 3]\nacceptance_m = 1",
    ),
    ("target_m = [1, 2, 3]", "waypoints_m = [[1, 2, 3]]"),
    ("target_m = [1, 2, 3]", "waypoints_m = []\nacceptance_m = 1"),
    (
        "target_m = [1, 2, 3]",
        "waypoints_m = [[1, 2, 3]]\nacceptance_m = 0",
    ),
    ("max = 0.2", "max = 0.2\nmax_deg = 10"),
    ("max = 0.2", "min_deg = 181"),
    ("max = 0.2", "max_deg = -1"),
    ("max = 0.2", "desired_deg = 10"),
    (
        "max = 0.2",
        "desired_deg = 10\nmax_deg = 20\ngain_per_s = 1",
    ),
    ("max = 0.2", "desired_deg = 10\ndesired = 1\ngain_per_s = 1"),
    ("min_m = [0, 0, 0]", ""),
    ("min_m = [0, 0, 0]", "center_m = [0, 0, 0]"),
    ("min_m = [0, 0, 0]", "min_m = [0, 0, 0]\nradius_m = 1"),
    ("min_m = [0, 0, 0]", "min_m = [0, 0, 0]\nmin = 1"),
    (
        "min_m = [0, 0, 0]\nmax_m = [1, 1, 1]",
        "center_m = [0, 0, 0]",
    ),
    ("min_m = [0, 0, 0]\nmax_m = [1, 1, 1]", ""),
    ("desired_rpy_deg = [0, 0, 9]", ""),
    (
        "desired_rpy_deg = [0, 0, 9]",
        "waypoints_rpy_deg = [[0, 0, 9]]",
    ),
    (
        "target_m = [0, 0, 1]\ndesired_rpy_deg = [0, 0, 9]",
        "waypoints_m = [[0, 0, 1]]\nwaypoints_rpy_deg = [[0, 0, 9]]\nacceptance_m = 1",
    ),
    (
        "target_m = [0, 0, 1]\ndesired_rpy_deg = [0, 0, 9]",
        "waypoints_m = [[0, 0, 1]]\nwaypoints_rpy_deg = [[0, 0, 9]]\nacceptance_m = 1\n\
             acceptance_deg = 1\nvelocity_m_per_s = [0, 0, 0]",
    ),
    (
        "target_m = [0, 0, 1]\ndesired_rpy_deg = [0, 0, 9]",
        "waypoints_m = [[0, 0, 1]]\nwaypoints_quaternion_wxyz = [[0, 0, 9]]\nacceptance_m = 1\n\
             acceptance_deg = 1",
    ),
    ("axis = \"z\"", "axis = \"w\""),
    ("gain_per_s = 2", ""),
    ("gain_per_s = 2", "gain_per_s = -2"),
];

#[test]
fn schema_and_reader_refuse_the_same_mistakes() {
    assert!(Scenario::from_toml(GOOD).is_ok() && is_valid(GOOD));
    for &(good, bad) in MISTAKES {
        assert!(GOOD.contains(good), "{good:?}");
        let text = GOOD.replacen(good, bad, 1);
        assert!(!is_valid(&text), "the schema allows {bad:?} for {good:?}");
        assert!(
            Scenario::from_toml(&text).is_err(),
            "the reader allows {bad:?} for {good:?}"
        );
    }
}

#[test]
fn schema_and_reader_refuse_the_same_descriptions_of_robots() {
    let model = "model = \"ur5-paper\"";
    for bad in [
        "urdf = 1".to_owned(),
        format!("{model}\nurdf = \"arm.urdf\""),
        format!("{model}\nbase = \"a\""),
        format!("{model}\ntool = [\"a\"]"),
        format!("{model}\nbase_rpy_deg = [0, 0]"),
    ] {
        let text = GOOD.replacen(model, &bad, 1);
        assert!(!is_valid(&text), "the schema allows {bad:?}");
        assert!(
            Scenario::from_toml(&text).is_err(),
            "the reader allows {bad:?}"
        );
    }
}

/// The keys that the reader lists where a key is unknown.
fn keys_of_reader(text: &str) -> BTreeSet<String> {
    let errors = Scenario::from_toml(text).expect_err("there is an unknown key");
    let mistake = errors
        .mistakes()
        .iter()
        .find(|m| m.key.ends_with("xyzzyxyzzy"));
    let help = &mistake.expect("it is reported").help;
    help.split('`')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}

fn keys_of_schema(table: &Value) -> BTreeSet<String> {
    let properties = table["properties"]
        .as_object()
        .expect("a table has properties");
    properties.keys().cloned().collect()
}

#[test]
fn reader_and_schema_know_the_same_keys() {
    let schema = schema();
    assert_eq!(keys_of_reader("xyzzyxyzzy = 1"), keys_of_schema(&schema));
    for table in ["robot", "control"] {
        let text = format!("[{table}]\nxyzzyxyzzy = 1");
        assert_eq!(
            keys_of_reader(&text),
            keys_of_schema(&schema["properties"][table])
        );
    }
    let types = &schema["properties"]["task"]["items"]["oneOf"];
    let types = types.as_array().expect("a list of types");
    assert_eq!(types.len(), 19);
    for task_type in types {
        let name = &task_type["properties"]["type"]["const"];
        let text = format!("[[task]]\ntype = {name}\nxyzzyxyzzy = 1");
        assert_eq!(keys_of_reader(&text), keys_of_schema(task_type), "{name}");
    }
}

/// Every key of the schema, of whatever table.
fn all_keys(schema: &Value, keys: &mut BTreeSet<String>) {
    match schema {
        Value::Object(object) => {
            for (name, inner) in object {
                if name == "properties" {
                    keys.extend(
                        inner
                            .as_object()
                            .expect("properties are an object")
                            .keys()
                            .cloned(),
                    );
                }
                all_keys(inner, keys);
            }
        }
        Value::Array(members) => members.iter().for_each(|member| all_keys(member, keys)),
        _ => {}
    }
}

#[test]
fn every_key_is_explained_in_schema_template_and_manual() {
    let manual = fs::read_to_string(scenarios().join("../docs/scenario.md")).expect("it is there");
    let mut keys = BTreeSet::new();
    all_keys(&schema(), &mut keys);
    assert!(keys.len() > 20);
    for key in keys {
        assert!(
            template().contains(&key),
            "the template does not mention {key}"
        );
        assert!(
            manual.contains(&format!("`{key}`")),
            "docs/scenario.md does not explain `{key}`"
        );
    }
}
