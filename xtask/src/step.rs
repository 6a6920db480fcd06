//! A step: one command, its name for people, and what it needs.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use crate::programs::Program;

/// One command of a task.
pub struct Step {
    /// What it checks.
    pub name: &'static str,
    /// The command and its arguments.
    pub command: Vec<&'static str>,
    /// The folder to run in, from the root of the repository. Where it is missing, the part of the
    /// project that the step checks is missing, and the step is skipped.
    pub folder: &'static str,
    /// Environment variables to set.
    pub environment: Vec<(&'static str, &'static str)>,
    /// Programs that must be there.
    pub needs: Vec<Program>,
}

impl Step {
    /// A step in the root of the repository that needs nothing but Rust.
    pub fn cargo(name: &'static str, arguments: &[&'static str]) -> Self {
        let mut command = vec!["cargo"];
        command.extend(arguments);
        Self {
            name,
            command,
            folder: ".",
            environment: Vec::new(),
            needs: Vec::new(),
        }
    }
}

/// Where tests in other languages find the command that the Rust tests were run with.
const COMMAND: &str = "CONIK";

/// Where they find the Python package that its own tests have built.
const WHEEL: &str = "CONIK_WHEEL";

/// The command, if it was built.
fn built_command() -> Option<PathBuf> {
    let name = format!("conik{}", std::env::consts::EXE_SUFFIX);
    let path = target()?.join("debug").join(name);
    path.is_file().then_some(path)
}

/// The newest wheel, if one was built.
fn built_wheel() -> Option<PathBuf> {
    let wheels = std::fs::read_dir(target()?.join("wheels")).ok()?;
    wheels
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "whl"))
        .max_by_key(|path| path.metadata().and_then(|data| data.modified()).ok())
}

/// What is built stands there.
fn target() -> Option<PathBuf> {
    let folder = std::env::var_os("CARGO_TARGET_DIR").map_or(root().join("target"), PathBuf::from);
    std::path::absolute(folder).ok()
}

/// Runs the steps in order and stops at the first that fails.
pub fn run(steps: &[Step]) -> ExitCode {
    let begin = Instant::now();
    for (i, step) in steps.iter().enumerate() {
        println!("[{}/{}] {}", i + 1, steps.len(), step.name);
        let folder = root().join(step.folder);
        if !folder.is_dir() {
            println!(
                "      skipped: there is no {}/ in this version",
                step.folder
            );
            continue;
        }
        if let Err(reason) = step.needs.iter().try_for_each(Program::provide) {
            eprintln!("{reason}");
            return ExitCode::FAILURE;
        }
        let started = Instant::now();
        let status = Command::new(step.command[0])
            .args(&step.command[1..])
            .envs(step.environment.iter().copied())
            .envs(built_command().map(|path| (COMMAND, path)))
            .envs(built_wheel().map(|path| (WHEEL, path)))
            .current_dir(&folder)
            .status();
        let line = step.command.join(" ");
        match status {
            Ok(status) if status.success() => {
                println!("      done in {:.0} s", started.elapsed().as_secs_f64());
            }
            Ok(_) => {
                eprintln!(
                    "failed: {}\nrepeat with, in {}: {line}",
                    step.name,
                    folder.display()
                );
                return ExitCode::FAILURE;
            }
            Err(error) => {
                eprintln!("failed: {}: cannot start `{line}`: {error}", step.name);
                return ExitCode::FAILURE;
            }
        }
    }
    println!("all steps done in {:.0} s", begin.elapsed().as_secs_f64());
    ExitCode::SUCCESS
}

/// The root of the repository.
fn root() -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    crate_folder.parent().unwrap_or(crate_folder).to_owned()
}
