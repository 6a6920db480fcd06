//! Shapes of the links from the URDF file: `shapes` in `[robot]`.

use std::fs;
use std::path::PathBuf;

use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Geometry, Scenario};

const URDF: &str = r#"<robot name="crane">
  <link name="foot"/>
  <link name="tower">
    <collision><origin xyz="0 0 0.5"/><geometry><box size="0.2 0.2 1"/></geometry></collision>
    <collision><origin xyz="0 0 1.1"/><geometry><sphere radius="0.15"/></geometry></collision>
  </link>
  <link name="the jib">
    <visual><geometry><sphere radius="9"/></geometry></visual>
    <collision>
      <origin xyz="0.5 0 0" rpy="0 1.5707963267948966 0"/>
      <geometry><capsule radius="0.05" length="1"/></geometry>
    </collision>
  </link>
  <link name="hook">
    <collision><geometry><mesh filename="hook.stl"/></geometry></collision>
  </link>
  <joint name="turn" type="continuous">
    <parent link="foot"/> <child link="tower"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="lift" type="continuous">
    <parent link="tower"/> <child link="the jib"/> <origin xyz="0 0 1.1"/> <axis xyz="0 1 0"/>
  </joint>
  <joint name="swing" type="continuous">
    <parent link="the jib"/> <child link="hook"/> <origin xyz="1 0 0"/> <axis xyz="0 1 0"/>
  </joint>
</robot>
"#;

const SCENARIO: &str = r#"
[robot]
urdf = "crane.urdf"
shapes = "primitives"
q0_deg = [0, 0, 0]
[[obstacle]]
name = "wall"
type = "half_space"
point_m = [3, 0, 0]
normal = [-1, 0, 0]
distance_m = 0.1
[[task]]
name = "p"
type = "height"
desired = 1
gain_per_s = 1
"#;

/// Its own folder, gone when the test is over.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder =
            std::env::temp_dir().join(format!("conik shapes {name} {}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join("crane.urdf"), URDF).expect("written");
        Self(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

impl Folder {
    fn load(&self, text: &str) -> Result<Scenario, String> {
        let file = self.0.join("crane.toml");
        fs::write(&file, text).expect("written");
        Scenario::load(&file).map_err(|error| error.to_string())
    }
}

fn load(name: &str, text: &str) -> Result<Scenario, String> {
    Folder::new(name).load(text)
}

/// Names of shapes with their links.
fn names(scenario: &Scenario) -> Vec<(&str, &str)> {
    let shapes = scenario.collision.shapes.iter();
    shapes.map(|shape| (&*shape.name, &*shape.link)).collect()
}

#[test]
fn primitives_of_the_links_become_shapes_that_keep_away() {
    let folder = Folder::new("primitives");
    let scenario = folder.load(SCENARIO).expect("sound");
    assert_eq!(
        names(&scenario),
        [
            ("tower", "tower"),
            ("tower.2", "tower"),
            ("the_jib", "the jib")
        ]
    );
    let Geometry::Capsule { from_m, to_m, .. } = scenario.collision.shapes[2].geometry else {
        panic!("{:?}", scenario.collision.shapes[2]);
    };
    let ends = [from_m[0].min(to_m[0]), from_m[0].max(to_m[0])];
    assert!(ends[0].abs() < 1e-12 && (ends[1] - 1.0).abs() < 1e-12);
    assert_eq!(
        Scenario::from_toml(&scenario.to_toml()),
        Ok(scenario.clone())
    );

    let experiment = Experiment::new(&scenario).expect("sound");
    let sets: Vec<&str> = experiment
        .controller
        .stack()
        .iter()
        .map(|(_, level)| level.name())
        .collect();
    assert_eq!(sets, ["tower/wall", "tower.2/wall", "the_jib/wall", "p"]);
}

#[test]
fn shapes_of_the_scenario_stand_in_place_of_those_of_the_file() {
    let own = "[[shape]]\nlink = \"hook\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\nradius_m = 0.1\n\
               [[shape]]\nname = \"post\"\nlink = \"tower\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\nradius_m = 0.1\n";
    // Now that the hook has a shape, no mesh is left without one.
    let text = SCENARIO
        .replace("\"primitives\"", "\"collision\"")
        .replace("[[obstacle]]", &format!("{own}[[obstacle]]"));
    let scenario = load("own", &text).expect("sound");
    assert_eq!(
        names(&scenario),
        [("hook", "hook"), ("post", "tower"), ("the_jib", "the jib")]
    );
}

#[test]
fn a_name_that_is_taken_is_numbered() {
    let own = "[[shape]]\nname = \"tower\"\nlink = \"hook\"\ntype = \"sphere\"\ncenter_m = [0, 0, 0]\nradius_m = 0.1\n";
    let text = SCENARIO.replace("[[obstacle]]", &format!("{own}[[obstacle]]"));
    let scenario = load("taken", &text).expect("sound");
    let shapes = names(&scenario);
    assert_eq!(shapes[..2], [("tower", "hook"), ("tower.2", "tower")]);
    assert_eq!(shapes[2], ("tower.3", "tower"));
}

#[test]
fn without_the_key_there_are_none() {
    let text = SCENARIO.replace("shapes = \"primitives\"\n", "");
    let error = load("none", &text).expect_err("nothing can meet the wall");
    assert!(
        error.contains("no link has a shape that could meet it"),
        "{error}"
    );
}

#[test]
fn mistakes_are_placed() {
    #[rustfmt::skip]
    let cases = [
        ("\"primitives\"", "\"collision\"", "robot.shapes: ", "crane.urdf:15: the shape of link \"hook\" is a mesh, and meshes have no distance"),
        ("\"primitives\"", "\"collisions\"", "robot.shapes: ", "did you mean \"collision\"?"),
        ("\"primitives\"", "true", "robot.shapes: ", "expected text in quotes"),
        ("urdf = \"crane.urdf\"", "model = \"ur5e\"", "robot.shapes: ", "`shapes` is for robots from URDF files"),
    ];
    for (part, other, key, what) in cases {
        let text = SCENARIO.replacen(part, other, 1);
        let error = load("mistakes", &text).expect_err(other);
        assert!(
            error.contains(key) && error.contains(what),
            "{other}: {error}"
        );
    }
    let folder = Folder::new("bad shape");
    let bad = URDF.replace("sphere radius=\"0.15\"", "sphere radius=\"-0.15\"");
    fs::write(folder.0.join("crane.urdf"), bad).expect("written");
    let error = folder.load(SCENARIO).expect_err("no such ball");
    assert!(
        error.contains(
            "crane.urdf:5:57: sphere of link \"tower\", attribute `radius`: a length must"
        ),
        "{error}"
    );
}

/// The crane with so many more shapes on its tower.
fn with_more(folder: &Folder, shapes: usize) {
    let more =
        "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>".repeat(shapes);
    let link = "<link name=\"tower\">";
    let text = URDF.replace(link, &format!("{link}{more}"));
    fs::write(folder.0.join("crane.urdf"), text).expect("written");
}

#[test]
fn of_many_shapes_all_have_names_and_of_too_many_none() {
    let folder = Folder::new("many");
    let apart = SCENARIO.replace("distance_m = 0.1\n", "");
    with_more(&folder, 900);
    let scenario = folder.load(&apart).expect("sound");
    let names = names(&scenario);
    assert_eq!(names[899], ("tower.900", "tower"));
    assert_eq!(names[902], ("the_jib", "the jib"));
    let kept = folder.load(SCENARIO).expect_err("too many sets");
    assert!(kept.contains("shapes need at least 257"), "{kept}");
    with_more(&folder, 50_000);
    let refused = folder.load(&apart).expect_err("too many shapes");
    assert!(
        refused.contains("robot.shapes: ") && refused.contains("there are 50003"),
        "{refused}"
    );
}
