//! The pictures of real runs: everything drawn is on them, and they stay small.

use std::fs;
use std::path::Path;

use super::process::{done, empty_folder, repository};
use crate::svg_frame;

/// Bytes of the largest picture of the scene, which opens at once and may stand in a page.
const LARGEST: usize = 150_000;

/// Runs a scenario on the ideal arm, plots it, and returns its picture of the arm.
fn pictures_are_right(name: &str, scenario: &str) -> String {
    let folder = empty_folder(&format!("pictures of {name}"));
    fs::write(folder.join("scenario.toml"), scenario).unwrap();
    done(&folder, "run scenario.toml --robot ideal --quiet --out .");
    let said = done(&folder, "plot . --format svg");
    let is_picture = |file: &&str| Path::new(file).extension().is_some_and(|it| it == "svg");
    for file in said.lines().filter(is_picture) {
        let svg = fs::read_to_string(folder.join(file)).unwrap();
        assert_eq!(svg_frame::faults(&svg), [""; 0], "{name}: {file}");
        let is_scene = ["./path.svg", "./arm.svg"].contains(&file);
        let size = svg.len();
        assert!(
            !is_scene || size < LARGEST,
            "{name}: {file} has {size} bytes"
        );
    }
    fs::read_to_string(folder.join("arm.svg")).unwrap()
}

#[test]
fn everything_in_the_gallery_is_on_its_pictures() {
    let robots = repository().join("robots");
    for entry in fs::read_dir(repository().join("scenarios/gallery")).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let text = text.replace("../../robots", robots.to_str().unwrap());
        // Fewer ticks, the same motion.
        let text = text.replace("rate_hz = 250", "rate_hz = 50");
        pictures_are_right(path.file_stem().unwrap().to_str().unwrap(), &text);
    }
}

#[test]
fn robots_of_every_kind_are_drawn_and_so_are_runs_without_motion() {
    let tasks = "[[task]]\nname = \"stay\"\ntype = \"posture\"\ngain_per_s = 1\n";
    for (robot, q0) in [
        ("model = \"ur5-paper\"", [0.0; 6].as_slice()),
        ("model = \"ur10e\"", &[10.0, -60.0, 80.0, -90.0, -90.0, 0.0]),
        (
            "model = \"panda\"",
            &[0.0, -30.0, 0.0, -120.0, 0.0, 100.0, 45.0],
        ),
        ("model = \"gen3\"", &[0.0; 7]),
        (
            "urdf = \"ROBOTS/rail-arm.urdf\"\ntool = \"gripper\"",
            &[0.0, 5.0, 5.0, 5.0, -60.0, 5.0, 30.0, 5.0],
        ),
    ] {
        for duration_s in [0.02, 1.0] {
            let robot = robot.replace("ROBOTS", repository().join("robots").to_str().unwrap());
            let scenario = format!(
                "[robot]\n{robot}\nq0_deg = {q0:?}\n\n[control]\nrate_hz = 50\n\
                 duration_s = {duration_s}\n\n{tasks}desired_deg = {q0:?}\n"
            );
            let arm = pictures_are_right("no motion", &scenario);
            assert!(arm.contains("The arm at 0\u{a0}s,"), "{robot}: drawn once");
            let drums = arm.matches("<ellipse ").count() + arm.matches("rotate(").count();
            assert!(drums > q0.len(), "{robot}: joints and links");
        }
    }
}

/// Of each shape one, beside the arm, around it and so far away that nothing else would be seen.
#[test]
fn shapes_of_every_size_fit_their_pictures() {
    for (name, scale) in [("tiny", 1e-3), ("usual", 0.1), ("vast", 30.0)] {
        let obstacles: String = [
            format!("type = \"sphere\"\ncenter_m = [{}, 0, 3]\nradius_m = {scale}", 20.0 * scale),
            format!("type = \"box\"\ncenter_m = [0, {}, 3]\nsize_m = [{scale}, {scale}, 0.01]", -20.0 * scale),
            format!("type = \"capsule\"\nfrom_m = [9, 9, 9]\nto_m = [9, 9, 9]\nradius_m = {}", 0.1 * scale),
            "type = \"half_space\"\npoint_m = [0, 0, -3]\nnormal = [0.1, 0, 1]".to_owned(),
            format!("type = \"sphere\"\ncenter_m = [-50, 0, {scale}]\nradius_m = 0.1\nvelocity_m_per_s = [0, {scale}, 0]"),
        ]
        .iter()
        .enumerate()
        .map(|(nth, it)| format!("[[obstacle]]\nname = \"obstacle_{nth}\"\n{it}\ndistance_m = 0\n\n"))
        .collect();
        let scenario = format!(
            "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -158, -108, -90, -85, 0]\n\n[control]\nrate_hz = 20\n\
             duration_s = 2\n\n[[shape]]\nname = \"hand\"\nlink = \"link_6\"\ntype = \"sphere\"\n\
             center_m = [0, 0, 0]\nradius_m = 0.05\n\n{obstacles}[[task]]\nname = \"position\"\n\
             type = \"position\"\ntarget_m = [0.4, 0.1, -0.2]\nvelocity_m_per_s = [0, 0.05, 0]\ngain_per_s = 1\n\n\
             [[task]]\nname = \"look\"\ntype = \"look_at\"\npoint_m = [0.4, 0.1, -9]\nmax = 0.2\ngain_per_s = 1\n"
        );
        pictures_are_right(name, &scenario);
    }
}

#[test]
fn poses_to_be_taken_show_how_the_tool_is_turned_there() {
    let arm = pictures_are_right(
        "poses",
        "[robot]\nmodel = \"ur5e\"\nq0_deg = [0, -90, -90, -90, 90, 0]\n\n[control]\nrate_hz = 20\n\
         duration_s = 8\n\n[[task]]\nname = \"pose\"\ntype = \"pose\"\n\
         waypoints_m = [[-0.5, -0.3, 0.3], [-0.4, 0.4, 0.3]]\n\
         waypoints_rpy_deg = [[180, 0, 0], [180, 30, 60]]\nacceptance_m = 0.02\n\
         acceptance_deg = 3\ngain_per_s = 1\n",
    );
    for colour in ["#d1242f", "#1a7f37", "#0550ae"] {
        let dashed = format!("stroke=\"{colour}\" stroke-width=\"1.3\"");
        assert_eq!(arm.matches(&dashed).count(), 2, "{colour}");
    }
}

#[test]
fn many_pairs_of_shapes_have_charts_only_if_they_came_to_their_limits() {
    let folder = empty_folder("pictures of pairs");
    let run = |count: usize| {
        let obstacle = |nth| {
            format!(
                "[[obstacle]]\nname = \"far_{nth}\"\ntype = \"sphere\"\ncenter_m = [9, 9, {nth}]\n\
                 radius_m = 0.1\ndistance_m = 0.1\n"
            )
        };
        let scenario = format!(
            "[robot]\nmodel = \"ur5-paper\"\nq0_rad = [0, -1, 1, 0, 0, 0]\n\n[control]\nduration_s = 0.1\n\n\
             [[shape]]\nlink = \"link_6\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\nradius_m = 0.05\n\n{}\
             [[task]]\nname = \"up\"\ntype = \"height\"\ndesired = 0.3\ngain_per_s = 1\n",
            (0..count).map(obstacle).collect::<String>()
        );
        fs::write(folder.join("scenario.toml"), scenario).unwrap();
        done(&folder, "run scenario.toml --robot ideal --quiet --out .");
        done(&folder, "plot . --quiet --format svg");
        let read = |file| fs::read_to_string(folder.join(file)).unwrap();
        (read("sets.svg"), read("report.html"))
    };
    let (sets, report) = run(12);
    assert!(sets.contains("link_6/far_11") && !report.contains("have no charts"));
    let (sets, report) = run(13);
    assert!(
        sets.contains("no set-based task that came to its limit"),
        "{sets}"
    );
    assert!(report.contains("13 pairs of shapes never came to their limits"));
}

#[test]
fn workspaces_are_drawn_whole() {
    let of = |bounds: &str| {
        let scenario = format!(
            "[robot]\nmodel = \"ur5e\"\nq0_deg = [0, -90, -90, -90, 90, 0]\n\n[control]\nrate_hz = 20\n\
             duration_s = 2\n\n[[task]]\nname = \"cell\"\ntype = \"workspace\"\n{bounds}\n\n[[task]]\n\
             name = \"position\"\ntype = \"position\"\ntarget_m = [-0.5, -0.3, 0.3]\ngain_per_s = 1\n"
        );
        let arm = pictures_are_right("workspace", &scenario);
        assert!(arm.contains(">cell</text>"), "{bounds}");
        arm.matches("stroke-dasharray=\"6 4\"").count()
    };
    assert_eq!(
        of("min_m = [-1.5, -1.2, 0.05]\nmax_m = [0.5, 1.2, 1.5]"),
        12,
        "edges"
    );
    assert_eq!(of("center_m = [0, 0, 0.2]\nradius_m = 1.6"), 1, "a circle");
}
