//! Every mistake in a scenario file is reported at its line, under its key, with what is wrong and
//! what would be right.

use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Mistake, Scenario};

/// A right scenario with every table, line by line; the cases below change one line each.
const GOOD: &str = r#"title = "good"
[robot]
model = "ur5-paper"
q0_deg = [-48, -158, -108, -90, -85, 0]
[control]
rate_hz = 125
duration_s = 60
mode_rule = "paper"
border = "freeze"
recursion = "chiaverini"
exclusive = [["a", "b"]]
[[task]]
name = "a"
type = "distance"
point_m = [0.40, -0.25, -0.33]
min = 0.18
[[task]]
name = "b"
type = "coordinate"
axis = "z"
max = 0.5
[[task]]
name = "p"
type = "position"
waypoints_m = [[0.486, -0.066, -0.250]]
acceptance_m = 0.02
gain_per_s = 0.3
[[task]]
name = "view"
type = "field_of_view"
direction = [1, 0, 0]
max = 0.26
gain_per_s = 1.0
[[task]]
name = "elbow"
type = "joint"
joint = "elbow_joint"
desired = -1.5
gain_per_s = 1
"#;

/// One mistake: the line of `GOOD` that is replaced, the key and line reported, and what the
/// message must contain.
struct Case {
    good: &'static str,
    bad: &'static str,
    key: &'static str,
    line: usize,
    says: &'static [&'static str],
}

const fn case(
    good: &'static str,
    bad: &'static str,
    key: &'static str,
    line: usize,
    says: &'static [&'static str],
) -> Case {
    Case {
        good,
        bad,
        key,
        line,
        says,
    }
}

const Q0: &str = "q0_deg = [-48, -158, -108, -90, -85, 0]";
/// The line after the start, for what may stand there besides.
const LIMITED: &str = "[control]";
const EXCLUSIVE: &str = r#"exclusive = [["a", "b"]]"#;
const WAYPOINTS: &str = "waypoints_m = [[0.486, -0.066, -0.250]]";
const POINT: &str = "point_m = [0.40, -0.25, -0.33]";

#[rustfmt::skip]
const CASES: &[Case] = &[
    // The file.
    case("title = \"good\"", "titel = \"x\"", "titel", 1, &["unknown key", "did you mean `title`?"]),
    case("title = \"good\"", "title = 3", "title", 1, &["expected text in quotes", "the number 3"]),
    case("title = \"good\"", "colour = 3", "colour", 1, &["unknown key", "`robot`, `control`, `ur`, `shape`, `obstacle`, `self_collision`, `task`"]),
    case("[control]", "[contol]", "contol", 5, &["did you mean `control`?"]),
    // [robot]
    case("model = \"ur5-paper\"", "model = \"ur6\"", "robot.model", 3, &["unknown robot \"ur6\"", "\"ur5-paper\""]),
    case("model = \"ur5-paper\"", "model = \"ur5_paper\"", "robot.model", 3, &["did you mean \"ur5-paper\""]),
    case("model = \"ur5-paper\"", "", "robot.model", 2, &["missing", "model = \"ur5-paper\""]),
    case("model = \"ur5-paper\"", "model = 5", "robot.model", 3, &["expected text"]),
    case("model = \"ur5-paper\"", "urdf = \"arm.urdf\"", "robot.urdf", 3, &["arm.urdf: cannot be read", "path of a URDF file"]),
    case(Q0, "", "robot.q0_deg", 2, &["missing", "q0_deg = ["]),
    case(Q0, "q0_deg = [1, 2, 3]", "robot.q0_deg", 4, &["has 6 joints, found 3 numbers", "wrist_3_joint"]),
    case(Q0, "q0_rad = [1, 2, 3, 4, 5, 6, 7]", "robot.q0_rad", 4, &["has 6 joints, found 7"]),
    case(Q0, "q0_deg = []", "robot.q0_deg", 4, &["has 6 joints, found 0"]),
    case(Q0, "q0_deg = 3", "robot.q0_deg", 4, &["a list of numbers, one for each joint"]),
    case(Q0, "q0_deg = [0, 0, \"x\", 0, 0, 0]", "robot.q0_deg[3]", 4, &["expected a number", "the text \"x\""]),
    case(Q0, "q0_deg = [0, 0, 0, nan, 0, 0]", "robot.q0_deg[4]", 4, &["not a finite number"]),
    case(Q0, "q0_rad = [-inf, 0, 0, 0, 0, 0]", "robot.q0_rad[1]", 4, &["-inf is not a finite number"]),
    case(Q0, "q0_rad = [0, 1e400, 0, 0, 0, 0]", "robot.q0_rad[2]", 4, &["not a finite number"]),
    case(Q0, "q0_rad = [0, 0, 0, 0, 0, 1001]", "robot.q0_rad[6]", 4, &["1001 is out of range", "from -1000 to 1000 rad"]),
    case(Q0, "q0_deg = [0, 0, 0, 0, 0, 0]\nq0_rad = [0, 0, 0, 0, 0, 0]", "robot.q0_rad", 5, &["both `q0_deg` and `q0_rad`"]),
    case(Q0, "q0 = [0, 0, 0, 0, 0, 0]\nq0_rad = [0, 0, 0, 0, 0, 0]", "robot.q0", 4, &["unknown key", "did you mean `q0_"]),
    case(LIMITED, "position_limits_deg = [[-1, 1]]\n[control]", "robot.position_limits_deg", 5, &["has 6 joints, found 1 pairs"]),
    case(LIMITED, "position_limits_deg = 90\n[control]", "robot.position_limits_deg", 5, &["a list of pairs of numbers"]),
    case(LIMITED, "position_limits_deg = [1, 2, 3, 4, 5, 6]\n[control]", "robot.position_limits_deg[1]", 5, &["a pair of numbers, or `[]`"]),
    case(LIMITED, "position_limits_rad = [[], [1], [], [], [], []]\n[control]", "robot.position_limits_rad[2]", 5, &["two numbers or none, found 1"]),
    case(LIMITED, "position_limits_rad = [[], [], [], [], [], [2, 1]]\n[control]", "robot.position_limits_rad[6]", 5, &["2 is greater than 1", "least position stands first"]),
    case(LIMITED, "position_limits_rad = [[], [], [], [0, nan], [], []]\n[control]", "robot.position_limits_rad[4][2]", 5, &["NaN"]),
    case(LIMITED, "speed_limits_deg_per_s = 0\n[control]", "robot.speed_limits_deg_per_s", 5, &["more than 0", "deg/s"]),
    case(LIMITED, "speed_limits_deg_per_s = [1, 2]\n[control]", "robot.speed_limits_deg_per_s", 5, &["has 6 joints, found 2 numbers"]),
    case(LIMITED, "speed_limits_deg_per_s = \"fast\"\n[control]", "robot.speed_limits_deg_per_s", 5, &["a number, or a list of numbers"]),
    case(LIMITED, "speed_limits_rad_per_s = [1, 1, -1, 1, 1, 1]\n[control]", "robot.speed_limits_rad_per_s[3]", 5, &["-1 is out of range"]),
    case(LIMITED, "acceleration_limits_rad_per_s2 = 4\nacceleration_limits_deg_per_s2 = 4\n[control]", "robot.acceleration_limits_rad_per_s2", 5, &["both `acceleration_limits_deg_per_s2` and"]),
    case(LIMITED, "acceleration_limit_rad_per_s2 = 4\n[control]", "robot.acceleration_limit_rad_per_s2", 5, &["did you mean `acceleration_limits_rad_per_s2`?"]),
    // [control]
    case("rate_hz = 125", "rate = 125", "control.rate", 6, &["did you mean `rate_hz`?"]),
    case("rate_hz = 125", "rate_hz = 0", "control.rate_hz", 6, &["0 is out of range", "from 1 to 10000 Hz"]),
    case("rate_hz = 125", "rate_hz = -125", "control.rate_hz", 6, &["-125 is out of range"]),
    case("rate_hz = 125", "rate_hz = 1e9", "control.rate_hz", 6, &["out of range"]),
    case("rate_hz = 125", "rate_hz = nan", "control.rate_hz", 6, &["NaN is not a finite number"]),
    case("rate_hz = 125", "rate_hz = \"125\"", "control.rate_hz", 6, &["expected a number", "rate_hz = 125"]),
    case("rate_hz = 125", "rate_hz = 99999999999999999999999999999999999999999999", "control.rate_hz", 6, &["not a finite number"]),
    case("rate_hz = 125", "rate_hz = true", "control.rate_hz", 6, &["expected a number, found true"]),
    case("duration_s = 60", "duration_s = 0", "control.duration_s", 7, &["more than 0, at most 86400 s"]),
    case("duration_s = 60", "duration_s = -1.5", "control.duration_s", 7, &["-1.5 is out of range"]),
    case("duration_s = 60", "duration_s = inf", "control.duration_s", 7, &["inf is not a finite number"]),
    case("duration_s = 60", "duration_s = 86401", "control.duration_s", 7, &["out of range"]),
    case("duration_s = 60", "duration_s = 0.0079", "control.duration_s", 7, &["0.0079 s are shorter than one control period at 125 Hz", "at least 0.008 s"]),
    case("duration_s = 60", "duration_s = nan", "control.duration_s", 7, &["not a finite number"]),
    case("duration_s = 60\n", "duration_s = 2024-01-01\n", "control.duration_s", 7, &["found a date or time"]),
    case("rate_hz = 125\nduration_s = 60", "rate_hz = 1000\nduration_s = 86400", "control.duration_s", 7, &["more than 50000000 ticks", "at most 50000 s"]),
    case("mode_rule = \"paper\"", "mode_rule = \"kone\"", "control.mode_rule", 8, &["unknown name \"kone\"", "\"paper\", \"border\", \"cone\""]),
    case("mode_rule = \"paper\"", "mode_rule = \"papre\"", "control.mode_rule", 8, &["did you mean \"paper\""]),
    case("mode_rule = \"paper\"", "mode_rule = 1", "control.mode_rule", 8, &["expected text"]),
    case("border = \"freeze\"", "border = \"lnad\"", "control.border", 9, &["did you mean \"land\"", "\"freeze\", \"land\""]),
    case("recursion = \"chiaverini\"", "recursion = \"siciliano\"", "control.recursion", 10, &["\"chiaverini\", \"siciliano-slotine\""]),
    case(EXCLUSIVE, "exclusive = [\"a\", \"b\"]", "control.exclusive[1]", 11, &["expected a list of task names", "[["]),
    case(EXCLUSIVE, "exclusive = 3", "control.exclusive", 11, &["a list of groups"]),
    case(EXCLUSIVE, "exclusive = [[\"a\", 3]]", "control.exclusive[1][2]", 11, &["expected text"]),
    case(EXCLUSIVE, "exclusive = [[\"a\"]]", "control.exclusive[1]", 11, &["at least two"]),
    case(EXCLUSIVE, "exclusive = [[]]", "control.exclusive[1]", 11, &["at least two"]),
    case(EXCLUSIVE, "exclusive = [[\"a\", \"a\"]]", "control.exclusive[1][2]", 11, &["\"a\" stands in this group twice"]),
    case(EXCLUSIVE, "exclusive = [[\"a\", \"veiw\"]]", "control.exclusive[1][2]", 11, &["there is no task \"veiw\"", "did you mean \"view\"?"]),
    case(EXCLUSIVE, "exclusive = [[\"view\", \"viev\"]]", "control.exclusive[1][2]", 11, &["there is no task \"viev\"", "the set-based tasks are: \"a\", \"b\", \"view\""]),
    case(EXCLUSIVE, "exclusive = [[\"a\", \"wall\"]]", "control.exclusive[1][2]", 11, &["the set-based tasks are: \"a\", \"b\", \"view\""]),
    case(EXCLUSIVE, "exclusive = [[\"a\", \"p\"]]", "control.exclusive[1][2]", 11, &["\"p\" is an equality task"]),
    // Names.
    case("name = \"view\"", "", "task[4].name", 28, &["missing"]),
    case("name = \"view\"", "name = 3", "task[4].name", 29, &["expected text"]),
    case("name = \"view\"", "name = \"\"", "task[4] \"\".name", 29, &["the name is empty"]),
    case("name = \"view\"", "name = \"my view\"", "task[4] \"my view\".name", 29, &["' ' cannot stand", "\"my_view\""]),
    case("name = \"view\"", "name = \"a+b\"", "task[4] \"a+b\".name", 29, &["'+' cannot stand"]),
    case("name = \"view\"", "name = \"größe\"", "task[4] \"größe\".name", 29, &["'ö' cannot stand"]),
    case("name = \"view\"", "name = \"p\"", "task[4] \"p\".name", 29, &["task[3] \"p\" has this name already"]),
    case("name = \"view\"", "name = \"p_error\"", "task[4] \"p_error\".name", 29, &["the log's column for the error of task \"p\""]),
    case("name = \"view\"", "name = \"t_s\"", "task[4] \"t_s\".name", 29, &["a column of the log", "\"task_t_s\""]),
    case("name = \"view\"", "name = \"waypoint\"", "task[4] \"waypoint\".name", 29, &["a column of the log"]),
    case("name = \"view\"", "name = \"q17_rad\"", "task[4] \"q17_rad\".name", 29, &["a column of the log"]),
    case("name = \"view\"", "name = \"qd1_rad_s\"", "task[4] \"qd1_rad_s\".name", 29, &["a column of the log"]),
    case("name = \"view\"", "name = \"qdd1_rad_s2\"", "task[4] \"qdd1_rad_s2\".name", 29, &["a column of the log"]),
    case("name = \"view\"", "name = \"q3_measured_rad\"", "task[4] \"q3_measured_rad\".name", 29, &["a column of the log"]),
    case("name = \"view\"", "name = \"why\"", "task[4] \"why\".name", 29, &["a column of the log"]),
    case("name = \"view\"", "name = \"limit/elbow_joint\"", "task[4] \"limit/elbow_joint\".name", 29, &["belong to the joints' position limits", "\"limit_elbow_joint\""]),
    // Types and their keys.
    case("type = \"distance\"", "", "task[1] \"a\".type", 12, &["missing"]),
    case("type = \"distance\"", "type = \"distanec\"", "task[1] \"a\".type", 14, &["unknown task type", "did you mean \"distance\"?", "\"joint\""]),
    case("type = \"field_of_view\"", "type = \"fieldOfView\"", "task[4] \"view\".type", 30, &["did you mean \"field_of_view\"?"]),
    case(POINT, "", "task[1] \"a\".point_m", 12, &["missing", "point_m = [0.40"]),
    case(POINT, "point_m = [1, 2]", "task[1] \"a\".point_m", 15, &["three numbers", "found 2"]),
    case(POINT, "point_m = [1, 2, nan]", "task[1] \"a\".point_m[3]", 15, &["NaN"]),
    case(POINT, "point_m = [1, 2, 1e300]", "task[1] \"a\".point_m[3]", 15, &["1e300 is out of range"]),
    case(POINT, "point_m = { x = 1 }", "task[1] \"a\".point_m", 15, &["found a table"]),
    case("min = 0.18", "min = 0.18\nvelocity_m_per_s = 0.2", "task[1] \"a\".velocity_m_per_s", 17, &["a list of three numbers"]),
    case("min = 0.18", "min = 0.18\nvelocity_m_per_s = [0, inf, 0]", "task[1] \"a\".velocity_m_per_s[2]", 17, &["inf"]),
    case("min = 0.18", "min = 0.18\nmoves_until_s = 4", "task[1] \"a\".moves_until_s", 17, &["nothing moves", "velocity_m_per_s = ["]),
    case("min = 0.18", "min = 0.18\nvelocity_m_per_s = [0, 1, 0]\nmoves_until_s = -4", "task[1] \"a\".moves_until_s", 18, &["out of range"]),
    case("axis = \"z\"", "axis = \"z\"\nvelocity_m_per_s = [0, 1, 0]", "task[2] \"b\".velocity_m_per_s", 21, &["a key of type \"position\", not of \"coordinate\""]),
    case("axis = \"z\"", "axis = \"w\"", "task[2] \"b\".axis", 20, &["\"x\", \"y\", \"z\""]),
    case("axis = \"z\"", "", "task[2] \"b\".axis", 17, &["missing"]),
    case("axis = \"z\"", "axis = \"z\"\ndirection = [1, 0, 0]", "task[2] \"b\".direction", 21, &["a key of type \"field_of_view\", not of \"coordinate\""]),
    case("direction = [1, 0, 0]", "direction = [0, 0.0, 0]", "task[4] \"view\".direction", 31, &["zero vector", "[1, 0, 0]"]),
    case("direction = [1, 0, 0]", "direction = [inf, 0, 0]", "task[4] \"view\".direction[1]", 31, &["inf"]),
    case("joint = \"elbow_joint\"", "joint = 7", "task[5] \"elbow\".joint", 37, &["no joint 7", "1 to 6", "elbow_joint"]),
    case("joint = \"elbow_joint\"", "joint = 0", "task[5] \"elbow\".joint", 37, &["no joint 0"]),
    case("joint = \"elbow_joint\"", "joint = 1.5", "task[5] \"elbow\".joint", 37, &["no joint 1.5"]),
    case("joint = \"elbow_joint\"", "joint = \"elbow\"", "task[5] \"elbow\".joint", 37, &["did you mean \"elbow_joint\"?"]),
    case("joint = \"elbow_joint\"", "joint = [1]", "task[5] \"elbow\".joint", 37, &["the number of a joint or its name"]),
    // Goals.
    case("min = 0.18", "", "task[1] \"a\"", 12, &["nothing is asked", "`min` and/or `max`"]),
    case("min = 0.18", "mim = 0.18\nmax = 1", "task[1] \"a\".mim", 16, &["did you mean `min`?"]),
    case("min = 0.18", "min = 0.3\nmax = 0.2", "task[1] \"a\".min", 16, &["min 0.3 is greater than max 0.2", "exchange"]),
    case("min = 0.18", "max = -0.1", "task[1] \"a\".max", 16, &["out of reach", "never below 0"]),
    case("min = 0.18", "min = inf", "task[1] \"a\".min", 16, &["inf is not a finite number"]),
    case("min = 0.18", "min = 0.18\ngain_per_s = 0", "task[1] \"a\".gain_per_s", 17, &["more than 0"]),
    case("min = 0.18", "min = 0.18\ntarget_m = [1, 2, 3]", "task[1] \"a\".target_m", 17, &["its value is one number", "\"position\""]),
    case("max = 0.26\n", "min = 2.5\n", "task[4] \"view\".min", 32, &["out of reach", "from 0 to 2"]),
    case("gain_per_s = 1.0", "", "task[4] \"view\".gain_per_s", 28, &["low priority and needs a gain", "task[3] \"p\""]),
    case("desired = -1.5", "desired = -1.5\nmin = -2", "task[5] \"elbow\".desired", 38, &["both a `desired` value and `min`"]),
    case("desired = -1.5", "desired = \"up\"", "task[5] \"elbow\".desired", 38, &["expected a number"]),
    case("gain_per_s = 1\n", "", "task[5] \"elbow\".gain_per_s", 34, &["missing: an equality task needs a gain"]),
    case("gain_per_s = 1\n", "gain_per_s = 250\n", "task[5] \"elbow\".gain_per_s", 39, &["unstable at 125 Hz", "less than 250"]),
    case("gain_per_s = 1\n", "gain_per_s = -1\n", "task[5] \"elbow\".gain_per_s", 39, &["more than 0"]),
    case("gain_per_s = 1\n", "gain = 1\ngain_per_s = 1\n", "task[5] \"elbow\".gain", 39, &["did you mean `gain_per_s`?"]),
    case("min = 0.18", "min = 0.18\nrecovery_per_s = 0", "task[1] \"a\".recovery_per_s", 17, &["more than 0"]),
    case("desired = -1.5", "desired = -1.5\nrecovery_per_s = 1", "task[5] \"elbow\".recovery_per_s", 39, &["equality task", "`gain_per_s`"]),
    case("max = 0.26\n", "max = 0.26\nrecovery_per_s = 1\n", "task[4] \"view\".recovery_per_s", 33, &["low priority", "task[3] \"p\"", "move the task above"]),
    case("acceptance_m = 0.02", "acceptance_m = 0.02\nrecovery_per_s = 1", "task[3] \"p\".recovery_per_s", 27, &["cannot be a set"]),
    // Damping.
    case("desired = -1.5", "desired = -1.5\ndamping = \"per_direction\"", "task[5] \"elbow\".damping", 39, &["unknown name \"per_direction\"", "did you mean \"per-direction\"?", "or a number, from 0"]),
    case("desired = -1.5", "desired = -1.5\ndamping = \"smalest\"", "task[5] \"elbow\".damping", 39, &["did you mean \"smallest\"?"]),
    case("desired = -1.5", "desired = -1.5\ndamping = \"0.1\"", "task[5] \"elbow\".damping", 39, &["known: \"automatic\", \"none\", \"smallest\", \"per-direction\"", "or a number"]),
    case("desired = -1.5", "desired = -1.5\ndamping = smallest", "task[5].damping", 39, &["write \"smallest\""]),
    case("desired = -1.5", "desired = -1.5\ndamping = -0.1", "task[5] \"elbow\".damping", 39, &["-0.1 is out of range", "from 0 to 1000000 unit/rad"]),
    case("desired = -1.5", "desired = -1.5\ndamping = 1e7", "task[5] \"elbow\".damping", 39, &["out of range"]),
    case("desired = -1.5", "desired = -1.5\ndamping = nan", "task[5] \"elbow\".damping", 39, &["NaN is not a finite number"]),
    case("desired = -1.5", "desired = -1.5\ndamping = inf", "task[5] \"elbow\".damping", 39, &["inf is not a finite number"]),
    case("desired = -1.5", "desired = -1.5\ndamping = false", "task[5] \"elbow\".damping", 39, &["expected text in quotes, or a number, found false", "damping = \"per-direction\""]),
    case("desired = -1.5", "desired = -1.5\ndampign = 0.1", "task[5] \"elbow\".dampign", 39, &["did you mean `damping`?"]),
    case("min = 0.18", "min = 0.18\ndamping = \"automatic\"", "task[1] \"a\".damping", 17, &["a set above every equality task has high priority", "remove it"]),
    case("max = 0.5", "max = 0.5\ndamping = 0.1", "task[2] \"b\".damping", 22, &["kept, never damped"]),
    // Positions.
    case(WAYPOINTS, "waypoints_m = []", "task[3] \"p\".waypoints_m", 25, &["the list is empty"]),
    case(WAYPOINTS, "waypoints_m = [0.4, 0.1, 0.2]", "task[3] \"p\".waypoints_m[1]", 25, &["a list of three numbers"]),
    case(WAYPOINTS, "waypoints_m = [[1, 2, 3], [1, 2]]", "task[3] \"p\".waypoints_m[2]", 25, &["three numbers", "found 2"]),
    case(WAYPOINTS, "waypoints_m = [[1, 2, nan]]", "task[3] \"p\".waypoints_m[1][3]", 25, &["NaN"]),
    case(WAYPOINTS, "waypoints_m = [[1, 2, 3]]\ntarget_m = [1, 2, 3]", "task[3] \"p\".target_m", 26, &["both `waypoints_m` and `target_m`"]),
    case(WAYPOINTS, "target_m = [1, 2, 3]", "task[3] \"p\".acceptance_m", 26, &["there are none"]),
    case("waypoints_m = [[0.486, -0.066, -0.250]]\nacceptance_m = 0.02", "", "task[3] \"p\"", 22, &["nothing is asked", "`target_m`"]),
    case("waypoints_m = [[0.486, -0.066, -0.250]]\nacceptance_m = 0.02", "min = 0.1", "task[3] \"p\".min", 25, &["cannot be a set", "\"coordinate\"", "\"distance\""]),
    case("waypoints_m = [[0.486, -0.066, -0.250]]\nacceptance_m = 0.02", "desired = 0.1", "task[3] \"p\".desired", 25, &["no single `desired`", "target_m = ["]),
    case("acceptance_m = 0.02", "", "task[3] \"p\".acceptance_m", 22, &["missing"]),
    case("acceptance_m = 0.02", "acceptance_m = 0", "task[3] \"p\".acceptance_m", 26, &["more than 0"]),
    case("acceptance_m = 0.02", "acceptance_m = -1", "task[3] \"p\".acceptance_m", 26, &["more than 0"]),
    case("[[task]]\nname = \"view\"", "[[task]]\nname = \"p2\"\ntype = \"position\"\nwaypoints_m = [[1, 2, 3]]\nacceptance_m = 1\ngain_per_s = 1\n[[task]]\nname = \"view\"", "task[4] \"p2\".waypoints_m", 31, &["task[3] \"p\" has waypoints already"]),
    // Syntax.
    case("rate_hz = 125", "rate_hz 125", "control", 6, &["not valid TOML"]),
    case("rate_hz = 125", "rate_hz = 125Hz", "control.rate_hz", 6, &["a number stands without unit"]),
    case("mode_rule = \"paper\"", "mode_rule = paper", "control.mode_rule", 8, &["quoted", "write \"paper\""]),
    case("rate_hz = 125", "rate_hz = 125\nrate_hz = 500", "control.rate_hz", 7, &["duplicate key", "once"]),
    case("min = 0.18", "min = 0.18\nmin = 0.2", "task[1].min", 17, &["duplicate key"]),
    case("[control]", "[control", "control", 5, &["not valid TOML", "unclosed"]),
    case("title = \"good\"", "title = \"good", "title", 1, &["not valid TOML"]),
    case("title = \"good\"", "title = \"go\u{0}od\"", "title", 1, &["not valid TOML"]),
];

fn mistakes(text: &str) -> Vec<Mistake> {
    match Scenario::from_toml(text) {
        Ok(_) => vec![],
        Err(errors) => errors.mistakes().to_vec(),
    }
}

#[test]
fn the_scenario_that_the_cases_spoil_is_right() {
    assert_eq!(mistakes(GOOD), []);
}

#[test]
fn each_mistake_is_named_placed_and_explained() {
    let mut failures = vec![];
    for case in CASES {
        assert!(
            GOOD.contains(case.good),
            "{:?} is not in the scenario",
            case.good
        );
        let text = GOOD.replacen(case.good, case.bad, 1);
        let found = mistakes(&text);
        let reported = found
            .iter()
            .find(|m| m.key == case.key && m.line == case.line);
        let complete = reported.is_some_and(|mistake| {
            let message = mistake.to_string();
            case.says.iter().all(|part| message.contains(part))
        });
        if !complete {
            let found: Vec<_> = found.iter().map(Mistake::to_string).collect();
            failures.push(format!(
                "{:?} at {} line {}: {found:#?}",
                case.bad, case.key, case.line
            ));
        }
    }
    assert!(
        failures.is_empty(),
        "{} of {}:\n{}",
        failures.len(),
        CASES.len(),
        failures.join("\n")
    );
}

#[test]
fn one_mistake_gives_one_message() {
    for case in CASES {
        let found = mistakes(&GOOD.replacen(case.good, case.bad, 1));
        // A misspelt or misplaced key is two mistakes where the right key is then missing; an
        // undone task takes its name out of the groups.
        let follows =
            |m: &Mistake| m.what.starts_with("missing") || m.what.contains("nothing is asked");
        let own = found.iter().filter(|m| !follows(m)).count();
        assert!(own <= 1, "{:?}: {found:#?}", case.bad);
    }
}

#[test]
fn all_independent_mistakes_are_reported_in_the_order_of_the_file() {
    let text = GOOD
        .replace("rate_hz = 125", "rate = 125")
        .replace("min = 0.18", "min = nan")
        .replace("model = \"ur5-paper\"", "model = \"kuka\"")
        .replace("desired = -1.5", "desired = true");
    let found = mistakes(&text);
    let keys: Vec<_> = found.iter().map(|mistake| mistake.key.as_str()).collect();
    let expected = [
        "robot.model",
        "control.rate",
        "task[1] \"a\".min",
        "task[5] \"elbow\".desired",
    ];
    assert_eq!(keys, expected);
}

#[test]
fn several_duplicate_keys_are_all_reported() {
    let text = GOOD
        .replace("rate_hz = 125", "rate_hz = 125\nrate_hz = 125")
        .replace("axis = \"z\"", "axis = \"z\"\naxis = \"z\"");
    let found = mistakes(&text);
    let keys: Vec<_> = found.iter().map(|mistake| mistake.key.as_str()).collect();
    assert_eq!(keys, ["control.rate_hz", "task[2].axis"]);
}

#[test]
fn spans_point_at_the_value_or_the_key() {
    let text = GOOD
        .replace("rate_hz = 125", "rate_hz = -1")
        .replace("title", "titel");
    let found = mistakes(&text);
    let pieces: Vec<_> = found
        .iter()
        .map(|mistake| &text[mistake.span.clone()])
        .collect();
    assert_eq!(pieces, ["titel", "-1"]);
    assert_eq!((found[1].line, found[1].column), (6, 11));
}

#[test]
fn missing_tables_are_reported() {
    let keys = |text: &str| -> Vec<_> { mistakes(text).into_iter().map(|m| m.key).collect() };
    assert_eq!(keys(""), ["robot", "task"]);
    assert_eq!(
        keys("task = []\n[robot]\nmodel = \"ur5-paper\"\nq0_rad = [0, 0, 0, 0, 0, 0]"),
        ["task"]
    );
    let found = mistakes(
        "[robot]\nmodel = \"ur5-paper\"\nq0_rad = [0, 0, 0, 0, 0, 0]\n[task]\nname = \"a\"\n",
    );
    assert!(found[0].help.contains("[[task]]"), "{found:?}");
}

/// `GOOD`, with tasks besides its five until there are so many.
fn with_so_many(tasks: usize, is_set: impl Fn(usize) -> bool) -> String {
    let task = |i| {
        let goal = if is_set(i) { "min" } else { "desired" };
        format!(
            "[[task]]\nname = \"s{i}\"\ntype = \"joint\"\njoint = 1\n{goal} = 0\ngain_per_s = 1\n"
        )
    };
    let added: Vec<_> = (5..tasks).map(task).collect();
    GOOD.to_owned() + &added.concat()
}

/// Refused at the header of the last task, in one message that has these parts; the controller
/// cannot be made either, and with one task less it can.
fn assert_one_too_many(tasks: usize, limits: &str, parts: &[&str]) {
    let limited = |tasks| with_so_many(tasks, |i| i % 2 == 0).replacen("[control]", limits, 1);
    let most = Scenario::from_toml(&limited(tasks - 1)).expect("so many may be");
    let experiment = Experiment::new(&most).expect("it can be run");
    assert_eq!(experiment.controller.stack().len(), conik::MAX_TASKS);
    let text = limited(tasks);
    let found = mistakes(&text);
    assert_eq!(found.len(), 1, "{found:?}");
    let name = format!("task[{tasks}] \"s{}\"", tasks - 1);
    assert_eq!(found[0].key, name);
    let header = text.rfind("[[task]]").expect("there are tasks");
    assert_eq!(found[0].span.start, header);
    let message = found[0].to_string();
    for part in parts {
        assert!(message.contains(part), "{part}: {message}");
    }
}

#[test]
fn more_tasks_than_the_controller_has_are_refused() {
    assert_one_too_many(
        257,
        "[control]",
        &["257 tasks are too many", "a scenario has at most 256"],
    );
    assert_one_too_many(
        255,
        "position_limits_deg = [[-180, 180], [], [-180, 180], [], [], []]\n[control]",
        &[
            "255 tasks are too many",
            "2 of them keep",
            "position limits",
            "at most 254",
        ],
    );
}

#[test]
fn many_tasks_too_many_are_one_mistake() {
    for is_set in [true, false] {
        let found = mistakes(&with_so_many(1000, |_| is_set));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].key, "task[257] \"s256\"");
        assert!(
            found[0].what.contains("1000 tasks are too many"),
            "{found:?}"
        );
    }
}

#[test]
fn a_thousand_mistakes_print_a_page() {
    let task = |i| format!("[[task]]\nk{i} = 1\n");
    let text = (0..1000).map(task).collect::<Vec<_>>().concat();
    let errors = Scenario::from_toml(&text).expect_err("no task is right");
    assert!(errors.more() > 900);
    assert!(errors.to_string().len() < 20_000);
}

/// What is put before the task and into it, and what the message must contain.
const UNFIT: &[(&str, &str, &[&str])] = &[
    (
        "",
        "frame = \"tool0\"\nrelative_to = \"tool0\"",
        &[
            "line 6, column 1: task[1] \"p\": no joint is between",
            "change the links",
        ],
    ),
    (
        "",
        "frame = \"base_link\"",
        &["line 6, column 1: task[1] \"p\": no joint is between"],
    ),
    (
        "[[shape]]\nname = \"limit\"\nlink = \"tool0\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\n\
         radius_m = 0.1\n[[obstacle]]\nname = \"elbow_joint\"\ntype = \"sphere\"\n\
         center_m = [9, 9, 9]\nradius_m = 1\ndistance_m = 0.1\n",
        "",
        &[
            "shape: \"limit/elbow_joint\" would be the name",
            "another name",
        ],
    ),
    (
        "",
        "frame = \"tool\"",
        &["no link \"tool\"", "leave `frame` out"],
    ),
    (
        "",
        "relative_to = \"world\"",
        &["no link \"world\"", "leave `relative_to` out"],
    ),
];

fn fitted(robot: &str, before: &str, task: &str) -> String {
    format!(
        "[robot]\nmodel = \"ur5e\"\nq0_deg = [0, -90, 90, 0, 90, 0]\n{robot}\n{before}\n[[task]]\n\
         name = \"p\"\ntype = \"position\"\ntarget_m = [0.4, 0.1, 0.3]\ngain_per_s = 1\n{task}\n"
    )
}

#[test]
fn what_does_not_fit_the_robot_is_named_with_its_place() {
    Scenario::from_toml(&fitted("", "", "")).expect("it is right");
    for (before, task, says) in UNFIT {
        let errors = Scenario::from_toml(&fitted("", before, task)).expect_err("it is wrong");
        let message = errors.to_string();
        for part in *says {
            assert!(message.contains(part), "{part}: {message}");
        }
    }
}

#[test]
fn the_tip_of_a_tool_with_an_offset_is_a_link() {
    let offset = "tool_offset_m = [0, 0, 0.1]";
    let seen_from_it = "frame = \"link_2\"\nrelative_to = \"tool\"";
    let scenario = Scenario::from_toml(&fitted(offset, "", seen_from_it)).expect("it is right");
    Experiment::new(&scenario).expect("it can be run");
    Scenario::from_toml(&fitted("", "", seen_from_it)).expect_err("there is no tip");
}

#[test]
fn names_that_no_table_has_room_for_are_refused() {
    let text = |name: &str| {
        format!(
            "[robot]\nmodel = \"ur5e\"\nq0_deg = [0, -90, 90, 0, 0, 0]\n[[task]]\nname = \"{name}\"\n\
             type = \"height\"\ndesired = 0.3\ngain_per_s = 1\n"
        )
    };
    assert!(Scenario::from_toml(&text(&"n".repeat(200))).is_ok());
    let error = Scenario::from_toml(&text(&"n".repeat(201))).expect_err("too long");
    let error = error.to_string();
    assert!(
        error.contains("the name has 201 characters; take a shorter one, of at most 200"),
        "{error}"
    );
}
