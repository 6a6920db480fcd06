//! Sets above an equality task: the tool goes past two obstacles. Example 1 of the paper.
//!
//! Each obstacle is a set, "at least so far away". While the tool is further away the sets cost nothing;
//! where the way to the next waypoint would enter one, the tool is held at its border and slides along it.
//! Below the position, the view is to be straight along x, with what freedom is left.

use conik::{Controller, Distance, FieldOfView, JointVec, Position, Robot, Settings, Stack};

const RATE_HZ: f64 = 125.0;
const TICKS: u32 = 125 * 60;
const START_DEG: [f64; 6] = [-48.0, -158.0, -108.0, -90.0, -85.0, 0.0];
/// Each obstacle: its name, where it is [m], and how far away the tool is to stay [m].
const OBSTACLES: [(&str, [f64; 3], f64); 2] = [
    ("obstacle_a", [0.40, -0.25, -0.33], 0.18),
    ("obstacle_b", [0.40, 0.15, -0.33], 0.15),
];
const WAYPOINTS_M: [[f64; 3]; 2] = [[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]];
const ACCEPTANCE_M: f64 = 0.02;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::builtin("ur5-paper")?;
    let mut stack = Stack::new(&robot);
    let mut obstacles = Vec::new();
    for (name, point, least) in OBSTACLES {
        obstacles.push(stack.set(name, Distance::of_tool_to(point), least..)?);
    }
    let position = stack.equality("position", Position::of_tool(), &WAYPOINTS_M[0], 0.3)?;
    let view = FieldOfView::of_tool_along([1.0, 0.0, 0.0]);
    let view = stack.equality("view", view, &[0.0], 1.0)?;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(RATE_HZ))?;

    let mut q = JointVec::from(START_DEG.map(f64::to_radians));
    let mut steps = Vec::new();
    let mut reached = Vec::new();
    for tick in 0..TICKS {
        let step = controller.step(&q)?.clone();
        q = step.q_ref;
        // A waypoint is reached inside a circle about it; then the next one is the target.
        if reached.len() < WAYPOINTS_M.len() && step.error_norm(position) < ACCEPTANCE_M {
            reached.push(f64::from(tick) / RATE_HZ);
            if let Some(next) = WAYPOINTS_M.get(reached.len()) {
                controller.setpoints().set_desired(position, next)?;
            }
        }
        steps.push(step);
    }

    for (number, time) in (1..).zip(&reached) {
        println!("waypoint {number} reached after: {time:.3} s");
    }
    for ((name, _, least), obstacle) in OBSTACLES.iter().zip(obstacles) {
        let distances = steps.iter().map(|step| step.value(obstacle)[0]);
        let outside = distances
            .clone()
            .filter(|distance| distance < least)
            .count();
        let nearest = distances.fold(f64::INFINITY, f64::min);
        println!("least distance to {name}: {nearest:.5} m");
        println!("samples nearer than {least} m to {name}: {outside}");
    }
    let changes = steps
        .windows(2)
        .filter(|pair| pair[0].active != pair[1].active);
    println!("changes of what is held: {}", changes.count());
    let last = controller.last_step();
    println!(
        "left to the last waypoint: {:.3} mm",
        last.error_norm(position) * 1e3
    );
    println!("left of the view: {:.6}", last.value(view)[0]);
    Ok(())
}
