//! Border `Land` under every rule and recursion: on random scenes, at random rates, no sample lies
//! outside a set that was entered, to the last bit, and none gets worse before.

use std::f64::consts::PI;

use conik::{
    Axis, Border, Controller, Coordinate, Distance, FieldOfView, Interval, JointPosition, JointVec,
    ModeRule, Position, Recursion, Robot, Settings, Stack, Task, TaskId,
};
use proptest::prelude::*;

/// What may be given away before a set is entered: the margin, once, and rounding.
const MARGIN: f64 = 1e-7 + 1e-12;

#[derive(Clone, Debug)]
enum Measure {
    Coordinate(Axis),
    Distance([f64; 3]),
    View([f64; 3]),
    Joint(usize),
}

impl Measure {
    fn task(&self) -> Box<dyn Task> {
        match *self {
            Self::Coordinate(axis) => Box::new(Coordinate::of_tool(axis)),
            Self::Distance(point) => Box::new(Distance::of_tool_to(point)),
            Self::View(along) => Box::new(FieldOfView::of_tool_along(along)),
            Self::Joint(joint) => Box::new(JointPosition::of(joint)),
        }
    }
}

/// A set whose border is `away` from the value at the start, inside or, if negative, outside.
#[derive(Clone, Debug)]
struct Set {
    measure: Measure,
    is_upper: bool,
    away: f64,
}

#[derive(Clone, Debug)]
struct Scene {
    q0: [f64; 6],
    sets: Vec<Set>,
    goal: [f64; 3],
    gain: f64,
    rate_hz: f64,
}

fn set() -> impl Strategy<Value = Set> {
    let measure = prop_oneof![
        3 => [-0.7..0.7, -0.7..0.7, -0.5..0.7_f64].prop_map(Measure::Distance),
        1 => prop_oneof![Just(Axis::X), Just(Axis::Y), Just(Axis::Z)].prop_map(Measure::Coordinate),
        1 => [0.1..1.0, -1.0..1.0, -1.0..1.0_f64].prop_map(Measure::View),
        1 => (0..6_usize).prop_map(Measure::Joint),
    ];
    let away = prop_oneof![3 => 0.001..0.2_f64, 1 => Just(0.0), 1 => -0.1..-0.001_f64];
    (measure, any::<bool>(), away).prop_map(|(measure, is_upper, away)| Set {
        measure,
        is_upper,
        away,
    })
}

fn scene() -> impl Strategy<Value = Scene> {
    (
        prop::array::uniform6(prop_oneof![-2.9..-0.2, 0.2..2.9_f64]),
        prop::collection::vec(set(), 1..7),
        [-0.7..0.7, -0.7..0.7, -0.4..0.7_f64],
        0.3..5.0_f64,
        20.0..500.0_f64,
    )
        .prop_map(|(q0, sets, goal, gain, rate_hz)| Scene {
            q0,
            sets,
            goal,
            gain,
            rate_hz,
        })
}

/// σ of a task at `q`.
fn value(robot: &Robot, task: &dyn Task, q: &[f64]) -> f64 {
    let mut kinematics = conik::Kinematics::new(robot);
    kinematics.update(q);
    let mut sigma = [0.0];
    task.value(&kinematics, &mut sigma);
    sigma[0]
}

/// A controller of the scene, and its sets.
fn controller(scene: &Scene, settings: Settings) -> (Controller, Vec<(TaskId, Interval)>) {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let mut sets = vec![];
    for (i, set) in scene.sets.iter().enumerate() {
        let sigma = value(&robot, &*set.measure.task(), &scene.q0);
        let interval = if set.is_upper {
            Interval::from(..=sigma + set.away)
        } else {
            Interval::from(sigma - set.away..)
        };
        let name = format!("set_{i}");
        let id = match set.measure {
            Measure::Coordinate(axis) => stack.set(&name, Coordinate::of_tool(axis), interval),
            Measure::Distance(point) => stack.set(&name, Distance::of_tool_to(point), interval),
            Measure::View(along) => stack.set(&name, FieldOfView::of_tool_along(along), interval),
            Measure::Joint(joint) => stack.set(&name, JointPosition::of(joint), interval),
        };
        sets.push((id.expect("sound"), interval));
    }
    stack
        .equality("position", Position::of_tool(), &scene.goal, scene.gain)
        .expect("sound");
    let controller = Controller::new(&robot, stack, settings).expect("sound settings");
    (controller, sets)
}

fn assert_stays_inside(scene: &Scene, settings: Settings) -> Result<(), TestCaseError> {
    let (mut controller, sets) = controller(scene, settings);
    let mut best: Vec<f64> = vec![f64::INFINITY; sets.len()];
    let mut q = JointVec::from(scene.q0);
    for tick in 0..200 {
        let step = controller.step(&q).expect("finite");
        for ((id, set), best) in sets.iter().zip(&mut best) {
            let outside = set.violation(step.value(*id)[0]);
            let slack = if *best == 0.0 { 0.0 } else { 3.0 * MARGIN };
            prop_assert!(
                outside <= *best + slack,
                "tick {tick}, {settings:?}: {outside} outside {set:?}, was {best}"
            );
            *best = best.min(outside);
        }
        prop_assert!(step.qd.iter().all(|speed| speed.abs() <= PI + 1e-9));
        prop_assert!(step.landed.kinematics <= 9 && step.landed.outside.is_none());
        q = step.q_ref;
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(120) })]

    #[test]
    fn every_sample_is_inside_every_set_entered(scene in scene()) {
        for mode_rule in [ModeRule::Paper, ModeRule::Border, ModeRule::Cone] {
            for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
                let border = Border::Land;
                let settings = Settings { rate_hz: scene.rate_hz, mode_rule, border, recursion };
                assert_stays_inside(&scene, settings)?;
            }
        }
    }
}
