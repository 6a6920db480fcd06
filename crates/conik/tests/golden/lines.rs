//! Reads the golden file that `golden.py` wrote, and compares a robot with a block of it.

use std::str::FromStr;

use conik::{Frame, JointKind, Kinematics, Pose, Robot, Vec3};

const GOLDEN: &str = include_str!("pinocchio.txt");
pub const TOLERANCE: f64 = 1e-12;

/// The words of a line after the first, which says what the line is.
pub struct Line {
    pub kind: &'static str,
    pub words: Vec<&'static str>,
}

impl Line {
    pub fn numbers(&self, from: usize) -> Vec<f64> {
        let words = self.words[from..].iter();
        words.map(|word| f64::from_str(word).unwrap()).collect()
    }

    pub fn pose(&self, from: usize) -> Pose {
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

    pub fn body(&self, word: usize) -> usize {
        self.words[word].parse().unwrap()
    }

    pub fn joint_kind(&self) -> JointKind {
        match self.words[0] {
            "prismatic" => JointKind::Prismatic,
            _ => JointKind::Revolute,
        }
    }
}

/// The blocks that begin with a line of this kind, that line first.
pub fn blocks(kind: &str) -> Vec<Vec<Line>> {
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

/// Compares a robot with the lines of a block, which has its joints in the order of `names`; returns how
/// many configurations there were.
pub fn compare(robot: &Robot, block: &[Line], names: &[&str]) -> usize {
    let mut kinematics = Kinematics::new(robot);
    // Number in the robot of each joint of the block.
    let find = |name: &&str| robot.joint_names().position(|other| other == *name);
    let order: Vec<usize> = names.iter().map(|name| find(name).expect(name)).collect();
    assert_eq!(order.len(), robot.dof(), "{}", robot.name());
    let mut compared = 0;
    for line in block {
        match line.kind {
            "q" => {
                let mut q = vec![0.0; robot.dof()];
                for (&joint, value) in order.iter().zip(line.numbers(0)) {
                    q[joint] = value;
                }
                kinematics.update(&q);
            }
            "frame" => {
                let name = line.words[0];
                let frame = robot.frame(name).expect(name);
                let found = flat(kinematics.world_from(frame));
                let what = format!("{} {name}", robot.name());
                assert_near(&found, &line.numbers(1), &what);
            }
            "jacobian" => {
                let found = jacobian(&kinematics);
                let rows = found.chunks(robot.dof());
                let found: Vec<f64> = rows
                    .flat_map(|row| order.iter().map(|&joint| row[joint]))
                    .collect();
                let what = format!("Jacobian of {}", robot.name());
                assert_near(&found, &line.numbers(0), &what);
                compared += 1;
            }
            _ => {}
        }
    }
    compared
}
