//! Forward kinematics of the paper's UR5 against values from other sources.

use conik::{
    Body, DhRow, Frame, JacobianMut, Joint, JointKind, Kinematics, Mimic, Pose, Position, Robot,
    RobotBuilder, Task, Vec3,
};

fn ur5() -> Robot {
    Robot::builtin("ur5-paper").expect("built in")
}

fn assert_near(found: Vec3, expected: [f64; 3], tolerance: f64) {
    let away = (found - Vec3::from(expected)).norm();
    assert!(away <= tolerance, "{found:?} instead of {expected:?}");
}

/// The tool's z axis at three configurations, from a student thesis that used the paper's robot.
#[test]
fn tool_axis_agrees_with_a_thesis() {
    let cases = [
        (
            [-1.432, -1.191, -1.810, -2.341, -2.144, -0.652],
            [0.6056, -0.4149, 0.6791],
        ),
        (
            [-0.915, -1.685, -1.741, -2.373, -2.156, -2.009],
            [0.8877, -0.2479, 0.3880],
        ),
        (
            [0.915, -1.685, -0.5, -2.373, -2.156, -2.009],
            [-0.5160, 0.2352, 0.8237],
        ),
    ];
    let mut kinematics = Kinematics::new(&ur5());
    for (q, axis) in cases {
        kinematics.update(&q);
        assert_near(kinematics.world_from(Frame::Tool).z_axis, axis, 1e-4);
    }
}

/// Rows of the position Jacobian at q = 0.1 in every joint, from the same thesis.
#[test]
fn position_jacobian_agrees_with_a_thesis() {
    let expected = [
        [0.2682, 0.2124, 0.1702, 0.0927, -0.0784, 0.0],
        [-0.7639, 0.0213, 0.0171, 0.0093, 0.0004, 0.0],
        [0.0, -0.7868, -0.3639, 0.0203, -0.0241, 0.0],
    ];
    let mut kinematics = Kinematics::new(&ur5());
    kinematics.update(&[0.1; 6]);
    let mut jacobian = [0.0; 18];
    Position::of_tool().jacobian(&kinematics, &mut JacobianMut::new(&mut jacobian, 6));
    for (row, expected) in jacobian.chunks(6).zip(expected) {
        for (found, expected) in row.iter().zip(expected) {
            assert!((found - expected).abs() < 6e-5, "{jacobian:?}");
        }
    }
}

/// The DH base of the paper, not the `base_link` of the maker's URDF, which is turned by π about z
/// against it: there this point is (0.5703, 0.3663, 0.4725), lengths not rounded.
#[test]
fn tool_position_is_in_the_base_frame_of_the_paper() {
    let mut kinematics = Kinematics::new(&ur5());
    kinematics.update(&[0.3, -1.0, 0.7, 0.2, 0.5, 0.1]);
    let tool = kinematics.world_from(Frame::Tool).origin;
    assert_near(tool, [-0.5701, -0.3658, 0.4719], 1e-4);
}

/// The same point with the maker's lengths, in both base frames that UR arms have.
#[test]
fn base_of_the_controller_and_base_link_of_the_urdf_are_half_a_turn_apart() {
    for name in [
        "ur3", "ur5", "ur10", "ur3e", "ur5e", "ur10e", "ur16e", "ur20", "ur30",
    ] {
        let robot = Robot::builtin(name).expect("built in");
        let frame = |link: &str| robot.frame(link).expect(link);
        let mut kinematics = Kinematics::new(&robot);
        kinematics.update(&[0.3, -1.0, 0.7, 0.2, 0.5, 0.1]);
        let seen_from = |link: &str| {
            let tool = kinematics.world_from(frame("tool0"));
            kinematics.world_from(frame(link)).untransform(tool.origin)
        };
        let (in_base, in_base_link) = (seen_from("base"), seen_from("base_link"));
        assert_eq!(in_base, kinematics.world_from(Frame::Tool).origin);
        assert_eq!(
            in_base_link,
            Vec3::new(-in_base.x, -in_base.y, in_base.z),
            "{name}"
        );
        if name == "ur5" {
            assert_near(in_base_link, [0.5703, 0.3663, 0.4725], 1e-4);
        }
        // The flange of the URDF has its x axis where the tool has its z axis.
        let (flange, tool) = (frame("flange"), frame("tool0"));
        let (flange, tool) = (kinematics.world_from(flange), kinematics.world_from(tool));
        assert_eq!(flange.origin, tool.origin);
        assert_near(flange.x_axis, tool.z_axis.to_array(), 1e-15);
    }
}

#[test]
fn links_follow_the_product_of_their_homogeneous_matrices() {
    let rows = [DhRow::new(0.3, 0.4, 0.1), DhRow::new(-0.2, -1.3, 0.25)];
    let robot = Robot::from_dh("two", &rows).expect("sound table");
    let q = [0.7, -1.9];
    let mut product = Pose::IDENTITY;
    for (row, theta) in rows.iter().zip(q) {
        let ((st, ct), (sa, ca)) = (f64::sin_cos(theta), f64::sin_cos(row.alpha_rad));
        product = product
            * Pose {
                x_axis: Vec3::new(ct, st, 0.0),
                y_axis: Vec3::new(-st * ca, ct * ca, sa),
                z_axis: Vec3::new(st * sa, -ct * sa, ca),
                origin: Vec3::new(row.a_m * ct, row.a_m * st, row.d_m),
            };
    }
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&q);
    for (found, expected) in kinematics
        .world_from(Frame::Tool)
        .to_matrix()
        .iter()
        .zip(product.to_matrix())
    {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15);
        }
    }
}

#[test]
fn robots_that_cannot_be_are_refused() {
    assert!(Robot::from_dh("none", &[]).is_err());
    assert!(Robot::from_dh("many", &[DhRow::default(); 33]).is_err());
    assert!(Robot::from_dh("nan", &[DhRow::new(f64::NAN, 0.0, 0.0)]).is_err());
    let error = Robot::builtin("ur6").expect_err("unknown").to_string();
    assert!(
        error.contains("ur6") && error.contains("ur5-paper"),
        "{error}"
    );
}

/// Where joints are placed is where the kinematics put what they carry: tables of both conventions, sliding
/// joints, and joints that follow others.
#[test]
fn placed_joints_agree_with_the_kinematics() {
    let mut lift = RobotBuilder::new("lift");
    let away = Pose {
        origin: Vec3::new(0.2, -0.1, 0.3),
        x_axis: Vec3::new(0.0, 1.0, 0.0),
        y_axis: Vec3::new(0.0, 0.0, 1.0),
        z_axis: Vec3::new(1.0, 0.0, 0.0),
    };
    let slide = lift.joint(Body::FIXED, away, Joint::prismatic("slide"));
    let turn = lift.joint_between(slide.unwrap(), away, Joint::revolute("turn"), away);
    let follows = Mimic {
        joint: 1,
        multiplier: -2.0,
        offset: 0.3,
    };
    let follower = (JointKind::Prismatic, follows, "follower");
    let end = lift.follower_between(turn.unwrap(), away, follower, away);
    lift.link("end", end.unwrap(), Pose::IDENTITY).unwrap();
    let robots = ["ur5-paper", "panda", "ur5e"].map(|name| Robot::builtin(name).unwrap());
    for robot in robots.into_iter().chain([lift.build().unwrap()]) {
        let q: Vec<f64> = (0..robot.dof()).map(|i| 0.4 - 0.3 * i as f64).collect();
        let mut kinematics = Kinematics::new(&robot);
        kinematics.update(&q);
        let joints = robot.placed_joints(&q);
        for link in robot.link_names() {
            let frame = robot.frame(link).unwrap();
            let Some(carrier) = robot.carrier(frame) else {
                continue;
            };
            // As the carrier's body sees it, a frame on it stays where it is at q = 0.
            let at_rest = robot.placed_joints(&vec![0.0; q.len()])[carrier].body;
            let placement = at_rest.inverse() * *Kinematics::new(&robot).world_from(frame);
            let expected = kinematics.world_from(frame);
            let found = joints[carrier].body * placement;
            assert_near(found.origin, expected.origin.to_array(), 1e-12);
            assert_near(found.x_axis, expected.x_axis.to_array(), 1e-12);
        }
        for joint in &joints {
            assert!(
                joint
                    .carried_by
                    .is_none_or(|carrier| joint.frame != joints[carrier].frame)
            );
            let (axis, moved) = (joint.frame.z_axis, joint.moved.z_axis);
            assert_near(moved, axis.to_array(), 1e-12);
        }
    }
}
