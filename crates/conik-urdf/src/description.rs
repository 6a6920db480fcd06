//! The whole description: its links and its joints, each name once.

use std::collections::HashMap;

use roxmltree::Document;

use crate::document;
use crate::element::Element;
use crate::error::{UrdfError, quoted};
use crate::joint::{self, DescribedJoint};
use crate::note::Notes;
use crate::unknown;

/// Links and joints in the order of the text.
#[derive(Debug)]
pub(crate) struct Description<'d> {
    pub(crate) name: &'d str,
    pub(crate) robot: Element<'d>,
    pub(crate) links: Vec<DescribedLink<'d>>,
    pub(crate) joints: Vec<DescribedJoint<'d>>,
}

/// A link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DescribedLink<'d> {
    pub(crate) name: &'d str,
    pub(crate) element: Element<'d>,
}

/// What stands in a description and moves nothing: bodies, drives, and what simulators want to know.
const LEFT_OUT: &[(&str, &str)] = &[
    (
        "inertial",
        "masses are left out: conik commands motions, not forces",
    ),
    ("visual", "shapes to look at are left out"),
    (
        "collision",
        "shapes of bodies are no part of the robot: distances to them are kept only where that is asked for",
    ),
    (
        "safety_controller",
        "its soft limits are left out: those of `<limit>` hold",
    ),
    (
        "dynamics",
        "damping and friction are left out: conik commands motions, not forces",
    ),
    (
        "calibration",
        "where the joint is calibrated is left out: it has no effect on motions",
    ),
    ("transmission", "drives are left out"),
    ("gazebo", "what it says to a simulator is left out"),
    ("ros2_control", "drives are left out"),
];

/// Reads links and joints.
pub(crate) fn read<'d>(
    document: &'d Document<'d>,
    notes: &mut Notes,
) -> Result<Description<'d>, UrdfError> {
    let robot = document::robot(document)?;
    let name = robot.attribute("name").unwrap_or_default();
    if name.trim().is_empty() {
        notes.add(&robot, "robot", "without a name");
    }
    let mut links = Vec::new();
    let mut places = HashMap::new();
    for element in robot.children().filter(|child| child.tag() == "link") {
        let name = element.required("name", "for example `<link name=\"forearm\"/>`")?;
        if let Some(earlier) = places.insert(name, links.len()) {
            let earlier: &DescribedLink = &links[earlier];
            return Err(taken(&element, name, &earlier.element));
        }
        links.push(DescribedLink { name, element });
    }
    if links.is_empty() {
        return Err(robot.error(
            "there is no link",
            "a robot needs `<link name=\"...\"/>` for each of its bodies, and joints between them",
        ));
    }
    let mut joints: Vec<DescribedJoint> = Vec::new();
    let mut named = HashMap::new();
    for element in robot.children().filter(|child| child.tag() == "joint") {
        let joint = joint::read(element, |name| places.get(name).copied(), notes)?;
        if let Some(earlier) = named.insert(joint.name, joints.len()) {
            return Err(taken(&element, joint.name, &joints[earlier].element));
        }
        joints.push(joint);
    }
    note_what_is_left_out(&robot, notes);
    unknown::note(&robot, notes);
    Ok(Description {
        name: if name.trim().is_empty() {
            "robot"
        } else {
            name
        },
        robot,
        links,
        joints,
    })
}

fn taken(element: &Element, name: &str, earlier: &Element) -> UrdfError {
    element.error_at(
        "name",
        format!(
            "the name {} is taken: a {} in line {} has it",
            quoted(name),
            earlier.tag(),
            earlier.place().0
        ),
        "give each its own name",
    )
}

/// One note for each kind of thing that is left out, however many there are.
fn note_what_is_left_out(robot: &Element, notes: &mut Notes) {
    let inner = robot
        .children()
        .filter(|child| matches!(child.tag(), "link" | "joint"))
        .flat_map(|child| child.children());
    let mut found: Vec<&str> = Vec::new();
    for element in robot.children().chain(inner) {
        let tag = element.tag();
        let Some((_, what)) = LEFT_OUT.iter().find(|(left_out, _)| *left_out == tag) else {
            continue;
        };
        if !found.contains(&tag) {
            found.push(tag);
            notes.add(&element, tag, *what);
        }
    }
}
