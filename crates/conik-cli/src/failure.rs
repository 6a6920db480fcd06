//! What can go wrong in a command: how it is shown, and the exit status it means.

use std::error::Error;
use std::fmt;
use std::io::IsTerminal;
use std::path::Path;

use conik_sim::scenario::{LoadError, Mistake, ScenarioErrors};
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Severity,
};

/// Lines longer than this are not shown: a file of noise would fill the screen.
const LONGEST_LINE_SHOWN: usize = 400;

/// A command that failed.
#[derive(Debug)]
pub struct Failure {
    /// What to print on standard error, ready for people.
    text: String,
    /// The exit status: 1 for a fault of the run, 2 for bad usage or bad input.
    status: u8,
}

impl Failure {
    /// Bad usage or bad input: exit status 2.
    pub fn input(error: impl fmt::Display) -> Self {
        Self {
            text: format!("error: {error}"),
            status: 2,
        }
    }

    /// A fault of the run: exit status 1.
    pub fn run(error: impl fmt::Display) -> Self {
        Self {
            text: format!("error: {error}"),
            status: 1,
        }
    }

    /// Mistakes in options that override the scenario, or in what they make of the rest of it.
    pub fn overrides(errors: &ScenarioErrors) -> Self {
        let lines: Vec<String> = errors
            .mistakes()
            .iter()
            .map(
                |Mistake {
                     key, what, help, ..
                 }| match key.as_str() {
                    "control.rate_hz" => format!("error: --rate-hz: {what}; {help}"),
                    "control.duration_s" => format!("error: --duration-s: {what}; {help}"),
                    key => format!("error: with these options, {key}: {what}; {help}"),
                },
            )
            .collect();
        Self {
            text: lines.join("\n"),
            status: 2,
        }
    }

    /// What to print on standard error.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The exit status.
    pub fn status(&self) -> u8 {
        self.status
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        match &error {
            LoadError::Mistakes { path, text, errors } if is_readable(text) => Self {
                text: show(path, text, errors),
                status: 2,
            },
            _ => Self::input(error),
        }
    }
}

/// What an error says, and what each of its causes adds.
pub fn with_causes(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let causes = std::iter::successors(error.source(), |&cause| cause.source());
    for cause in causes.map(ToString::to_string) {
        if !text.contains(&cause) {
            text += &format!("\n  because: {cause}");
        }
    }
    text
}

fn is_readable(text: &str) -> bool {
    text.lines().all(|line| line.len() <= LONGEST_LINE_SHOWN)
}

/// Every mistake with the lines of the file that it is about.
fn show(path: &Path, text: &str, errors: &ScenarioErrors) -> String {
    // Whoever reads a file or a pipe breaks its lines themselves.
    let piped = (!std::io::stderr().is_terminal()).then(|| {
        GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(10_000)
    });
    let mut shown = String::new();
    for mistake in errors.mistakes() {
        let report = miette::Report::new(diagnostic(mistake)).with_source_code(NamedSource::new(
            path.display().to_string(),
            text.to_owned(),
        ));
        match &piped {
            Some(handler) => {
                if handler.render_report(&mut shown, report.as_ref()).is_err() {
                    shown.push_str(&mistake.to_string());
                }
            }
            // As wide as the terminal, in colours if it has any.
            None => shown += format!("{report:?}").trim_start_matches('\n'),
        }
    }
    if errors.more() > 0 {
        shown.push_str(&format!("and {} more mistakes\n", errors.more()));
    }
    shown.trim_end().to_owned()
}

fn diagnostic(mistake: &Mistake) -> MietteDiagnostic {
    let what = match mistake.key.as_str() {
        "" => mistake.what.clone(),
        key => format!("{key}: {}", mistake.what),
    };
    MietteDiagnostic::new(what)
        .with_severity(Severity::Error)
        .with_help(mistake.help.clone())
        .with_label(LabeledSpan::underline(mistake.span.clone()))
}
