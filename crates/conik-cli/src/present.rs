//! What `conik run` says on the terminal: a heading before, a summary after.

use conik_cli::figure::quantity::wanted;
use conik_cli::report::units::{limit, optional, quantity};
use conik_sim::cycle_times::CycleSummary;
use conik_sim::experiment::Experiment;
use conik_sim::histogram::Distribution;
use conik_sim::joint_limits::LIMIT;
use conik_sim::scenario::{Border, Choice, Control, GoalConfig, Scenario, TaskConfig};
use conik_sim::summary::{Landing, Outcome, Property, Summary, TaskSummary};

use crate::layout::{counted, table, wrapped};
use crate::monitors;

/// Waypoints beyond this number are counted, not listed.
const MOST_WAYPOINTS_LISTED: usize = 8;

/// What is run, on what, and how.
pub fn heading(scenario: &Scenario, arm: &str) -> String {
    let title = scenario
        .title
        .as_ref()
        .map_or(String::new(), |title| format!("{title}\n"));
    let control = &scenario.control;
    let model = scenario.robot.label();
    format!(
        "{title}{model} on {arm}\n{} s at {} Hz, {}\n",
        control.duration_s,
        control.rate_hz,
        rules(control)
    )
}

/// The three choices of how the controller works.
fn rules(control: &Control) -> String {
    format!(
        "rule {}, border {}, recursion {}",
        control.mode_rule.name(),
        control.border.name(),
        control.recursion.name()
    )
}

/// What became of the run.
pub fn summary(summary: &Summary, experiment: &Experiment) -> String {
    if summary.modes.is_empty() {
        return outcome(summary);
    }
    [
        outcome(summary),
        changes(summary),
        waypoints(summary),
        tasks(summary),
        properties(summary),
        limits(summary, experiment),
        monitors::lines(summary),
        machine(summary),
    ]
    .into_iter()
    .filter(|part| !part.is_empty())
    .map(|part| format!("\n{part}"))
    .collect()
}

fn outcome(summary: &Summary) -> String {
    let when = if summary.modes.is_empty() {
        "before the first tick".to_owned()
    } else {
        format!("at {} s", summary.ended_at_s)
    };
    match &summary.outcome {
        Outcome::Completed | Outcome::Running => String::new(),
        Outcome::Interrupted => {
            format!("stopped by hand {when}; the arm was brought to a stop first\n")
        }
        Outcome::Fault { name, .. } => format!("stopped {when} by a fault: {name}\n"),
    }
}

/// That people changed the run, if they did.
fn changes(summary: &Summary) -> String {
    let first = summary.changes.iter().find_map(|change| change.t_s);
    first.map_or(String::new(), |t_s| {
        let times = summary.changes.len();
        wrapped(
            "  ",
            &format!("changed while it ran: {times} x, at first at {t_s} s; bounds below are those from before"),
        )
    })
}

fn waypoints(summary: &Summary) -> String {
    let all = &summary.waypoints_reached_s;
    if all.len() > MOST_WAYPOINTS_LISTED {
        let reached: Vec<f64> = all.iter().flatten().copied().collect();
        let last = reached
            .iter()
            .copied()
            .reduce(f64::max)
            .map_or(String::new(), |t_s| {
                format!(", the last of them at {t_s} s")
            });
        return format!(
            "  {} of {} waypoints reached{last}\n",
            reached.len(),
            all.len()
        );
    }
    all.iter()
        .enumerate()
        .map(|(i, reached)| match reached {
            Some(t_s) => format!("  waypoint {}  reached at {t_s} s\n", i + 1),
            None => format!("  waypoint {}  not reached\n", i + 1),
        })
        .collect()
}

/// One line per task, in the order of priority; of the joints' position limits only those that bound.
fn tasks(summary: &Summary) -> String {
    let mut rows =
        vec![["task", "goal", "result", "first inside", "active for"].map(str::to_owned)];
    let is_idle = |task: &TaskConfig| {
        let result = summary.tasks.get(&task.name);
        let did = |result: &TaskSummary| (result.worst_violation, result.active_s);
        task.name.starts_with(LIMIT) && result.map(did) == Some((Some(0.0), Some(0.0)))
    };
    for task in &summary.settings.scenario.all_tasks() {
        if !is_idle(task) {
            rows.push(task_row(summary, task));
        }
    }
    table(&rows)
}

fn task_row(summary: &Summary, task: &TaskConfig) -> [String; 5] {
    let unit = summary
        .settings
        .units
        .get(&task.name)
        .map_or("", String::as_str);
    let result = summary.tasks.get(&task.name).cloned().unwrap_or_default();
    let goal = match &task.goal {
        GoalConfig::Waypoints { .. } => match task.goal.waypoint_count() {
            Some(count) if count != 1 => format!("{count} waypoints"),
            _ => "1 waypoint".to_owned(),
        },
        GoalConfig::Desired { desired, .. } => {
            let values = || {
                let values = desired.iter().map(|value| limit(*value, unit));
                values.collect::<Vec<_>>().join(", ")
            };
            format!("= {}", wanted(task).unwrap_or_else(values))
        }
        GoalConfig::Set { min, max, .. } => match (min, max) {
            (Some(min), Some(max)) => format!("{} … {}", limit(*min, "-"), limit(*max, unit)),
            (Some(min), None) => format!("≥ {}", limit(*min, unit)),
            (None, Some(max)) => format!("≤ {}", limit(*max, unit)),
            (None, None) => "anything".to_owned(),
        },
    };
    match result.worst_violation {
        Some(worst) => [
            task.name.clone(),
            goal,
            match worst {
                0.0 => "never outside".to_owned(),
                worst => format!("at most {} outside", quantity(worst, unit)),
            },
            match result.entered_set_s {
                Some(0.0) => "the start".to_owned(),
                Some(t_s) => format!("{t_s} s"),
                None => "never".to_owned(),
            },
            format!("{:.2} s", result.active_s.unwrap_or(0.0)),
        ],
        None => [
            task.name.clone(),
            goal,
            format!("{} off at the end", optional(result.final_error, unit)),
            String::new(),
            String::new(),
        ],
    }
}

/// The five properties with verdicts.
fn properties(summary: &Summary) -> String {
    let properties = &summary.properties;
    let high_priority_holds = [
        &properties.inside_stays,
        &properties.outside_never_worse,
        &properties.entered_stays,
    ]
    .iter()
    .all(|property| property.holds);
    let mut text =
        "  the paper's five properties (Section VI), to 1e-6; 2 to 4: high-priority sets\n"
            .to_owned();
    for (sentence, property, observation) in [
        (
            "1  equality tasks converge",
            &properties.equality_converges,
            true,
        ),
        (
            "2  sets held at the start stay",
            &properties.inside_stays,
            false,
        ),
        (
            "3  sets outside never get worse",
            &properties.outside_never_worse,
            false,
        ),
        (
            "4  sets once entered stay",
            &properties.entered_stays,
            false,
        ),
        (
            "5  low-priority sets stay",
            &properties.low_priority_excess,
            true,
        ),
    ] {
        let verdict = match (property.holds, observation) {
            (true, _) => "holds",
            (false, true) => "not here",
            (false, false) => "broken",
        };
        let worst = worst(summary, property);
        text += format!("  {sentence:<33}{verdict:<10}{worst}").trim_end();
        text.push('\n');
    }
    if !high_priority_holds {
        let why = match summary.settings.scenario.control.border {
            Border::Freeze => {
                "border `freeze` promises nothing between samples: a dip is of the order of \
                 one period's motion, but is not brought back, and dips may add up"
            }
            Border::Land if was_announced(summary) => {
                "border `land` promises 2 to 4. Each tick before had announced it: no velocity \
                 within the limits kept every set"
            }
            Border::Land => "border `land` promises 2 to 4: this is a fault",
        };
        text += &wrapped("  ", why);
    }
    text
}

/// Whether sets were left, and never without notice.
fn was_announced(summary: &Summary) -> bool {
    let seen = summary.monitors.as_ref();
    seen.is_some_and(|seen| seen.went_outside.is_seen() && !seen.unannounced.is_seen())
}

fn worst(summary: &Summary, property: &Property) -> String {
    let (Some(task), Some(at_s)) = (&property.task, property.at_s) else {
        return String::new();
    };
    let unit = summary.settings.units.get(task).map_or("", String::as_str);
    format!("{} in {task} at {at_s} s", quantity(property.worst, unit))
}

fn limits(summary: &Summary, experiment: &Experiment) -> String {
    let period = 1.0 / experiment.controller.settings().rate_hz;
    let mut text = String::new();
    if summary.no_mode_ticks > 0 {
        text += &wrapped(
            "  ",
            &format!(
                "for {:.3} s no allowed mode kept every set, and the arm stood still: does \
                 `exclusive` name sets that can be at their border together?",
                summary.no_mode_ticks as f64 * period
            ),
        );
    }
    if let Some(landing) = summary.landing.filter(|landing| landing.halvings > 0) {
        text += &wrapped("  ", &halvings(&landing, period));
    }
    text
}

fn halvings(landing: &Landing, period: f64) -> String {
    let halved = format!(
        "to stay inside the sets the velocity was halved {}",
        counted(landing.halvings, "time")
    );
    if landing.stood_still_ticks == 0 {
        return halved;
    }
    format!(
        "{halved}, and for {:.3} s no velocity would do, and the arm stood still",
        landing.stood_still_ticks as f64 * period
    )
}

fn machine(summary: &Summary) -> String {
    let time = &summary.step_time_us;
    let mut text = format!(
        "  {}{}\n  a step took {:.2} µs (99 % below {:.2} µs, longest {:.0} µs)\n",
        counted(summary.modes.len() as u64 - 1, "mode change"),
        monitors::most_changes(summary),
        time.median,
        time.p99,
        time.max
    );
    if let Some(tracking) = &summary.tracking {
        let (joint, max) = tracking
            .max_rad
            .iter()
            .copied()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0, 0.0));
        let rms = tracking.rms_rad.get(joint).copied().unwrap_or(0.0);
        if let Some(delay_s) = tracking.delay_s {
            let left = tracking.delayed_max_rad.iter().flatten().copied();
            let left = left.fold(0.0, f64::max);
            text += &format!(
                "  the arm ran {:.1} ms behind its reference, and but for that within {}\n",
                1e3 * delay_s,
                quantity(left, "rad")
            );
        }
        text += &format!(
            "  the arm followed within {} (joint {}, root mean square {})\n  {} without a reference\n",
            quantity(max, "rad"),
            joint + 1,
            quantity(rms, "rad"),
            counted(summary.deadline_misses, "cycle"),
        );
    }
    text + &summary.cycles.as_ref().map_or(String::new(), cycles)
}

/// When packages came and were answered.
fn cycles(cycles: &CycleSummary) -> String {
    let row = |name: &str, times: &Distribution| {
        let times = [times.median, times.p99, times.p999, times.max];
        let [median, p99, p999, max] = times.map(|us| format!("{us:.0}"));
        [name.to_owned(), median, p99, p999, max]
    };
    let mut rows = vec![
        ["[µs]", "median", "99 %", "99.9 %", "longest"].map(str::to_owned),
        row("package to package", &cycles.period_us),
    ];
    rows.extend(
        cycles
            .answer_us
            .as_ref()
            .map(|times| row("package to answer", times)),
    );
    format!(
        "{}  {} missed, {} repeated\n",
        table(&rows),
        counted(cycles.missed, "cycle"),
        cycles.repeated
    )
}
