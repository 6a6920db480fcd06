//! How far a robot reaches, whatever its configuration.

use alloc::vec::Vec;

use crate::robot::{Mimic, Robot};

/// The most that a link can be away from the joints that move it [m], or from the world's origin if
/// the first joints' own places count.
pub(super) fn reach(robot: &Robot, from_world: bool) -> f64 {
    let mut lengths: Vec<f64> = alloc::vec![0.0];
    for body in robot.bodies() {
        let own = if from_world || body.parent != 0 {
            body.length()
        } else {
            body.length_from_joint()
        };
        lengths.push(lengths[body.parent] + own);
    }
    let links = robot
        .links()
        .iter()
        .filter(|link| from_world || link.body.index() != 0);
    links
        .map(|link| lengths[link.body.index()] + link.placement.origin.norm())
        .fold(0.0, f64::max)
}

/// The most that one joint can turn, itself and what follows it [rad/rad].
pub(super) fn turning(drives: &[Mimic]) -> f64 {
    let of = |joint: usize| -> f64 {
        let driven = drives.iter().filter(|drive| drive.joint == joint);
        driven.map(|drive| drive.multiplier.abs()).sum()
    };
    (0..drives.len()).map(of).fold(0.0, f64::max)
}
