//! `conik run --tui` in a pseudo terminal, whether somebody reads it or not.
#![cfg(target_os = "linux")]

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::os::fd::OwnedFd;
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use rustix::fs::{Mode, OFlags, open};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{LocalModes, Winsize, tcgetattr, tcsetwinsize};
use serde_json::Value;

use super::process::{conik, empty_folder, paper, patient, say, wait_for};

/// A command in a terminal of 80 x 24.
struct Terminal {
    /// What somebody at it would hold: reading shows the screen, writing types.
    person: File,
    /// Kept open, so that its settings can be asked for after the end.
    device: OwnedFd,
    child: Child,
}

impl Terminal {
    fn run(folder: &Path, scenario: &Path, arguments: &str) -> Self {
        let person =
            openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&person).unwrap();
        unlockpt(&person).unwrap();
        let name = ptsname(&person, Vec::new()).unwrap();
        let device = open(&name, OFlags::RDWR | OFlags::NOCTTY, Mode::empty()).unwrap();
        resize(&device, 24, 80);
        let side = || Stdio::from(device.try_clone().unwrap());
        let child = conik(["run", "--tui"])
            .arg(scenario)
            .args(arguments.split_whitespace())
            .current_dir(folder)
            .env("TERM", "xterm-256color")
            .stdin(side())
            .stdout(side())
            .stderr(side())
            .spawn()
            .unwrap();
        Self {
            person: File::from(person),
            device,
            child,
        }
    }

    /// Reads all that is written from now on.
    fn read(&self) -> Arc<Mutex<String>> {
        let screen = Arc::new(Mutex::new(String::new()));
        let (mut person, written) = (self.person.try_clone().unwrap(), Arc::clone(&screen));
        thread::spawn(move || {
            let mut bytes = [0; 4096];
            loop {
                match person.read(&mut bytes) {
                    Err(error) if error.kind() == ErrorKind::Interrupted => {}
                    Ok(0) | Err(_) => break,
                    Ok(count) => {
                        let text = String::from_utf8_lossy(&bytes[..count]);
                        written.lock().unwrap().push_str(&text);
                    }
                }
            }
        });
        screen
    }

    fn press(&mut self, keys: &str) {
        self.person.write_all(keys.as_bytes()).unwrap();
    }

    /// Closes the window, as long as nobody [`read`](Self::read)s.
    fn hang_up(&mut self) {
        self.person = File::open("/dev/null").unwrap();
    }

    fn status(&mut self) -> Option<i32> {
        wait_for("the end of the process", || self.child.try_wait().unwrap()).code()
    }

    /// Whether keys are read as they are pressed, and not shown.
    fn is_raw(&self) -> bool {
        let modes = tcgetattr(&self.device).unwrap().local_modes;
        !modes.intersects(LocalModes::ICANON | LocalModes::ECHO)
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // It may have ended on its own.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn resize(device: &OwnedFd, rows: u16, columns: u16) {
    let size = Winsize {
        ws_row: rows,
        ws_col: columns,
        ws_xpixel: 0,
        ws_ypixel: 0,
    };
    tcsetwinsize(device, size).unwrap();
}

/// The lowest row and the furthest column that a text goes to, counted from 1.
fn reaches(text: &str) -> (u16, u16) {
    let places = text.split("\u{1b}[").filter_map(|sequence| {
        let (place, _) = sequence.split_once('H')?;
        let (row, column) = place.split_once(';')?;
        Some((row.parse::<u16>().ok()?, column.parse::<u16>().ok()?))
    });
    places.fold((0, 0), |(lowest, furthest), (row, column)| {
        (lowest.max(row), furthest.max(column))
    })
}

/// How the run ended, once it has.
fn outcome(folder: &Path) -> Option<String> {
    let text = std::fs::read_to_string(folder.join("out/summary.json")).ok()?;
    let summary: Value = serde_json::from_str(&text).ok()?;
    let kind = summary["outcome"]["kind"].as_str()?;
    (kind != "running").then(|| kind.to_owned())
}

/// Rows of the log after its heading, the last of which must be whole.
fn rows(folder: &Path) -> usize {
    let log = std::fs::read_to_string(folder.join("out/log.csv")).unwrap();
    assert!(log.ends_with('\n'));
    let mut rows = log.lines().filter(|line| !line.starts_with('#'));
    let columns = rows.next().unwrap().split(',').count();
    let rows: Vec<_> = rows.collect();
    assert_eq!(rows.last().unwrap().split(',').count(), columns);
    rows.len()
}

#[test]
fn view_stays_after_the_end_until_q_and_then_the_last_words_are_said() {
    let folder = empty_folder("terminal-end");
    let options = "--robot ideal --out out";
    let mut terminal = Terminal::run(&folder, &paper("example2"), options);
    let screen = terminal.read();
    let has = |what: &str| screen.lock().unwrap().contains(what).then_some(());
    wait_for("a task", || has("obstacle_a"));
    wait_for("the end of the run", || outcome(&folder));
    wait_for("the report", || {
        folder.join("out/report.html").exists().then_some(())
    });
    assert!(has("\u{1b}[?1049l").is_none(), "the view is still there");
    assert!(terminal.is_raw());
    terminal.press("q");
    assert_eq!(terminal.status(), Some(0));
    wait_for("the last words", || has("report: out/report.html"));
    let text = screen.lock().unwrap().clone();
    let (_, after) = text.rsplit_once("\u{1b}[?1049l").unwrap();
    assert!(after.contains("report:"), "said on the normal screen");
    assert!(!terminal.is_raw());
    assert_eq!(rows(&folder), 7501);
}

#[test]
fn q_stops_the_run_as_ctrl_c_does() {
    for (name, key) in [("terminal-q", "q"), ("terminal-ctrl-c", "\u{3}")] {
        let folder = empty_folder(name);
        let scenario = patient(&folder);
        let mut terminal = Terminal::run(&folder, &scenario, "--out out");
        let screen = terminal.read();
        let has = |what: &str| screen.lock().unwrap().contains(what).then_some(());
        wait_for("the arm to move", || has("running"));
        terminal.press(key);
        assert_eq!(terminal.status(), Some(130), "{name}");
        assert_eq!(outcome(&folder), Some("interrupted".to_owned()), "{name}");
        wait_for("the last words", || has("stopped by hand"));
        assert!(!terminal.is_raw());
        assert!(rows(&folder) > 0);
    }
}

/// Has so much drawn that a terminal that nobody reads takes nothing more.
fn stall(terminal: &mut Terminal) {
    for _ in 0..200 {
        terminal.press("?");
        thread::sleep(Duration::from_millis(10));
    }
}

/// Reads what was drawn before it stalled: nothing of the end can be there.
#[track_caller]
fn assert_was_stalled(terminal: &Terminal) {
    let screen = terminal.read();
    wait_for("what was drawn", || {
        (!screen.lock().unwrap().is_empty()).then_some(())
    });
    assert!(!screen.lock().unwrap().contains("\u{1b}[?1049l"));
}

#[test]
fn terminal_that_nobody_reads_holds_up_neither_the_run_nor_its_log() {
    let folder = empty_folder("terminal-stalled");
    let options = "--robot emulator --duration-s 6 --out out";
    let scenario = patient(&folder);
    let mut terminal = Terminal::run(&folder, &scenario, options);
    stall(&mut terminal);
    let ended = wait_for("the run to end", || outcome(&folder));
    assert_eq!(ended, "completed");
    assert_eq!(rows(&folder), 751);
    wait_for("the report", || {
        folder.join("out/report.html").exists().then_some(())
    });
    terminal.press("q");
    assert_eq!(terminal.status(), Some(0));
    assert!(!terminal.is_raw());
    assert_was_stalled(&terminal);
}

#[test]
fn q_is_heard_at_a_terminal_that_nobody_reads() {
    let folder = empty_folder("terminal-stalled-q");
    let scenario = patient(&folder);
    let mut terminal = Terminal::run(&folder, &scenario, "--out out");
    stall(&mut terminal);
    terminal.press("q");
    assert_eq!(terminal.status(), Some(130));
    assert_eq!(outcome(&folder), Some("interrupted".to_owned()));
    assert!(rows(&folder) > 0);
    assert!(!terminal.is_raw());
    assert_was_stalled(&terminal);
}

#[test]
fn terminal_that_is_hung_up_ends_the_command_and_not_the_run() {
    let folder = empty_folder("terminal-gone");
    let options = "--robot emulator --duration-s 2 --out out";
    let scenario = patient(&folder);
    let mut terminal = Terminal::run(&folder, &scenario, options);
    let log = folder.join("out/log.csv");
    let length = || std::fs::metadata(&log).map_or(0, |file| file.len());
    wait_for("the first rows", || (length() > 0).then_some(()));
    terminal.hang_up();
    assert_eq!(terminal.status(), Some(0));
    assert_eq!(outcome(&folder), Some("completed".to_owned()));
    assert_eq!(rows(&folder), 251);
}

#[test]
fn terminal_that_is_hung_up_after_the_end_ends_the_command() {
    let folder = empty_folder("terminal-gone-later");
    let options = "--robot ideal --out out";
    let mut terminal = Terminal::run(&folder, &paper("example2"), options);
    wait_for("the report", || {
        folder.join("out/report.html").exists().then_some(())
    });
    terminal.hang_up();
    assert_eq!(terminal.status(), Some(0));
}

#[test]
fn view_fits_the_window_whatever_size_it_is_given() {
    let folder = empty_folder("terminal-resized");
    let scenario = patient(&folder);
    let mut terminal = Terminal::run(&folder, &scenario, "--out out");
    let screen = terminal.read();
    let has = |what: &str| screen.lock().unwrap().contains(what).then_some(());
    wait_for("the arm to move", || has("running"));
    let (rows, columns) = reaches(&screen.lock().unwrap());
    assert!(
        (20..=24).contains(&rows) && columns <= 80,
        "{rows} {columns}"
    );
    for (rows, columns) in [(40, 120), (5, 20), (1, 1), (24, 80)] {
        // What is under way when the size changes may still be of the old one.
        resize(&terminal.device, rows, columns);
        let drawn = || screen.lock().unwrap().len();
        let before = drawn();
        wait_for("a picture of that size", || {
            let text = screen.lock().unwrap();
            let last = text[before..]
                .rsplit_once("\u{1b}[2J")
                .map(|(_, last)| reaches(last));
            last.filter(|(lowest, furthest)| {
                (rows - rows / 4..=rows).contains(lowest) && *furthest <= columns
            })
            .map(|_| ())
        });
    }
    terminal.press("q");
    assert_eq!(terminal.status(), Some(130));
    assert!(!terminal.is_raw());
}

#[test]
fn output_that_is_no_terminal_is_refused() {
    let folder = empty_folder("terminal-none");
    let line = format!("run --tui --robot ideal {}", paper("example2").display());
    let said = say(&folder, &line);
    assert_eq!(said.status, Some(2));
    assert!(
        said.stderr.contains("standard output is no terminal"),
        "{said:?}"
    );
    assert!(!folder.join("out").exists());
}
