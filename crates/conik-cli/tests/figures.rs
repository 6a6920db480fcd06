//! What the figures of a run must show, also of strange runs.

mod invented_run;
mod svg_frame;

use std::fs;

use conik_cli::figure::{self, Run, sets};
use invented_run::{Invention, strange_runs};

const FILES: [&str; 8] = [
    "path.svg",
    "mode.svg",
    "sets.svg",
    "errors.svg",
    "joints.svg",
    "figure4.svg",
    "arm.svg",
    "cycles.svg",
];

/// Draws the run and returns the pictures in the order of [`FILES`].
fn drawn(name: &str, run: &Invention) -> Vec<String> {
    let dir = run.write(name);
    let written = figure::write_all(&dir).unwrap();
    // Of an arm that is not the scenario's robot nobody knows what it looks like.
    let known = |file: &&str| *file != "arm.svg" || run.joints == 6;
    let files = FILES.into_iter().filter(known).map(|file| dir.join(file));
    assert_eq!(written, files.collect::<Vec<_>>());
    written
        .iter()
        .map(|path| fs::read_to_string(path).unwrap())
        .collect()
}

/// Every attribute that places a mark is a number on or near the page.
fn assert_well_formed(svg: &str, what: &str) {
    assert!(
        svg.starts_with("<?xml") && svg.trim_end().ends_with("</svg>"),
        "{what}"
    );
    assert_eq!(svg_frame::faults(svg), [""; 0], "{what}");
    for tag in ["g", "text", "svg", "title"] {
        let opened =
            svg.matches(&format!("<{tag} ")).count() + svg.matches(&format!("<{tag}>")).count();
        assert_eq!(
            opened,
            svg.matches(&format!("</{tag}>")).count(),
            "{what}: <{tag}>"
        );
    }
    let links = svg.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    assert!(!links.contains("http"), "{what}: refers to elsewhere");
}

#[test]
fn each_panel_shows_what_it_is_for() {
    let [path, mode, sets, errors, joints, all, arm, cycles] =
        drawn("usual", &Invention::default()).try_into().unwrap();
    for label in [
        "x [m]",
        "y [m]",
        "z [m]",
        "base",
        "start",
        "obstacle_0",
        ">1<",
        ">2<",
        "url(#ball-0072B2)",
    ] {
        assert!(path.contains(label), "path: {label}");
    }
    for label in ["time [s]", "no set active", "obstacle_0"] {
        assert!(mode.contains(label), "mode: {label}");
    }
    for label in [
        "min 0.17",
        "max 0.2622",
        "distance [m]",
        "view error [-]",
        "entered 1.344\u{a0}s",
    ] {
        assert!(sets.contains(label), "sets: {label}");
        assert!(all.contains(label), "figure 4: {label}");
    }
    for label in ["error norm, log. [m]", "accepted below 0.02", ">1<", ">2<"] {
        assert!(errors.contains(label), "errors: {label}");
    }
    for label in ["position [rad]", "velocity [rad/s]", "joint_6"] {
        assert!(joints.contains(label), "joints: {label}");
    }
    for label in ["x [m]", "start", "1.8\u{a0}s", "obstacle_0", "<g opacity="] {
        assert!(arm.contains(label), "arm: {label}");
    }
    assert!(all.contains("tool path") && all.contains("active mode"));
    for label in [
        "time [µs]",
        "cycles, log.",
        "median 803",
        "longest 28000 µs",
        "1 beyond",
    ] {
        assert!(cycles.contains(label), "cycles: {label}: {cycles}");
    }
}

#[test]
fn the_field_of_view_comes_last() {
    let dir = Invention::default().write("order");
    let run = Run::load(&dir).unwrap();
    let names: Vec<&str> = sets::tasks(&run)
        .iter()
        .map(|task| task.name.as_str())
        .collect();
    assert_eq!(names, ["obstacle_0", "obstacle_1", "view"]);
}

#[test]
fn strange_runs_are_drawn_too() {
    for (name, run) in strange_runs() {
        for (nth, svg) in drawn(name, &run).iter().enumerate() {
            let what = format!("{name}: picture {nth}");
            assert_well_formed(svg, &what);
            assert!(svg.len() < 4_000_000, "{what} has {} bytes", svg.len());
        }
    }
}

#[test]
fn a_run_that_ended_early_says_so() {
    for (name, word) in [
        ("interrupted", "interrupted at 3.992\u{a0}s"),
        ("fault", "fault: link-lost at 3.992\u{a0}s"),
    ] {
        let (_, run) = strange_runs()
            .into_iter()
            .find(|run| run.0 == name)
            .unwrap();
        let pictures = drawn(&format!("early {name}"), &run);
        assert!(pictures[5].contains(word), "{name}");
    }
}

#[test]
fn a_flickering_run_shows_both_its_modes() {
    let run = Invention {
        flickers: true,
        rows: 20_000,
        ..Invention::default()
    };
    let dir = run.write("flickers");
    let run = Run::load(&dir).unwrap();
    assert!(run.flickers() && run.spans().len() == 20_000);
    let mut modes: Vec<usize> = run.drawable_spans().iter().map(|span| span.mode).collect();
    assert!(modes.len() < 1000);
    modes.dedup();
    assert_eq!(modes, [0, 1]);
}

#[test]
fn many_sets_have_a_chart_each() {
    let run = Invention {
        sets: 48,
        ..Invention::default()
    };
    let pictures = drawn("a chart each", &run);
    assert_eq!(pictures[2].matches(">min 0.17<").count(), 48);
}

#[test]
fn names_are_never_markup() {
    let run = Invention {
        set_name: "<b>&".into(),
        title: "<script>alert(1)</script>".into(),
        ..Invention::default()
    };
    for svg in drawn("markup", &run) {
        assert!(!svg.contains("<script") && !svg.contains("<b>"));
    }
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let run = Invention::default();
    assert_eq!(drawn("once", &run), drawn("twice", &run));
}

#[test]
fn a_folder_that_is_no_run_is_an_error_with_a_name() {
    let dir = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("nothing here");
    let error = figure::write_all(&dir).unwrap_err().to_string();
    assert!(
        error.contains("summary.json") && error.contains("folder of a run"),
        "{error}"
    );
    let dir = Invention {
        rows: 0,
        ..Invention::default()
    }
    .write("no rows");
    let error = figure::write_all(&dir).unwrap_err().to_string();
    assert!(
        error.contains("log.csv") && error.contains("no rows"),
        "{error}"
    );
}
