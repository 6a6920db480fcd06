//! What the figures of a run must show, also of strange runs.

mod invented_run;
mod svg_frame;

use std::fs;

use conik_cli::figure::scene::Scene;
use conik_cli::figure::{self, Resolution, Run, Wanted, sets};
use invented_run::{Invention, strange_runs};
use resvg::tiny_skia::Pixmap;

const FILES: [&str; 9] = [
    "path.svg",
    "mode.svg",
    "sets.svg",
    "errors.svg",
    "joints.svg",
    "figure4.svg",
    "arm.svg",
    "figure5.svg",
    "cycles.svg",
];

fn only_svg() -> Wanted {
    Wanted {
        png: None,
        ..Wanted::default()
    }
}

/// Draws the run and returns the pictures in the order of [`FILES`].
fn drawn(name: &str, run: &Invention) -> Vec<String> {
    let dir = run.write(name);
    let written = figure::write_all(&dir, &only_svg()).unwrap();
    // Of an arm that is not the scenario's robot nobody knows what it looks like.
    let known = |file: &&str| !["arm.svg", "figure5.svg"].contains(file) || run.joints == 6;
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
    let [path, mode, sets, errors, joints, all, arm, five, cycles] =
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
    for label in ["t = 0\u{a0}s", "colours of the paper", ">x<", ">y<", ">z<"] {
        assert!(five.contains(label), "figure 5: {label}");
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
fn the_arm_is_shown_at_the_times_asked_for() {
    let dir = Invention::default().write("times");
    let at = |at_s: &[f64]| {
        let wanted = Wanted {
            at_s: at_s.to_vec(),
            ..only_svg()
        };
        figure::write_all(&dir, &wanted).map_err(|error| error.to_string())
    };
    at(&[2.503, 0.0, 1.2]).unwrap();
    let five = fs::read_to_string(dir.join("figure5.svg")).unwrap();
    // Between two rows, the nearer one.
    let times = ["t = 0\u{a0}s", "t = 1.2\u{a0}s", "t = 2.504\u{a0}s"];
    let places: Vec<usize> = times.iter().filter_map(|time| five.find(time)).collect();
    assert!(places.len() == 3 && places.is_sorted(), "{places:?}");
    let arm = fs::read_to_string(dir.join("arm.svg")).unwrap();
    assert!(arm.contains("The arm at 0\u{a0}s, 1.2\u{a0}s, 2.504\u{a0}s,"));
    for bad in [-0.1, 4.0, f64::NAN, f64::INFINITY] {
        let error = at(&[1.0, bad]).unwrap_err();
        assert!(error.contains("from 0 s to 3.992 s"), "{error}");
    }
    assert!(at(&[1.0; 13]).unwrap_err().contains("at most 12"));
    let stranger = Invention {
        joints: 3,
        ..Invention::default()
    };
    let wanted = Wanted {
        at_s: vec![1.0],
        ..only_svg()
    };
    let error = figure::write_all(&stranger.write("times of a stranger"), &wanted).unwrap_err();
    assert!(error.to_string().contains("robot of this run is not known"));
}

#[test]
fn a_run_shown_until_a_time_has_its_path_until_then() {
    let run = Run::load(&Invention::default().write("until")).unwrap();
    let end = |run: &Run| Scene::of(run).ends().unwrap().1;
    let on_circle = |t_s: f64| [0.5 + 0.1 * t_s.cos(), 0.3 * t_s.sin(), -0.2];
    assert_eq!(end(&run), on_circle(3.992));
    assert_eq!(end(&run.until(1.0)), on_circle(1.0));
    assert!(run.is_whole() && !run.until(1.0).is_whole());
}

#[test]
fn pixels_have_the_colours_of_the_marks() {
    let dir = Invention::default().write("pixels");
    let wanted = Wanted {
        at_s: vec![1.0],
        png: Some(Resolution::Scale(3.0)),
        ..Wanted::default()
    };
    figure::write_all(&dir, &wanted).unwrap();
    let svg = fs::read_to_string(dir.join("figure5.svg")).unwrap();
    let png = Pixmap::decode_png(&fs::read(dir.join("figure5.png")).unwrap()).unwrap();
    let (_, cell) = svg.split_once("<g transform=\"translate(0 22)\">").unwrap();
    // The paper's: x, y, z of base and tool.
    for colour in ["#1a7f37", "#0550ae", "#d1242f"] {
        let heads = cell.split("<polygon points=\"").skip(1);
        let heads = heads.filter(|it| it.contains(&format!("fill=\"{colour}\"")));
        let mut count = 0;
        for head in heads {
            let (points, _) = head.split_once('"').unwrap();
            let numbers: Vec<f64> = points
                .split([' ', ','])
                .map(|number| number.parse().unwrap())
                .collect();
            let middle = |from: usize| numbers.iter().skip(from).step_by(2).sum::<f64>() / 3.0;
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let place = |value: f64| (3.0 * value) as u32;
            let pixel = png
                .pixel(place(middle(0)), place(middle(1) + 22.0))
                .unwrap();
            let painted = format!(
                "#{:02x}{:02x}{:02x}",
                pixel.red(),
                pixel.green(),
                pixel.blue()
            );
            assert_eq!(painted, colour, "{points}");
            count += 1;
        }
        assert_eq!(count, 2, "base and tool, {colour}");
    }
    let corner = png.pixel(1, 1).unwrap();
    assert_eq!((corner.red(), corner.alpha()), (255, 255), "white paper");
}

#[test]
fn the_same_run_gives_the_same_pixels() {
    let bytes = |name: &str| {
        let dir = Invention::default().write(name);
        let written = figure::write_all(&dir, &Wanted::default()).unwrap();
        let pictures = written.iter().filter(|it| it.extension().unwrap() == "png");
        pictures.map(|it| fs::read(it).unwrap()).collect::<Vec<_>>()
    };
    let once = bytes("pixels once");
    assert_eq!(once.len(), FILES.len());
    assert!(once == bytes("pixels twice"));
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
    let error = figure::write_all(&dir, &Wanted::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("summary.json") && error.contains("folder of a run"),
        "{error}"
    );
    let dir = Invention {
        rows: 0,
        ..Invention::default()
    }
    .write("no rows");
    let error = figure::write_all(&dir, &Wanted::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("log.csv") && error.contains("no rows"),
        "{error}"
    );
}
