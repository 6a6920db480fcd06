//! Random scenes in closed loop against the plain second implementation in `oracle`, which goes
//! through all 2ⁿ modes with pseudoinverses by eigenvectors.

mod oracle;

use conik::{
    Axis, Controller, Coordinate, Distance, FieldOfView, Interval, JointPosition, JointVec,
    ModeRule, Position, Robot, Settings, Stack, StackError, TaskId,
};
use oracle::{Goal, Measure, Task};
use proptest::prelude::*;
use proptest::strategy::Union;

/// Largest difference of a joint velocity [rad/s].
const TOLERANCE: f64 = 1e-9;

/// Nearer to a singularity than this, rounding alone moves the velocities by more than the tolerance.
const SINGULAR: f64 = 1e-2;

fn point() -> impl Strategy<Value = [f64; 3]> {
    [-0.6..0.6, -0.6..0.6, -0.5..0.6_f64]
}

fn scalar_measure() -> impl Strategy<Value = Measure> {
    prop_oneof![
        (0..3_usize).prop_map(Measure::Coordinate),
        point().prop_map(Measure::Distance),
        prop::array::uniform3(-1.0..1.0_f64)
            .prop_filter("a direction", |d| d.iter().any(|v| v.abs() > 0.1))
            .prop_map(Measure::FieldOfView),
        (0..6_usize).prop_map(Measure::Joint),
    ]
}

/// A set-based task whose border lies near the value at `q`, so that it soon matters.
fn set(q: [f64; 6]) -> impl Strategy<Value = Task> {
    (
        scalar_measure(),
        prop_oneof![-0.1..-0.01, 0.001..0.3_f64],
        0..3_u8,
        0.2..2.0_f64,
    )
        .prop_map(move |(measure, margin, sides, gain)| {
            let sigma = oracle::measure(measure, &q).0[0];
            let (min, max) = match sides {
                0 => (sigma - margin, f64::INFINITY),
                1 => (f64::NEG_INFINITY, sigma + margin),
                _ => (sigma - margin, sigma - margin + 0.4),
            };
            Task {
                measure,
                goal: Goal::Set(min, max),
                gain,
            }
        })
}

fn equality() -> impl Strategy<Value = Task> {
    let position = (point(), 0.2..1.0_f64).prop_map(|(target, gain)| Task {
        measure: Measure::Position,
        goal: Goal::Equality(target.to_vec()),
        gain,
    });
    let scalar =
        (scalar_measure(), 0.0..0.8_f64, 0.2..1.0_f64).prop_map(|(measure, desired, gain)| Task {
            measure,
            goal: Goal::Equality(vec![desired]),
            gain,
        });
    Union::new_weighted(vec![(3, position.boxed()), (2, scalar.boxed())])
}

#[derive(Clone, Debug)]
struct Scene {
    q0: [f64; 6],
    tasks: Vec<Task>,
}

/// Up to ten tasks: sets above, then equality tasks and sets in any order.
fn scene(max_high: usize, max_lower: usize) -> impl Strategy<Value = Scene> {
    prop::array::uniform6(prop_oneof![-2.9..-0.2, 0.2..2.9_f64]).prop_flat_map(move |q0| {
        let high = prop::collection::vec(set(q0), 0..=max_high);
        let lower = prop::collection::vec(prop_oneof![equality(), set(q0)], 0..=max_lower);
        (high, equality(), lower).prop_map(move |(mut tasks, first, lower)| {
            tasks.push(first);
            tasks.extend(lower);
            Scene { q0, tasks }
        })
    })
}

fn add(stack: &mut Stack, name: &str, task: &Task) -> Result<TaskId, StackError> {
    match task.measure {
        Measure::Position => add_as(stack, name, task, Position::of_tool()),
        Measure::Coordinate(k) => add_as(
            stack,
            name,
            task,
            Coordinate::of_tool([Axis::X, Axis::Y, Axis::Z][k]),
        ),
        Measure::Distance(point) => add_as(stack, name, task, Distance::of_tool_to(point)),
        Measure::FieldOfView(along) => add_as(stack, name, task, FieldOfView::of_tool_along(along)),
        Measure::Joint(i) => add_as(stack, name, task, JointPosition::of(i)),
    }
}

fn add_as(
    stack: &mut Stack,
    name: &str,
    task: &Task,
    measure: impl conik::Task,
) -> Result<TaskId, StackError> {
    match &task.goal {
        Goal::Equality(desired) => stack.equality(name, measure, desired, task.gain),
        &Goal::Set(min, max) => {
            stack.set_with_gain(name, measure, Interval { min, max }, task.gain)
        }
    }
}

/// Follows the crate's own trajectory and compares every tick with the oracle at the same q.
fn assert_same_modes_and_velocities(
    scene: &Scene,
    rule: ModeRule,
    ticks: usize,
) -> Result<(), TestCaseError> {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    for (i, task) in scene.tasks.iter().enumerate() {
        add(&mut stack, &format!("task_{i}"), task).expect("sound tasks");
    }
    let settings = Settings {
        mode_rule: rule,
        ..Settings::of_the_paper()
    };
    let mut controller = Controller::new(&robot, stack, settings).expect("sound settings");
    let mut q = JointVec::from(scene.q0);
    for tick in 0..ticks {
        let expected = oracle::step(&scene.tasks, &q, rule == ModeRule::Border);
        if expected.conditioning < SINGULAR {
            break;
        }
        let step = controller.step(&q).expect("finite configuration");
        let chosen = step
            .active
            .iter()
            .fold(0_u32, |bits, task| bits | 1 << task.index());
        prop_assert_eq!(chosen, expected.active, "tick {}, q {:?}", tick, q);
        for (a, b) in step.qd.iter().zip(expected.qd.iter()) {
            prop_assert!(
                (a - b).abs() <= TOLERANCE,
                "tick {tick}: {:?} instead of {:?}",
                step.qd,
                expected.qd
            );
        }
        q = step.q_ref;
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn paper_rule_equals_full_enumeration(scene in scene(5, 3)) {
        assert_same_modes_and_velocities(&scene, ModeRule::Paper, 25)?;
    }

    #[test]
    fn border_rule_equals_full_enumeration(scene in scene(5, 3)) {
        assert_same_modes_and_velocities(&scene, ModeRule::Border, 25)?;
    }

    /// More sets than joints, so that frozen rows must depend on each other.
    #[test]
    fn many_sets_equal_full_enumeration(scene in scene(8, 1)) {
        assert_same_modes_and_velocities(&scene, ModeRule::Paper, 6)?;
    }
}
