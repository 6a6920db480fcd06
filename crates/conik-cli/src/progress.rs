//! Progress lines: of a run, its time, mode, active sets and distance to go; of other work, its share.

use std::cell::Cell;
use std::io::{self, Write};
use std::time::{Duration, Instant};

use conik_sim::columns::Columns;
use conik_sim::experiment::Experiment;
use conik_sim::record::Record;
use conik_sim::summary::ModeChange;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Between two updates of the line.
const EVERY: Duration = Duration::from_millis(66);

/// Between two lines where there is no terminal: a log file should show that the run goes on.
const EVERY_WITHOUT_TERMINAL: Duration = Duration::from_secs(5);

/// Shows how far a run is, on standard error.
#[derive(Debug)]
pub struct Progress {
    /// `None` under `--quiet`.
    bar: Option<ProgressBar>,
    is_terminal: bool,
    last: Instant,
    duration_s: f64,
    /// Where in a record the error of the task at hand stands, and what to call its goal.
    to_go: Option<(usize, &'static str)>,
    waypoints: usize,
}

impl Progress {
    /// For a run of this experiment.
    pub fn new(experiment: &Experiment, quiet: bool) -> Self {
        let stack = experiment.controller.stack();
        let names = Columns::new(stack).names(stack);
        let error_of = |name: &str| {
            let column = format!("{name}_error");
            names.iter().position(|name| *name == column)
        };
        let first_equality = stack.iter().find(|(_, level)| level.interval().is_none());
        let to_go = match (&experiment.waypoints, first_equality) {
            (Some(waypoints), _) => {
                let level = &stack[waypoints.task];
                error_of(level.name()).map(|column| (column, level.task().unit()))
            }
            (None, Some((_, level))) => {
                error_of(level.name()).map(|column| (column, level.task().unit()))
            }
            (None, None) => None,
        };
        let target = ProgressDrawTarget::stderr();
        // A terminal that cannot move its cursor (`TERM=dumb`) is written to like a file.
        let is_terminal = !target.is_hidden();
        let bar = (!quiet).then(|| {
            let bar = ProgressBar::with_draw_target(Some(experiment.last_tick), target);
            // A template that is wrong shows a plain bar.
            if let Ok(style) = ProgressStyle::with_template("{bar:10} {wide_msg}") {
                bar.set_style(style.progress_chars("━╸─"));
            }
            bar
        });
        Self {
            bar,
            is_terminal,
            last: Instant::now(),
            duration_s: experiment.last_tick as f64 / experiment.controller.settings().rate_hz,
            to_go,
            waypoints: experiment.waypoint_count(),
        }
    }

    /// Shows the tick if it is time to.
    pub fn show(&mut self, record: &Record, mode: Option<&ModeChange>) {
        let Some(bar) = &self.bar else { return };
        let every = if self.is_terminal {
            EVERY
        } else {
            EVERY_WITHOUT_TERMINAL
        };
        if self.last.elapsed() < every {
            return;
        }
        self.last = Instant::now();
        let line = self.line(record, mode);
        if self.is_terminal {
            bar.set_position(record.tick);
            bar.set_message(line);
        } else {
            // Nobody may be reading: the run goes on all the same.
            let _ = writeln!(io::stderr(), "{line}");
        }
    }

    /// What grows with the number of sets comes last: a narrow terminal cuts the line.
    fn line(&self, record: &Record, mode: Option<&ModeChange>) -> String {
        let mut line = format!("{:6.2} of {} s", record.t_s, self.duration_s);
        if let Some((column, unit)) = self.to_go {
            line += &format!("  {:.3} {unit} to ", record.task_values[column]);
            line += &match self.waypoints {
                0 | 1 => "go".to_owned(),
                all => format!("waypoint {}/{all}", record.waypoint + 1),
            };
        }
        if let Some(mode) = mode {
            let number = mode
                .mode
                .map_or("–".to_owned(), |number| number.to_string());
            let active = match mode.active.as_slice() {
                [] => "no set active".to_owned(),
                names => names.join(" + "),
            };
            line += &format!("  mode {number}: {active}");
        }
        line
    }

    /// Takes the line away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Shows which share of some work is done, on standard error.
#[derive(Debug)]
pub struct Share {
    /// What is being done.
    what: String,
    /// `None` under `--quiet`.
    bar: Option<ProgressBar>,
    is_terminal: bool,
    last: Cell<Instant>,
}

impl Share {
    /// For work of that name.
    pub fn new(what: &str, quiet: bool) -> Self {
        let target = ProgressDrawTarget::stderr();
        let is_terminal = !target.is_hidden();
        let bar = (!quiet).then(|| {
            let bar = ProgressBar::with_draw_target(Some(100), target);
            if let Ok(style) = ProgressStyle::with_template("{bar:10} {percent} % of {wide_msg}") {
                bar.set_style(style.progress_chars("━╸─"));
            }
            bar
        });
        Self {
            what: what.to_owned(),
            bar,
            is_terminal,
            last: Cell::new(Instant::now()),
        }
    }

    /// Shows that a share of 1 is done, if it is time to.
    pub fn show(&self, done: f64) {
        let Some(bar) = &self.bar else { return };
        let every = if self.is_terminal {
            EVERY
        } else {
            EVERY_WITHOUT_TERMINAL
        };
        if self.last.get().elapsed() < every {
            return;
        }
        self.last.set(Instant::now());
        // Between 0 and 100.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let percent = (100.0 * done.clamp(0.0, 1.0)) as u64;
        if self.is_terminal {
            bar.set_message(self.what.clone());
            bar.set_position(percent);
        } else {
            // Nobody may be reading: the work goes on all the same.
            let _ = writeln!(io::stderr(), "{percent} % of {}", self.what);
        }
    }

    /// Takes the line away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Shows how many of many things are done, how fast, and for how long it still takes, on standard error.
#[derive(Debug)]
pub struct Count {
    /// `None` under `--quiet`.
    bar: Option<ProgressBar>,
    what: &'static str,
    is_terminal: bool,
    last: Cell<Instant>,
    begin: Cell<Option<(Instant, u64)>>,
    all: u64,
}

impl Count {
    /// For so many things of that name.
    pub fn new(what: &'static str, all: u64, quiet: bool) -> Self {
        let target = ProgressDrawTarget::stderr();
        let is_terminal = !target.is_hidden();
        let bar = (!quiet).then(|| {
            let bar = ProgressBar::with_draw_target(Some(all), target);
            if let Ok(style) = ProgressStyle::with_template("{bar:10} {wide_msg}") {
                bar.set_style(style.progress_chars("━╸─"));
            }
            bar
        });
        Self {
            bar,
            what,
            is_terminal,
            last: Cell::new(Instant::now()),
            begin: Cell::new(None),
            all,
        }
    }

    /// Shows that so many are done, if it is time to.
    pub fn show(&self, done: u64) {
        let Some(bar) = &self.bar else { return };
        let (begin, before) = self.begin.get().unwrap_or((Instant::now(), done));
        self.begin.set(Some((begin, before)));
        let every = if self.is_terminal {
            EVERY
        } else {
            EVERY_WITHOUT_TERMINAL
        };
        if self.last.get().elapsed() < every {
            return;
        }
        self.last.set(Instant::now());
        let rate = (done - before.min(done)) as f64 / begin.elapsed().as_secs_f64();
        let left = self.all.saturating_sub(done);
        let remaining = if rate > 0.0 {
            format!(", {} left", time(left as f64 / rate))
        } else {
            String::new()
        };
        let message = format!(
            "{done} of {} {}, {rate:.0} a second{remaining}",
            self.all, self.what
        );
        if self.is_terminal {
            bar.set_position(done);
            bar.set_message(message);
        } else {
            let _ = writeln!(io::stderr(), "{message}");
        }
    }

    /// Takes the line away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A time, as people say it.
fn time(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
