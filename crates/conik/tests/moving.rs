//! Points, directions, desired values and bounds that move between ticks.

use conik::{
    Axis, Border, BoundRates, Controller, Coordinate, Distance, FieldOfView, JointPosition,
    JointVec, ModeRule, Position, Recursion, Robot, Settings, Stack, TaskId, Vec3,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

const RECURSIONS: [Recursion; 2] = [Recursion::Chiaverini, Recursion::SicilianoSlotine];

fn settings(rate_hz: f64, recursion: Recursion) -> Settings {
    Settings {
        mode_rule: ModeRule::Cone,
        border: Border::Land,
        recursion,
        ..Settings::at_rate(rate_hz)
    }
}

fn controller(settings: Settings, fill: impl FnOnce(&mut Stack)) -> Controller {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    fill(&mut stack);
    Controller::new(&robot, stack, settings).expect("sound settings")
}

fn find(controller: &Controller, name: &str) -> TaskId {
    controller.stack().find(name).expect("there")
}

fn tool(controller: &mut Controller, q: &[f64]) -> Vec3 {
    controller
        .kinematics_at(q)
        .world_from(conik::Frame::Tool)
        .origin
}

/// What a scene with an obstacle that moves came to.
#[derive(Debug, Default)]
struct Passage {
    /// Samples outside, and the furthest of them [m].
    outside: usize,
    worst: f64,
    /// Samples outside that the tick before had not announced, or by another amount.
    unannounced: usize,
    closest: f64,
    fastest: f64,
}

/// A tool that wants to stay where it is, and an obstacle of 0.15 m that moves straight through it.
fn pass(rate_hz: f64, recursion: Recursion, q0: &JointVec, direction: Vec3, speed: f64) -> Passage {
    const RADIUS: f64 = 0.15;
    const AHEAD: f64 = 0.35;
    let mut controller = controller(settings(rate_hz, recursion), |_| {});
    let here = tool(&mut controller, q0);
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let start = here - direction * AHEAD;
    stack
        .set("obstacle", Distance::of_tool_to(start), RADIUS..)
        .expect("sound");
    stack
        .equality("position", Position::of_tool(), &here.to_array(), 1.0)
        .expect("sound");
    let mut controller =
        Controller::new(&robot, stack, settings(rate_hz, recursion)).expect("sound");
    let obstacle = find(&controller, "obstacle");
    let mut q = *q0;
    let mut passage = Passage {
        closest: f64::INFINITY,
        ..Passage::default()
    };
    let mut announced: Option<f64> = None;
    for tick in 0_u32.. {
        let travelled = speed * f64::from(tick) / rate_hz;
        if travelled > 2.0 * AHEAD {
            break;
        }
        let point = start + direction * travelled;
        controller
            .setpoints()
            .task_mut::<Distance>(obstacle)
            .expect("a distance")
            .set_point_moving(point, direction * speed);
        let step = controller.step(&q).expect("finite");
        let sigma = step.value(obstacle)[0];
        passage.closest = passage.closest.min(sigma);
        let by = RADIUS - sigma;
        if by > 1e-12 {
            passage.outside += 1;
            passage.worst = passage.worst.max(by);
            let is_announced = announced.is_some_and(|said| (said - by).abs() < 1e-9);
            passage.unannounced += usize::from(!is_announced);
        }
        announced = step.landed.outside.map(|outside| outside.by);
        let (_, fastest) = step.qd.largest().expect("joints");
        passage.fastest = passage.fastest.max(fastest);
        assert!(step.pivots <= conik::MAX_PIVOTS && step.landed.kinematics <= 10);
        q = step.q_ref;
    }
    passage
}

fn scenes(cases: u32) -> TestRunner {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    TestRunner::new_with_rng(
        Config {
            cases,
            failure_persistence: None,
            ..Config::default()
        },
        rng,
    )
}

/// Elbow and wrist bent, so that the tool can move at 0.2 m/s in every direction.
fn dexterous() -> impl Strategy<Value = JointVec> {
    let ranges = (
        -3.0..3.0,
        -2.2..-0.9,
        -2.0..-1.0,
        -3.0..3.0,
        0.7..2.4,
        -3.0..3.0,
    );
    ranges.prop_map(|(a, b, c, d, e, f)| JointVec::from([a, b, c, d, e, f]))
}

fn direction() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64)
        .prop_map(|(x, y, z)| Vec3::new(x, y, z))
        .prop_filter("no direction", |v| v.norm() > 0.1)
        .prop_map(Vec3::normalized)
}

#[test]
fn an_obstacle_that_moves_through_the_tool_is_avoided() {
    let rates = prop::sample::select(vec![50.0, 125.0, 500.0, 1000.0]);
    let recursions = prop::sample::select(RECURSIONS.to_vec());
    scenes(40)
        .run(
            &(rates, recursions, dexterous(), direction()),
            |(rate_hz, recursion, q0, direction)| {
                let passage = pass(rate_hz, recursion, &q0, direction, 0.2);
                prop_assert!(passage.outside == 0, "{passage:?}");
                prop_assert!(passage.closest < 0.1501, "it never came near: {passage:?}");
                Ok(())
            },
        )
        .unwrap();
}

#[test]
fn what_cannot_be_avoided_is_announced_in_the_tick_before() {
    // 5 m/s is more than the arm has.
    let recursions = prop::sample::select(RECURSIONS.to_vec());
    let outside = std::cell::Cell::new(0);
    scenes(20)
        .run(
            &(recursions, dexterous(), direction()),
            |(recursion, q0, direction)| {
                let passage = pass(500.0, recursion, &q0, direction, 5.0);
                prop_assert_eq!(passage.unannounced, 0, "{:?}", passage);
                prop_assert!(
                    passage.fastest <= std::f64::consts::PI + 1e-9,
                    "{passage:?}"
                );
                outside.set(outside.get() + passage.outside);
                Ok(())
            },
        )
        .unwrap();
    assert!(outside.get() > 0, "the scenes are too easy to tell");
}

#[test]
fn a_moving_bound_takes_the_task_with_it() {
    for recursion in RECURSIONS {
        for rule in [ModeRule::Paper, ModeRule::Border, ModeRule::Cone] {
            let mut settings = settings(125.0, recursion);
            settings.mode_rule = rule;
            let mut controller = controller(settings, |stack| {
                stack
                    .set("height", Coordinate::of_tool(Axis::Z), -2.0..)
                    .expect("sound");
                stack
                    .equality("joint", JointPosition::of(0), &[0.0], 1.0)
                    .expect("sound");
            });
            let height = find(&controller, "height");
            let mut q = JointVec::from([0.3, -1.6, -1.6, -1.5, 1.5, 0.2]);
            let start = tool(&mut controller, &q).z - 0.02;
            for tick in 0..400 {
                let min = start + 0.1 * f64::from(tick) / 125.0;
                let rates = BoundRates { min: 0.1, max: 0.0 };
                controller
                    .setpoints()
                    .set_interval_moving(height, min.., rates)
                    .expect("sound");
                let step = controller.step(&q).expect("finite");
                let inside = step.value(height)[0] - min;
                assert!(inside >= -1e-12, "{rule:?} {recursion:?} {tick}: {inside}");
                assert!(step.landed.outside.is_none());
                if tick > 100 {
                    assert!(inside < 1e-5, "{rule:?} {recursion:?} {tick}: {inside}");
                }
                q = step.q_ref;
            }
        }
    }
}

#[test]
fn a_turning_view_is_followed_to_first_order_and_kept_exactly() {
    for recursion in RECURSIONS {
        let mut controller = controller(settings(125.0, recursion), |stack| {
            stack
                .set("view", FieldOfView::of_tool_along([1.0, 0.0, 0.0]), ..=0.2)
                .expect("sound");
            stack
                .equality("joint", JointPosition::of(0), &[0.0], 1.0)
                .expect("sound");
        });
        let view = find(&controller, "view");
        let mut q = JointVec::from([0.3, -1.6, -1.6, -1.5, 1.5, 0.2]);
        let axis = controller
            .kinematics_at(&q)
            .world_from(conik::Frame::Tool)
            .z_axis;
        let turn = Vec3::new(0.1, -0.2, 0.15);
        for tick in 0..600 {
            let direction = axis.turned_by(turn * (f64::from(tick) / 125.0));
            controller
                .setpoints()
                .task_mut::<FieldOfView>(view)
                .expect("a view")
                .set_direction_turning(direction, turn);
            let step = controller.step(&q).expect("finite");
            assert!(step.value(view)[0] <= 0.2 + 1e-12, "tick {tick}");
            assert!(step.landed.outside.is_none());
            q = step.q_ref;
        }
        assert!(controller.last_step().value(view)[0] > 0.19);
    }
}

#[test]
fn a_task_about_a_moving_point_is_met_without_lag() {
    // The distance itself is to stay 0.3 m while the point moves away: without the feed-forward the
    // error would be speed / gain = 0.1 m.
    for recursion in RECURSIONS {
        let mut controller = controller(settings(500.0, recursion), |stack| {
            stack
                .equality("leash", Distance::of_tool_to([0.0, 0.0, 2.0]), &[0.3], 1.0)
                .expect("sound");
        });
        let leash = find(&controller, "leash");
        let mut q = JointVec::from([0.3, -1.6, -1.6, -1.5, 1.5, 0.2]);
        let start = tool(&mut controller, &q) + Vec3::new(0.0, 0.3, 0.0);
        let velocity = Vec3::new(0.02, 0.08, -0.06);
        for tick in 0..1000 {
            let point = start + velocity * (f64::from(tick) / 500.0);
            controller
                .setpoints()
                .task_mut::<Distance>(leash)
                .expect("a distance")
                .set_point_moving(point, velocity);
            let step = controller.step(&q).expect("finite");
            assert!(step.error_norm(leash) < 1e-4, "tick {tick}");
            q = step.q_ref;
        }
    }
}

#[test]
fn a_set_that_starts_outside_recovers_at_the_chosen_speed() {
    for recursion in RECURSIONS {
        for (rule, border) in [
            (ModeRule::Cone, Border::Land),
            (ModeRule::Cone, Border::Freeze),
        ] {
            let settings = Settings {
                mode_rule: rule,
                border,
                recursion,
                ..Settings::at_rate(125.0)
            };
            let mut controller = controller(settings, |stack| {
                stack
                    .set("height", Coordinate::of_tool(Axis::Z), 0.0..)
                    .expect("sound");
                stack
                    .equality("joint", JointPosition::of(0), &[0.0], 1.0)
                    .expect("sound");
            });
            let height = find(&controller, "height");
            let mut q = JointVec::from([0.3, -1.6, -1.6, -1.5, 1.5, 0.2]);
            let min = tool(&mut controller, &q).z + 0.1;
            let mut setpoints = controller.setpoints();
            setpoints.set_interval(height, min..).expect("sound");
            let mut now = setpoints;
            now.set_recovery(height, Some(0.05)).expect("sound");
            let mut values = Vec::new();
            for _ in 0..500 {
                let step = controller.step(&q).expect("finite");
                values.push(step.value(height)[0] - min);
                q = step.q_ref;
            }
            // Two seconds for 0.1 m at 0.05 m/s.
            assert!(
                values[125] > -0.0505 && values[125] < -0.0495,
                "{}",
                values[125]
            );
            assert!(
                values[240] < 0.0 && values[255] >= -1e-6,
                "{rule:?} {border:?}"
            );
            assert!(values[255..].iter().all(|v| *v >= -1e-6));
        }
    }
}

#[test]
fn a_bound_that_jumps_past_the_task_is_reached_as_fast_as_the_joints_allow() {
    let mut controller = controller(settings(125.0, Recursion::SicilianoSlotine), |stack| {
        stack
            .set("wall", Coordinate::of_tool(Axis::Z), -2.0..)
            .expect("sound");
        stack
            .equality("joint", JointPosition::of(0), &[0.3], 1.0)
            .expect("sound");
    });
    let wall = find(&controller, "wall");
    let mut q = JointVec::from([0.3, -1.6, -1.6, -1.5, 1.5, 0.2]);
    let before = controller.step(&q).expect("finite");
    assert!(before.landed.outside.is_none());
    q = before.q_ref;
    let min = before.value(wall)[0] + 0.05;
    controller
        .setpoints()
        .set_interval(wall, min..)
        .expect("sound");
    let mut said: Option<f64> = None;
    let mut announced = 0;
    for tick in 0..50 {
        let step = controller.step(&q).expect("finite");
        let outside = (min - step.value(wall)[0]).max(0.0);
        if tick > 0 {
            assert!((said.unwrap_or(0.0) - outside).abs() < 1e-9, "tick {tick}");
        }
        if step.landed.outside.is_some() {
            let (_, speed) = step.qd.largest().expect("joints");
            assert!(
                (speed - std::f64::consts::PI).abs() < 1e-9,
                "tick {tick}: {speed}"
            );
        }
        said = step.landed.outside.map(|outside| outside.by);
        announced += u32::from(said.is_some());
        q = step.q_ref;
    }
    assert!(said.is_none() && announced > 0);
}

/// A view that turns away from one that stays, both entered before. No arm can keep both, and the
/// velocity of the least violation leaps from one end of the joints' ranges to the other.
#[test]
fn sets_that_pull_against_each_other_do_not_make_the_arm_bounce() {
    let mut random = 0x9e37_79b9_u32;
    let mut uniform = |from: f64, to: f64| {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        from + (to - from) * f64::from(random) / f64::from(u32::MAX)
    };
    let mut contradictions = 0;
    for scene in 0..24 {
        let rate = [50_u32, 125, 500, 1000][scene % 4];
        let rate_hz = f64::from(rate);
        let recursion = RECURSIONS[scene / 12];
        let q0: [f64; 6] = std::array::from_fn(|_| uniform(-3.0, 3.0));
        let turn = Vec3::from(std::array::from_fn(|_| uniform(-0.3, 0.3)));
        let mut q = JointVec::from(q0);
        let mut controller = controller(settings(rate_hz, recursion), |_| {});
        let pose = *controller.kinematics_at(&q).world_from(conik::Frame::Tool);
        let goal = pose.origin + Vec3::from(std::array::from_fn(|_| uniform(-0.3, 0.3)));
        let mut controller = self::controller(settings(rate_hz, recursion), |stack| {
            for name in ["stays", "turns"] {
                stack
                    .set(name, FieldOfView::of_tool_along(pose.z_axis), ..=0.2)
                    .expect("sound");
            }
            stack
                .equality("position", Position::of_tool(), &goal.to_array(), 1.0)
                .expect("sound");
        });
        let turns = find(&controller, "turns");
        let (mut before, mut reversals) = (JointVec::zeros(6), 0);
        let mut announced = 0;
        for tick in 0..6 * rate {
            let direction = pose.z_axis.turned_by(turn * (f64::from(tick) / rate_hz));
            controller
                .setpoints()
                .task_mut::<FieldOfView>(turns)
                .expect("a view")
                .set_direction_turning(direction, turn);
            let step = controller.step(&q).expect("finite");
            let turned_back =
                |(a, b): &(&f64, &f64)| **a * **b < 0.0 && a.abs().min(b.abs()) > 0.05;
            reversals += step
                .qd
                .iter()
                .zip(before.iter())
                .filter(turned_back)
                .count();
            announced += usize::from(step.landed.outside.is_some());
            assert!(step.landed.kinematics <= 10, "{:?}", step.landed);
            (before, q) = (step.qd, step.q_ref);
        }
        contradictions += usize::from(announced > 0);
        assert!(reversals <= 20, "scene {scene}: {reversals} reversals");
    }
    assert!(contradictions > 12, "{contradictions}");
}
