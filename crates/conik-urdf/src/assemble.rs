//! From the description to the robot: bodies, frames and limits.

use conik::{Body, Joint, JointLimits, Pose, RobotBuilder, RobotError};

use crate::Described;
use crate::description::Description;
use crate::error::UrdfError;
use crate::joint::DescribedJoint;
use crate::narrow::limits_with_followers;
use crate::note::Notes;
use crate::pose::{moved, with_z_axis};
use crate::role::Role;
use crate::tree::{Step, Tree};

/// Joints and followers that a robot may have.
const MOST_MOVED: usize = 32;

/// A link's frame: the body that it is on, and body_from_link.
type Attached = (Body, Pose);

/// Puts the robot together.
///
/// A joint of the description acts about any axis `a` of its frame, one of the robot about z. With a
/// turn A that takes z to `a`, parent_from_child(q) = origin · A · Rz(q) · A⁻¹; so the frame of what is
/// moved is the child's. The other way round, child_from_parent(q) = A · Rz(q) · A⁻¹ · origin⁻¹ with A
/// taking z to −a.
pub(crate) fn robot(
    description: &Description,
    tree: &Tree,
    roles: &[Role],
    mut notes: Notes,
) -> Result<Described, UrdfError> {
    let is_moved = |role: &&Role| matches!(role, Role::Moves(_) | Role::Follows(..));
    let moved = roles.iter().filter(is_moved).count();
    if moved > MOST_MOVED {
        return Err(description.robot.error(
            format!("{moved} joints move or follow, and a robot may have {MOST_MOVED}"),
            "choose base and tools with fewer joints between them",
        ));
    }
    let unusable = |error: RobotError| {
        description.robot.error(
            format!("no robot can be made of it: {error}"),
            "are its lengths and angles sound?",
        )
    };
    let mut builder = RobotBuilder::new(description.name);
    let mut attached: Vec<Option<Attached>> = vec![None; description.links.len()];
    attached[tree.base] = Some((Body::FIXED, Pose::IDENTITY));
    builder
        .link(
            description.links[tree.base].name,
            Body::FIXED,
            Pose::IDENTITY,
        )
        .map_err(unusable)?;
    let limits = limits_with_followers(description, tree, roles, &mut notes);
    let mut efforts = Vec::new();
    for step in &tree.steps {
        let Some(carrier) = attached[step.from] else {
            // Steps follow from one another: there always is one.
            continue;
        };
        let joint = &description.joints[step.joint];
        if let Role::Moves(_) = roles[step.joint] {
            efforts.push(joint.limits.effort);
        }
        let link = attach(
            &mut builder,
            carrier,
            *step,
            joint,
            (roles[step.joint], limits[step.joint]),
        )
        .map_err(unusable)?;
        attached[step.to] = Some(link);
        builder
            .link(description.links[step.to].name, link.0, link.1)
            .map_err(unusable)?;
    }
    builder
        .tool(description.links[tree.tool].name)
        .map_err(unusable)?;
    Ok(Described {
        robot: builder.build().map_err(unusable)?,
        efforts,
        notes: notes.finish(),
    })
}

/// The frame of the link that a step leads to.
fn attach(
    builder: &mut RobotBuilder,
    (body, body_from_link): Attached,
    step: Step,
    joint: &DescribedJoint,
    (role, limits): (Role, JointLimits),
) -> Result<Attached, RobotError> {
    let (axis, before, after) = if step.is_forward {
        (joint.axis, joint.origin, Pose::IDENTITY)
    } else {
        (-joint.axis, Pose::IDENTITY, joint.origin.inverse())
    };
    let still = body_from_link * before;
    let align = with_z_axis(axis);
    let (placement, joint_from_body) = (still * align, align.inverse() * after);
    match role {
        Role::Fixed => Ok((body, still * after)),
        Role::Held(kind, position) => Ok((body, still * moved(kind, axis, position) * after)),
        Role::Moves(kind) => {
            let joint = Joint {
                name: joint.name.to_owned(),
                kind,
                limits,
            };
            let moved = builder.joint_between(body, placement, joint, joint_from_body)?;
            Ok((moved, Pose::IDENTITY))
        }
        Role::Follows(kind, mimic) => {
            let what = (kind, mimic, joint.name);
            let moved = builder.follower_between(body, placement, what, joint_from_body)?;
            Ok((moved, Pose::IDENTITY))
        }
    }
}
