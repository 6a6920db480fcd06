//! A run that is watched: its page, served in a thread of its own.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use conik_cli::view::live::{Arm, Live};
use conik_cli::view::server::{Place, Server};
use conik_sim::scenario::Scenario;

use crate::arguments::RunArguments;
use crate::commands::{self, run::Driven};
use crate::failure::Failure;

/// Between two looks at whether to stop.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// A run, and the thread that serves its page.
#[derive(Debug)]
pub struct Watched {
    live: Arc<Live>,
    server: JoinHandle<io::Result<()>>,
}

impl Watched {
    /// Serves the page of a run with this arm until `stop` is set, and prints its address.
    pub fn run(
        arguments: &RunArguments,
        scenario: &Scenario,
        driven: &Driven,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Failure> {
        let watch = &arguments.watch;
        if watch.allow_edit && !driven.is_outside {
            return Err(Failure::input(
                "--allow-edit: simulated arms can be changed anyway; it is for --robot HOST",
            ));
        }
        let arm = if driven.is_outside {
            Arm::Outside {
                may_edit: watch.allow_edit,
            }
        } else {
            Arm::Simulated {
                has_clock: driven.arm.is_real_time(),
            }
        };
        let live = Live::new(&name(&arguments.scenario), scenario, arm, &arguments.robot);
        let place = Place {
            address: watch.listen,
            port: watch.view_port,
        };
        let watched = Self::serve(live.map_err(Failure::input)?, place, stop)?;
        // Its record is written: it does not wait for anybody to look.
        watched.live.helm().begin();
        Ok(watched)
    }

    /// Serves the page of a run until `stop` is set, and prints its address.
    pub fn serve(live: Live, place: Place, stop: &Arc<AtomicBool>) -> Result<Self, Failure> {
        let live = Arc::new(live);
        let server = Server::with_live(place, Arc::clone(&live));
        let server = server.map_err(|error| cannot_listen(place, &error))?;
        let url = server.url();
        let stop = Arc::clone(stop);
        let server = thread::Builder::new()
            .name("page".to_owned())
            .spawn(move || server.serve(&stop))
            .map_err(|error| Failure::run(format!("cannot serve the page: {error}")))?;
        commands::print(&format!("{url}\n"))?;
        Ok(Self { live, server })
    }

    /// The run.
    pub fn live(&self) -> &Live {
        &self.live
    }

    /// Says how the run ended and shows it until `stop` is set.
    pub fn stay(
        self,
        done: Result<ExitCode, Failure>,
        quiet: bool,
        stop: &AtomicBool,
    ) -> Result<ExitCode, Failure> {
        let status = done.unwrap_or_else(|failure| {
            // Nobody may be reading: the status says it too.
            let _ = writeln!(io::stderr(), "{}", failure.text());
            ExitCode::from(failure.status())
        });
        if !quiet && !stop.load(Ordering::Relaxed) {
            commands::print("the page is there until Ctrl-C\n")?;
        }
        while !stop.load(Ordering::Relaxed) && !self.server.is_finished() {
            thread::sleep(LOOK_EVERY);
        }
        self.close()?;
        Ok(status)
    }

    /// Waits until the page is served no longer.
    pub fn close(self) -> Result<(), Failure> {
        match self.server.join() {
            Ok(served) => {
                served.map_err(|error| Failure::run(format!("cannot serve the page: {error}")))
            }
            Err(panic) => std::panic::resume_unwind(panic),
        }
    }
}

/// The name of a scenario: its file's, without what follows the last point.
pub fn name(scenario: &Path) -> String {
    let stem = scenario.file_stem().unwrap_or("run".as_ref());
    stem.to_string_lossy().into_owned()
}

/// What to say where the page cannot be served.
pub fn cannot_listen(place: Place, error: &io::Error) -> Failure {
    let Place { address, port } = place;
    match port {
        0 => Failure::run(format!("cannot listen on {address}: {error}")),
        _ => Failure::run(format!(
            "cannot listen on port {port} of {address}: {error}; without a port any free one is taken"
        )),
    }
}
