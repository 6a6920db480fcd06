//! A task of one's own: the sum of two joints, which on this arm is how far the forearm leans. As a set it
//! keeps the forearm from leaning too far while the tool moves.

use conik::{Controller, JacobianMut, Kinematics, Position, Robot, Settings, Stack, Task};

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
    let lean = stack.set("lean", Lean { joints: [1, 2] }, -4.8..=-4.3)?;
    let position = stack.equality("position", Position::of_tool(), &[0.3, 0.4, 0.1], 1.0)?;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0))?;
    let mut q = conik::JointVec::from([-0.84, -2.76, -1.88, -1.57, -1.48, 0.0]);
    for _ in 0..125 * 10 {
        q = controller.step(&q)?.q_ref;
    }
    let step = controller.last_step();
    let (lean, left) = (step.value(lean)[0], step.error_norm(position));
    println!("it leans {lean:.4} rad, and the tool is {left:.4} m from its target");
    Ok(())
}
