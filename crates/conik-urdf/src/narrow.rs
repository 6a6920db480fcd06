//! Limits of joints that others follow: where the others reach theirs, the joint must stop too.

use conik::JointLimits;

use crate::description::Description;
use crate::note::Notes;
use crate::role::Role;
use crate::tree::Tree;

/// What is narrowed by less is only rounded otherwise [rad or m].
const ROUNDED: f64 = 1e-6;

/// The limits of each joint, narrowed so that those that follow it keep theirs too.
pub(crate) fn limits_with_followers(
    description: &Description,
    tree: &Tree,
    roles: &[Role],
    notes: &mut Notes,
) -> Vec<JointLimits> {
    let joints = &description.joints;
    let mut limits: Vec<JointLimits> = joints.iter().map(|joint| joint.limits.joint).collect();
    // The degrees of freedom are numbered along the way.
    let way = tree.steps[..tree.on_way].iter().map(|step| step.joint);
    let leaders: Vec<usize> = way
        .filter(|place| matches!(roles[*place], Role::Moves(_)))
        .collect();
    for (follower, role) in joints.iter().zip(roles) {
        let Role::Follows(_, mimic) = role else {
            continue;
        };
        if mimic.multiplier == 0.0 {
            continue;
        }
        let leader = &mut limits[leaders[mimic.joint]];
        if let Some(own) = follower.limits.joint.position {
            let ends = [own.0, own.1].map(|end| (end - mimic.offset) / mimic.multiplier);
            let (min, max) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            let (least, most) = leader
                .position
                .unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
            let both = (least.max(min), most.min(max));
            if both.0 > both.1 {
                notes.add(
                    &follower.element,
                    follower.name,
                    "its position limits are left out: no position of the joint that it follows \
                     keeps them",
                );
            } else {
                if both.0 - least > ROUNDED || most - both.1 > ROUNDED {
                    notes.add(
                        &follower.element,
                        follower.name,
                        "its position limits narrow those of the joint that it follows",
                    );
                }
                leader.position = Some(both);
            }
        }
        if let Some(own) = follower.limits.joint.speed {
            let speed = own / mimic.multiplier.abs();
            leader.speed = Some(leader.speed.map_or(speed, |limit| limit.min(speed)));
        }
    }
    limits
}
