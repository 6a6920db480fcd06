//! `conik view`: the page that replays runs.

use std::process::ExitCode;

use conik_cli::view::Recording;
use conik_cli::view::server::Server;

use crate::arguments::ViewArguments;
use crate::failure::{Failure, with_causes};

/// Serves the page until Ctrl-C.
pub fn view(arguments: &ViewArguments) -> Result<ExitCode, Failure> {
    if let Some(file) = arguments.dirs.iter().find(|dir| dir.is_file()) {
        return Err(Failure::input(format!(
            "{} is a file; give the folder that `conik run` wrote for it",
            file.display()
        )));
    }
    let recording =
        Recording::load(&arguments.dirs).map_err(|error| Failure::input(with_causes(&error)))?;
    let stop = super::run::stop_on_ctrl_c()?;
    let port = arguments.port;
    let server = Server::bind(port, &recording).map_err(|error| match port {
        0 => Failure::run(format!("cannot listen on 127.0.0.1: {error}")),
        _ => Failure::run(format!("cannot listen on port {port} of 127.0.0.1: {error}; without --port any free one is taken")),
    })?;
    drop(recording);
    super::print(&format!("{}\n", server.url()))?;
    if !arguments.quiet {
        super::print("the page is there until Ctrl-C\n")?;
    }
    server
        .serve(&stop)
        .map_err(|error| Failure::run(format!("cannot serve the page: {error}")))?;
    Ok(ExitCode::SUCCESS)
}
