//! `conik run --explain T` says what a tick decided, in words that agree with the log.

use super::process::{conik, done, empty_folder, ended, paper};
use super::run_folder::Rows;

const DEFAULT_RULES: &str =
    "--mode-rule cone --border land --recursion siciliano-slotine --robot ideal --out .";

/// The last tick at or before 13.51 s, while the view is at its border.
#[test]
fn explanation_tells_of_the_tick_what_the_log_has() {
    let folder = empty_folder("explain");
    let example = paper("example2");
    let line = format!(
        "run {} {DEFAULT_RULES} --quiet --explain 13.51",
        example.display()
    );
    let said = done(&folder, &line);
    let log = Rows::of(&folder);
    let row = &log.rows[1688];
    assert!(
        said.contains("at 13.504 s (tick 1688, the last at or before 13.51 s)"),
        "{said}"
    );
    assert!(said.contains("waypoint 2 of 2, "), "{said}");
    assert_eq!(
        (&*row[0], &*row[2]),
        ("13.504", "obstacle_b+view"),
        "the run shows something"
    );
    assert!(
        said.contains(&format!("mode {}, active: obstacle_b + view", row[1])),
        "{said}"
    );
    let codes = row.last().unwrap();
    assert!(codes.starts_with("hold:obstacle_b+hold:view"), "{codes}");
    assert!(
        said.contains("- `view` is held at its greatest value: let go"),
        "{said}"
    );
    let value: f64 = row[log.at("obstacle_a")].parse().unwrap();
    let is_of = |line: &&str| line.trim().starts_with("obstacle_a");
    let line = said.lines().find(is_of).unwrap();
    assert!(line.contains(&format!("{value:.6} m")), "{line}");
    let inside = format!("{:.0}\u{a0}mm inside", 1e3 * (value - 0.18));
    assert!(line.ends_with(&inside), "{line}: {inside}");
    let error: f64 = row[log.at("position_error")].parse().unwrap();
    assert!(
        said.contains(&format!("error {:.0}\u{a0}mm", 1e3 * error)),
        "{said}"
    );
    assert!(
        said.contains("nothing limits the speed: the fastest joint is "),
        "{said}"
    );
    assert!(
        said.lines().all(|line| line.chars().count() <= 80),
        "{said}"
    );
}

#[test]
fn several_times_are_explained_in_the_order_asked_after_the_summary() {
    let folder = empty_folder("explain twice");
    let example = paper("example1");
    let line = "--duration-s 2 --explain 2 --explain 0 --explain 1.9999";
    let said = done(
        &folder,
        &format!("run {} {DEFAULT_RULES} {line}", example.display()),
    );
    let places: Vec<usize> = [
        "report: ",
        "at 2 s (tick 250)",
        "at 0 s (tick 0)",
        "at 1.992 s (tick 249",
    ]
    .iter()
    .map(|part| {
        said.find(part)
            .unwrap_or_else(|| panic!("no {part} in {said}"))
    })
    .collect();
    assert!(places.is_sorted(), "{said}");
}

#[test]
fn time_outside_the_run_is_refused_before_it_begins() {
    for time in ["-0.1", "2.01", "nan", "inf", "soon"] {
        let folder = empty_folder(&format!("explain {time}"));
        let options = [
            "--robot",
            "ideal",
            "--duration-s",
            "2",
            "--out",
            "out",
            "--explain",
            time,
        ];
        let said = ended(
            conik(["run"])
                .arg(paper("example1"))
                .args(options)
                .current_dir(&folder),
        );
        assert_eq!(said.status, Some(2), "{said:#?}");
        assert!(said.stderr.contains("--explain"), "{said:#?}");
        assert!(!folder.join("out").exists(), "it began all the same");
    }
}
