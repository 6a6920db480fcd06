//! A run that is watched: what clients of `/live` are told, and what they can do.

use std::fs;

use serde_json::{Value, json};

use super::process::{done, empty_folder, paper, patient, repository, wait_for};
use super::run_folder::{Rows, summary};
use super::watched::Watched;

#[test]
fn whoever_connects_is_told_everything_and_then_what_is_new() {
    let watched = Watched::scenario("greeting", &paper("example2"));
    let mut client = watched.client();
    let hello = client.next();
    assert_eq!(
        (&hello["kind"], &hello["protocol"]),
        (&json!("hello"), &json!(1))
    );
    let scene = client.next();
    assert_eq!(scene["kind"], "scene");
    assert_eq!(
        (&scene["live"], &scene["editable"]),
        (&json!(true), &json!(true))
    );
    assert_eq!(
        (&scene["name"], &scene["revision"]),
        (&json!("example2"), &json!(0))
    );
    assert_eq!(scene["robot"]["name"], "ur5-paper");
    let first = client.next();
    assert_eq!(
        (&first["kind"], &first["reset"]),
        (&json!("ticks"), &json!(true))
    );
    let state = client.next();
    assert_eq!(state["kind"], "state");
    assert_eq!(state["allowed"].as_array().unwrap().len(), 5);
    let more = client.wait(|it| it["kind"] == "ticks" && it["reset"] == false);
    let rows = more["t_s"].as_array().unwrap().len();
    for column in [
        "q1_rad",
        "qd6_rad_s",
        "tool_z_m",
        "position_error",
        "view",
        "waypoint",
    ] {
        assert_eq!(
            more["columns"][column].as_array().unwrap().len(),
            rows,
            "{column}"
        );
    }
    // One who comes later gets what has been.
    let mut late = watched.client();
    let all = late.of_kind("ticks");
    assert_eq!(all["t_s"][0], json!(0.0));
    let mut late_rows = late.wait(|it| it["kind"] == "ticks")["t_s"][0]
        .as_f64()
        .unwrap();
    late_rows -= all["t_s"]
        .as_array()
        .unwrap()
        .last()
        .unwrap()
        .as_f64()
        .unwrap();
    assert!(
        (late_rows - 0.008).abs() < 1e-9,
        "nothing is missing, nothing twice"
    );
}

#[test]
fn paused_run_steps_and_goes_on() {
    let watched = Watched::scenario("pause", &paper("example2"));
    let mut client = watched.client();
    client.of_kind("ticks");
    client.done(json!({"kind": "pause"}));
    client.wait(|it| it["kind"] == "state" && it["running"] == "paused");
    // Whatever was on its way has come when a later state says the same time twice.
    let at = |state: &Value| state["t_s"].as_f64().unwrap();
    let mut last = at(&client.of_kind("state"));
    let resting = loop {
        let now = at(&client.of_kind("state"));
        if now == last {
            break now;
        }
        last = now;
    };
    client.done(json!({"kind": "step", "ticks": 5}));
    let wanted = resting + 5.0 * 0.008;
    let there = client.wait(|it| it["kind"] == "state" && at(it) > wanted - 1e-9);
    assert!((at(&there) - wanted).abs() < 1e-9);
    assert!(
        (at(&client.of_kind("state")) - wanted).abs() < 1e-9,
        "and no further"
    );
    client.done(json!({"kind": "speed", "factor": 10}));
    client.done(json!({"kind": "resume"}));
    client.wait(|it| it["kind"] == "state" && at(it) > wanted + 0.5 && it["speed"] == 10.0);
    // What comes of it may be told before the answer.
    client.send(json!({"kind": "restart"}));
    let anew = client.wait(|it| it["kind"] == "ticks" && it["reset"] == true);
    assert!(
        anew["t_s"]
            .as_array()
            .unwrap()
            .first()
            .is_none_or(|t_s| *t_s == 0.0)
    );
    client.wait(|it| it["kind"] == "state" && it["running"] == "running" && at(it) > 0.1);
}

#[test]
fn changed_bound_is_kept_saved_and_taken_back() {
    let watched = Watched::scenario("change", &paper("example1"));
    let mut client = watched.client();
    client.done(json!({"kind": "speed", "factor": 10}));
    let changes = json!([
        {"control": "mode_rule", "value": "cone"},
        {"control": "border", "value": "land"},
        {"task": "obstacle_a", "key": "min", "value": 0.25, "speed": 0.05},
    ]);
    let revision = client.done(json!({"kind": "change", "changes": changes}));
    let at = |it: &Value| it["revision"].as_u64() >= Some(revision);
    client.column_until("t_s", |state| {
        at(state) && state["t_s"].as_f64() > Some(25.0)
    });
    let distances = client.column_until("obstacle_a", |state| state["t_s"].as_f64() > Some(40.0));
    assert!(distances.len() > 100);
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(
        (0.25 - 1e-7..0.252).contains(&least),
        "held where it now is: {least}"
    );
    let saved = client.ask(json!({"kind": "save"}));
    assert_eq!(
        (&saved["kind"], &saved["name"]),
        (&json!("text"), &json!("example1-edited.toml"))
    );
    let folder = empty_folder("live-saved");
    fs::write(folder.join("saved.toml"), saved["toml"].as_str().unwrap()).unwrap();
    let checked = done(&folder, "check saved.toml");
    assert!(checked.contains("0.25"), "{checked}");
    client.done(json!({"kind": "reset"}));
    let scene = &client.scene;
    assert_eq!(scene["robot"], Value::Null, "it is known");
    assert_eq!(scene["settings"]["mode_rule"], "paper");
    let state = client.wait(|it| it["kind"] == "state" && it["revision"].as_u64() > Some(revision));
    assert_eq!(state["edited"], false);
}

#[test]
fn dragged_obstacle_is_told_of_where_it_is_and_where_it_goes() {
    let shelf = repository().join("scenarios/gallery/shelf.toml");
    let watched = Watched::scenario("drag", &shelf);
    let mut client = watched.client();
    let scene = client.of_kind("scene");
    let obstacles = scene["obstacles"].as_array().unwrap();
    let post = obstacles.iter().find(|it| it["name"] == "post").unwrap();
    let key = ["center_m", "from_m"]
        .into_iter()
        .find(|key| post[*key].is_array())
        .unwrap();
    let mut changes = Vec::new();
    for key in ["center_m", "from_m", "to_m"] {
        if let Some(place) = post[key].as_array() {
            let x = place[0].as_f64().unwrap() + 0.01;
            let moved = json!([x, place[1], place[2]]);
            changes.push(json!({"obstacle": "post", "key": key, "value": moved, "speed": 0.005}));
        }
    }
    client.done(json!({"kind": "change", "changes": changes}));
    let moved = client.scene["obstacles"].as_array().unwrap();
    let moved = moved.iter().find(|it| it["name"] == "post").unwrap();
    let x = |it: &Value| it[key][0].as_f64().unwrap();
    assert!((x(moved) - x(post) - 0.01).abs() < 1e-12);
    let gliding = client.wait(|it| it["gliding"].as_array().is_some_and(|it| !it.is_empty()));
    let gliding = gliding["gliding"].as_array().unwrap();
    assert_eq!(gliding.len(), 1, "once for all of its pairs: {gliding:?}");
    assert_eq!(gliding[0]["name"], "post");
    assert!(gliding[0]["away_m"][0].as_f64().unwrap() < 0.0);
    client.wait(|it| it["kind"] == "ticks" && it["gliding"] == json!([]));
}

#[test]
fn watched_run_writes_what_was_changed_and_stays_until_it_is_interrupted() {
    let folder = empty_folder("live-run");
    let line = format!(
        "run {} --robot ideal --view --quiet --duration-s 3 --mode-rule cone --border land --out out",
        paper("example2").display()
    );
    let watched = Watched::start(&folder, &line);
    let mut client = watched.client();
    client.done(json!({"kind": "pause"}));
    let changes = json!([{"task": "position", "key": "gain_per_s", "value": 0.6}]);
    client.done(json!({"kind": "change", "changes": changes}));
    client.done(json!({"kind": "resume"}));
    let ended = client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    assert_eq!(ended["outcome"]["kind"], "completed");
    assert_eq!(ended["allowed"], json!([]));
    let told = wait_for("the summary", || {
        let told = summary(&folder.join("out"));
        (told["outcome"]["kind"] == "completed").then_some(told)
    });
    assert_eq!(told["changes"][0]["changes"], changes);
    assert!(told["changes"][0]["t_s"].as_f64().unwrap() >= 0.0);
    assert_eq!(told["settings"]["scenario"]["task"][3]["gain_per_s"], 0.3);
    assert_eq!(Rows::of(&folder.join("out")).rows.len(), 376);
    assert!(
        watched.client().of_kind("ticks")["t_s"]
            .as_array()
            .unwrap()
            .len()
            == 376
    );
    watched.process.signal("INT");
    assert_eq!(watched.process.wait().status, Some(0));
    // A replay has the task as it then was.
    let replayed = Watched::start(&folder, "view --quiet out");
    let recording = replayed.recording();
    let later = &recording["runs"][0]["later"];
    assert_eq!(later.as_array().unwrap().len(), 1);
    assert_eq!(later[0]["from_s"], told["changes"][0]["t_s"]);
    assert_eq!(later[0]["tasks"][3]["gain_per_s"], 0.6);
    assert_eq!(recording["runs"][0]["scene"]["tasks"][3]["gain_per_s"], 0.3);
}

#[test]
fn run_that_is_begun_anew_leaves_the_log_of_its_last_time() {
    let folder = empty_folder("live-restart");
    let example = patient(&folder);
    let line = format!(
        "run {} --view --quiet --duration-s 2 --out out",
        example.display()
    );
    let watched = Watched::start(&folder, &line);
    let mut client = watched.client();
    client.wait(|it| it["kind"] == "state" && it["t_s"].as_f64() > Some(0.5));
    // What comes of it may be told before the answer.
    client.send(json!({"kind": "restart"}));
    client.wait(|it| it["kind"] == "ticks" && it["reset"] == true);
    let ended = client.wait(|it| it["kind"] == "state" && it["running"] == "ended");
    assert_eq!(ended["outcome"]["kind"], "completed", "{ended}");
    wait_for("the summary", || {
        (summary(&folder.join("out"))["outcome"]["kind"] == "completed").then_some(())
    });
    let rows = Rows::of(&folder.join("out")).rows;
    assert_eq!(rows.len(), 251);
    watched.process.signal("INT");
    assert_eq!(watched.process.wait().status, Some(0));
}
