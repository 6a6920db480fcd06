//! Writing what a task measures, as it stands in the file.

use super::choice::Choice;
use super::config::TaskKind;
use super::keys;
use super::write::{number, text, vector};

/// A key and its value.
type Line = (&'static str, String);

/// The name of the type, then its own keys and values.
pub(super) fn written(kind: &TaskKind) -> (&'static str, Vec<Line>) {
    match kind {
        TaskKind::Position => ("position", vec![]),
        TaskKind::Coordinate { axis } => ("coordinate", vec![(keys::AXIS.name, text(axis.name()))]),
        TaskKind::Distance { point_m } => ("distance", vec![point(point_m)]),
        TaskKind::ShapeDistance { shapes } => {
            let [first, second] = shapes.each_ref().map(|name| text(name));
            let list = format!("[{first}, {second}]");
            ("shape_distance", vec![(keys::SHAPES.name, list)])
        }
        // No task of a file: shapes and obstacles stand for it.
        TaskKind::Shapes(_) => ("shapes", vec![]),
        TaskKind::FieldOfView { direction } => (
            "field_of_view",
            vec![(keys::DIRECTION.name, vector(direction))],
        ),
        TaskKind::Orientation {
            desired_quaternion_wxyz,
        } => ("orientation", vec![quaternion(desired_quaternion_wxyz)]),
        TaskKind::OrientationAngle {
            desired_quaternion_wxyz,
        } => (
            "orientation_angle",
            vec![quaternion(desired_quaternion_wxyz)],
        ),
        TaskKind::Pose {
            target_m,
            desired_quaternion_wxyz,
        } => (
            "pose",
            vec![
                (keys::TARGET_M.name, vector(target_m)),
                quaternion(desired_quaternion_wxyz),
            ],
        ),
        TaskKind::PointingAngle { axis, direction } => (
            "pointing_angle",
            vec![
                (keys::AXIS_IN_FRAME.name, vector(axis)),
                (keys::DIRECTION.name, vector(direction)),
            ],
        ),
        TaskKind::LookAt { point_m } => ("look_at", vec![point(point_m)]),
        TaskKind::Plane { normal, offset_m } => (
            "plane",
            vec![
                (keys::NORMAL.name, vector(normal)),
                (keys::OFFSET_M.name, number(*offset_m)),
            ],
        ),
        TaskKind::Height => ("height", vec![]),
        TaskKind::Joint { joint } => ("joint", vec![(keys::JOINT.name, joint.to_string())]),
        TaskKind::Posture { joints } => {
            let numbers: Vec<_> = joints.iter().map(usize::to_string).collect();
            let list = format!("[{}]", numbers.join(", "));
            ("posture", vec![(keys::JOINTS.name, list)])
        }
        TaskKind::JointSpeed {
            joint,
            speed_rad_per_s,
        } => (
            "joint_speed",
            vec![
                (keys::JOINT.name, joint.to_string()),
                (keys::SPEED_RAD_PER_S.name, number(*speed_rad_per_s)),
            ],
        ),
        TaskKind::Manipulability { part } => {
            ("manipulability", vec![(keys::PART.name, text(part.name()))])
        }
        TaskKind::SmallestSingularValue { part } => (
            "smallest_singular_value",
            vec![(keys::PART.name, text(part.name()))],
        ),
        TaskKind::Elbow {
            shoulder,
            elbow,
            wrist,
            direction,
        } => (
            "elbow",
            vec![
                (keys::SHOULDER.name, text(shoulder)),
                (keys::ELBOW.name, text(elbow)),
                (keys::WRIST.name, text(wrist)),
                (keys::DIRECTION.name, vector(direction)),
            ],
        ),
    }
}

fn point(point_m: &[f64; 3]) -> Line {
    (keys::POINT_M.name, vector(point_m))
}

fn quaternion(wxyz: &[f64; 4]) -> Line {
    (keys::DESIRED_QUATERNION_WXYZ.name, vector(wxyz))
}
