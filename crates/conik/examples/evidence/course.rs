//! One of the paper's examples under one combination, and what became of it.

use crate::chain::{Chain, Measure, norm};
use crate::paper::Example;

/// A start with the view cone near its border, which speed comparisons use.
pub fn bench() -> [f64; 6] {
    [
        -0.913_794, -2.850_336, -1.496_087, -1.936_762, -2.484_59, 1.611_513,
    ]
}

/// From here the paper's rule freezes an obstacle that is far away, and waits for ever.
pub fn deadlock() -> [f64; 6] {
    [1.7809, 0.4115, 0.4475, 0.2984, -0.2144, 0.0]
}

/// What became of a run.
#[derive(Debug, Default)]
pub struct Course {
    pub mode_changes: usize,
    /// Furthest outside a high-priority set that had been inside, distances [m] and view [-].
    pub outside: f64,
    pub outside_view: f64,
    pub waypoints_s: [Option<f64>; 2],
    /// Mode changes while no joint moved faster than 1e-5 rad/s.
    pub changes_at_rest: usize,
    pub peak_speed: f64,
    pub peak_acceleration: f64,
    pub last_error: f64,
}

/// The sets of high priority in an example, as (measure, least, most).
fn high_priority(number: u8) -> Vec<(Measure, f64, f64)> {
    let mut sets = vec![
        (Measure::Distance([0.40, -0.25, -0.33]), 0.18, f64::INFINITY),
        (Measure::Distance([0.40, 0.15, -0.33]), 0.15, f64::INFINITY),
    ];
    if number == 2 {
        sets.push((Measure::View([1.0, 0.0, 0.0]), f64::NEG_INFINITY, 0.2622));
    }
    sets
}

/// Runs an example and judges it by the second kinematics.
pub fn course(number: u8, q0: [f64; 6], settings: conik::Settings, duration_s: f64) -> Course {
    let mut example = Example::new(number, q0, settings);
    let sets = high_priority(number);
    let mut entered = vec![false; sets.len()];
    let mut course = Course {
        outside: f64::NEG_INFINITY,
        outside_view: f64::NEG_INFINITY,
        ..Course::default()
    };
    let mut before = None;
    let mut tick = 0_u32;
    while f64::from(tick) <= duration_s * settings.rate_hz {
        let t_s = f64::from(tick) / settings.rate_hz;
        let chain = Chain::at(&example.q);
        for (&(measure, min, max), entered) in sets.iter().zip(&mut entered) {
            let sigma = chain.value(measure);
            let outside = (min - sigma).max(sigma - max);
            *entered |= outside <= 0.0;
            let worst = match measure {
                Measure::View(_) => &mut course.outside_view,
                _ => &mut course.outside,
            };
            if *entered {
                *worst = worst.max(outside);
            }
        }
        let (waypoint, was_done) = (example.waypoints.index(), example.waypoints.is_done());
        let step = example.tick().clone();
        if example.waypoints.index() != waypoint || example.waypoints.is_done() != was_done {
            course.waypoints_s[waypoint] = Some(t_s);
        }
        let still = step.qd.iter().all(|speed| speed.abs() < 1e-5);
        if let Some((active, was_still)) = before.replace((step.active, still)) {
            let changed = active != step.active;
            course.mode_changes += usize::from(changed);
            course.changes_at_rest += usize::from(changed && still && was_still);
            let acceleration = step.qdd.largest().map_or(0.0, |(_, largest)| largest);
            course.peak_acceleration = course.peak_acceleration.max(acceleration);
        }
        let speed = step.qd.largest().map_or(0.0, |(_, largest)| largest);
        course.peak_speed = course.peak_speed.max(speed);
        course.last_error = norm(step.error(example.position).try_into().expect("a point"));
        tick += 1;
    }
    course
}
