//! Points or poses to visit one after the other, with the circle of acceptance of Section IV.A of the paper.

use crate::geometry::{Pose, Vec3};
use alloc::vec::Vec;

/// Points that a position task visits in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoints {
    points: Vec<Vec3>,
    acceptance: f64,
    progress: Progress,
}

/// Poses that a task visits in order.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseWaypoints {
    poses: Vec<Pose>,
    acceptance: f64,
    acceptance_angle: f64,
    progress: Progress,
}

/// How far along a list of waypoints something is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Progress {
    index: usize,
    last_reached: bool,
}

impl Progress {
    const START: Self = Self {
        index: 0,
        last_reached: false,
    };

    /// The waypoint in use, of `count`, is reached: the next one is in use from now on, if there is one.
    fn reach(&mut self, count: usize) -> usize {
        let reached = self.index;
        if self.index + 1 < count {
            self.index += 1;
        } else {
            self.last_reached = true;
        }
        reached
    }
}

impl Waypoints {
    /// Visits `points` [m] in order; one is reached when it is closer than `acceptance` [m]. `None`
    /// if there are no points.
    pub fn new(points: Vec<Vec3>, acceptance: f64) -> Option<Self> {
        (!points.is_empty()).then_some(Self {
            points,
            acceptance,
            progress: Progress::START,
        })
    }

    /// Called once at the start of each tick with the present position [m]. If the waypoint in use
    /// is reached and there is a next one, that one is in use from now on. Returns the index of a
    /// waypoint that this tick is the first to reach.
    pub fn advance(&mut self, position: Vec3) -> Option<usize> {
        if self.is_done() || !((self.target() - position).norm() < self.acceptance) {
            return None;
        }
        Some(self.progress.reach(self.points.len()))
    }

    /// The waypoint in use [m].
    pub fn target(&self) -> Vec3 {
        self.points[self.index()]
    }

    /// Index of the waypoint in use, from 0.
    pub fn index(&self) -> usize {
        self.progress.index
    }

    /// All points [m].
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Whether the last waypoint has been reached.
    pub fn is_done(&self) -> bool {
        self.progress.last_reached
    }
}

impl PoseWaypoints {
    /// Visits `poses` in order; one is reached when its origin is closer than `acceptance` [m] and its
    /// orientation is less than `acceptance_angle` [rad] away. Infinity for one of them: it does not
    /// matter. `None` if there are no poses.
    pub fn new(poses: Vec<Pose>, acceptance: f64, acceptance_angle: f64) -> Option<Self> {
        (!poses.is_empty()).then_some(Self {
            poses,
            acceptance,
            acceptance_angle,
            progress: Progress::START,
        })
    }

    /// Called once at the start of each tick with the present pose, as [`Waypoints::advance`] is.
    pub fn advance(&mut self, pose: &Pose) -> Option<usize> {
        if self.is_done() {
            return None;
        }
        let (distance, angle) = Self::to_go(&self.target(), pose);
        let is_reached = distance < self.acceptance && angle < self.acceptance_angle;
        is_reached.then(|| self.progress.reach(self.poses.len()))
    }

    /// Goes on where another list is: at the waypoint of the same number, or the last one if there are fewer.
    pub fn take_over(&mut self, other: &Self) {
        let last = self.poses.len() - 1;
        self.progress = Progress {
            index: other.index().min(last),
            last_reached: other.is_done() && other.index() >= last,
        };
    }

    /// How far [m] and how much to turn [rad] it is from `pose` to `target`.
    pub fn to_go(target: &Pose, pose: &Pose) -> (f64, f64) {
        let turn = *pose * target.inverse();
        (
            (target.origin - pose.origin).norm(),
            turn.rotation_vector().norm(),
        )
    }

    /// The waypoint in use.
    pub fn target(&self) -> Pose {
        self.poses[self.index()]
    }

    /// Index of the waypoint in use, from 0.
    pub fn index(&self) -> usize {
        self.progress.index
    }

    /// All poses.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Whether the last waypoint has been reached.
    pub fn is_done(&self) -> bool {
        self.progress.last_reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> Waypoints {
        let points = alloc::vec![Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0)];
        Waypoints::new(points, 0.125).expect("there are points")
    }

    #[test]
    fn the_next_waypoint_is_used_from_the_tick_that_is_inside_the_circle() {
        let mut waypoints = two();
        assert_eq!(
            waypoints.advance(Vec3::new(0.875, 0.0, 0.0)),
            None,
            "on the circle is not inside"
        );
        assert_eq!(waypoints.advance(Vec3::new(0.95, 0.0, 0.0)), Some(0));
        assert_eq!((waypoints.index(), waypoints.target().x), (1, 2.0));
    }

    #[test]
    fn the_last_waypoint_is_reached_once_and_stays_in_use() {
        let mut waypoints = two();
        waypoints.advance(Vec3::new(1.0, 0.0, 0.0));
        assert_eq!(waypoints.advance(Vec3::new(2.0, 0.0, 0.0)), Some(1));
        assert_eq!(waypoints.advance(Vec3::new(2.0, 0.0, 0.0)), None);
        assert!(waypoints.is_done());
        assert_eq!(waypoints.target().x, 2.0);
    }

    #[test]
    fn a_pose_is_reached_when_it_is_both_near_and_turned() {
        let pose = |x: f64, yaw: f64| Pose {
            origin: Vec3::new(x, 0.0, 0.0),
            ..Pose::turned(Vec3::new(0.0, 0.0, yaw))
        };
        let poses = alloc::vec![pose(1.0, 0.5), pose(1.0, 3.0)];
        let mut waypoints =
            PoseWaypoints::new(poses.clone(), 0.125, 0.25).expect("there are poses");
        assert_eq!(waypoints.advance(&pose(1.0, 0.8)), None, "not turned");
        assert_eq!(waypoints.advance(&pose(1.2, 0.5)), None, "not near");
        assert_eq!(waypoints.advance(&pose(0.9, 0.3)), Some(0));
        // The short way round from -3.1 to 3 is 0.18 rad.
        assert_eq!(waypoints.advance(&pose(1.0, -3.1)), Some(1));
        assert_eq!(waypoints.advance(&pose(1.0, 3.0)), None);
        assert!(waypoints.is_done() && waypoints.index() == 1);
        let mut points = PoseWaypoints::new(poses, 0.125, f64::INFINITY).expect("there are poses");
        assert_eq!(
            points.advance(&pose(1.0, -2.0)),
            Some(0),
            "turns do not matter"
        );
        assert!(PoseWaypoints::new(Vec::new(), 1.0, 1.0).is_none());
    }
}
