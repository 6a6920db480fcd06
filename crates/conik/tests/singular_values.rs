//! Manipulability and the smallest singular value against an independent decomposition, and at and near
//! singularities.

use conik::{
    DhRow, Frame, JacobianMut, JacobianPart, Kinematics, Manipulability, Robot,
    SmallestSingularValue, Task,
};
use nalgebra::DMatrix;

mod robots;

use robots::{mixed_arm, tree};

fn nine_joints() -> Robot {
    let rows: Vec<DhRow> = (0..9)
        .map(|i| DhRow::new(0.1, [1.2, -0.7, 0.4][i % 3], 0.05))
        .collect();
    Robot::from_dh("nine", &rows).expect("sound")
}

fn ur5() -> Robot {
    Robot::builtin("ur5-paper").expect("built in")
}

fn value_at(task: &dyn Task, robot: &Robot, q: &[f64]) -> f64 {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let mut value = [f64::NAN];
    task.value(&kinematics, &mut value);
    value[0]
}

fn row_at(task: &dyn Task, robot: &Robot, q: &[f64]) -> Vec<f64> {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let mut row = vec![f64::NAN; q.len()];
    task.jacobian(&kinematics, &mut JacobianMut::new(&mut row, q.len()));
    row
}

/// The singular values of the tool's Jacobian in the world, by another library.
fn expected(robot: &Robot, q: &[f64], part: JacobianPart) -> Vec<f64> {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(q);
    let (n, motion) = (q.len(), kinematics.motion(Frame::Tool));
    let tool = kinematics.world_from(Frame::Tool).origin;
    let mut rows = vec![0.0; 6 * n];
    let (along, about) = rows.split_at_mut(3 * n);
    kinematics.point_rows(motion, tool, JacobianMut::new(along, n).rows());
    for (axis, row) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .into_iter()
        .zip(about.chunks_mut(n))
    {
        kinematics.turn_row(motion, axis.into(), row);
    }
    let rows = match part {
        JacobianPart::Position => &rows[..3 * n],
        JacobianPart::Orientation => &rows[3 * n..],
        JacobianPart::Pose => &rows[..],
    };
    let matrix = DMatrix::from_row_slice(rows.len() / n, n, rows);
    matrix.singular_values().iter().copied().collect()
}

const PARTS: [JacobianPart; 3] = [
    JacobianPart::Position,
    JacobianPart::Orientation,
    JacobianPart::Pose,
];

fn cases() -> [(Robot, Vec<f64>); 5] {
    [
        (ur5(), vec![0.3, -1.2, 1.4, -0.6, 1.0, 0.2]),
        (ur5(), vec![-2.0, 0.4, -0.9, 2.2, -1.3, 0.7]),
        (
            nine_joints(),
            vec![0.3, -0.5, 0.4, 1.2, -0.9, 0.1, 0.8, -0.3, 0.6],
        ),
        (mixed_arm(), vec![0.3, 0.25, 1.4, -0.6, 0.1, 0.2]),
        (tree(), vec![0.3, -0.5, 0.4, 1.2, -0.9]),
    ]
}

#[test]
fn values_are_those_of_another_library() {
    for (robot, q) in cases() {
        for part in PARTS {
            let expected = expected(&robot, &q, part);
            let smallest = expected.iter().copied().fold(f64::INFINITY, f64::min);
            if part == JacobianPart::Pose && q.len() < 6 {
                continue;
            }
            let found = value_at(&SmallestSingularValue::of_tool(part), &robot, &q);
            assert!((found - smallest).abs() < 1e-14, "{part:?}: {found}");
            let found = value_at(&Manipulability::of_tool(part), &robot, &q);
            let product: f64 = expected.iter().product();
            assert!((found - product).abs() < 1e-14, "{part:?}: {found}");
        }
    }
}

#[test]
fn smallest_singular_value_has_the_derivative_of_its_own_value() {
    const STEP: f64 = 1e-5;
    for (robot, q) in cases() {
        for part in PARTS {
            let tasks = [
                SmallestSingularValue::of_tool(part),
                SmallestSingularValue::of_tool(part).relative_to(Frame::Link(4)),
                SmallestSingularValue::of(Frame::World, part).relative_to(Frame::Tool),
            ];
            for task in tasks {
                let value = value_at(&task, &robot, &q);
                if value < 1e-3 {
                    // With too few joints between the frames it is zero everywhere.
                    assert!(value < 1e-14, "{task:?}: {value}");
                    continue;
                }
                let row = row_at(&task, &robot, &q);
                for joint in 0..q.len() {
                    let at = |offset: f64| {
                        let mut q = q.clone();
                        q[joint] += offset;
                        value_at(&task, &robot, &q)
                    };
                    let expected = (at(STEP) - at(-STEP)) / (2.0 * STEP);
                    assert!(
                        (row[joint] - expected).abs() < 1e-7,
                        "{task:?}, joint {joint}: {} instead of {expected}",
                        row[joint]
                    );
                }
            }
        }
    }
}

#[test]
fn manipulability_falls_to_a_singularity_along_its_slope() {
    // On the way to the stretched arm it falls as the sine of the elbow, to the last digit.
    let robot = ur5();
    let task = Manipulability::of_tool(JacobianPart::Pose);
    let at = |elbow: f64| [0.3, -1.2, elbow, -0.6, 1.0, 0.2];
    let slope = row_at(&task, &robot, &at(1e-6))[2];
    for elbow in [1e-5, 1e-7, 1e-9, 1e-11] {
        let value = value_at(&task, &robot, &at(elbow));
        let found = row_at(&task, &robot, &at(elbow));
        assert!(
            (value / (slope * elbow) - 1.0).abs() < 1e-4,
            "{elbow}: {value}"
        );
        assert!((found[2] / slope - 1.0).abs() < 1e-4, "{elbow}: {found:?}");
    }
    // At it, and within a singularity of every posture, there is no slope, but there are numbers.
    for task in [
        &task as &dyn Task,
        &Manipulability::of(Frame::Link(2), JacobianPart::Pose),
        &SmallestSingularValue::of_tool(JacobianPart::Pose),
        &SmallestSingularValue::of(Frame::Link(1), JacobianPart::Position),
    ] {
        assert!(value_at(task, &robot, &at(0.0)) < 1e-15, "{task:?}");
        let row = row_at(task, &robot, &at(0.0));
        assert!(
            row.iter().all(|entry| entry.is_finite()),
            "{task:?} {row:?}"
        );
    }
}

#[test]
fn a_jacobian_with_more_rows_than_joints_is_refused() {
    let task = Manipulability::of_tool(JacobianPart::Pose);
    assert!(task.check(&tree()).is_err());
    assert!(task.check(&ur5()).is_ok());
}
