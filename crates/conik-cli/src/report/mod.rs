//! The report of a run: one page that opens anywhere, also off line.
//!
//! [`write`] makes `report.html` from a run folder: the verdict, the paper's Figure 4 for this
//! run, the task table, the five properties, and the settings; and, at the press of a button, the
//! run replayed. The figures come from [`figure`](crate::figure), the replay is the page of
//! [`view`](crate::view); here they are put into words and tables.

use std::error::Error;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::thread;

use crate::figure::chart::Layout;
use crate::figure::markup::Escaped;
use crate::figure::svg::Picture;
use crate::figure::{Run, RunError, arm, errors, joints, mode, path, sets};
use crate::view::ViewError;

mod cycles;
pub mod monitors;
mod policy;
mod properties;
mod replay;
mod rotation;
mod table;
mod tables;
pub mod units;
mod verdict;

/// Width and height of the picture of the path [px], still readable on a phone.
const PATH: (f64, f64) = (520.0, 500.0);

/// Width and greatest height of the picture of the arm [px].
const ARM: (f64, f64) = (620.0, 560.0);

const STYLE: &str = include_str!("style.css");

/// Writes `report.html` into the run folder `dir` and returns its path.
pub fn write(dir: &Path) -> Result<PathBuf, ReportError> {
    // The replay can plot every column.
    let run = Run::load_columns(dir, |_| true)?;
    let path = dir.join("report.html");
    match fs::write(&path, page(&run, dir)) {
        Ok(()) => Ok(path),
        Err(source) => Err(ReportError::Write { path, source }),
    }
}

/// The page as text, of a run that was read from the folder `dir`.
pub fn page(run: &Run, dir: &Path) -> String {
    let (report, replay) = thread::scope(|scope| {
        // Packing takes as long as drawing.
        let replay = scope.spawn(|| replay::elements(run, dir));
        let report = report(run);
        match replay.join() {
            Ok(replay) => (report, replay),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    let title = Escaped(run.title());
    let (turning, of_turning) = policy::script(rotation::SCRIPT);
    let (switching, of_switching) = policy::script(replay::SCRIPT);
    let policy = policy::element(&[&of_turning, &of_switching, replay::digest_of_player()]);
    let (tabs, elements, note) = match replay {
        Ok(elements) => (replay::TABS, elements, String::new()),
        Err(error) => ("", String::new(), no_replay(&error)),
    };
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{policy}\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{tabs}<main>\n\
         <h1>{title}</h1>\n{}{note}{report}</main>\n{elements}{turning}{switching}</body>\n</html>\n",
        verdict::banner(run),
    )
}

fn report(run: &Run) -> String {
    let mut sections = vec![figure_four(run)];
    if !run.was_cut_off() {
        sections.extend([
            tables::tasks(run),
            properties::section(run),
            monitors::section(run),
            tables::timing(run),
            cycles::section(run),
        ]);
    }
    sections.extend([
        joints_section(run),
        tables::mode_changes(run),
        settings(run),
    ]);
    sections.concat()
}

fn no_replay(error: &ViewError) -> String {
    // What lies beneath names no folder: the report may be read elsewhere.
    let why = error
        .source()
        .map_or(error.to_string(), ToString::to_string);
    format!(
        "<p class=\"note\">This run cannot be replayed here: {}.</p>\n",
        Escaped(&why)
    )
}

/// The paper's Figure 4 for this run, in the paper's order.
fn figure_four(run: &Run) -> String {
    let cell = Layout::alone(440.0, 210.0);
    let equalities = errors::tasks(run);
    let (views, others): (Vec<_>, Vec<_>) = equalities
        .into_iter()
        .partition(|task| crate::figure::quantity::is_view(task));
    let set_charts = sets::tasks(run)
        .into_iter()
        .map(|task| sets::chart(run, task, cell));
    let error_charts = others
        .into_iter()
        .chain(views)
        .map(|task| errors::chart(run, task, cell));
    let sets: String = set_charts.map(|chart| card(&chart)).collect();
    let errors: String = error_charts.map(|chart| card(&chart)).collect();
    let path = path::panel(run, PATH.0, PATH.1);
    let arm = arm::panel(run, &[], ARM.0, ARM.1).map(|picture| {
        let picture = scrolling_card(&picture);
        format!("<h3>The arm at a few times</h3>\n{picture}")
    });
    format!(
        "<section>\n<h2>What happened</h2>\n\
         <h3>Path of the tool</h3>\n<figure class=\"card\" id=\"path\">{}{}</figure>\n\
         {}<h3>Mode over time</h3>\n{}\
         <h3>Set-based tasks and their limits</h3>\n{}{}\
         <h3>Errors of the equality tasks</h3>\n{}</section>\n",
        path.to_html(),
        rotation::scene(run, PATH.0, PATH.1),
        arm.unwrap_or_default(),
        scrolling_card(&mode::panel(run, 680.0)),
        cards(&sets, &format!("This run has no {}.", sets::kind(run))),
        left_out(run),
        cards(&errors, "This run has no equality task."),
    )
}

fn left_out(run: &Run) -> String {
    match sets::pairs_left_out(run) {
        0 => String::new(),
        1 => {
            "<p class=\"note\">One pair of shapes never came to its limit, and has no chart.</p>\n"
                .to_owned()
        }
        pairs => format!(
            "<p class=\"note\">{pairs} pairs of shapes never came to their limits, and have no charts.</p>\n"
        ),
    }
}

fn joints_section(run: &Run) -> String {
    format!(
        "<section>\n<h2>Joints</h2>\n{}</section>\n",
        scrolling_card(&joints::panel(run, 860.0))
    )
}

fn settings(run: &Run) -> String {
    let settings = &run.summary().settings;
    // Every part of the settings was read from JSON, so it can be written as JSON.
    let text = serde_json::to_string_pretty(settings).unwrap_or_default();
    format!(
        "<section>\n<h2>Settings</h2>\n<details>\n<summary>The scenario after defaults and \
         overrides</summary>\n<pre>{}</pre>\n</details>\n</section>\n<footer>Conik {}, format {} \
         of the run folder</footer>\n",
        Escaped(&text),
        Escaped(&run.summary().version),
        run.summary().format,
    )
}

fn cards(cards: &str, nothing: &str) -> String {
    if cards.is_empty() {
        format!("<p>{nothing}</p>\n")
    } else {
        format!("<div class=\"cards\">\n{cards}</div>\n")
    }
}

fn card(picture: &Picture) -> String {
    format!("<figure class=\"card\">{}</figure>\n", picture.to_html())
}

/// A card of a picture too wide for a phone: it scrolls rather than becoming unreadable.
fn scrolling_card(picture: &Picture) -> String {
    let svg = picture.to_html();
    format!("<figure class=\"card scrolling\" tabindex=\"0\">{svg}</figure>\n")
}

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The run folder cannot be read.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The page cannot be written.
    #[error("{}: cannot be written", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
}
