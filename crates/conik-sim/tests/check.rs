//! What a look at a scenario finds doubtful, before anything moves.

use conik_sim::check::find;
use conik_sim::experiment::Experiment;
use conik_sim::scenario::Scenario;

/// A scenario with a ball that the tool, at (0.2546, -0.4564, -0.2319) m, starts outside of.
const SOUND: &str = r#"
[robot]
model = "ur5-paper"
q0_deg = [-48, -158, -108, -90, -85, 0]
speed_limits_rad_per_s = 1
[[task]]
name = "ball"
type = "distance"
point_m = [0.25, 0.2, -0.23]
min = 0.1
[[task]]
name = "position"
type = "position"
target_m = [0.25, -0.45, -0.23]
gain_per_s = 1
"#;

fn doubts(good: &str, other: &str) -> Vec<String> {
    assert!(SOUND.contains(good), "{good}");
    let scenario = Scenario::from_toml(&SOUND.replace(good, other)).expect("it is right");
    let experiment = Experiment::new(&scenario).expect("it is right");
    find(&scenario, &experiment).doubts
}

/// The one doubt, in which each part stands.
fn assert_doubted(good: &str, other: &str, parts: &[&str]) {
    let doubts = doubts(good, other);
    assert_eq!(doubts.len(), 1, "{other}: {doubts:?}");
    for part in parts {
        assert!(doubts[0].contains(part), "{part}: {doubts:?}");
    }
}

#[test]
fn sound_scenario_is_not_doubtful() {
    assert_eq!(doubts("min", "min"), [""; 0]);
}

#[test]
fn start_outside_a_set_is_doubted_with_and_without_recovery() {
    let outside = "point_m = [0.25, -0.4, -0.23]";
    let point = "point_m = [0.25, 0.2, -0.23]";
    let doubts_of = |other: &str| doubts(point, other);
    // The target is in the ball too; that is another doubt.
    let without = doubts_of(outside);
    assert!(without[0].contains("never driven in"), "{without:?}");
    assert!(without[0].contains("`recovery_per_s` would"), "{without:?}");
    let with = doubts_of(&format!("{outside}\nrecovery_per_s = 0.05"));
    assert!(with[0].contains("it is driven in at 0.05 m/s"), "{with:?}");
    assert!(!with[0].contains("never"), "{with:?}");
}

#[test]
fn start_outside_position_limits_is_doubted() {
    assert_doubted(
        "speed_limits_rad_per_s = 1",
        "position_limits_deg = [[], [], [-90, 90], [], [], []]",
        &["`limit/elbow_joint` starts 0.3142 outside the position limits of elbow_joint"],
    );
}

#[test]
fn obstacle_is_doubted_that_is_faster_than_the_tool() {
    let point = "point_m = [0.25, 0.2, -0.23]";
    let moving = |speed: &str| format!("{point}\nvelocity_m_per_s = [0, {speed}, 0]");
    assert_eq!(doubts(point, &moving("-0.2")), [""; 0]);
    assert_eq!(doubts(point, &moving("0")), [""; 0], "at rest");
    assert_doubted(
        point,
        &moving("-9"),
        &["`ball` moves at 9.000 m/s", "the tool can move"],
    );
}

#[test]
fn target_in_an_obstacle_is_doubted_where_that_comes_to_rest() {
    let point = "point_m = [0.25, 0.2, -0.23]";
    let moving = "velocity_m_per_s = [0, -0.2, 0]";
    assert_eq!(
        doubts(point, &format!("{point}\n{moving}")),
        [""; 0],
        "it goes on"
    );
    assert_doubted(
        point,
        &format!("{point}\n{moving}\nmoves_until_s = 3"),
        &["the target of `position` is 0.0500 m from the point of `ball`"],
    );
}

#[test]
fn start_at_a_singularity_is_doubted_where_nothing_is_damped() {
    let gain = "gain_per_s = 1";
    let none = "gain_per_s = 1\ndamping = \"none\"";
    assert_eq!(doubts(gain, none), [""; 0], "the arm is bent");
    let stretched = |goal: &str| {
        let text = SOUND
            .replace("-158, -108, -90, -85", "-60, 0, 0, -85")
            .replace(gain, goal);
        let scenario = Scenario::from_toml(&text).expect("it is right");
        let experiment = Experiment::new(&scenario).expect("it is right");
        find(&scenario, &experiment).doubts
    };
    let found = stretched(none);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].contains("hardly moves `position`") && found[0].contains("\"none\""),
        "{found:?}"
    );
    for damped in [gain, "gain_per_s = 1\ndamping = 0.1"] {
        assert_eq!(stretched(damped), [""; 0], "{damped}");
    }
}

#[test]
fn a_first_task_that_no_joint_moves_is_not_said_to_depend_on_others() {
    let first = "type = \"position\"\ntarget_m = [0.25, -0.45, -0.23]";
    let pan = "type = \"joint\"\njoint = 1\ndesired = 0";
    let again = format!("{pan}\ngain_per_s = 1\n[[task]]\nname = \"again\"\n{pan}");
    let doubts_of = |other: &str| doubts(first, other);
    let doubts = doubts_of(&again);
    let of_second = "`again` depends on the equality tasks above";
    assert!(
        doubts.iter().any(|doubt| doubt.contains(of_second)),
        "{doubts:?}"
    );
    // Two joints move the end of the upper arm, on a sphere.
    let doubts = doubts_of(&format!("{first}\nframe = \"link_2\""));
    let of_first = "no joint motion moves `position` in one of its directions";
    assert!(
        doubts.iter().any(|doubt| doubt.contains(of_first)),
        "{doubts:?}"
    );
    assert!(
        !doubts.iter().any(|doubt| doubt.contains("depends")),
        "{doubts:?}"
    );
}

#[test]
fn an_elbow_set_with_half_a_turn_inside_is_doubted() {
    let ball = "type = \"distance\"\npoint_m = [0.25, 0.2, -0.23]\nmin = 0.1";
    let elbow = |bounds: &str| {
        format!(
            "type = \"elbow\"\nshoulder = \"link_1\"\nelbow = \"link_2\"\nwrist = \"link_4\"\n\
             direction = [0, 0, 1]\n{bounds}"
        )
    };
    let is_doubted = |bounds: &str| {
        let doubts = doubts(ball, &elbow(bounds));
        doubts
            .iter()
            .any(|doubt| doubt.contains("half a turn inside"))
    };
    for bounds in [
        "min = -3",
        "max = 3",
        "min = 3\nmax = 3.3",
        "min = -4\nmax = 3",
    ] {
        assert!(is_doubted(bounds), "{bounds}");
    }
    assert!(!is_doubted("min = -3.1\nmax = 3.1"));
}

#[test]
fn self_collision_of_neighbours_alone_is_doubted() {
    let own = |link: &str| {
        format!(
            "[[shape]]\nname = \"a\"\nlink = \"link_2\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\nradius_m = 0.05\n\
             [[shape]]\nname = \"b\"\nlink = \"{link}\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\nradius_m = 0.05\n\
             [self_collision]\ndistance_m = 0.01\n[[task]]\nname = \"ball\""
        )
    };
    let task = "[[task]]\nname = \"ball\"";
    assert_doubted(
        task,
        &own("link_3"),
        &["`self_collision` keeps nothing apart"],
    );
    assert_eq!(doubts(task, &own("link_4")), [""; 0]);
}
