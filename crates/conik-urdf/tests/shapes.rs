//! Shapes of links: where `<collision>` says they are, and what is wrong with those that are none.

use conik::Vec3;
use conik_urdf::shapes;

/// A link with this in it.
fn link(inside: &str) -> String {
    format!("<robot name=\"r\">\n<link name=\"hand\">\n{inside}\n</link></robot>")
}

fn collision(origin: &str, shape: &str) -> String {
    link(&format!(
        "<collision>{origin}<geometry>{shape}</geometry></collision>"
    ))
}

/// What a point at `at` is away from the only shape.
fn distance(origin: &str, shape: &str, at: [f64; 3]) -> f64 {
    let described = shapes(&collision(origin, shape)).expect("sound");
    assert_eq!(described.shapes.len(), 1);
    assert_eq!(described.shapes[0].link, "hand");
    let point = conik::Sphere::new(Vec3::from(at), 0.0).into();
    let closest = described.shapes[0].shape.closest_to(&point);
    closest.expect("they have a distance").distance
}

#[test]
fn shapes_are_where_their_origin_puts_them() {
    let origin = r#"<origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/>"#;
    #[rustfmt::skip]
    let cases = [
        ("", r#"<sphere radius="0.1"/>"#, [0.0, 0.0, 0.5], 0.4),
        ("", r#"<box size="0.2 0.4 0.6"/>"#, [0.0, 0.5, 0.0], 0.3),
        ("", r#"<cylinder radius="0.1" length="0.6"/>"#, [0.0, 0.0, 0.5], 0.2),
        ("", r#"<cylinder radius="0.1" length="0.6"/>"#, [0.5, 0.0, 0.0], 0.4),
        ("", r#"<capsule radius="0.1" length="0.6"/>"#, [0.0, 0.0, 0.5], 0.1),
        // Turned by a quarter about y, its z axis is the link's x axis.
        (origin, r#"<sphere radius="0.1"/>"#, [1.0, 0.0, 0.5], 0.4),
        (origin, r#"<box size="0.2 0.4 0.6"/>"#, [1.5, 0.0, 0.0], 0.2),
        (origin, r#"<cylinder radius="0.1" length="0.6"/>"#, [1.5, 0.0, 0.0], 0.2),
        (origin, r#"<capsule radius="0.1" length="0.6"/>"#, [1.5, 0.0, 0.0], 0.1),
    ];
    for (origin, shape, at, expected) in cases {
        let found = distance(origin, shape, at);
        assert!(
            (found - expected).abs() < 1e-12,
            "{origin} {shape}: {found}"
        );
    }
}

#[test]
fn every_collision_of_a_link_is_a_shape_and_what_is_to_be_seen_is_none() {
    let ball = "<geometry><sphere radius=\"0.1\"/></geometry>";
    let inside = format!(
        "<visual>{ball}</visual><collision name=\"a\">{ball}</collision><collision>{ball}</collision>"
    );
    assert_eq!(shapes(&link(&inside)).expect("sound").shapes.len(), 2);
}

#[test]
fn of_a_mesh_only_the_link_is_told() {
    let described = shapes(&collision("", "<mesh filename=\"hand.stl\"/>")).expect("sound");
    assert!(described.shapes.is_empty());
    assert_eq!(described.meshes.len(), 1);
    assert_eq!(described.meshes[0].link, "hand");
    assert_eq!(described.meshes[0].line, 3);
}

#[test]
fn what_is_no_shape_is_refused_where_it_stands() {
    #[rustfmt::skip]
    let cases = [
        ("<collision/>", "line 3, column 1: collision of link \"hand\": `<geometry>` is missing"),
        ("<collision><geometry/></collision>", "line 3, column 12: geometry of link \"hand\": it must hold one shape"),
        ("<collision><geometry><ball radius=\"1\"/></geometry></collision>", "line 3, column 22: ball of link \"hand\": it is no shape"),
        ("<collision><geometry><sphere/></geometry></collision>", "attribute `radius`: missing"),
        ("<collision><geometry><sphere radius=\"0\"/></geometry></collision>", "attribute `radius`: a length must be above 0"),
        ("<collision><geometry><sphere radius=\"nan\"/></geometry></collision>", "attribute `radius`"),
        ("<collision><geometry><box size=\"1 1\"/></geometry></collision>", "attribute `size`: expected three numbers, found 2"),
        ("<collision><geometry><box size=\"1 -1 1\"/></geometry></collision>", "attribute `size`: a length must be above 0"),
        ("<collision><geometry><cylinder radius=\"1\"/></geometry></collision>", "attribute `length`: missing"),
        ("<collision><geometry><capsule radius=\"1\" length=\"1e9\"/></geometry></collision>", "attribute `length`"),
        ("<collision><geometry><sphere radius=\"1\"/><sphere radius=\"1\"/></geometry></collision>", "it must hold one shape"),
    ];
    for (inside, expected) in cases {
        let error = shapes(&link(inside)).expect_err(inside).to_string();
        assert!(error.contains(expected), "{inside}: {error}");
    }
}

#[test]
fn each_of_many_meshes_has_its_line() {
    let mesh = "<collision><geometry>\n<mesh filename=\"a.stl\"/></geometry></collision>\n";
    let described = shapes(&link(&mesh.repeat(30_000))).expect("sound");
    let lines: Vec<usize> = described.meshes.iter().map(|mesh| mesh.line).collect();
    let expected: Vec<usize> = (0..30_000).map(|i| 4 + 2 * i).collect();
    assert_eq!(lines, expected);
}
