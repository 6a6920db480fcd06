//! Every Jacobian against central differences of its own task's value, in one table.

use conik::{
    Axis, Coordinate, DhRow, Distance, FieldOfView, Frame, JacobianMut, JointPosition, Kinematics,
    Position, Robot, Task,
};
use proptest::prelude::*;

mod robots;

use robots::{mixed_arm, tree};

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

fn assert_jacobians_are_derivatives(robot: &Robot, q: &[f64]) -> Result<(), TestCaseError> {
    let mut kinematics = Kinematics::new(robot);
    for (name, task) in tasks() {
        let m = task.dimension();
        let mut jacobian = vec![f64::NAN; m * q.len()];
        kinematics.update(q);
        task.jacobian(&kinematics, &mut JacobianMut::new(&mut jacobian, q.len()));
        for joint in 0..q.len() {
            let mut value_at = |offset: f64| {
                let mut moved = q.to_vec();
                moved[joint] += offset;
                kinematics.update(&moved);
                let mut value = vec![f64::NAN; m];
                task.value(&kinematics, &mut value);
                value
            };
            let (after, before) = (value_at(STEP), value_at(-STEP));
            for i in 0..m {
                let expected = (after[i] - before[i]) / (2.0 * STEP);
                let found = jacobian[i * q.len() + joint];
                // Norms bend like 1 / σ near 0, and ε in their denominators shows there.
                let bend = if name.starts_with("distance") || name.starts_with("field") {
                    after[i].powi(-2)
                } else {
                    0.0
                };
                prop_assert!(
                    (found - expected).abs() <= TOLERANCE * (1.0 + bend),
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
fn jacobians_are_finite_where_they_are_undefined() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&[0.3, -1.0, 0.7, 0.2, 0.5, 0.1]);
    let tool = *kinematics.world_from(Frame::Tool);
    let at_zero: [Box<dyn Task>; 2] = [
        Box::new(Distance::of_tool_to(tool.origin)),
        Box::new(FieldOfView::of_tool_along(tool.z_axis)),
    ];
    for task in at_zero {
        let mut jacobian = [f64::NAN; 6];
        task.jacobian(&kinematics, &mut JacobianMut::new(&mut jacobian, 6));
        assert!(
            jacobian.iter().all(|v| v.is_finite()),
            "{task:?}: {jacobian:?}"
        );
    }
}
