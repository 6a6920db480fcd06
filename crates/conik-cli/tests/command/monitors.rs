//! What the monitors saw stands on the terminal, in summary.json and in the report.

use std::fs;

use super::process::{conik, done, empty_folder, ended, paper};
use super::run_folder::{Rows, summary};

/// A tool that is to stay at a point while a ball passes over it at `speed` [m/s] from the side.
fn passing_ball(speed: f64) -> String {
    format!(
        "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -158, -108, -90, -85, 0]\n\
         position_limits_deg = [[-50, 90], [], [], [], [], []]\n\
         speed_limits_rad_per_s = 3\nacceleration_limits_rad_per_s2 = 8\n\
         [control]\nduration_s = 4\n\
         [[task]]\nname = \"ball\"\ntype = \"distance\"\npoint_m = [0.2546, -0.15, -0.2319]\n\
         velocity_m_per_s = [0, {:?}, 0]\nmoves_until_s = {:?}\nmin = 0.1\n\
         [[task]]\nname = \"position\"\ntype = \"position\"\n\
         target_m = [0.35, -0.45, -0.25]\ngain_per_s = 1\n",
        -speed,
        0.6 / speed
    )
}

#[test]
fn ball_that_is_too_fast_is_announced_and_ends_in_status_1() {
    let folder = empty_folder("too fast");
    fs::write(folder.join("ball.toml"), passing_ball(20.0)).unwrap();
    let said = ended(conik("run ball.toml --robot ideal --out .".split(' ')).current_dir(&folder));
    assert_eq!(said.status, Some(1), "{said:#?}");
    assert!(said.stderr.contains("promise-broken: `ball`"), "{said:#?}");
    assert!(
        said.stderr.contains("the tick before had announced"),
        "{said:#?}"
    );
    assert!(
        said.stdout.contains("outside, announced: for "),
        "{said:#?}"
    );
    let summary = summary(&folder);
    let monitors = &summary["monitors"];
    assert_eq!(monitors["went_outside"]["verdict"], "seen");
    assert_eq!(monitors["went_outside"]["task"], "ball");
    assert_eq!(monitors["unannounced"]["verdict"], "never");
    assert_eq!(monitors["frozen_moves"]["verdict"], "not_watched");
    let log = Rows::of(&folder);
    let why = log.at("why");
    let announced = log
        .rows
        .iter()
        .filter(|row| row[why].contains("outside:ball"));
    assert_eq!(monitors["went_outside"]["ticks"], announced.count());
}

#[test]
fn limits_that_bind_are_told_joint_by_joint() {
    let folder = empty_folder("limits");
    fs::write(folder.join("ball.toml"), passing_ball(0.2)).unwrap();
    let said = done(&folder, "run ball.toml --robot ideal --out .");
    let summary = summary(&folder);
    let log = Rows::of(&folder);
    let why = log.at("why");
    let times = |code: &str| {
        let has = |row: &&Vec<String>| row[why].split('+').any(|other| other == code);
        log.rows.iter().filter(has).count() as f64 / 125.0
    };
    let joints = summary["monitors"]["joints"].as_array().unwrap();
    let mut limited = 0.0;
    for (nth, joint) in joints.iter().enumerate() {
        let name = joint["joint"].as_str().unwrap();
        let speed = times(&format!("speed:q{}", nth + 1));
        let acceleration = times(&format!("acceleration:q{}", nth + 1));
        let position = times(&format!("hold:limit/{name}"));
        assert_eq!(joint["speed_limited_s"], speed, "{name}");
        assert_eq!(joint["acceleration_limited_s"], acceleration, "{name}");
        assert_eq!(joint["position_limited_s"], position, "{name}");
        let line = said
            .lines()
            .find(|line| line.contains(&format!("limits of {name}:")));
        assert_eq!(
            line.is_some(),
            speed + acceleration + position > 0.0,
            "{said}"
        );
        limited += acceleration + position;
    }
    assert!(limited > 0.0, "limits bound: {said}");
    let report = fs::read_to_string(folder.join("report.html")).unwrap();
    assert!(
        report.contains("What else was watched") && report.contains("limit/shoulder_pan_joint")
    );
}

#[test]
fn run_without_incident_has_nothing_else_to_report() {
    let folder = empty_folder("nothing else");
    let line = format!(
        "run {} --robot ideal --out . --border land",
        paper("example1").display()
    );
    let said = done(&folder, &line);
    assert!(said.contains("nothing else to report"), "{said}");
    let monitors = &summary(&folder)["monitors"];
    for (name, monitor) in monitors.as_object().unwrap() {
        if !["joints", "mode_changes", "frozen_moves"].contains(&name.as_str()) {
            assert_eq!(monitor["verdict"], "never", "{name}");
        }
    }
}
