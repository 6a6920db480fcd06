//! Random scenes: an arm, a configuration and a task list, for the crate and for the oracle alike.

use std::f64::consts::FRAC_PI_2;

use conik::{
    Axis, Controller, Coordinate, Distance, FieldOfView, Interval, JointPosition, Position,
    Settings, Stack, StackError, TaskId,
};
use proptest::prelude::*;
use proptest::strategy::Union;

use super::arm::Arm;
use super::{Goal, Measure, Task};

#[derive(Clone, Debug)]
pub struct Scene {
    pub arm: Arm,
    pub q0: Vec<f64>,
    pub tasks: Vec<Task>,
}

impl Scene {
    /// A controller for the scene.
    pub fn controller(&self, settings: Settings) -> Controller {
        self.controller_excluding(settings, &[])
    }

    /// A controller in which no two sets of a pair are active together.
    pub fn controller_excluding(
        &self,
        settings: Settings,
        exclusive: &[(usize, usize)],
    ) -> Controller {
        let robot = self.arm.robot();
        let mut stack = Stack::new(&robot);
        let mut ids = Vec::new();
        for (i, task) in self.tasks.iter().enumerate() {
            ids.push(add(&mut stack, &format!("task_{i}"), task).expect("sound tasks"));
        }
        for &(a, b) in exclusive {
            stack.exclude_together(&[ids[a], ids[b]]).expect("sets");
        }
        Controller::new(&robot, stack, settings).expect("sound settings")
    }
}

/// Adds a task to a stack.
pub fn add(stack: &mut Stack, name: &str, task: &Task) -> Result<TaskId, StackError> {
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

/// How far inside its border a set is at the start [task's unit].
pub type Margin = BoxedStrategy<f64>;

/// Sets that soon matter: somewhat outside, or inside by up to 0.3.
pub fn near_the_border() -> Margin {
    prop_oneof![-0.1..-0.01, 0.001..0.3_f64].boxed()
}

/// Sets that matter at once: many just outside or as good as on their border.
pub fn at_the_border() -> Margin {
    prop_oneof![
        2 => -0.1..-0.01,
        4 => -1e-5..-1e-8,
        4 => 1e-8..1e-4,
        1 => 0.01..0.3_f64,
    ]
    .boxed()
}

/// The UR5, or an arm of 3 to 10 joints.
pub fn any_arm() -> impl Strategy<Value = Arm> {
    let twist = prop_oneof![Just(0.0), Just(FRAC_PI_2), Just(-FRAC_PI_2), -1.5..1.5_f64];
    let row = (-0.5..0.5_f64, twist, -0.3..0.3_f64).prop_map(|(a, alpha, d)| [a, alpha, d]);
    let other = prop::collection::vec(row, 3..=10).prop_map(Arm);
    prop_oneof![Just(Arm::ur5()), other]
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [-0.6..0.6, -0.6..0.6, -0.5..0.6_f64]
}

fn scalar_measure(dof: usize) -> impl Strategy<Value = Measure> {
    prop_oneof![
        (0..3_usize).prop_map(Measure::Coordinate),
        point().prop_map(Measure::Distance),
        prop::array::uniform3(-1.0..1.0_f64)
            .prop_filter("a direction", |d| d.iter().any(|v| v.abs() > 0.1))
            .prop_map(Measure::FieldOfView),
        (0..dof).prop_map(Measure::Joint),
    ]
}

/// A set-based task whose border lies `margin` from the value at `q`.
fn set(arm: Arm, q: Vec<f64>, margin: Margin) -> BoxedStrategy<Task> {
    (scalar_measure(arm.dof()), margin, 0..3_u8, 0.2..2.0_f64)
        .prop_map(move |(measure, margin, sides, gain)| {
            let sigma = arm.measure(measure, &q).0[0];
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
        .boxed()
}

fn equality(dof: usize) -> BoxedStrategy<Task> {
    let position = (point(), 0.2..1.0_f64).prop_map(|(target, gain)| Task {
        measure: Measure::Position,
        goal: Goal::Equality(target.to_vec()),
        gain,
    });
    let scalar =
        (scalar_measure(dof), 0.0..0.8_f64, 0.2..1.0_f64).prop_map(|(measure, desired, gain)| {
            Task {
                measure,
                goal: Goal::Equality(vec![desired]),
                gain,
            }
        });
    Union::new_weighted(vec![(3, position.boxed()), (2, scalar.boxed())]).boxed()
}

/// Up to `max_high` sets above an equality task, then up to `max_lower` equality tasks and sets in any
/// order.
pub fn scene(
    arm: impl Strategy<Value = Arm>,
    margin: Margin,
    max_high: usize,
    max_lower: usize,
) -> impl Strategy<Value = Scene> {
    let joint = prop_oneof![-2.9..-0.2, 0.2..2.9_f64];
    let posture = arm.prop_flat_map(move |arm| {
        let q = prop::collection::vec(joint.clone(), arm.dof());
        (Just(arm), q)
    });
    posture.prop_flat_map(move |(arm, q0)| {
        let set = set(arm.clone(), q0.clone(), margin.clone());
        let dof = arm.dof();
        let high = prop::collection::vec(set.clone(), 0..=max_high);
        let lower = prop::collection::vec(prop_oneof![equality(dof), set], 0..=max_lower);
        (high, equality(dof), lower).prop_map(move |(mut tasks, first, lower)| {
            tasks.push(first);
            tasks.extend(lower);
            Scene {
                arm: arm.clone(),
                q0: q0.clone(),
                tasks,
            }
        })
    })
}
