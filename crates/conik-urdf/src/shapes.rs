//! The shapes of the links: what their `<collision>` elements say.

use conik::{Capsule, Cuboid, Cylinder, Pose, Shape, Sphere};

use crate::document;
use crate::element::Element;
use crate::error::UrdfError;
use crate::note::Notes;
use crate::pose;

/// A shape of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkShape {
    /// Name of the link.
    pub link: String,
    /// The shape in the link's frame [m].
    pub shape: Shape,
}

/// A link that has a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkMesh {
    /// Name of the link.
    pub link: String,
    /// Line of the mesh, from 1.
    pub line: usize,
}

/// The shapes of a description, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DescribedShapes {
    /// Those that have a distance.
    pub shapes: Vec<LinkShape>,
    /// Those that have none.
    pub meshes: Vec<LinkMesh>,
}

/// Reads the primitive shapes of a description's `<collision>` elements: `box`, `sphere`, `cylinder` and
/// `capsule`; of meshes, which links have them.
///
/// # Errors
///
/// As [`read`](crate::read); the joints are not looked at.
pub fn shapes(text: &str) -> Result<DescribedShapes, UrdfError> {
    let document = document::parse(text)?;
    let robot = document::robot(&document)?;
    // What is odd about an origin is not what keeps a robot from its description.
    let mut notes = Notes::default();
    let mut described = DescribedShapes::default();
    // Counted from one mesh to the next, of which there may be tens of thousands.
    let (mut line, mut counted) = (1, 0);
    for link in robot.children().filter(|child| child.tag() == "link") {
        let name = link.required("name", "for example `<link name=\"forearm\"/>`")?;
        for collision in link.children().filter(|it| it.tag() == "collision") {
            let geometry = geometry(&collision)?;
            if geometry.tag() == "mesh" {
                let start = geometry.start();
                let lines_since = |text: &str| text.bytes().filter(|byte| *byte == b'\n').count();
                line += document
                    .input_text()
                    .get(counted..start)
                    .map_or(0, lines_since);
                counted = start;
                described.meshes.push(LinkMesh {
                    link: name.to_owned(),
                    line,
                });
                continue;
            }
            let from_shape = pose::origin(&collision, name, &mut notes)?;
            described.shapes.push(LinkShape {
                link: name.to_owned(),
                shape: shape(&geometry)?.placed(&from_shape),
            });
        }
    }
    Ok(described)
}

/// What stands in `<geometry>`.
fn geometry<'d>(collision: &Element<'d>) -> Result<Element<'d>, UrdfError> {
    const EXAMPLE: &str = "write for example `<geometry><sphere radius=\"0.1\"/></geometry>`";
    let geometry = collision
        .child("geometry")?
        .ok_or_else(|| collision.error("`<geometry>` is missing", EXAMPLE))?;
    let mut found = geometry.children();
    match (found.next(), found.next()) {
        (Some(shape), None) => Ok(shape),
        _ => Err(geometry.error("it must hold one shape", EXAMPLE)),
    }
}

/// The shape in its own frame.
fn shape(geometry: &Element) -> Result<Shape, UrdfError> {
    Ok(match geometry.tag() {
        "box" => {
            let size = geometry.three_numbers("size")?;
            let size = size.ok_or_else(|| missing(geometry, "size", "0.1 0.2 0.3"))?;
            if size.iter().any(|edge| *edge <= 0.0) {
                return Err(not_positive(geometry, "size"));
            }
            Cuboid::new(Pose::IDENTITY, size).into()
        }
        "sphere" => Sphere::new([0.0; 3], length(geometry, "radius")?).into(),
        // Both lie along z, their middle at the origin; the length of a capsule is without its caps.
        tag @ ("cylinder" | "capsule") => {
            let radius = length(geometry, "radius")?;
            let half = length(geometry, "length")? / 2.0;
            let (from, to) = ([0.0, 0.0, -half], [0.0, 0.0, half]);
            if tag == "cylinder" {
                Cylinder::new(from, to, radius).into()
            } else {
                Capsule::new(from, to, radius).into()
            }
        }
        _ => {
            return Err(geometry.error(
                "it is no shape of URDF",
                "known shapes: `box`, `sphere`, `cylinder`, `capsule`, `mesh`",
            ));
        }
    })
}

/// A length that must be there, and above 0.
fn length(geometry: &Element, name: &str) -> Result<f64, UrdfError> {
    match geometry.number(name)? {
        Some(length) if length > 0.0 => Ok(length),
        Some(_) => Err(not_positive(geometry, name)),
        None => Err(missing(geometry, name, "0.1")),
    }
}

fn missing(geometry: &Element, name: &str, example: &str) -> UrdfError {
    let help = format!("write it in metres: `{name}=\"{example}\"`");
    geometry.error_at(name, "missing", help)
}

fn not_positive(geometry: &Element, name: &str) -> UrdfError {
    geometry.error_at(name, "a length must be above 0", "give it in metres")
}
