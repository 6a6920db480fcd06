//! What one run is, as a value: the types that the rest of the program works with.

use serde::{Deserialize, Serialize};

use super::collision::Collision;
use super::damping::Damping;
use super::frames::Frames;
use super::motion::Motion;
use super::robot_source::{PlacesConfig, RobotSource};
use super::ur::UrSettings;
use crate::collision_pairs::ShapePair;

/// One run: a robot, a start, the settings of the controller and the tasks in decreasing priority.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scenario {
    /// A line for people.
    pub title: Option<String>,
    /// The robot and where it starts.
    pub robot: RobotConfig,
    /// How the controller works.
    pub control: Control,
    /// How a Universal Robots arm is driven, if the file says so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ur: Option<UrSettings>,
    /// What must not collide.
    #[serde(flatten)]
    pub collision: Collision,
    /// The tasks, the most important first.
    #[serde(rename = "task")]
    pub tasks: Vec<TaskConfig>,
}

/// The robot and where it starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RobotConfig {
    /// What describes it.
    #[serde(flatten)]
    pub source: RobotSource,
    /// Where it stands, and where on it the tool is.
    #[serde(flatten)]
    pub places: PlacesConfig,
    /// Joint positions at the start [rad] (scenario files may say `q0_deg` instead).
    pub q0_rad: Vec<f64>,
    /// Limits that override the model's.
    #[serde(flatten)]
    pub limits: LimitsConfig,
}

/// Limits of the joints, base to tool, that override the model's; `None`: the model's hold. Scenario
/// files may give them in degrees instead.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LimitsConfig {
    /// Least and greatest position of each joint [rad or m]; `None`: that joint has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_limits_rad: Option<Vec<Option<[f64; 2]>>>,
    /// Greatest speed of each joint [rad/s or m/s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_limits_rad_per_s: Option<Vec<f64>>,
    /// Greatest acceleration of each joint [rad/s² or m/s²].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration_limits_rad_per_s2: Option<Vec<f64>>,
}

/// How the controller works.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Control {
    /// Control rate [Hz].
    pub rate_hz: f64,
    /// Length of the run [s].
    pub duration_s: f64,
    /// Which rule chooses the active set-based tasks.
    pub mode_rule: ModeRule,
    /// What happens at the border of a set between samples.
    pub border: Border,
    /// How the velocities of lower levels are fitted under the higher ones.
    pub recursion: Recursion,
    /// Groups of set-based tasks of which no two are ever active together.
    pub exclusive: Vec<Vec<String>>,
}

impl Default for Control {
    /// What holds where the file says nothing.
    fn default() -> Self {
        Self {
            rate_hz: 125.0,
            duration_s: 60.0,
            mode_rule: ModeRule::Cone,
            border: Border::Land,
            recursion: Recursion::SicilianoSlotine,
            exclusive: Vec::new(),
        }
    }
}

/// `control.mode_rule`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModeRule {
    /// All subsets of the set-based tasks, the paper's order.
    Paper,
    /// The same, but only tasks at or outside their border may be active.
    Border,
    /// The velocity nearest to what each task asks that keeps every high-priority set.
    Cone,
}

/// `control.border`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Border {
    /// Active high-priority sets are frozen, as in the paper.
    Freeze,
    /// No sample lies outside a high-priority set that was ever entered.
    Land,
}

/// `control.recursion`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Recursion {
    /// The singularity-robust form of the paper.
    Chiaverini,
    /// Each task is fitted to what the tasks above leave of it.
    SicilianoSlotine,
}

/// One task: what it measures, and what is asked of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskConfig {
    /// Unique name, `[A-Za-z0-9_./-]+`.
    pub name: String,
    /// What it measures.
    #[serde(flatten)]
    pub kind: TaskKind,
    /// Of which frame, and as which other one sees it.
    #[serde(flatten)]
    pub frames: Frames,
    /// How points, directions and desired values move that are given as what they are at t = 0.
    #[serde(flatten)]
    pub motion: Motion,
    /// What is asked of it.
    #[serde(flatten)]
    pub goal: GoalConfig,
    /// How it is damped near singularities; a set of high priority is no level, and is not.
    #[serde(default, skip_serializing_if = "Damping::is_default")]
    pub damping: Damping,
}

/// What a task measures; `type` in the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum TaskKind {
    /// Position of the frame [m]; dimension 3.
    Position,
    /// One coordinate of the frame's position [m].
    Coordinate {
        /// Which one.
        axis: Axis,
    },
    /// Distance of the frame to a point [m].
    Distance {
        /// The point [m].
        point_m: [f64; 3],
    },
    /// Norm of (direction − z axis of the frame) [-].
    FieldOfView {
        /// The direction, of length 1.
        direction: [f64; 3],
    },
    /// Rotation vector from a desired orientation to that of the frame [rad]; dimension 3, zero is desired.
    Orientation {
        /// The desired orientation, or the first one, a quaternion of length 1, its real part first.
        desired_quaternion_wxyz: [f64; 4],
    },
    /// Length of that vector: the angle that is left to turn [rad].
    OrientationAngle {
        /// The desired orientation, a quaternion of length 1, its real part first.
        desired_quaternion_wxyz: [f64; 4],
    },
    /// Position and orientation of the frame against desired ones [m, rad]; dimension 6, zero is desired.
    Pose {
        /// The desired position, or the first one [m].
        target_m: [f64; 3],
        /// The desired orientation, or the first one, a quaternion of length 1, its real part first.
        desired_quaternion_wxyz: [f64; 4],
    },
    /// Angle between an axis of the frame and a direction [rad].
    PointingAngle {
        /// The axis in the frame, of length 1.
        axis: [f64; 3],
        /// The direction, of length 1.
        direction: [f64; 3],
    },
    /// Angle between the frame's z axis and the line of sight to a point [rad].
    LookAt {
        /// The point [m].
        point_m: [f64; 3],
    },
    /// Signed distance of the frame to a plane [m].
    Plane {
        /// The normal of the plane, of length 1, towards what counts positive.
        normal: [f64; 3],
        /// How far the plane is from the origin along its normal [m].
        offset_m: f64,
    },
    /// Height of the frame: its z [m].
    Height,
    /// Position of one joint [rad or m].
    Joint {
        /// 1-based number of the joint.
        joint: usize,
    },
    /// Positions of several joints [rad or m].
    Posture {
        /// 1-based numbers of the joints.
        joints: Vec<usize>,
    },
    /// Speed of one joint, without regard to where it is; the value is its position [rad or m].
    JointSpeed {
        /// 1-based number of the joint.
        joint: usize,
        /// The desired speed [rad/s or m/s].
        speed_rad_per_s: f64,
    },
    /// Manipulability of the frame, √det(J Jᵀ) [m³ or -].
    Manipulability {
        /// Which rows of the Jacobian count.
        part: Part,
    },
    /// Smallest singular value of the frame's Jacobian [m/rad or -].
    SmallestSingularValue {
        /// Which rows of the Jacobian count.
        part: Part,
    },
    /// Swivel angle of the elbow about the line from shoulder to wrist [rad].
    Elbow {
        /// Link at whose origin the shoulder is.
        shoulder: String,
        /// Link at whose origin the elbow is.
        elbow: String,
        /// Link at whose origin the wrist is.
        wrist: String,
        /// Where the elbow is at 0, of length 1.
        direction: [f64; 3],
    },
    /// Distance of two shapes of the file [m].
    ShapeDistance {
        /// Their names.
        shapes: [String; 2],
    },
    /// The same, with the shapes themselves; no type of the file, but what shapes and obstacles in it become.
    Shapes(Box<ShapePair>),
}

/// Which rows of a frame's Jacobian count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// The three of its position.
    #[default]
    Position,
    /// The three of its angular velocity.
    Orientation,
    /// All six.
    Pose,
}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// x
    X,
    /// y
    Y,
    /// z
    Z,
}

/// What is asked of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum GoalConfig {
    /// Equality task: visit points, orientations or poses one after the other.
    Waypoints {
        /// The points [m]; none where only orientations count.
        waypoints_m: Vec<[f64; 3]>,
        /// The orientations, as many, quaternions of length 1, real part first; none where only points count.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        waypoints_quaternion_wxyz: Vec<[f64; 4]>,
        /// At this distance [m] the next one is taken.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        acceptance_m: Option<f64>,
        /// At this angle [rad] the next one is taken.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        acceptance_rad: Option<f64>,
        /// Λ [1/s].
        gain_per_s: f64,
    },
    /// Equality task: one desired value (one entry, three for `position`, one a joint for `posture`; zeros
    /// for what has its desired value among its own keys).
    Desired {
        /// `σ_des` in the task's unit.
        desired: Vec<f64>,
        /// Λ [1/s].
        gain_per_s: f64,
    },
    /// Set-based task.
    Set {
        /// Least allowed value.
        #[serde(skip_serializing_if = "Option::is_none")]
        min: Option<f64>,
        /// Greatest allowed value.
        #[serde(skip_serializing_if = "Option::is_none")]
        max: Option<f64>,
        /// Speed [task's unit/s] at which a set of high priority moves in while it is outside.
        #[serde(skip_serializing_if = "Option::is_none")]
        recovery_per_s: Option<f64>,
        /// Λ [1/s], needed below the first equality task only.
        #[serde(skip_serializing_if = "Option::is_none")]
        gain_per_s: Option<f64>,
    },
}

impl GoalConfig {
    /// How many waypoints it has, if it has any.
    pub fn waypoint_count(&self) -> Option<usize> {
        match self {
            Self::Waypoints {
                waypoints_m,
                waypoints_quaternion_wxyz,
                ..
            } => Some(waypoints_m.len().max(waypoints_quaternion_wxyz.len())),
            _ => None,
        }
    }

    /// Λ [1/s], where the goal has one.
    pub fn gain_per_s(&self) -> Option<f64> {
        match self {
            Self::Waypoints { gain_per_s, .. } | Self::Desired { gain_per_s, .. } => {
                Some(*gain_per_s)
            }
            Self::Set { gain_per_s, .. } => *gain_per_s,
        }
    }
}
