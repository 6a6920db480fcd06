//! What stands in the way of a run, and what stops it: disks, folders, signals.

use std::fs;
use std::path::Path;

use super::process::{
    Running, Said, conik, done, empty_folder, ended, paper, patient, say, wait_for,
};
use super::run_folder::{Rows, summary};

#[test]
fn folder_that_cannot_be_written_is_named() {
    let folder = empty_folder("unwritable");
    fs::write(folder.join("file"), "in the way").unwrap();
    fs::create_dir_all(folder.join("taken/log.csv")).unwrap();
    fs::create_dir_all(folder.join("occupied/report.html")).unwrap();
    for (out, names) in [
        ("file", "file"),
        ("file/below", "file/below"),
        ("taken", "taken/log.csv"),
        ("occupied", "occupied/report.html"),
    ] {
        let line = format!(
            "run {} --fast --quiet --out {out}",
            paper("example2").display()
        );
        let said = say(&folder, &line);
        assert_eq!(said.status, Some(2), "{said:#?}");
        assert!(said.stderr.contains(names), "{out}: {said:#?}");
    }
    assert_eq!(fs::read(folder.join("file")).unwrap(), b"in the way");
}

#[cfg(target_os = "linux")]
#[test]
fn full_disk_ends_the_run_and_is_named() {
    for robot in ["--robot ideal", "--fast", "--robot ideal --duration-s 0.5"] {
        let folder = empty_folder("full disk");
        std::os::unix::fs::symlink("/dev/full", folder.join("log.csv")).unwrap();
        let line = format!(
            "run {} {robot} --quiet --out .",
            paper("example2").display()
        );
        let said = say(&folder, &line);
        assert_eq!(said.status, Some(1), "{said:#?}");
        assert!(
            said.stderr.contains("./log.csv") && said.stderr.contains("No space"),
            "{said:#?}"
        );
        assert_eq!(summary(&folder)["outcome"]["name"], "log-failed");
        assert!(
            !folder.join("report.html").exists(),
            "a report of half a log"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_nobody_takes_is_an_error_but_a_reader_that_left_is_none() {
    let printed_to = |stdout: std::process::Stdio| {
        let child = conik(["schema"])
            .stdout(stdout)
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        Said::from(child.wait_with_output().unwrap())
    };
    let full = fs::OpenOptions::new().write(true).open("/dev/full");
    let said = printed_to(full.unwrap().into());
    assert_eq!(said.status, Some(1));
    assert!(
        said.stderr.contains("cannot write to standard output"),
        "{said:#?}"
    );

    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let said = printed_to(writer.into());
    assert_eq!((said.status, said.stderr.as_str()), (Some(0), ""));
}

#[test]
fn new_run_replaces_everything_that_an_earlier_one_said() {
    let folder = empty_folder("again");
    let run = |options: &str| {
        let line = format!("run {} --out . {options}", paper("example2").display());
        say(&folder, &line)
    };
    assert_eq!(run("--robot ideal --duration-s 4").status, Some(0));
    assert_eq!(run("--robot ideal --duration-s 2").status, Some(0));
    assert_eq!(Rows::of(&folder).rows.len(), 251);
    assert_eq!(summary(&folder)["ended_at_s"], 2.0);
    assert_eq!(run("--robot no.such.host.invalid").status, Some(1));
    assert_eq!(summary(&folder)["outcome"]["name"], "connect-failed");
    assert!(
        !folder.join("report.html").exists(),
        "the report of an earlier run"
    );
}

#[test]
fn settings_that_cannot_run_leave_an_earlier_run_alone() {
    let folder = empty_folder("left alone");
    let example = paper("example2");
    done(
        &folder,
        &format!(
            "run {} --robot ideal --duration-s 1 --out .",
            example.display()
        ),
    );
    let line = format!("run {} --rate-hz 2000 --out .", example.display());
    assert_eq!(say(&folder, &line).status, Some(2));
    assert_eq!(Rows::of(&folder).rows.len(), 126);
    assert!(folder.join("report.html").exists());
}

/// Starts an hour in wall time, sends the signal when there are rows, and waits for the end.
fn interrupted(folder: &Path, signal: &str) -> Said {
    let line = format!(
        "run {} --duration-s 3600 --out .",
        patient(folder).display()
    );
    let run = Running::start(folder, &line);
    let log = folder.join("log.csv");
    wait_for("rows", || {
        fs::metadata(&log).ok().filter(|log| log.len() > 0)
    });
    run.signal(signal);
    run.wait()
}

#[test]
fn stopped_run_keeps_its_log_and_says_what_became_of_it() {
    for signal in ["INT", "TERM"] {
        let folder = empty_folder(&format!("stopped by {signal}"));
        let said = interrupted(&folder, signal);
        assert_eq!(said.status, Some(130), "{said:#?}");
        assert!(said.stdout.contains("stopped by hand"), "{said:#?}");
        assert!(said.stdout.contains("report: ./report.html"), "{said:#?}");
        let (log, summary) = (Rows::of(&folder), summary(&folder));
        assert_eq!(summary["outcome"]["kind"], "interrupted");
        log.assert_complete(125.0);
        assert_eq!(summary["ended_at_s"], *log.numbers("t_s").last().unwrap());
        assert!(folder.join("report.html").exists());
    }
}

#[test]
fn second_run_into_the_same_folder_is_refused() {
    let folder = empty_folder("two at once");
    let line = format!(
        "run {} --duration-s 3600 --out both",
        patient(&folder).display()
    );
    let first = Running::start(&folder, &line);
    let log = folder.join("both/log.csv");
    wait_for("rows", || {
        fs::metadata(&log).ok().filter(|log| log.len() > 0)
    });
    let second = say(&folder, &format!("{line} --robot ideal"));
    assert_eq!(second.status, Some(2), "{second:#?}");
    assert!(
        second.stderr.contains("another run is writing to both;"),
        "{second:#?}"
    );
    first.signal("INT");
    assert_eq!(first.wait().status, Some(130));
    Rows::of(&folder.join("both")).assert_complete(125.0);
}

#[test]
fn killed_run_can_still_be_drawn() {
    let folder = empty_folder("killed");
    let line = format!(
        "run {} --duration-s 3600 --out .",
        patient(&folder).display()
    );
    let mut run = Running::start(&folder, &line);
    let log = folder.join("log.csv");
    wait_for("rows", || {
        fs::metadata(&log).ok().filter(|log| log.len() > 0)
    });
    run.child().kill().unwrap();
    assert_eq!(run.wait().status, None, "killed by a signal");
    assert_eq!(summary(&folder)["outcome"]["kind"], "running");
    // Half a line, as a kill in the midst of a write leaves it.
    let mut text = fs::read_to_string(&log).unwrap();
    text.truncate(text.rfind('\n').unwrap() + 1);
    let last = text.lines().last().unwrap().split(',').next().unwrap();
    let last: f64 = last.parse().unwrap();
    fs::write(&log, text + "3599.9,1,vi").unwrap();

    done(&folder, "plot .");
    let report = fs::read_to_string(folder.join("report.html")).unwrap();
    let ended = format!("<strong>Cut off</strong> after {last}\u{a0}s of 3600\u{a0}s");
    assert!(report.contains(&ended), "{ended}");
    assert!(report.contains("The last line of the log was cut off"));
    assert!(!report.contains("not reached"), "nobody knows");
    assert!(!report.contains("The five properties"), "nobody knows");
}

#[cfg(target_os = "linux")]
#[test]
fn endless_files_of_a_run_folder_are_refused() {
    let folder = empty_folder("endless");
    let line = format!(
        "run {} --robot ideal --duration-s 1 --out .",
        paper("example2").display()
    );
    done(&folder, &line);
    for name in ["log.csv", "summary.json"] {
        let path = folder.join(name);
        fs::remove_file(&path).unwrap();
        std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
        let said = say(&folder, "plot .");
        assert_eq!(said.status, Some(2), "{said:#?}");
        assert!(said.stderr.contains(&format!("./{name}:")), "{said:#?}");
    }
}

#[test]
fn error_that_nobody_reads_keeps_its_status() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let status = conik(["check", "no-such-file.toml"])
        .stderr(writer)
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(2));
}

#[test]
fn run_goes_on_when_nobody_reads_its_progress() {
    let folder = empty_folder("unread");
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let line = format!(
        "run {} --duration-s 3600 --out .",
        patient(&folder).display()
    );
    let mut run = Running::of(
        conik(line.split_whitespace())
            .current_dir(&folder)
            .stderr(writer),
    );
    // Past the first line of progress, which comes after five seconds.
    wait_for("six seconds of rows", || {
        assert_eq!(run.child().try_wait().unwrap(), None, "it ended");
        let text = fs::read_to_string(folder.join("log.csv")).ok()?;
        (text.lines().count() > 6 * 125).then_some(())
    });
    run.signal("INT");
    assert_eq!(run.wait().status, Some(130));
    assert_eq!(summary(&folder)["outcome"]["kind"], "interrupted");
}

#[test]
fn run_without_input_and_output_still_writes_its_files() {
    let folder = empty_folder("closed");
    let script = "exec \"$0\" run \"$1\" --fast --duration-s 1 --out . <&- >&- 2>&-";
    let status = ended(
        std::process::Command::new("sh")
            .args(["-c", script, env!("CARGO_BIN_EXE_conik")])
            .arg(paper("example2"))
            .current_dir(&folder),
    )
    .status;
    assert_eq!(status, Some(0));
    assert_eq!(Rows::of(&folder).rows.len(), 126);
}
