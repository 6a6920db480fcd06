//! What a tick says about itself.

mod paper;

use conik::{
    ActiveSet, Border, Controller, Distance, FieldOfView, ModeRule, Position, Reason, Recursion,
    Robot, Settings, Stack,
};
use paper::Example;

fn by_default(recursion: Recursion) -> Settings {
    Settings {
        mode_rule: ModeRule::Cone,
        border: Border::Land,
        recursion,
        ..Settings::at_rate(125.0)
    }
}

/// Example 1 or 2 without one of its sets, at rest, on the way to a waypoint.
fn without(name: &str, number: u8, target: &[f64], settings: Settings) -> Controller {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut stack = Stack::new(&robot);
    let obstacles = [
        ("obstacle_a", [0.40, -0.25, -0.33], 0.18),
        ("obstacle_b", [0.40, 0.15, -0.33], 0.15),
    ];
    for (obstacle, point, min) in obstacles {
        if obstacle != name {
            stack
                .set(obstacle, Distance::of_tool_to(point), min..)
                .expect("sound");
        }
    }
    if number == 2 && name != "view" {
        stack
            .set(
                "view",
                FieldOfView::of_tool_along([1.0, 0.0, 0.0]),
                ..=0.2622,
            )
            .expect("sound");
    }
    stack
        .equality("position", Position::of_tool(), target, 0.3)
        .expect("sound");
    Controller::new(&robot, stack, settings).expect("sound")
}

#[test]
fn a_set_that_is_held_would_go_as_far_out_as_its_reason_says() {
    for (recursion, tolerance) in [
        (Recursion::Chiaverini, 1e-3),
        (Recursion::SicilianoSlotine, 0.05),
    ] {
        let settings = by_default(recursion);
        let mut example = Example::new(1, paper::thesis(), settings);
        let mut compared = 0;
        for _ in 0..3000 {
            let q = example.q;
            let step = example.tick();
            let reasons: Vec<_> = step.reasons().to_vec();
            let stack = example.controller.stack();
            let holds = reasons.iter().find_map(|reason| match *reason {
                Reason::Holds { task, crossing, .. } => Some((task, crossing)),
                _ => None,
            });
            let Some((task, crossing)) = holds.filter(|(_, crossing)| *crossing > 1e-6) else {
                continue;
            };
            let name = stack[task].name().to_owned();
            let conik::Goal::Equality { desired, .. } =
                stack[stack.find("position").expect("there")].goal()
            else {
                panic!("an equality task")
            };
            let mut free = without(&name, 1, desired, settings);
            let q_free = free.step(&q).expect("finite").q_ref;
            let mut after = without("", 1, desired, settings);
            let id = after.stack().find(&name).expect("there");
            let least = after.stack()[id].interval().expect("a set").min;
            let out = least - after.step(&q_free).expect("finite").value(id)[0];
            // To first order; the way bends by less than a hundredth of it.
            assert!(
                (out - crossing).abs() < tolerance * crossing + 1e-5,
                "{recursion:?} {name}: said {crossing}, went {out}"
            );
            compared += 1;
        }
        assert!(compared > 100, "{compared}");
    }
}

#[test]
fn every_active_set_has_a_reason_and_every_one_let_go_too() {
    let all = [
        (ModeRule::Paper, Border::Freeze),
        (ModeRule::Border, Border::Land),
        (ModeRule::Cone, Border::Land),
    ];
    for (mode_rule, border) in all {
        for number in 1..=3 {
            let settings = Settings {
                mode_rule,
                border,
                ..by_default(Recursion::Chiaverini)
            };
            let mut example = Example::new(number, paper::thesis(), settings);
            let mut before = ActiveSet::EMPTY;
            let mut let_go = 0;
            for _ in 0..7500 {
                let step = example.tick();
                let held: ActiveSet = step
                    .reasons()
                    .iter()
                    .filter(|r| matches!(r, Reason::Holds { .. } | Reason::HoldsInside { .. }))
                    .filter_map(Reason::task)
                    .collect();
                assert_eq!(held, step.active);
                let freed: ActiveSet = step
                    .reasons()
                    .iter()
                    .filter(|r| matches!(r, Reason::LetsGo { .. }))
                    .filter_map(Reason::task)
                    .collect();
                assert!(!freed.intersects(&step.active));
                for task in before.iter() {
                    assert_ne!(freed.contains(task), step.active.contains(task));
                }
                let_go += freed.len();
                before = step.active;
            }
            assert!(let_go > 0, "{mode_rule:?} {number}");
        }
    }
}

#[test]
fn a_set_frozen_inside_is_told_from_one_on_its_border() {
    let start = [1.7809, 0.4115, 0.4475, 0.2984, -0.2144, 0.0];
    let mut example = Example::new(2, start, Settings::of_the_paper());
    for _ in 0..7500 {
        example.tick();
    }
    let step = example.controller.last_step();
    let obstacle = example
        .controller
        .stack()
        .find("obstacle_a")
        .expect("there");
    let inside = step.reasons().iter().find_map(|reason| match *reason {
        Reason::HoldsInside { task, inside } if task == obstacle => Some(inside),
        _ => None,
    });
    let inside = inside.expect("the paper's rule deadlocks here");
    assert!((inside - (step.value(obstacle)[0] - 0.18)).abs() < 1e-12 && inside > 0.01);
}

/// In a narrow tube the arm has to stand still at times: what then slows it down is said.
#[test]
fn a_velocity_is_never_shortened_without_a_reason() {
    let (mut still, mut cautious) = (0, 0);
    for seed in 0..40_u32 {
        let turn = f64::from(seed) * 0.37;
        let q0 = [turn, -1.2 + 0.3 * turn.sin(), 1.1, 0.4 * turn, 1.2, 0.1];
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut kinematics = conik::Kinematics::new(&robot);
        kinematics.update(&q0);
        let here = kinematics.world_from(conik::Frame::Tool).origin;
        let mut stack = Stack::new(&robot);
        // A tube much narrower than what the arm bends in a period of 1 s.
        for (name, axis, value) in [
            ("across", conik::Axis::Y, here.y),
            ("up", conik::Axis::Z, here.z),
        ] {
            stack
                .set(
                    name,
                    conik::Coordinate::of_tool(axis),
                    value - 1e-6..=value + 1e-6,
                )
                .expect("sound");
        }
        let target = [here.x + 0.3, here.y, here.z];
        stack
            .equality("position", Position::of_tool(), &target, 1.0)
            .expect("sound");
        let settings = Settings {
            rate_hz: 1.0,
            ..by_default(Recursion::SicilianoSlotine)
        };
        let mut controller = Controller::new(&robot, stack, settings).expect("sound");
        let mut q = conik::JointVec::from(q0);
        for _ in 0..20 {
            let step = controller.step(&q).expect("finite");
            if let Some(share) = step.landed.cautious {
                assert!(share < 1.0 && step.reasons().contains(&Reason::Cautious(share)));
                cautious += 1;
            }
            still += u32::from(step.reasons().contains(&Reason::StandsStill));
            q = step.q_ref;
        }
    }
    assert!(still > 0 && cautious > 0, "{still} {cautious}");
}

#[test]
fn reasons_read_well() {
    let mut example = Example::new(2, paper::thesis(), by_default(Recursion::SicilianoSlotine));
    let mut told = std::collections::BTreeMap::new();
    for _ in 0..7500 {
        let step = example.tick().clone();
        let stack = example.controller.stack();
        for reason in step.reasons() {
            let code = reason.code(stack).to_string();
            told.entry(code)
                .or_insert(reason.in_words(stack).to_string());
        }
    }
    assert!(told["hold:obstacle_b"].starts_with("`obstacle_b` is held at its least value"));
    assert!(told["hold:view"].contains("greatest"));
    assert!(told["free:obstacle_b"].starts_with("`obstacle_b` is let go"));
    assert!(told.contains_key("corrected"));
}
