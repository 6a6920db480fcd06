//! Conflicts and singularities: whatever the rule, border and recursion, a run has only finite numbers within
//! the speed limits, never bounces between them, and ends at rest.

use std::f64::consts::PI;

use conik::{
    Axis, Border, Controller, Coordinate, Distance, FieldOfView, Frame, JointPosition, JointVec,
    Kinematics, MAX_PIVOTS, ModeRule, Position, Recursion, Robot, Settings, Stack, StackError,
};

/// Everything that can be chosen.
fn all_settings(rate_hz: f64) -> Vec<Settings> {
    let mut all = Vec::new();
    for mode_rule in [ModeRule::Paper, ModeRule::Border, ModeRule::Cone] {
        for border in [Border::Freeze, Border::Land] {
            for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
                all.push(Settings {
                    mode_rule,
                    border,
                    recursion,
                    ..Settings::at_rate(rate_hz)
                });
            }
        }
    }
    all
}

/// Fills a stack, knowing where the tool is and along which axis it points.
type Fill = fn(&mut Stack, [f64; 3], [f64; 3]) -> Result<(), StackError>;

/// A start, and a stack that is in conflict there or on the way.
struct Case {
    name: &'static str,
    q0: [f64; 6],
    is_out_of_reach: bool,
    fill: Fill,
}

const BENT: [f64; 6] = [0.3, -1.2, 1.4, -0.7, -1.3, 0.2];
const STRETCHED: [f64; 6] = [0.4, -0.6, 0.0, 0.0, 0.5, 0.0];
const WRIST_IN_LINE: [f64; 6] = [0.3, -1.2, 1.4, -0.7, 0.0, 0.2];

const CASES: [Case; 10] = [
    Case {
        name: "two obstacles in one place, and a wall that touches them",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, _| {
            let [x, y, z] = tool;
            stack.set("a", Distance::of_tool_to([x + 0.1, y, z]), 0.1..)?;
            stack.set("b", Distance::of_tool_to([x + 0.1, y, z]), 0.1..)?;
            stack.set("c", Coordinate::of_tool(Axis::X), ..=x)?;
            position(stack, [x + 0.3, y + 0.05, z])
        },
    },
    Case {
        name: "twelve sets at their border on six joints",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, _| {
            for (i, q) in BENT.iter().enumerate() {
                let joint = JointPosition::of(i);
                stack.set(&format!("joint {i}"), joint, *q..=q + 0.5)?;
            }
            for (i, axis) in [Axis::X, Axis::Y, Axis::Z].into_iter().enumerate() {
                let coordinate = Coordinate::of_tool(axis);
                stack.set(&format!("wall {i}"), coordinate, tool[i]..)?;
                let mut point = tool;
                point[i] += 0.2;
                stack.set(&format!("point {i}"), Distance::of_tool_to(point), 0.2..)?;
            }
            position(stack, [-0.3, 0.4, 0.3])
        },
    },
    Case {
        name: "an obstacle straight between tool and goal",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, _| {
            let [x, y, z] = tool;
            stack.set("ball", Distance::of_tool_to([x, y, z + 0.15]), 0.1..)?;
            position(stack, [x, y, z + 0.3])
        },
    },
    Case {
        name: "a stretched arm that is asked further out",
        q0: STRETCHED,
        is_out_of_reach: true,
        fill: |stack, tool, _| {
            stack.set("wall", Coordinate::of_tool(Axis::Z), -0.5..)?;
            position(stack, tool.map(|v| 1.5 * v))
        },
    },
    Case {
        name: "a stretched arm that is asked back in",
        q0: STRETCHED,
        is_out_of_reach: false,
        fill: |stack, tool, _| position(stack, tool.map(|v| 0.6 * v)),
    },
    Case {
        name: "a wrist in line, and a view that turns it",
        q0: WRIST_IN_LINE,
        is_out_of_reach: false,
        fill: |stack, tool, axis| {
            stack.set("view", FieldOfView::of_tool_along(axis), ..=0.3)?;
            position(stack, [tool[0], tool[1] + 0.2, tool[2]])?;
            let along = FieldOfView::of_tool_along([1.0, 0.2, 0.1]);
            stack.equality("turn", along, &[0.0], 0.5)?;
            Ok(())
        },
    },
    Case {
        name: "two sets that cannot both be kept",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, _| {
            stack.set("near", Coordinate::of_tool(Axis::X), ..=tool[0] - 0.05)?;
            stack.set("far", Coordinate::of_tool(Axis::X), tool[0] + 0.05..)?;
            position(stack, [tool[0], tool[1], tool[2] + 0.1])
        },
    },
    Case {
        name: "a tool exactly at the point that it is to keep away from",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, _| {
            stack.set("ball", Distance::of_tool_to(tool), 0.1..)?;
            position(stack, [tool[0] + 0.3, tool[1], tool[2]])
        },
    },
    Case {
        name: "a tool exactly along the direction that it is to leave",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, axis| {
            stack.set("apart", FieldOfView::of_tool_along(axis), 0.5..)?;
            stack.set("view", FieldOfView::of_tool_along(axis), ..=1.0)?;
            position(stack, [tool[0] - 0.2, tool[1], tool[2]])
        },
    },
    Case {
        name: "a tool exactly against the direction that it is to take",
        q0: BENT,
        is_out_of_reach: false,
        fill: |stack, tool, axis| {
            let opposite = axis.map(|v| -v);
            stack.set("view", FieldOfView::of_tool_along(opposite), ..=0.3)?;
            position(stack, [tool[0] - 0.2, tool[1], tool[2]])?;
            stack.equality("turn", FieldOfView::of_tool_along(opposite), &[0.0], 0.5)?;
            Ok(())
        },
    },
];

fn position(stack: &mut Stack, target: [f64; 3]) -> Result<(), StackError> {
    stack.equality("position", Position::of_tool(), &target, 0.5)?;
    Ok(())
}

impl Case {
    fn controller(&self, settings: Settings) -> Controller {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut kinematics = Kinematics::new(&robot);
        kinematics.update(&self.q0);
        let pose = *kinematics.world_from(Frame::Tool);
        let mut stack = Stack::new(&robot);
        (self.fill)(&mut stack, pose.origin.to_array(), pose.z_axis.to_array())
            .expect("a sound stack");
        Controller::new(&robot, stack, settings).expect("sound settings")
    }
}

/// What a run came to.
#[derive(Debug, Default)]
struct Run {
    /// Largest joint speed at all, and in the last two seconds [rad/s].
    fastest: f64,
    fastest_late: f64,
    /// Ticks in which a joint reversed at more than half its speed limit.
    bounces: usize,
    /// The same at any speed that can be seen, in the last two seconds.
    late_reversals: usize,
    /// Furthest outside a high-priority set that had been entered [task's unit].
    dip: f64,
    most_pivots: usize,
    most_kinematics: usize,
}

const DURATION_S: usize = 24;

fn run(case: &Case, settings: Settings, rate: usize) -> Run {
    let mut controller = case.controller(settings);
    let mut q = JointVec::from(case.q0);
    let mut before = JointVec::zeros(6);
    let mut entered = [false; MAX_SETS];
    let mut run = Run::default();
    for tick in 0..DURATION_S * rate {
        let is_late = tick >= (DURATION_S - 2) * rate;
        let step = controller.step(&q).expect("finite").clone();
        assert!(step.qd.is_finite() && step.q_ref.is_finite() && step.qdd.is_finite());
        let reversal = (0..6)
            .filter(|&i| before[i] * step.qd[i] < 0.0)
            .map(|i| before[i].abs().min(step.qd[i].abs()))
            .fold(0.0, f64::max);
        let (_, speed) = step.qd.largest().expect("six joints");
        run.fastest = run.fastest.max(speed);
        run.bounces += usize::from(reversal > 0.5 * PI);
        if is_late {
            run.fastest_late = run.fastest_late.max(speed);
            run.late_reversals += usize::from(reversal > VISIBLE);
        }
        run.most_pivots = run.most_pivots.max(step.pivots);
        run.most_kinematics = run.most_kinematics.max(step.landed.kinematics);
        let stack = controller.stack();
        for (id, level) in stack.iter().take_while(|(_, l)| l.interval().is_some()) {
            let violation = level
                .interval()
                .expect("a set")
                .violation(step.value(id)[0]);
            if entered[id.index()] {
                run.dip = run.dip.max(violation);
            }
            entered[id.index()] |= violation == 0.0;
        }
        before = step.qd;
        q = step.q_ref;
    }
    run
}

const MAX_SETS: usize = 16;
/// A reversal slower than this [rad/s] is not seen.
const VISIBLE: f64 = 1e-3;
/// A joint slower than this [rad/s] has come to rest, or nearly: along a set, errors may fade slowly.
const AT_REST: f64 = 5e-3;

/// The paper's pseudoinverse is not damped, as the paper has it: a goal out of reach drives it on, to
/// and fro across the singularity, scaled to the speed limits.
fn is_undamped(settings: Settings) -> bool {
    settings.mode_rule != ModeRule::Cone && settings.recursion == Recursion::Chiaverini
}

fn assert_defined(rate: usize) {
    for case in &CASES {
        for settings in all_settings(rate as f64) {
            let run = run(case, settings, rate);
            let context = format!("{}, {settings:?}: {run:?}", case.name);
            assert!(run.fastest <= PI * (1.0 + 1e-12), "{context}");
            assert!(run.most_pivots <= MAX_PIVOTS, "{context}");
            assert!(run.most_kinematics <= 10, "{context}");
            if settings.border == Border::Land {
                assert!(run.dip <= 1e-12, "{context}");
            }
            if is_undamped(settings) && case.is_out_of_reach {
                continue;
            }
            assert!(run.bounces <= 1, "{context}");
            assert_eq!(run.late_reversals, 0, "{context}");
            assert!(run.fastest_late <= AT_REST, "{context}");
        }
    }
}

#[test]
fn conflicts_and_singularities_end_at_rest_at_125_hz() {
    assert_defined(125);
}

#[test]
fn conflicts_and_singularities_end_at_rest_at_50_hz() {
    assert_defined(50);
}
/// The tool is between two walls that are each on the wrong side: along them it moves as ever.
#[test]
fn sets_that_cannot_be_kept_do_not_stop_what_they_leave_free() {
    let case = CASES
        .iter()
        .find(|case| case.name == "two sets that cannot both be kept")
        .expect("it is there");
    for settings in all_settings(125.0) {
        let mut controller = case.controller(settings);
        let mut q = JointVec::from(case.q0);
        for _ in 0..DURATION_S * 125 {
            q = controller.step(&q).expect("finite").q_ref;
        }
        let position = controller.stack().find("position").expect("there");
        let error = controller.last_step().error_norm(position);
        assert!(error < 1e-3, "{settings:?}: {error} m short");
    }
}
