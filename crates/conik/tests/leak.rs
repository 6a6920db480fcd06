//! A frozen task does not leak while one below it is damped: projectors are strict, only the inverse that
//! makes a velocity is damped.

use conik::{
    Axis, Border, Controller, Coordinate, Frame, JacobianMut, Kinematics, ModeRule, Position,
    Recursion, Robot, Settings, Stack, Task,
};

/// What rounding leaves of a frozen task's rate [unit/s].
const ROUNDING: f64 = 1e-12;

/// J q̇ of a task at q, one entry per component.
fn rate(task: &impl Task, q: &[f64], qd: &[f64]) -> Vec<f64> {
    let mut kinematics = Kinematics::new(&Robot::builtin("ur5-paper").expect("built in"));
    kinematics.update(q);
    let mut rows = vec![0.0; task.dimension() * q.len()];
    task.jacobian(&kinematics, &mut JacobianMut::new(&mut rows, q.len()));
    rows.chunks_exact(q.len())
        .map(|row| row.iter().zip(qd).map(|(a, v)| a * v).sum())
        .collect()
}

/// Configurations with the elbow, then the wrist, more and more in line.
fn near_singularities() -> Vec<[f64; 6]> {
    [0.1, 1e-2, 1e-3, 1e-5, 1e-8, 0.0]
        .into_iter()
        .flat_map(|bend| {
            let elbow = [0.4, -0.8, bend, -0.5, 0.7, 0.2];
            let wrist = [0.4, -1.1, 1.2, -0.5, bend, 0.2];
            [elbow, wrist]
        })
        .collect()
}

/// One tick at `q` of a stack in which the task `above` must not move and a position below it is asked
/// outward. The rate of the task above, and by how much the position falls short of what it asks.
fn leak(q: [f64; 6], settings: Settings, is_equality: bool) -> (f64, f64) {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&q);
    let tool = kinematics.world_from(Frame::Tool).origin.to_array();
    let above = Coordinate::of_tool(Axis::X);
    let mut stack = Stack::new(&robot);
    let target = tool.map(|v| 1.2 * v);
    if is_equality {
        stack.equality("above", above, &tool[..1], 1.0)
    } else if target[0] > tool[0] {
        stack.set("above", above, ..=tool[0])
    } else {
        stack.set("above", above, tool[0]..)
    }
    .expect("sound");
    let gain = 0.5;
    let position = stack
        .equality("position", Position::of_tool(), &target, gain)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, settings).expect("sound");
    let step = controller.step(&q).expect("finite").clone();
    assert!(is_equality || !step.active.is_empty(), "the set is active");
    let got = rate(&Position::of_tool(), &q, &step.qd);
    let short = got
        .iter()
        .zip(step.error(position))
        .skip(1)
        .map(|(got, error)| (gain * error - got).abs())
        .fold(0.0, f64::max);
    (rate(&above, &q, &step.qd)[0].abs(), short)
}

#[test]
fn a_frozen_task_does_not_move_while_the_one_below_is_damped() {
    let mut damped = 0;
    for mode_rule in [ModeRule::Paper, ModeRule::Border, ModeRule::Cone] {
        for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
            for is_equality in [false, true] {
                for q in near_singularities() {
                    let settings = Settings {
                        mode_rule,
                        recursion,
                        border: Border::Freeze,
                        ..Settings::at_rate(125.0)
                    };
                    let (moved, short) = leak(q, settings, is_equality);
                    assert!(
                        moved <= ROUNDING,
                        "{settings:?}, equality {is_equality}, {q:?}: moves at {moved}"
                    );
                    damped += usize::from(short > 1e-3);
                }
            }
        }
    }
    assert!(damped > 20, "{damped} ticks were damped");
}
