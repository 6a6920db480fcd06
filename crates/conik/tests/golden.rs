//! Poses and Jacobians against those of Pinocchio, an independent library: the built-in robots, every
//! joint type of a URDF, random trees. `golden/golden.py` wrote the file and says how to write it again.

use std::str::FromStr;

use conik::{
    Body, DhRow, Frame, Joint, JointKind, Kinematics, Mimic, Pose, Robot, RobotBuilder, Vec3,
};

const GOLDEN: &str = include_str!("golden/pinocchio.txt");
const TOLERANCE: f64 = 1e-12;

/// The words of a line after the first, which says what the line is.
struct Line {
    kind: &'static str,
    words: Vec<&'static str>,
}

impl Line {
    fn numbers(&self, from: usize) -> Vec<f64> {
        let words = self.words[from..].iter();
        words.map(|word| f64::from_str(word).unwrap()).collect()
    }

    fn pose(&self, from: usize) -> Pose {
        let n = &self.numbers(from)[..12];
        let row = |i: usize| Vec3::new(n[3 * i], n[3 * i + 1], n[3 * i + 2]);
        let columns = Pose {
            x_axis: row(0),
            y_axis: row(1),
            z_axis: row(2),
            origin: Vec3::ZERO,
        };
        Pose {
            origin: row(3),
            ..columns.inverse()
        }
    }

    fn body(&self, word: usize) -> usize {
        self.words[word].parse().unwrap()
    }

    fn joint_kind(&self) -> JointKind {
        match self.words[0] {
            "prismatic" => JointKind::Prismatic,
            _ => JointKind::Revolute,
        }
    }
}

/// The blocks that begin with a line of this kind, that line first.
fn blocks(kind: &str) -> Vec<Vec<Line>> {
    let mut blocks: Vec<Vec<Line>> = Vec::new();
    for line in GOLDEN.lines().filter(|line| !line.starts_with('#')) {
        let mut words = line.split(' ');
        let line = Line {
            kind: words.next().unwrap(),
            words: words.collect(),
        };
        if ["robot", "urdf", "tree"].contains(&line.kind) {
            blocks.push(Vec::new());
        }
        blocks.last_mut().unwrap().push(line);
    }
    blocks.retain(|block| block[0].kind == kind);
    blocks
}

fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (found, expected) in found.iter().zip(expected) {
        let away = (found - expected).abs();
        assert!(away <= TOLERANCE, "{what}: {found} is not {expected}");
    }
}

fn flat(pose: &Pose) -> Vec<f64> {
    let rows = pose.to_matrix();
    let rotation = rows[..3].iter().flat_map(|row| &row[..3]);
    let origin = rows[..3].iter().map(|row| &row[3]);
    rotation.chain(origin).copied().collect()
}

/// Rows x, y, z of the tool's velocity, then of its angular velocity.
fn jacobian(kinematics: &Kinematics) -> Vec<f64> {
    let motion = kinematics.motion(Frame::Tool);
    let tool = kinematics.world_from(Frame::Tool).origin;
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from);
    let mut rows = vec![vec![0.0; kinematics.dof()]; 6];
    for (i, axis) in axes.into_iter().enumerate() {
        kinematics.point_row(motion, tool, axis, &mut rows[i]);
        kinematics.turn_row(motion, axis, &mut rows[3 + i]);
    }
    rows.concat()
}

/// Compares a robot with the lines of a block; returns how many configurations there were.
fn compare(robot: &Robot, block: &[Line]) -> usize {
    let mut kinematics = Kinematics::new(robot);
    let mut compared = 0;
    for line in block {
        match line.kind {
            "q" => kinematics.update(&line.numbers(0)),
            "frame" => {
                let name = line.words[0];
                let frame = robot.frame(name).expect(name);
                let found = flat(kinematics.world_from(frame));
                let what = format!("{} {name}", robot.name());
                assert_near(&found, &line.numbers(1), &what);
            }
            "jacobian" => {
                let what = format!("Jacobian of {}", robot.name());
                assert_near(&jacobian(&kinematics), &line.numbers(0), &what);
                compared += 1;
            }
            _ => {}
        }
    }
    compared
}

#[test]
fn every_built_in_robot_agrees_with_pinocchio() {
    let blocks = blocks("robot");
    let names: Vec<&str> = blocks.iter().map(|block| block[0].words[0]).collect();
    assert_eq!(names, Robot::builtin_names());
    for (name, block) in names.into_iter().zip(blocks) {
        let robot = Robot::builtin(name).expect("built in");
        assert_eq!(robot.tool_name(), block[0].words[1], "{name}");
        assert_eq!(compare(&robot, &block), 2, "{name}");
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
        assert_eq!(compare(&tree.build().expect("sound"), &block), 1);
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
        std::panic::catch_unwind(|| compare(&robot, block)).is_err()
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
