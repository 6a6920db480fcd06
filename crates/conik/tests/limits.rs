//! Limits of the joints: positions are sets, speeds and accelerations shorten the whole velocity.

use conik::{
    Axis, Border, Controller, Coordinate, Distance, JointLimits, JointVec, ModeRule, Position,
    Recursion, Robot, Settings, Stack,
};

const RECURSIONS: [Recursion; 2] = [Recursion::Chiaverini, Recursion::SicilianoSlotine];
const START: [f64; 6] = [-0.84, -2.76, -1.88, -1.57, -1.48, 0.0];

/// The UR5 with these limits at every joint.
fn limited(limits: JointLimits) -> Robot {
    let ur5 = Robot::builtin("ur5-paper").expect("built in");
    ur5.with_limits(|_, _| limits).expect("sound")
}

fn accelerating(limit: f64) -> Robot {
    limited(JointLimits {
        speed: Some(1.0),
        acceleration: Some(limit),
        position: None,
    })
}

fn settings(rate_hz: f64, recursion: Recursion) -> Settings {
    Settings {
        mode_rule: ModeRule::Cone,
        border: Border::Land,
        recursion,
        ..Settings::at_rate(rate_hz)
    }
}

/// Two obstacles, and a goal on the other side of them.
fn scene(robot: &Robot, settings: Settings) -> Controller {
    let mut stack = Stack::new(robot);
    for (name, point, min) in [
        ("obstacle_a", [0.40, -0.25, -0.33], 0.18),
        ("obstacle_b", [0.40, 0.15, -0.33], 0.15),
    ] {
        stack
            .set(name, Distance::of_tool_to(point), min..)
            .expect("sound");
    }
    stack
        .equality(
            "position",
            Position::of_tool(),
            &[0.320, 0.370, -0.250],
            2.0,
        )
        .expect("sound");
    Controller::new(robot, stack, settings).expect("sound")
}

#[test]
fn accelerations_are_limited_and_every_set_is_kept() {
    for rate_hz in [50_u32, 125, 500] {
        for recursion in RECURSIONS {
            let robot = accelerating(4.0);
            let mut controller = scene(&robot, settings(f64::from(rate_hz), recursion));
            let position = controller.stack().find("position").expect("there");
            let mut q = JointVec::from(START);
            let mut limited_ticks = 0;
            let mut was_held = [false; 2];
            for _ in 0..20 * rate_hz {
                let step = controller.step(&q).expect("finite").clone();
                for (i, (name, min)) in [("obstacle_a", 0.18), ("obstacle_b", 0.15)]
                    .into_iter()
                    .enumerate()
                {
                    let id = controller.stack().find(name).expect("there");
                    assert!(step.value(id)[0] >= min, "{name} {rate_hz} {recursion:?}");
                    was_held[i] |= step.active.contains(id);
                }
                let (_, speed) = step.qd.largest().expect("joints");
                assert!(speed <= 1.0 + 1e-12);
                let (_, acceleration) = step.qdd.largest().expect("joints");
                assert!(acceleration <= 4.0 * (1.0 + 1e-9), "{acceleration}");
                assert!(step.acceleration_exceeded.is_none());
                limited_ticks += u32::from(step.acceleration_limit.is_some());
                q = step.q_ref;
            }
            assert!(limited_ticks > 0 && was_held != [false; 2]);
            assert!(controller.last_step().error_norm(position) < 0.02);
        }
    }
}

#[test]
fn a_set_comes_before_an_acceleration_limit() {
    // Moving at full speed towards a wall that appears just in front of it: no braking way is left.
    for recursion in RECURSIONS {
        let robot = accelerating(1.0);
        let mut stack = Stack::new(&robot);
        stack
            .set("wall", Coordinate::of_tool(Axis::Y), ..=5.0)
            .expect("sound");
        stack
            .equality("position", Position::of_tool(), &[0.3, 0.5, 0.1], 2.0)
            .expect("sound");
        let mut controller =
            Controller::new(&robot, stack, settings(125.0, recursion)).expect("sound");
        let wall = controller.stack().find("wall").expect("there");
        let mut q = JointVec::from(START);
        for _ in 0..125 {
            q = controller.step(&q).expect("finite").q_ref;
        }
        let y = controller
            .kinematics_at(&q)
            .world_from(conik::Frame::Tool)
            .origin
            .y;
        let max = y + 1e-4;
        controller
            .setpoints()
            .set_interval(wall, ..=max)
            .expect("sound");
        let mut exceeded = 0;
        for _ in 0..500 {
            let step = controller.step(&q).expect("finite");
            assert!(step.value(wall)[0] <= max);
            assert!(step.landed.outside.is_none());
            if let Some(joint) = step.acceleration_exceeded {
                println!(
                    "{recursion:?} {joint:?} {:?} {:?}",
                    step.landed, step.acceleration_limit
                );
                exceeded += 1;
            }
            q = step.q_ref;
        }
        assert!((1..10).contains(&exceeded), "{recursion:?}: {exceeded}");
    }
}

#[test]
fn position_limits_are_high_priority_sets_by_default() {
    let robot = limited(JointLimits {
        position: Some((-3.0, 0.2)),
        speed: Some(3.0),
        acceleration: None,
    });
    for recursion in RECURSIONS {
        let mut controller = scene(&robot, settings(125.0, recursion));
        assert_eq!(controller.stack().len(), 6 + 3);
        let limits: Vec<_> = robot
            .joint_names()
            .map(|name| {
                let id = controller.stack().find(&format!("limit/{name}"));
                id.expect("a set for each joint")
            })
            .collect();
        assert!(
            limits
                .iter()
                .all(|&id| controller.stack().is_high_priority(id))
        );
        let mut q = JointVec::from(START);
        let mut held = 0;
        for _ in 0..2000 {
            let step = controller.step(&q).expect("finite");
            held += usize::from(limits.iter().any(|&id| step.active.contains(id)));
            q = step.q_ref;
            assert!(q.iter().all(|q| (-3.0..=0.2).contains(q)), "{q:?}");
        }
        assert!(held > 100, "the first joint has to turn by more: {held}");
    }
    let stack = Stack::without_position_limits(&robot);
    assert!(stack.is_empty());
}
