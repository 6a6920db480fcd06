//! `--explain T`: what the controller decided at a time of the run, in plain words.

use std::collections::BTreeMap;

use conik::{Interval, JointKind, Kinematics, Reason, Vec3};
use conik_cli::report::units::{limit, quantity};
use conik_sim::columns::Columns;
use conik_sim::experiment::Experiment;
use conik_sim::mover::Mover;
use conik_sim::record::Record;
use conik_sim::scenario::TaskKind;

use crate::failure::Failure;
use crate::layout::{table, wrapped};

/// The times asked about, and the records of their ticks.
#[derive(Debug)]
pub struct Explanations {
    /// Each time [s] with its tick.
    asked: Vec<(f64, u64)>,
    records: BTreeMap<u64, Record>,
}

impl Explanations {
    /// For these times [s], each of which must be within the run.
    pub fn new(times: &[f64], experiment: &Experiment) -> Result<Self, Failure> {
        let period_s = experiment.period_s();
        let end_s = experiment.last_tick as f64 * period_s;
        let tick_of = |&t_s: &f64| {
            if !(0.0..=end_s + 1e-9).contains(&t_s) {
                return Err(Failure::input(format!(
                    "--explain: {t_s} s is not within the run, which is from 0 to {end_s} s"
                )));
            }
            // Positive, and no more than the last tick.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let tick = (t_s / period_s + 1e-9).floor() as u64;
            Ok((t_s, tick))
        };
        Ok(Self {
            asked: times.iter().map(tick_of).collect::<Result<_, _>>()?,
            records: BTreeMap::new(),
        })
    }

    /// Takes in one record; keeps it if it is asked about.
    pub fn take(&mut self, record: &Record) {
        if self.asked.iter().any(|&(_, tick)| tick == record.tick) {
            self.records.insert(record.tick, record.clone());
        }
    }

    /// An explanation of each time asked about, in the order asked.
    pub fn in_words(&self, experiment: &Experiment) -> String {
        let explained = self.asked.iter().map(|&(t_s, tick)| {
            let record = self.records.get(&tick);
            record.map_or_else(
                || format!("\nat {t_s} s there is nothing to explain: the run had ended\n"),
                |record| format!("\n{}", explain(t_s, record, experiment)),
            )
        });
        explained.collect()
    }
}

fn explain(asked_s: f64, record: &Record, experiment: &Experiment) -> String {
    let nearest = if asked_s == record.t_s {
        String::new()
    } else {
        format!(", the last at or before {asked_s} s")
    };
    let mut text = format!("at {} s (tick {}{nearest})\n", record.t_s, record.tick);
    text += &wrapped("  ", &mode(record, experiment));
    if let Some(way) = waypoint(record, experiment) {
        text += &wrapped("  ", &way);
    }
    text += &tasks(record, experiment);
    for mover in experiment.movers.iter().filter(|it| !it.motion.is_rest()) {
        text += &wrapped("  ", &moved(mover, record.t_s, experiment));
    }
    let stack = experiment.controller.stack();
    for reason in &record.reasons {
        text += &wrapped("  - ", &reason.in_words(stack).to_string());
    }
    text += &wrapped("  - ", &speed(record, experiment));
    text
}

/// Where what moves of a task is: its point, its direction, its desired value.
fn moved(mover: &Mover, t_s: f64, experiment: &Experiment) -> String {
    let level = &experiment.controller.stack()[mover.task];
    let what = match mover.kind {
        TaskKind::Position | TaskKind::Pose { .. } => "target",
        _ => "point",
    };
    let point = mover.point_at(t_s).map(|point| {
        let [x, y, z] = point.map(|value| format!("{value:.4}"));
        format!("{what} is at ({x}, {y}, {z}) m")
    });
    let turned = mover.motion.angular_velocity_rad_per_s.map(|_| {
        let turned = Vec3::from(mover.motion.turned_at(t_s)).norm();
        format!("direction has turned by {:.2} deg", turned.to_degrees())
    });
    let desired = mover
        .desired_at(t_s)
        .map(|value| format!("desired value is {}", quantity(value, level.task().unit())));
    let ways: Vec<_> = [point, turned, desired].into_iter().flatten().collect();
    format!("`{}`: its {}", level.name(), ways.join("; its "))
}

fn mode(record: &Record, experiment: &Experiment) -> String {
    let stack = experiment.controller.stack();
    let names: Vec<&str> = record
        .active
        .iter()
        .map(|task| stack[task].name())
        .collect();
    let number = experiment.mode_order.number(&record.active);
    let mode = number.map_or("a mode without a number".to_owned(), |number| {
        format!("mode {number}")
    });
    if names.is_empty() {
        format!("{mode}, no set is active")
    } else {
        format!("{mode}, active: {}", names.join(" + "))
    }
}

fn waypoint(record: &Record, experiment: &Experiment) -> Option<String> {
    let waypoints = experiment.waypoints.as_ref()?;
    let mut kinematics = Kinematics::new(&experiment.robot);
    kinematics.update(&record.q);
    let (distance, angle) = waypoints.to_go(record.waypoint, &kinematics);
    let distance = distance.map(|distance| format!("{} to go", quantity(distance, "m")));
    let angle = angle.map(|angle| format!("{} to turn", quantity(angle, "rad")));
    let left: Vec<_> = [distance, angle].into_iter().flatten().collect();
    let (nth, all) = (record.waypoint + 1, waypoints.count());
    Some(format!("waypoint {nth} of {all}, {}", left.join(", ")))
}

/// The value of each set and its distance to its border; the error of each equality task.
fn tasks(record: &Record, experiment: &Experiment) -> String {
    let stack = experiment.controller.stack();
    let columns = Columns::new(stack);
    let mut rows = vec![["task", "value", "allowed", "distance to its border"].map(str::to_owned)];
    for (id, level) in stack.iter() {
        let unit = level.task().unit();
        let value = columns.value(record, id);
        let shown = value.map_or(String::new(), |value| {
            format!("{value:.6} {unit}")
                .trim_end_matches([' ', '-'])
                .to_owned()
        });
        let (allowed, distance) = if let (Some(set), Some(value)) = (level.interval(), value) {
            (allowed(set, unit), border(set, value, unit))
        } else {
            let error = columns.error(record, id).unwrap_or(f64::NAN);
            (String::new(), format!("error {}", quantity(error, unit)))
        };
        rows.push([level.name().to_owned(), shown, allowed, distance]);
    }
    table(&rows)
}

fn allowed(set: &Interval, unit: &str) -> String {
    match (set.min.is_finite(), set.max.is_finite()) {
        (true, true) => format!("{} … {}", limit(set.min, "-"), limit(set.max, unit)),
        (true, false) => format!("≥ {}", limit(set.min, unit)),
        (false, _) => format!("≤ {}", limit(set.max, unit)),
    }
}

fn border(set: &Interval, value: f64, unit: &str) -> String {
    let inside = (value - set.min).min(set.max - value);
    let side = if inside < 0.0 { "outside" } else { "inside" };
    format!("{} {side}", quantity(inside.abs(), unit))
}

/// How fast the arm moves, and that nothing limits it if nothing does.
fn speed(record: &Record, experiment: &Experiment) -> String {
    let limits = |reason: &Reason| {
        matches!(
            reason,
            Reason::SpeedLimit(_)
                | Reason::AccelerationLimit(_)
                | Reason::Halved(_)
                | Reason::Cautious(_)
                | Reason::StandsStill
                | Reason::NoMode
        )
    };
    let nothing = if record.reasons.iter().any(limits) {
        ""
    } else {
        "nothing limits the speed: "
    };
    let Some((index, speed)) = record.qd.largest().filter(|(_, speed)| *speed > 0.0) else {
        return format!("{nothing}the arm is at rest");
    };
    let joint = &experiment.robot.joints()[index];
    let unit = match joint.kind {
        JointKind::Revolute => "rad/s",
        JointKind::Prismatic => "m/s",
    };
    let most = joint.limits.speed.map_or(String::new(), |most| {
        format!(" of {} allowed", limit(most, unit))
    });
    format!(
        "{nothing}the fastest joint is {}, at {}{most}",
        joint.name,
        limit(speed, unit)
    )
}
