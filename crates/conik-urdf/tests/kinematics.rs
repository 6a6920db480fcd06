//! Every frame of every kind of tree is where a product of homogeneous matrices has it.

mod product;

use conik::{Frame, JointKind, Kinematics, Vec3};
use conik_urdf::{Described, Options, read};
use product::Product;

fn options(base: Option<&str>, tools: &[&str]) -> Options {
    Options {
        base: base.map(str::to_owned),
        tools: tools.iter().map(|&tool| tool.to_owned()).collect(),
    }
}

/// Numbers that look random, from −1 to 1.
fn noise(seed: usize) -> f64 {
    (seed as f64 * 12.9898)
        .sin()
        .mul_add(43_758.545_3, 0.0)
        .fract()
}

/// Name, base, tools and joints.
type Case = (
    &'static str,
    Option<&'static str>,
    &'static [&'static str],
    &'static [&'static str],
);

/// The robots under `fixtures/`, from where to where they are read, and the joints that must result.
const CASES: &[Case] = &[
    (
        "six_axes",
        None,
        &[],
        &["yaw", "lift", "bend", "roll", "tilt", "twist"],
    ),
    (
        "six_axes",
        Some("forearm"),
        &["flange"],
        &["roll", "tilt", "twist"],
    ),
    (
        "six_axes",
        Some("flange"),
        &["stand"],
        &["twist", "tilt", "roll", "bend", "lift", "yaw"],
    ),
    ("gripper", None, &["palm"], &["slide", "wrist"]),
    (
        "gripper",
        None,
        &["palm", "left_tip"],
        &["slide", "wrist", "left"],
    ),
    (
        "gripper",
        None,
        &["right_tip", "left_tip"],
        &["slide", "wrist", "left"],
    ),
    (
        "torso",
        None,
        &["left_hand"],
        &["waist", "left_shoulder", "left_elbow"],
    ),
    (
        "torso",
        Some("left_hand"),
        &["right_hand"],
        &[
            "left_elbow",
            "left_shoulder",
            "right_shoulder",
            "right_elbow",
        ],
    ),
    (
        "torso",
        None,
        &["right_hand", "left_hand"],
        &[
            "waist",
            "right_shoulder",
            "right_elbow",
            "left_shoulder",
            "left_elbow",
        ],
    ),
    (
        "torso",
        Some("chest"),
        &["foot", "left_hand"],
        &["waist", "left_shoulder", "left_elbow"],
    ),
    ("gantry", None, &[], &["x", "y", "z", "spin"]),
    ("gantry", Some("bridge"), &["nozzle"], &["y", "z", "spin"]),
];

fn each_case(check: impl Fn(&str, &Described, &Product)) {
    for (name, base, tools, joints) in CASES {
        let path = format!("{}/tests/fixtures/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("a fixture");
        let described = read(&text, &options(*base, tools)).expect("it is right");
        let found: Vec<&str> = described.robot.joint_names().collect();
        assert_eq!(found, *joints, "{name} from {base:?} to {tools:?}");
        let product = Product::new(&text);
        check(
            &format!("{name} from {base:?} to {tools:?}"),
            &described,
            &product,
        );
    }
}

#[test]
fn every_link_is_where_the_product_of_matrices_has_it() {
    each_case(|case, described, product| {
        let robot = &described.robot;
        let links: Vec<&str> = robot.link_names().collect();
        assert_eq!(
            links.len(),
            product.link_count(),
            "{case}: every link is a frame"
        );
        let mut kinematics = Kinematics::new(robot);
        for round in 0..20 {
            let q: Vec<f64> = (0..robot.dof())
                .map(|i| 3.0 * noise(round * 40 + i + 1))
                .collect();
            kinematics.update(&q);
            let named: Vec<(&str, f64)> = robot.joint_names().zip(q.iter().copied()).collect();
            let base_from_root = product
                .root_from(links[0], &named)
                .try_inverse()
                .expect("rigid");
            for (place, link) in links.iter().enumerate() {
                let expected = base_from_root * product.root_from(link, &named);
                let found = kinematics.world_from(Frame::Link(place)).to_matrix();
                for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column)))
                {
                    let difference = (found[row][column] - expected[(row, column)]).abs();
                    assert!(difference < 1e-13, "{case}: {link} is {difference} off");
                }
            }
        }
    });
}

#[test]
fn jacobians_of_all_links_agree_with_finite_differences() {
    each_case(|case, described, _| {
        let robot = &described.robot;
        let n = robot.dof();
        let mut kinematics = Kinematics::new(robot);
        let q: Vec<f64> = (0..n).map(|i| noise(i + 7)).collect();
        for link in 0..robot.link_names().len() {
            let frame = Frame::Link(link);
            let motion = kinematics.motion(frame);
            let origin_at = |kinematics: &mut Kinematics, joint: usize, by: f64| {
                let mut q = q.clone();
                q[joint] += by;
                kinematics.update(&q);
                kinematics.world_from(frame).origin
            };
            for axis in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.6, -0.8)] {
                kinematics.update(&q);
                let mut row = vec![0.0; n];
                let point = kinematics.world_from(frame).origin;
                kinematics.point_row(motion, point, axis, &mut row);
                for joint in 0..n {
                    let step = 1e-5;
                    let ahead = origin_at(&mut kinematics, joint, step);
                    let behind = origin_at(&mut kinematics, joint, -step);
                    let slope = axis.dot(ahead - behind) / (2.0 * step);
                    let difference = (row[joint] - slope).abs();
                    assert!(
                        difference < 1e-8,
                        "{case}: link {link}, joint {joint}: {difference}"
                    );
                }
            }
        }
    });
}

#[test]
fn limits_are_those_of_the_description() {
    let text = include_str!("fixtures/gantry.urdf");
    let described = read(text, &Options::default()).expect("it is right");
    let joints = described.robot.joints();
    assert_eq!(joints[0].kind, JointKind::Prismatic);
    assert_eq!(joints[0].limits.position, Some((0.0, 2.5)));
    assert_eq!(joints[0].limits.speed, Some(1.5));
    assert_eq!(
        joints[1].limits.position,
        Some((-1.0, f64::INFINITY)),
        "1e16 is no bound"
    );
    assert_eq!(joints[1].limits.speed, None, "0 is no limit of speed");
    assert_eq!(joints[2].limits.position, None, "no `<limit>`");
    assert_eq!(joints[3].kind, JointKind::Revolute);
    assert_eq!(joints[3].limits.position, None, "it is continuous");
    assert_eq!(joints[3].limits.speed, Some(6.0));
    assert_eq!(described.efforts, [Some(900.0), None, None, Some(4.0)]);
    let notes: Vec<String> = described.notes.iter().map(ToString::to_string).collect();
    assert_eq!(notes.len(), 6, "{notes:#?}");
    for (line, said) in [
        (4, "\"inertial\": masses"),
        (5, "\"visual\": shapes"),
        (17, "\"y\": immense `lower` or `upper`"),
        (17, "\"y\": `velocity` is not above 0"),
        (19, "\"z\": no `<limit>`"),
        (31, "\"transmission\": drives"),
    ] {
        let starts = format!("line {line}: {said}");
        assert!(
            notes.iter().any(|note| note.starts_with(&starts)),
            "{starts}: {notes:#?}"
        );
    }
}

#[test]
fn what_is_off_the_way_is_held_at_its_limit_nearest_to_0() {
    let text = include_str!("fixtures/gripper.urdf");
    let described = read(text, &options(None, &["palm"])).expect("it is right");
    let notes: Vec<String> = described.notes.iter().map(ToString::to_string).collect();
    let says = |said: &str| notes.iter().any(|note| note.contains(said));
    assert!(
        says("\"left\": held at its limit nearest to 0"),
        "{notes:#?}"
    );
    assert!(says("\"right_pad\", \"right\": held still"), "{notes:#?}");
}

#[test]
fn what_follows_nothing_stands_at_its_offset_off_the_way() {
    let text = include_str!("fixtures/gripper.urdf").replace("joint=\"left\"", "joint=\"lost\"");
    let robot = read(&text, &options(None, &["palm"]))
        .expect("it is right")
        .robot;
    let kinematics = Kinematics::new(&robot);
    let pose = |link: &str| *kinematics.world_from(robot.frame(link).expect("a link"));
    // 0.05 to the right, and by its offset of -0.1 to the left of that.
    let tip = pose("palm").untransform(pose("right_tip").origin);
    assert!((tip - Vec3::new(0.1, 0.05, 0.0)).norm() < 1e-15, "{tip:?}");
    assert!(read(&text, &options(None, &["right_tip"])).is_err());
}

#[test]
fn axes_along_those_of_the_frame_are_not_rounded() {
    // At q = 0 every entry is 0 or ±1 but the lengths, which are sums of what stands in the text.
    let text = include_str!("fixtures/gantry.urdf");
    let robot = read(text, &Options::default()).expect("it is right").robot;
    let pose = *Kinematics::new(&robot).world_from(Frame::Tool);
    for axis in [pose.x_axis, pose.y_axis, pose.z_axis] {
        assert!(
            axis.to_array()
                .iter()
                .all(|x| [0.0, 1.0].contains(&x.abs())),
            "{pose:?}"
        );
    }
}
