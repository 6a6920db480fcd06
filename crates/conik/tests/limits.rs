//! Limits of the joints: positions are sets, speeds shorten the whole velocity, and accelerations take from the last task first.

use conik::{
    Axis, Border, Controller, Coordinate, Distance, Frame, JointLimits, JointVec, Kinematics,
    ModeRule, Position, Recursion, Robot, Settings, Stack,
};
use proptest::prelude::*;

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

/// How fast the first task of `level_hand` takes back what it is off [1/s].
const HEIGHT_GAIN: f64 = 4.0;

/// The height of the tool comes before its way to a goal that is higher or lower.
fn level_hand(stack: Stack, robot: &Robot, start: &[f64], goal: [f64; 3]) -> Stack {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(start);
    let tool = kinematics.world_from(Frame::Tool).origin;
    let mut stack = stack;
    let height = Coordinate::of_tool(Axis::Z);
    stack
        .equality("height", height, &[tool.z], HEIGHT_GAIN)
        .expect("sound");
    stack
        .equality("position", Position::of_tool(), &goal, 2.0)
        .expect("sound");
    stack
}

/// Runs `level_hand`. How far the height was off at most, in units of what a motion
/// along a straight line in joint space bends away in a period, once the gain has taken it in; and in how many
/// ticks accelerations were limited.
fn most_off(controller: &mut Controller, start: &[f64; 6], ticks: u32) -> (f64, u32) {
    let rate_hz = controller.settings().rate_hz;
    let height = controller.stack().find("height").expect("there");
    let mut q = JointVec::from(*start);
    let (mut most, mut fastest, mut limited) = (0.0_f64, 0.0_f64, 0);
    for _ in 0..ticks {
        let step = controller.step(&q).expect("finite");
        assert!(step.landed.outside.is_none());
        assert!(step.acceleration_exceeded.is_none(), "{step:?}");
        limited += u32::from(step.acceleration_limit.is_some());
        most = most.max(step.error_norm(height));
        fastest = fastest.max(step.qd.iter().map(|speed| speed.abs()).sum());
        q = step.q_ref;
    }
    // |∂²z/∂q²| ≤ 1 m/rad², the reach of the arm: z bends by less than (T Σ|q̇|)²/2 in a period.
    let bend = 0.5 * fastest * fastest / (rate_hz * HEIGHT_GAIN);
    (most / bend, limited)
}

#[test]
fn first_equality_task_keeps_its_value_under_limited_accelerations() {
    for limit in [2.0, 4.0, 8.0] {
        for recursion in RECURSIONS {
            let robot = accelerating(limit);
            let goal = [0.320, 0.370, -0.250];
            let mut stack = Stack::new(&robot);
            let post = Distance::of_tool_to([0.4, -0.05, -0.33]);
            stack.set("post", post, 0.15..).expect("sound");
            let stack = level_hand(stack, &robot, &START, goal);
            let mut controller =
                Controller::new(&robot, stack, settings(250.0, recursion)).expect("sound");
            let (off, limited) = most_off(&mut controller, &START, 2000);
            assert!(off <= 1.0, "{limit} {recursion:?}: {off}");
            assert!(limited > 20, "{limit} {recursion:?}: {limited}");
            let position = controller.stack().find("position").expect("there");
            let error = controller.last_step().error(position);
            assert!(
                error[0].hypot(error[1]) < 0.05,
                "{limit} {recursion:?}: {error:?}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]
    #[test]
    fn no_task_below_takes_from_the_first_one_while_accelerations_are_limited(
        start in [-3.0..3.0, -2.5..-0.6, 0.6..2.2, -1.5..1.5, 1.0..2.0, -1.0..1.0_f64],
        goal in [-0.6..0.6, -0.6..0.6, -0.1..0.5_f64],
        limit in 3.0..10.0_f64,
        rate_hz in prop_oneof![Just(125.0), Just(250.0), Just(500.0)],
    ) {
        // Slow enough that holding the height round what bends takes less than the joints can do.
        let robot = limited(JointLimits {
            speed: Some(0.5),
            acceleration: Some(limit),
            position: None,
        });
        let stack = level_hand(Stack::new(&robot), &robot, &start, goal);
        let settings = settings(rate_hz, Recursion::SicilianoSlotine);
        let mut controller = Controller::new(&robot, stack, settings).expect("sound");
        let (off, _) = most_off(&mut controller, &start, 1000);
        prop_assert!(off <= 1.0, "{off}");
    }
}
