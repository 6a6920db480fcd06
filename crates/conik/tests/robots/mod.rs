//! Robots that are no plain arms of turning joints.

use conik::{Body, DhConvention, DhRow, Joint, JointKind, Mimic, Pose, Robot, RobotBuilder, Vec3};

/// An arm with sliding joints among the turning ones, and twists that are no right angles.
pub fn mixed_arm() -> Robot {
    let joints = [
        (JointKind::Revolute, [0.1, 0.7, 0.3, 0.2]),
        (JointKind::Prismatic, [0.2, -1.1, 0.1, 0.4]),
        (JointKind::Revolute, [-0.3, 0.3, 0.0, -0.5]),
        (JointKind::Revolute, [0.0, 1.9, 0.2, 0.0]),
        (JointKind::Prismatic, [0.05, 0.4, 0.0, 1.0]),
        (JointKind::Revolute, [0.1, 0.0, 0.1, 0.3]),
    ]
    .into_iter()
    .enumerate()
    .map(|(i, (kind, [a_m, alpha_rad, d_m, theta_rad]))| {
        let joint = Joint {
            kind,
            ..Joint::revolute(&format!("joint_{i}"))
        };
        let row = DhRow {
            a_m,
            alpha_rad,
            d_m,
            theta_rad,
        };
        (joint, row)
    })
    .collect();
    Robot::from_dh_joints("mixed", DhConvention::Standard, joints).expect("sound joints")
}

/// Two arms on a turning column, with a joint that slides and one that follows two others apart from it:
/// the tool is on one arm, links 4 and 5 on the other.
pub fn tree() -> Robot {
    let turned = |x: f64, y: f64, z: f64| {
        let turn = Vec3::new(x, y, z);
        Pose {
            x_axis: Vec3::new(1.0, 0.0, 0.0).turned_by(turn),
            y_axis: Vec3::new(0.0, 1.0, 0.0).turned_by(turn),
            z_axis: Vec3::new(0.0, 0.0, 1.0).turned_by(turn),
            origin: Vec3::new(y, 0.3, x) * 0.5,
        }
    };
    let mut tree = RobotBuilder::new("tree");
    let mut add = |on, turn: [f64; 3], joint: Joint| {
        let [x, y, z] = turn;
        tree.joint(on, turned(x, y, z), joint).expect("sound")
    };
    let column = add(Body::FIXED, [0.1, 0.2, 0.3], Joint::revolute("column"));
    let left = add(column, [0.7, -0.4, 1.0], Joint::revolute("left"));
    let right = add(column, [-0.9, 1.4, 0.2], Joint::prismatic("right"));
    let far_left = add(left, [1.1, 0.0, 0.6], Joint::revolute("far left"));
    let far_right = add(right, [0.5, 0.5, -1.5], Joint::revolute("far right"));
    let follows_left = Mimic {
        joint: 1,
        multiplier: -1.7,
        offset: 0.4,
    };
    let hand = tree.follower_between(
        far_right,
        turned(0.2, -0.6, 0.4),
        (JointKind::Revolute, follows_left, "hand"),
        turned(-0.3, 0.6, 0.8),
    );
    let hand = hand.expect("sound");
    for (name, body) in [
        ("base", Body::FIXED),
        ("column", column),
        ("left", left),
        ("far left", far_left),
        ("right", right),
        ("far right", far_right),
    ] {
        tree.link(name, body, turned(0.3, 0.1, -0.7))
            .expect("sound");
    }
    tree.link("hand", hand, Pose::at(Vec3::new(0.1, 0.2, 0.3)))
        .expect("sound");
    tree.build().expect("sound")
}
