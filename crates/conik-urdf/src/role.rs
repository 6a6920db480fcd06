//! What each joint is to the robot: a degree of freedom, a follower, or held still.

use conik::{JointKind, Mimic};

use crate::description::Description;
use crate::error::{UrdfError, quoted};
use crate::joint::{DescribedJoint, Movement};
use crate::mimic::{self, Following};
use crate::note::Notes;
use crate::tree::Tree;

/// What a joint does.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Role {
    /// Nothing: its links are as one.
    Fixed,
    /// It stays at this position [rad or m].
    Held(JointKind, f64),
    /// It is the degree of freedom of this number.
    Moves(JointKind),
    /// It follows one.
    Follows(JointKind, Mimic),
}

/// Of each joint, what it does.
pub(crate) fn of_joints(
    description: &Description,
    tree: &Tree,
    notes: &mut Notes,
) -> Result<Vec<Role>, UrdfError> {
    let joints = &description.joints;
    let following = mimic::resolve(description)?;
    let on_way = || tree.steps[..tree.on_way].iter().map(|step| step.joint);
    let mut numbers: Vec<Option<usize>> = vec![None; joints.len()];
    let mut dof = 0;
    for place in on_way() {
        let joint = &joints[place];
        match joint.movement {
            Movement::Freely => {
                return Err(joint.element.error_at(
                    "type",
                    "the joint is between base and tool, and moves in more than one direction",
                    "describe it as several \"revolute\" and \"prismatic\" joints, or choose a base \
                     behind it",
                ));
            }
            Movement::Along(_) if following[place].leader == Some(place) => {
                numbers[place] = Some(dof);
                dof += 1;
            }
            Movement::Along(_) if following[place].leader.is_none() => {
                return Err(follows_nothing(joint));
            }
            Movement::Along(_) | Movement::Fixed => {}
        }
    }
    if dof == 0 {
        return Err(description.robot.error(
            format!(
                "no joint moves {} as seen from {}",
                quoted(description.links[tree.tool].name),
                quoted(description.links[tree.base].name)
            ),
            "choose a base and a tool with a joint between them that is not fixed and follows none \
             elsewhere",
        ));
    }
    let mut is_on_way = vec![false; joints.len()];
    for place in on_way() {
        is_on_way[place] = true;
    }
    let roles = (0..joints.len()).map(|place| {
        let joint = &joints[place];
        let Movement::Along(kind) = joint.movement else {
            if joint.movement == Movement::Freely {
                notes.add(
                    &joint.element,
                    joint.name,
                    "held at its origin: it moves in more than one direction",
                );
            }
            return Role::Fixed;
        };
        if numbers[place].is_some() {
            return Role::Moves(kind);
        }
        let Following {
            leader,
            multiplier,
            offset,
        } = following[place];
        let Some(leader) = leader else {
            notes.add(
                &joint.element,
                joint.name,
                "held as if what it follows stood at 0: there is no joint of that name",
            );
            return Role::Held(kind, offset);
        };
        if let Some(number) = numbers[leader] {
            let mimic = Mimic {
                joint: number,
                multiplier,
                offset,
            };
            return Role::Follows(kind, mimic);
        }
        let (rest, is_at_limit) = rest(&joints[leader]);
        let what = if joints[leader].movement == Movement::Fixed {
            "held: what it follows does not move"
        } else if joints[leader].movement == Movement::Freely {
            "held as if what it follows stood at 0: that moves in more than one direction"
        } else if is_on_way[place] {
            "held: what it follows is not on the way from base to tool"
        } else if leader == place && is_at_limit {
            "held at its limit nearest to 0: it is not on the way from base to tool"
        } else {
            "held still: it is not on the way from base to tool"
        };
        notes.add(&joint.element, joint.name, what);
        Role::Held(kind, multiplier * rest + offset)
    });
    Ok(roles.collect())
}

/// The error about a joint that is needed and follows one that is not there.
fn follows_nothing(joint: &DescribedJoint) -> UrdfError {
    let element = joint.mimic.as_ref().map_or(joint.element, |it| it.element);
    element.error(
        "it, or what it follows, follows a joint that is not there",
        "name a joint of this description: `<mimic joint=\"...\"/>`",
    )
}

/// Where a joint is held: at 0, or at its limit nearest to it, and whether that is so.
fn rest(joint: &DescribedJoint) -> (f64, bool) {
    match joint.limits.joint.position {
        Some((min, _)) if min > 0.0 => (min, true),
        Some((_, max)) if max < 0.0 => (max, true),
        _ => (0.0, false),
    }
}
