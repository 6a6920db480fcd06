//! The command `conik`.

mod arguments;
mod commands;
mod explain;
mod failure;
mod layout;
mod monitors;
mod overrides;
mod present;
mod progress;
mod watched;

use std::io::{self, Write};
use std::process::ExitCode;

use arguments::{Arguments, Command};
use clap::Parser;

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Run(arguments) => commands::run::run(&arguments),
        Command::Check(arguments) => commands::check::check(&arguments),
        Command::Plot(arguments) => commands::plot::plot(&arguments),
        Command::Campaign(arguments) => commands::campaign::campaign(&arguments),
        Command::Export(arguments) => commands::export::export(&arguments),
        Command::View(arguments) => commands::view::view(&arguments),
        Command::Emulate(arguments) => commands::emulate::emulate(&arguments),
        Command::Preflight(arguments) => commands::preflight::preflight(&arguments),
        Command::Recover(arguments) => commands::recover::recover(&arguments),
        Command::Init(arguments) => commands::init::init(&arguments),
        Command::Robots(arguments) => commands::robots::robots(&arguments),
        Command::Schema => commands::schema::schema(),
        Command::Completions { shell } => commands::completions::completions(shell),
    };
    done.unwrap_or_else(|failure| {
        // Nobody may be reading: the status says it too.
        let _ = writeln!(io::stderr(), "{}", failure.text());
        ExitCode::from(failure.status())
    })
}
