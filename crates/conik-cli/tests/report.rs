//! What the report of a run must say, and that it needs nothing but itself.

mod invented_run;
mod svg_frame;

use std::fs;
use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use conik_cli::{report, view};
use conik_sim::summary::Outcome;
use flate2::read::GzDecoder;
use invented_run::{Invention, strange_runs};
use serde_json::Value;
use sha2::{Digest, Sha256};

fn reported(name: &str, run: &Invention) -> String {
    let dir = run.write(&format!("report of {name}"));
    let path = report::write(&dir).unwrap();
    assert_eq!(path, dir.join("report.html"));
    fs::read_to_string(path).unwrap()
}

/// What an element of that name has in it, packed.
fn unpacked(page: &str, id: &str) -> String {
    let start = format!("<script type=\"application/gzip\" id=\"{id}\">");
    let (_, rest) = page.split_once(&start).unwrap();
    let (packed, _) = rest.split_once("</script>").unwrap();
    let bytes = STANDARD.decode(packed).unwrap();
    let mut text = String::new();
    GzDecoder::new(&bytes[..])
        .read_to_string(&mut text)
        .unwrap();
    text
}

/// The run in a page, for its replay.
fn recording(page: &str) -> Value {
    serde_json::from_str(&unpacked(page, "recording")).unwrap()
}

#[test]
fn the_page_tells_the_run_in_the_papers_order() {
    let page = reported("the usual", &Invention::default());
    let order = [
        "<h1>An invented run</h1>",
        "Completed",
        "Waypoint 1 reached at 0.8\u{a0}s, waypoint 2 reached at 1.8\u{a0}s.",
        "Path of the tool",
        "The arm at a few times",
        "Mode over time",
        "Set-based tasks and their limits",
        "Errors of the equality tasks",
        "Tasks, the most important first",
        "The five properties",
        "Step time and tracking",
        "The arm ran 104.2 ms behind its reference",
        "Largest, less the delay",
        "Cycles of the arm",
        "2 cycles were missed, 0 repeated.",
        "Histogram",
        "Mode changes",
        "Settings",
    ];
    let places: Vec<usize> = order
        .iter()
        .map(|words| {
            page.find(words)
                .unwrap_or_else(|| panic!("`{words}` is missing"))
        })
        .collect();
    assert!(places.is_sorted(), "{places:?}");
}

#[test]
fn the_page_needs_nothing_but_itself() {
    let page = reported("itself", &Invention::default());
    for reference in [
        "http:", "https:", " src=", "@import", "<link", "url(h", "//cdn",
    ] {
        assert!(!page.contains(reference), "{reference}");
    }
}

#[test]
fn the_replay_is_the_page_of_view_with_the_run_in_it() {
    let page = reported("replayed", &Invention::default());
    assert!(unpacked(&page, "player") == view::PAGE);
    let recording = recording(&page);
    let run = &recording["runs"][0];
    assert_eq!(recording["kind"], "recording");
    assert_eq!(run["name"], "report of replayed");
    assert_eq!(run["scene"]["title"], "An invented run");
    let columns = run["ticks"]["columns"].as_object().unwrap();
    // The figures show no accelerations, the replay does.
    for name in ["tool_x_m", "q6_rad", "qdd6_rad_s2"] {
        assert_eq!(columns[name].as_array().unwrap().len(), 500, "{name}");
    }
}

#[test]
fn only_scripts_of_the_page_may_run() {
    let page = reported("policy", &Invention::default());
    let (_, policy) = page
        .split_once("\"Content-Security-Policy\" content=\"")
        .unwrap();
    let (policy, _) = policy.split_once('"').unwrap();
    assert!(policy.starts_with("default-src 'none'; script-src 'sha256-"));
    let scripts: Vec<&str> = page.split("<script>").skip(1).collect();
    let player = unpacked(&page, "player");
    let (_, of_player) = player.rsplit_once("<script type=\"module\">").unwrap();
    assert_eq!(scripts.len(), 2);
    for script in scripts.into_iter().chain([of_player]) {
        let (script, _) = script.split_once("</script>").unwrap();
        let digest = STANDARD.encode(Sha256::digest(script));
        let rule = format!("'sha256-{digest}'");
        assert!(policy.contains(&rule), "{rule} is not in {policy}");
    }
    assert_eq!(policy.matches("sha256-").count(), 3);
}

#[test]
fn a_long_run_gives_a_report_that_can_be_mailed() {
    let run = Invention {
        rows: 25_000,
        ..Invention::default()
    };
    let page = reported("a long run", &run);
    assert_eq!(recording(&page)["runs"][0]["ticks"]["every"], 3);
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
}

#[test]
fn a_robot_that_nobody_knows_has_a_report_without_a_replay() {
    let dir = Invention::default().write("report of a stranger");
    let summary = dir.join("summary.json");
    let text = fs::read_to_string(&summary).unwrap();
    fs::write(&summary, text.replace("ur5-paper", "nobody's arm")).unwrap();
    let page = fs::read_to_string(report::write(&dir).unwrap()).unwrap();
    assert!(page.contains("This run cannot be replayed here: "));
    assert!(page.contains("nobody&#39;s arm") && page.contains("Path of the tool"));
    assert!(!page.contains("Replay in 3-D") && !page.contains("application/gzip"));
}

#[test]
fn moments_lead_to_the_replay() {
    let page = reported("moments", &Invention::default());
    // A change of mode, and the worst of a property.
    assert!(page.contains("<span data-t=\"0.0000\">0\u{a0}s</span>"));
    assert!(page.contains("<span data-t=\"1.5000\">1.5\u{a0}s</span>"));
    // Without a script nothing promises what it cannot keep.
    assert!(page.contains("<nav id=\"views\" aria-label=\"Views\" hidden>"));
}

#[test]
fn every_mark_is_on_its_picture() {
    for (name, run) in strange_runs() {
        let page = reported(&format!("marks of {name}"), &run);
        let pictures: Vec<&str> = page.split("<svg ").skip(1).collect();
        assert!(pictures.len() > 3, "{name}");
        for picture in pictures {
            let (picture, _) = picture.split_once("</svg>").unwrap();
            assert_eq!(
                svg_frame::faults(&format!("<svg {picture}")),
                [""; 0],
                "{name}"
            );
        }
    }
}

#[test]
fn pictures_and_tables_are_accessible() {
    let page = reported("access", &Invention::default());
    let pictures = page.matches("<svg ").count();
    // Path, arm, mode, three sets, one error, cycles, joints.
    assert_eq!(pictures, 9);
    assert_eq!(page.matches("role=\"img\" aria-label=\"").count(), pictures);
    assert_eq!(
        page.matches("<table>").count(),
        page.matches("<thead>").count()
    );
    assert!(page.contains("scope=\"col\"") && page.contains("scope=\"row\""));
    assert!(page.contains("<html lang=\"en\">") && page.contains("width=device-width"));
    assert!(page.contains("prefers-color-scheme: dark"));
}

#[test]
fn text_of_the_user_is_never_markup() {
    let attack = "<script>alert(1)</script>";
    let run = Invention {
        title: attack.into(),
        set_name: "\"><img onerror=x>".into(),
        outcome: Outcome::Fault {
            name: attack.into(),
            detail: attack.into(),
        },
        ..Invention::default()
    };
    let page = reported("an attack", &run);
    assert!(!page.contains(attack) && !page.contains("<img"));
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;"));
}

#[test]
fn promises_and_observations_are_told_apart() {
    let page = reported("promises", &Invention::default());
    assert_eq!(page.matches("✓ holds").count(), 4);
    assert_eq!(page.matches("✗ does not hold").count(), 1);
    assert!(page.contains("promises nothing between samples"));
    assert!(page.contains("1 and 5 are observations"));
}

#[test]
fn a_run_that_ended_early_stands_out() {
    let run = Invention {
        outcome: Outcome::Interrupted,
        ..Invention::default()
    };
    let page = reported("interruption", &run);
    assert!(
        page.contains("class=\"verdict bad\"") && page.contains("<strong>Interrupted</strong>")
    );
    let fault = Outcome::Fault {
        name: "link-lost".into(),
        detail: "nothing heard for 0.5 s".into(),
    };
    let page = reported(
        "fault",
        &Invention {
            outcome: fault,
            ..Invention::default()
        },
    );
    assert!(
        page.contains("Stopped by a fault (link-lost)") && page.contains("nothing heard for 0.5 s")
    );
}

#[test]
fn strange_runs_have_a_report_too() {
    for (name, run) in strange_runs() {
        let page = reported(name, &run);
        assert!(page.ends_with("</html>\n"), "{name}");
        // What is packed is any letters.
        let (told, _) = page.split_once("</main>").unwrap();
        assert!(!told.contains("NaN") || name == "not finite", "{name}");
    }
}

#[test]
fn a_log_cut_short_is_still_reported() {
    let dir = Invention::default().write("report of a killed run");
    let log = dir.join("log.csv");
    let text = fs::read_to_string(&log).unwrap();
    fs::write(&log, &text[..text.len() - 30]).unwrap();
    let page = fs::read_to_string(report::write(&dir).unwrap()).unwrap();
    assert!(page.contains("last line of the log was cut off"));
}

#[test]
fn monitors_are_told_with_their_verdicts() {
    let folder = Invention::default().write("monitors");
    let page = fs::read_to_string(report::write(&folder).unwrap()).unwrap();
    let page = page.replace('\u{a0}', " ");
    let (_, section) = page.split_once("What else was watched").unwrap();
    let row = |words: &str| section.lines().find(|line| line.contains(words)).unwrap();
    let frozen = row("frozen though it was strictly inside");
    for part in [">seen</td>", "1 s", "0.0123", "1.5 s", "view"] {
        assert!(frozen.contains(part), "{part}: {frozen}");
    }
    assert!(row("left without notice").contains(">not watched</td>"));
    assert!(row("local minimum").contains(">never</td>"));
    assert!(row("joint_1</th>").contains("0.72 s"));
}
