//! What a description says and the robot does not show is noted, with its line; what belongs to others
//! is left alone.

use conik::JointKind;
use conik_urdf::{Described, Options, read};

/// A sound arm about which nothing is to be said, of which each case changes one thing.
const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm" xmlns:drake="http://drake.mit.edu">
  <link name="base"/>
  <link name="upper"/>
  <link name="lower"/>
  <joint name="turn" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <origin xyz="0 0 0.3" rpy="0 0 1.5"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" velocity="3" effort="40"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="upper"/>
    <child link="lower"/>
    <axis xyz="1 0 0"/>
    <limit lower="0" upper="0.5" velocity="1" effort="9"/>
  </joint>
</robot>
"#;

fn described(text: &str) -> Described {
    read(text, &Options::default()).expect("it is right")
}

fn notes(text: &str) -> Vec<String> {
    let notes = described(text).notes;
    notes.iter().map(ToString::to_string).collect()
}

#[test]
fn of_a_plain_arm_there_is_nothing_to_note() {
    assert_eq!(notes(ARM), [""; 0]);
}

/// What is replaced, by what, and how the only note begins.
#[rustfmt::skip]
const CASES: &[(&str, &str, &str)] = &[
    ("<origin xyz", "<orgin xyz", "line 9: \"orgin\": no element of `<joint>` in URDF"),
    ("rpy=\"0 0 1.5\"", "ypr=\"0 0 1.5\"", "line 9: \"ypr\": no attribute of `<origin>`"),
    ("velocity=\"3\"", "velocity=\"3\" speed=\"2\"", "line 11: \"speed\": no attribute of `<limit>`"),
    ("<link name=\"lower\"/>", "<link name=\"lower\"><link name=\"hand\"/></link>", "line 5: \"link\": no element of `<link>`"),
    ("</robot>", "<property name=\"a\"/><property name=\"b\"/></robot>", "line 19: \"property\": no element of `<robot>`"),
    ("effort=\"40\"/>", "effort=\"40\"/><drake:limit acceleration=\"1\"/>", "line 11: \"drake:limit\": what has a prefix"),
    ("</robot>", "<drake:joint name=\"bush\" type=\"ball\"/></robot>", "line 19: \"drake:joint\": what has a prefix"),
    ("<axis xyz=\"0 0 1\"/>", "", "line 6: \"turn\": no `<axis>`"),
    ("<axis xyz=\"1 0 0\"/>", "<axis/>", "line 16: \"slide\": `<axis>` without `xyz`"),
    ("lower=\"-1\" upper=\"2\"", "lower=\"-170\" upper=\"170\"", "line 6: \"turn\": its position limits are taken as radians"),
    ("upper=\"0.5\"", "upper=\"500\"", "line 13: \"slide\": its position limits are taken as metres"),
    ("velocity=\"3\"", "velocity=\"180\"", "line 6: \"turn\": its velocity limit is taken as radians"),
    ("velocity=\"1\"", "velocity=\"250\"", "line 13: \"slide\": its velocity limit is taken as metres"),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0 300\"", "line 6: \"turn\": the `xyz` of its origin is taken as metres"),
    ("rpy=\"0 0 1.5\"", "rpy=\"0 0 -90\"", "line 6: \"turn\": the `rpy` of its origin is taken as radians"),
    ("type=\"revolute\"", "type=\"continuous\"", "line 11: \"turn\": `lower` and `upper` are left out"),
    ("upper=\"2\"", "upper=\"1e16\"", "line 11: \"turn\": immense `lower` or `upper`"),
    ("velocity=\"3\"", "velocity=\"1e16\"", "line 11: \"turn\": immense `velocity`"),
    ("velocity=\"3\"", "velocity=\"3\" acceleration=\"-3\"", "line 11: \"turn\": `acceleration` is not above 0"),
    ("velocity=\"3\"", "velocity=\"3\" jerk=\"3\"", "line 11: \"turn\": `jerk` is left out"),
    ("<axis xyz=\"1 0 0\"/>", "<axis xyz=\"1 0 0\"/><dynamics damping=\"2\"/>", "line 16: \"dynamics\": damping and friction"),
    ("<axis xyz=\"1 0 0\"/>", "<axis xyz=\"1 0 0\"/><mimic joint=\"turn\" multiplier=\"0\" offset=\"4\"/>", "line 13: \"slide\": its position limits are left out"),
];

#[test]
fn what_is_not_taken_as_it_stands_is_noted_once() {
    let mut wrong = Vec::new();
    for (good, changed, begins) in CASES {
        assert!(ARM.contains(good), "{good}");
        let found = notes(&ARM.replacen(good, changed, 1));
        if found.len() != 1 || !found[0].starts_with(begins) {
            wrong.push(format!("{changed}: {begins}: {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_follows_a_fixed_joint_is_held_and_said_to_be() {
    let text = ARM.replace("revolute", "fixed").replace(
        "</robot>",
        "<link name=\"hand\"/><joint name=\"wrist\" type=\"revolute\"><parent link=\"lower\"/>\
         <child link=\"hand\"/><axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"1\" velocity=\"1\"/>\
         <mimic joint=\"turn\" offset=\"0.5\"/></joint></robot>",
    );
    let found = described(&text);
    assert_eq!(found.robot.dof(), 1);
    assert_eq!(found.robot.joints()[0].kind, JointKind::Prismatic);
    let held = "\"wrist\": held: what it follows does not move";
    let notes: Vec<String> = found.notes.iter().map(ToString::to_string).collect();
    assert!(notes[0].ends_with(held), "{notes:?}");
}

#[test]
fn accelerations_of_followers_narrow_that_of_their_leader() {
    let limits = |text: &str| described(text).robot.joints()[0].limits;
    let own = ARM.replace("velocity=\"3\"", "acceleration=\"7\" deceleration=\"5\"");
    assert_eq!(limits(&own).acceleration, Some(5.0));
    let followed = own.replace(
        "<axis xyz=\"1 0 0\"/>",
        "<axis xyz=\"1 0 0\"/><mimic joint=\"turn\" multiplier=\"-4\" offset=\"0.2\"/>",
    );
    let followed = followed.replace("velocity=\"1\"", "velocity=\"1\" acceleration=\"8\"");
    assert_eq!(limits(&followed).acceleration, Some(2.0));
    assert_eq!(limits(&followed).speed, Some(0.25));
}

#[test]
fn a_quaternion_is_the_turn_that_roll_pitch_and_yaw_are() {
    let pose = |orientation: &str| {
        let robot = described(&ARM.replace("rpy=\"0 0 1.5\"", orientation)).robot;
        let frame = robot.frame("upper").expect("a link");
        *conik::Kinematics::new(&robot).world_from(frame)
    };
    // Half a turn about (1, 1, 0), of any length: x becomes y, and z is turned over.
    let (one, other) = (
        pose("quat_xyzw=\"3 3 0 0\""),
        pose("rpy=\"3.141592653589793 0 1.5707963267948966\""),
    );
    for (one, other) in one
        .to_matrix()
        .iter()
        .flatten()
        .zip(other.to_matrix().iter().flatten())
    {
        assert!((one - other).abs() < 1e-15, "{one} is not {other}");
    }
}
