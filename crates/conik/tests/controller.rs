//! What a user of the controller may rely on, beyond agreement with the paper.

mod paper;

use conik::{
    Axis, Controller, ControllerError, Coordinate, Distance, FieldOfView, Frame, JointPosition,
    JointVec, ModeOrder, ModeRule, Monitor, Pose, Position, Robot, Settings, Stack,
    StackErrorReason, StepError, Vec3,
};
use paper::Example;

fn ur5() -> Robot {
    Robot::builtin("ur5-paper").expect("built in")
}

fn controller(fill: impl FnOnce(&mut Stack)) -> Controller {
    controller_with(Settings::at_rate(125.0), fill)
}

fn controller_with(settings: Settings, fill: impl FnOnce(&mut Stack)) -> Controller {
    let robot = ur5();
    let mut stack = Stack::new(&robot);
    fill(&mut stack);
    Controller::new(&robot, stack, settings).expect("sound settings")
}

#[test]
fn frozen_task_keeps_its_value() {
    let mut example = Example::new(2, paper::thesis(), Settings::of_the_paper());
    let view = example.controller.stack().find("view").expect("there");
    let mut frozen_ticks = 0;
    for _ in 0..7500 {
        let q = example.q;
        let step = example.tick();
        if step.active.contains(view) {
            frozen_ticks += 1;
            // To first order: what remains after one period is of second order in it.
            let before = step.value(view)[0];
            let after = example
                .controller
                .step(&example.q)
                .expect("finite")
                .value(view)[0];
            assert!(
                (after - before).abs() < 2e-5,
                "moved by {} from {q:?}",
                after - before
            );
        }
    }
    assert!(frozen_ticks > 1000);
}

#[test]
fn scaling_keeps_the_direction_of_the_whole_velocity() {
    let run = |gain: f64| {
        let mut controller = controller(|stack| {
            stack
                .equality("position", Position::of_tool(), &[0.4, 0.3, 0.2], gain)
                .expect("sound");
        });
        controller.step(&paper::thesis()).expect("finite").clone()
    };
    let (slow, fast) = (run(0.1), run(100.0));
    assert!(slow.speed_limit.is_none());
    let limit = fast.speed_limit.expect("100 1/s is far beyond the joints");
    let (_, largest) = fast.qd.largest().expect("six joints");
    assert!((largest - std::f64::consts::PI).abs() < 1e-12);
    assert_eq!(fast.qd.largest().map(|(joint, _)| joint), Some(limit.joint));
    for i in 0..6 {
        assert!((fast.qd[i] - slow.qd[i] * 1000.0 * limit.factor).abs() < 1e-12);
    }
}

#[test]
fn bad_configurations_are_errors_and_the_last_reference_stands() {
    let mut example = Example::new(1, paper::thesis(), Settings::of_the_paper());
    let good = example.tick().q_ref;
    for joint in 0..6 {
        let mut q = example.q;
        q[joint] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][joint % 3];
        assert_eq!(
            example.controller.step(&q),
            Err(StepError::PositionNotFinite { joint })
        );
    }
    let short = example.controller.step(&[0.0; 5]);
    assert!(matches!(
        short,
        Err(StepError::WrongLength {
            expected: 6,
            found: 5
        })
    ));
    assert_eq!(example.controller.last_step().q_ref, good);
}

#[test]
fn a_task_without_a_finite_value_is_an_error_not_an_inactive_set() {
    let mut controller = controller(|stack| {
        stack
            .set("wall", Distance::of_tool_to([1.0, 1.0, 1.0]), 0.1..)
            .expect("sound");
    });
    let wall = controller.stack().find("wall").expect("there");
    controller
        .setpoints()
        .task_mut::<Distance>(wall)
        .expect("a distance")
        .set_point([1e200, 0.0, 0.0]);
    let result = controller.step(&[0.1; 6]);
    assert_eq!(
        result.map(|_| ()),
        Err(StepError::TaskNotFinite { task: wall })
    );
}

#[test]
fn parameters_that_no_longer_fit_the_robot_are_refused_until_they_do() {
    let mut controller = controller(|stack| {
        stack
            .set("wall", Distance::of_tool_to([1.0, 1.0, 1.0]), 0.1..)
            .expect("sound");
    });
    let wall = controller.stack().find("wall").expect("there");
    let good = controller.step(&[0.1; 6]).expect("finite").q_ref;
    let elsewhere = Distance::between(Frame::Link(7), [1.0, 1.0, 1.0]);
    for bad in [Distance::of_tool_to([f64::NAN, 0.0, 0.0]), elsewhere] {
        let mut setpoints = controller.setpoints();
        *setpoints.task_mut(wall).expect("a distance") = bad;
        for _ in 0..2 {
            let error = controller.step(&good).map(|_| ());
            assert!(matches!(error, Err(StepError::TaskUnfit { task, .. }) if task == wall));
        }
        assert_eq!(controller.last_step().q_ref, good);
    }
    let mut setpoints = controller.setpoints();
    *setpoints.task_mut(wall).expect("a distance") = Distance::of_tool_to([1.0, 1.0, 1.0]);
    assert!(controller.step(&good).is_ok());
}

#[test]
fn a_point_moved_between_ticks_counts_where_the_last_tick_landed() {
    let mut controller = controller(|stack| {
        stack
            .set("wall", Distance::of_tool_to([1.0, 1.0, 1.0]), 0.1..)
            .expect("sound");
    });
    let wall = controller.stack().find("wall").expect("there");
    let mut q = controller.step(&[0.1; 6]).expect("finite").q_ref;
    for x in [1.5, 1.0, 2.0] {
        let point = [x, 1.0, 1.0];
        controller
            .setpoints()
            .task_mut::<Distance>(wall)
            .expect("a distance")
            .set_point(point);
        let tool = controller.kinematics_at(&q).world_from(Frame::Tool).origin;
        let expected = (tool - Vec3::from(point)).norm();
        for _ in 0..2 {
            let step = controller.step(&q).expect("finite");
            assert_eq!(step.value(wall), [expected]);
        }
        q = controller.last_step().q_ref;
    }
}

#[test]
fn moving_setpoints_are_followed_without_lag_with_their_rate() {
    // σ_des(t) = 0.3 + 0.1 t on one joint: with the feed-forward the error stays what Euler leaves,
    // and what the default recursion gives up for strict convexity, a millionth of a tick's motion.
    for (settings, lag) in [
        (Settings::of_the_paper(), 1e-12),
        (Settings::at_rate(125.0), 1e-7),
    ] {
        let mut controller = controller_with(settings, |stack| {
            stack
                .equality("joint", JointPosition::of(2), &[0.3], 2.0)
                .expect("sound");
        });
        let joint = controller.stack().find("joint").expect("there");
        let mut q = JointVec::from([0.0, 0.0, 0.3, 0.0, 0.0, 0.0]);
        for tick in 0..500 {
            let desired = 0.3 + 0.1 * f64::from(tick) / 125.0;
            controller
                .setpoints()
                .set_desired_moving(joint, &[desired], &[0.1])
                .expect("finite");
            let step = controller.step(&q).expect("finite");
            assert!(step.error_norm(joint) < lag, "{}", step.error_norm(joint));
            q = step.q_ref;
        }
    }
}

/// Both bounds are exceeded, the tool is asked further out along both, and only one of the two may
/// be active.
fn pushed_out_of_two_exclusive_sets(mode_rule: ModeRule) -> Controller {
    let settings = Settings {
        mode_rule,
        ..Settings::at_rate(125.0)
    };
    controller_with(settings, |stack| {
        let sets = [
            stack
                .set("x", Coordinate::of_tool(Axis::X), ..=-0.9)
                .expect("sound"),
            stack
                .set("y", Coordinate::of_tool(Axis::Y), ..=-0.9)
                .expect("sound"),
        ];
        stack.exclude_together(&sets).expect("sets");
        stack
            .equality("position", Position::of_tool(), &[5.0, 5.0, 0.0], 0.3)
            .expect("sound");
    })
}

#[test]
fn exclusions_that_leave_no_mode_bring_the_arm_to_rest() {
    for mode_rule in [ModeRule::Paper, ModeRule::Border] {
        let mut controller = pushed_out_of_two_exclusive_sets(mode_rule);
        let step = controller.step(&paper::thesis()).expect("finite");
        assert!(step.no_mode);
        assert_eq!(step.qd, JointVec::zeros(6));
    }
}

#[test]
fn rule_cone_keeps_both_of_two_exclusive_sets_in_a_mode_without_a_number() {
    let mut controller = pushed_out_of_two_exclusive_sets(ModeRule::Cone);
    let step = controller.step(&paper::thesis()).expect("finite").clone();
    assert!(!step.no_mode);
    assert_eq!(step.active.len(), 2);
    assert!(step.qd.iter().any(|speed| speed.abs() > 0.1), "it goes on");
    let order = ModeOrder::new(controller.stack());
    assert_eq!(order.number(&step.active), None, "a struck-out mode");
    assert_eq!(order.count(), Some(3));
    let next = controller.step(&step.q_ref).expect("finite");
    for task in step.active.iter() {
        assert!(next.value(task)[0] <= step.value(task)[0] + 2e-7);
    }
}

#[test]
fn modes_are_numbered_as_the_paper_does() {
    let example = Example::new(2, paper::thesis(), Settings::of_the_paper());
    let stack = example.controller.stack();
    let order = ModeOrder::new(stack);
    let number = |names: &[&str]| {
        order.number(
            &names
                .iter()
                .map(|name| stack.find(name).expect("there"))
                .collect(),
        )
    };
    assert_eq!(number(&[]), Some(1));
    assert_eq!(number(&["obstacle_a"]), Some(2));
    assert_eq!(number(&["obstacle_b"]), Some(3));
    assert_eq!(number(&["view"]), Some(4));
    assert_eq!(number(&["obstacle_a", "view"]), Some(5));
    assert_eq!(number(&["obstacle_b", "view"]), Some(6));
    assert_eq!(order.count(), Some(6));
}

#[test]
fn mode_numbers_equal_their_place_in_the_full_list() {
    let mut stack = Stack::new(&ur5());
    let sets: Vec<_> = (0..9)
        .map(|i| {
            stack
                .set(&format!("s{i}"), JointPosition::of(i % 6), 0.0..)
                .expect("sound")
        })
        .collect();
    let groups = [vec![0, 3, 4], vec![4, 7], vec![1, 8]];
    for group in &groups {
        let group: Vec<_> = group.iter().map(|&i: &usize| sets[i]).collect();
        stack.exclude_together(&group).expect("sets");
    }
    let mut modes: Vec<Vec<usize>> = (0_u32..1 << 9)
        .map(|bits| (0..9).filter(|i| bits & 1 << i != 0).collect::<Vec<_>>())
        .filter(|mode| {
            groups
                .iter()
                .all(|g| g.iter().filter(|i| mode.contains(i)).count() < 2)
        })
        .collect();
    modes.sort_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
    let order = ModeOrder::new(&stack);
    assert_eq!(order.count(), Some(modes.len() as u64));
    for (i, mode) in modes.iter().enumerate() {
        let active = mode.iter().map(|&i| sets[i]).collect();
        assert_eq!(order.number(&active), Some(i as u64 + 1), "{mode:?}");
    }
}

#[test]
fn mode_numbers_that_do_not_fit_are_none() {
    let mut stack = Stack::new(&ur5());
    let sets: Vec<_> = (0..200)
        .map(|i| {
            stack
                .set(&format!("s{i}"), JointPosition::of(i % 6), 0.0..)
                .expect("sound")
        })
        .collect();
    let order = ModeOrder::new(&stack);
    assert_eq!(order.count(), None);
    assert_eq!(order.number(&[sets[199]].into_iter().collect()), Some(201));
    assert_eq!(order.number(&sets[..100].iter().copied().collect()), None);
}

#[test]
fn stacks_say_what_they_refuse() {
    let mut stack = Stack::new(&ur5());
    let reason = |result: Result<conik::TaskId, conik::StackError>| result.unwrap_err().reason;
    stack
        .set("view", FieldOfView::of_tool_along([1.0, 0.0, 0.0]), ..=0.2)
        .expect("sound");
    let zero = FieldOfView::of_tool_along([0.0; 3]);
    assert!(matches!(
        reason(stack.set("zero", zero, ..=0.2)),
        StackErrorReason::Unfit(_)
    ));
    let huge = FieldOfView::of_tool_along([1e200; 3]);
    assert!(matches!(
        reason(stack.set("huge", huge, ..=0.2)),
        StackErrorReason::Unfit(_)
    ));
    let joint = JointPosition::of(6);
    assert!(matches!(
        reason(stack.set("joint", joint, 0.0..)),
        StackErrorReason::Unfit(_)
    ));
    let first = JointPosition::of(0);
    assert_eq!(
        reason(stack.set("view", first, 0.0..)),
        StackErrorReason::NameTaken
    );
    assert!(matches!(
        reason(stack.set("a", first, 1.0..=0.0)),
        StackErrorReason::BadInterval(_)
    ));
    let position = Position::of_tool();
    assert_eq!(
        reason(stack.set("a", position, 0.0..)),
        StackErrorReason::NotScalar(3)
    );
    assert_eq!(
        reason(stack.equality("a", first, &[0.0], 0.0)),
        StackErrorReason::BadGain(0.0)
    );
    let short = StackErrorReason::WrongDimension {
        expected: 3,
        found: 1,
    };
    assert_eq!(reason(stack.equality("a", position, &[0.0], 1.0)), short);
    let nan = reason(stack.equality("a", first, &[f64::NAN], 1.0));
    assert_eq!(nan, StackErrorReason::NotFinite);
    stack.equality("first", first, &[0.0], 1.0).expect("sound");
    assert_eq!(
        reason(stack.set("low", first, 0.0..)),
        StackErrorReason::MissingGain
    );
    stack
        .set_with_gain("low", first, 0.0.., 1.0)
        .expect("sound");
}

#[test]
fn controllers_refuse_rates_and_stacks_that_do_not_fit() {
    let robot = ur5();
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Controller::new(&robot, Stack::new(&robot), Settings::at_rate(rate));
        assert!(matches!(error, Err(ControllerError::BadRate(_))));
    }
    let two = Robot::from_dh("two", &[conik::DhRow::new(0.1, 0.0, 0.0); 2]).expect("sound");
    let error = Controller::new(&robot, Stack::new(&two), Settings::at_rate(125.0));
    assert!(matches!(
        error,
        Err(ControllerError::OtherRobot { stack: 2, robot: 6 })
    ));
    let camera = robot
        .clone()
        .with_frame("camera", Frame::Tool, Pose::IDENTITY);
    let camera = camera.expect("a new name");
    let mut stack = Stack::new(&camera);
    let frame = camera.frame("camera").expect("just added");
    let wall = stack.set("wall", Distance::between(frame, [1.0; 3]), 0.1..);
    let wall = wall.expect("sound");
    let error = Controller::new(&robot, stack, Settings::at_rate(125.0));
    assert!(matches!(error, Err(ControllerError::TaskUnfit { task, .. }) if task == wall));
}

/// From this start the paper's rule freezes an obstacle that is
/// 20 cm away, strictly inside its set, and waits for ever; the border rule does not.
#[test]
fn border_rule_has_no_deadlock_where_the_paper_rule_has_one() {
    let start = [1.7809, 0.4115, 0.4475, 0.2984, -0.2144, 0.0];
    let run = |mode_rule: ModeRule| {
        let settings = Settings {
            mode_rule,
            ..Settings::of_the_paper()
        };
        let mut example = Example::new(2, start, settings);
        for _ in 0..7500 {
            example.tick();
        }
        let step = example.tick().clone();
        (step.error_norm(example.position), step)
    };
    let (stuck, step) = run(ModeRule::Paper);
    assert!((0.40..0.48).contains(&stuck), "{stuck}");
    let frozen = step.active.iter().next().expect("a set is frozen");
    assert_eq!(frozen.index(), 0, "obstacle_a");
    assert!(step.value(frozen)[0] > 0.19, "strictly inside its set");
    let (error, _) = run(ModeRule::Border);
    assert!(error < 0.05, "{error}");
}

#[test]
fn monitors_report_the_dips_that_freezing_between_samples_leaves() {
    let mut example = Example::new(2, paper::thesis(), Settings::of_the_paper());
    let mut monitor = Monitor::new(example.controller.stack());
    for tick in 0..=7500 {
        let step = example.tick().clone();
        monitor.observe(example.controller.stack(), &step, f64::from(tick) / 125.0);
    }
    let stack = example.controller.stack();
    let properties = monitor.properties(stack);
    // 0.18 − 0.1793252 and 0.2643212 − 0.2622, as the independent trajectories have them.
    assert!((properties.inside_stays.worst - 6.747_841_8e-4).abs() < 1e-9);
    assert_eq!(properties.inside_stays.task, stack.find("obstacle_a"));
    assert!((properties.entered_stays.worst - 2.121_197_1e-3).abs() < 1e-9);
    assert_eq!(properties.entered_stays.task, stack.find("view"));
    assert!(properties.outside_never_worse.holds());
    let view = monitor.history(stack.find("view").expect("there"));
    assert_eq!(view.entered_s, Some(4.456));
    assert!(
        properties.low_priority_excess.holds(),
        "there is no low-priority set"
    );
}
