//! A robot from a URDF file in a scenario: where it is looked for, what of it holds, and its mistakes.

use std::fs;
use std::path::{Path, PathBuf};

use conik::{Frame, Goal, Kinematics, Vec3};
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Scenario, TaskKind};

/// Two arms on a waist; the left one slides out.
const TORSO: &str = r#"<robot name="torso">
  <link name="foot"/> <link name="chest"/> <link name="left"/> <link name="right"/>
  <joint name="waist" type="revolute">
    <parent link="foot"/> <child link="chest"/> <origin xyz="0 0 1"/> <axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1.5" effort="80"/>
  </joint>
  <joint name="reach out" type="prismatic">
    <parent link="chest"/> <child link="left"/> <origin xyz="0 0.3 0"/> <axis xyz="1 0 0"/>
    <limit lower="0" upper="0.6" velocity="0.2" effort="80"/>
  </joint>
  <joint name="wave" type="continuous">
    <parent link="chest"/> <child link="right"/> <origin xyz="0 -0.3 0"/> <axis xyz="0 1 0"/>
  </joint>
</robot>
"#;

const SCENARIO: &str = r#"
[robot]
urdf = "torso.urdf"
tool = ["left", "right"]
q0_deg = [90, 0.25, 30]
[[task]]
name = "p"
type = "position"
target_m = [0, 0, 1]
gain_per_s = 1
"#;

/// A folder with the file and a scenario.
struct Cell(PathBuf);

impl Cell {
    fn new(name: &str, urdf: &str, scenario: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("conik urdf {name} {}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join("torso.urdf"), urdf).expect("written");
        fs::write(folder.join("cell.toml"), scenario).expect("written");
        Self(folder)
    }

    fn file(&self) -> PathBuf {
        self.0.join("cell.toml")
    }
}

impl Drop for Cell {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn refusal(name: &str, urdf: &str, scenario: &str) -> String {
    let cell = Cell::new(name, urdf, scenario);
    let error = Scenario::load(cell.file()).expect_err("it is wrong");
    error.to_string()
}

#[test]
fn the_file_is_found_beside_the_scenario_and_written_back() {
    let cell = Cell::new("beside", TORSO, SCENARIO);
    let scenario = Scenario::load(cell.file()).expect("it is right");
    assert_eq!(Path::new(scenario.robot.name()), cell.0.join("torso.urdf"));
    assert_eq!(
        Scenario::from_toml(&scenario.to_toml()),
        Ok(scenario.clone())
    );
    let json = serde_json::to_string(&scenario).expect("it can be written");
    assert_eq!(
        serde_json::from_str::<Scenario>(&json).expect("read"),
        scenario
    );
    // What was read can be run when the file is gone.
    drop(cell);
    let experiment = Experiment::new(&scenario).expect("it can be run");
    let joints: Vec<&str> = experiment.robot.joint_names().collect();
    assert_eq!(joints, ["waist", "reach out", "wave"]);
}

#[test]
fn lengths_stay_lengths_and_limits_become_sets() {
    let cell = Cell::new("limits", TORSO, SCENARIO);
    let scenario = Scenario::load(cell.file()).expect("it is right");
    let [waist, out, wave] = scenario.robot.q0_rad[..] else {
        panic!("three joints");
    };
    assert_eq!(
        [waist, out, wave],
        [90_f64.to_radians(), 0.25, 30_f64.to_radians()]
    );
    let experiment = Experiment::new(&scenario).expect("it can be run");
    let stack = experiment.controller.stack();
    let names: Vec<&str> = stack.iter().map(|(_, level)| level.name()).collect();
    assert_eq!(names, ["limit/waist", "limit/reach out", "p"]);
    let units: Vec<&str> = stack.iter().map(|(_, level)| level.task().unit()).collect();
    assert_eq!(units, ["rad", "m", "m"]);
    assert_eq!(experiment.robot.joints()[1].limits.speed, Some(0.2));
    let limits = "position_limits_deg = [[-90, 90], [0.1, 0.5], []]\nspeed_limits_deg_per_s = [90, 0.1, 180]";
    let own = SCENARIO.replace("[[task]]", &format!("{limits}\n[[task]]"));
    let cell = Cell::new("own limits", TORSO, &own);
    let scenario = Scenario::load(cell.file()).expect("it is right");
    let robot = Experiment::new(&scenario).expect("it can be run").robot;
    assert_eq!(robot.joints()[1].limits.position, Some((0.1, 0.5)));
    assert_eq!(robot.joints()[1].limits.speed, Some(0.1));
    assert_eq!(robot.joints()[0].limits.speed, Some(90_f64.to_radians()));
}

#[test]
fn base_and_tool_stand_where_they_are_put() {
    let places = "base_position_m = [1, 2, 3]\nbase_rpy_deg = [0, 0, 90]\n\
                  tool_offset_m = [0, 0, 0.5]\ntool_offset_rpy_deg = [90, 0, 0]";
    let text = SCENARIO.replace("[[task]]", &format!("{places}\n[[task]]"));
    let cell = Cell::new(
        "places",
        TORSO,
        &text.replace("[90, 0.25, 30]", "[0, 0.25, 30]"),
    );
    let scenario = Scenario::load(cell.file()).expect("it is right");
    assert_eq!(
        Scenario::from_toml(&scenario.to_toml()),
        Ok(scenario.clone())
    );
    let experiment = Experiment::new(&scenario).expect("it can be run");
    let robot = &experiment.robot;
    assert_eq!(robot.tool_name(), "tool");
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(&experiment.q0);
    // The hand is at (0.25, 0.3, 1) of the base, whose x is the world's y.
    let tool = kinematics.world_from(Frame::Tool);
    let off = (tool.origin - Vec3::new(1.0 - 0.3, 2.0 + 0.25, 3.0 + 1.0 + 0.5)).norm();
    assert!(off < 1e-15, "{tool:?}");
    // Rolled by a quarter about the hand's x, its y points up.
    assert!(
        (tool.y_axis - Vec3::new(0.0, 0.0, 1.0)).norm() < 1e-15,
        "{tool:?}"
    );
}

#[test]
fn mistakes_are_told_with_the_file_that_they_are_in() {
    let bad = TORSO.replace("type=\"continuous\"", "type=\"hinge\"");
    let message = refusal("hinge", &bad, SCENARIO);
    for part in [
        "cell.toml:3:8: robot.urdf: ",
        "torso.urdf:11:22: joint \"wave\", attribute `type`",
        "\"hinge\"",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
    // What is replaced in the scenario, by what, and what the one message says.
    let cases = [
        (
            "\"torso.urdf\"",
            "\"tarso.urdf\"",
            "robot.urdf",
            "tarso.urdf: cannot be read",
        ),
        ("\"torso.urdf\"", "\".\"", "robot.urdf", "is a directory"),
        (
            "tool = [\"left\", \"right\"]",
            "",
            "robot.tool",
            "\"left\", \"right\"",
        ),
        (
            "[\"left\", \"right\"]",
            "[\"left\", \"hand\"]",
            "robot.tool",
            "there is no link \"hand\"",
        ),
        (
            "[\"left\", \"right\"]",
            "[]",
            "robot.tool",
            "the list is empty",
        ),
        (
            "[\"left\", \"right\"]",
            "[1]",
            "robot.tool[1]",
            "expected text",
        ),
        (
            "tool =",
            "base = \"floor\"\ntool =",
            "robot.base",
            "there is no link \"floor\"",
        ),
        (
            "tool =",
            "model = \"ur5-paper\"\ntool =",
            "robot.urdf",
            "both `model` and `urdf`",
        ),
        (
            "urdf = \"torso.urdf\"",
            "model = \"ur5-paper\"",
            "robot.tool",
            "is for robots from URDF",
        ),
        (
            "[90, 0.25, 30]",
            "[90, 30]",
            "robot.q0_deg",
            "robot \"torso\" has 3 joints",
        ),
        (
            "tool =",
            "speed_limits_deg_per_s = 90\ntool =",
            "robot.speed_limits_deg_per_s",
            "waist, reach out, wave",
        ),
    ];
    for (good, other, key, says) in cases {
        assert!(SCENARIO.contains(good), "{good}");
        let message = refusal("case", TORSO, &SCENARIO.replacen(good, other, 1));
        assert!(
            message.contains(&format!(": {key}: ")) && message.contains(says),
            "{other}: {message}"
        );
    }
}

#[test]
fn a_joint_that_would_break_the_log_is_refused() {
    for name in ["reach, out", "reach\u{202e}out", "reach+out"] {
        let message = refusal("comma", &TORSO.replace("reach out", name), SCENARIO);
        let says = format!("{name:?} cannot be named in the log");
        assert!(message.contains(&says), "{says}: {message}");
    }
}

#[test]
fn notes_tell_what_was_not_taken() {
    let cell = Cell::new(
        "notes",
        TORSO,
        &SCENARIO
            .replace("[\"left\", \"right\"]", "\"right\"")
            .replace("0.25, ", ""),
    );
    let scenario = Scenario::load(cell.file()).expect("it is right");
    let notes = scenario.robot.notes();
    assert!(
        notes
            .iter()
            .any(|note| note.starts_with("line 7: \"reach out\": held still")),
        "{notes:?}"
    );
    assert!(
        notes.iter().any(|note| note.contains("waist 80")),
        "{notes:?}"
    );
}

#[test]
fn tasks_take_lengths_of_joints_that_slide_as_they_are() {
    let scenario = SCENARIO.to_owned()
        + r#"
[[task]]
name = "rest"
type = "posture"
joints = ["reach out", "waist"]
desired_deg = [0.25, 90]
gain_per_s = 1
[[task]]
name = "out"
type = "joint_speed"
joint = "reach out"
speed_deg_per_s = 0.1
"#;
    let cell = Cell::new("tasks", TORSO, &scenario);
    let scenario = Scenario::load(cell.file()).expect("it is right");
    let experiment = Experiment::new(&scenario).expect("it can be run");
    let stack = experiment.controller.stack();
    let rest = stack.find("rest").expect("listed");
    let Goal::Equality { desired, .. } = stack[rest].goal() else {
        panic!("a posture has desired positions");
    };
    assert_eq!(*desired, [0.25, 90_f64.to_radians()]);
    let out = scenario.tasks.last().expect("three tasks");
    let speed = TaskKind::JointSpeed {
        joint: 2,
        speed_rad_per_s: 0.1,
    };
    assert_eq!(out.kind, speed);
}

#[test]
fn only_joints_that_turn_have_limits_in_degrees() {
    let limited = |joint: &str| {
        let task = "[[task]]\nname = \"it\"\ntype = \"joint\"\nmax_deg = 1\ngain_per_s = 1\n";
        format!("{SCENARIO}{task}joint = \"{joint}\"\n")
    };
    let cell = Cell::new("turns", TORSO, &limited("waist"));
    Scenario::load(cell.file()).expect("it turns");
    let cell = Cell::new("slides", TORSO, &limited("reach out"));
    let told = Scenario::load(cell.file())
        .expect_err("it slides")
        .to_string();
    let part =
        "task[2] \"it\".max_deg: joint 2 slides: its position is in m, not in degrees; give `max`";
    assert!(told.contains(part), "{told}");
}
