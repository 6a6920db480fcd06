//! A task of one's own: how far the forearm leans, as a set, while the tool goes to a point.
//!
//! A task is a type with a value and its Jacobian. This one is the sum of two joints, which on this arm is
//! how far the forearm leans. Added to the stack it is kept like any other set.

use conik::{
    Controller, JacobianMut, JointVec, Kinematics, Position, Robot, Settings, Stack, Task,
};

const RATE_HZ: f64 = 125.0;
const TICKS: usize = 125 * 10;
const START_DEG: [f64; 6] = [-48.0, -158.0, -108.0, -90.0, -85.0, 0.0];
const TARGET_M: [f64; 3] = [0.3, 0.4, 0.1];
const LEAST_RAD: f64 = -4.8;
const GREATEST_RAD: f64 = -4.3;

/// The sum of two joints [rad].
#[derive(Debug)]
struct Lean {
    joints: [usize; 2],
}

impl Task for Lean {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        value[0] = self.joints.iter().map(|joint| kinematics.q()[*joint]).sum();
    }

    fn jacobian(&self, _kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        let row = jacobian.row(0);
        row.fill(0.0);
        for joint in self.joints {
            row[joint] = 1.0;
        }
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, robot: &Robot) -> Result<(), &'static str> {
        let has = |joint: &usize| *joint < robot.dof();
        self.joints
            .iter()
            .all(has)
            .then_some(())
            .ok_or("the robot has no such joint")
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::builtin("ur5-paper")?;
    let mut stack = Stack::new(&robot);
    let lean = Lean { joints: [1, 2] };
    let lean = stack.set("lean", lean, LEAST_RAD..=GREATEST_RAD)?;
    let position = stack.equality("position", Position::of_tool(), &TARGET_M, 1.0)?;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(RATE_HZ))?;

    let mut q = JointVec::from(START_DEG.map(f64::to_radians));
    let mut leans = Vec::new();
    let mut held = 0;
    for _ in 0..TICKS {
        let step = controller.step(&q)?;
        leans.push(step.value(lean)[0]);
        held += usize::from(step.active.contains(lean));
        q = step.q_ref;
    }

    let outside = leans
        .iter()
        .filter(|lean| !(LEAST_RAD..=GREATEST_RAD).contains(*lean));
    let least = leans.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = leans.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let left = controller.last_step().error_norm(position);
    println!("lean at the start: {:.4} rad", leans[0]);
    println!("least lean: {least:.5} rad");
    println!("greatest lean: {greatest:.5} rad");
    println!("samples outside: {}", outside.count());
    println!(
        "time in which the lean is held: {:.3} s",
        held as f64 / RATE_HZ
    );
    println!("left to the target: {:.4} mm", left * 1e3);
    Ok(())
}
