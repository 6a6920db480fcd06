//! Second derivatives of every task against central differences of its own Jacobian.

use conik::{
    Axis, Coordinate, Distance, FieldOfView, Frame, JacobianMut, JointPosition, Kinematics, Plane,
    PointingAngle, Position, Robot, Task,
};

mod robots;

use robots::{mixed_arm, tree};

const STEP: f64 = 1e-5;

fn tasks() -> Vec<Box<dyn Task>> {
    vec![
        Box::new(Position::of_tool()),
        Box::new(Position::of(Frame::Link(4))),
        Box::new(Coordinate::of_tool(Axis::Y)),
        Box::new(Distance::of_tool_to([0.4, -0.2, 0.3])),
        Box::new(Distance::between(Frame::Link(3), [0.1, 0.5, -0.2])),
        Box::new(FieldOfView::of_tool_along([1.0, -0.5, 0.3])),
        Box::new(FieldOfView::between(Frame::Link(5), [0.2, 0.1, -1.0])),
        Box::new(Position::of_tool().relative_to(Frame::Link(3))),
        Box::new(Coordinate::of(Frame::World, Axis::X).relative_to(Frame::Link(4))),
        Box::new(Distance::of_tool_to([0.4, -0.3, 0.5]).relative_to(Frame::Link(1))),
        Box::new(FieldOfView::of_tool_along([1.0, 0.3, -0.2]).relative_to(Frame::Link(3))),
        Box::new(Plane::of_tool_to([1.0, 2.0, -0.5], 0.3)),
        Box::new(Plane::height_of(Frame::World).relative_to(Frame::Link(4))),
        Box::new(PointingAngle::of_tool_along([1.0, -0.5, 0.3])),
        Box::new(
            PointingAngle::between(Frame::Link(5), [1.0, 0.3, -0.2])
                .with_axis([0.1, 2.0, -0.4])
                .relative_to(Frame::Link(3)),
        ),
        Box::new(JointPosition::of(2)),
    ]
}

/// Σ wᵢ Jᵢ at `q`.
fn weighted_row(task: &dyn Task, robot: &Robot, q: &[f64], weights: &[f64]) -> Vec<f64> {
    let (mut kinematics, n) = (Kinematics::new(robot), q.len());
    kinematics.update(q);
    let mut jacobian = vec![0.0; task.dimension() * n];
    task.jacobian(&kinematics, &mut JacobianMut::new(&mut jacobian, n));
    (0..n)
        .map(|j| {
            weights
                .iter()
                .zip(jacobian.chunks(n))
                .map(|(weight, row)| weight * row[j])
                .sum()
        })
        .collect()
}

fn assert_second_derivatives(robot: &Robot, q: &[f64]) {
    let n = q.len();
    for task in tasks() {
        let weights = &[0.7, -1.3, 0.4][..task.dimension()];
        let mut kinematics = Kinematics::new(robot);
        kinematics.update(q);
        // What is there already is added to.
        let mut hessian = vec![1.0; n * n];
        task.add_curvature(&kinematics, weights, &mut hessian);
        for i in 0..n {
            let shifted = |step: f64| {
                let mut q = q.to_vec();
                q[i] += step;
                weighted_row(&*task, robot, &q, weights)
            };
            for (j, (plus, minus)) in shifted(STEP).iter().zip(shifted(-STEP)).enumerate() {
                let expected = 1.0 + (plus - minus) / (2.0 * STEP);
                let found = hessian[i * n + j];
                assert!(
                    (found - expected).abs() < 1e-8,
                    "{task:?} {i} {j}: {found}, {expected}"
                );
            }
        }
    }
}

#[test]
fn curvature_is_the_derivative_of_the_jacobian() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    for q in [
        [0.3, -1.2, 1.4, -0.6, 1.0, 0.2],
        [-2.0, 0.4, -0.9, 2.2, -1.3, 0.7],
    ] {
        assert_second_derivatives(&robot, &q);
    }
}

#[test]
fn sliding_joints_turn_nothing() {
    assert_second_derivatives(&mixed_arm(), &[0.3, 0.25, 1.4, -0.6, 0.1, 0.2]);
}

#[test]
fn of_a_tree_only_the_joints_between_two_frames_count() {
    assert_second_derivatives(&tree(), &[0.3, -0.5, 0.4, 1.2, -0.9]);
}
