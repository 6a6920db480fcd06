//! Robots from URDF files on the command line: what `check` notes, and who can drive them.

use std::fs;

use super::process::{empty_folder, repository, say};

const SCENARIO: &str = "scenarios/gallery/urdf-rail-arm.toml";

#[test]
fn the_emulator_refuses_what_no_ur_arm_is() {
    for robot in ["emulator", "127.0.0.1"] {
        let arguments = format!("run {SCENARIO} --robot {robot} --out target/never");
        let output = say(&repository(), &arguments);
        let said = output.stderr;
        assert_eq!(output.status, Some(2), "{said}");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in [
            "six joints that turn",
            "8 joints, of which 1 slide",
            "--robot ideal",
        ] {
            assert!(said.contains(part), "{part}: {said}");
        }
    }
}

#[test]
fn check_shows_joints_in_their_units_and_notes() {
    let output = say(&repository(), &format!("check {SCENARIO}"));
    let said = output.stdout;
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "1 rail starts at -0.600 m, -1.000…1.000 m, ≤ 0.500 m/s",
        "2 shoulder_yaw starts at 20.000°",
        "line 62: \"left_finger\", \"right_finger\": held still",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn a_run_is_headed_with_the_name_of_the_file() {
    let folder = empty_folder("urdf heading");
    let scenario = repository().join(SCENARIO);
    let arguments = format!("run {} --robot ideal --out .", scenario.display());
    let said = say(&folder, &arguments).stdout;
    assert!(said.contains("\nrail-arm.urdf on ideal arm"), "{said}");
    let report = fs::read_to_string(folder.join("report.html")).unwrap();
    assert!(report.contains("robot rail-arm.urdf, at 250 Hz"));
}

#[test]
fn mistakes_in_the_file_are_shown_with_its_own_line() {
    let folder = empty_folder("urdf mistake");
    let urdf = fs::read_to_string(repository().join("robots/rail-arm.urdf")).unwrap();
    let urdf = urdf.replacen("type=\"prismatic\"", "type=\"sliding\"", 1);
    fs::write(folder.join("rail-arm.urdf"), urdf).unwrap();
    let scenario = fs::read_to_string(repository().join(SCENARIO)).unwrap();
    let scenario = scenario.replace("../../robots/", "");
    fs::write(folder.join("cell.toml"), scenario).unwrap();
    let output = say(&folder, "check cell.toml");
    assert_eq!(output.status, Some(2));
    let said = output.stderr;
    assert!(said.contains("rail-arm.urdf:18:"), "{said}");
    assert!(said.contains("cell.toml:8:"), "{said}");
}

/// A UR arm's joints, with lengths of nobody's.
fn ur_urdf() -> String {
    let joints = [
        "shoulder_pan",
        "shoulder_lift",
        "elbow",
        "wrist_1",
        "wrist_2",
        "wrist_3",
    ];
    let mut text = "<robot name=\"ur5e\"><link name=\"l0\"/>".to_owned();
    for (i, joint) in joints.iter().enumerate() {
        let (next, y) = (i + 1, i % 2);
        let x = 1 - y;
        text += &format!(
            "<link name=\"l{next}\"/><joint name=\"left_{joint}_joint\" type=\"revolute\">\
             <parent link=\"l{i}\"/><child link=\"l{next}\"/><origin xyz=\"0 {x} 0.2\"/>\
             <axis xyz=\"0 {y} {x}\"/><limit lower=\"-3\" upper=\"3\" velocity=\"1\"/></joint>"
        );
    }
    text + "</robot>"
}

#[test]
fn joints_in_another_order_than_the_controllers_are_not_driven() {
    let folder = empty_folder("urdf order");
    fs::write(folder.join("ur.urdf"), ur_urdf()).unwrap();
    let cell = |ways: &str| {
        format!(
            "[robot]\nurdf = \"ur.urdf\"\nq0_deg = [10, 20, 30, 40, 50, 60]\n{ways}\n[control]\n\
             duration_s = 0.1\n[[task]]\nname = \"still\"\ntype = \"posture\"\n\
             desired_deg = [10, 20, 30, 40, 50, 60]\ngain_per_s = 1\n"
        )
    };
    fs::write(folder.join("cell.toml"), cell("")).unwrap();
    let output = say(&folder, "run cell.toml --fast --out right");
    assert_eq!(output.status, Some(0), "{}", output.stderr);
    assert!(!output.stderr.contains("warning"), "{}", output.stderr);
    let turned = cell("base = \"l6\"\ntool = \"l0\"");
    fs::write(folder.join("cell.toml"), turned).unwrap();
    for robot in ["emulator", "127.0.0.1"] {
        let output = say(
            &folder,
            &format!("run cell.toml --fast --robot {robot} --out turned"),
        );
        let said = output.stderr;
        assert_eq!(output.status, Some(2), "{said}");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        let part = "has them as left_wrist_3_joint, left_wrist_2_joint";
        assert!(said.contains(part), "{said}");
    }
}
