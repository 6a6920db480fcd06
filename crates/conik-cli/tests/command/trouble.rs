//! What stands in the way of a run, and what stops it: disks, folders, signals.

use std::fs;
use std::path::Path;

use super::process::{Running, Said, conik, done, empty_folder, ended, paper, say, wait_for};
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
        paper("example2").display()
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
