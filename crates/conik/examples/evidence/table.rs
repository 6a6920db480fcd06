//! Outcomes of random scenes as a table, a row for each combination.

use std::time::Duration;

use crate::chain::Measure;
use crate::combo::Combo;
use crate::run::Outcome;
use crate::scene::Scene;

/// A sample counts as outside beyond this: what two kinematics may differ by [task's unit].
pub const ROUNDING: f64 = 1e-12;

/// More mode changes than this in a scene are flicker.
pub const FLICKER: usize = 30;

/// So many mode changes may fall into the time in which the arm comes to rest.
pub const SETTLING: usize = 3;

/// What is wrong with the outcome of a scene, if anything.
pub fn complaint(scene: &Scene, outcome: &Outcome) -> Option<String> {
    let mut complaints = Vec::new();
    let mut complain = |is_wrong: bool, what: String| {
        if is_wrong {
            complaints.push(what);
        }
    };
    complain(outcome.broke, "not finite".into());
    complain(
        outcome.worst() > ROUNDING,
        format!("outside by {:.1e}", outcome.worst()),
    );
    complain(
        outcome.worsened > 0.0,
        format!("worse by {:.1e}", outcome.worsened),
    );
    complain(
        outcome.mode_changes > FLICKER,
        format!(
            "{} mode changes ({} late)",
            outcome.mode_changes, outcome.late_changes
        ),
    );
    complain(
        outcome.changes_at_rest > SETTLING,
        format!("{} changes at rest", outcome.changes_at_rest),
    );
    complain(
        outcome.reversals > 6,
        format!("{} reversals", outcome.reversals),
    );
    complain(
        outcome.late_swings > 12,
        format!("{} late swings", outcome.late_swings),
    );
    complain(
        outcome.stopped_falsely(),
        format!("false stop, |e| falls {:.2e} m/rad", outcome.could_fall),
    );
    complain(
        outcome.peak_speed > std::f64::consts::PI + 1e-9,
        format!("{} rad/s", outcome.peak_speed),
    );
    complain(
        outcome.most_kinematics > 9 || outcome.most_pivots > 60,
        format!(
            "{} kinematics, {} pivots",
            outcome.most_kinematics, outcome.most_pivots
        ),
    );
    let posture = if scene.posture.is_some() {
        ", posture"
    } else {
        ""
    };
    (!complaints.is_empty()).then(|| {
        format!(
            "{} ({} Hz, {} low{posture})",
            complaints.join(", "),
            scene.rate_hz,
            scene.low.len()
        )
    })
}

pub fn print_head(scenes: u64, seed: u64) {
    println!("{scenes} random scenes, seed {seed}.\n");
    let columns = [
        "combination",
        "inside",
        "worst distance [m]",
        "coordinate [m]",
        "view [-]",
        "joint [rad]",
        "mode changes med/p90/max",
        "flicker",
        "reversals p99/max",
        "false stops",
        "stops",
        "waypoints 1/2",
        "mean time [s] 1/2",
        "mean error [m]",
        "speed med/max [rad/s]",
        "acceleration med/p90 [rad/s²]",
        "step med [µs]",
        "pivots max",
        "kinematics max",
    ];
    println!("| {} |", columns.join(" | "));
    println!("|---|{}", "---:|".repeat(columns.len() - 1));
}

pub fn print_row(combo: Combo, outcomes: &[(Scene, Outcome)]) {
    let n = outcomes.len();
    let count = |test: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|(_, o)| test(o)).count();
    let sorted = |value: &dyn Fn(&Outcome) -> f64| -> Vec<f64> {
        let mut values: Vec<f64> = outcomes.iter().map(|(_, o)| value(o)).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let at = |values: &[f64], share: f64| -> f64 {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of the length"
        )]
        let i = (share * (values.len() - 1) as f64).round() as usize;
        values[i]
    };
    let changes = sorted(&|o| o.mode_changes as f64);
    let reversals = sorted(&|o| o.reversals as f64);
    let speeds = sorted(&|o| o.peak_speed);
    let accelerations = sorted(&|o| o.peak_acceleration);
    let steps = sorted(&|o| o.times[0].as_secs_f64() * 1e6);
    let reached = |k: usize| count(&|o| o.waypoints_s[k].is_some());
    let mean_time = |k: usize| {
        let times: Vec<f64> = outcomes
            .iter()
            .filter_map(|(_, o)| o.waypoints_s[k])
            .collect();
        times.iter().sum::<f64>() / times.len().max(1) as f64
    };
    let mean_error = outcomes.iter().map(|(_, o)| o.final_error).sum::<f64>() / n as f64;
    let worst = |is_kind: &dyn Fn(Measure) -> bool| worst_of_kind(outcomes, is_kind);
    let cells = [
        format!("`{combo}`"),
        count(&|o| o.worst() <= ROUNDING && o.worsened <= 0.0).to_string(),
        worst(&|m| matches!(m, Measure::Distance(_))),
        worst(&|m| matches!(m, Measure::Coordinate(_))),
        worst(&|m| matches!(m, Measure::View(_))),
        worst(&|m| matches!(m, Measure::Joint(_))),
        format!(
            "{}/{}/{}",
            at(&changes, 0.5),
            at(&changes, 0.9),
            at(&changes, 1.0)
        ),
        count(&|o| o.mode_changes > FLICKER || o.changes_at_rest > SETTLING).to_string(),
        format!("{}/{}", at(&reversals, 0.99), at(&reversals, 1.0)),
        count(&Outcome::stopped_falsely).to_string(),
        count(&Outcome::stopped).to_string(),
        format!("{}/{}", reached(0), reached(1)),
        format!("{:.2}/{:.2}", mean_time(0), mean_time(1)),
        format!("{mean_error:.4}"),
        format!("{:.2}/{:.3}", at(&speeds, 0.5), at(&speeds, 1.0)),
        format!(
            "{:.0}/{:.0}",
            at(&accelerations, 0.5),
            at(&accelerations, 0.9)
        ),
        format!("{:.2}", at(&steps, 0.5)),
        count_most(outcomes, |o| o.most_pivots),
        count_most(outcomes, |o| o.most_kinematics),
    ];
    println!("| {} |", cells.join(" | "));
    let slowest = outcomes.iter().map(|(_, o)| o.times[1]).max();
    let still: usize = outcomes.iter().map(|(_, o)| o.stood_still).sum();
    let halved: usize = outcomes.iter().map(|(_, o)| o.halvings).sum();
    eprintln!(
        "{combo}: slowest step {:?}, {halved} halvings, {still} ticks at a standstill to stay inside",
        slowest.unwrap_or(Duration::ZERO)
    );
}

fn count_most(outcomes: &[(Scene, Outcome)], value: impl Fn(&Outcome) -> usize) -> String {
    let most = outcomes.iter().map(|(_, o)| value(o)).max();
    most.unwrap_or(0).to_string()
}

/// The furthest that an entered set of a kind was outside; 0 if none was beyond rounding.
fn worst_of_kind(outcomes: &[(Scene, Outcome)], is_kind: &dyn Fn(Measure) -> bool) -> String {
    let mut worst: f64 = 0.0;
    for (scene, outcome) in outcomes {
        for (set, violation) in scene.high.iter().zip(&outcome.violations) {
            if is_kind(set.measure) {
                worst = worst.max(violation.unwrap_or(0.0));
            }
        }
    }
    if worst <= ROUNDING {
        "0".into()
    } else {
        format!("{worst:.1e}")
    }
}
