//! Many sets below an equality task, at or outside their border: the rules `Paper` and `Border` do not go
//! through 2ⁿ modes for them.

use std::f64::consts::PI;

use conik::{
    Controller, DhRow, Interval, JacobianMut, JointPosition, Kinematics, ModeRule, Position,
    Recursion, Robot, Settings, Stack, Step, Task, Vec3,
};

/// σ = Σᵢ qᵢ: pulls at all joints alike.
#[derive(Debug)]
struct JointSum;

impl Task for JointSum {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = kinematics.q().iter().sum();
    }

    fn jacobian(&self, _: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        jacobian.row(0).fill(1.0);
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, _: &Robot) -> Result<(), &'static str> {
        Ok(())
    }
}

/// A bent arm without limits.
fn arm(joints: usize) -> Robot {
    let row = |i: usize| {
        let twist = [0.5, -0.5, 0.0][i % 3] * PI;
        DhRow::new(0.3, twist, 0.1)
    };
    let rows: Vec<DhRow> = (0..joints).map(row).collect();
    Robot::from_dh("arm", &rows).expect("finite rows")
}

fn settings() -> impl Iterator<Item = Settings> {
    [ModeRule::Paper, ModeRule::Border]
        .into_iter()
        .flat_map(|mode_rule| {
            [Recursion::Chiaverini, Recursion::SicilianoSlotine].map(|recursion| Settings {
                mode_rule,
                recursion,
                ..Settings::of_the_paper()
            })
        })
}

/// Adds sets q_i ≤ `max`, one for each joint listed.
fn add_sets(stack: &mut Stack, joints: impl Iterator<Item = usize>, max: f64) {
    let interval = Interval {
        min: f64::NEG_INFINITY,
        max,
    };
    for joint in joints {
        let name = format!("set_{}", stack.len());
        stack
            .set_with_gain(&name, JointPosition::of(joint), interval, 1.0)
            .expect("a sound set");
    }
}

fn first_step(robot: &Robot, stack: Stack, settings: Settings, q: &[f64]) -> Step {
    let mut controller = Controller::new(robot, stack, settings).expect("sound settings");
    controller.step(q).expect("a finite configuration").clone()
}

/// 1 + Σₖ C(n, k), k = 0 … free: n sets where the equality task leaves so many rows free.
fn most_velocities(n: usize, free: usize) -> usize {
    let mut binomial = 1;
    let cores: usize = (0..=free)
        .map(|k| {
            let this = binomial;
            binomial = binomial * (n - k) / (k + 1);
            this
        })
        .sum();
    1 + cores
}

/// A sum of six joints leaves five rows free: 21,700 subsets of 20 sets, not 1,048,576.
#[test]
fn twenty_sets_on_six_joints_stay_within_the_bound() {
    let robot = arm(6);
    for settings in settings() {
        let mut stack = Stack::new(&robot);
        stack
            .equality("sum", JointSum, &[100.0], 1.0)
            .expect("a sound task");
        add_sets(&mut stack, (0..20).map(|i| i % 6), -0.1);
        let step = first_step(&robot, stack, settings, &[0.0; 6]);
        // Fitted levels pull five joints back as asked, so that one set each is enough for them; the
        // sixth has three.
        let expected = match settings.recursion {
            Recursion::Chiaverini => 20,
            _ => 5 + 3,
        };
        assert_eq!(step.active.len(), expected, "{settings:?}");
        let evaluated = step.modes_evaluated;
        assert!(
            (7..=most_velocities(20, 5)).contains(&evaluated),
            "{evaluated}, {settings:?}"
        );
    }
}

/// A position leaves three rows free.
#[test]
fn rows_that_the_equality_tasks_take_are_not_tried() {
    let robot = arm(6);
    for settings in settings() {
        let mut stack = Stack::new(&robot);
        let target = Vec3::new(0.1, -0.2, 0.3);
        stack
            .equality("tool", Position::of_tool(), &target.to_array(), 1.0)
            .expect("a sound task");
        add_sets(&mut stack, (0..20).map(|i| i % 6), 0.2);
        let step = first_step(&robot, stack, settings, &[0.3; 6]);
        let evaluated = step.modes_evaluated;
        assert!(
            evaluated > 1 && evaluated <= most_velocities(20, 3),
            "{evaluated}, {settings:?}"
        );
    }
}

/// As many sets as joints: all but one make a core, and the last depends on it.
#[test]
fn a_set_on_every_joint_is_active_with_the_velocity_of_all_but_one() {
    let n = 12;
    let robot = arm(n);
    for settings in settings() {
        let mut stack = Stack::new(&robot);
        stack
            .equality("sum", JointSum, &[100.0], 1.0)
            .expect("a sound task");
        add_sets(&mut stack, 0..n, -0.1);
        let step = first_step(&robot, stack, settings, &[0.0; 12]);
        assert_eq!(step.active.len(), n, "{settings:?}");
        assert!(
            step.modes_evaluated <= most_velocities(n, n - 1),
            "{settings:?}"
        );
        let sum: f64 = step.qd.iter().sum();
        assert!(
            (sum - 100.0).abs() < 1e-3,
            "the task above keeps its speed: {sum}, {settings:?}"
        );
    }
}

/// Where two sets on the joint that the task above moves must be active, no mode of three is tried.
#[test]
fn nothing_is_tried_after_the_first_mode_found() {
    let robot = arm(6);
    for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
        let settings = Settings {
            recursion,
            ..Settings::of_the_paper()
        };
        let mut stack = Stack::new(&robot);
        stack
            .equality("joint", JointPosition::of(0), &[1.0], 1.0)
            .expect("a sound task");
        add_sets(&mut stack, [0, 0].into_iter(), -0.1);
        add_sets(&mut stack, (0..18).map(|i| 1 + i % 5), 1.0);
        let step = first_step(&robot, stack, settings, &[0.0; 6]);
        let active: Vec<usize> = step.active.iter().map(conik::TaskId::index).collect();
        assert_eq!(active, [1, 2], "{recursion:?}");
        // None, each of the 20, and the answer.
        assert_eq!(step.modes_evaluated, 1 + 20 + 1, "{recursion:?}");
    }
}
