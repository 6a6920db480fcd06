//! The times of a run at which its arm is drawn: so few that their pictures can be told apart, and those
//! that tell most.

use conik::{Kinematics, Robot, Vec3};

use super::run::Run;

/// More figures of the arm than this hide each other.
const MOST: usize = 5;

/// The arm must have moved by this part of its size to be drawn again.
const APART: f64 = 0.12;

/// A tool that turns about itself moves points so far from it, as part of the arm's size: by a third of a
/// turn, and the arm is drawn again.
const TOOL: f64 = 0.1;

/// What the arm looks like at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The time [s].
    pub t_s: f64,
    /// Joint positions [rad or m].
    pub q: Vec<f64>,
}

/// The moments at the times `at_s`, in order of time; without any, the telling ones.
pub fn chosen(run: &Run, robot: &Robot, at_s: &[f64], size: f64) -> Vec<Moment> {
    if at_s.is_empty() {
        return of(run, robot, size);
    }
    let Some(columns) = columns(run, robot) else {
        return Vec::new();
    };
    let mut moments: Vec<Moment> = at_s
        .iter()
        .filter_map(|&t_s| moment(run, &columns, t_s))
        .collect();
    moments.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
    moments.dedup();
    moments
}

/// The columns of the joints of this robot; `None` if the log does not have them.
fn columns<'a>(run: &'a Run, robot: &Robot) -> Option<Vec<&'a [f64]>> {
    (1..=robot.dof())
        .map(|joint| run.log().column(&format!("q{joint}_rad")))
        .collect()
}

/// The row next to a time, if the joints were somewhere then.
fn moment(run: &Run, columns: &[&[f64]], t_s: f64) -> Option<Moment> {
    let times = run.log().time_s();
    let after = times.partition_point(|&time| time < t_s);
    let rows = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let rows = rows.filter(|&row| row < times.len());
    let row = rows.min_by(|&a, &b| (times[a] - t_s).abs().total_cmp(&(times[b] - t_s).abs()))?;
    let q: Option<Vec<f64>> = columns
        .iter()
        .map(|column| column.get(row).copied())
        .collect();
    let q = q.filter(|q| q.iter().all(|position| position.is_finite()))?;
    Some(Moment { t_s: times[row], q })
}

/// The telling moments of a run in order of time, the start and the end among them; none if the log does
/// not tell where the joints of this robot were.
pub fn of(run: &Run, robot: &Robot, size: f64) -> Vec<Moment> {
    let Some(columns) = columns(run, robot) else {
        return Vec::new();
    };
    let at = |t_s: f64| moment(run, &columns, t_s);
    let (begin, end) = run.period_s();
    let places = |moment: &Moment| places(robot, &moment.q, TOOL * size);
    let mut chosen: Vec<Moment> = [begin, end].into_iter().filter_map(at).collect();
    let mut drawn: Vec<Vec<Vec3>> = chosen.iter().map(places).collect();
    if let [start, end] = &drawn[..]
        && distance(start, end) < 1e-3 * size
    {
        chosen.pop();
        drawn.pop();
    }
    // Where a waypoint was reached tells more than where the mode changed.
    let waypoints = run.summary().waypoints_reached_s.iter().flatten();
    let changes = run
        .drawable_spans()
        .into_iter()
        .map(|span| (span.from_s, 1.0));
    let times = waypoints.map(|&t_s| (t_s, 1.6)).chain(changes);
    let mut left: Vec<(Moment, f64, Vec<Vec3>)> = times
        .filter_map(|(t_s, weight)| at(t_s).map(|moment| (places(&moment), weight, moment)))
        .map(|(places, weight, moment)| (moment, weight, places))
        .collect();
    while chosen.len() < MOST {
        let away = |places: &Vec<Vec3>| {
            let away = drawn.iter().map(|other| distance(places, other));
            away.fold(f64::INFINITY, f64::min)
        };
        let told = left
            .iter()
            .map(|(_, weight, places)| (weight * away(places), away(places)))
            .enumerate()
            .filter(|(_, (_, away))| *away > APART * size);
        let Some((best, _)) = told.max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0)) else {
            break;
        };
        let (moment, _, places) = left.swap_remove(best);
        chosen.push(moment);
        drawn.push(places);
    }
    chosen.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
    chosen
}

/// Where joints and tool are, and points along the tool's axes, so far from it.
fn places(robot: &Robot, q: &[f64], along_axes: f64) -> Vec<Vec3> {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let joints = robot.placed_joints(q);
    let mut places: Vec<Vec3> = joints.iter().map(|joint| joint.moved.origin).collect();
    let tool = kinematics.world_from(conik::Frame::Tool);
    places.push(tool.origin);
    let axes = [tool.x_axis, tool.y_axis, tool.z_axis];
    places.extend(axes.map(|axis| tool.origin + axis * along_axes));
    places
}

/// The most that a point of the arm is away from where it is in another figure [m].
fn distance(one: &[Vec3], other: &[Vec3]) -> f64 {
    let away = one.iter().zip(other).map(|(a, b)| (*a - *b).norm());
    away.fold(0.0, f64::max)
}
