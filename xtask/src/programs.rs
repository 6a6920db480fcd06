//! Programs that steps need, and how they get there.

use std::process::{Command, Stdio};

/// A program that a step needs.
#[derive(Clone, Copy)]
pub struct Program {
    /// How to see that it is there: a command that succeeds.
    probe: &'static [&'static str],
    /// How to install it. The first that succeeds is enough.
    install: &'static [&'static [&'static str]],
    /// What to tell a person if none does.
    advice: &'static str,
}

/// Formats Rust.
pub const RUSTFMT: Program = Program {
    probe: &["cargo", "fmt", "--version"],
    install: &[&["rustup", "component", "add", "rustfmt"]],
    advice: "install rustfmt: rustup component add rustfmt",
};

/// Lints Rust.
pub const CLIPPY: Program = Program {
    probe: &["cargo", "clippy", "--version"],
    install: &[&["rustup", "component", "add", "clippy"]],
    advice: "install clippy: rustup component add clippy",
};

/// Python with virtual environments.
pub const PYTHON: Program = Program {
    probe: &["python3", "-c", "import venv, ensurepip"],
    install: &[&["apt-get", "install", "--yes", "python3", "python3-venv"]],
    advice: "install Python 3.10 or later with venv (Debian: apt-get install python3 python3-venv)",
};

/// Node, for the page.
pub const NODE: Program = Program {
    probe: &["npm", "--version"],
    install: &[&["apt-get", "install", "--yes", "nodejs", "npm"]],
    advice: "install Node 20 or later with npm",
};

/// A browser, for the page's tests.
pub const CHROMIUM: Program = Program {
    probe: &["chromium", "--version"],
    install: &[&["apt-get", "install", "--yes", "chromium"]],
    advice: "install Chromium (Debian: apt-get install chromium)",
};

impl Program {
    /// Makes sure that the program is there, installing it if need be and possible.
    pub fn provide(&self) -> Result<(), String> {
        if succeeds(self.probe) {
            return Ok(());
        }
        println!("      `{}` is missing, trying to install it", self.probe[0]);
        for command in self.install {
            if command[0] == "apt-get" {
                // Lists of packages that were never fetched know none.
                succeeds(&["apt-get", "update", "--quiet"]);
            }
            if succeeds(command) && succeeds(self.probe) {
                return Ok(());
            }
        }
        Err(format!(
            "`{}` does not work here; {}",
            self.probe.join(" "),
            self.advice
        ))
    }
}

fn succeeds(command: &[&str]) -> bool {
    Command::new(command[0])
        .args(&command[1..])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}
