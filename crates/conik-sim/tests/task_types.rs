//! Every type of task by its keys: read, written and read again, and run.

use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Scenario, schema};

/// Type, and its keys but for the goal.
const TYPES: &[(&str, &str)] = &[
    ("position", "target_m = [0.4, 0, 0]\ngain_per_s = 1"),
    ("coordinate", "axis = \"x\"\nmax = 2"),
    ("distance", "point_m = [0, 0, 1]\nmin = 0.01"),
    ("field_of_view", "direction = [0, 0, -1]\nmax = 2"),
    ("joint", "joint = 2\nmax = 3"),
    (
        "orientation",
        "desired_rpy_deg = [170, -20, 30]\ngain_per_s = 1",
    ),
    (
        "orientation_angle",
        "desired_quaternion_wxyz = [0, 0.3, 2, 1]\nmax = 3",
    ),
    (
        "pose",
        "target_m = [0.4, 0, 0]\ndesired_rpy_deg = [170, -20, 30]\ngain_per_s = 1",
    ),
    (
        "pointing_angle",
        "axis = [0, 3, 0.1]\ndirection = [1, 0, 7]\nmax = 3",
    ),
    (
        "look_at",
        "point_m = [1, 0, 0]\nvelocity_m_per_s = [0, 0.1, 0]\nmoves_until_s = 2\nmax = 3",
    ),
    ("plane", "normal = [0, -1, 3]\noffset_m = -0.5\nmin = -1"),
    ("height", "min = -1"),
    ("workspace", "center_m = [0, 0, 0]\nradius_m = 2"),
    ("shape_distance", "shapes = [\"hand\", \"post\"]\nmin = 0"),
    (
        "posture",
        "joints = [\"elbow_joint\", 1]\ndesired_deg = [90, 10]\ngain_per_s = 1",
    ),
    (
        "joint_speed",
        "joint = 6\nspeed_deg_per_s = 20\ndamping = \"none\"",
    ),
    ("manipulability", "part = \"orientation\"\nmin = 0"),
    ("smallest_singular_value", "min = 0"),
    (
        "elbow",
        "shoulder = \"link_1\"\nelbow = \"link_2\"\nwrist = \"link_6\"\ndirection = [0, 0, 2]\nmin = -3",
    ),
];

/// Angles in degrees, and the same in the unit of the task.
const IN_DEGREES: &[(&str, &str, &str, &str)] = &[
    (
        "pointing_angle",
        "direction = [1, 0, 7]",
        "max_deg = 30",
        "max = 0.5235987755982988",
    ),
    (
        "look_at",
        "point_m = [1, 0, 0]",
        "min_deg = 0\nmax_deg = 180",
        "min = 0\nmax = 3.141592653589793",
    ),
    (
        "orientation_angle",
        "desired_rpy_deg = [170, -20, 30]",
        "desired_deg = 90\ngain_per_s = 1",
        "desired = 1.5707963267948966\ngain_per_s = 1",
    ),
    (
        "elbow",
        "shoulder = \"link_1\"\nelbow = \"link_2\"\nwrist = \"link_6\"\ndirection = [0, 0, 2]",
        "min_deg = -180\nmax = 1",
        "min = -3.141592653589793\nmax = 1",
    ),
    (
        "joint",
        "joint = 2",
        "min_deg = -720\nmax_deg = 90",
        "min = -12.566370614359172\nmax = 1.5707963267948966",
    ),
    (
        "field_of_view",
        "direction = [1, 0, 0]",
        "max_deg = 180",
        "max = 2",
    ),
    (
        "field_of_view",
        "direction = [1, 0, 0]",
        "max_deg = 60",
        "max = 0.9999999999999999",
    ),
];

/// Types with further keys: what moves of them, waypoints, a box.
const MOVING: &[(&str, &str)] = &[
    (
        "workspace",
        "min_m = [-2, -2, -2]\nmax_m = [2, 2, 2]\nrecovery_per_s = 0.1",
    ),
    (
        "position",
        "target_m = [0.4, 0, 0]\nvelocity_m_per_s = [0, 0.1, 0]\nmoves_until_s = 2\ngain_per_s = 1",
    ),
    (
        "pose",
        "target_m = [0.4, 0, 0]\ndesired_rpy_deg = [170, -20, 30]\nvelocity_m_per_s = [0, 0.1, 0]\n\
         angular_velocity_rad_per_s = [0, 0.3, 0.1]\nmoves_until_s = 2\ngain_per_s = 1",
    ),
    (
        "field_of_view",
        "direction = [0, 0, -1]\nangular_velocity_deg_per_s = [10, 0, 0]\nmax = 2",
    ),
    (
        "pointing_angle",
        "direction = [1, 0, 7]\nangular_velocity_rad_per_s = [0.1, 0, 0]\nmoves_until_s = 1\n\
         desired = 0.2\ndesired_per_s = 0.1\ngain_per_s = 2",
    ),
    (
        "orientation",
        "desired_rpy_deg = [170, -20, 30]\nangular_velocity_deg_per_s = [0, 0, 10]\ngain_per_s = 1",
    ),
    (
        "orientation_angle",
        "desired_rpy_deg = [170, -20, 30]\nangular_velocity_deg_per_s = [0, 0, 10]\nmax = 3",
    ),
    (
        "coordinate",
        "axis = \"x\"\ndesired = 0.4\ndesired_per_s = -0.1\nmoves_until_s = 3\ngain_per_s = 1",
    ),
    (
        "pose",
        "waypoints_m = [[0.4, 0, 0], [0.3, 0.2, 0]]\nwaypoints_rpy_deg = [[170, 0, 30], [180, 0, 0]]\n\
         acceptance_m = 0.02\nacceptance_deg = 3\ngain_per_s = 1",
    ),
    (
        "pose",
        "waypoints_m = [[0.4, 0, 0]]\nwaypoints_quaternion_wxyz = [[0.2, 3, 1, 0]]\n\
         acceptance_m = 0.02\nacceptance_rad = 0.1\ngain_per_s = 1",
    ),
    (
        "orientation",
        "waypoints_rpy_deg = [[170, 0, 30], [180, 0, 0]]\nacceptance_deg = 3\ngain_per_s = 1",
    ),
    (
        "joint",
        "joint = 3\ndesired = 1\ndesired_per_s = 2e-2\ngain_per_s = 1",
    ),
];

/// They measure no frame.
const WITHOUT_FRAME: &[&str] = &["joint", "posture", "joint_speed", "shape_distance"];

/// What types that name shapes need beside them.
const SHAPES: &str = r#"
[[shape]]
name = "hand"
link = "link_6"
type = "sphere"
center_m = [0, 0, 0.1]
radius_m = 0.05
[[obstacle]]
name = "post"
type = "cylinder"
from_m = [2, 0, 0]
to_m = [2, 0, 1]
radius_m = 0.1
"#;

fn scenario(type_name: &str, keys: &str) -> String {
    format!(
        "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -158, -108, -90, -85, 10]\n{SHAPES}\n[[task]]\n\
         name = \"it\"\ntype = \"{type_name}\"\n{keys}\n"
    )
}

fn read(text: &str) -> Scenario {
    Scenario::from_toml(text).unwrap_or_else(|errors| panic!("{text}\n{errors}"))
}

/// With the frames that the type may have.
fn cases() -> Vec<(&'static str, String)> {
    let mut cases = Vec::new();
    for (name, keys) in TYPES.iter().chain(MOVING) {
        cases.push((*name, scenario(name, keys)));
        let seen = "relative_to = \"link_1\"";
        if *name == "elbow" {
            cases.push((*name, scenario(name, &format!("{keys}\n{seen}"))));
        } else if !WITHOUT_FRAME.contains(name) {
            let frames = format!("{keys}\nframe = \"link_5\"\n{seen}");
            cases.push((*name, scenario(name, &frames)));
        }
    }
    cases
}

#[test]
fn the_table_has_every_type() {
    let schema = schema();
    let types = schema["properties"]["task"]["items"]["oneOf"].as_array();
    let known: Vec<&str> = types
        .expect("types")
        .iter()
        .map(|known| known["title"].as_str().expect("a name"))
        .collect();
    for name in known {
        assert!(TYPES.iter().any(|(tried, _)| *tried == name), "{name}");
    }
}

#[test]
fn what_is_written_reads_back_to_the_same() {
    for (name, text) in cases() {
        let scenario = read(&text);
        let written = scenario.to_toml();
        assert_eq!(read(&written), scenario, "{name}\n{written}");
        let json = serde_json::to_string(&scenario).expect("it can be written");
        let again: Scenario = serde_json::from_str(&json).expect("it can be read");
        assert_eq!(again, scenario, "{name}\n{json}");
    }
}

#[test]
fn angles_may_be_given_in_degrees() {
    let validator = jsonschema::draft7::new(&schema()).expect("a schema");
    for (name, own, in_degrees, in_value) in IN_DEGREES {
        let text = scenario(name, &format!("{own}\n{in_degrees}"));
        let expected = read(&scenario(name, &format!("{own}\n{in_value}")));
        assert_eq!(read(&text), expected, "{text}");
        assert_eq!(read(&read(&text).to_toml()), expected, "{text}");
        let file: serde_json::Value = toml::from_str(&text).expect("TOML");
        assert!(validator.is_valid(&file), "{text}");
    }
}

#[test]
fn schema_takes_what_the_reader_takes() {
    let validator = jsonschema::draft7::new(&schema()).expect("a schema");
    for (name, text) in cases() {
        let file: serde_json::Value = toml::from_str(&text).expect("TOML");
        assert!(validator.is_valid(&file), "{name}\n{text}");
    }
}

#[test]
fn every_type_runs() {
    for (name, text) in cases() {
        let mut experiment = Experiment::new(&read(&text)).expect(name);
        let mut q = experiment.q0;
        for tick in 0..25 {
            experiment.move_world(f64::from(tick) / 125.0).expect(name);
            let step = experiment.controller.step(&q).expect(name);
            q = step.q_ref;
        }
        assert!(q.is_finite(), "{name}");
        let of_sets = ["max = ", "min = ", "radius_m = 2", "max_m = "];
        let is_set = of_sets.iter().any(|key| text.contains(key));
        assert_eq!(
            q == experiment.q0,
            is_set,
            "{name}: only levels move the arm"
        );
    }
}

#[test]
fn a_frame_moves_as_the_file_says() {
    let text = scenario("height", "frame = \"link_2\"\nmin = -1");
    let mut experiment = Experiment::new(&read(&text)).expect("sound");
    let q0 = experiment.q0;
    let mut kinematics = conik::Kinematics::new(&experiment.robot);
    kinematics.update(&q0);
    let expected = kinematics.world_from(conik::Frame::Link(2)).origin.z;
    let task = experiment
        .controller
        .stack()
        .find("it")
        .expect("it is there");
    let step = experiment.controller.step(&q0).expect("finite");
    assert_eq!(step.value(task)[0], expected);
}

/// Type, keys, and a part of the message.
const MISTAKES: &[(&str, &str, &str)] = &[
    (
        "height",
        "min = 0\nframe = \"link_7\"",
        "the robot has no link \"link_7\"",
    ),
    (
        "height",
        "min = 0\nframe = \"lnk_3\"",
        "did you mean \"link_3\"?",
    ),
    (
        "joint",
        "joint = 1\nmax = 1\nframe = \"link_1\"",
        "`frame` is a key of type",
    ),
    (
        "orientation",
        "gain_per_s = 1",
        "desired_rpy_deg = [180, 0, 90]",
    ),
    (
        "orientation",
        "desired_quaternion_wxyz = [1, 0, 0]\ngain_per_s = 1",
        "expected four numbers, w, x, y and z; found 3",
    ),
    (
        "orientation",
        "desired_quaternion_wxyz = [0, 0, 0, 0]\ngain_per_s = 1",
        "the quaternion 0 is no orientation",
    ),
    (
        "orientation",
        "desired_rpy_deg = [0, 0, 0]\ndesired_quaternion_wxyz = [1, 0, 0, 0]\ngain_per_s = 1",
        "state it once",
    ),
    (
        "orientation",
        "desired_rpy_deg = [0, 0, 0]\nmax = 1",
        "a task of type \"orientation\" cannot be a set",
    ),
    (
        "pose",
        "desired_rpy_deg = [0, 0, 0]\ngain_per_s = 1",
        "target_m",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 0]\nmax = 1",
        "the zero vector has no direction",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\nmin = 4",
        "its values are from",
    ),
    (
        "plane",
        "normal = [0, 0, 0]\nmin = 0",
        "the zero vector has no direction",
    ),
    (
        "posture",
        "desired_deg = [1, 2]\ngain_per_s = 1",
        "of 6 joints, found 2 numbers",
    ),
    (
        "posture",
        "joints = [1, 1]\ndesired_deg = [1, 2]\ngain_per_s = 1",
        "joint 1 stands in the list twice",
    ),
    (
        "posture",
        "desired_deg = [1, 2, 3, 4, 5, 6]",
        "an equality task needs a gain",
    ),
    ("joint_speed", "joint = 1", "speed_deg_per_s"),
    (
        "joint_speed",
        "joint = 1\nspeed_deg_per_s = 1\ngain_per_s = 1",
        "`gain_per_s`",
    ),
    (
        "manipulability",
        "part = \"wrist\"\nmin = 0",
        "unknown name \"wrist\"",
    ),
    ("manipulability", "max = -1", "its values are never below 0"),
    ("elbow", "direction = [0, 0, 1]\nmin = 0", "shoulder"),
    (
        "workspace",
        "min_m = [0, 0, 0.5]\nmax_m = [1, 1, 0.4]",
        "0.5 in `min_m` is greater than 0.4 in `max_m`: nothing is in this box",
    ),
    (
        "workspace",
        "recovery_per_s = 0.1",
        "this workspace has no shape",
    ),
    ("workspace", "center_m = [0, 0, 0]", "radius_m"),
    ("workspace", "max_m = [0, 0, 0]", "min_m"),
    (
        "workspace",
        "center_m = [0, 0, 0]\nradius_m = -1",
        "out of range",
    ),
    (
        "workspace",
        "center_m = [0, 0, 0]\nmax_m = [0, 0, 0]",
        "`center_m` is of a sphere and `max_m` of a box",
    ),
    ("workspace", "max = 1", "it is a region"),
    (
        "workspace",
        "center_m = [0, 0, 0]\nradius_m = 1\nframe = \"lnk_3\"",
        "did you mean \"link_3\"?",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\nmin = 0.1\nmin_deg = 4",
        "both `min` and `min_deg` are given",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\ndesired = 0.1\ndesired_deg = 4\ngain_per_s = 1",
        "both `desired` and `desired_deg` are given",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\nmin_deg = 30\nmax_deg = 20",
        "min_deg 30 is greater than max_deg 20: no value is in this set; exchange them: `min_deg = 20`",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\nmin_deg = 30\nmax = 0.2",
        "min_deg 30 is greater than max 0.2: no value is in this set",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\ndesired_deg = 30\nmax = 0.2\ngain_per_s = 1",
        "both a `desired` value and `min` or `max`",
    ),
    (
        "field_of_view",
        "direction = [0, 0, 1]\nmin_deg = 200",
        "200 is out of reach of a task of this type; its values are from 0 to 180",
    ),
    (
        "look_at",
        "point_m = [0, 0, 1]\nmax_deg = -1",
        "its values are from 0 to 180",
    ),
    (
        "elbow",
        "min_deg = \"30\"",
        "expected a number, found the text \"30\"",
    ),
    ("height", "min_deg = 3", "`min_deg` is a key of type"),
    (
        "orientation",
        "max_deg = 3",
        "a task of type \"orientation\" cannot be a set",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\nmax_deg = 3\ndesired_per_s = 1",
        "and this is a set",
    ),
    (
        "position",
        "waypoints_m = [[0, 0, 1]]\nacceptance_m = 0.1\ngain_per_s = 1\nvelocity_m_per_s = [0, 0, 1]",
        "waypoints stay where they are",
    ),
    (
        "pose",
        "waypoints_m = [[0, 0, 1]]\nwaypoints_rpy_deg = [[0, 0, 0]]\nacceptance_m = 0.1\ngain_per_s = 1",
        "acceptance_deg",
    ),
    (
        "pose",
        "waypoints_m = [[0, 0, 1]]\nacceptance_deg = 2\nacceptance_m = 0.1\ngain_per_s = 1",
        "waypoints_rpy_deg = [[",
    ),
    (
        "pose",
        "waypoints_m = [[0, 0, 1], [0, 1, 1]]\nwaypoints_rpy_deg = [[0, 0, 0]]\nacceptance_deg = 2\n\
         acceptance_m = 0.1\ngain_per_s = 1",
        "1 orientations for 2 points",
    ),
    (
        "pose",
        "target_m = [0, 0, 1]\nwaypoints_rpy_deg = [[0, 0, 0]]\nacceptance_deg = 2\ngain_per_s = 1",
        "both `waypoints_rpy_deg` and `target_m` are given",
    ),
    (
        "pose",
        "target_m = [0, 0, 1]\ndesired_rpy_deg = [0, 0, 0]\nacceptance_deg = 2\ngain_per_s = 1",
        "`acceptance_deg` says when the next waypoint is taken, and there are none",
    ),
    (
        "orientation",
        "waypoints_quaternion_wxyz = [[0, 0, 0, 0]]\nacceptance_deg = 2\ngain_per_s = 1",
        "the quaternion 0 is no orientation",
    ),
    (
        "orientation",
        "waypoints_quaternion_wxyz = []\nacceptance_deg = 2\ngain_per_s = 1",
        "the list is empty",
    ),
    (
        "orientation",
        "waypoints_quaternion_wxyz = [[1, 0, 0, 0], 3]\nacceptance_deg = 2\ngain_per_s = 1",
        "expected a list of four numbers, found the number 3",
    ),
    (
        "orientation",
        "waypoints_rpy_deg = [[0, 0, 0]]\nacceptance_deg = 200\ngain_per_s = 1",
        "out of range",
    ),
    (
        "orientation",
        "waypoints_rpy_deg = [[0, 0, 0]]\nacceptance_deg = 2\nacceptance_rad = 0.1\ngain_per_s = 1",
        "both `acceptance_deg` and `acceptance_rad` are given",
    ),
    (
        "pose",
        "waypoints_m = [[0, 0, 1]]\nwaypoints_rpy_deg = [[0, 0, 0]]\nacceptance_m = 0.1\n\
         acceptance_deg = 2\ngain_per_s = 1\nangular_velocity_deg_per_s = [0, 0, 1]",
        "waypoints stay where they are",
    ),
    (
        "position",
        "target_m = [0, 0, 1]\ngain_per_s = 1\nmoves_until_s = 1",
        "nothing moves; remove it, or write for example `velocity_m_per_s",
    ),
    (
        "position",
        "target_m = [0, 0, 1]\ngain_per_s = 1\nangular_velocity_deg_per_s = [0, 0, 1]",
        "`angular_velocity_deg_per_s` is a key of type",
    ),
    (
        "position",
        "target_m = [0, 0, 1]\ngain_per_s = 1\nvelocity_m_per_s = [0, 0, 1e7]",
        "out of range",
    ),
    (
        "orientation",
        "desired_rpy_deg = [0, 0, 0]\ngain_per_s = 1\nangular_velocity_deg_per_s = 3",
        "expected a list of three numbers, found the number 3",
    ),
    (
        "pose",
        "target_m = [0, 0, 1]\ndesired_rpy_deg = [0, 0, 0]\ngain_per_s = 1\n\
             angular_velocity_deg_per_s = [0, 0, 1]\nangular_velocity_rad_per_s = [0, 0, 1]",
        "both `angular_velocity_deg_per_s` and `angular_velocity_rad_per_s` are given",
    ),
    ("height", "min = 0\ndesired_per_s = 1", "and this is a set"),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\ndesired = 0.1\ndesired_per_s = 1\nmoves_until_s = 4\ngain_per_s = 1",
        "after 4 s the desired value is 4.1, out of reach",
    ),
    (
        "pointing_angle",
        "direction = [0, 0, 1]\ndesired = 0.1\ndesired_per_s = -0.01\ngain_per_s = 1",
        "after 60 s the desired value is -0.5, out of reach",
    ),
    (
        "joint_speed",
        "joint = 1\nspeed_deg_per_s = 1\ndesired_per_s = 1",
        "`desired_per_s`",
    ),
];

#[test]
fn mistakes_are_told_with_what_would_be_right() {
    for (type_name, keys, what) in MISTAKES {
        let errors = Scenario::from_toml(&scenario(type_name, keys)).expect_err(keys);
        let told = errors.to_string();
        assert!(told.contains(what), "{type_name}, {keys}: {told}");
    }
}
