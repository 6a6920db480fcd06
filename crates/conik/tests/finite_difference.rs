//! Every Jacobian against central differences of its own task's value, in one table.

use conik::{
    Axis, Coordinate, DhRow, Distance, Elbow, FieldOfView, Frame, FramePose, JacobianMut,
    JacobianPart, JointPosition, JointSpeed, Kinematics, LookAt, Manipulability, Orientation,
    OrientationAngle, Plane, PointingAngle, Pose, Position, Posture, Robot, Task, Vec3,
};
use proptest::prelude::*;

mod robots;
mod shape_distances;

use robots::{mixed_arm, tree};
use shape_distances::shape_distances;

/// Half the difference of positions [rad or m] between the two values compared.
const STEP: f64 = 1e-5;
/// Truncation is of order STEP², rounding of order 1e-16 / STEP.
const TOLERANCE: f64 = 1e-8;

fn tasks() -> Vec<(&'static str, Box<dyn Task>)> {
    vec![
        ("position of the tool", Box::new(Position::of_tool())),
        ("position of a link", Box::new(Position::of(Frame::Link(3)))),
        ("coordinate x", Box::new(Coordinate::of_tool(Axis::X))),
        ("coordinate y", Box::new(Coordinate::of_tool(Axis::Y))),
        (
            "coordinate z of a link",
            Box::new(Coordinate::of(Frame::Link(2), Axis::Z)),
        ),
        (
            "distance of the tool",
            Box::new(Distance::of_tool_to([0.4, -0.25, 1.33])),
        ),
        (
            "distance of a link",
            Box::new(Distance::between(Frame::Link(4), [-0.1, 1.2, 0.3])),
        ),
        (
            "field of view",
            Box::new(FieldOfView::of_tool_along([1.0, 0.3, -0.2])),
        ),
        (
            "field of view of a link",
            Box::new(FieldOfView::between(Frame::Link(5), [0.0, 0.0, -7.0])),
        ),
        (
            "position seen from a link",
            Box::new(Position::of_tool().relative_to(Frame::Link(2))),
        ),
        (
            "position of the world seen from the tool",
            Box::new(Position::of(Frame::World).relative_to(Frame::Tool)),
        ),
        (
            "coordinate seen from a link",
            Box::new(Coordinate::of(Frame::Link(5), Axis::Y).relative_to(Frame::Link(3))),
        ),
        (
            "distance to a point of a link",
            Box::new(Distance::of_tool_to([0.4, -0.3, 0.5]).relative_to(Frame::Link(1))),
        ),
        (
            "field of view along a direction of a link",
            Box::new(FieldOfView::of_tool_along([1.0, 0.3, -0.2]).relative_to(Frame::Link(3))),
        ),
        ("first joint", Box::new(JointPosition::of(0))),
        ("another joint", Box::new(JointPosition::of(4))),
    ]
}

/// Those that have to do with orientations, singularities and several joints.
fn more_tasks() -> Vec<(&'static str, Box<dyn Task>)> {
    let desired = Pose {
        origin: Vec3::new(0.3, -0.2, 0.5),
        ..Pose::turned(Vec3::new(0.4, -1.1, 0.7))
    };
    let arm = [Frame::Link(1), Frame::Link(3), Frame::Tool];
    vec![
        (
            "orientation of the tool",
            Box::new(Orientation::of_tool(desired)),
        ),
        (
            "orientation of a link seen from another",
            Box::new(Orientation::of(Frame::Link(3), desired).relative_to(Frame::Link(5))),
        ),
        (
            "orientation angle",
            Box::new(OrientationAngle::of_tool_to(desired)),
        ),
        (
            "orientation angle seen from a link",
            Box::new(OrientationAngle::of_tool_to(desired).relative_to(Frame::Link(4))),
        ),
        (
            "orientation in a pose",
            Box::new(FramePose::of_tool(desired)),
        ),
        (
            "orientation in a pose seen from a link",
            Box::new(FramePose::of_tool(desired).relative_to(Frame::Link(4))),
        ),
        (
            "pointing",
            Box::new(PointingAngle::of_tool_along([1.0, 0.3, -0.2])),
        ),
        (
            "pointing of another axis seen from a link",
            Box::new(
                PointingAngle::between(Frame::Link(5), [1.0, 0.3, -0.2])
                    .with_axis([0.1, 2.0, -0.4])
                    .relative_to(Frame::Link(2)),
            ),
        ),
        ("looking", Box::new(LookAt::of_tool_at([2.0, 3.0, -2.0]))),
        (
            "looking at a point of a link",
            Box::new(LookAt::of_tool_at([2.0, 3.0, -2.0]).relative_to(Frame::Link(4))),
        ),
        ("plane", Box::new(Plane::of_tool_to([1.0, 2.0, -0.5], 0.3))),
        (
            "plane of a link",
            Box::new(Plane::of_tool_to([1.0, 2.0, -0.5], 0.3).relative_to(Frame::Link(4))),
        ),
        (
            "height of a link",
            Box::new(Plane::height_of(Frame::Link(3))),
        ),
        ("posture", Box::new(Posture::of([3, 0, 2]))),
        ("speed of a joint", Box::new(JointSpeed::of(2, 0.3))),
        (
            "manipulability",
            Box::new(Manipulability::of_tool(JacobianPart::Position)),
        ),
        (
            "manipulability of orientation",
            Box::new(Manipulability::of_tool(JacobianPart::Orientation)),
        ),
        (
            "manipulability as another frame sees it",
            Box::new(Manipulability::of_tool(JacobianPart::Position).relative_to(Frame::Link(4))),
        ),
        ("elbow", Box::new(Elbow::of(arm, [0.3, -0.2, 1.0]))),
        (
            "elbow against a direction of a link",
            Box::new(Elbow::of(arm, [0.3, -0.2, 1.0]).relative_to(Frame::Link(4))),
        ),
    ]
}

/// How large the third derivative may be, but for a factor of order 1.
fn bend(name: &str, value: f64, row: &[f64]) -> f64 {
    match name.split(' ').next() {
        // Norms bend like 1 / σ near 0, and ε in their denominators shows there.
        Some("distance" | "field" | "manipulability") => value.powi(-2),
        Some("orientation") if name.starts_with("orientation angle") => value.powi(-2),
        // Corners come close, and near to each other they turn about each other fast.
        Some("shapes:") => value.powi(-2).max(100.0),
        // Angles, also near π.
        Some("pointing" | "looking") => value.sin().powi(-2),
        // Near the line from shoulder to wrist, or with the reference along it, it turns fast.
        Some("elbow") => 100.0 + 100.0 * row.iter().map(|entry| entry.abs().powi(3)).sum::<f64>(),
        _ => 0.0,
    }
}

/// Where an orientation is so near to half a turn that it may jump between the values compared, or an
/// elbow to ±π.
fn may_jump(name: &str, value: &[f64]) -> bool {
    let turned = match name.split(' ').next() {
        Some("orientation" | "elbow") => &value[value.len().saturating_sub(3)..],
        _ => return false,
    };
    let norm = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm > std::f64::consts::PI - 1e-3
}

fn assert_jacobians_are_derivatives(robot: &Robot, q: &[f64]) -> Result<(), TestCaseError> {
    let mut kinematics = Kinematics::new(robot);
    let tasks = tasks().into_iter().chain(more_tasks());
    for (name, task) in tasks.chain(shape_distances()) {
        let m = task.dimension();
        let mut elsewhere = kinematics.clone();
        let mut jacobian_at = |q: &[f64]| {
            let mut jacobian = vec![f64::NAN; m * q.len()];
            elsewhere.update(q);
            task.jacobian(&elsewhere, &mut JacobianMut::new(&mut jacobian, q.len()));
            jacobian
        };
        let jacobian = jacobian_at(q);
        for joint in 0..q.len() {
            // Where another pair of features becomes the closest, slopes bend or leap, and differences
            // are off by as much as the Jacobian does.
            let mut entry_at = |offset: f64| {
                let mut moved = q.to_vec();
                moved[joint] += offset;
                jacobian_at(&moved)[joint]
            };
            let leap = if name.starts_with("shapes") {
                (entry_at(STEP) - 2.0 * entry_at(0.0) + entry_at(-STEP)).abs()
            } else {
                0.0
            };
            let mut value_at = |offset: f64| {
                let mut moved = q.to_vec();
                moved[joint] += offset;
                kinematics.update(&moved);
                let mut value = vec![f64::NAN; m];
                task.value(&kinematics, &mut value);
                value
            };
            let (after, before) = (value_at(STEP), value_at(-STEP));
            if may_jump(name, &after) {
                continue;
            }
            for i in 0..m {
                let expected = (after[i] - before[i]) / (2.0 * STEP);
                let found = jacobian[i * q.len() + joint];
                let bend = bend(name, after[i], &jacobian[i * q.len()..][..q.len()]);
                prop_assert!(
                    (found - expected).abs() <= TOLERANCE * (1.0 + bend) + leap,
                    "{name}, row {i}, joint {joint}: {found} instead of {expected}"
                );
            }
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn jacobians_are_derivatives_whatever_the_number_of_joints(
        dof in 6_usize..=9,
        q in prop::array::uniform9(-1.5..1.5_f64),
    ) {
        let rows: Vec<DhRow> = (0..dof)
            .map(|i| DhRow::new(0.1, [1.2, -0.7, 0.4][i % 3], 0.05))
            .collect();
        assert_jacobians_are_derivatives(&Robot::from_dh("arm", &rows).expect("sound"), &q[..dof])?;
    }

    #[test]
    fn jacobians_are_derivatives_on_the_ur5(q in prop::array::uniform6(-3.0..3.0_f64)) {
        assert_jacobians_are_derivatives(&Robot::builtin("ur5-paper").expect("built in"), &q)?;
    }

    #[test]
    fn jacobians_are_derivatives_on_a_tree_where_joints_follow_others(
        q in prop::array::uniform5(-1.5..1.5_f64),
    ) {
        assert_jacobians_are_derivatives(&tree(), &q)?;
    }

    #[test]
    fn jacobians_are_derivatives_with_sliding_joints(q in prop::array::uniform6(-1.5..1.5_f64)) {
        assert_jacobians_are_derivatives(&mixed_arm(), &q)?;
    }
}

#[test]
fn jacobian_of_a_whole_pose_makes_its_manipulability() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let task = Manipulability::of_tool(JacobianPart::Pose);
    let mut kinematics = Kinematics::new(&robot);
    for q in [
        [0.3, -1.2, 1.4, -0.6, 1.0, 0.2],
        [-2.0, 0.4, -0.9, 2.2, -1.3, 0.7],
    ] {
        kinematics.update(&q);
        let mut row = [f64::NAN; 6];
        task.jacobian(&kinematics, &mut JacobianMut::new(&mut row, 6));
        for joint in 0..6 {
            let mut at = |offset: f64| {
                let mut moved = q;
                moved[joint] += offset;
                kinematics.update(&moved);
                let mut value = [f64::NAN];
                task.value(&kinematics, &mut value);
                value[0]
            };
            let expected = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            assert!((row[joint] - expected).abs() < TOLERANCE, "joint {joint}");
        }
    }
}

#[test]
fn jacobians_are_finite_where_they_are_undefined() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&[0.3, -1.0, 0.7, 0.2, 0.5, 0.1]);
    let tool = *kinematics.world_from(Frame::Tool);
    let half_a_turn = |axis: Vec3| Pose::turned(axis * std::f64::consts::PI) * tool;
    let elbow = [Frame::Link(1), Frame::Link(2), Frame::Link(3)];
    let [shoulder, _, wrist] = elbow.map(|link| kinematics.world_from(link).origin);
    let undefined: [Box<dyn Task>; 14] = [
        Box::new(Distance::of_tool_to(tool.origin)),
        Box::new(FieldOfView::of_tool_along(tool.z_axis)),
        Box::new(PointingAngle::of_tool_along(tool.z_axis)),
        Box::new(PointingAngle::of_tool_along(-tool.z_axis)),
        Box::new(LookAt::of_tool_at(tool.origin)),
        Box::new(LookAt::of_tool_at(tool.origin + tool.z_axis)),
        Box::new(LookAt::of_tool_at(tool.origin + tool.z_axis * -1e-12)),
        Box::new(Orientation::of_tool(tool)),
        Box::new(Orientation::of_tool(half_a_turn(tool.x_axis))),
        Box::new(Orientation::of_tool(half_a_turn(tool.z_axis))),
        Box::new(OrientationAngle::of_tool_to(tool)),
        Box::new(OrientationAngle::of_tool_to(half_a_turn(tool.y_axis))),
        Box::new(Elbow::of(elbow, wrist - shoulder)),
        Box::new(Manipulability::of(Frame::Link(1), JacobianPart::Pose)),
    ];
    for task in undefined {
        let mut value = [f64::NAN; 3];
        task.value(&kinematics, &mut value[..task.dimension()]);
        let mut jacobian = [f64::NAN; 18];
        let jacobian = &mut jacobian[..6 * task.dimension()];
        task.jacobian(&kinematics, &mut JacobianMut::new(jacobian, 6));
        let is_finite = value[..task.dimension()]
            .iter()
            .chain(&*jacobian)
            .all(|v| v.is_finite());
        assert!(is_finite, "{task:?}: {value:?}, {jacobian:?}");
    }
}
