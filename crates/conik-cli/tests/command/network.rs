//! Two processes: `conik emulate` and the `conik run` that drives it; and nobody there at all.

use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::path::Path;

use super::process::{Running, empty_folder, paper, patient, say, wait_for};
use super::run_folder::{Rows, summary};

const RTDE_PORT: u16 = 30004;

/// An emulator at the start of example 2, and its port offset: the first that is free.
pub fn emulator(folder: &Path) -> (Running, u16) {
    let example = paper("example2");
    for offset in (1000..20_000).step_by(37) {
        let line = format!(
            "emulate --series cb3 --port-offset {offset} --scenario {}",
            example.display()
        );
        let mut running = Running::start(folder, &line);
        let mut said = String::new();
        let stdout = running.child().stdout.as_mut().unwrap();
        BufReader::new(stdout).read_line(&mut said).unwrap();
        if said.contains(&format!("RTDE {}", RTDE_PORT + offset)) {
            return (running, offset);
        }
    }
    panic!("no free ports");
}

#[test]
fn run_drives_an_emulator_in_another_process() {
    let folder = empty_folder("two processes");
    let (emulator, offset) = emulator(&folder);
    let run = |out: &str| {
        let example = patient(&folder);
        let line = format!(
            "run {} --robot 127.0.0.1 --port-offset {offset} --duration-s 1 --quiet --out {out}",
            example.display()
        );
        say(&folder, &line)
    };
    let first = run("first");
    assert_eq!(first.status, Some(0), "{first:#?}");
    assert_eq!(first.stderr, "", "the emulator answers every question");
    let log = Rows::of(&folder.join("first"));
    assert_eq!(log.rows.len(), 126);
    assert!(log.header.ends_with(",q6_measured_rad,why"));
    let written = summary(&folder.join("first"));
    assert_eq!(written["settings"]["robot"], "127.0.0.1");
    let cycles = &written["cycles"];
    assert_eq!(cycles["answer_us"]["count"], 126);
    assert_eq!(cycles["period_us"]["count"], 125);
    assert_eq!(cycles["missed"], written["deadline_misses"]);
    assert_eq!(cycles["repeated"], 0);
    let report = std::fs::read_to_string(folder.join("first/report.html")).unwrap();
    assert!(report.contains("Cycles of the arm"));

    // The arm now stands elsewhere: it is not driven off to the start unasked.
    let second = run("second");
    assert_eq!(second.status, Some(1));
    assert!(
        second.stderr.contains("error: start-away: joint "),
        "{second:#?}"
    );

    // Nor is it, but begins where it stands, where that is asked for.
    let third = run("third --from-here");
    assert_eq!(third.status, Some(0), "{third:#?}");
    let third = Rows::of(&folder.join("third"));
    for joint in 1..=6 {
        let name = format!("q{joint}_rad");
        let (ended, begun) = (log.numbers(&name)[125], third.numbers(&name)[0]);
        // The arm runs a tenth of a second behind its reference.
        assert!(
            (ended - begun).abs() < 0.04,
            "{name}: {ended}, then {begun}"
        );
    }
    let base = |rows: &Rows| rows.numbers("q1_rad")[0];
    assert!((base(&log) - base(&third)).abs() > 0.02, "it had moved");

    emulator.signal("INT");
    assert_eq!(emulator.wait().status, Some(0));
}

#[test]
fn a_run_that_was_killed_is_followed_by_another_only_after_recover() {
    let folder = empty_folder("killed on the arm");
    let (emulator, offset) = emulator(&folder);
    let line = format!(
        "run {} --robot 127.0.0.1 --port-offset {offset} --quiet",
        patient(&folder).display()
    );
    let begun = |out: &str| {
        let run = Running::start(&folder, &format!("{line} --duration-s 600 --out {out}"));
        let log = folder.join(out).join("log.csv");
        wait_for("rows", || {
            std::fs::metadata(&log).ok().filter(|log| log.len() > 0)
        });
        run
    };
    let dry = || {
        say(
            &folder,
            &format!("{line} --dry-run --duration-s 0.1 --out dry"),
        )
    };
    let mut run = begun("killed");
    run.child().kill().unwrap();
    run.wait();
    let refused = wait_for("the program's end", || {
        Some(dry()).filter(|said| !said.stderr.contains("other-program-running"))
    });
    assert_eq!(refused.status, Some(1), "{refused:#?}");
    assert!(
        refused.stderr.contains("error: not-rearmed: "),
        "{refused:#?}"
    );
    let recover = format!("recover 127.0.0.1 --port-offset {offset}");
    let recovered = say(&folder, &recover);
    assert_eq!(recovered.status, Some(0), "{recovered:#?}");
    assert!(recovered.stdout.contains("arming anew"), "{recovered:#?}");
    let again = say(&folder, &recover);
    assert!(
        again
            .stdout
            .starts_with("a run may start, from where the arm stands"),
        "{again:#?}"
    );
    let next = dry();
    assert!(!next.stderr.contains("not-rearmed"), "{next:#?}");
    emulator.signal("INT");
    assert_eq!(emulator.wait().status, Some(0));
}

#[test]
fn nobody_listening_is_a_fault_with_a_name() {
    let folder = empty_folder("nobody");
    let free = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let offset = free.checked_sub(RTDE_PORT).unwrap_or(777);
    let line = format!(
        "run {} --robot 127.0.0.1 --port-offset {offset} --out .",
        paper("example2").display()
    );
    let said = say(&folder, &line);
    assert_eq!(said.status, Some(1));
    assert!(
        said.stderr
            .contains("error: connect-failed: no connection to 127.0.0.1:")
    );
    assert_eq!(
        said.stderr.lines().count(),
        1,
        "one fault, one message: {said:#?}"
    );
    assert!(said.stdout.contains("before the first tick"), "{said:#?}");
    let summary = summary(&folder);
    assert_eq!(summary["outcome"]["name"], "connect-failed");
    // Not a single tick: nothing was shown.
    assert!(summary["tasks"]["position"]["final_error"].is_null());
    for (name, property) in summary["properties"].as_object().unwrap() {
        assert_eq!(property["holds"], false, "{name}");
    }
}

#[test]
fn preflight_measures_an_emulator_in_another_process_and_moves_nothing() {
    let folder = empty_folder("preflight");
    let (emulator, offset) = emulator(&folder);
    let line = format!("preflight 127.0.0.1 --port-offset {offset} --seconds 0.5");
    let first = say(&folder, &line);
    // Whether this computer is fit is its own affair; what is said must fit the verdict.
    let verdict = match first.status {
        Some(0) => ["fit: ", "doubtful: "],
        _ => ["not fit: ", "not fit: "],
    };
    let said = |part: &str| first.stdout.lines().any(|line| line.starts_with(part));
    assert!(verdict.into_iter().any(said), "{first:#?}");
    for part in [
        "UR5 (CB3), software 3.15",
        "a run could start",
        "packages at 125 Hz",
        "lateness",
    ] {
        assert!(first.stdout.contains(part), "{part}: {first:#?}");
    }
    // The pose that it found is still the pose, and the arm is free for a run.
    let pose = |stdout: &str| {
        stdout
            .lines()
            .find(|line| line.starts_with("joints at"))
            .map(str::to_owned)
    };
    let second = say(&folder, &line);
    assert!(pose(&first.stdout).is_some());
    assert_eq!(pose(&second.stdout), pose(&first.stdout));

    let impossible = say(&folder, &format!("{line} --rate-hz 500"));
    assert_eq!(impossible.status, Some(1));
    assert!(impossible.stderr.starts_with("error: rate-not-possible: "));
    emulator.signal("INT");
    assert_eq!(emulator.wait().status, Some(0));
}

#[test]
fn a_dry_run_goes_through_the_whole_scenario_and_moves_nothing() {
    let folder = empty_folder("dry run");
    let (emulator, offset) = emulator(&folder);
    let example = std::fs::read_to_string(paper("example2")).unwrap();
    let text = example.replacen(
        "\n[[task]]",
        "\n[ur]\nhost = \"127.0.0.1\"\nseries = \"cb3\"\nbridge_s = 0.5\n\n[[task]]",
        1,
    );
    std::fs::write(folder.join("arm.toml"), &text).unwrap();
    let line = format!("run arm.toml --robot ur --port-offset {offset} --duration-s 1 --dry-run");
    // Twice: after a run that moved the arm, the second would find it away from the start.
    for out in ["first", "second"] {
        let said = say(&folder, &format!("{line} --out {out}"));
        assert_eq!(said.status, Some(0), "{said:#?}");
        assert!(
            said.stdout.contains("dry run: nothing is sent"),
            "{said:#?}"
        );
        assert!(said.stdout.contains("driving with "), "{said:#?}");
        assert_eq!(Rows::of(&folder.join(out)).rows.len(), 126);
    }
    // Limits of [ur] are the last word.
    let slow = text.replace("[ur]", "[ur]\nmost_speed_rad_per_s = 0.01");
    std::fs::write(folder.join("slow.toml"), slow).unwrap();
    let said = say(&folder, &line.replace("arm.toml", "slow.toml"));
    assert_eq!(said.status, Some(1));
    assert!(
        said.stderr
            .contains("error: reference-refused: reference 0 (t = 0.000 s): joint "),
        "{said:#?}"
    );
    assert!(
        said.stderr.contains("its limit is 0.010000 rad/s"),
        "{said:#?}"
    );
    // So is the arm's model: the emulator's dashboard calls it a UR5.
    let other = text.replace("[ur]", "[ur]\nmodel = \"ur10\"");
    std::fs::write(folder.join("other.toml"), other).unwrap();
    let said = say(&folder, &line.replace("arm.toml", "other.toml"));
    assert_eq!(said.status, Some(1));
    assert!(said.stderr.starts_with("error: wrong-arm: "), "{said:#?}");
    emulator.signal("INT");
    assert_eq!(emulator.wait().status, Some(0));
}

#[test]
fn nothing_is_recovered_or_powered_where_no_dashboard_answers() {
    let folder = empty_folder("no dashboard");
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    drop(listener);
    let offset = port.checked_sub(29_999).unwrap_or(777);
    let example = paper("example2");
    for line in [
        format!("recover 127.0.0.1 --port-offset {offset}"),
        format!(
            "run {} --robot 127.0.0.1 --power-on --port-offset {offset}",
            example.display()
        ),
    ] {
        let said = say(&folder, &line);
        assert_eq!(said.status, Some(1), "{said:#?}");
        let begins = format!(
            "error: connect-failed: no connection to 127.0.0.1:{}",
            29_999 + offset
        );
        assert!(said.stderr.starts_with(&begins), "{said:#?}");
    }
}
