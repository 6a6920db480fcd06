//! Numbers that are likely in another unit than URDF's: degrees, millimetres.

use conik::{JointKind, JointLimits};

use crate::element::Element;
use crate::note::Notes;

/// Few joints turn further from their zero, either way [rad]: four turns.
const FAR: f64 = 8.0 * std::f64::consts::PI;
/// Few joints turn faster [rad/s].
const FAST: f64 = 60.0;
/// Few parts of robots are longer, or slide further [m].
const LONG: f64 = 100.0;
/// An orientation needs no greater angle [rad]: a turn, as it may have been rounded.
const TURN: f64 = 6.3;

/// Notes what of a joint's limits is likely in degrees or millimetres.
pub(crate) fn note_limits(
    joint: &Element,
    name: &str,
    (kind, limits): (JointKind, &JointLimits),
    notes: &mut Notes,
) {
    let far = limits.position.map_or(0.0, |(min, max)| {
        let finite = |bound: f64| if bound.is_finite() { bound.abs() } else { 0.0 };
        finite(min).max(finite(max))
    });
    let fast = limits.speed.unwrap_or(0.0);
    match kind {
        JointKind::Revolute if far > FAR => notes.add(
            joint,
            name,
            "its position limits are taken as radians, as URDF says: are they degrees?",
        ),
        JointKind::Prismatic if far > LONG => notes.add(
            joint,
            name,
            "its position limits are taken as metres, as URDF says: are they millimetres?",
        ),
        _ => {}
    }
    match kind {
        JointKind::Revolute if fast > FAST => notes.add(
            joint,
            name,
            "its velocity limit is taken as radians per second, as URDF says: are they degrees?",
        ),
        JointKind::Prismatic if fast > LONG => notes.add(
            joint,
            name,
            "its velocity limit is taken as metres per second, as URDF says: are they millimetres?",
        ),
        _ => {}
    }
}

/// Notes what of the `<origin>` of a joint is likely in degrees or millimetres.
pub(crate) fn note_origin(
    joint: &Element,
    name: &str,
    (position, angles): ([f64; 3], [f64; 3]),
    notes: &mut Notes,
) {
    if position.iter().any(|length| length.abs() > LONG) {
        notes.add(
            joint,
            name,
            "the `xyz` of its origin is taken as metres, as URDF says: are they millimetres?",
        );
    }
    if angles.iter().any(|angle| angle.abs() > TURN) {
        notes.add(
            joint,
            name,
            "the `rpy` of its origin is taken as radians, as URDF says: are they degrees?",
        );
    }
}
