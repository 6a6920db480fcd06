//! Tasks that are not damped where they need it: near a singularity at the start.

use conik::{JacobianMut, Kinematics, Stack, Task};

use crate::scenario::{Damping, DampingRule, Scenario};

/// A task moves hardly in a direction in which it moves less than this for a joint motion of 1 rad
/// [task's unit]: from there on the controller damps, where it may.
const HARDLY: f64 = 0.2;

pub(super) fn undamped_at_a_singularity(
    scenario: &Scenario,
    stack: &Stack,
    kinematics: &Kinematics,
    doubts: &mut Vec<String>,
) {
    for config in &scenario.tasks {
        if config.damping != Damping::Rule(DampingRule::None) {
            continue;
        }
        let task = stack.find(&config.name).map(|id| stack[id].task());
        if task.is_some_and(|task| !moves_well(task, stack.dof(), kinematics)) {
            doubts.push(format!(
                "at the start, the arm hardly moves `{}` in one of its directions: with damping \
                 \"none\" velocities may grow up to the joints' speed limits there, \"per-direction\" \
                 slows that direction alone",
                config.name
            ));
        }
    }
}

/// Whether every singular value of the task's Jacobian J is more than [`HARDLY`]: J Jᵀ − `HARDLY`² I
/// is positive definite then, and has a Cholesky factor.
fn moves_well(task: &dyn Task, dof: usize, kinematics: &Kinematics) -> bool {
    let n = task.dimension();
    let mut jacobian = vec![0.0; n * dof];
    task.jacobian(kinematics, &mut JacobianMut::new(&mut jacobian, dof));
    let row = |i: usize| &jacobian[i * dof..][..dof];
    let mut factor = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let product: f64 = row(i).iter().zip(row(j)).map(|(a, b)| a * b).sum();
            let found: f64 = (0..j).map(|k| factor[i * n + k] * factor[j * n + k]).sum();
            let rest = product - found;
            if i != j {
                factor[i * n + j] = rest / factor[j * n + j];
                continue;
            }
            let pivot = rest - HARDLY * HARDLY;
            if !(pivot > 0.0) {
                return false;
            }
            factor[i * n + i] = pivot.sqrt();
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use conik::{JointPosition, Position, Robot};

    use super::*;

    /// The arm with these positions of its lift and elbow joints [deg].
    fn standing(lift: f64, elbow: f64) -> Kinematics {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut kinematics = Kinematics::new(&robot);
        let degrees = [-48.0, lift, elbow, -90.0, -85.0, 0.0];
        kinematics.update(&degrees.map(f64::to_radians));
        kinematics
    }

    #[test]
    fn an_arm_that_is_stretched_hardly_moves_its_tool() {
        let well = |kinematics| moves_well(&Position::of_tool(), 6, &kinematics);
        assert!(well(standing(-158.0, -108.0)));
        assert!(!well(standing(-60.0, 0.0)));
        assert!(!well(standing(-60.0, 3.0)), "nearly stretched");
    }

    #[test]
    fn a_joint_moves_well_wherever_the_arm_stands() {
        assert!(moves_well(&JointPosition::of(2), 6, &standing(-60.0, 0.0)));
    }
}
