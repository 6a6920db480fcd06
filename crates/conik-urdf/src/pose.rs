//! Poses as URDF writes them, and how joints move.

use conik::{JointKind, Pose, Vec3};

use crate::element::Element;
use crate::error::UrdfError;
use crate::note::Notes;
use crate::unit;

/// A sine or a cosine of less than this is zero that was rounded.
const ROUNDED: f64 = 1e-15;

/// The pose of the `<origin>` of a joint of this name, which gives its orientation as `rpy` or, since
/// version 1.2 of URDF, as `quat_xyzw`; the identity without one.
pub(crate) fn origin(of: &Element, name: &str, notes: &mut Notes) -> Result<Pose, UrdfError> {
    let Some(origin) = of.child("origin")? else {
        return Ok(Pose::IDENTITY);
    };
    let position = origin.three_numbers("xyz")?.unwrap_or_default();
    let angles = origin.three_numbers("rpy")?;
    unit::note_origin(of, name, (position, angles.unwrap_or_default()), notes);
    let orientation = match origin.numbers("quat_xyzw", ("four", "0 0 0 1"))? {
        None => turned(angles.unwrap_or_default()),
        Some(_) if angles.is_some() => {
            return Err(origin.error_at(
                "quat_xyzw",
                "`rpy` gives the orientation already",
                "state it once: remove one of them",
            ));
        }
        Some([0.0, 0.0, 0.0, 0.0]) => {
            return Err(origin.error_at(
                "quat_xyzw",
                "a quaternion of zeros is no orientation",
                "write the identity as `quat_xyzw=\"0 0 0 1\"`",
            ));
        }
        Some([x, y, z, w]) => Pose::from_quaternion_wxyz([w, x, y, z]),
    };
    Ok(Pose {
        origin: position.into(),
        ..orientation
    })
}

/// A frame turned by roll, pitch and yaw [rad]: R = Rz(yaw) · Ry(pitch) · Rx(roll), about x first, all about
/// the axes that stand still (URDF specification, "origin").
pub fn turned([roll, pitch, yaw]: [f64; 3]) -> Pose {
    let ((sr, cr), (sp, cp), (sy, cy)) = (sin_cos(roll), sin_cos(pitch), sin_cos(yaw));
    Pose {
        x_axis: Vec3::new(cy * cp, sy * cp, -sp),
        y_axis: Vec3::new(cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr),
        z_axis: Vec3::new(cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr),
        origin: Vec3::ZERO,
    }
}

/// Sine and cosine, those of a multiple of π/2 without the rounding of π.
fn sin_cos(angle: f64) -> (f64, f64) {
    let (sin, cos) = angle.sin_cos();
    if cos.abs() < ROUNDED {
        (sin.signum(), 0.0)
    } else if sin.abs() < ROUNDED {
        (0.0, cos.signum())
    } else {
        (sin, cos)
    }
}

/// A frame whose z axis is this unit vector; of a coordinate axis, without rounding.
pub(crate) fn with_z_axis(axis: Vec3) -> Pose {
    let [x, y, z] = axis.to_array().map(f64::abs);
    // The coordinate axis that is furthest from it, made perpendicular.
    let other = if x <= y && x <= z {
        Pose::IDENTITY.x_axis
    } else if y <= z {
        Pose::IDENTITY.y_axis
    } else {
        Pose::IDENTITY.z_axis
    };
    let x_axis = (other - axis * axis.dot(other)).normalized();
    Pose {
        x_axis,
        y_axis: axis.cross(x_axis),
        z_axis: axis,
        origin: Vec3::ZERO,
    }
}

/// How far a joint at `position` [rad or m] has moved its child's frame.
pub(crate) fn moved(kind: JointKind, axis: Vec3, position: f64) -> Pose {
    match kind {
        JointKind::Prismatic => Pose::at(axis * position),
        JointKind::Revolute => {
            let aligned = with_z_axis(axis);
            aligned * turned([0.0, 0.0, position]) * aligned.inverse()
        }
    }
}
