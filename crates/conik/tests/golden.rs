//! Poses and Jacobians against those of Pinocchio, an independent library: the built-in robots and random
//! trees. `golden/golden.py` wrote the file and says how to write it again.

#[path = "golden/lines.rs"]
mod lines;

use conik::{Body, DhRow, Joint, Mimic, Robot, RobotBuilder};
use lines::{Line, TOLERANCE, blocks, compare};

#[test]
fn every_built_in_robot_agrees_with_pinocchio() {
    let blocks = blocks("robot");
    let names: Vec<&str> = blocks.iter().map(|block| block[0].words[0]).collect();
    assert_eq!(names, Robot::builtin_names());
    for (name, block) in names.into_iter().zip(blocks) {
        let robot = Robot::builtin(name).expect("built in");
        assert_eq!(robot.tool_name(), block[0].words[1], "{name}");
        let joints: Vec<&str> = robot.joint_names().collect();
        assert_eq!(compare(&robot, &block, &joints), 2, "{name}");
    }
}

/// The limits were typed twice, here and in the script, from different documents.
#[test]
fn limits_of_every_built_in_robot_are_those_published() {
    for block in blocks("robot") {
        let robot = Robot::builtin(block[0].words[0]).expect("built in");
        let lines: Vec<&Line> = block.iter().filter(|line| line.kind == "limits").collect();
        assert_eq!(lines.len(), robot.dof(), "{}", robot.name());
        for (joint, line) in robot.joints().iter().zip(lines) {
            assert_eq!(joint.name, line.words[0]);
            let (position, limits) = (joint.limits.position, joint.limits);
            let found = [
                position.map(|(least, _)| least),
                position.map(|(_, most)| most),
                limits.speed,
                limits.acceleration,
            ];
            for (found, word) in found.into_iter().zip(&line.words[1..]) {
                let expected = word.parse().ok();
                assert_eq!(found.is_some(), expected.is_some(), "{}", joint.name);
                let pair = found.zip(expected);
                assert!(pair.is_none_or(|(found, expected): (f64, f64)| {
                    (found - expected).abs() <= TOLERANCE
                }));
            }
        }
    }
}

#[test]
fn random_trees_with_followers_agree_with_pinocchio() {
    let blocks = blocks("tree");
    assert!(blocks.len() >= 3);
    for block in blocks {
        let mut tree = RobotBuilder::new(format!("tree {}", block[0].words[0]));
        let mut bodies = vec![Body::FIXED];
        for (i, line) in block.iter().enumerate() {
            if line.kind == "link" {
                let on = bodies[line.body(1)];
                tree.link(line.words[0], on, line.pose(2)).expect("sound");
                continue;
            }
            if !["joint", "follower"].contains(&line.kind) {
                continue;
            }
            let (on, before, after) = (bodies[line.body(1)], line.pose(2), line.pose(14));
            let (kind, name) = (line.joint_kind(), format!("joint {i}"));
            let added = if line.kind == "joint" {
                let joint = Joint {
                    kind,
                    ..Joint::revolute(&name)
                };
                tree.joint_between(on, before, joint, after)
            } else {
                let [multiplier, offset] = line.numbers(27)[..] else {
                    panic!("a follower has two numbers more");
                };
                let mimic = Mimic {
                    joint: line.body(26),
                    multiplier,
                    offset,
                };
                tree.follower_between(on, before, (kind, mimic, &name), after)
            };
            bodies.push(added.expect("sound"));
        }
        tree.tool("link_0").expect("there");
        let robot = tree.build().expect("sound");
        let joints: Vec<&str> = robot.joint_names().collect();
        assert_eq!(compare(&robot, &block, &joints), 1);
    }
}

/// A table that is wrong by a thousandth of a millimetre, or a twist by a millionth, would be seen.
#[test]
fn golden_file_sees_every_entry_of_a_table() {
    let block = &blocks("robot")[0];
    assert_eq!(block[0].words[0], "ur5-paper");
    let rows = [
        [0.0, std::f64::consts::FRAC_PI_2, 0.089],
        [-0.425, 0.0, 0.0],
        [-0.392, 0.0, 0.0],
        [0.0, std::f64::consts::FRAC_PI_2, 0.109],
        [0.0, -std::f64::consts::FRAC_PI_2, 0.095],
        [0.0, 0.0, 0.082],
    ];
    let sees = |rows: [[f64; 3]; 6]| {
        let rows = rows.map(|[a, alpha, d]| DhRow::new(a, alpha, d));
        let robot = Robot::from_dh("changed", &rows).expect("sound");
        let joints: Vec<&str> = robot.joint_names().collect();
        std::panic::catch_unwind(|| compare(&robot, block, &joints)).is_err()
    };
    assert!(!sees(rows));
    for row in 0..6 {
        for entry in 0..3 {
            let mut changed = rows;
            changed[row][entry] += 1e-6;
            assert!(sees(changed), "row {row}, entry {entry}");
        }
    }
}
