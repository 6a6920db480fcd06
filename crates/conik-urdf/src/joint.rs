//! One `<joint>` of the description.

use conik::{JointKind, Pose, Vec3};

use crate::element::Element;
use crate::error::{UrdfError, quoted};
use crate::limits::{self, Limits};
use crate::note::Notes;
use crate::pose;
use crate::unit;

/// A joint as described: `child` hangs on `parent`.
#[derive(Clone, Debug)]
pub(crate) struct DescribedJoint<'d> {
    pub(crate) name: &'d str,
    pub(crate) element: Element<'d>,
    pub(crate) movement: Movement,
    /// Places among the links.
    pub(crate) parent: usize,
    pub(crate) child: usize,
    /// parent_from_joint, at position 0 parent_from_child.
    pub(crate) origin: Pose,
    /// Unit vector in the joint's frame.
    pub(crate) axis: Vec3,
    pub(crate) limits: Limits,
    pub(crate) mimic: Option<DescribedMimic<'d>>,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Movement {
    Fixed,
    Along(JointKind),
    /// In more than one direction: `planar` or `floating`.
    Freely,
}

/// A joint's `<mimic>`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DescribedMimic<'d> {
    pub(crate) element: Element<'d>,
    pub(crate) leader: &'d str,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

const TYPES: &str = "known types: \"fixed\", \"revolute\", \"continuous\", \"prismatic\"";

/// Reads a joint. `link` finds the place of a link by name.
pub(crate) fn read<'d>(
    element: Element<'d>,
    link: impl Fn(&str) -> Option<usize>,
    notes: &mut Notes,
) -> Result<DescribedJoint<'d>, UrdfError> {
    let name = element.required("name", "for example `<joint name=\"elbow\" ...>`")?;
    let kind = element.required("type", "for example `type=\"revolute\"`")?;
    let (movement, has_ends) = match kind {
        "fixed" => (Movement::Fixed, false),
        "revolute" => (Movement::Along(JointKind::Revolute), true),
        "continuous" => (Movement::Along(JointKind::Revolute), false),
        "prismatic" => (Movement::Along(JointKind::Prismatic), true),
        "planar" | "floating" => (Movement::Freely, false),
        other => {
            let what = format!("unknown type {}", quoted(other));
            return Err(element.error_at("type", what, TYPES));
        }
    };
    let end = |tag: &str| {
        let example = format!("for example `<{tag} link=\"forearm\"/>`");
        let end = element.child(tag)?.ok_or_else(|| {
            element.error(format!("`<{tag}>` is missing"), format!("write {example}"))
        })?;
        let name = end.required("link", &example)?;
        link(name).ok_or_else(|| {
            end.error_at(
                "link",
                format!("there is no link {}", quoted(name)),
                format!(
                    "add `<link name={}/>`, or name one that there is",
                    quoted(name)
                ),
            )
        })
    };
    let (parent, child) = (end("parent")?, end("child")?);
    let origin = pose::origin(&element, name, notes)?;
    let Movement::Along(kind) = movement else {
        return Ok(DescribedJoint {
            name,
            element,
            movement,
            parent,
            child,
            origin,
            axis: Pose::IDENTITY.z_axis,
            limits: Limits::default(),
            mimic: None,
        });
    };
    let axis = axis(&element, name, notes)?;
    let limits = limits::read(&element, name, has_ends, notes)?;
    unit::note_limits(&element, name, (kind, &limits.joint), notes);
    Ok(DescribedJoint {
        name,
        element,
        movement,
        parent,
        child,
        origin,
        axis,
        limits,
        mimic: mimic(&element)?,
    })
}

/// The joint's axis; x where none is given (URDF specification, "axis").
fn axis(joint: &Element, name: &str, notes: &mut Notes) -> Result<Vec3, UrdfError> {
    let Some(axis) = joint.child("axis")? else {
        notes.add(joint, name, "no `<axis>`, which means its x axis");
        return Ok(Pose::IDENTITY.x_axis);
    };
    let Some(xyz) = axis.three_numbers("xyz")? else {
        notes.add(
            &axis,
            name,
            "`<axis>` without `xyz`, which means its x axis",
        );
        return Ok(Pose::IDENTITY.x_axis);
    };
    let greatest = xyz.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if greatest == 0.0 {
        return Err(axis.error_at(
            "xyz",
            "the axis has no direction",
            "give the direction about which, or along which, the joint moves: `xyz=\"0 0 1\"`",
        ));
    }
    // The greatest entry comes first: squares of minute ones are 0.
    Ok(Vec3::from(xyz.map(|x| x / greatest)).normalized())
}

fn mimic<'d>(joint: &Element<'d>) -> Result<Option<DescribedMimic<'d>>, UrdfError> {
    let Some(element) = joint.child("mimic")? else {
        return Ok(None);
    };
    let leader = element.required("joint", "for example `<mimic joint=\"left_finger\"/>`")?;
    Ok(Some(DescribedMimic {
        element,
        leader,
        multiplier: element.number("multiplier")?.unwrap_or(1.0),
        offset: element.number("offset")?.unwrap_or(0.0),
    }))
}
