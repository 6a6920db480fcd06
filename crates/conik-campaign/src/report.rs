//! `report.html`: what a campaign shows, in one file.

use std::fmt::Write;

use conik_sim::scenario::Choice;

use crate::class::Class;
use crate::plan::{Plan, Starts};
use crate::tally::{PROPERTIES_IN_WORDS, Tally, quantile};
use crate::worst;

/// Classes that say of a run that the method did not do what it promises, rather than what it cannot do.
const IN_DOUBT: [Class; 2] = [Class::Unexplained, Class::Fault];

/// The page of a campaign.
pub fn page(plan: &Plan, tally: &Tally) -> String {
    let title = plan
        .scenario
        .title
        .clone()
        .unwrap_or_else(|| "Campaign".to_owned());
    let title = escaped(&title);
    format!(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{title}: {} runs</title>\n<style>{STYLE}</style>\n<main>\n\
         <h1>{title}</h1>\n<p>{}</p>\n<p class=\"verdict {}\">{}</p>\n\
         <h2>The five properties</h2>\n{}\n\
         <h2>What became of the runs</h2>\n{}\n{}\n\
         <h2>Figures</h2>\n{}\n\
         <p class=\"note\">Every run is a row of <code>runs.parquet</code>. A start may lie outside of sets: \
         property 2 is about runs in which a set holds at the start, 3 and 4 about those in which one does not. \
         Property 1 counts as kept when all waypoints were reached, or an error is at most {} at the end. With 95&nbsp;% \
         confidence, the share of all such runs that break a property is below the bound (Wilson).</p>\n\
         </main>\n</html>\n",
        grouped(tally.runs),
        described(plan),
        match (in_doubt(tally), sets_are_kept(tally)) {
            (0, true) => "good",
            (0, false) => "left",
            _ => "bad",
        },
        verdict(tally),
        properties(tally),
        bars(tally),
        classes(tally),
        figures(tally),
        crate::flown::DONE,
    )
}

fn in_doubt(tally: &Tally) -> u64 {
    let of = |class: &Class| tally.classes.get(class).copied().unwrap_or(0);
    IN_DOUBT.iter().map(of).sum()
}

/// Whether no run left a set of high priority.
fn sets_are_kept(tally: &Tally) -> bool {
    let mut promised = tally.properties[1..4].iter();
    promised.all(|kept| kept.kept == kept.shown)
}

fn verdict(tally: &Tally) -> String {
    let sets = if sets_are_kept(tally) {
        "No set of high priority was left in any run."
    } else {
        "Sets of high priority were left in some runs."
    };
    match in_doubt(tally) {
        0 => format!("{sets} Every failure is explained."),
        count => format!("{sets} {} runs are not explained.", grouped(count)),
    }
}

/// What was run, in a sentence or two.
fn described(plan: &Plan) -> String {
    let control = &plan.scenario.control;
    let varied = &plan.varied;
    let starts = match varied.starts {
        Starts::Same => "from the scenario's start".to_owned(),
        Starts::Anywhere => {
            "from anywhere: each joint between its limits, at most half a turn from zero".to_owned()
        }
        Starts::Near(near) => {
            format!("with each joint up to {near} rad or m from the scenario's start")
        }
    };
    let mut text = format!(
        "{} runs of {} s of <code>{}</code>, rule <code>{}</code>, border <code>{}</code>, recursion <code>{}</code>, {starts}; seed {}.",
        grouped(plan.runs),
        control.duration_s,
        escaped(plan.scenario.robot.label()),
        control.mode_rule.name(),
        control.border.name(),
        control.recursion.name(),
        plan.seed,
    );
    let rates: Vec<String> = varied.rates_hz.iter().map(ToString::to_string).collect();
    let mut more = vec![if rates.is_empty() {
        format!("{} Hz", control.rate_hz)
    } else {
        format!("{} Hz", rates.join(", "))
    }];
    if varied.obstacles_m > 0.0 {
        more.push(format!(
            "obstacles shifted by up to {} m",
            varied.obstacles_m
        ));
    }
    if varied.targets_m > 0.0 {
        more.push(format!("targets shifted by up to {} m", varied.targets_m));
    }
    if let Some([least, most]) = varied.servo_lag_s {
        more.push(format!(
            "an arm that lags behind its reference by {least} to {most} s"
        ));
    }
    let _ = write!(text, " {}.", more.join("; "));
    text
}

fn properties(tally: &Tally) -> String {
    let rows: String = PROPERTIES_IN_WORDS
        .iter()
        .zip(&tally.properties)
        .map(|(words, kept)| {
            if kept.shown == 0 {
                return format!("<tr><td>{words}<td colspan=\"4\">no run could show it</tr>\n");
            }
            format!(
                "<tr><td>{words}<td class=\"n\">{}<td class=\"n\">{}<td class=\"n\">{}<td class=\"n\">{:.2e}</tr>\n",
                grouped(kept.shown),
                grouped(kept.shown - kept.kept),
                percent(kept.bound()),
                kept.worst,
            )
        })
        .collect();
    format!(
        "<div class=\"wide\"><table><tr><th>property<th class=\"n\">runs that can show it<th class=\"n\">broken in\
         <th class=\"n\">95&nbsp;% bound<th class=\"n\">worst deviation</tr>\n{rows}</table></div>"
    )
}

/// One bar of all classes, by their shares.
fn bars(tally: &Tally) -> String {
    let mut at = 0.0;
    let runs = tally.runs.max(1) as f64;
    let bars: String = tally
        .classes
        .iter()
        .map(|(class, count)| {
            let width = 100.0 * *count as f64 / runs;
            let bar = format!(
                "<rect x=\"{at:.3}%\" width=\"{width:.3}%\" height=\"28\" fill=\"{}\"><title>{}: {}</title></rect>",
                colour(*class),
                class.name(),
                grouped(*count),
            );
            at += width;
            bar
        })
        .collect();
    format!(
        "<svg class=\"bars\" width=\"100%\" height=\"28\" role=\"img\" aria-label=\"Shares of the classes below\">{bars}</svg>"
    )
}

fn classes(tally: &Tally) -> String {
    let rows: String = tally
        .classes
        .iter()
        .map(|(class, count)| {
            let runs = tally.examples.get(class).map_or(&[][..], Vec::as_slice);
            let links: Vec<String> = runs
                .iter()
                .map(|(_, run)| {
                    let file = worst::file(*class, *run);
                    format!("<a href=\"{}\">{run}</a>", file.display())
                })
                .collect();
            format!(
                "<tr><td><svg width=\"12\" height=\"12\" aria-hidden=\"true\"><rect width=\"12\" height=\"12\" fill=\"{}\"/></svg> \
                 {}<td>{}<td class=\"n\">{}<td class=\"n\">{}<td>{}</tr>\n",
                colour(*class),
                class.name(),
                class.in_words(),
                grouped(*count),
                percent(*count as f64 / tally.runs.max(1) as f64),
                links.join(", "),
            )
        })
        .collect();
    format!(
        "<div class=\"wide\"><table><tr><th>class<th>why<th class=\"n\">runs<th class=\"n\">share<th>the worst, as scenarios</tr>\n{rows}</table></div>"
    )
}

fn figures(tally: &Tally) -> String {
    let mut arrived = tally.arrived_s.clone();
    let mut changes: Vec<f64> = tally
        .mode_changes
        .iter()
        .map(|count| *count as f64)
        .collect();
    let row = |name: &str, numbers: &mut [f64]| {
        let cells: String = [0.0, 0.5, 0.9, 0.99, 1.0]
            .iter()
            .map(|share| match quantile(numbers, *share) {
                Some(number) => format!("<td class=\"n\">{}", rounded(number)),
                None => "<td class=\"n\">–".to_owned(),
            })
            .collect();
        format!(
            "<tr><td>{name}<td class=\"n\">{}{cells}</tr>\n",
            grouped(numbers.len() as u64)
        )
    };
    let rows =
        row("last waypoint reached after [s]", &mut arrived) + &row("mode changes", &mut changes);
    format!(
        "<div class=\"wide\"><table><tr><th>figure<th class=\"n\">runs<th class=\"n\">least<th class=\"n\">median\
         <th class=\"n\">90&nbsp;%<th class=\"n\">99&nbsp;%<th class=\"n\">greatest</tr>\n{rows}</table></div>"
    )
}

/// Colours that those tell apart too who see fewer.
fn colour(class: Class) -> &'static str {
    match class {
        Class::None => "#009e73",
        Class::OnItsWay => "#56b4e9",
        Class::DependentTasks => "#0072b2",
        Class::Singularity => "#8172b3",
        Class::LocalMinimum => "#e69f00",
        Class::ConflictOfSets => "#cc79a7",
        Class::FrozenInside => "#f0e442",
        Class::SpeedLimit => "#004d40",
        Class::Freeze => "#999999",
        Class::Announced => "#c4c4c4",
        Class::ServoLag => "#7f5f3f",
        Class::Fault => "#000000",
        Class::Unexplained => "#d55e00",
    }
}

fn percent(share: f64) -> String {
    match share * 100.0 {
        0.0 => "0 %".to_owned(),
        percent if percent < 0.1 => format!("{percent:.4} %"),
        percent => format!("{percent:.2} %"),
    }
}

fn rounded(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number with a space between thousands.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (nth, digit) in digits.chars().enumerate() {
        if nth > 0 && (digits.len() - nth).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

const STYLE: &str = "
:root { color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif; }
body { margin: 0; } main { max-width: 60rem; margin: auto; padding: 1rem; }
table { border-collapse: collapse; width: 100%; } .wide { overflow-x: auto; }
th, td { text-align: left; padding: .3rem .6rem; border-bottom: 1px solid #8886; vertical-align: top; }
.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.verdict { padding: .6rem 1rem; border-left: .4rem solid #009e73; background: #009e7318; }
.verdict.left { border-color: #e69f00; background: #e69f0018; }
.verdict.bad { border-color: #d55e00; background: #d55e0018; }
.bars { border-radius: 4px; overflow: hidden; margin-bottom: .6rem; }
.note { color: GrayText; font-size: .9rem; }
";
