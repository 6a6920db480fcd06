//! What stands where a description is read and is none of URDF's: misspelt, or somebody else's.

use std::collections::HashSet;

use crate::element::Element;
use crate::note::Notes;

/// An element that is read, and the elements and attributes that URDF has in it.
struct Known {
    tag: &'static str,
    elements: &'static [&'static str],
    attributes: &'static [&'static str],
}

/// URDF specification 1.2, and what simulators and controllers have there by custom.
const KNOWN: &[Known] = &[
    Known {
        tag: "robot",
        elements: &[
            "link",
            "joint",
            "material",
            "transmission",
            "gazebo",
            "ros2_control",
            "model_state",
            "sensor",
        ],
        attributes: &["name", "version"],
    },
    Known {
        tag: "link",
        elements: &["inertial", "visual", "collision", "contact", "sensor"],
        attributes: &["name", "type"],
    },
    Known {
        tag: "joint",
        elements: &[
            "parent",
            "child",
            "origin",
            "axis",
            "limit",
            "mimic",
            "dynamics",
            "calibration",
            "safety_controller",
        ],
        attributes: &["name", "type"],
    },
    Known {
        tag: "parent",
        elements: &[],
        attributes: &["link"],
    },
    Known {
        tag: "child",
        elements: &[],
        attributes: &["link"],
    },
    Known {
        tag: "origin",
        elements: &[],
        attributes: &["xyz", "rpy", "quat_xyzw"],
    },
    Known {
        tag: "axis",
        elements: &[],
        attributes: &["xyz"],
    },
    Known {
        tag: "limit",
        elements: &[],
        attributes: &[
            "lower",
            "upper",
            "velocity",
            "effort",
            "acceleration",
            "deceleration",
            "jerk",
        ],
    },
    Known {
        tag: "mimic",
        elements: &[],
        attributes: &["joint", "multiplier", "offset"],
    },
];

/// Notes it in the robot, its links and its joints: each name once, however often it is there.
pub(crate) fn note(robot: &Element, notes: &mut Notes) {
    let mut said = HashSet::new();
    look_at(robot, &mut said, notes);
    for element in robot.children() {
        if !matches!(element.tag(), "link" | "joint") {
            continue;
        }
        look_at(&element, &mut said, notes);
        if element.tag() == "joint" {
            for part in element.children() {
                look_at(&part, &mut said, notes);
            }
        }
    }
}

/// The element that has it, what kind of thing it is, and its name.
type Said<'d> = (&'d str, &'static str, &'d str);

fn look_at<'d>(element: &Element<'d>, said: &mut HashSet<Said<'d>>, notes: &mut Notes) {
    let tag = element.tag();
    let Some(known) = KNOWN.iter().find(|known| known.tag == tag) else {
        return;
    };
    for child in element.children() {
        let name = child.tag();
        if !known.elements.contains(&name) && said.insert((tag, "element", name)) {
            let what = format!("no element of `<{tag}>` in URDF, so it is left out");
            notes.add(&child, name, what);
        }
    }
    for name in element.attribute_names() {
        if !known.attributes.contains(&name) && said.insert((tag, "attribute", name)) {
            let what = format!("no attribute of `<{tag}>` in URDF, so it is left out");
            notes.add(element, name, what);
        }
    }
    for child in element.others() {
        let name = child.written_tag();
        if said.insert(("", "element", name)) {
            notes.add(
                &child,
                name,
                "what has a prefix is somebody else's, so it is left out",
            );
        }
    }
}
