//! Points to visit one after the other, with the circle of acceptance of Section IV.A of the paper.

use crate::geometry::Vec3;
use alloc::vec::Vec;

/// Points that a position task visits in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoints {
    points: Vec<Vec3>,
    acceptance: f64,
    index: usize,
    last_reached: bool,
}

impl Waypoints {
    /// Visits `points` [m] in order; one is reached when it is closer than `acceptance` [m]. `None`
    /// if there are no points.
    pub fn new(points: Vec<Vec3>, acceptance: f64) -> Option<Self> {
        (!points.is_empty()).then_some(Self {
            points,
            acceptance,
            index: 0,
            last_reached: false,
        })
    }

    /// Called once at the start of each tick with the present position [m]. If the waypoint in use
    /// is reached and there is a next one, that one is in use from now on. Returns the index of a
    /// waypoint that this tick is the first to reach.
    pub fn advance(&mut self, position: Vec3) -> Option<usize> {
        if self.last_reached || !((self.target() - position).norm() < self.acceptance) {
            return None;
        }
        let reached = self.index;
        if self.index + 1 < self.points.len() {
            self.index += 1;
        } else {
            self.last_reached = true;
        }
        Some(reached)
    }

    /// The waypoint in use [m].
    pub fn target(&self) -> Vec3 {
        self.points[self.index]
    }

    /// Index of the waypoint in use, from 0.
    pub fn index(&self) -> usize {
        self.index
    }

    /// All points [m].
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Whether the last waypoint has been reached.
    pub fn is_done(&self) -> bool {
        self.last_reached
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
}
