//! Set-based task-priority inverse kinematics.
pub mod joints;
pub use joints::{JointVec, MAX_JOINTS, TooManyJoints};
