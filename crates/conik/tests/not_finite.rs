//! A task of the user's own whose Jacobian is no number: no reference comes of it.

use conik::{
    Border, Controller, JacobianMut, JointVec, Kinematics, ModeRule, Position, Robot, Settings,
    Stack, StepError, Task,
};

/// The position of the first joint, with a Jacobian that has this number in it.
#[derive(Debug)]
struct Broken(f64);

impl Task for Broken {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = kinematics.q()[0];
    }

    fn jacobian(&self, _kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let row = jacobian.row(0);
        row.fill(0.0);
        row[0] = 1.0;
        row[1] = self.0;
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, _robot: &Robot) -> Result<(), &'static str> {
        Ok(())
    }
}

const START: [f64; 6] = [-0.84, -2.76, -1.88, -1.57, -1.48, 0.0];

/// What a tick says of the task above or below a position, as an equality or as a set at its border.
fn tick(
    robot: &Robot,
    settings: Settings,
    number: f64,
    fill: impl Fn(&mut Stack, Broken),
) -> Result<JointVec, StepError> {
    let mut stack = Stack::new(robot);
    fill(&mut stack, Broken(number));
    let mut controller = Controller::new(robot, stack, settings).expect("sound");
    controller.step(&START).map(|step| step.q_ref)
}

fn position(stack: &mut Stack) {
    stack
        .equality("position", Position::of_tool(), &[0.3, 0.4, 0.1], 1.0)
        .expect("sound");
}

/// Adds the broken task to a stack, and others.
type Fill = fn(&mut Stack, Broken);

#[test]
fn jacobian_that_is_no_number_is_an_error_under_every_setting() {
    let plain = Robot::builtin("ur5-paper").expect("built in");
    let limited = plain.clone().with_limits(|_, joint| {
        let mut limits = joint.limits;
        limits.acceleration = Some(3.0);
        limits
    });
    let mut silent = Vec::new();
    for (robot, accelerations) in [(&plain, "free"), (&limited.expect("sound"), "limited")] {
        for mode_rule in [ModeRule::Cone, ModeRule::Border, ModeRule::Paper] {
            for border in [Border::Land, Border::Freeze] {
                let settings = Settings {
                    mode_rule,
                    border,
                    ..Settings::at_rate(125.0)
                };
                let stacks: [(&str, Fill); 3] = [
                    ("first equality", |stack, broken| {
                        stack.equality("own", broken, &[0.5], 1.0).expect("sound");
                        position(stack);
                    }),
                    ("second equality", |stack, broken| {
                        position(stack);
                        stack.equality("own", broken, &[0.5], 1.0).expect("sound");
                    }),
                    ("set at its border", |stack, broken| {
                        stack.set("own", broken, START[0]..).expect("sound");
                        position(stack);
                    }),
                ];
                for (name, fill) in stacks {
                    for number in [f64::NAN, f64::INFINITY] {
                        let said = tick(robot, settings, number, fill);
                        if !matches!(said, Err(StepError::JacobianNotFinite { .. })) {
                            let what = (accelerations, mode_rule, border, name, number);
                            silent.push(format!("{what:?}: {said:?}"));
                        }
                    }
                }
            }
        }
    }
    assert!(silent.is_empty(), "\n{}", silent.join("\n"));
}
