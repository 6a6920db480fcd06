//! Which equality tasks depend on those above them: the rank certificate of a hierarchy.

use alloc::vec::Vec;

use crate::kinematics::Kinematics;
use crate::linalg::RowSpace;
use crate::stack::Stack;
use crate::task::JacobianMut;
use crate::task_id::TaskId;

/// The equality tasks of which at least one row depends, in this configuration, on the rows of the
/// equality tasks above. Those rows leave them no joint motion of their own, and the convergence that
/// the paper proves for independent tasks is not given.
pub fn dependent_tasks(stack: &Stack, kinematics: &Kinematics) -> Vec<TaskId> {
    let dof = stack.dof();
    let mut above = RowSpace::new(dof, crate::MAX_JOINTS);
    let mut dependent = Vec::new();
    for (id, level) in stack.iter().filter(|(_, level)| level.interval().is_none()) {
        let rows = level.task().dimension();
        let mut jacobian = alloc::vec![0.0; rows * dof];
        level
            .task()
            .jacobian(kinematics, &mut JacobianMut::new(&mut jacobian, dof));
        let rank = above.rank();
        above.push_block(&jacobian);
        if above.rank() - rank < rows {
            dependent.push(id);
        }
    }
    dependent
}
