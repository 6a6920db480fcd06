//! One file per command. Each returns the exit status, or a [`Failure`].

pub mod campaign;
pub mod check;
pub mod completions;
pub mod emulate;
pub mod export;
pub mod init;
pub mod plot;
pub mod preflight;
pub mod recover;
pub mod robots;
pub mod run;
pub mod schema;
mod ur_robot;
pub mod view;

use std::io::{self, Write};
use std::process::ExitCode;

use crate::failure::Failure;
use crate::layout::wrapped;

/// Prints to standard output. A reader that went away (`conik schema | head`) is no failure.
pub(crate) fn print(text: &str) -> Result<ExitCode, Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::run(format!(
            "cannot write to standard output: {error}"
        ))),
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// Says on standard error what is no failure but should be known.
fn warn(text: &str) {
    // Nobody reading is no reason to stop.
    let _ = io::stderr().write_all(wrapped("", &format!("warning: {text}")).as_bytes());
}
