//! One equality task: the tool goes to a point.
//!
//! The task asks for the velocity `gain * error`. So the error falls as exp(-gain t), and the tool goes there
//! on a straight line: no set is in its way.

use conik::{Controller, JointVec, Position, Robot, Settings, Stack, Vec3};

const RATE_HZ: f64 = 125.0;
const SECOND: usize = 125;
const DURATION: usize = 20 * SECOND;
const GAIN_PER_S: f64 = 0.5;
const TARGET_M: [f64; 3] = [0.320, 0.370, -0.250];
const START_DEG: [f64; 6] = [-48.0, -158.0, -108.0, -90.0, -85.0, 0.0];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::builtin("ur5-paper")?;
    let mut stack = Stack::new(&robot);
    let position = stack.equality("position", Position::of_tool(), &TARGET_M, GAIN_PER_S)?;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(RATE_HZ))?;

    let mut q = JointVec::from(START_DEG.map(f64::to_radians));
    let (mut tools, mut errors) = (Vec::new(), Vec::new());
    for _ in 0..DURATION {
        let step = controller.step(&q)?;
        let tool = step.value(position);
        tools.push(Vec3::new(tool[0], tool[1], tool[2]));
        errors.push(step.error_norm(position));
        q = step.q_ref;
    }

    let way = (Vec3::from(TARGET_M) - tools[0]).normalized();
    let aside = tools.iter().map(|tool| {
        let off = *tool - tools[0];
        (off - way * off.dot(way)).norm()
    });
    let near = errors.iter().take_while(|error| **error >= 1e-3).count();
    println!("distance at the start: {:.4} m", errors[0]);
    println!("distance after 4 s: {:.4} m", errors[4 * SECOND]);
    println!(
        "distance by exp(-gain t) after 4 s: {:.4} m",
        errors[0] * (-GAIN_PER_S * 4.0).exp()
    );
    println!("nearer than 1 mm after: {:.3} s", near as f64 / RATE_HZ);
    println!(
        "furthest from the straight line: {:.2} mm",
        aside.fold(0.0, f64::max) * 1e3
    );
    Ok(())
}
