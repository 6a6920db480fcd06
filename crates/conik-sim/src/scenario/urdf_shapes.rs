//! The shapes that a URDF file gives the links: `shapes` in `[robot]`.

use std::collections::{HashMap, HashSet};

use super::choice::Choice;
use super::collision::{LinkShape, MOST, name_of};
use super::geometry::Geometry;
use super::keys;
use super::mistake::Mistakes;
use super::robot_source::{RobotSource, UrdfConfig, mistaken, note};
use super::table::Table;

/// `robot.shapes`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UrdfShapes {
    None,
    Collision,
    Primitives,
}

impl Choice for UrdfShapes {
    const ALL: &'static [(Self, &'static str)] = &[
        (Self::None, "none"),
        (
            Self::Collision,
            "those of its `<collision>` elements; a mesh is an error, unless its link has a \
             `[[shape]]` of its own",
        ),
        (
            Self::Primitives,
            "those of them that are no meshes: no distance to a mesh is kept",
        ),
    ];

    fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Collision => "collision",
            Self::Primitives => "primitives",
        }
    }
}

/// The shapes of the links, named as their links, or where that name is taken `LINK.2`, `LINK.3`; `None` if
/// they cannot be had. A link for which the scenario has shapes of its `own` gets none.
pub(super) fn read(
    table: &Table,
    source: Option<&RobotSource>,
    own: &[LinkShape],
    found: &mut Mistakes,
) -> Option<Vec<LinkShape>> {
    let wanted = table
        .choice(&keys::URDF_SHAPES, found)
        .or(UrdfShapes::None)?;
    let (Some(RobotSource::Urdf(file)), true) = (source, wanted != UrdfShapes::None) else {
        return Some(Vec::new());
    };
    let has_own = |link: &str| own.iter().any(|shape| shape.link == link);
    let described = match conik_urdf::shapes(&file.urdf_text) {
        Ok(described) => described,
        Err(error) => {
            note(table, &file.urdf, &error, found);
            return None;
        }
    };
    let count = own.len() + described.shapes.len();
    if count > MOST {
        let what = format!(
            "{}: with its shapes there are {count}, which is too many",
            file.urdf
        );
        let help = format!("give the links at most {MOST}, with `[[shape]]`");
        mistaken(table, &keys::URDF_SHAPES, &what, &help, found);
        return None;
    }
    let mut meshes = described.meshes.iter().filter(|mesh| !has_own(&mesh.link));
    if let (UrdfShapes::Collision, Some(mesh)) = (wanted, meshes.next()) {
        refuse_meshes(table, file, mesh, meshes.count(), found);
        return None;
    }
    let mut shapes: Vec<LinkShape> = Vec::new();
    let mut taken: HashSet<String> = own.iter().map(|shape| shape.name.clone()).collect();
    // Of each link, the number that its next shape has.
    let mut next: HashMap<String, usize> = HashMap::new();
    for shape in described.shapes {
        if has_own(&shape.link) {
            continue;
        }
        let name = name_of(&shape.link);
        let number = next.entry(name.clone()).or_insert(1);
        let mut free = name.clone();
        while !taken.insert(free.clone()) {
            *number += 1;
            free = format!("{name}.{number}");
        }
        shapes.push(LinkShape {
            name: free,
            link: shape.link,
            geometry: Geometry::from(shape.shape),
        });
    }
    Some(shapes)
}

fn refuse_meshes(
    table: &Table,
    file: &UrdfConfig,
    mesh: &conik_urdf::LinkMesh,
    more: usize,
    found: &mut Mistakes,
) {
    let others = match more {
        0 => String::new(),
        1 => ", and one more link".to_owned(),
        more => format!(", and {more} more"),
    };
    let what = format!(
        "{}:{}: the shape of link {:?} is a mesh, and meshes have no distance{others}",
        file.urdf, mesh.line, mesh.link
    );
    let help = "give each such link a `[[shape]]`, or take `shapes = \"primitives\"`, which keeps no \
                distance to meshes";
    mistaken(table, &keys::URDF_SHAPES, &what, help, found);
}
