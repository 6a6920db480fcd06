//! Where a frame is to be: one place or waypoints; of a place its point, its orientation, or both.

use super::config::GoalConfig;
use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::orientation::{self, Quaternion};
use super::robot::in_one_unit;
use super::table::Table;

/// What of a place counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) point: bool,
    pub(super) orientation: bool,
}

/// The places, one or, if they are waypoints, one or more.
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// The points; none where those do not count.
    points_m: Vec<[f64; 3]>,
    /// The orientations; none where those do not count.
    orientations: Vec<Quaternion>,
    /// When the next waypoint is taken, where these are such.
    acceptance: Option<Acceptance>,
}

#[derive(Clone, Copy, Debug)]
struct Acceptance {
    distance_m: Option<f64>,
    angle_rad: Option<f64>,
}

/// The keys that say that there are waypoints, and which.
pub(super) const WAYPOINTS: &[&Key] = &[
    &keys::WAYPOINTS_M,
    &keys::WAYPOINTS_RPY_DEG,
    &keys::WAYPOINTS_QUATERNION_WXYZ,
];
/// The keys that say where one place is.
pub(super) const ONE_PLACE: &[&Key] = &[
    &keys::TARGET_M,
    &keys::DESIRED_RPY_DEG,
    &keys::DESIRED_QUATERNION_WXYZ,
];
/// The keys that say when the next waypoint is taken.
pub(super) const ACCEPTANCE: &[&Key] = &[
    &keys::ACCEPTANCE_M,
    &keys::ACCEPTANCE_DEG,
    &keys::ACCEPTANCE_RAD,
];

/// The first of the keys that the table has.
pub(super) fn first_of(table: &Table, keys: &[&'static Key]) -> Option<&'static Key> {
    keys.iter().copied().find(|key| table.has(key))
}

impl Places {
    /// Reads them; `None` if anything of them is wrong.
    pub(super) fn read(table: &Table, counts: Counts, found: &mut Mistakes) -> Option<Self> {
        let (waypoint, place) = (first_of(table, WAYPOINTS), first_of(table, ONE_PLACE));
        match (waypoint, place) {
            (Some(waypoint), Some(place)) => {
                found.add(
                    table.span_of(place),
                    table.path_of(place),
                    format!("both `{}` and `{}` are given", waypoint.name, place.name),
                    "remove one of them",
                );
                None
            }
            (Some(_), None) => Self::read_waypoints(table, counts, found),
            (None, _) => Self::read_one(table, counts, found),
        }
    }

    /// The same where what is wrong is noted elsewhere.
    pub(super) fn known(table: &Table, counts: Counts) -> Option<Self> {
        Self::read(table, counts, &mut Mistakes::new(""))
    }

    fn read_one(table: &Table, counts: Counts, found: &mut Mistakes) -> Option<Self> {
        let points_m = if counts.point {
            let target = table.vector(&keys::TARGET_M, found);
            target.required(table, found).map(|point| vec![point])
        } else {
            Some(Vec::new())
        };
        let orientations = if counts.orientation {
            orientation::read(table, found).map(|turn| vec![turn])
        } else {
            Some(Vec::new())
        };
        if let Some(key) = first_of(table, ACCEPTANCE) {
            found.add(
                table.span_of(key),
                table.path_of(key),
                format!(
                    "`{}` says when the next waypoint is taken, and there are none",
                    key.name
                ),
                "remove it, or give waypoints in place of one place",
            );
        }
        Some(Self {
            points_m: points_m?,
            orientations: orientations?,
            acceptance: None,
        })
    }

    fn read_waypoints(table: &Table, counts: Counts, found: &mut Mistakes) -> Option<Self> {
        let (mut points_m, mut distance_m) = (Some(Vec::new()), Some(None));
        if counts.point {
            let points = table.points(&keys::WAYPOINTS_M, found);
            points_m = points.required(table, found);
            let distance = table.number(&keys::ACCEPTANCE_M, found);
            distance_m = distance.required(table, found).map(Some);
        }
        let (mut orientations, mut angle_rad) = (Some(Vec::new()), Some(None));
        if counts.orientation {
            orientations = orientation::read_waypoints(table, found);
            angle_rad = read_angle(table, found).map(Some);
        }
        let (points_m, orientations) = (points_m?, orientations?);
        let (points, turns) = (points_m.len(), orientations.len());
        if counts.point && counts.orientation && points != turns {
            let key = first_of(table, &WAYPOINTS[1..]).unwrap_or(WAYPOINTS[1]);
            found.add(
                table.span_of(key),
                table.path_of(key),
                format!("{turns} orientations for {points} points"),
                "give each waypoint a point and an orientation",
            );
            return None;
        }
        Some(Self {
            points_m,
            orientations,
            acceptance: Some(Acceptance {
                distance_m: distance_m?,
                angle_rad: angle_rad?,
            }),
        })
    }

    /// The place to begin with: its point [m] and its orientation.
    pub(super) fn first(&self) -> ([f64; 3], Quaternion) {
        let point = self.points_m.first().copied();
        let orientation = self.orientations.first().copied();
        (
            point.unwrap_or_default(),
            orientation.unwrap_or([1.0, 0.0, 0.0, 0.0]),
        )
    }

    /// What that asks of a task.
    pub(super) fn goal(self, counts: Counts, gain_per_s: f64) -> GoalConfig {
        let (point, _) = self.first();
        match (self.acceptance, counts.orientation) {
            (Some(acceptance), _) => GoalConfig::Waypoints {
                waypoints_m: self.points_m,
                waypoints_quaternion_wxyz: self.orientations,
                acceptance_m: acceptance.distance_m,
                acceptance_rad: acceptance.angle_rad,
                gain_per_s,
            },
            (None, false) => GoalConfig::Desired {
                desired: point.to_vec(),
                gain_per_s,
            },
            // What is measured is the way there: none is desired.
            (None, true) => GoalConfig::Desired {
                desired: vec![0.0; if counts.point { 6 } else { 3 }],
                gain_per_s,
            },
        }
    }
}

/// The angle at which the next waypoint is taken [rad].
fn read_angle(table: &Table, found: &mut Mistakes) -> Option<f64> {
    let (deg, rad) = (&keys::ACCEPTANCE_DEG, &keys::ACCEPTANCE_RAD);
    let (in_deg, in_rad) = (table.number(deg, found), table.number(rad, found));
    let angle = in_one_unit(table, deg, in_deg, rad, in_rad, found);
    let (angle, to_rad) = angle.required(table, found)?;
    Some(to_rad(angle))
}
