//! What `conik run` writes is what the contract says: the log, the summary, the report.

use std::fs;

use serde_json::{Value, json};

use super::process::{conik, done, empty_folder, ended, paper, repository};
use super::run_folder::{Rows, summary};

const HEADER: &str = "t_s,mode,active,waypoint,obstacle_a,obstacle_b,view,position_error,\
    tool_x_m,tool_y_m,tool_z_m,\
    q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,\
    qd1_rad_s,qd2_rad_s,qd3_rad_s,qd4_rad_s,qd5_rad_s,qd6_rad_s,\
    qdd1_rad_s2,qdd2_rad_s2,qdd3_rad_s2,qdd4_rad_s2,qdd5_rad_s2,qdd6_rad_s2";

const MEASURED: &str = ",q1_measured_rad,q2_measured_rad,q3_measured_rad,q4_measured_rad,\
    q5_measured_rad,q6_measured_rad";

#[test]
fn log_has_one_row_a_tick_under_the_header_of_the_contract() {
    let folder = empty_folder("log");
    let example = paper("example2");
    let example = example.display();
    done(&folder, &format!("run {example} --robot ideal --out ideal"));
    done(&folder, &format!("run {example} --fast --out emulator"));
    let ideal = Rows::of(&folder.join("ideal"));
    let emulated = Rows::of(&folder.join("emulator"));

    assert_eq!(ideal.header, format!("{HEADER},why"));
    assert_eq!(emulated.header, format!("{HEADER}{MEASURED},why"));
    for log in [&ideal, &emulated] {
        assert_eq!(log.rows.len(), 7501);
        log.assert_complete(125.0);
        assert_eq!(log.rows[0][0], "0.0");
        assert_eq!(log.rows[7500][0], "60.0");
    }
    for (k, (alone, emulated)) in ideal.rows.iter().zip(&emulated.rows).enumerate() {
        let (why, alone) = alone.split_last().unwrap();
        assert_eq!(
            *alone,
            emulated[..alone.len()],
            "row {k}: the arm changed the references"
        );
        assert_eq!(Some(why), emulated.last(), "row {k}");
    }
    let numbers = |row: &Vec<String>| row[4..row.len() - 1].to_vec();
    for cell in emulated.rows.iter().flat_map(numbers) {
        let value: f64 = cell.parse().unwrap();
        assert_eq!(format!("{value:?}"), cell, "not the shortest form");
        assert!(value.is_finite());
    }
    let start = [-48.0_f64, -158.0, -108.0, -90.0, -85.0, 0.0];
    for (joint, degrees) in start.into_iter().enumerate() {
        let q = ideal.numbers(&format!("q{}_rad", joint + 1))[0];
        assert!(
            (q - degrees.to_radians()).abs() < 1e-15,
            "joint {}",
            joint + 1
        );
    }
}

#[test]
fn log_says_why_each_tick_came_out_as_it_did() {
    let folder = empty_folder("why");
    let example = paper("example2");
    let line = "--robot ideal --mode-rule cone --border land --recursion siciliano-slotine";
    done(
        &folder,
        &format!("run {} {line} --out .", example.display()),
    );
    let log = Rows::of(&folder);
    let text = |name: &str| -> Vec<&str> {
        let at = log.at(name);
        log.rows.iter().map(|row| row[at].as_str()).collect()
    };
    let (all_active, why) = (text("active"), text("why"));
    let mut seen = std::collections::BTreeSet::new();
    for (k, (active, why)) in all_active.iter().zip(&why).enumerate() {
        let codes: Vec<&str> = why.split('+').filter(|code| !code.is_empty()).collect();
        let held = codes.iter().filter_map(|code| code.strip_prefix("hold:"));
        assert_eq!(
            held.collect::<Vec<_>>().join("+"),
            *active,
            "row {k}: {why}"
        );
        if active.is_empty() && k > 0 && !all_active[k - 1].is_empty() {
            assert!(why.contains("free:"), "row {k}: {why}");
        }
        seen.extend(
            codes
                .iter()
                .map(|code| code.split(':').next().unwrap().to_owned()),
        );
    }
    // Every code that occurs is explained.
    let manual = std::fs::read_to_string(repository().join("docs/output.md")).unwrap();
    for word in &seen {
        assert!(
            manual.contains(&format!("| `{word}")),
            "{word} is not explained"
        );
    }
    assert!(seen.contains("hold") && seen.contains("free") && seen.contains("corrected"));
}

#[test]
fn summary_agrees_with_the_log() {
    let folder = empty_folder("summary");
    let example = paper("example2");
    done(
        &folder,
        &format!("run {} --fast --out .", example.display()),
    );
    let (log, summary) = (Rows::of(&folder), summary(&folder));

    assert_eq!(summary["modes"], Value::from(log.modes()));
    assert!(
        log.modes().len() > 2,
        "a run without a change of mode shows nothing"
    );
    assert_eq!(summary["outcome"], json!({"kind": "completed"}));
    assert_eq!(summary["ended_at_s"], json!(60.0));
    for (name, worst_outside) in [
        (
            "obstacle_a",
            &(|value: f64| 0.18 - value) as &dyn Fn(f64) -> f64,
        ),
        ("obstacle_b", &|value| 0.15 - value),
        ("view", &|value| value - 0.2622),
    ] {
        let (values, task) = (log.numbers(name), &summary["tasks"][name]);
        let times = log.numbers("t_s");
        let most = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(f64::MIN, f64::max);
        assert_eq!(task["max"], most(&mut values.iter().copied()), "{name}");
        assert_eq!(
            task["min"],
            -most(&mut values.iter().map(|value| -value)),
            "{name}"
        );
        let worst = most(&mut values.iter().map(|value| worst_outside(*value)));
        let reported = task["worst_violation"].as_f64().unwrap();
        assert!(
            (reported - worst.max(0.0)).abs() < 1e-12,
            "{name}: {reported}, {worst}"
        );
        let first_inside = values
            .iter()
            .position(|value| worst_outside(*value) <= 0.0)
            .unwrap();
        assert_eq!(task["entered_set_s"], times[first_inside], "{name}");
    }
    let last_error = *log.numbers("position_error").last().unwrap();
    assert_eq!(summary["tasks"]["position"]["final_error"], last_error);
    let second_from = log
        .numbers("waypoint")
        .iter()
        .position(|index| *index == 1.0);
    let reached = summary["waypoints_reached_s"].as_array().unwrap();
    assert_eq!(reached.len(), 2);
    assert_eq!(reached[0], log.numbers("t_s")[second_from.unwrap()]);
    for joint in 0..6 {
        let last = *log.numbers(&format!("q{}_rad", joint + 1)).last().unwrap();
        assert_eq!(summary["final_q_rad"][joint], last);
    }
}

#[test]
fn summary_has_every_field_of_the_contract() {
    let folder = empty_folder("fields");
    let example = paper("example2");
    done(
        &folder,
        &format!(
            "run {} --robot ideal --duration-s 2 --out .",
            example.display()
        ),
    );
    let summary = summary(&folder);

    assert!(summary["format"].is_u64());
    assert!(summary["version"].is_string());
    assert!(summary["deadline_misses"].is_u64());
    assert_eq!(summary["waypoints_reached_s"], json!([null, null]));
    assert_eq!(summary["settings"]["robot"], "ideal");
    assert_eq!(
        summary["settings"]["scenario"]["control"]["duration_s"],
        2.0
    );
    for number in ["median", "p99", "max"] {
        assert!(summary["step_time_us"][number].is_f64(), "{number}");
    }
    for property in [
        "equality_converges",
        "inside_stays",
        "outside_never_worse",
        "entered_stays",
        "low_priority_excess",
    ] {
        let property = &summary["properties"][property];
        assert!(property["holds"].is_boolean() && property["worst"].is_f64());
        assert_eq!(property["at_s"].is_f64(), property["task"].is_string());
    }
    for task in ["obstacle_a", "obstacle_b", "view", "position"] {
        let task = summary["tasks"][task].as_object().unwrap();
        for key in ["min", "max", "worst_violation", "entered_set_s"] {
            assert!(task[key].is_f64() || task[key].is_null(), "{key}");
        }
    }
}

#[test]
fn options_override_the_file() {
    let folder = empty_folder("overrides");
    let example = paper("example1");
    done(
        &folder,
        &format!(
            "run {} --robot ideal --out . --rate-hz 250 --duration-s 1.5 --mode-rule border \
             --border freeze --recursion chiaverini",
            example.display()
        ),
    );
    let log = Rows::of(&folder);
    assert_eq!(log.rows.len(), 376);
    log.assert_complete(250.0);
    let control = &summary(&folder)["settings"]["scenario"]["control"];
    assert_eq!(control["rate_hz"], 250.0);
    assert_eq!(control["duration_s"], 1.5);
    assert_eq!(control["mode_rule"], "border");
    assert_eq!(control["border"], "freeze");
    assert_eq!(control["recursion"], "chiaverini");

    let line = "--robot ideal --out . --duration-s 1 --mode-rule cone --border land \
                --recursion siciliano-slotine";
    done(&folder, &format!("run {} {line}", example.display()));
    let control = &summary(&folder)["settings"]["scenario"]["control"];
    assert_eq!(control["mode_rule"], "cone");
    assert_eq!(control["border"], "land");
    assert_eq!(control["recursion"], "siciliano-slotine");
}

#[test]
fn every_scenario_of_the_paper_runs_and_says_where_its_report_is() {
    for name in ["example1", "example2", "example3"] {
        let folder = empty_folder(name);
        let example = paper(name);
        let line = format!("run {} --robot ideal --duration-s 5", example.display());
        let said = done(&folder, &line);
        let out = folder.join("out").join(name);
        assert!(
            said.contains(&format!("report: out/{name}/report.html\n")),
            "{said}"
        );
        assert!(
            fs::read_to_string(out.join("report.html"))
                .unwrap()
                .contains("</html>")
        );
        assert!(
            said.lines().all(|line| line.chars().count() <= 80),
            "{said}"
        );
    }
}

#[test]
fn quiet_run_says_nothing() {
    let folder = empty_folder("quiet");
    let line = "--fast --quiet --duration-s 1 --out .";
    let said = ended(
        conik(["run"])
            .arg(paper("example3"))
            .args(line.split(' '))
            .current_dir(&folder),
    );
    assert_eq!(said.status, Some(0));
    assert_eq!((said.stdout.as_str(), said.stderr.as_str()), ("", ""));
    assert!(folder.join("report.html").exists());
}

#[test]
fn names_with_spaces_and_accents_are_names_like_others() {
    let folder = empty_folder("größe 2");
    fs::copy(paper("example2"), folder.join("meine Übung.v2.toml")).unwrap();
    let options = ["--robot", "ideal", "--duration-s", "1"];
    let said = ended(
        conik(["run", "meine Übung.v2.toml"])
            .args(options)
            .current_dir(&folder),
    );
    assert_eq!(said.status, Some(0), "{said:#?}");
    assert!(
        said.stdout
            .contains("report: out/meine Übung.v2/report.html")
    );
    assert!(folder.join("out/meine Übung.v2/log.csv").exists());
}

#[test]
fn two_runs_at_once_do_not_touch_each_other() {
    let folder = empty_folder("two at once");
    let example = paper("example2");
    std::thread::scope(|scope| {
        for out in ["a", "b"] {
            let (folder, example) = (&folder, &example);
            let line = format!(
                "run {} --fast --duration-s 4 --out {out}",
                example.display()
            );
            scope.spawn(move || done(folder, &line));
        }
    });
    let log = |out: &str| fs::read(folder.join(out).join("log.csv")).unwrap();
    assert!(log("a") == log("b"), "the same run came out differently");
}
