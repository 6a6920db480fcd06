//! A ball that crosses the tool's way. The controller is told where it is, and how it moves.
//!
//! The ball moves at 0.2 m/s for 5.5 s and then stays. Before every tick the controller is told where it is
//! now and with what velocity it moves, so the next sample is computed for where the ball will be then: the
//! tool gives way in time. A second run tells only where the ball is: there the tool is late, and inside the
//! ball for a while.

use conik::{Controller, Distance, JointVec, Position, Robot, Settings, Stack, Vec3};

const RATE_HZ: f64 = 125.0;
const TICKS: u32 = 125 * 30;
const START_DEG: [f64; 6] = [-48.0, -158.0, -108.0, -90.0, -85.0, 0.0];
const BALL_M: Vec3 = Vec3::new(0.75, 0.30, -0.25);
const BALL_M_PER_S: Vec3 = Vec3::new(-0.1132, -0.1649, 0.0);
const BALL_STOPS_S: f64 = 5.5;
const LEAST_M: f64 = 0.12;
const WAYPOINTS_M: [[f64; 3]; 2] = [[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]];
const ACCEPTANCE_M: f64 = 0.02;

/// Where the ball is [m], and its velocity [m/s].
fn ball(t: f64) -> (Vec3, Vec3) {
    if t < BALL_STOPS_S {
        (BALL_M + BALL_M_PER_S * t, BALL_M_PER_S)
    } else {
        (BALL_M + BALL_M_PER_S * BALL_STOPS_S, Vec3::ZERO)
    }
}

fn run(name: &str, tells_velocity: bool) -> Result<(), Box<dyn std::error::Error>> {
    let robot = Robot::builtin("ur5-paper")?;
    let mut stack = Stack::new(&robot);
    let distance = stack.set("ball", Distance::of_tool_to(BALL_M), LEAST_M..)?;
    let position = stack.equality("position", Position::of_tool(), &WAYPOINTS_M[0], 0.3)?;
    let mut controller = Controller::new(&robot, stack, Settings::at_rate(RATE_HZ))?;

    let mut q = JointVec::from(START_DEG.map(f64::to_radians));
    let (mut inside, mut held, mut reached) = (Vec::new(), 0, 0);
    for tick in 0..TICKS {
        let t = f64::from(tick) / RATE_HZ;
        let (point, velocity) = ball(t);
        if let Some(task) = controller.setpoints().task_mut::<Distance>(distance) {
            task.set_point_moving(point, if tells_velocity { velocity } else { Vec3::ZERO });
        }
        let step = controller.step(&q)?;
        inside.push(LEAST_M - step.value(distance)[0]);
        held += usize::from(step.active.contains(distance));
        q = step.q_ref;
        if reached < WAYPOINTS_M.len() && step.error_norm(position) < ACCEPTANCE_M {
            reached += 1;
            println!("{name}, waypoint {reached} reached after: {t:.3} s");
            if let Some(next) = WAYPOINTS_M.get(reached) {
                controller.setpoints().set_desired(position, next)?;
            }
        }
    }

    // A rounding of the ball's place, in the last of its digits, is no entry.
    let entries = inside.iter().filter(|depth| **depth > 1e-12).count();
    let deepest = inside.iter().copied().fold(0.0, f64::max);
    println!("{name}, samples inside the ball: {entries}");
    println!("{name}, deepest inside the ball: {:.3} mm", deepest * 1e3);
    println!(
        "{name}, time in which the ball is held off: {:.3} s",
        held as f64 / RATE_HZ
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    run("velocity told", true)?;
    run("velocity not told", false)
}
