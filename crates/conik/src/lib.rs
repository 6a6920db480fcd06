//! Set-based task-priority inverse kinematics: a real-time kinematic controller for robot arms.
//!
//! # The problem
//!
//! A robot with joint positions q ∈ ℝⁿ has tasks σ(q), in decreasing priority. An *equality task*
//! has a desired value σ_des; a *set-based task* is scalar and has an interval C = \[min, max\] of
//! allowed values. Once per period T the controller chooses a joint velocity q̇ and integrates it to
//! the next joint reference q + T q̇.
//!
//! While all sets hold, the equality tasks alone decide. With sᵢ = σ̇ᵢ,des + Λᵢ (σᵢ,des − σᵢ), Jacobians
//! Jᵢ and N the null-space projector of all rows stacked above level i, level by level,
//!
//! ```text
//! q̇ ← q̇ + (Jᵢ N)⁺ (sᵢ − Jᵢ q̇)            by default
//! q̇ ← q̇ + N Jᵢ⁺ sᵢ                       in the paper
//! ```
//!
//! A set-based task is ignored until it would leave its set: until it is at a border of C and J q̇
//! points out of the tangent cone T_C(σ). Then it becomes *active*. Above the first equality task it
//! is held there, and no sample lies outside; below, it is driven back to its border with a gain. The
//! set of active tasks is the *mode*; [`Settings`] says how it is chosen, how sets are held, and how
//! levels are fitted. `docs/method.md` in the repository has the whole.
//!
//! The method is that of Moe, Antonelli, Pettersen and Schrimpf, *Experimental Results for
//! Set-based Control within the Singularity-robust Multiple Task-priority Inverse Kinematics
//! Framework*, IEEE ROBIO 2015. Equation numbers in this documentation are of that paper.
//!
//! # Use
//!
//! ```
//! use conik::{Controller, Distance, Position, Robot, Settings, Stack};
//!
//! let robot = Robot::builtin("ur5-paper")?;
//! let mut stack = Stack::new(&robot);
//! stack.set("obstacle", Distance::of_tool_to([0.40, -0.25, -0.33]), 0.18..)?;
//! let position = stack.equality("position", Position::of_tool(), &[0.486, -0.066, -0.250], 0.3)?;
//!
//! let mut controller = Controller::new(&robot, stack, Settings::at_rate(125.0))?;
//! let mut q = conik::JointVec::from([-0.84, -2.76, -1.88, -1.57, -1.48, 0.0]);
//! for _ in 0..125 * 60 {
//!     q = controller.step(&q)?.q_ref;
//! }
//! assert!(controller.last_step().error_norm(position) < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! Lengths are in metres, angles in radians, times in seconds. Everything is expressed in the
//! [world](Frame::World), which is the robot's base unless it was put elsewhere; poses are named by the
//! frames they relate, `world_from_tool`.
//!
//! The crate needs no operating system: without the default feature `std` (and with `libm`) it is
//! `no_std` and uses `alloc` at construction only.

#![forbid(unsafe_code)]
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod active;
mod anchor;
mod barrier;
mod border;
mod cone;
mod controller;
mod damping;
mod dependence;
mod evaluation;
mod geometry;
mod hierarchy;
mod joints;
mod kinematics;
mod landing;
mod limits;
mod linalg;
mod mode;
mod monitor;
mod ranges;
mod real;
mod reason;
mod restless;
mod robot;
mod rotation;
mod settings;
mod shape;
mod sides;
mod stack;
mod step;
mod task;
mod task_id;
mod task_vectors;
mod trigonometry;
mod watch;
mod waypoints;

pub use active::{ActiveSet, MAX_TASKS};
pub use cone::Interval;
pub use controller::{Controller, ControllerError, MAX_PIVOTS, StepError};
pub use damping::Damping;
pub use dependence::dependent_tasks;
pub use geometry::{Pose, Vec3};
pub use joints::{JointVec, MAX_JOINTS, TooManyJoints};
pub use kinematics::{Frame, Kinematics, Motion};
pub use landing::{Landed, Outside};
pub use limits::{Exceeded, Shortened};
pub use mode::ModeOrder;
pub use monitor::{
    Deviation, JointHistory, Monitor, Observations, Occurrence, PROPERTY_TOLERANCE, Properties,
    TaskHistory,
};
pub use reason::Reason;
pub use robot::{
    Body, DhConvention, DhRow, Joint, JointKind, JointLimits, Link, Mimic, MovedBody, PlacedJoint,
    Robot, RobotBuilder, RobotError, UrArm,
};
pub use settings::{Border, ModeRule, Recursion, Settings};
pub use shape::{Capsule, Closest, Cuboid, Cylinder, HalfSpace, Shape, Sphere};
pub use stack::{BoundRates, Goal, Level, Setpoints, Stack, StackError, StackErrorReason};
pub use step::Step;
pub use task::{
    Axis, Coordinate, Distance, Elbow, FieldOfView, FramePose, JacobianMut, JacobianPart,
    JointPosition, JointSpeed, LookAt, Manipulability, Orientation, OrientationAngle, Plane,
    PointingAngle, Position, Posture, ShapeDistance, SmallestSingularValue, Task,
};
pub use task_id::TaskId;
pub use waypoints::{PoseWaypoints, Waypoints};
