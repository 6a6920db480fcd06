//! The types of the messages: those that Foxglove knows by name, and our own.
//!
//! All fields of a type stand here, those that are never written too, so that a reader who knows the type
//! finds it unchanged.

use super::schema::Kind::{
    Bool, Bytes, Choice, Double, Fixed32, Int32, Int64, Text, Uint32, Uint64,
};
use super::schema::{MessageType, many, maybe, message, messages, one, plain};

static TIMESTAMP: MessageType = plain(
    "google.protobuf.Timestamp",
    &[one("seconds", Int64), one("nanos", Int32)],
);
static DURATION: MessageType = plain(
    "google.protobuf.Duration",
    &[one("seconds", Int64), one("nanos", Int32)],
);
static VECTOR3: MessageType = plain(
    "foxglove.Vector3",
    &[one("x", Double), one("y", Double), one("z", Double)],
);
static POINT3: MessageType = plain(
    "foxglove.Point3",
    &[one("x", Double), one("y", Double), one("z", Double)],
);
static QUATERNION: MessageType = plain(
    "foxglove.Quaternion",
    &[
        one("x", Double),
        one("y", Double),
        one("z", Double),
        one("w", Double),
    ],
);
static COLOR: MessageType = plain(
    "foxglove.Color",
    &[
        one("r", Double),
        one("g", Double),
        one("b", Double),
        one("a", Double),
    ],
);
static POSE: MessageType = plain(
    "foxglove.Pose",
    &[
        message("position", &VECTOR3),
        message("orientation", &QUATERNION),
    ],
);
static KEY_VALUE_PAIR: MessageType = plain(
    "foxglove.KeyValuePair",
    &[one("key", Text), one("value", Text)],
);
static ARROW: MessageType = plain(
    "foxglove.ArrowPrimitive",
    &[
        message("pose", &POSE),
        one("shaft_length", Double),
        one("shaft_diameter", Double),
        one("head_length", Double),
        one("head_diameter", Double),
        message("color", &COLOR),
    ],
);
static CUBE: MessageType = plain(
    "foxglove.CubePrimitive",
    &[
        message("pose", &POSE),
        message("size", &VECTOR3),
        message("color", &COLOR),
    ],
);
static SPHERE: MessageType = plain(
    "foxglove.SpherePrimitive",
    &[
        message("pose", &POSE),
        message("size", &VECTOR3),
        message("color", &COLOR),
    ],
);
static CYLINDER: MessageType = plain(
    "foxglove.CylinderPrimitive",
    &[
        message("pose", &POSE),
        message("size", &VECTOR3),
        one("bottom_scale", Double),
        one("top_scale", Double),
        message("color", &COLOR),
    ],
);
static LINE: MessageType = MessageType {
    name: "foxglove.LinePrimitive",
    fields: &[
        one("type", Choice("Type")),
        message("pose", &POSE),
        one("thickness", Double),
        one("scale_invariant", Bool),
        messages("points", &POINT3),
        message("color", &COLOR),
        messages("colors", &COLOR),
        many("indices", Fixed32),
    ],
    choices: &[("Type", &["LINE_STRIP", "LINE_LOOP", "LINE_LIST"])],
};
static TRIANGLES: MessageType = plain(
    "foxglove.TriangleListPrimitive",
    &[
        message("pose", &POSE),
        messages("points", &POINT3),
        message("color", &COLOR),
        messages("colors", &COLOR),
        many("indices", Fixed32),
    ],
);
static TEXT: MessageType = plain(
    "foxglove.TextPrimitive",
    &[
        message("pose", &POSE),
        one("billboard", Bool),
        one("font_size", Double),
        one("scale_invariant", Bool),
        message("color", &COLOR),
        one("text", Text),
    ],
);
static MODEL: MessageType = plain(
    "foxglove.ModelPrimitive",
    &[
        message("pose", &POSE),
        message("scale", &VECTOR3),
        message("color", &COLOR),
        one("override_color", Bool),
        one("url", Text),
        one("media_type", Text),
        one("data", Bytes),
    ],
);
static ENTITY: MessageType = plain(
    "foxglove.SceneEntity",
    &[
        message("timestamp", &TIMESTAMP),
        one("frame_id", Text),
        one("id", Text),
        message("lifetime", &DURATION),
        one("frame_locked", Bool),
        messages("metadata", &KEY_VALUE_PAIR),
        messages("arrows", &ARROW),
        messages("cubes", &CUBE),
        messages("spheres", &SPHERE),
        messages("cylinders", &CYLINDER),
        messages("lines", &LINE),
        messages("triangles", &TRIANGLES),
        messages("texts", &TEXT),
        messages("models", &MODEL),
    ],
);
static DELETION: MessageType = MessageType {
    name: "foxglove.SceneEntityDeletion",
    fields: &[
        message("timestamp", &TIMESTAMP),
        one("type", Choice("Type")),
        one("id", Text),
    ],
    choices: &[("Type", &["MATCHING_ID", "ALL"])],
};

/// Things in the scene.
pub static SCENE_UPDATE: MessageType = plain(
    "foxglove.SceneUpdate",
    &[
        messages("deletions", &DELETION),
        messages("entities", &ENTITY),
    ],
);

static FRAME_TRANSFORM: MessageType = plain(
    "foxglove.FrameTransform",
    &[
        message("timestamp", &TIMESTAMP),
        one("parent_frame_id", Text),
        one("child_frame_id", Text),
        message("translation", &VECTOR3),
        message("rotation", &QUATERNION),
    ],
);

/// Where frames are.
pub static FRAME_TRANSFORMS: MessageType = plain(
    "foxglove.FrameTransforms",
    &[messages("transforms", &FRAME_TRANSFORM)],
);

static JOINT_STATE: MessageType = plain(
    "foxglove.JointState",
    &[
        one("name", Text),
        maybe("position", Double),
        maybe("velocity", Double),
        maybe("acceleration", Double),
        maybe("effort", Double),
    ],
);

/// Where joints are and how they move.
pub static JOINT_STATES: MessageType = plain(
    "foxglove.JointStates",
    &[
        message("timestamp", &TIMESTAMP),
        messages("joints", &JOINT_STATE),
    ],
);

/// Where something is.
pub static POSE_IN_FRAME: MessageType = plain(
    "foxglove.PoseInFrame",
    &[
        message("timestamp", &TIMESTAMP),
        one("frame_id", Text),
        message("pose", &POSE),
    ],
);

/// A line for people.
pub static LOG: MessageType = MessageType {
    name: "foxglove.Log",
    fields: &[
        message("timestamp", &TIMESTAMP),
        one("level", Choice("Level")),
        one("message", Text),
        one("name", Text),
        one("file", Text),
        one("line", Fixed32),
    ],
    choices: &[(
        "Level",
        &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"],
    )],
};

/// A task in one tick; a number that it does not have is absent.
pub static TASK: MessageType = plain(
    "conik.Task",
    &[
        maybe("value", Double),
        maybe("desired", Double),
        maybe("min", Double),
        maybe("max", Double),
        maybe("error", Double),
        maybe("active", Uint32),
    ],
);

/// What was decided, from one tick on.
pub static DECISION: MessageType = plain(
    "conik.Decision",
    &[
        maybe("mode", Uint64),
        one("active", Text),
        one("active_count", Uint32),
        one("waypoint", Uint32),
        one("why", Text),
    ],
);
