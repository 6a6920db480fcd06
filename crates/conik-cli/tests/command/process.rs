//! Runs the built command and keeps what it said.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Whoever waits longer than this for anything waits in vain. No test's verdict hangs on less.
const IN_VAIN: Duration = Duration::from_secs(60);

/// One of the paper's scenarios, `example2` for instance.
pub fn paper(name: &str) -> PathBuf {
    repository().join(format!("scenarios/paper/{name}.toml"))
}

/// Example 2 for an arm with a clock of its own, by its name in this folder: it bridges half a
/// second, so that a busy computer is no fault.
pub fn patient(folder: &Path) -> PathBuf {
    let text = fs::read_to_string(paper("example2")).unwrap();
    let text = text.replacen("\n[[task]]", "\n[ur]\nbridge_s = 0.5\n\n[[task]]", 1);
    let name = PathBuf::from("patient.toml");
    fs::write(folder.join(&name), text).unwrap();
    name
}

/// Where the scenarios stand.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// An empty folder for one test.
pub fn empty_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("command")
        .join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// What an ended process left behind.
#[derive(Debug)]
pub struct Said {
    pub status: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Said {
    fn from(output: Output) -> Self {
        Self {
            status: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

/// `conik` with these arguments, not yet started.
pub fn conik<A: AsRef<std::ffi::OsStr>>(arguments: impl IntoIterator<Item = A>) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_conik"));
    command.args(arguments).stdin(Stdio::null());
    command
}

/// Runs `conik` in `folder` with the words of `line`, and waits for its end.
pub fn say(folder: &Path, line: &str) -> Said {
    ended(conik(line.split_whitespace()).current_dir(folder))
}

/// Runs a command and waits for its end.
pub fn ended(command: &mut Command) -> Said {
    command.output().unwrap().into()
}

/// As [`say`], for what must go well: its standard output.
#[track_caller]
pub fn done(folder: &Path, line: &str) -> String {
    let said = say(folder, line);
    assert_eq!(said.status, Some(0), "conik {line}: {said:#?}");
    said.stdout
}

/// A process that is ended when the test is, however that ends.
pub struct Running(Child);

impl Running {
    /// Starts `conik` in `folder`, its output piped.
    pub fn start(folder: &Path, line: &str) -> Self {
        Self::of(
            conik(line.split_whitespace())
                .current_dir(folder)
                .stderr(Stdio::piped()),
        )
    }

    /// Starts a command, its standard output piped.
    pub fn of(command: &mut Command) -> Self {
        Self(command.stdout(Stdio::piped()).spawn().unwrap())
    }

    /// The process.
    pub fn child(&mut self) -> &mut Child {
        &mut self.0
    }

    /// Sends the signal of that name: `INT`, `TERM`.
    pub fn signal(&self, name: &str) {
        let id = self.0.id().to_string();
        let sent = Command::new("kill")
            .args([&format!("-{name}"), &id])
            .status();
        assert!(sent.unwrap().success(), "kill -{name} {id}");
    }

    /// Waits for the end. What is printed until then must fit into a pipe.
    pub fn wait(mut self) -> Said {
        let status: ExitStatus = wait_for("the end of the process", || self.0.try_wait().unwrap());
        let mut said = Said {
            status: status.code(),
            stdout: String::new(),
            stderr: String::new(),
        };
        if let Some(mut pipe) = self.0.stdout.take() {
            pipe.read_to_string(&mut said.stdout).unwrap();
        }
        if let Some(mut pipe) = self.0.stderr.take() {
            pipe.read_to_string(&mut said.stderr).unwrap();
        }
        said
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended on its own.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Looks until there is something to see.
pub fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(seen) = look() {
            return seen;
        }
        assert!(begin.elapsed() < IN_VAIN, "waited in vain for {what}");
        sleep(Duration::from_millis(20));
    }
}
