//! What the view shows of runs.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use conik_sim::arm::{ArmError, IdealArm};
use conik_sim::experiment::Experiment;
use conik_sim::record::Record;
use conik_sim::run;
use conik_sim::scenario::{Border, ModeRule, Scenario};
use conik_sim::summary::Outcome;
use ratatui_core::backend::TestBackend;
use ratatui_core::buffer::Buffer;
use ratatui_core::style::Color;
use ratatui_core::terminal::Terminal;

use super::course::{Course, PIECES};
use super::frame::{Looks, draw};
use super::ink::Ink;
use super::keys::Key;
use super::list::Row;
use super::scene::Scene;

/// A run with an ideal arm, up to the first tick of which `is_enough` says so.
fn run_until(scenario: &str, is_enough: impl Fn(&Scene, &Record) -> bool) -> (Scene, Course) {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut scenario = Scenario::load(scenarios.join(scenario)).unwrap();
    // What is held is then on its border, not a little outside.
    scenario.control.mode_rule = ModeRule::Cone;
    scenario.control.border = Border::Land;
    let experiment = Experiment::new(&scenario).unwrap();
    let scene = Scene::new(&scenario, &experiment, "ideal arm (q = q_ref)");
    let mut course = Course::default();
    let mut arm = IdealArm::at(experiment.q0);
    let mut sink = |record: Record| {
        course.take(&scene, &record);
        if is_enough(&scene, &record) {
            return Err(ArmError::new("enough", "the test has seen enough"));
        }
        Ok(())
    };
    run::run(experiment, &mut arm, &mut sink, &AtomicBool::new(false));
    (scene, course)
}

fn is_active(scene: &Scene, record: &Record, name: &str) -> bool {
    let task = scene.tasks.iter().find(|task| task.name == name).unwrap();
    record.active.contains(task.id)
}

fn drawn(
    (scene, course): &(Scene, Course),
    looks: &Looks,
    ink: Ink,
    (width, height): (u16, u16),
) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    let picture = |frame: &mut ratatui_core::terminal::Frame<'_>| {
        draw(frame.buffer_mut(), scene, course, looks, ink);
    };
    terminal.draw(picture).unwrap();
    terminal.backend().buffer().clone()
}

/// The lines on a screen of that size, spaces as spaces.
fn lines(shown: &(Scene, Course), looks: &Looks, size: (u16, u16)) -> Vec<String> {
    let buffer = drawn(shown, looks, Ink::None, size);
    let rows = buffer.content().chunks(usize::from(size.0));
    let line = |row: &[ratatui_core::buffer::Cell]| {
        let text: String = row.iter().map(ratatui_core::buffer::Cell::symbol).collect();
        text.replace('\u{a0}', " ").trim_end().to_owned()
    };
    rows.map(line).collect()
}

#[track_caller]
fn line_with<'a>(lines: &'a [String], what: &str) -> &'a str {
    let found = lines.iter().find(|line| line.contains(what));
    found.unwrap_or_else(|| panic!("no line with {what:?}:\n{}", lines.join("\n")))
}

const USUAL: (u16, u16) = (80, 24);

#[test]
fn held_set_is_marked_and_says_why() {
    let shown = run_until("paper/example2.toml", |scene, record| {
        is_active(scene, record, "obstacle_a") && record.t_s > 2.0
    });
    let lines = lines(&shown, &Looks::default(), USUAL);
    let held = line_with(&lines, " 1 ■ obstacle_a");
    assert!(held.contains("≥ 0.18 m"), "{held}");
    assert!(held.contains('◆'), "its value is on its bound: {held}");
    assert!(held.ends_with("HELD at least"), "{held}");
    let inside = line_with(&lines, " 2 · obstacle_b");
    assert!(inside.contains("inside by"), "{inside}");
    line_with(
        &lines,
        "obstacle_a, ≥ 0.18 m: Held at its least allowed value.",
    );
    line_with(&lines, "waypoint 1 of 2");
}

#[test]
fn set_that_is_not_active_is_not_held() {
    let shown = run_until("paper/example2.toml", |_, record| record.tick == 0);
    let lines = lines(&shown, &Looks::default(), USUAL);
    line_with(&lines, " 1 · obstacle_a");
    assert!(
        !lines.iter().any(|line| line.contains("HELD")),
        "{lines:#?}"
    );
}

#[test]
fn joint_limits_stand_in_one_line_until_they_are_opened() {
    let mut shown = run_until("gallery/shelf.toml", |_, record| record.tick == 0);
    // None is active, whatever the start.
    if let Some(record) = &mut shown.1.record {
        record.active = conik::ActiveSet::EMPTY;
    }
    let mut looks = Looks::default();
    let folded = lines(&shown, &looks, (100, 40));
    let limits = shown.0.tasks.iter();
    let count = limits.filter(|it| it.kind == Some("joint limits")).count();
    assert!(count > 3);
    line_with(
        &folded,
        &format!("▸ 1–{count} {count} joint limits  · all inside"),
    );
    assert!(!folded.iter().any(|line| line.contains("· limit/")));
    Key::Open.press(&mut looks, &shown.0, &shown.1);
    let open = lines(&shown, &looks, (100, 40));
    let members = open.iter().filter(|line| line.contains("· limit/"));
    assert_eq!(members.count(), count, "{open:#?}");
    Key::Open.press(&mut looks, &shown.0, &shown.1);
    assert_eq!(lines(&shown, &looks, (100, 40)), folded);
}

#[test]
fn held_task_of_a_folded_group_shows() {
    let shown = run_until("gallery/shelf.toml", |scene, record| {
        let tasks = scene.tasks.iter();
        let mut pairs = tasks.filter(|task| task.kind == Some("shapes kept apart"));
        pairs.any(|task| record.active.contains(task.id))
    });
    let lines = lines(&shown, &Looks::default(), (100, 40));
    line_with(&lines, "1 HELD");
    let held = lines.iter().filter(|line| line.contains("HELD at least"));
    assert_eq!(held.count(), 1, "{lines:#?}");
}

#[test]
fn narrow_terminal_keeps_states_whole_and_tells_of_the_selected_task_what_is_asked() {
    let shown = run_until("paper/example2.toml", |scene, record| {
        is_active(scene, record, "obstacle_a") && record.t_s > 2.0
    });
    let lines = lines(&shown, &Looks::default(), (60, 24));
    let held = line_with(&lines, " 1 ■ obstacle_a");
    assert!(held.ends_with("HELD at least"), "{held}");
    assert!(!held.contains('≥'), "{held}");
    assert!(held.contains('◆'), "{held}");
    line_with(&lines, "obstacle_a, ≥ 0.18 m:");
}

#[test]
fn without_colour_no_cell_has_one() {
    let shown = run_until("paper/example2.toml", |scene, record| {
        is_active(scene, record, "obstacle_a") && record.t_s > 2.0
    });
    let colours = |ink| {
        let buffer = drawn(&shown, &Looks::default(), ink, USUAL);
        let mut cells = buffer.content().iter();
        cells.any(|cell| cell.fg != Color::Reset || cell.bg != Color::Reset)
    };
    assert!(!colours(Ink::None));
    assert!(colours(Ink::Indexed));
    assert!(colours(Ink::Full));
}

#[test]
fn modes_are_told_apart_by_letters_in_the_order_of_occurrence() {
    let shown = run_until("paper/example2.toml", |scene, record| {
        is_active(scene, record, "obstacle_a") && record.t_s > 3.0
    });
    let lines = lines(&shown, &Looks::default(), USUAL);
    let strip = line_with(&lines, "mode  ");
    let mut letters: Vec<char> = strip["mode  ".len()..].chars().collect();
    letters.dedup();
    let first = letters.iter().position(|letter| *letter == 'A').unwrap();
    let second = letters.iter().position(|letter| *letter == 'B');
    assert!(second.is_none_or(|second| first < second), "{strip}");
    let now = line_with(&lines, "now   ");
    assert!(now.contains("obstacle_a"), "{now}");
    // What has not been yet is empty.
    assert!(strip.chars().count() < 60, "{strip}");
}

#[test]
fn fault_is_told_by_name_and_sentence() {
    let mut shown = run_until("paper/example2.toml", |_, record| record.tick == 9);
    shown.1.outcome = Some(Outcome::Fault {
        name: "link-lost".to_owned(),
        detail: "no package for 0.1 s".to_owned(),
    });
    let lines = lines(&shown, &Looks::default(), USUAL);
    line_with(&lines, "FAULT link-lost");
    line_with(&lines, "no package for 0.1 s");
    line_with(&lines, "q leave");
}

#[test]
fn frozen_view_stays_and_says_that_the_arm_does_not() {
    let before = run_until("paper/example2.toml", |_, record| record.tick == 100);
    let mut looks = Looks::default();
    Key::Freeze.press(&mut looks, &before.0, &before.1);
    let after = run_until("paper/example2.toml", |_, record| record.tick == 500);
    let frozen = lines(&after, &looks, USUAL);
    line_with(&frozen, "0.80 of 60 s");
    line_with(&frozen, "the arm is NOT");
    Key::Freeze.press(&mut looks, &after.0, &after.1);
    line_with(&lines(&after, &looks, USUAL), "4.00 of 60 s");
}

#[test]
fn selected_line_is_always_on_the_screen() {
    let shown = run_until("gallery/shelf.toml", |_, record| record.tick == 0);
    let mut looks = Looks::default();
    Key::Open.press(&mut looks, &shown.0, &shown.1);
    for _ in 0..2 * shown.0.tasks.len() {
        let lines = lines(&shown, &looks, (80, 16));
        line_with(&lines, ">");
        Key::Down.press(&mut looks, &shown.0, &shown.1);
    }
    assert_eq!(looks.selected, Row::Task(shown.0.tasks.len() - 1));
}

#[test]
fn any_size_is_drawn() {
    let shown = run_until("gallery/shelf.toml", |_, record| record.tick == 50);
    for width in [1, 2, 5, 7, 20, 40, 59, 76, 80, 200] {
        for height in [1, 2, 3, 5, 10, 19, 20, 60] {
            for has_help in [false, true] {
                let looks = Looks {
                    has_help,
                    ..Looks::default()
                };
                drawn(&shown, &looks, Ink::Full, (width, height));
            }
        }
    }
}

#[test]
fn whole_run_takes_a_bounded_memory_and_fills_its_strip() {
    let shown = run_until("paper/example2.toml", |_, _| false);
    assert_eq!(shown.1.pieces.len(), PIECES);
    let lines = lines(&shown, &Looks::default(), USUAL);
    assert_eq!(line_with(&lines, "mode  ").chars().count(), 80);
    line_with(&lines, "60.00 of 60 s");
}
