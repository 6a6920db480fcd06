//! `conik check`: what a scenario is, and what is doubtful about it, before anything moves.

use std::process::ExitCode;

use conik::{Joint, JointKind, JointLimits};
use conik_cli::report::units::limit;
use conik_sim::check::{Findings, find};
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Choice, GoalConfig, Scenario};

use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::layout::{table, wrapped};

/// Prints the robot, the hierarchy, the modes and the doubts.
pub fn check(arguments: &CheckArguments) -> Result<ExitCode, Failure> {
    let scenario = Scenario::load(&arguments.scenario)?;
    let experiment = Experiment::new(&scenario).map_err(Failure::input)?;
    let findings = find(&scenario, &experiment);
    let mut text = String::new();
    if let Some(title) = &scenario.title {
        text += &format!("{title}\n\n");
    }
    text += &robot(&scenario, &experiment, &findings);
    text += &hierarchy(&scenario, &experiment, &findings);
    text += &modes(&scenario, &experiment);
    text += &doubts(&findings);
    super::print(&text)
}

fn robot(scenario: &Scenario, experiment: &Experiment, findings: &Findings) -> String {
    let tool = findings
        .tool_m
        .map(|value| format!("{value:.4}"))
        .join(", ");
    let mut text = format!(
        "robot {}, tool at ({tool}) m at the start\n",
        scenario.robot.name()
    );
    for (i, (joint, q)) in experiment
        .robot
        .joints()
        .iter()
        .zip(experiment.q0.iter())
        .enumerate()
    {
        let name = &joint.name;
        let (per_unit, unit) = unit(joint);
        text += &format!(
            "  {} {name:<22} starts at {:8.3}{unit}{}\n",
            i + 1,
            q * per_unit,
            limits(joint)
        );
    }
    let notes = scenario.robot.notes();
    if !notes.is_empty() {
        text += &format!("notes on {}:\n", scenario.robot.name());
    }
    for note in notes {
        text += &wrapped("  - ", &note);
    }
    text + "\n"
}

/// In what positions of a joint are shown, and how many of it are in a radian or metre.
fn unit(joint: &Joint) -> (f64, &'static str) {
    match joint.kind {
        JointKind::Revolute => (1_f64.to_degrees(), "°"),
        JointKind::Prismatic => (1.0, " m"),
    }
}

/// What a joint must not exceed: `, -90.0…90.0°, at most 180.0°/s`.
fn limits(joint: &Joint) -> String {
    let (per_unit, unit) = unit(joint);
    let JointLimits {
        position,
        speed,
        acceleration,
    } = joint.limits;
    let digits = match joint.kind {
        JointKind::Revolute => 1,
        JointKind::Prismatic => 3,
    };
    let mut text = String::new();
    if let Some((min, max)) = position {
        text += &format!(
            ", {:.digits$}…{:.digits$}{unit}",
            min * per_unit,
            max * per_unit
        );
    }
    if let Some(limit) = speed {
        text += &format!(", ≤ {:.digits$}{unit}/s", limit * per_unit);
    }
    if let Some(limit) = acceleration {
        text += &format!(", ≤ {:.0}{unit}/s²", limit * per_unit);
    }
    text
}

fn hierarchy(scenario: &Scenario, experiment: &Experiment, findings: &Findings) -> String {
    let mut rows = vec![["task", "kind", "wanted", "at the start"].map(str::to_owned)];
    let stack = experiment.controller.stack();
    let tasks = scenario.all_tasks();
    for (((id, level), config), now) in stack.iter().zip(&tasks).zip(&findings.values) {
        let unit = level.task().unit();
        let kind = match (&config.goal, stack.is_high_priority(id)) {
            (GoalConfig::Set { .. }, true) => "high-priority set",
            (GoalConfig::Set { .. }, false) => "low-priority set",
            _ => "equality",
        };
        let wanted = match level.interval() {
            Some(set) if set.min.is_finite() && set.max.is_finite() => {
                format!("{} … {}", limit(set.min, "-"), limit(set.max, unit))
            }
            Some(set) if set.min.is_finite() => format!("≥ {}", limit(set.min, unit)),
            Some(set) => format!("≤ {}", limit(set.max, unit)),
            None => format!("gain {}/s", config.goal.gain_per_s().unwrap_or(0.0)),
        };
        rows.push([config.name.clone(), kind.to_owned(), wanted, now.clone()]);
    }
    format!("tasks in decreasing priority\n{}\n", table(&rows))
}

fn modes(scenario: &Scenario, experiment: &Experiment) -> String {
    let sets = experiment
        .controller
        .stack()
        .iter()
        .filter(|(_, level)| level.interval().is_some())
        .count();
    let count = experiment
        .mode_order
        .count()
        .map_or("more modes than fit 64 bits".to_owned(), |count| {
            format!("{count} modes")
        });
    let control = &scenario.control;
    let mut text = format!(
        "{sets} set-based tasks make {count}\n{} s at {} Hz\n",
        control.duration_s, control.rate_hz,
    );
    text += &explained("rule", control.mode_rule);
    text += &explained("border", control.border);
    text += &explained("recursion", control.recursion);
    text + "\n"
}

/// A setting of the controller, and what it means.
fn explained<T: Choice>(setting: &str, chosen: T) -> String {
    let about = T::ALL.iter().find(|(value, _)| *value == chosen);
    let about = about.map_or("", |(_, about)| about);
    wrapped("  ", &format!("{setting} {}: {about}", chosen.name()))
}

fn doubts(findings: &Findings) -> String {
    if findings.doubts.is_empty() {
        return "nothing is doubtful\n".to_owned();
    }
    let mut text = "doubtful:\n".to_owned();
    for doubt in &findings.doubts {
        text += &wrapped("  - ", doubt);
    }
    text
}
