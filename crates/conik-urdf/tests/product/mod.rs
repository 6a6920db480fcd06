//! An independent reading of a fixture: products of homogeneous matrices from the root to each link.

use std::collections::HashMap;

use nalgebra::{Matrix4, Rotation3, Translation3, Unit, Vector3};
use roxmltree::{Document, Node};

pub struct Product {
    /// Of each link, the joint that carries it.
    carried_by: HashMap<String, Joint>,
    links: usize,
}

struct Joint {
    name: String,
    kind: String,
    parent: String,
    origin: Matrix4<f64>,
    axis: Unit<Vector3<f64>>,
    mimic: Option<(String, f64, f64)>,
    limit: Option<(f64, f64)>,
}

fn numbers(node: Option<Node>, attribute: &str, default: [f64; 3]) -> Vector3<f64> {
    let text = node.and_then(|node| node.attribute(attribute));
    let numbers = text.map(|text| {
        let words = text.split_whitespace().map(str::parse::<f64>);
        Vector3::from_iterator(words.map(|number| number.expect("a number")))
    });
    numbers.unwrap_or_else(|| default.into())
}

impl Product {
    pub fn new(text: &str) -> Self {
        let document = Document::parse(text).expect("XML");
        let all = || document.root_element().children();
        let joints = all().filter(|node| node.has_tag_name("joint"));
        let carried_by = joints.map(|node| {
            let child = |tag| node.children().find(|child| child.has_tag_name(tag));
            let link = |tag| {
                child(tag)
                    .and_then(|end| end.attribute("link"))
                    .expect("a link")
            };
            let number = |node: Node, name: &str, default: f64| {
                node.attribute(name)
                    .map_or(default, |text| text.parse().expect("a number"))
            };
            let xyz = numbers(child("origin"), "xyz", [0.0; 3]);
            let rpy = numbers(child("origin"), "rpy", [0.0; 3]);
            let origin = Translation3::from(xyz).to_homogeneous()
                * Rotation3::from_euler_angles(rpy.x, rpy.y, rpy.z).to_homogeneous();
            let joint = Joint {
                name: node.attribute("name").expect("a name").to_owned(),
                kind: node.attribute("type").expect("a type").to_owned(),
                parent: link("parent").to_owned(),
                origin,
                axis: Unit::new_normalize(numbers(child("axis"), "xyz", [1.0, 0.0, 0.0])),
                mimic: child("mimic").map(|mimic| {
                    let leader = mimic.attribute("joint").expect("a joint").to_owned();
                    (
                        leader,
                        number(mimic, "multiplier", 1.0),
                        number(mimic, "offset", 0.0),
                    )
                }),
                limit: child("limit")
                    .filter(|limit| limit.has_attribute("lower"))
                    .map(|limit| (number(limit, "lower", 0.0), number(limit, "upper", 0.0))),
            };
            (link("child").to_owned(), joint)
        });
        Self {
            carried_by: carried_by.collect(),
            links: all().filter(|node| node.has_tag_name("link")).count(),
        }
    }

    pub fn link_count(&self) -> usize {
        self.links
    }

    /// Where a joint is: told, or following, or at its limit nearest to 0.
    fn position(&self, joint: &Joint, q: &[(&str, f64)]) -> f64 {
        if let Some((leader, multiplier, offset)) = &joint.mimic {
            let leader = self.carried_by.values().find(|other| other.name == *leader);
            return multiplier * self.position(leader.expect("a leader"), q) + offset;
        }
        let told = q.iter().find(|(name, _)| *name == joint.name);
        told.map_or_else(
            || {
                joint
                    .limit
                    .map_or(0.0, |(min, max)| 0.0_f64.clamp(min, max))
            },
            |(_, position)| *position,
        )
    }

    /// The pose of a link in the frame of the root.
    pub fn root_from(&self, link: &str, q: &[(&str, f64)]) -> Matrix4<f64> {
        let Some(joint) = self.carried_by.get(link) else {
            return Matrix4::identity();
        };
        let position = self.position(joint, q);
        let moved = match joint.kind.as_str() {
            "prismatic" => Translation3::from(joint.axis.into_inner() * position).to_homogeneous(),
            "fixed" => Matrix4::identity(),
            _ => Rotation3::from_axis_angle(&joint.axis, position).to_homogeneous(),
        };
        self.root_from(&joint.parent, q) * joint.origin * moved
    }
}
