//! Swivel angle of an elbow: σ = atan2(n · (d × e), (d · e) − (n · d)(n · e)), the angle about the line n from
//! shoulder to wrist, from a reference direction d to the elbow e.

use super::{JacobianMut, NEARLY_ZERO, Task};
use crate::geometry::Vec3;
use crate::joints::JointVec;
use crate::kinematics::{Frame, Kinematics, Motion};
use crate::linalg::add_scaled;
use crate::real::{atan2, sin_cos};
use crate::robot::Robot;

/// Angle [rad], in (−π, π], of the plane through shoulder, elbow and wrist about the line from shoulder to
/// wrist, against the plane through that line and a reference direction: with the reference upward, 0 is
/// the elbow at its highest.
///
/// Errors go the shorter way round. A set must keep away from ±π, where the value jumps: turn the reference
/// round if it does not. Where the elbow is on the line, or the line along the reference, the angle is
/// undefined, and the Jacobian zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elbow {
    /// Shoulder, elbow and wrist.
    joints: [Frame; 3],
    from: Frame,
    reference: Vec3,
}

/// The angle and how it changes with the elbow and the wrist, seen from the shoulder.
struct Swivel {
    angle: f64,
    along_elbow: Vec3,
    along_wrist: Vec3,
}

impl Elbow {
    /// Of the arm whose shoulder, elbow and wrist have their origins there, against `reference`, any non-zero
    /// vector of the world.
    pub fn of(shoulder_elbow_wrist: [Frame; 3], reference: impl Into<Vec3>) -> Self {
        Self {
            joints: shoulder_elbow_wrist,
            from: Frame::World,
            reference: reference.into().normalized(),
        }
    }

    /// The same with a reference that is fixed to another frame of the robot, and given in it.
    #[must_use]
    pub const fn relative_to(self, frame: Frame) -> Self {
        Self {
            from: frame,
            ..self
        }
    }

    /// Takes another reference.
    pub fn set_reference(&mut self, reference: impl Into<Vec3>) {
        self.reference = reference.into().normalized();
    }

    fn swivel(&self, kinematics: &Kinematics) -> Swivel {
        let [shoulder, elbow, wrist] = self.joints.map(|frame| kinematics.world_from(frame).origin);
        let (e, line) = (elbow - shoulder, wrist - shoulder);
        let d = kinematics.world_from(self.from).rotate(self.reference);
        let undefined = Swivel {
            angle: 0.0,
            along_elbow: Vec3::ZERO,
            along_wrist: Vec3::ZERO,
        };
        let length = line.norm();
        if length < NEARLY_ZERO {
            return undefined;
        }
        let n = line * (1.0 / length);
        let sine = n.dot(d.cross(e));
        let cosine = d.dot(e) - n.dot(d) * n.dot(e);
        let squared = sine * sine + cosine * cosine;
        if squared < NEARLY_ZERO * NEARLY_ZERO {
            return undefined;
        }
        let along_elbow = n.cross(d) * cosine - (d - n * n.dot(d)) * sine;
        let along_n = d.cross(e) * cosine + (d * n.dot(e) + e * n.dot(d)) * sine;
        let along_line = (along_n - n * n.dot(along_n)) * (1.0 / length);
        Swivel {
            angle: atan2(sine, cosine),
            along_elbow: along_elbow * (1.0 / squared),
            along_wrist: along_line * (1.0 / squared),
        }
    }

    fn motion(&self, kinematics: &Kinematics, frame: Frame) -> Motion {
        kinematics.motion_between(self.from, frame)
    }
}

impl Task for Elbow {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.swivel(kinematics).angle;
    }

    fn jacobian(&self, kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let swivel = self.swivel(kinematics);
        let row = jacobian.row(0);
        row.fill(0.0);
        let along_shoulder = -(swivel.along_elbow + swivel.along_wrist);
        let along = [along_shoulder, swivel.along_elbow, swivel.along_wrist];
        for (frame, along) in self.joints.into_iter().zip(along) {
            let mut part = JointVec::zeros(kinematics.dof());
            let point = kinematics.world_from(frame).origin;
            kinematics.point_row(self.motion(kinematics, frame), point, along, &mut part);
            add_scaled(row, 1.0, &part);
        }
    }

    /// The shorter way round.
    fn error(&self, desired: &[f64], value: &[f64], error: &mut [f64]) {
        let (sin, cos) = sin_cos(desired[0] - value[0]);
        error[0] = atan2(sin, cos);
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        let [shoulder, elbow, wrist] = self.joints;
        let mut frames = self.joints.iter().chain([&self.from]);
        if !frames.all(|frame| robot.has(*frame)) {
            Err("the robot has no such link")
        } else if elbow == shoulder || elbow == wrist || shoulder == wrist {
            Err("shoulder, elbow and wrist must be three frames")
        } else if !self.reference.is_unit() {
            Err("the reference direction must be finite and not zero")
        } else {
            Ok(())
        }
    }
}
