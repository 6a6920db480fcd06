//! Every type of joint, about odd axes, and a follower: poses and Jacobians against those of Pinocchio,
//! which read the same description. The golden file is that of the built-in robots.

#[path = "../../conik/tests/golden/lines.rs"]
#[allow(dead_code)] // The tests of the robots and trees need more of it.
mod lines;

use conik_urdf::{Options, read};
use lines::{blocks, compare};

const JOINT_TYPES: &str = include_str!("../../conik/tests/golden/joint_types.urdf");

#[test]
fn every_joint_type_agrees_with_pinocchio() {
    let blocks = blocks("urdf");
    let [block] = &blocks[..] else {
        panic!("one description was written");
    };
    assert_eq!(block[0].words[0], "joint_types.urdf");
    // `left` is not on the way to the tip.
    let options = Options {
        base: None,
        tools: vec![block[0].words[1].to_owned(), "left_arm".to_owned()],
    };
    let robot = read(JOINT_TYPES, &options).expect("sound").robot;
    assert_eq!(compare(&robot, block, &block[0].words[2..]), 3);
}
