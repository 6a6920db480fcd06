//! How a body follows from the one that carries it, made ready for forward kinematics.

use crate::geometry::{Pose, Vec3};
use crate::real::{atan2, sin_cos};

/// A sine or a cosine of less than this is zero that was rounded.
const ROUNDED: f64 = 1e-15;

/// From the body that carries a joint to the one that it moves.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Placement {
    /// A row of a Denavit-Hartenberg table, standard convention: the joint acts about or along the z axis
    /// of the body that carries it. Most arms are tables, and rows cost a third of what poses do.
    Row(Row),
    /// Anything else.
    Poses {
        /// The joint's frame in that of the body that carries it.
        before: Pose,
        /// The frame of what the joint moves in the joint's, unless they coincide.
        after: Option<Pose>,
    },
}

/// Turn by θ about z, move by d along it, move by a along the new x, turn by α about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) theta: f64,
    d: f64,
    a: f64,
    twist: Twist,
}

/// The turn by α about the new x. Most arms have none but those of a quarter, which cost little.
#[derive(Clone, Copy, Debug)]
enum Twist {
    /// By ±π/2; the sign is sin α.
    Quarter {
        sign: f64,
    },
    /// By nothing.
    None,
    Any {
        cos: f64,
        sin: f64,
    },
}

impl Twist {
    fn new(sin: f64, cos: f64) -> Self {
        if cos == 0.0 {
            Self::Quarter { sign: sin }
        } else if sin == 0.0 && cos > 0.0 {
            Self::None
        } else {
            Self::Any { cos, sin }
        }
    }

    /// The y and the z axis after the turn.
    #[inline]
    fn turn(self, y_axis: Vec3, z_axis: Vec3) -> (Vec3, Vec3) {
        if let Self::Quarter { sign } = self {
            return (z_axis * sign, y_axis * -sign);
        }
        if let Self::Any { cos, sin } = self {
            return (y_axis * cos + z_axis * sin, z_axis * cos - y_axis * sin);
        }
        (y_axis, z_axis)
    }
}

impl Placement {
    /// From the joint's frame in that of its carrier, and the frame of what it moves in its own.
    pub(crate) fn new(before: &Pose, after: &Pose) -> Self {
        let (z_axis, x_axis) = (Pose::IDENTITY.z_axis, Pose::IDENTITY.x_axis);
        let along = |pose: &Pose, axis: Vec3| {
            let across = pose.origin - axis * axis.dot(pose.origin);
            across == Vec3::ZERO
        };
        let is_row = before.z_axis == z_axis
            && along(before, z_axis)
            && after.x_axis == x_axis
            && along(after, x_axis);
        if is_row {
            return Self::Row(Row {
                theta: atan2(before.x_axis.y, before.x_axis.x),
                d: before.origin.z,
                a: after.origin.x,
                twist: Twist::new(after.y_axis.z, after.y_axis.y),
            });
        }
        Self::Poses {
            before: *before,
            after: (*after != Pose::IDENTITY).then_some(*after),
        }
    }

    /// What is added to the angle of the joint [rad].
    #[inline]
    pub(crate) fn theta(&self) -> f64 {
        match self {
            Self::Row(row) => row.theta,
            Self::Poses { .. } => 0.0,
        }
    }
}

impl Row {
    /// What the joint moves, given what carries it, how far it slid, and sine and cosine of θ.
    #[inline]
    pub(crate) fn advance(&self, carrier: &Pose, slid: f64, (sin, cos): (f64, f64)) -> Pose {
        let (x_axis, across) = turn_about_z(carrier, (sin, cos));
        let (y_axis, z_axis) = self.twist.turn(across, carrier.z_axis);
        Pose {
            x_axis,
            y_axis,
            z_axis,
            origin: carrier.origin + carrier.z_axis * (self.d + slid) + x_axis * self.a,
        }
    }
}

/// The x and the y axis after a turn about z, given its sine and cosine.
#[inline]
pub(crate) fn turn_about_z(pose: &Pose, (sin, cos): (f64, f64)) -> (Vec3, Vec3) {
    (
        pose.x_axis * cos + pose.y_axis * sin,
        pose.y_axis * cos - pose.x_axis * sin,
    )
}

/// Sine and cosine, those of a multiple of π/2 without the rounding of π.
pub(crate) fn exact_sin_cos(angle: f64) -> (f64, f64) {
    let (sin, cos) = sin_cos(angle);
    if cos.abs() < ROUNDED {
        (sin.signum(), 0.0)
    } else if sin.abs() < ROUNDED {
        (0.0, cos.signum())
    } else {
        (sin, cos)
    }
}
