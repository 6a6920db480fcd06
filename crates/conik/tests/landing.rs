//! Border `Land` under every rule and recursion: on random scenes, at random rates, no sample lies
//! outside a set that was entered, to the last bit, and none gets worse before.

use std::f64::consts::PI;

use conik::{
    Axis, Border, Controller, Coordinate, Distance, FieldOfView, Frame, Interval, JacobianMut,
    JointPosition, JointVec, Kinematics, ModeRule, Position, Recursion, Robot, Settings, Stack,
    Task, TaskId, Vec3,
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

/// σ = q₀, with a Jacobian that points the wrong way: no correction helps.
#[derive(Debug)]
struct Misleading;

impl Task for Misleading {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = kinematics.q()[0];
    }

    fn jacobian(&self, _: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        jacobian.row(0).fill(0.0);
        jacobian.row(0)[0] = -1.0;
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, _: &Robot) -> Result<(), &'static str> {
        Ok(())
    }
}

#[test]
fn an_arm_that_had_to_stand_still_for_long_soon_moves_again() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let q0 = [0.0, -1.2, 1.4, -0.9, 1.0, 0.3];
    let mut stack = Stack::without_position_limits(&robot);
    let set = stack.set("set", Misleading, ..=q0[0]).expect("sound");
    stack
        .equality("joint", JointPosition::of(0), &[1.0], 1.0)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    for _ in 0..500 {
        let step = controller.step(&q0).expect("finite");
        assert!(step.landed.stood_still, "{:?}", step.landed);
    }
    controller
        .setpoints()
        .set_interval(set, ..=2.0)
        .expect("sound");
    let mut q = JointVec::from(q0);
    for _ in 0..31 {
        q = controller.step(&q).expect("finite").q_ref;
    }
    let step = controller.step(&q).expect("finite");
    assert_eq!(step.landed.cautious, None);
    assert!(step.qd[0] > 0.5, "{}", step.qd[0]);
}

#[test]
fn landing_does_not_undo_what_a_lower_level_takes_inward() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let q0 = [0.0, -1.2, 1.4, -0.9, 1.0, 0.3];
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&q0);
    let height = kinematics.world_from(Frame::Tool).origin.z;
    let mut row = [0.0; 6];
    let (motion, tool) = (
        kinematics.motion(Frame::Tool),
        kinematics.world_from(Frame::Tool).origin,
    );
    kinematics.point_row(motion, tool, Vec3::new(0.0, 0.0, 1.0), &mut row);
    // The upper level presses the elbow, on its border, ever so slightly outward.
    let desired = height + 1e-6 * row[2].signum();
    let mut stack = Stack::without_position_limits(&robot);
    let elbow = JointPosition::of(2);
    stack.set("set", elbow, ..=q0[2] + 1e-7).expect("sound");
    stack
        .equality("height", Coordinate::of_tool(Axis::Z), &[desired], 1.0)
        .expect("sound");
    stack
        .equality("elbow", elbow, &[q0[2] - 0.5], 1.0)
        .expect("sound");
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0)).expect("sound");
    let step = controller.step(&q0).expect("finite");
    assert!(!step.active.is_empty(), "the upper level alone would leave");
    assert!((step.qd[2] + 0.5).abs() < 0.05, "{}", step.qd[2]);
}
