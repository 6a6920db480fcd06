//! A set below an equality task: the tool looks within a cone where the position allows. Example 3 of the
//! paper.
//!
//! The view stands below the position, so it has low priority, and needs a gain: it is driven back to its
//! border as well as the obstacles and the position allow. Unlike in 03_field_of_view, samples may lie
//! outside of it.

use conik::{Controller, Distance, FieldOfView, JointVec, Position, Robot, Settings, Stack};

const RATE_HZ: f64 = 125.0;
const TICKS: u32 = 125 * 60;
const START_DEG: [f64; 6] = [-48.0, -158.0, -108.0, -90.0, -85.0, 0.0];
/// Each obstacle: its name, where it is [m], and how far away the tool is to stay [m].
const OBSTACLES: [(&str, [f64; 3], f64); 2] = [
    ("obstacle_a", [0.40, -0.25, -0.33], 0.18),
    ("obstacle_b", [0.40, 0.15, -0.33], 0.15),
];
/// The value is 2 sin(angle / 2): 0.2622 is 15.07 degrees.
const VIEW_MAX: f64 = 0.2622;
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
    let view = stack.set_with_gain("view", view, ..=VIEW_MAX, 1.0)?;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(RATE_HZ))?;

    let mut q = JointVec::from(START_DEG.map(f64::to_radians));
    let mut steps = Vec::new();
    let mut reached = Vec::new();
    for tick in 0..TICKS {
        let step = controller.step(&q)?.clone();
        q = step.q_ref;
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
    let views: Vec<f64> = steps.iter().map(|step| step.value(view)[0]).collect();
    let entered = views.iter().take_while(|view| **view > VIEW_MAX).count();
    let since = &views[entered..];
    println!("view at the start: {:.4}", views[0]);
    println!("view entered after: {:.3} s", entered as f64 / RATE_HZ);
    println!(
        "greatest view from then on: {:.5}",
        since.iter().copied().fold(0.0, f64::max)
    );
    println!(
        "samples outside the view from then on: {}",
        since.iter().filter(|view| **view > VIEW_MAX).count()
    );
    println!("view at the end: {:.6}", views[views.len() - 1]);
    let active = steps
        .iter()
        .filter(|step| step.active.contains(view))
        .count();
    println!(
        "time in which the view is active: {:.3} s",
        active as f64 / RATE_HZ
    );
    let changes = steps
        .windows(2)
        .filter(|pair| pair[0].active != pair[1].active);
    println!("changes of what is active: {}", changes.count());
    Ok(())
}
