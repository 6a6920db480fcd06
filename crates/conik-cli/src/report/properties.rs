//! The five properties that the paper's Section VI confirms, in plain words, with the verdict of
//! the run's monitors on each.

use conik_sim::scenario::Border;
use conik_sim::summary::Property;

use super::replay::moment;
use super::units;
use crate::figure::markup::Escaped;
use crate::figure::{Run, quantity};

/// How far a property binds.
#[derive(Clone, Copy, PartialEq)]
enum Force {
    /// The controller is built to keep it.
    Guarantee,
    /// It depends on the scenario; the run shows it or does not.
    Observation,
}

/// The section of the page.
pub fn section(run: &Run) -> String {
    let properties = &run.summary().properties;
    let rows = [
        (
            "Every equality task reaches its desired value.",
            &properties.equality_converges,
            Force::Observation,
        ),
        (
            "A high-priority set that holds at the start holds all the time.",
            &properties.inside_stays,
            Force::Guarantee,
        ),
        (
            "A high-priority set that does not hold at the start freezes or comes closer.",
            &properties.outside_never_worse,
            Force::Guarantee,
        ),
        (
            "A high-priority set, once entered, is not left again.",
            &properties.entered_stays,
            Force::Guarantee,
        ),
        (
            "Low-priority sets are kept as well; how far they are left otherwise.",
            &properties.low_priority_excess,
            Force::Observation,
        ),
    ];
    let body: String = rows
        .into_iter()
        .enumerate()
        .map(|(nth, (words, property, force))| row(run, nth + 1, words, property, force))
        .collect();
    format!(
        "<section>\n<h2>The five properties</h2>\n<div class=\"table properties\" tabindex=\"0\"><table>\n<thead><tr>\
         <th scope=\"col\">#</th><th scope=\"col\">Property</th><th scope=\"col\">Verdict</th>\
         <th scope=\"col\" class=\"number\">Worst</th><th scope=\"col\" class=\"number\">When</th>\
         <th scope=\"col\">Task</th></tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n\
         <p class=\"note\">Tolerance 10⁻⁶ in the task's unit. {}</p>\n</section>\n",
        what_is_promised(run)
    )
}

fn row(run: &Run, number: usize, words: &str, property: &Property, force: Force) -> String {
    let (class, verdict) = match (property.holds, force) {
        (true, _) => ("holds", "✓ holds"),
        (false, Force::Guarantee) => ("broken", "✗ does not hold"),
        (false, Force::Observation) => ("seen", "○ does not hold"),
    };
    let task = property.task.as_deref();
    let unit = run
        .tasks()
        .iter()
        .find(|candidate| Some(candidate.name.as_str()) == task)
        .map_or("-", |task| quantity::unit(run, task));
    let when = property.at_s.map_or_else(|| "–".to_owned(), moment);
    format!(
        "<tr><td>{number}</td><th scope=\"row\">{words}</th><td class=\"{class}\">{verdict}</td>\
         <td class=\"number\">{}</td><td class=\"number\">{when}</td><td>{}</td></tr>\n",
        units::quantity(property.worst, unit),
        Escaped(task.unwrap_or("–")),
    )
}

fn what_is_promised(run: &Run) -> &'static str {
    if run.summary().settings.scenario.control.border == Border::Freeze {
        "Properties 1 and 5 are observations: whether they hold depends on the scenario. Border \
         <code>freeze</code> promises nothing between samples: a set may be left by what the arm \
         moves in one period before the task is frozen, as in the paper. It is not brought back, so \
         that such dips may add up. They are reported, not counted as faults."
    } else {
        "Properties 1 and 5 are observations: whether they hold depends on the scenario. \
         Properties 2 to 4 are promised by these settings."
    }
}
