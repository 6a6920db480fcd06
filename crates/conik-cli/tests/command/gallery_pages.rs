//! The pages of `docs/gallery`: what they say of a run is what the run does.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::process::{done, empty_folder, repository};
use super::run_folder::{Rows, summary};

/// A time on a page is rounded, and told a little after what happens then begins.
const TIME_TOLERANCE_S: f64 = 0.1;

/// GitHub shows no larger pictures well.
const MOST_BYTES_OF_A_PICTURE: u64 = 150_000;

fn pages_folder() -> PathBuf {
    repository().join("docs/gallery")
}

/// Name and text of every page but the index.
fn pages() -> Vec<(String, String)> {
    let entries = fs::read_dir(pages_folder()).unwrap();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.unwrap().file_name().into_string().ok())
        .filter_map(|file| file.strip_suffix(".md").map(str::to_owned))
        .filter(|name| name != "README")
        .collect();
    names.sort();
    let page = |name: String| {
        let path = pages_folder().join(format!("{name}.md"));
        (name, fs::read_to_string(path).unwrap())
    };
    names.into_iter().map(page).collect()
}

/// The cells of the rows of the table under the heading `title`.
fn table<'a>(page: &'a str, title: &str) -> Vec<Vec<&'a str>> {
    let (_, section) = page
        .split_once(&format!("\n## {title}\n"))
        .unwrap_or_else(|| panic!("no section \"{title}\""));
    let section = section.split("\n## ").next().unwrap();
    let rows = section.lines().filter(|line| line.starts_with('|')).skip(2);
    rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

/// What stands in backticks.
fn names(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// `12.5 s`, and how much one unit of its last digit is.
fn number(cell: &str) -> (f64, f64) {
    let digits = cell.split_whitespace().next().unwrap();
    let decimals = digits
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    let value = digits.replace('−', "-").parse().unwrap();
    (value, 10_f64.powi(-i32::try_from(decimals).unwrap()))
}

/// The sets that were active at some time around `at_s`.
fn active_around(run: &Value, at_s: f64) -> Vec<&str> {
    let modes = run["modes"].as_array().unwrap();
    let begins = |k: usize| modes[k]["t_s"].as_f64().unwrap();
    let ends = |k: usize| {
        if k + 1 < modes.len() {
            begins(k + 1)
        } else {
            f64::INFINITY
        }
    };
    (0..modes.len())
        .filter(|&k| begins(k) <= at_s + TIME_TOLERANCE_S && ends(k) >= at_s - TIME_TOLERANCE_S)
        .flat_map(|k| modes[k]["active"].as_array().unwrap())
        .map(|name| name.as_str().unwrap())
        .collect()
}

/// Rows `| 6.7 s | sets active then | waypoint 2: what happens |`.
fn assert_happens(name: &str, page: &str, run: &Value) {
    let rows = table(page, "What happens");
    assert!(rows.len() >= 3, "{name}: {rows:?}");
    let mut named = 0;
    for row in rows {
        let [at, active, what] = row[..] else {
            panic!("{name}: {row:?}")
        };
        let (at_s, _) = number(at);
        let around = active_around(run, at_s);
        for set in names(active) {
            assert!(around.contains(&set), "{name}: {row:?}, not {around:?}");
            named += 1;
        }
        if let Some(rest) = what.strip_prefix("waypoint ") {
            let digits = rest.split(|c: char| !c.is_ascii_digit()).next().unwrap();
            let waypoint: usize = digits.parse().unwrap();
            let reached = run["waypoints_reached_s"][waypoint - 1].as_f64().unwrap();
            assert!(
                (reached - at_s).abs() <= TIME_TOLERANCE_S,
                "{name}: {row:?}, not {reached}"
            );
        }
    }
    assert!(named >= 2, "{name} says of {named} sets when they are held");
}

/// Rows `| set | min 0.020 m | 3.9 s |`: its least or greatest value, and how long it was active.
fn assert_sets(name: &str, page: &str, run: &Value) {
    let rows = table(page, "Sets");
    assert!(!rows.is_empty(), "{name}");
    for row in rows {
        let [set, extreme, active] = row[..] else {
            panic!("{name}: {row:?}")
        };
        let set = names(set).next().unwrap();
        let task = &run["tasks"][set];
        let (which, value) = extreme.split_once(' ').unwrap();
        assert!(["min", "max"].contains(&which), "{name}: {row:?}");
        let active_s = &task["active_s"];
        for (said, seen) in [(number(value), &task[which]), (number(active), active_s)] {
            let (said, digit) = said;
            let seen = seen
                .as_f64()
                .unwrap_or_else(|| panic!("{name}: no set {set}"));
            assert!((said - seen).abs() <= digit, "{name}: {row:?}, not {seen}");
        }
        assert!(active_s.as_f64() > Some(0.0), "{name}: {set} is never held");
    }
}

fn assert_promises(name: &str, run: &Value) {
    for property in ["inside_stays", "outside_never_worse", "entered_stays"] {
        let property = &run["properties"][property];
        assert_eq!(property["holds"], true, "{name}: {property}");
    }
    let reached = run["waypoints_reached_s"].as_array().unwrap();
    assert!(reached.iter().all(Value::is_f64), "{name}: {reached:?}");
    for monitor in ["went_outside", "unannounced", "stood_still", "stuck"] {
        let monitor = &run["monitors"][monitor];
        assert_eq!(monitor["verdict"], "never", "{name}: {monitor}");
    }
}

/// Runs the scenario of a page in a folder of its own.
fn run(test: &str, name: &str) -> PathBuf {
    let folder = empty_folder(&format!("gallery page {test} {name}"));
    let path = repository().join(format!("scenarios/gallery/{name}.toml"));
    let line = format!("run {} --robot ideal --quiet --out .", path.display());
    done(&folder, &line);
    folder
}

#[test]
fn pages_say_what_their_runs_do() {
    let pages = pages();
    assert!(pages.len() >= 4, "{}", pages.len());
    for (name, page) in pages {
        assert!(
            page.contains(&format!("scenarios/gallery/{name}.toml")),
            "{name} says how it is to be repeated"
        );
        let run = summary(&run("said", &name));
        assert_promises(&name, &run);
        assert_happens(&name, &page, &run);
        assert_sets(&name, &page, &run);
    }
}

#[test]
fn index_has_every_scenario_and_every_page() {
    let index = fs::read_to_string(pages_folder().join("README.md")).unwrap();
    for entry in fs::read_dir(repository().join("scenarios/gallery")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        assert!(index.contains(&format!("`{file}`")), "{file} is not there");
    }
    for (name, page) in pages() {
        assert!(
            index.contains(&format!("({name}.md)")),
            "{name} is not linked"
        );
        assert!(page.contains(".svg)"), "{name} has no picture");
    }
}

#[test]
fn pictures_are_small_and_shown() {
    let mut texts: String = pages().into_iter().map(|(_, text)| text).collect();
    texts += &fs::read_to_string(pages_folder().join("README.md")).unwrap();
    for entry in fs::read_dir(pages_folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "svg") {
            let bytes = fs::metadata(&path).unwrap().len();
            assert!(
                bytes <= MOST_BYTES_OF_A_PICTURE,
                "{}: {bytes}",
                path.display()
            );
            let file = path.file_name().unwrap().to_str().unwrap();
            assert!(texts.contains(file), "{file} is shown nowhere");
        }
    }
}

#[test]
fn right_palm_stays_on_the_crate() {
    let page = fs::read_to_string(pages_folder().join("dual-arm-carry.md")).unwrap();
    assert!(page.contains("within 0.4 mm and 0.6 mrad"));
    let rows = Rows::of(&run("grip", "dual-arm-carry"));
    for (task, most) in [("grip_position", 0.4e-3), ("grip_orientation", 0.6e-3)] {
        let errors = rows.numbers(&format!("{task}_error")).into_iter();
        let worst = errors.fold(0.0, f64::max);
        assert!(worst <= most, "{task}: {worst}");
    }
}

/// At the second waypoint of the pouring arm only the cup has turned.
#[test]
fn arm_is_drawn_again_where_its_tool_has_turned() {
    let folder = run("turned", "pouring");
    done(&folder, "plot . --quiet --format svg");
    let reached = &summary(&folder)["waypoints_reached_s"][1];
    let picture = fs::read_to_string(folder.join("arm.svg")).unwrap();
    let title = picture.split("</title>").next().unwrap();
    let time = format!("{reached}\u{a0}s");
    assert!(title.contains(&time), "{title}, and not {time}");
}
