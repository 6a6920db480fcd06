//! The scenarios of `scenarios/gallery`: they do what their comments say.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::process::{done, empty_folder, repository};
use super::run_folder::summary;

fn gallery() -> PathBuf {
    repository().join("scenarios/gallery")
}

/// Runs a scenario of the gallery, changed by `change`, on the ideal arm; in a folder of the test's.
fn run(test: &str, name: &str, change: impl FnOnce(String) -> String) -> Value {
    let folder = empty_folder(&format!("gallery {test} {name}"));
    let text = fs::read_to_string(gallery().join(name)).unwrap();
    // The files that it names stay where they are.
    let robots = repository().join("robots");
    let text = text.replace("../../robots", robots.to_str().unwrap());
    fs::write(folder.join("scenario.toml"), change(text)).unwrap();
    done(&folder, "run scenario.toml --robot ideal --quiet --out .");
    summary(&folder)
}

fn changes(summary: &Value) -> usize {
    summary["modes"].as_array().unwrap().len() - 1
}

#[test]
fn every_scenario_reaches_its_goals_inside_its_sets() {
    let mut names: Vec<String> = fs::read_dir(gallery())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(names.len() >= 4, "{names:?}");
    let readme = fs::read_to_string(repository().join("README.md")).unwrap();
    for name in names {
        let summary = run("all", &name, |text| {
            for key in ["mode_rule", "border", "recursion"] {
                assert!(!text.contains(key), "{name} shows the defaults");
            }
            text
        });
        assert!(readme.contains(&name), "README.md does not mention {name}");
        for property in ["inside_stays", "entered_stays"] {
            let property = &summary["properties"][property];
            assert_eq!(property["worst"], 0.0, "{name}: {property}");
        }
        let reached = summary["waypoints_reached_s"].as_array().unwrap();
        assert!(reached.iter().all(Value::is_f64), "{name}: {reached:?}");
        let tasks = summary["tasks"].as_object().unwrap().values();
        let errors: Vec<f64> = tasks
            .filter_map(|task| task["final_error"].as_f64())
            .collect();
        assert!(!errors.is_empty(), "{name}");
        assert!(
            errors.iter().all(|&error| error < 1e-5),
            "{name}: {errors:?}"
        );
        assert!((1..=24).contains(&changes(&summary)), "{name}");
        assert_eq!(summary["landing"]["stood_still_ticks"], 0, "{name}");
    }
}

#[test]
fn joints_come_to_their_limits_and_the_ball_is_slid_along() {
    let limits = run("limits", "joint-limits.toml", |text| text);
    for joint in ["elbow", "wrist_2"] {
        assert!(limits["tasks"][joint]["active_s"].as_f64() > Some(1.0));
    }
    let behind = run("limits", "straight-behind.toml", |text| text);
    assert!(behind["tasks"]["ball"]["active_s"].as_f64() > Some(10.0));
    let forest = run("limits", "forest.toml", |text| text);
    let active = forest["tasks"].as_object().unwrap().values();
    let active = active.filter(|task| task["active_s"].as_f64() > Some(0.0));
    assert!(active.count() >= 5, "balls were in the way");
    let modes = forest["modes"].as_array().unwrap();
    let lifted = |mode: &Value| mode["active"].as_array().unwrap().len() == 2;
    assert!(modes.iter().any(lifted), "a ball and the ceiling");
}

#[test]
fn angles_heights_and_singularities_make_a_difference() {
    let active = |summary: &Value, task: &str| summary["tasks"][task]["active_s"].as_f64();
    let welding = run("types", "welding.toml", |text| text);
    assert!(active(&welding, "torch") > Some(1.0));
    let looking = run("types", "keep-looking.toml", |text| text);
    assert!(active(&looking, "picture") > Some(10.0));
    assert!(looking["tasks"]["picture"]["entered_set_s"].as_f64() > Some(1.0));
    let table = run("types", "above-the-table.toml", |text| text);
    for task in ["wrist", "dexterity"] {
        assert!(active(&table, task) > Some(1.0), "{task}");
    }
}

/// 40°, as its page says.
#[test]
fn elbow_of_seven_axes_drops_where_no_set_keeps_it_up() {
    let least = |summary: &Value| summary["tasks"]["elbow"]["min"].as_f64().unwrap();
    let border = -12_f64.to_radians();
    let kept = run("elbow", "pouring.toml", |text| text);
    assert!(
        (border..border + 1e-6).contains(&least(&kept)),
        "{}",
        least(&kept)
    );
    let left = run("elbow", "pouring.toml", |text| {
        let bounds = "\nmin_deg = -12\n";
        assert!(text.contains(bounds));
        text.replace(bounds, "\nmin_deg = -170\n")
    });
    let dropped = -40_f64.to_radians();
    assert!((least(&left) - dropped).abs() < 0.02, "{}", least(&left));
}

#[test]
fn links_slide_along_the_shelf_and_miss_each_other() {
    let shelf = run("shelf", "shelf.toml", |text| text);
    for (pair, distance) in [
        ("forearm/post", 0.02),
        ("wrist/board", 0.01),
        ("hand/post", 0.02),
        ("forearm/hand", 0.03),
    ] {
        let task = &shelf["tasks"][pair];
        assert!(task["active_s"].as_f64() > Some(0.5), "{pair}: {task}");
        let closest = task["min"].as_f64().unwrap();
        assert!(
            (distance..distance + 1e-6).contains(&closest),
            "{pair}: {closest}"
        );
    }
    let limit = &shelf["tasks"]["limit/elbow_joint"];
    assert!(limit["active_s"].as_f64() > Some(1.0), "{limit}");
    assert!(
        shelf["tasks"].get("upper_arm/forearm").is_none(),
        "neighbours"
    );
}

#[test]
fn tool_gives_way_to_the_ball_that_crosses_its_way() {
    let crossing = run("crossing", "crossing.toml", |text| text);
    assert!(crossing["tasks"]["ball"]["active_s"].as_f64() > Some(1.0));
    let closest = crossing["tasks"]["ball"]["min"].as_f64().unwrap();
    assert!((0.12..0.12 + 1e-4).contains(&closest), "it came: {closest}");
    // It is drawn where it was at the start and where it came to rest, 5.5 s later.
    let folder = empty_folder("gallery drawn");
    let path = gallery().join("crossing.toml");
    done(
        &folder,
        &format!("run {} --robot ideal --quiet --out .", path.display()),
    );
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    // Its radius, where it came to rest, and its way there.
    let moving = "0.12000,[[0.12740,-0.60695,-0.25000]],[-0.62260,-0.90695,0.00000]]";
    assert!(page.contains(moving));
    for label in ["ball, start", "ball, end"] {
        assert!(page.contains(label), "{label} is not drawn");
    }
    for monitor in ["went_outside", "unannounced", "stood_still"] {
        assert_eq!(
            crossing["monitors"][monitor]["verdict"], "never",
            "{monitor}"
        );
    }
}

#[test]
fn limited_accelerations_bind_and_are_kept_in_front_of_obstacles() {
    let limited = run("acceleration", "acceleration-limits.toml", |text| text);
    let joints = limited["monitors"]["joints"].as_array().unwrap();
    let bound = |joint: &Value| joint["acceleration_limited_s"].as_f64().unwrap();
    assert!(joints.iter().map(bound).sum::<f64>() > 0.1, "{joints:?}");
    let limit = 120_f64.to_radians();
    for joint in joints {
        let hardest = joint["hardest"].as_f64().unwrap();
        assert!(hardest <= limit * (1.0 + 1e-6), "{joint}");
    }
    for obstacle in ["obstacle_a", "obstacle_b"] {
        let task = &limited["tasks"][obstacle];
        assert!(task["active_s"].as_f64() > Some(1.0), "{task}");
    }
    let free = run("acceleration", "acceleration-limits.toml", |text| {
        let without = text
            .lines()
            .filter(|line| !line.starts_with("acceleration"));
        without.collect::<Vec<_>>().join("\n")
    });
    let hardest = free["monitors"]["joints"][0]["hardest"].as_f64();
    assert!(hardest > joints[0]["hardest"].as_f64(), "{hardest:?}");
}

#[test]
fn low_priority_view_is_left_and_comes_back() {
    let summary = run("left", "low-priority-view.toml", |text| text);
    let excess = &summary["properties"]["low_priority_excess"];
    assert!(excess["worst"].as_f64() > Some(0.1), "it is left: {excess}");
    let last = summary["tasks"]["view"]["active_s"].as_f64();
    assert!(last > Some(10.0), "{last:?}");
}

/// Folded in towards this point, the position task carries the view out, then in, by turns.
#[test]
fn low_priority_set_on_its_way_back_is_not_released_and_driven_by_turns() {
    let summary = run("back", "low-priority-view.toml", |text| {
        let (there, here) = ("0.25, 0.45, 0.00", "0.10, 0.45, 0.10");
        assert!(text.contains(there));
        text.replace(there, here)
    });
    assert!(changes(&summary) <= 6, "{}", changes(&summary));
}
