//! From the task of a scenario to that of the controller.

use conik::{
    Coordinate, Distance, Elbow, FieldOfView, Frame, FramePose, Interval, JacobianPart,
    JointPosition, JointSpeed, LookAt, Manipulability, Orientation, OrientationAngle, Plane,
    PointingAngle, Pose, Position, Posture, Robot, SmallestSingularValue, Stack, Task, TaskId,
};

use crate::experiment::ExperimentError;
use crate::named_shapes::NoPair;
use crate::scenario::{Axis, Frames, GoalConfig, Part, TaskConfig, TaskKind};

/// Adds the task below all others.
pub(crate) fn add_task(
    stack: &mut Stack,
    robot: &Robot,
    config: &TaskConfig,
) -> Result<TaskId, ExperimentError> {
    let link = |name: &String| link(robot, name);
    let (frame, from) = frames(robot, &config.frames)?;
    match config.kind {
        TaskKind::Shapes(ref pair) => add(stack, config, pair.task(robot)?),
        TaskKind::ShapeDistance { ref shapes } => Err(without_shapes(config, shapes)),
        TaskKind::Position => add(stack, config, Position::of(frame).relative_to(from)),
        TaskKind::Coordinate { axis } => {
            let axis = match axis {
                Axis::X => conik::Axis::X,
                Axis::Y => conik::Axis::Y,
                Axis::Z => conik::Axis::Z,
            };
            let coordinate = Coordinate::of(frame, axis);
            add(stack, config, coordinate.relative_to(from))
        }
        TaskKind::Distance { point_m } => {
            let distance = Distance::between(frame, point_m);
            add(stack, config, distance.relative_to(from))
        }
        TaskKind::FieldOfView { direction } => {
            let view = FieldOfView::between(frame, direction);
            add(stack, config, view.relative_to(from))
        }
        TaskKind::Orientation {
            desired_quaternion_wxyz,
        } => {
            let desired = Pose::from_quaternion_wxyz(desired_quaternion_wxyz);
            let orientation = Orientation::of(frame, desired);
            add(stack, config, orientation.relative_to(from))
        }
        TaskKind::OrientationAngle {
            desired_quaternion_wxyz,
        } => {
            let desired = Pose::from_quaternion_wxyz(desired_quaternion_wxyz);
            let angle = OrientationAngle::between(frame, desired);
            add(stack, config, angle.relative_to(from))
        }
        TaskKind::Pose {
            target_m,
            desired_quaternion_wxyz,
        } => {
            let desired = Pose {
                origin: target_m.into(),
                ..Pose::from_quaternion_wxyz(desired_quaternion_wxyz)
            };
            let pose = FramePose::of(frame, desired);
            add(stack, config, pose.relative_to(from))
        }
        TaskKind::PointingAngle { axis, direction } => {
            let angle = PointingAngle::between(frame, direction).with_axis(axis);
            add(stack, config, angle.relative_to(from))
        }
        TaskKind::LookAt { point_m } => {
            let look = LookAt::between(frame, point_m);
            add(stack, config, look.relative_to(from))
        }
        TaskKind::Plane { normal, offset_m } => {
            let plane = Plane::between(frame, normal, offset_m);
            add(stack, config, plane.relative_to(from))
        }
        TaskKind::Height => add(stack, config, Plane::height_of(frame).relative_to(from)),
        TaskKind::Joint { joint } => {
            let position = JointPosition::of_robot(index(joint), robot);
            add(stack, config, position)
        }
        TaskKind::Posture { ref joints } => {
            let joints = joints.iter().map(|joint| index(*joint));
            add(stack, config, Posture::of(joints))
        }
        TaskKind::JointSpeed {
            joint,
            speed_rad_per_s,
        } => add(stack, config, JointSpeed::of(index(joint), speed_rad_per_s)),
        TaskKind::Manipulability { part } => {
            let manipulability = Manipulability::of(frame, rows(part));
            add(stack, config, manipulability.relative_to(from))
        }
        TaskKind::SmallestSingularValue { part } => {
            let smallest = SmallestSingularValue::of(frame, rows(part));
            add(stack, config, smallest.relative_to(from))
        }
        TaskKind::Elbow {
            ref shoulder,
            ref elbow,
            ref wrist,
            direction,
        } => {
            let arm = [link(shoulder)?, link(elbow)?, link(wrist)?];
            add(stack, config, Elbow::of(arm, direction).relative_to(from))
        }
    }
}

/// What is added has the shapes themselves in the place of their names.
fn without_shapes(config: &TaskConfig, names: &[String; 2]) -> ExperimentError {
    ExperimentError::Shapes(config.name.clone(), NoPair::Unknown(names[0].clone()))
}

/// What is measured, and the frame that it is seen from.
pub(crate) fn frames(robot: &Robot, frames: &Frames) -> Result<(Frame, Frame), ExperimentError> {
    let frame = frames.frame.as_ref();
    let frame = frame.map_or(Ok(Frame::Tool), |name| link(robot, name))?;
    let from = frames.relative_to.as_ref();
    let from = from.map_or(Ok(Frame::World), |name| link(robot, name))?;
    Ok((frame, from))
}

fn link(robot: &Robot, name: &String) -> Result<Frame, ExperimentError> {
    let place = robot.link_names().position(|link| link == name);
    place
        .map(Frame::Link)
        .ok_or_else(|| ExperimentError::UnknownLink(name.clone()))
}

/// Joints are counted from 1 in scenarios; 0 is refused by the stack as any other that the robot does not
/// have.
fn index(joint: usize) -> usize {
    joint.wrapping_sub(1)
}

fn rows(part: Part) -> JacobianPart {
    match part {
        Part::Position => JacobianPart::Position,
        Part::Orientation => JacobianPart::Orientation,
        Part::Pose => JacobianPart::Pose,
    }
}

fn add(stack: &mut Stack, config: &TaskConfig, task: impl Task) -> Result<TaskId, ExperimentError> {
    let name = &config.name;
    Ok(match &config.goal {
        GoalConfig::Waypoints {
            waypoints_m,
            gain_per_s,
            ..
        } => {
            let first = match config.kind {
                TaskKind::Position => waypoints_m
                    .first()
                    .ok_or_else(|| ExperimentError::NoWaypoints(name.clone()))?
                    .to_vec(),
                // Of all others zero is desired; where that is, is their own parameter.
                _ => vec![0.0; task.dimension()],
            };
            stack.equality(name, task, &first, *gain_per_s)?
        }
        GoalConfig::Desired {
            desired,
            gain_per_s,
        } => stack.equality(name, task, desired, *gain_per_s)?,
        GoalConfig::Set {
            min,
            max,
            gain_per_s,
            ..
        } => {
            let set = Interval {
                min: min.unwrap_or(f64::NEG_INFINITY),
                max: max.unwrap_or(f64::INFINITY),
            };
            match gain_per_s {
                Some(gain) => stack.set_with_gain(name, task, set, *gain)?,
                None => stack.set(name, task, set)?,
            }
        }
    })
}
