//! Every mistake in what a user gives is told with its place, and the exit status is 2.

use std::fs;
use std::path::Path;

use super::process::{Said, conik, empty_folder, ended, paper, say};

/// A line of example 2 and what is written in its place; the line and key that must be named.
struct Case {
    good: &'static str,
    bad: &'static str,
    line: usize,
    key: &'static str,
    says: &'static str,
}

const fn case(
    good: &'static str,
    bad: &'static str,
    line: usize,
    key: &'static str,
    says: &'static str,
) -> Case {
    Case {
        good,
        bad,
        line,
        key,
        says,
    }
}

#[rustfmt::skip]
const CASES: &[Case] = &[
    case("rate_hz = 125", "rate = 125", 9, "control.rate", "did you mean `rate_hz`?"),
    case("rate_hz = 125", "rate_hz = \"fast\"", 9, "control.rate_hz", "expected a number"),
    case("rate_hz = 125", "rate_hz = 0", 9, "control.rate_hz", "from 1 to 10000 Hz"),
    case("rate_hz = 125", "rate_hz = -125", 9, "control.rate_hz", "-125 is out of range"),
    case("rate_hz = 125", "rate_hz = 1e12", 9, "control.rate_hz", "out of range"),
    case("rate_hz = 125", "rate_hz = nan", 9, "control.rate_hz", "not a finite number"),
    case("rate_hz = 125", "rate_hz = 125 Hz", 9, "control.rate_hz", "not valid TOML"),
    case("duration_s = 60", "duration_s = 0", 10, "control.duration_s", "more than 0"),
    case("duration_s = 60", "duration_s = -1", 10, "control.duration_s", "out of range"),
    case("duration_s = 60", "duration_s = 1e9", 10, "control.duration_s", "at most 86400 s"),
    case("duration_s = 60", "duration_s = inf", 10, "control.duration_s", "not a finite number"),
    case("model = \"ur5-paper\"", "model = \"kuka\"", 5, "robot.model", "unknown robot"),
    case("model = \"ur5-paper\"", "", 4, "robot.model", "missing"),
    case("q0_deg = [-48, ", "q0_deg = [", 6, "robot.q0_deg", "has 6 joints, found 5"),
    case("q0_deg = [-48, ", "q0_deg = [-inf, ", 6, "robot.q0_deg[1]", "not a finite number"),
    case("[\"obstacle_a\", \"obstacle_b\"]", "[\"obstacle_a\", \"obstacle_c\"]", 14, "control.exclusive[1][2]", "there is no task \"obstacle_c\""),
    case("min = 0.18", "min = nan", 20, "task[1] \"obstacle_a\".min", "not a finite number"),
    case("min = 0.18", "min = 0.2\nmax = 0.1", 20, "task[1] \"obstacle_a\".min", "greater than max"),
    case("min = 0.18", "", 16, "task[1] \"obstacle_a\"", "`min` and/or `max`"),
    case("name = \"obstacle_b\"", "name = \"obstacle_a\"", 23, "task[2] \"obstacle_a\".name", "this name already"),
    case("direction = [1, 0, 0]", "direction = [0, 0, 0]", 31, "task[3] \"view\".direction", "zero vector"),
    case("waypoints_m = [[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]]", "waypoints_m = []", 37, "task[4] \"position\".waypoints_m", "the list is empty"),
    case("gain_per_s = 0.3", "", 34, "task[4] \"position\".gain_per_s", "needs a gain"),
];

/// Bad input is told on standard error alone, nothing is written, the status is 2.
#[track_caller]
fn assert_refused(said: &Said, folder: &Path) {
    assert_eq!(said.status, Some(2), "{said:#?}");
    assert_eq!(said.stdout, "");
    assert!(!folder.join("out").exists(), "a run was begun");
}

#[test]
fn mistake_in_a_scenario_is_told_with_file_line_and_key() {
    let folder = empty_folder("mistakes");
    let good = fs::read_to_string(paper("example2")).unwrap();
    let mut failures = vec![];
    for case in CASES {
        assert!(
            good.contains(case.good),
            "{} is not in the example",
            case.good
        );
        fs::write(
            folder.join("bad.toml"),
            good.replacen(case.good, case.bad, 1),
        )
        .unwrap();
        for command in ["check bad.toml", "run bad.toml --robot ideal --quiet"] {
            let said = say(&folder, command);
            assert_refused(&said, &folder);
            let place = format!("bad.toml:{}:", case.line);
            let parts = [place.as_str(), case.key, case.says];
            if !parts.iter().all(|part| said.stderr.contains(part)) {
                failures.push(format!("{parts:?} are not all in:\n{}", said.stderr));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn all_mistakes_are_told_at_once() {
    let folder = empty_folder("many mistakes");
    let mut text = fs::read_to_string(paper("example2")).unwrap();
    for (good, bad) in [
        ("rate_hz = 125", "rate_hz = 0"),
        ("min = 0.15", "mni = 0.15"),
    ] {
        text = text.replace(good, bad);
    }
    fs::write(folder.join("bad.toml"), text).unwrap();
    let said = say(&folder, "run bad.toml");
    assert_refused(&said, &folder);
    assert!(
        said.stderr.contains("bad.toml:9:") && said.stderr.contains("`min`"),
        "{said:#?}"
    );
}

#[test]
fn file_that_is_no_scenario_is_named() {
    let folder = empty_folder("no scenario");
    // 10 MB, the same each time, of every byte there is.
    let noise: Vec<u8> = (0..10_000_000_u32)
        .map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()[1])
        .collect();
    let letters: Vec<u8> = noise[..3_000_000]
        .iter()
        .map(|byte| b' ' + byte % 95)
        .collect();
    fs::write(folder.join("noise.toml"), &noise).unwrap();
    fs::write(folder.join("bytes.toml"), &noise[..1000]).unwrap();
    fs::write(folder.join("letters.toml"), letters).unwrap();
    fs::write(folder.join("brackets.toml"), "[".repeat(1_000_000)).unwrap();
    fs::write(folder.join("empty.toml"), "").unwrap();
    fs::create_dir(folder.join("folder.toml")).unwrap();
    for name in [
        "noise", "bytes", "letters", "brackets", "empty", "folder", "absent",
    ] {
        let said = say(&folder, &format!("run {name}.toml"));
        assert_refused(&said, &folder);
        assert!(
            said.stderr.contains(&format!("{name}.toml:")),
            "{name}: {said:#?}"
        );
        assert!(said.stderr.len() < 2000, "{name} fills the screen");
    }
}

#[test]
fn bad_option_is_named() {
    let folder = empty_folder("options");
    for (options, says) in [
        ("--rate-hz 0", "--rate-hz: 0 is out of range"),
        ("--rate-hz 0.5", "--rate-hz"),
        ("--rate-hz nan", "--rate-hz: NaN"),
        ("--rate-hz 2000", "1 to 1000"),
        ("--duration-s 0", "--duration-s: 0 is out of range"),
        ("--duration-s -1", "--duration-s: -1 is out of range"),
        ("--duration-s inf", "--duration-s: inf"),
        ("--duration-s nan", "--duration-s: NaN"),
        (
            "--duration-s 0.007",
            "--duration-s: 0.007 s are shorter than one control period at 125 Hz",
        ),
        (
            "--duration-s 86400 --rate-hz 10000",
            "--duration-s: 86400 s at 10000 Hz",
        ),
        ("--mode-rule papr", "--mode-rule: there is no `papr`"),
        ("--border soft", "--border: there is no `soft`"),
        ("--recursion none", "--recursion: there is no `none`"),
        ("--robot 127.0.0.1 --port-offset 65535", "--port-offset"),
        ("--robot 127.0.0.1 --fast", "--fast"),
        ("--from-here", "stands at the scenario's start"),
        (
            "--robot ideal --from-here",
            "--from-here: the arm of --robot ideal",
        ),
    ] {
        let said = ended(
            conik(["run"])
                .arg(paper("example2"))
                .args(options.split(' '))
                .current_dir(&folder),
        );
        assert_refused(&said, &folder);
        assert!(said.stderr.contains(says), "{options}: {}", said.stderr);
    }
}

#[test]
fn arm_that_a_series_does_not_have_is_refused_with_those_that_it_has() {
    let folder = empty_folder("no such arm");
    for (options, says) in [
        ("--model ur20 --series cb3", "there are ur3, ur5, ur10"),
        ("--model ur6", "ur16e, ur20, ur30"),
        ("--model arm", "--model arm: no such arm"),
    ] {
        let said = say(&folder, &format!("emulate {options}"));
        assert_refused(&said, &folder);
        assert!(said.stderr.contains(says), "{options}: {}", said.stderr);
    }
}

#[test]
fn option_that_spoils_another_key_names_that_key() {
    let folder = empty_folder("spoiling option");
    let text = fs::read_to_string(paper("example2")).unwrap();
    fs::write(
        folder.join("a.toml"),
        text.replace("gain_per_s = 0.3", "gain_per_s = 3"),
    )
    .unwrap();
    let said = say(&folder, "run a.toml --rate-hz 1");
    assert_refused(&said, &folder);
    assert!(
        said.stderr.contains("task[4] \"position\".gain_per_s"),
        "{said:#?}"
    );
}
